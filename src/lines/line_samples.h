// The samples that lines need: a whole raster, or the samples near the lines of a streamed raster.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "geom/segments.h"
#include "grid/raster.h"
#include "scarp/height_field.h"
#include "scarp/result.h"

namespace scarp::lines {

class LineSamples {
 public:
  /// Borrows the whole raster.
  explicit LineSamples(const grid::Raster& raster) : raster_(raster) {}

  /// Reads the samples of the cells that lattice segments cross, and of the cells around them, from the top down.
  /// Segments may extend some samples beyond the raster. Fails if the field's source fails. Memory: 4 bytes per sample,
  /// 24 for each row that a line crosses, 8 for each row of the raster.
  static Result<LineSamples> read(const HeightField& field, std::span<const geom::Segment> near);

  std::int32_t cols() const { return raster_.cols; }
  std::int32_t rows() const { return raster_.rows; }
  /// NaN for nodata and away from lines.
  float at(Point p) const {
    if (raster_.samples != nullptr) return raster_.at(p);
    const std::size_t i = find(p);
    return i == kNowhere ? std::numeric_limits<float>::quiet_NaN() : heights_[i];
  }
  bool is_valid(Point p) const { return !std::isnan(at(p)); }
  /// Changes the height of a sample near a line, unless it is nodata. Returns the old height. REQUIRES: read().
  float change(Point p, float height);

  /// The part of the surface's outline that is near lines and has known cells on both sides. Excludes the sides of the
  /// raster. REQUIRES: read().
  std::vector<geom::Segment> outline_near() const;

  std::uint64_t bytes() const { return sizeof(float) * heights_.size() + sizeof(Run) * runs_.size(); }

 private:
  struct Run {
    std::int32_t row, col, end;
    std::size_t first;  // index of the first of its heights
  };
  static constexpr std::size_t kNowhere = ~std::size_t{0};

  LineSamples(std::int32_t cols, std::int32_t rows) : raster_{nullptr, cols, rows} {}
  void mark(const geom::Segment& segment);
  void merge_marks();
  std::size_t find(Point p) const;
  bool has_cell(std::int32_t col, std::int32_t row) const;

  grid::Raster raster_;
  std::vector<Run> runs_;            // by row and column, disjoint
  std::vector<std::size_t> begins_;  // begin of each row's runs, and the end of the last row's
  std::vector<float> heights_;
};

}  // namespace scarp::lines
