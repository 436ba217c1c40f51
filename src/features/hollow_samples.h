// Finds samples lower than the land on both sides, and their neighbours, also in rasters larger than memory.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/point.h"
#include "features/hollows.h"
#include "scarp/height_field.h"
#include "scarp/result.h"

namespace scarp::features {

class HollowSamples {
 public:
  struct Question {
    double height = 0;                       ///< see find_hollows()
    bool is_upside_down = false;             ///< true: searches the negated raster
    std::function<bool(Point)> is_left_out;  ///< true for samples to ignore
    /// Called with the number of samples found so far and the share of the raster searched; may fail.
    std::function<Result<void>(std::uint64_t samples, double share)> check;
    int threads = 0;
  };
  /// Finds low samples, and all samples within two samples of them. Reads the field's source once from the top down.
  /// Returns failures of the source and of `check`. Memory: bytes(), and 9 bytes per sample found (18 during the
  /// search).
  static Result<HollowSamples> find(const HeightField& field, const Question& question);
  /// Memory of find() in addition to the samples.
  static std::uint64_t bytes(const HeightField& field);

  std::size_t size() const { return heights_.size(); }
  // In raster order.
  float height(std::uint32_t i) const { return heights_[i]; }  ///< negated where the raster is upside down
  Hollow hollow(std::uint32_t i) const { return hollows_[i]; }
  Point point(std::uint32_t i) const;
  /// Calls visit(j) for the existing samples adjacent to i, diagonals included.
  template <class Visit>
  void visit_neighbours(std::uint32_t i, const Visit& visit) const {
    const Point at = point(i);
    for (std::int32_t row = at.y - 1; row <= at.y + 1; ++row) {
      for (std::uint32_t j = first_from({at.x - 1, row}); j < end_of(row) && cols_[j] <= at.x + 1; ++j) visit(j);
    }
  }

 private:
  std::uint32_t end_of(std::int32_t row) const {
    return row < 0 || row + 1 >= static_cast<std::int32_t>(begins_.size()) ? 0
                                                                           : begins_[static_cast<std::size_t>(row) + 1];
  }
  std::uint32_t first_from(Point p) const;

  std::vector<float> heights_;
  std::vector<std::int32_t> cols_;
  std::vector<Hollow> hollows_;
  std::vector<std::uint32_t> begins_;  // begin of each row's samples, and the end of the last row's
};

}  // namespace scarp::features
