#include "session/inputs/surface.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "io/raster/crs_description.h"
#include "io/raster/height_unit.h"
#include "scarp/io.h"
#include "session/inputs/mesh_place.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

using enum OptionId;
using Affine = std::array<double, 6>;

constexpr Affine kSame{0, 1, 0, 0, 0, 1};
constexpr const char* kNoCrs = "the coordinates of a source without a CRS";

std::string metadata_of(const Mesh& mesh, const char* key) {
  const auto entry = mesh.metadata.find(key);
  return entry == mesh.metadata.end() ? "" : entry->second;
}

/// The coordinates in which the mesh has a place, and the map to them.
struct PlaceOfMesh {
  std::string in;  ///< a CRS, or the words of a frame; empty if the file holds none
  Affine way = kSame;
};

PlaceOfMesh place_of(const Mesh& mesh) {
  if (const auto way = read_to_source(mesh)) {
    const std::string crs = metadata_of(mesh, "origin_crs");
    return {crs.empty() ? kNoCrs : crs, *way};
  }
  const std::string crs = metadata_of(mesh, "crs");
  const std::string frame = metadata_of(mesh, "frame");
  if (crs.empty() && (metadata_of(mesh, "crs_option") == "source" || frame.ends_with("own coordinates (no CRS)")))
    return {kNoCrs};
  return {crs.empty() ? frame : crs};
}

/// A CRS by its name.
std::string words_of(const std::string& place) {
  const auto crs = place.find('[') != std::string::npos ? io::describe_crs(place) : std::nullopt;
  return crs ? crs->name : place;
}

/// The CRS of x and y themselves; empty for local coordinates, and if it is unknown.
std::string crs_of(const Mesh& mesh) {
  const std::string crs = metadata_of(mesh, "crs");
  const PlaceOfMesh place = place_of(mesh);
  const bool is_turned = place.way[1] != 1 || place.way[2] != 0 || place.way[4] != 0 || place.way[5] != 1;
  return crs.empty() && !is_turned ? metadata_of(mesh, "origin_crs") : crs;
}

/// Metres of one unit of x and y; 0 if unknown.
double metres_of(const Mesh& mesh) {
  const std::string option = metadata_of(mesh, "crs_option");
  if (option == "grid") return 0;
  const bool has_crs = !metadata_of(mesh, "origin_crs").empty();
  if (option == "local") return has_crs || metadata_of(mesh, "frame").starts_with("local metres") ? 1 : 0;
  const auto crs = io::describe_crs(crs_of(mesh));
  return crs && !crs->is_geographic ? crs->unit_in_metres : 0;
}

/// "m"; empty for a unit without a short name.
std::string unit_of(double metres) {
  constexpr std::pair<double, const char*> kUnits[] = {{1, "m"},     {0.3048, "ft"}, {1200.0 / 3937, "us-ft"},
                                                       {1000, "km"}, {0.01, "cm"},   {0.001, "mm"}};
  for (const auto& [size, name] : kUnits) {
    if (std::abs(metres / size - 1) < 1e-9) return name;
  }
  return "";
}

SurfaceUnits units_of(const Mesh& mesh) {
  const std::string named = metadata_of(mesh, "unit");
  const double metres = metres_of(mesh), metres_up = named.empty() ? metres : io::find_metres(named).value_or(0);
  const std::string across = unit_of(metres), up = unit_of(metres_up);
  if (across.empty() || up.empty()) return {"cubic units", "square units", named, false};
  return {across == up ? across + "³" : fmt::format("{}²·{}", across, up), across + "²", up, true};
}

void move_by(const Affine& way, Mesh& mesh) {
  const auto turn = [&](double& x, double& y) {
    const double turned = way[1] * x + way[2] * y;
    y = way[4] * x + way[5] * y;
    x = turned;
  };
  turn(mesh.origin[0], mesh.origin[1]);
  mesh.origin[0] += way[0];
  mesh.origin[1] += way[3];
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) turn(mesh.positions[3 * v], mesh.positions[3 * v + 1]);
}

/// The bound in the mesh's metadata, plus the rounding of the samples that it was made of.
std::optional<double> max_error_of(const Mesh& mesh) {
  const auto error = nlohmann::json::parse(metadata_of(mesh, "error"), nullptr, false);
  if (!error.is_object()) return std::nullopt;
  const auto number = [&](const char* key) {
    return error.contains(key) && error[key].is_number() ? std::optional(error[key].get<double>()) : std::nullopt;
  };
  const std::optional<double> measured = number("max_error");
  if (!measured || !(*measured >= 0)) return std::nullopt;
  return *measured + number("sample_rounding").value_or(0);
}

}  // namespace

Result<Surface> read_surface(const GivenSurface& given, bool is_y_up) {
  if (given.level) return Surface{given, {}, 0.0};
  Result<Mesh> mesh = read_mesh(given.path);
  if (!mesh) {
    std::error_code ignored;
    if (find_mesh_file(given.path) || !std::filesystem::exists(given.path, ignored))
      return tl::unexpected(std::move(mesh.error()));
    const std::string path = shell_word(given.path);
    return fail(
        ErrorKind::kInput,
        fmt::format(
            "{} is no mesh, and {} compares surfaces of triangles: make one of it, scarp simplify {} {}.glb -e 1", path,
            kVolume, path, path));
  }
  turn_up(is_y_up, given.path, *mesh);
  undo_placement(*mesh);
  const auto refuse = [&](const char* why) {
    return fail(ErrorKind::kInput, fmt::format("{} {}: make it with {} local", given.name(), why, kCrs));
  };
  if (mesh->metadata.contains("to_earth")) return refuse("lies in space, where z is no height");
  if (const auto crs = io::describe_crs(crs_of(*mesh)); crs && crs->is_geographic)
    return refuse("has x and y in degrees, in which there is no area");
  Surface surface{given, std::move(*mesh), std::nullopt};
  surface.max_error = max_error_of(surface.mesh);
  return surface;
}

bool has_place(const Surface& surface) { return surface.given.level || !place_of(surface.mesh).in.empty(); }

Result<SurfaceUnits> settle_frames(std::array<Surface, 2>& surfaces) {
  auto& [from, to] = surfaces;
  if (from.given.level) return units_of(to.mesh);
  if (to.given.level) return units_of(from.mesh);
  const PlaceOfMesh of_from = place_of(from.mesh), of_to = place_of(to.mesh);
  if (of_from.in.empty()) return units_of(to.mesh);
  if (of_to.in.empty()) return units_of(from.mesh);
  if (of_from.in != of_to.in)
    return fail(ErrorKind::kInput, fmt::format("{} lies in {}, and {} in {}: make both with one {}", from.given.name(),
                                               words_of(of_from.in), to.given.name(), words_of(of_to.in), kCrs));
  if (of_from.way != of_to.way) move_by(way_between(of_to.way, of_from.way), to.mesh);
  const std::string up = metadata_of(from.mesh, "unit"), other_up = metadata_of(to.mesh, "unit");
  if (up != other_up && !up.empty() && !other_up.empty() && io::find_metres(up) != io::find_metres(other_up))
    return fail(ErrorKind::kInput,
                fmt::format("heights of {} are in {}, and those of {} in {}: make both as .glb, which is in metres",
                            from.given.name(), up, to.given.name(), other_up));
  return units_of(from.mesh);
}

}  // namespace scarp::cli
