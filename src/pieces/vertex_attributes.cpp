#include "pieces/vertex_attributes.h"

#include <cstddef>

#include "pieces/normals.h"

namespace scarp::pieces {

namespace {

/// Pixel centres, 2 values per point; (0, 0) is the image's top left corner and (1, 1) its bottom right corner.
std::vector<float> sample_uvs(std::int32_t cols, std::int32_t rows, const LatticePoints& at) {
  std::vector<float> uvs;
  uvs.reserve(2 * at.points.size());
  const double steps = at.steps;
  for (Point p : at.points) {
    uvs.push_back(static_cast<float>((p.x / steps + 0.5) / cols));
    uvs.push_back(static_cast<float>((p.y / steps + 0.5) / rows));
  }
  return uvs;
}

}  // namespace

bool has_attributes(const HeightField& field, const metric::Request& options) {
  return options.output.normals || options.output.uvs || !field.channels.empty();
}

void add_attributes(const HeightField& field, const metric::Request& options, const LatticePoints& at, Mesh& mesh) {
  if (options.output.normals) mesh.normals = sample_normals(field, at, options.domain.border);
  if (options.output.uvs) mesh.uvs = sample_uvs(field.cols, field.rows, at);
  mesh.channel_count = static_cast<int>(field.channels.size());
  for (Point p : field.channels.empty() ? std::vector<Point>() : at.points) {
    for (const Channel& channel : field.channels)
      mesh.channels.push_back(channel.samples[static_cast<std::size_t>(p.y) * static_cast<std::size_t>(field.cols) +
                                              static_cast<std::size_t>(p.x)]);
  }
}

}  // namespace scarp::pieces
