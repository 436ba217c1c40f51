// quantized-mesh 1.0: https://github.com/CesiumGS/quantized-mesh
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "globe/ground.h"
#include "globe/tile_positions.h"
#include "scarp/tile.h"

namespace scarp {
namespace {

constexpr std::size_t kWideIndices = 65536;  ///< vertices above which indices have 32 bits
constexpr std::uint8_t kNormals = 1, kWaterMask = 2;
/// The finest step of heights, still visible after decoding to float32.
constexpr double kLeastStep = 0x1p-10;

class Writer {
 public:
  template <class T>
  void add(T value) {
    static_assert(std::is_arithmetic_v<T> && std::endian::native == std::endian::little);
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof value);
    std::memcpy(bytes_.data() + at, &value, sizeof value);
  }
  template <class T, std::size_t N>
  void add_all(const std::array<T, N>& values) {
    for (const T value : values) add(value);
  }
  void pad_to(std::size_t multiple) {
    while (bytes_.size() % multiple != 0) bytes_.push_back(0);
  }
  std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  std::vector<std::uint8_t> bytes_;
};

/// Writes differences, with the sign in the lowest bit.
void add_deltas(Writer& writer, const std::vector<std::uint16_t>& values) {
  std::int32_t before = 0;
  for (const std::uint16_t value : values) {
    const std::int32_t delta = value - before;
    writer.add(static_cast<std::uint16_t>((delta << 1) ^ (delta >> 31)));
    before = value;
  }
}

/// Heights as steps between the header's two heights.
struct HeightSteps {
  float low = 0, high = 0;
  std::vector<std::uint16_t> h;
};

/// The header's heights are 32767 steps apart, with spare steps below the lowest vertex. A step is the level's quantum
/// divided by a power of two, so that every possible height of a neighbour's edge is a multiple of it.
HeightSteps choose_steps(const TerrainTile& tile) {
  const auto [bottom, top] = std::minmax_element(tile.heights.begin(), tile.heights.end());
  HeightSteps steps;
  const std::int64_t least = *bottom, most = *top;
  if (least == most) {
    steps.low = steps.high = static_cast<float>(tile.quantum * static_cast<double>(most));
    steps.h.assign(tile.heights.size(), 0);
    return steps;
  }
  int shift = 0;
  const auto fits = [&](int more) {
    const std::int64_t relief = (most - least) << more, size = std::max(std::abs(least), std::abs(most)) << more;
    return relief <= 32767 && size + 32767 < (1 << 24) && std::ldexp(tile.quantum, -more) >= kLeastStep;
  };
  while (fits(shift + 1)) ++shift;
  const double step = std::ldexp(tile.quantum, -shift);
  const std::int64_t high = most << shift, low = high - 32767;
  steps.low = static_cast<float>(step * static_cast<double>(low));
  steps.high = static_cast<float>(step * static_cast<double>(high));
  for (const std::int32_t height : tile.heights)
    steps.h.push_back(static_cast<std::uint16_t>((std::int64_t{height} << shift) - low));
  return steps;
}

template <class Index>
void add_indices(Writer& writer, const TerrainTile& tile) {
  // High-water marks: 0 is the first unused index.
  std::uint32_t highest = 0;
  writer.add(static_cast<std::uint32_t>(tile.triangles.size() / 3));
  for (const std::uint32_t index : tile.triangles) {
    writer.add(static_cast<Index>(highest - index));
    if (index == highest) ++highest;
  }
  const auto add_edge = [&](const std::vector<std::uint16_t>& across, std::uint16_t edge,
                            const std::vector<std::uint16_t>& along) {
    std::vector<std::uint32_t> vertices;
    for (std::uint32_t v = 0; v < across.size(); ++v) {
      if (across[v] == edge) vertices.push_back(v);
    }
    std::sort(vertices.begin(), vertices.end(), [&](std::uint32_t a, std::uint32_t b) { return along[a] < along[b]; });
    writer.add(static_cast<std::uint32_t>(vertices.size()));
    for (const std::uint32_t v : vertices) writer.add(static_cast<Index>(v));
  };
  add_edge(tile.u, 0, tile.v);
  add_edge(tile.v, 0, tile.u);
  add_edge(tile.u, 32767, tile.v);
  add_edge(tile.v, 32767, tile.u);
}

void add_extension(Writer& writer, std::uint8_t id, std::size_t length) {
  writer.add(id);
  writer.add(static_cast<std::uint32_t>(length));
}

/// Reads hostile files; never reads beyond the end.
class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  std::size_t left() const { return bytes_.size() - at_; }
  bool failed() const { return failed_; }
  template <class T>
  T take() {
    T value{};
    if (left() < sizeof value) {
      failed_ = true;
      at_ = bytes_.size();
      return value;
    }
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  /// Reads a count of items of `size` bytes each; 0 and failed() if these do not fit.
  std::size_t take_count(std::size_t size) {
    const std::size_t count = take<std::uint32_t>();
    if (count <= left() / size) return count;
    failed_ = true;
    return 0;
  }
  std::span<const std::uint8_t> take_bytes(std::size_t count) {
    if (count > left()) {
      failed_ = true;
      return {};
    }
    at_ += count;
    return bytes_.subspan(at_ - count, count);
  }
  void skip_to(std::size_t multiple) { at_ = std::min(bytes_.size(), (at_ + multiple - 1) / multiple * multiple); }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  bool failed_ = false;
};

std::vector<std::uint16_t> take_deltas(Reader& reader, std::size_t count) {
  std::vector<std::uint16_t> values;
  std::uint16_t value = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const auto code = reader.take<std::uint16_t>();
    value = static_cast<std::uint16_t>(value + ((code >> 1) ^ (0 - (code & 1))));
    values.push_back(value);
  }
  return values;
}

template <class Index>
bool take_indices(Reader& reader, QuantizedMesh& mesh) {
  const std::size_t vertices = mesh.u.size();
  const std::size_t triangles = reader.take_count(3 * sizeof(Index));
  std::uint32_t highest = 0;
  for (std::size_t k = 0; k < 3 * triangles; ++k) {
    const std::uint32_t code = reader.take<Index>();
    if (code > highest) return false;
    mesh.triangles.push_back(highest - code);
    if (mesh.triangles.back() >= vertices) return false;
    if (code == 0) ++highest;
  }
  for (std::vector<std::uint32_t>* edge : {&mesh.west, &mesh.south, &mesh.east, &mesh.north}) {
    const std::size_t count = reader.take_count(sizeof(Index));
    for (std::size_t k = 0; k < count; ++k) {
      edge->push_back(reader.take<Index>());
      if (edge->back() >= vertices) return false;
    }
  }
  return true;
}

}  // namespace

std::vector<std::uint8_t> encode_quantized_mesh(const TerrainTile& tile, const Geodetic& ellipsoid,
                                                const TileGrid& grid, std::span<const std::uint8_t> water_mask) {
  const globe::Ground ground(grid, ellipsoid);
  const std::vector<globe::Space> positions = globe::positions_in_space(tile, grid, ground);
  const globe::Globe::Sphere sphere = globe::Globe::sphere_around(positions);
  const HeightSteps steps = choose_steps(tile);
  Writer writer;
  writer.add_all(sphere.centre);
  writer.add(steps.low);
  writer.add(steps.high);
  writer.add_all(sphere.centre);
  writer.add(sphere.radius);
  writer.add_all(ground.horizon_point(sphere.centre, positions));
  writer.add(static_cast<std::uint32_t>(tile.u.size()));
  for (const std::vector<std::uint16_t>* values : {&tile.u, &tile.v, &steps.h}) add_deltas(writer, *values);
  const bool is_wide = tile.u.size() > kWideIndices;
  writer.pad_to(is_wide ? 4 : 2);
  if (is_wide) {
    add_indices<std::uint32_t>(writer, tile);
  } else {
    add_indices<std::uint16_t>(writer, tile);
  }
  if (!tile.normals.empty()) {
    add_extension(writer, kNormals, 2 * tile.normals.size());
    for (const auto& normal : tile.normals) writer.add_all(normal);
  }
  if (!water_mask.empty()) {
    add_extension(writer, kWaterMask, water_mask.size());
    for (const std::uint8_t texel : water_mask) writer.add(texel);
  }
  return writer.take();
}

Result<QuantizedMesh> decode_quantized_mesh(std::span<const std::uint8_t> bytes, const std::string& name_for_errors) {
  Reader reader(bytes);
  QuantizedMesh mesh;
  for (double& value : mesh.center) value = reader.take<double>();
  mesh.min_height = reader.take<float>();
  mesh.max_height = reader.take<float>();
  for (double& value : mesh.sphere) value = reader.take<double>();
  for (double& value : mesh.horizon_point) value = reader.take<double>();
  const std::size_t vertices = reader.take_count(6);
  for (std::vector<std::uint16_t>* values : {&mesh.u, &mesh.v, &mesh.h}) *values = take_deltas(reader, vertices);
  const bool is_wide = vertices > kWideIndices;
  reader.skip_to(is_wide ? 4 : 2);
  const bool are_indices =
      is_wide ? take_indices<std::uint32_t>(reader, mesh) : take_indices<std::uint16_t>(reader, mesh);
  while (are_indices && !reader.failed() && reader.left() > 0) {
    const auto id = reader.take<std::uint8_t>();
    const std::size_t length = reader.take_count(1);
    const std::span<const std::uint8_t> content = reader.take_bytes(length);
    if (id == kNormals && length == 2 * vertices) {
      for (std::size_t v = 0; v < vertices; ++v) mesh.normals.push_back({content[2 * v], content[2 * v + 1]});
    } else if (id == kNormals) {
      return fail(ErrorKind::kInput,
                  fmt::format("{} has {} bytes of normals for {} vertices", name_for_errors, length, vertices));
    } else if (id == kWaterMask) {
      mesh.water_mask.assign(content.begin(), content.end());
    }
  }
  if (reader.failed() || vertices == 0)
    return fail(ErrorKind::kInput, fmt::format("{} is no quantized-mesh tile, or ends too early", name_for_errors));
  if (!are_indices)
    return fail(ErrorKind::kInput,
                fmt::format("{} has a triangle or an edge of a vertex that is not there", name_for_errors));
  const auto is_beyond = [](std::uint16_t value) { return value > 32767; };
  for (const std::vector<std::uint16_t>* values : {&mesh.u, &mesh.v, &mesh.h}) {
    if (std::any_of(values->begin(), values->end(), is_beyond))
      return fail(ErrorKind::kInput, fmt::format("{} has a vertex beyond 32767", name_for_errors));
  }
  return mesh;
}

}  // namespace scarp
