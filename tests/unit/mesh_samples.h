// Small meshes for tests.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "scarp/mesh.h"

namespace scarp::test {

/// Two triangles for each grid cell (i, j) that `has_cell` accepts, over (cols + 1)·(rows + 1) vertices with bumpy
/// heights above 1. Offsets are float32 values. Vertices without a triangle are omitted.
inline Mesh grid_mesh(int cols, int rows, const std::function<bool(int, int)>& has_cell, bool normals = false) {
  Mesh mesh;
  std::vector<std::uint32_t> ids(static_cast<std::size_t>((cols + 1) * (rows + 1)), 0xFFFFFFFF);
  const auto id = [&](int i, int j) {
    std::uint32_t& known = ids[static_cast<std::size_t>(j * (cols + 1) + i)];
    if (known == 0xFFFFFFFF) {
      known = static_cast<std::uint32_t>(mesh.vertex_count());
      const float z = 2.0f + static_cast<float>(std::sin(0.7 * i) * std::cos(0.3 * j * i));
      mesh.positions.insert(mesh.positions.end(), {static_cast<double>(30.25f * static_cast<float>(i)),
                                                   static_cast<double>(-29.875f * static_cast<float>(j)), double{z}});
      if (normals) {
        const float x = 0.1f * static_cast<float>((i * 7 + j) % 5);
        mesh.normals.insert(mesh.normals.end(), {x, 0.0f, std::sqrt(1.0f - x * x)});
      }
    }
    return known;
  };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < cols; ++i) {
      if (!has_cell(i, j)) continue;
      const std::uint32_t a = id(i, j + 1), b = id(i + 1, j + 1), c = id(i + 1, j), d = id(i, j);
      if ((i + j) % 3 == 0) {
        mesh.triangles.insert(mesh.triangles.end(), {a, b, c, a, c, d});
      } else {
        mesh.triangles.insert(mesh.triangles.end(), {a, b, d, b, c, d});
      }
    }
  }
  return mesh;
}

inline Mesh sample_mesh(bool normals = false) {
  Mesh mesh = grid_mesh(
      4, 3, [](int, int) { return true; }, normals);
  mesh.origin = {512345.625, 4023456.0625, 0};
  mesh.metadata = {{"generator", "Scarp 0.2.0"},
                   {"command", "scarp simplify \"a b.tif\" c.glb -e 5%\\\nsecond line: \ttabbed"},
                   {"crs", "EPSG:32611"},
                   {"a:key", ": value "},
                   {"number", "1.50"},
                   {"report", R"({"vertices":20,"max_error":4.9375,"at":[3,4],"note":"x: y"})"},
                   {"empty", ""}};
  return mesh;
}

/// Gives each vertex uvs, a colour and `channels` further values, all different from its neighbour's.
inline void add_attributes(Mesh& mesh, int channels) {
  mesh.channel_count = channels;
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    const auto n = static_cast<float>(mesh.vertex_count());
    mesh.uvs.insert(mesh.uvs.end(), {static_cast<float>(v) / n, 1 - static_cast<float>(v * 7 % 11) / 64});
    for (std::uint32_t k = 0; k < 3; ++k) mesh.colors.push_back(static_cast<std::uint8_t>(v * 37 + k * 101));
    for (int c = 0; c < channels; ++c)
      mesh.channels.push_back(static_cast<float>(v) / 3 - static_cast<float>(c) * 1e5f);
  }
}

/// True if vertices and triangles are bit-identical, as absolute positions and as offsets.
inline bool same_geometry(const Mesh& a, const Mesh& b) {
  if (a.triangles != b.triangles || a.vertex_count() != b.vertex_count()) return false;
  for (std::size_t v = 0; v < a.vertex_count(); ++v) {
    if (a.vertex(v) != b.vertex(v)) return false;
  }
  return a.origin == b.origin && a.positions == b.positions && a.normals == b.normals;
}

inline std::vector<std::uint8_t> to_bytes(const std::string& text) { return {text.begin(), text.end()}; }

}  // namespace scarp::test
