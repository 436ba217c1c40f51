#include "io/gdal/georeference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "grid/local_frame.h"
#include "io/commands.h"
#include "io/raster/raster_finish.h"
#include "scarp/height_field.h"

namespace scarp::gdal {
namespace {

/// Converts GDAL's pixel corners to a Frame's pixel centres.
std::array<double, 6> at_centres(const std::array<double, 6>& gt) {
  return {gt[0] + gt[1] / 2 + gt[2] / 2, gt[1], gt[2], gt[3] + gt[4] / 2 + gt[5] / 2, gt[4], gt[5]};
}

Geodetic geodetic_of(const Georeference& geo) {
  OGRErr error = OGRERR_NONE;
  return {OSRGetSemiMajor(geo.crs.get(), &error), OSRGetInvFlattening(geo.crs.get(), &error), geo.unit_in_metres};
}

/// Metres per unit of x and of y at the centre sample; zeros if unknown.
grid::MetresPerUnit metres_per_unit(const Georeference& geo) {
  if (!geo.crs) return {};
  if (!geo.geographic) return {geo.unit_in_metres, geo.unit_in_metres};
  const auto [east, north] = metres_of_unit(geo.centre()[1], geodetic_of(geo));
  return {east, north};
}

Frame source_frame(const Georeference& geo) {
  Frame frame;
  frame.kind = Frame::Kind::kSource;
  frame.affine = geo.samples;
  frame.crs = crs_name(geo.crs);
  frame.description = geo.crs ? fmt::format("coordinates in {} ({})", short_name(geo.crs), geo.unit_name)
                              : "the raster's own coordinates (no CRS)";
  frame.unit_in_metres = geo.length_in_metres();
  return frame;
}

/// Warns if coordinates resemble degrees, but there is no CRS or its unit is a length.
void doubt_lengths(const Georeference& geo, RasterInfo& info) {
  if (geo.geographic || info.format == "memory" || !io::looks_like_degrees(geo.pixels, geo.cols, geo.rows)) return;
  if (geo.crs && OSRIsProjected(geo.crs.get()) == 0) return;
  info.seems_degrees = true;
  if (!geo.crs) {
    info.warnings.push_back(
        fmt::format("the raster has no CRS, but its coordinates look like degrees, which do not mix with heights: if "
                    "they are, give it that CRS first ({})",
                    io::translate_command("-a_srs EPSG:4326", info.path)));
    return;
  }
  const Crs degrees = copy_crs(Crs(OSRCloneGeogCS(geo.crs.get())).get());
  const std::string name = crs_name(degrees);
  info.warnings.push_back(
      fmt::format("its x and y look like degrees, but its CRS, {}, has the unit {}, of which a cell is {:.3g} wide: "
                  "if they are degrees, that is the wrong CRS; name theirs first ({})",
                  short_name(geo.crs), geo.unit_name, info.cell_x,
                  io::translate_command("-a_srs " + (name.starts_with("EPSG:") ? name : "EPSG:4326"), info.path)));
}

void warn_of_degrees(RasterInfo& info) {
  info.warnings.push_back(
      "x and y are degrees while z is a length: the mesh is no shape in space; the frame 'local' is in "
      "metres");
}

/// In the local frame, east–west lengths are true only on the centre's parallel.
void warn_of_distortion(const Georeference& geo, RasterInfo& info) {
  const double centre = std::cos(geo.centre()[1] * geo.unit_in_metres);
  double worst = 0;
  for (const double col : {0.0, geo.cols - 1.0}) {
    for (const double row : {0.0, geo.rows - 1.0}) {
      const double y = geo.samples[3] + geo.samples[4] * col + geo.samples[5] * row;
      worst = std::max(worst, std::abs(centre / std::max(std::cos(y * geo.unit_in_metres), 1e-9) - 1));
    }
  }
  constexpr double kWorthSaying = 0.05;
  if (worst > kWorthSaying) {
    info.warnings.push_back(
        fmt::format("the raster spans so many degrees of latitude that east-west lengths in the local frame "
                    "are off by up to {:.0f} % at its edge; choose a projected CRS if shapes matter",
                    std::min(worst, 9.99) * 100));
  }
}

Result<Frame> centred_frame(const Georeference& geo, RasterInfo& info) {
  const grid::MetresPerUnit metres = geo.crs ? metres_per_unit(geo) : grid::MetresPerUnit{1, 1};
  auto frame = grid::local_frame(geo.samples, metres, geo.cols, geo.rows, geo.crs ? short_name(geo.crs) : "");
  if (!frame) return fail(frame.error().kind, info.path + ": " + frame.error().message);
  if (geo.geographic) warn_of_distortion(geo, info);
  return frame;
}

/// Fails with kUsage unless a net of points over the raster, including its edges, has finite images that neither fold
/// nor tear: all triangles keep one orientation.
Result<void> verify_transform(const Frame& frame, const Georeference& geo, const std::string& path) {
  constexpr int kNet = 32;
  const int across = std::min(kNet, geo.cols - 1), down = std::min(kNet, geo.rows - 1);
  const auto stride = static_cast<std::size_t>(across) + 1;
  std::vector<double> x, y;
  for (int j = 0; j <= down; ++j) {
    for (int i = 0; i <= across; ++i) {
      const auto at = frame.apply_affine((geo.cols - 1.0) * i / across, (geo.rows - 1.0) * j / down);
      x.push_back(at[0]);
      y.push_back(at[1]);
    }
  }
  const std::string from = short_name(geo.crs);
  if (!frame.transform->apply(x, y) || !std::isfinite(frame_origin(frame, geo.cols, geo.rows)[0])) {
    return fail(ErrorKind::kUsage,
                fmt::format("{}: parts of the raster have no place in {} (from {}); choose a CRS that covers "
                            "all of it",
                            path, frame.crs.size() < 40 ? frame.crs : "that CRS", from));
  }
  int positive = 0, negative = 0;
  for (int j = 0; j < down; ++j) {
    for (int i = 0; i < across; ++i) {
      const std::size_t a = static_cast<std::size_t>(j) * stride + static_cast<std::size_t>(i);
      for (const auto& [p, q, r] : {std::array{a, a + 1, a + stride}, std::array{a + 1, a + stride + 1, a + stride}}) {
        const double area = (x[q] - x[p]) * (y[r] - y[p]) - (x[r] - x[p]) * (y[q] - y[p]);
        positive += area > 0 ? 1 : 0;
        negative += area < 0 ? 1 : 0;
      }
    }
  }
  const int all = 2 * across * down;
  if (positive != all && negative != all) {
    return fail(ErrorKind::kUsage,
                fmt::format("{}: the raster would fold or tear in {} (from {}), as across the 180th meridian or "
                            "a pole; choose a CRS that is smooth over all of it",
                            path, frame.crs.size() < 40 ? frame.crs : "that CRS", from));
  }
  return {};
}

Result<Frame> projected_frame(const Georeference& geo, const std::string& wanted, RasterInfo& info) {
  const Crs target = find_crs(wanted);
  if (!target) {
    return fail(ErrorKind::kUsage,
                fmt::format("'{}' is no coordinate reference system that GDAL knows; give 'source', 'local', "
                            "'enu', 'grid', a code such as EPSG:32633, WKT or a PROJ string",
                            wanted));
  }
  if (!OSRIsGeographic(target.get()) && !OSRIsProjected(target.get()) && !OSRIsLocal(target.get())) {
    return fail(ErrorKind::kUsage,
                fmt::format("{} is not a CRS of positions on a map (vertical ones are not); choose a "
                            "projected or geographic CRS",
                            short_name(target)));
  }
  if (OSRIsGeographic(target.get())) warn_of_degrees(info);
  if (same_crs(geo.crs, target)) return source_frame(geo);
  Frame frame = source_frame(geo);
  frame.kind = Frame::Kind::kProjected;
  frame.crs = crs_name(target);
  frame.description = fmt::format("coordinates in {}, transformed from {}", short_name(target), short_name(geo.crs));
  frame.unit_in_metres = OSRIsGeographic(target.get()) != 0 ? 0 : OSRGetLinearUnits(target.get(), nullptr);
  frame.transform = build_transform(geo.crs, target);
  if (!frame.transform) {
    return fail(ErrorKind::kUsage, fmt::format("{}: there is no way from {} to {}; choose another CRS", info.path,
                                               short_name(geo.crs), short_name(target)));
  }
  SCARP_RETURN_IF_ERROR(verify_transform(frame, geo, info.path));
  return frame;
}

}  // namespace

std::array<double, 2> Georeference::centre() const {
  const double col = cols / 2, row = rows / 2;
  const auto& a = samples;
  return {a[0] + a[1] * col + a[2] * row, a[3] + a[4] * col + a[5] * row};
}

double Georeference::length_in_metres() const { return crs && !geographic ? unit_in_metres : 0; }

Georeference make_georeference(int cols, int rows, const std::optional<std::array<double, 6>>& pixels, Crs crs,
                               SpaceCrs space) {
  Georeference geo;
  geo.cols = cols;
  geo.rows = rows;
  geo.located = pixels.has_value();
  if (pixels) geo.pixels = *pixels;
  geo.samples = at_centres(geo.pixels);
  geo.crs = std::move(crs);
  geo.in_space = std::move(space);
  if (geo.crs) {
    char* name = nullptr;  // owned by the CRS
    geo.geographic = OSRIsGeographic(geo.crs.get()) != 0;
    geo.unit_in_metres =
        geo.geographic ? OSRGetAngularUnits(geo.crs.get(), &name) : OSRGetLinearUnits(geo.crs.get(), &name);
    geo.unit_name = name != nullptr ? name : "unknown unit";
  }
  return geo;
}

Result<Georeference> read_georeference(GDALDatasetH dataset, const std::string& path) {
  std::optional<std::array<double, 6>> pixels(std::in_place);
  if (GDALGetGeoTransform(dataset, pixels->data()) != CE_None) pixels.reset();
  Georeference geo = make_georeference(GDALGetRasterXSize(dataset), GDALGetRasterYSize(dataset), pixels,
                                       crs_of(dataset), space_crs_of(declared_crs(dataset)));
  if (geo.located && grid::is_degenerate(geo.samples)) {
    return fail(ErrorKind::kInput,
                fmt::format("{}: its geotransform maps the raster to a line or to infinity; give it a place first ({})",
                            path, io::translate_command("-a_ullr WEST NORTH EAST SOUTH", path)));
  }
  return geo;
}

void describe_georeference(const Georeference& geo, RasterInfo& info) {
  info.has_georeference = geo.located;
  info.geotransform = geo.pixels;
  info.crs = crs_name(geo.crs);
  info.crs_unit = geo.unit_name;
  info.crs_unit_in_metres = geo.length_in_metres();
  info.is_geographic = geo.geographic;
  info.vertical = geo.in_space.vertical;
  info.is_ellipsoidal = geo.in_space.is_ellipsoidal;
  if (!geo.in_space.vertical.empty()) info.crs_with_heights = wkt_with_heights(geo.in_space.crs);
  const auto& gt = geo.pixels;
  info.cell_x = std::hypot(gt[1], gt[4]);
  info.cell_y = std::hypot(gt[2], gt[5]);
  if (geo.located && geo.crs) {
    const auto metres = metres_per_unit(geo);
    info.cell_x_m = std::hypot(gt[1] * metres.east, gt[4] * metres.north);
    info.cell_y_m = std::hypot(gt[2] * metres.east, gt[5] * metres.north);
  }
}

Result<Frame> choose_frame(const Georeference& geo, const ReadOptions& options, RasterInfo& info) {
  const std::string& wanted = options.crs;
  if (!geo.located) {
    auto frame = io::ungeoreferenced_frame(info.path, geo.cols, geo.rows, options);
    if (frame && geo.crs) {
      info.warnings.push_back(info.path + " has a CRS but no position in it: x and y are columns and rows");
    }
    return frame;
  }
  const std::string way = info.format == "memory" ? "" : io::translate_command("-a_srs EPSG:CODE", info.path);
  SCARP_RETURN_IF_ERROR(verify_degrees(geo.crs, geo.centre(), info.path, way));
  if (wanted == "grid") return io::grid_or_cells(info.path, geo.cols, geo.rows, options);
  if (options.cell_size) {
    return fail(ErrorKind::kUsage, info.path +
                                       " has a georeference, which says how wide its cells are: leave the cell size "
                                       "out, or ask for the frame 'grid'");
  }
  doubt_lengths(geo, info);
  const DefaultFrame otherwise = options.default_frame;
  const bool is_local =
      wanted == "local" ||
      (wanted.empty() && (otherwise == DefaultFrame::kLocal || (otherwise == DefaultFrame::kMetric && geo.geographic)));
  if (is_local) return centred_frame(geo, info);
  if (wanted.empty() || wanted == "source") {
    if (geo.geographic) warn_of_degrees(info);
    return source_frame(geo);
  }
  if (!geo.crs) {
    return fail(ErrorKind::kUsage,
                fmt::format("{} has no CRS, so its coordinates cannot be given in '{}': ask for 'source', 'local' or "
                            "'grid', or give {}",
                            info.path, wanted,
                            info.format == "memory"
                                ? "crs with the samples"
                                : "it its CRS first (" + io::translate_command("-a_srs EPSG:CODE", info.path) + ")"));
  }
  return is_in_space(wanted) ? earth_frame(geo, wanted, info) : projected_frame(geo, wanted, info);
}

}  // namespace scarp::gdal
