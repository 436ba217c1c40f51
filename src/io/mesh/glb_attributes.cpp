#include "io/mesh/glb_attributes.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "io/mesh/file_bytes.h"
#include "io/mesh/glb_numbers.h"
#include "io/mesh/srgb.h"

namespace scarp::io {
namespace {

constexpr double kMostShort = 65535, kMostWhole = 1 << 24;

struct Interval {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  double extent() const { return high - low; }
};

double as_float32(double value) { return static_cast<double>(static_cast<float>(value)); }

/// The coarsest of cell, cell / 2 … cell / 256 that divides all coordinates; 0 if none does.
double find_step(const Mesh& mesh, std::size_t axis, double cell) {
  constexpr double kFinest = 256;
  constexpr double kRounding = 0x1p-20;  // rounding of a double, far from the origin
  if (!(cell > 0)) return 0;
  const double unit = cell / kFinest;
  std::uint64_t bits = static_cast<std::uint64_t>(kFinest);
  for (std::size_t i = axis; i < mesh.positions.size(); i += 3) {
    const double steps = mesh.positions[i] / unit, whole = std::nearbyint(steps);
    if (!(std::abs(steps - whole) <= kRounding) || std::abs(whole) > 0x1p40) return 0;
    bits |= static_cast<std::uint64_t>(std::abs(whole));
  }
  return unit * static_cast<double>(std::uint64_t{1} << std::countr_zero(bits));
}

/// The largest power of two that divides all heights.
double find_height_step(const Mesh& mesh) {
  int exponent = std::numeric_limits<int>::max();
  for (std::size_t i = 2; i < mesh.positions.size(); i += 3) {
    const double z = mesh.positions[i];
    if (z == 0) continue;
    int power = 0;
    const auto digits = static_cast<std::uint64_t>(std::ldexp(std::abs(std::frexp(z, &power)), 53));
    exponent = std::min(exponent, power - 53 + std::countr_zero(digits));
  }
  return exponent == std::numeric_limits<int>::max() ? 1 : std::ldexp(1.0, exponent);
}

/// Rounds to twelve significant bits. The other bits become 0, which compresses to nothing.
float round_significand(double value) {
  int power = 0;
  const double digits = std::frexp(value, &power);
  return static_cast<float>(std::ldexp(std::nearbyint(std::ldexp(digits, 12)), power - 12));
}

/// The direction that becomes `normal` when the grid's scale transforms it as a normal.
std::array<double, 3> to_grid(const std::array<float, 3>& normal, const GlbGrid& grid) {
  std::array<double, 3> n{};
  double squares = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    n[k] = double{normal[k]} * grid.scale[k];
    squares += n[k] * n[k];
  }
  if (!(squares > 0)) return {0, 1, 0};
  for (double& component : n) component /= std::sqrt(squares);
  return n;
}

std::uint16_t to_short(double share) { return static_cast<std::uint16_t>(std::nearbyint(share * 65535)); }

GlbAttribute floats(std::string name, std::size_t width, std::function<float(std::size_t, std::size_t)> value) {
  return {std::move(name),
          kFloatComponent,
          width,
          false,
          4 * width,
          [width, value = std::move(value)](std::size_t v, std::uint8_t*& at) {
            for (std::size_t k = 0; k < width; ++k) store_number(at, value(v, k));
          }};
}

/// Values 0 … 1 as multiples of 1/65535, padded to multiples of 4 bytes.
GlbAttribute shares(std::string name, std::size_t width, std::function<double(std::size_t, std::size_t)> value) {
  const std::size_t padded = (width + 1) / 2 * 2;
  return {std::move(name),
          kUint16Component,
          width,
          true,
          2 * padded,
          [width, padded, value = std::move(value)](std::size_t v, std::uint8_t*& at) {
            for (std::size_t k = 0; k < padded; ++k)
              store_number(at, k < width ? to_short(value(v, k)) : std::uint16_t{0});
          }};
}

GlbAttribute positions(const Mesh& mesh, const GlbGrid& grid) {
  if (!grid.is_short) {
    return floats("POSITION", 3, [&mesh, &grid](std::size_t v, std::size_t k) {
      return static_cast<float>(grid.number(&mesh.positions[3 * v])[k]);
    });
  }
  return {"POSITION", kUint16Component, 3, false, 8, [&mesh, &grid](std::size_t v, std::uint8_t*& at) {
            for (const double number : grid.number(&mesh.positions[3 * v]))
              store_number(at, static_cast<std::uint16_t>(number));
            store_number(at, std::uint16_t{0});
          }};
}

GlbAttribute normals(const Mesh& mesh, const GlbGrid& grid, bool compress) {
  return floats("NORMAL", 3, [&mesh, &grid, compress](std::size_t v, std::size_t k) {
    const float* n = &mesh.normals[3 * v];
    const std::array<float, 3> up = to_y_up(n[0], n[1], n[2]);
    return compress ? round_significand(to_grid(up, grid)[k]) : up[k];
  });
}

GlbAttribute constant(std::string name, std::vector<float> value) {
  const std::size_t width = value.size();
  return floats(std::move(name), width, [value = std::move(value)](std::size_t, std::size_t k) { return value[k]; });
}

}  // namespace

std::array<double, 3> GlbGrid::number(const double* offsets) const {
  const std::array<double, 3> at = to_y_up(offsets[0], offsets[1], offsets[2]);
  if (is_plain()) return at;
  std::array<double, 3> numbers{};
  for (std::size_t k = 0; k < 3; ++k) {
    numbers[k] = (at[k] - shift[k]) / scale[k];
    if (scale[k] != 1) numbers[k] = std::nearbyint(numbers[k]);
  }
  return numbers;
}

GlbGrid find_grid(const Mesh& mesh, const std::array<double, 2>& cell) {
  GlbGrid grid;
  const double x = find_step(mesh, 0, std::abs(cell[0])), y = find_step(mesh, 1, std::abs(cell[1]));
  if (x == 0 || y == 0) return grid;
  std::array<Interval, 3> extents;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const double* p = &mesh.positions[3 * v];
    const std::array<double, 3> at = to_y_up(p[0], p[1], p[2]);
    for (std::size_t k = 0; k < 3; ++k) extents[k].add(at[k]);
  }
  const double z = find_height_step(mesh);
  const bool has_heights = extents[1].extent() / z <= kMostShort;
  grid.scale = {x, has_heights ? z : 1, y};
  grid.shift = {extents[0].low, has_heights ? extents[1].low : 0, extents[2].low};
  grid.is_short =
      has_heights && extents[0].extent() / x <= kMostShort + 0.5 && extents[2].extent() / y <= kMostShort + 0.5;
  return grid;
}

bool holds_positions(const GlbGrid& grid, const Mesh& mesh) {
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const double* p = &mesh.positions[3 * v];
    if (grid.is_plain()) {
      if (as_float32(p[0]) != p[0] || as_float32(p[1]) != p[1]) return false;
      continue;
    }
    const std::array<double, 3> number = grid.number(p);
    if (number[0] > kMostWhole || number[2] > kMostWhole) return false;
  }
  return true;
}

bool colors_say_channels(const Mesh& mesh) {
  const auto channels = static_cast<std::size_t>(mesh.channel_count);
  if (mesh.colors.empty() || (channels != 1 && channels != 3)) return false;
  for (std::size_t i = 0; i < mesh.colors.size(); ++i) {
    if (mesh.channels[channels == 3 ? i : i / 3] != static_cast<float>(mesh.colors[i])) return false;
  }
  return true;
}

std::vector<GlbAttribute> list_glb_attributes(const Mesh& mesh, const GlbGrid& grid, const GlbOptions& options) {
  std::vector<GlbAttribute> list;
  list.push_back(positions(mesh, grid));
  if (!options.normal_map.bytes.empty()) {
    list.push_back(constant("NORMAL", {0, 1, 0}));
    list.push_back(constant("TANGENT", {1, 0, 0, 1}));
  } else if (!mesh.normals.empty()) {
    list.push_back(normals(mesh, grid, options.compress));
  }
  if (!mesh.uvs.empty()) {
    const auto value = [&mesh](std::size_t v, std::size_t k) { return mesh.uvs[2 * v + k]; };
    const bool are_shares = std::all_of(mesh.uvs.begin(), mesh.uvs.end(), [](float uv) { return uv >= 0 && uv <= 1; });
    list.push_back(options.compress && are_shares ? shares("TEXCOORD_0", 2, value) : floats("TEXCOORD_0", 2, value));
  }
  if (!mesh.colors.empty()) {
    const auto value = [&mesh](std::size_t v, std::size_t k) { return kLinearOfSrgb[mesh.colors[3 * v + k]]; };
    list.push_back(options.compress ? shares("COLOR_0", 3, value) : floats("COLOR_0", 3, value));
  }
  const auto channels = static_cast<std::size_t>(mesh.channel_count);
  const std::size_t written = colors_say_channels(mesh) ? 0 : channels;
  for (std::size_t c = 0; c < written; ++c) {
    list.push_back(floats(fmt::format("_CHANNEL_{}", c + 1), 1, [&mesh, channels, c](std::size_t v, std::size_t) {
      const float value = mesh.channels[channels * v + c];
      return std::isfinite(value) ? value : kNoChannelValue;
    }));
  }
  return list;
}

}  // namespace scarp::io
