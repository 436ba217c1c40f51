#include "live/whole_mesh.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace scarp::live {

namespace {

/// Ids of the vertices on borders of cells, by sample.
class BorderVertices {
 public:
  explicit BorderVertices(std::int32_t side) : side_(side) {}

  /// The vertex at a place on a border, if there is one; else `id`, which is stored for that place.
  std::uint32_t find(double col, double row, std::uint32_t id) {
    if (std::fmod(col, side_) != 0 && std::fmod(row, side_) != 0) return id;
    const auto key = std::uint64_t{static_cast<std::uint32_t>(static_cast<std::int32_t>(col))} << 32 |
                     static_cast<std::uint32_t>(static_cast<std::int32_t>(row));
    return ids_.try_emplace(key, id).first->second;
  }

 private:
  std::int32_t side_;
  std::unordered_map<std::uint64_t, std::uint32_t> ids_;
};

}  // namespace

Mesh join_cells(std::span<const std::shared_ptr<const LiveCell>> cells, std::int32_t side, int channels,
                const Area& field, const Frame& frame) {
  Mesh mesh;
  mesh.channel_count = channels;
  const auto [x, y] = frame_origin(frame, field.cols(), field.rows());
  mesh.origin = {x, y, 0};
  const bool is_mirrored = frame.determinant() > 0;
  BorderVertices borders(side);
  std::vector<std::uint32_t> ids;
  for (const auto& cell : cells) {
    ids.clear();
    for (std::size_t v = 0; v < cell->vertex_count(); ++v) {
      const double col = cell->place.col + double{cell->positions[3 * v]};
      const double row = cell->place.row - double{cell->positions[3 * v + 1]};
      const auto next = static_cast<std::uint32_t>(mesh.vertex_count());
      ids.push_back(borders.find(col, row, next));
      if (ids.back() != next) continue;
      const auto [east, north] = frame.apply_affine(col - field.west, row - field.north);
      mesh.positions.insert(mesh.positions.end(), {east - x, north - y, double{cell->positions[3 * v + 2]}});
      const auto values = cell->channels.begin() + static_cast<std::ptrdiff_t>(v) * channels;
      mesh.channels.insert(mesh.channels.end(), values, values + channels);
    }
    for (std::size_t k = 0; k < cell->triangles.size(); k += 3) {
      std::array<std::uint32_t, 3> corners{};
      for (std::size_t c = 0; c < 3; ++c) corners[c] = ids[cell->triangles[k + c]];
      if (is_mirrored) std::swap(corners[1], corners[2]);
      mesh.triangles.insert(mesh.triangles.end(), corners.begin(), corners.end());
    }
  }
  return mesh;
}

}  // namespace scarp::live
