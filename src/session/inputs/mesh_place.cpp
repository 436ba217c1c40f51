#include "session/inputs/mesh_place.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "scarp/io.h"

namespace scarp::cli {
namespace {

using enum OptionId;

/// In cells: two frames closer than this are one frame, rounded differently.
constexpr double kSamePlace = 1e-3;

/// The largest distance of any corner of the raster in the two frames, in cells.
double distance_in_cells(const std::array<double, 6>& a, const std::array<double, 6>& b, int cols, int rows) {
  const double cell = std::sqrt(std::abs(a[1] * a[5] - a[2] * a[4]));
  double farthest = 0;
  for (const double col : {0.0, cols - 1.0}) {
    for (const double row : {0.0, rows - 1.0}) {
      for (const std::size_t k : {std::size_t{0}, std::size_t{3}}) {
        const double apart = a[k] - b[k] + (a[k + 1] - b[k + 1]) * col + (a[k + 2] - b[k + 2]) * row;
        farthest = std::max(farthest, std::abs(apart) / cell);
      }
    }
  }
  return farthest;
}

}  // namespace

std::optional<std::array<double, 6>> read_to_source(const Mesh& mesh) {
  const auto entry = mesh.metadata.find("to_source");
  if (entry == mesh.metadata.end()) return std::nullopt;
  const auto json = nlohmann::json::parse(entry->second, nullptr, false);
  if (!json.is_array() || json.size() != 6) return std::nullopt;
  std::array<double, 6> numbers{};
  for (std::size_t k = 0; k < 6; ++k) {
    if (!json[k].is_number()) return std::nullopt;
    numbers[k] = json[k].get<double>();
  }
  const double determinant = numbers[1] * numbers[5] - numbers[2] * numbers[4];
  if (!std::isfinite(determinant) || determinant == 0) return std::nullopt;
  return numbers;
}

std::array<double, 6> way_between(const std::array<double, 6>& from, const std::array<double, 6>& to) {
  const double determinant = to[1] * to[5] - to[2] * to[4];
  std::array<double, 6> way{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = from[k] - (k == 0 ? to[0] : 0), y = from[k + 3] - (k == 0 ? to[3] : 0);
    way[k] = (to[5] * x - to[2] * y) / determinant;
    way[k + 3] = (to[1] * y - to[4] * x) / determinant;
  }
  return way;
}

void Extent::add(double x, double y) {
  if (!std::isfinite(x) || !std::isfinite(y)) return;
  low = {std::min(low[0], x), std::min(low[1], y)};
  high = {std::max(high[0], x), std::max(high[1], y)};
}

double Extent::overlap(const Extent& other) const {
  double common = 1, one = 1, two = 1;
  for (std::size_t k = 0; k < 2; ++k) {
    common *= std::max(0.0, std::min(high[k], other.high[k]) - std::max(low[k], other.low[k]));
    one *= high[k] - low[k];
    two *= other.high[k] - other.low[k];
  }
  return common > 0 ? common / (one + two - common) : 0;
}

std::string Extent::text() const {
  return fmt::format("x {:.10g} to {:.10g} and y {:.10g} to {:.10g}", low[0], high[0], low[1], high[1]);
}

Extent extent_of(const Mesh& mesh) {
  Extent extent;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const auto at = mesh.vertex(v);
    extent.add(at[0], at[1]);
  }
  return extent;
}

Extent extent_of(const HeightField& field) {
  constexpr int kSteps = 16;  // points along a side, which is bent in other CRSs
  std::vector<double> x, y;
  for (int k = 0; k <= kSteps; ++k) {
    const double col = (field.cols - 1.0) * k / kSteps, row = (field.rows - 1.0) * k / kSteps;
    for (const auto& [c, r] : {std::pair{col, 0.0}, {col, field.rows - 1.0}, {0.0, row}, {field.cols - 1.0, row}}) {
      const auto at = field.frame.apply_affine(c, r);
      x.push_back(at[0]);
      y.push_back(at[1]);
    }
  }
  if (field.frame.transform) field.frame.transform->apply(x, y);
  std::vector<double> z(x.size());
  if (field.frame.space) field.frame.space->to_space(x, y, z);
  Extent extent;
  for (std::size_t k = 0; k < x.size(); ++k) extent.add(x[k], y[k]);
  return extent;
}

Extent extent_of(const PointSet& points) {
  Extent extent;
  for (std::size_t k = 0; k < points.size(); ++k) extent.add(points.x[k], points.y[k]);
  return extent;
}

GivenOptions remember_options(const GivenOptions& given, const Mesh& mesh) {
  GivenOptions asked = given;
  constexpr std::pair<const char*, OptionId> kKeys[] = {
      {"crs_option", kCrs}, {"z_scale", kZScale}, {"z_offset", kZOffset}, {"unit", kZUnit}, {"cell_size", kCellSize}};
  for (const auto& [key, option] : kKeys) {
    if (option == kZScale && given.has(kZUnit)) continue;  // it may contain the conversion of that unit to metres
    const auto entry = mesh.metadata.find(key);
    if (!given.has(option) && entry != mesh.metadata.end()) asked.set(option, Given(entry->second));
  }
  return asked;
}

void turn_up(bool is_y_up, const std::string& path, Mesh& mesh) {
  // A file that declares its up axis was turned accordingly.
  if (!is_y_up || mesh.metadata.contains("up") || find_mesh_format(path) == MeshFormat::kGlb) return;
  mesh.metadata["up"] = "y";
  undo_y_up(mesh);
}

bool fit_frame(const Mesh& mesh, OwnedHeightField& field) {
  if (field.frame.kind != Frame::Kind::kLocal) return false;
  HeightField source = field.view();
  source.frame.kind = field.info.has_georeference ? Frame::Kind::kSource : Frame::Kind::kGrid;
  source.frame.affine = map_affine(field.info, field.rows);
  source.frame.crs = field.info.crs;
  source.frame.unit_in_metres = field.info.crs_unit_in_metres;
  source.frame.description = "the raster's own coordinates, where the mesh lies";
  const Extent of_mesh = extent_of(mesh);
  if (of_mesh.overlap(extent_of(source)) <= of_mesh.overlap(extent_of(field.view()))) return false;
  field.frame = source.frame;
  return !field.info.file_unit.empty();
}

std::vector<std::string> place_frame(const Mesh& mesh, OwnedHeightField& field) {
  const auto to_source = read_to_source(mesh);
  if (!to_source || !field.info.has_georeference || !field.frame.is_affine()) return {};
  const std::array<double, 6> affine = way_between(map_affine(field.info, field.rows), *to_source);
  if (distance_in_cells(field.frame.affine, affine, field.cols, field.rows) > kSamePlace) {
    field.frame.affine = affine;
    if (const auto words = mesh.metadata.find("frame"); words != mesh.metadata.end())
      field.frame.description = words->second;
  }
  const auto crs = mesh.metadata.find("origin_crs");
  const auto is_code = [](const std::string& of) { return of.rfind("EPSG:", 0) == 0; };
  if (crs == mesh.metadata.end() || crs->second == field.info.crs) return {};
  if (!is_code(crs->second) || !is_code(field.info.crs)) return {};
  return {fmt::format("the mesh says that it was made from a raster in {}, and this one is in {}", crs->second,
                      field.info.crs)};
}

std::string describe_elsewhere(const Extent& mesh, const Extent& reference, const std::string& what) {
  return fmt::format(
      "it covers no sample of {}: its vertices lie at {}, the samples at {}; give the CRS it was made in "
      "({}), or its own raster",
      what, mesh.text(), reference.text(), kCrs);
}

}  // namespace scarp::cli
