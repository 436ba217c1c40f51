// The samples of a field that moves, stored as a torus, so that samples that stay are not copied.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "scarp/height_field.h"

namespace scarp::live {

/// A rectangle on the lattice of places; its last column and row are included.
struct Area {
  std::int32_t west = 0, north = 0, east = -1, south = -1;

  std::int32_t cols() const { return east - west + 1; }
  std::int32_t rows() const { return south - north + 1; }
  bool is_empty() const { return east < west || south < north; }
  Area grown(std::int32_t by) const { return {west - by, north - by, east + by, south + by}; }
  Area moved(std::int32_t by_cols, std::int32_t by_rows) const {
    return {west + by_cols, north + by_rows, east + by_cols, south + by_rows};
  }
  Area clipped(const Area& to) const;
  void include(std::int32_t col, std::int32_t row);
  /// The parts that another area does not cover; some may be empty, or overlap.
  std::array<Area, 4> beyond(const Area& other) const;

  friend bool operator==(const Area&, const Area&) = default;
};

/// The remainder that is not negative.
inline std::int32_t modulo(std::int32_t value, std::int32_t by) {
  const std::int32_t rest = value % by;
  return rest < 0 ? rest + by : rest;
}

/// One value for each sample.
class SampleRing {
 public:
  SampleRing(std::int32_t cols, std::int32_t rows, float missing)
      : cols_(cols), rows_(rows), missing_(missing), values_(std::size_t(cols) * std::size_t(rows), missing) {}

  /// Writes the values of an area, row by row; samples outside `field` have the value for missing ones.
  void read(const Area& area, const Area& field, float* out) const;
  /// REQUIRES: the area has no more columns and rows than the ring.
  void write(const Area& area, std::span<const float> values);
  void clear(const Area& area);

 private:
  /// Calls visit(values, count, offset) for the one or two runs of a row.
  template <class Visit>
  void visit_runs(std::int32_t row, std::int32_t west, std::int32_t east, const Visit& visit) const;

  std::int32_t cols_, rows_;
  float missing_;
  std::vector<float> values_;
};

}  // namespace scarp::live
