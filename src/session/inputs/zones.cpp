#include "session/inputs/zones.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "scarp/lines.h"
#include "session/inputs/lines.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

void drop_heights(Line& line) {
  for (auto& point : line.points) point[2] = std::numeric_limits<double>::quiet_NaN();
}

/// The polygons of a file. Without an attribute, features are numbered in their order, after kElsewhere.
Result<std::vector<run::Zone>> make_zones(const std::vector<Line>& lines, const Given& field) {
  std::vector<run::Zone> zones;
  std::map<std::uint32_t, std::size_t> zone_of;  // by polygon
  std::map<std::string, std::uint32_t> numbers;  // by feature
  for (const Line& line : lines) {
    const auto [place, is_new] = zone_of.try_emplace(line.polygon, zones.size());
    if (is_new) {
      const double value = line.points.front()[2];
      if (field && !(value >= 0 && value <= std::numeric_limits<std::int32_t>::max() && value == std::floor(value)))
        return fail(ErrorKind::kInput,
                    fmt::format("{} has {} as its material: {} must be a whole number from 0 to 2147483647", line.name,
                                std::isnan(value) ? "nothing" : format_number(value), *field));
      const auto next = static_cast<std::uint32_t>(kElsewhere + 1 + numbers.size());
      const std::uint32_t number = numbers.try_emplace(line.name, next).first->second;
      zones.push_back({{}, field ? static_cast<std::uint32_t>(value) : number});
    }
    zones[place->second].rings.push_back(line);
  }
  return zones;
}

/// The map from coordinates by `first` to those by `second`: first⁻¹, then second.
std::array<double, 6> between(const std::array<double, 6>& first, const std::array<double, 6>& second) {
  const auto& a = first;
  const double determinant = a[1] * a[5] - a[2] * a[4];
  const double col_x = a[5] / determinant, col_y = -a[2] / determinant, row_x = -a[4] / determinant,
               row_y = a[1] / determinant;
  std::array<double, 6> both{};
  for (const std::size_t k : {std::size_t{0}, std::size_t{3}}) {
    both[k + 1] = second[k + 1] * col_x + second[k + 2] * row_x;
    both[k + 2] = second[k + 1] * col_y + second[k + 2] * row_y;
    both[k] = second[k] - both[k + 1] * a[0] - both[k + 2] * a[3];
  }
  return both;
}

}  // namespace

Result<ZonePlan> read_zones(const GivenOptions& given, const RasterInfo& raster, int rows,
                            const ProgressCallback& progress, LineConstraints& breaklines,
                            std::vector<std::string>& warnings) {
  ZonePlan plan;
  plan.affine = map_affine(raster, rows);
  ReadLinesOptions options;
  options.crs = raster.crs;
  options.progress = progress;
  if (given.has(OptionId::kMaterials)) {
    options.z_field = given[OptionId::kMaterialField].value_or("");
    options.ignore_z = !given.has(OptionId::kMaterialField);
    SCARP_TRY(auto lines, read_files({*given[OptionId::kMaterials]}, options, warnings));
    const std::string user =
        fmt::format("{} ", OptionId::kMaterials) + shell_word(base_name(*given[OptionId::kMaterials]));
    SCARP_RETURN_IF_ERROR(check_polygons(lines, user));
    SCARP_TRY(plan.zones, make_zones(lines, given[OptionId::kMaterialField]));
    for (Line& line : lines) {
      drop_heights(line);
      breaklines.lines.push_back(std::move(line));
    }
  }
  options.z_field.clear();
  options.ignore_z = true;
  SCARP_TRY(auto lines, read_files(given.all(OptionId::kNodeStrings), options, warnings));
  breaklines.lines.insert(breaklines.lines.end(), lines.begin(), lines.end());
  plan.strings = std::move(lines);
  return plan;
}

MeshZones find_zones(const ZonePlan& plan, const Frame& frame, const Mesh& mesh) {
  const std::array<double, 6> to_map = between(frame.affine, plan.affine);
  // Lines lie on a lattice of 256ths of a sample and move by up to 1.5 lattice steps where they cross.
  const auto& a = plan.affine;
  const double reach = 0.01 * std::max(std::hypot(a[1], a[4]), std::hypot(a[2], a[5]));
  MeshZones zones;
  if (!plan.zones.empty()) zones.materials = run::find_materials(mesh, plan.zones, to_map, kElsewhere);
  zones.node_strings = run::find_node_strings(mesh, plan.strings, to_map, reach);
  return zones;
}

}  // namespace scarp::cli
