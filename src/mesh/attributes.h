// Attributes of a vertex other than position and normal.
#pragma once

#include <cstddef>

#include "scarp/mesh.h"

namespace scarp::mesh {

/// Calls visit(array, numbers per vertex) for uvs, colors and channels, if present.
template <class AnyMesh, class Visit>
void for_each_attribute(AnyMesh& mesh, Visit visit) {
  if (!mesh.uvs.empty()) visit(mesh.uvs, std::size_t{2});
  if (!mesh.colors.empty()) visit(mesh.colors, std::size_t{3});
  if (!mesh.channels.empty()) visit(mesh.channels, static_cast<std::size_t>(mesh.channel_count));
}

/// Copies the attributes of `vertex` to a vertex just appended to the positions.
inline void append_attributes_of(Mesh& mesh, std::size_t vertex) {
  for_each_attribute(mesh, [&](auto& values, std::size_t width) {
    for (std::size_t k = 0; k < width; ++k) values.push_back(values[width * vertex + k]);
  });
}

}  // namespace scarp::mesh
