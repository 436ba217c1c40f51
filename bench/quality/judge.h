// How the programs of bench/quality come to fields, and what they hold against meshes.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <numbers>
#include <string>

#include "files.h"
#include "scarp/scarp.h"

namespace bench {

inline constexpr int kGeneratedSide = 768;

/// CPU time of this process, all its threads: other programs on the machine count less.
inline double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// A raster of find_raster(), or a style of `scarp generate`.
inline scarp::Result<scarp::OwnedHeightField> read_field(const std::filesystem::path& project,
                                                         const std::string& name) {
  if (const auto style = scarp::find_field_style(name))
    return scarp::generate_field(*style, kGeneratedSide, kGeneratedSide);
  const auto path = find_raster(project, name);
  if (!path) return tl::unexpected(scarp::Error{scarp::ErrorKind::kInput, name + " is not there"});
  return scarp::read_height_field(*path);
}

/// The fault of a mesh that promised max_error; nothing if nothing is.
inline std::string find_fault(const scarp::Measurement& judged, double max_error) {
  // Planes through vertices between samples are no numbers of double.
  constexpr double kRounding = 1 + 1e-12;
  if (judged.max_error > kRounding * max_error) return fmt::format("its max error is {:.9g}", judged.max_error);
  if (judged.uncovered > 0) return fmt::format("{} samples are uncovered", judged.uncovered);
  return judged.is_sound() ? "" : "it folds, gapes or degenerates";
}

/// A mesh as measure() judges it, and what it cost.
struct Made {
  scarp::Measurement judged;
  double seconds = 0;
  double thin_percent = 0;  ///< share of its triangles whose smallest angle, seen from above, is below 5 degrees
};

inline double smallest_angle(const scarp::Mesh& mesh, std::size_t triangle) {
  std::array<std::array<double, 2>, 3> at{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto point = mesh.vertex(mesh.triangles[3 * triangle + k]);
    at[k] = {point[0], point[1]};
  }
  double least = 180;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto &p = at[k], &q = at[(k + 1) % 3], &r = at[(k + 2) % 3];
    const double ax = q[0] - p[0], ay = q[1] - p[1], bx = r[0] - p[0], by = r[1] - p[1];
    least = std::min(least, std::atan2(std::abs(ax * by - ay * bx), ax * bx + ay * by) * 180 / std::numbers::pi);
  }
  return least;
}

inline double thin_percent(const scarp::Mesh& mesh) {
  std::size_t thin = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) thin += smallest_angle(mesh, t) < 5 ? 1 : 0;
  return 100.0 * static_cast<double>(thin) / static_cast<double>(std::max<std::size_t>(1, mesh.triangle_count()));
}

inline scarp::Result<Made> make(const scarp::OwnedHeightField& field, const scarp::SimplifyOptions& options) {
  const double start = cpu_seconds();
  const auto simplified = scarp::simplify(field, options);
  Made made;
  made.seconds = cpu_seconds() - start;
  if (!simplified) return tl::unexpected(simplified.error());
  auto judged = scarp::measure(field, simplified->mesh);
  if (!judged) return tl::unexpected(judged.error());
  made.judged = *std::move(judged);
  made.thin_percent = thin_percent(simplified->mesh);
  return made;
}

}  // namespace bench
