// The contents of a mesh handle and its layout for JavaScript.
#pragma once

#include "door.h"
#include "scarp/measure.h"
#include "scarp/mesh.h"

namespace scarp::wasm {

/// The measured error of a mesh. Errors are vertical, mesh minus sample, in z units.
struct Report {
  double stop = -1;    ///< goal reached: 0 max_error, 1 max_triangles, 2 max_vertices, 3 every sample is exact
  double effort = -1;  ///< 0 fast, 1 normal, 2 high, 3 max; -1 for a measured mesh
  double vertices = 0, triangles = 0;
  double samples = 0, uncovered = 0, stray = 0;
  double max_error = 0, max_error_col = -1, max_error_row = -1;
  double rmse = 0, mean_error = 0, mean_abs_error = 0, p50 = 0, p95 = 0, p99 = 0;
  double is_sound = -1;  ///< -1: not checked
};
Report describe(const Measurement& measured);

struct WholeMesh {
  Mesh mesh;
  Report report;
  double cell[2] = {0, 0};  ///< sides of a raster cell along x and y, with sign; 0: unknown
};

/// A mesh with its largest error, without the rest of a report.
std::unique_ptr<WholeMesh> whole_of(Mesh mesh, double max_error);

struct MeshView {
  double vertices, triangles;
  double positions, corners, normals, uvs;  ///< addresses; 0: none
  double origin[3];
  double cell[2];
  Report report;
};

}  // namespace scarp::wasm
