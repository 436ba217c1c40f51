// The per-vertex arrays of a GLB file: float32, or smaller numbers if compressed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "scarp/io.h"
#include "scarp/mesh.h"

namespace scarp::io {

struct GlbAttribute {
  std::string name;
  int component = 0;      ///< glTF's component type
  std::size_t width = 0;  ///< components of a vertex
  bool is_normalized = false;
  std::size_t stride = 0;                                            ///< bytes of a vertex, a multiple of 4
  std::function<void(std::size_t vertex, std::uint8_t*& at)> store;  ///< writes `stride` bytes
};

/// Conversion of numbers in the file to positions: origin + shift + scale · number, in glTF's axes.
struct GlbGrid {
  std::array<double, 3> scale{1, 1, 1}, shift{0, 0, 0};
  bool is_short = false;  ///< 16-bit numbers, else float32

  bool is_plain() const { return scale == std::array{1.0, 1.0, 1.0} && shift == std::array{0.0, 0.0, 0.0}; }
  std::array<double, 3> number(const double* offsets) const;
};

/// The coarsest grid that represents every position exactly, for cells of size `cell`; else the plain grid.
GlbGrid find_grid(const Mesh& mesh, const std::array<double, 2>& cell);
/// True if the grid represents x and y exactly.
bool holds_positions(const GlbGrid& grid, const Mesh& mesh);

/// (x, y, z) → (x, z, −y); 0 − y rather than −y, so that 0 stays 0.
template <class T>
std::array<T, 3> to_y_up(T x, T y, T z) {
  return {x, z, T{0} - y};
}

/// True if the channels repeat the colours: three as red, green and blue, or one as grey.
bool colors_say_channels(const Mesh& mesh);
/// Represents a missing channel value, as declared in the primitive's extras, since JSON and glTF have no NaN.
inline constexpr float kNoChannelValue = std::numeric_limits<float>::lowest();

/// POSITION is first. The mesh, the grid and the options must outlive the result.
std::vector<GlbAttribute> list_glb_attributes(const Mesh& mesh, const GlbGrid& grid, const GlbOptions& options);

}  // namespace scarp::io
