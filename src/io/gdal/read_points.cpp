// Points of a vector layer, and lines through them.
#include <cpl_conv.h>
#include <cpl_port.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "grid/local_frame.h"
#include "io/commands.h"
#include "io/gdal/crs.h"
#include "io/gdal/earth_frame.h"
#include "io/gdal/vector.h"
#include "io/lent.h"
#include "io/points/column_names.h"
#include "io/points/layer_list.h"
#include "io/points/line_points.h"
#include "io/points/point_heights.h"
#include "io/points/point_source.h"

namespace scarp::gdal {
namespace {

bool may_hold_points(OGRLayerH layer) {
  const OGRwkbGeometryType type = wkbFlatten(OGR_L_GetGeomType(layer));
  return type == wkbPoint || type == wkbMultiPoint || type == wkbUnknown || type == wkbGeometryCollection;
}

bool is_layer_of_lines(OGRLayerH layer) {
  const OGRwkbGeometryType type = wkbFlatten(OGR_L_GetGeomType(layer));
  return OGR_GT_IsSubClassOf(type, wkbCurve) != 0 || OGR_GT_IsSubClassOf(type, wkbMultiCurve) != 0;
}

bool holds_polygons(OGRLayerH layer) {
  return OGR_GT_IsSubClassOf(OGR_GT_GetLinear(wkbFlatten(OGR_L_GetGeomType(layer))), wkbSurface) != 0 ||
         OGR_GT_IsSubClassOf(wkbFlatten(OGR_L_GetGeomType(layer)), wkbMultiSurface) != 0;
}

/// The remedy for contours that are polygons.
std::string make_lines(const std::string& path) {
  return fmt::format("if their rings are contours, make lines of them first (ogr2ogr -nlt MULTILINESTRING {} {})",
                     io::new_file(".gpkg"), io::file_word(path));
}

/// The layers to read: those named by `wanted`, else the first layer of points, else the first layer of lines.
Result<std::vector<VectorLayer>> find_layers(GDALDatasetH dataset, const std::string& path, const std::string& wanted) {
  const std::vector<VectorLayer> layers = list_layers(dataset);
  if (layers.empty()) return fail(ErrorKind::kInput, path + ": holds no points or lines");
  const auto named = [&](const std::string& name) {
    return std::find_if(layers.begin(), layers.end(), [&](const VectorLayer& layer) { return layer.name == name; });
  };
  std::vector<VectorLayer> found;
  for (const std::string& name : io::layer_list(wanted, [&](const auto& all) { return named(all) != layers.end(); })) {
    const auto layer = named(name);
    if (layer == layers.end())
      return fail(ErrorKind::kInput, fmt::format("{}: holds no layer '{}', only {}", path, name, layer_names(layers)));
    found.push_back(*layer);
  }
  if (!found.empty()) return found;
  const bool is_drawing = !layers.front().filter.empty();
  if (is_drawing && layers.size() > 1)
    return fail(ErrorKind::kInput,
                fmt::format("{}: a drawing with the layers {}: name those of the terrain with --layer A,B", path,
                            layer_names(layers)));
  for (const auto& fits : {may_hold_points, is_layer_of_lines}) {
    const auto layer = std::find_if(layers.begin(), layers.end(), [&](const VectorLayer& l) { return fits(l.of); });
    if (layer != layers.end()) return std::vector{*layer};
  }
  if (holds_polygons(layers.front().of))
    return fail(ErrorKind::kInput, fmt::format("{}: holds polygons, not points or lines: {}", path, make_lines(path)));
  return fail(ErrorKind::kInput,
              fmt::format("{}: holds no layer of points or lines, only {}", path, layer_names(layers)));
}

/// The meaning of a layer's third coordinates, from its features if its type does not declare it.
struct ThirdCoordinates {
  std::optional<double> first;  ///< none: no third coordinates
  bool differ = false;          ///< NaN equals NaN

  void add(OGRGeometryH geometry) {
    for (int i = 0; i < OGR_G_GetGeometryCount(geometry) && !differ; ++i) add(OGR_G_GetGeometryRef(geometry, i));
    const bool has_points = OGR_G_GetGeometryCount(geometry) == 0;
    for (int i = 0; has_points && i < OGR_G_GetPointCount(geometry) && !differ; ++i) {
      const double z = OGR_G_GetZ(geometry, i);
      if (!first) first = z;
      differ = z != *first && !(std::isnan(z) && std::isnan(*first));
    }
  }
};

ThirdCoordinates look_at_third_coordinates(OGRLayerH layer) {
  ThirdCoordinates found;
  OGR_L_ResetReading(layer);
  while (const Feature feature{OGR_L_GetNextFeature(layer)}) {
    OGRGeometryH geometry = OGR_F_GetGeometryRef(feature.get());
    if (geometry == nullptr || OGR_G_IsEmpty(geometry) != 0) continue;
    if (OGR_G_Is3D(geometry) == 0) return found;
    found.add(geometry);
    if (found.differ) return found;
  }
  return found;
}

std::string list_of_fields(OGRLayerH layer, bool heights_only, int without = -1) {
  OGRFeatureDefnH definition = OGR_L_GetLayerDefn(layer);
  std::string list;
  for (int i = 0; i < OGR_FD_GetFieldCount(definition); ++i) {
    const char* name = OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(definition, i));
    if (i != without && (!heights_only || io::role_of(name) == io::ColumnRole::kHeight))
      list += (list.empty() ? "" : ", ") + std::string(name);
  }
  return list;
}

/// The attribute whose name is most specific to heights.
std::optional<int> find_named_height(OGRLayerH layer) {
  OGRFeatureDefnH definition = OGR_L_GetLayerDefn(layer);
  std::optional<int> best;
  std::size_t least = 0;
  for (int i = 0; i < OGR_FD_GetFieldCount(definition); ++i) {
    const char* name = OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(definition, i));
    if (io::role_of(name) != io::ColumnRole::kHeight || (best && io::rank_of(name) >= least)) continue;
    best = i;
    least = io::rank_of(name);
  }
  return best;
}

/// Finds the heights: an attribute, or the third coordinate. The choice is stored in `points`.
Result<std::optional<int>> find_height_field(OGRLayerH layer, const std::string& wanted, bool is_only,
                                             PointSet& points) {
  const std::string& path = points.path;
  const auto name_of = [&](int index) {
    return std::string(OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(OGR_L_GetLayerDefn(layer), index)));
  };
  const auto take = [&](int index) {
    points.columns = "height: attribute " + name_of(index);
    points.heights.unit = io::unit_named_in(name_of(index));
  };
  if (!wanted.empty()) {
    SCARP_TRY(const auto& index, find_field(layer, path, wanted));
    take(index);
    return index;
  }
  const ThirdCoordinates third = look_at_third_coordinates(layer);
  points.columns = "height: third coordinate";
  if (third.differ) return std::nullopt;
  const std::optional<int> named = find_named_height(layer);
  if (!named && !third.first)
    return fail(ErrorKind::kInput,
                fmt::format("{}: the features of the layer {} have no third coordinate, and no attribute z, height, "
                            "elevation, elev or h: name the one that holds heights with --z-field",
                            path, OGR_L_GetName(layer)));
  if (!named && !is_only) return std::nullopt;
  if (!named) {
    const std::string fields = list_of_fields(layer, false);
    points.warnings.push_back(fmt::format(
        "{}: all heights are {}{}", path, *third.first,
        fields.empty() ? std::string() : ": if an attribute holds them, name it with --z-field (" + fields + ")"));
    return std::nullopt;
  }
  take(*named);
  if (third.first)
    points.warnings.push_back(
        fmt::format("{}: the third coordinate is {} everywhere, so the heights are those of the "
                    "attribute {}: --z-field names another",
                    path, *third.first, name_of(*named)));
  if (const std::string others = list_of_fields(layer, true, *named); !others.empty())
    points.warnings.push_back(
        fmt::format("{}: the heights are those of the attribute {}, not of {}: --z-field names another", path,
                    name_of(*named), others));
  return named;
}

class PointCollector {
 public:
  PointCollector(const std::string& path, std::optional<int> height_field, std::optional<double> nodata,
                 PointSet& points)
      : path_(path), height_field_(height_field), nodata_(nodata), points_(points) {}

  Result<void> add(OGRFeatureH feature) {
    id_ = OGR_F_GetFID(feature);
    OGRGeometryH geometry = OGR_F_GetGeometryRef(feature);
    if (geometry == nullptr || OGR_G_IsEmpty(geometry) != 0) {
      ++without_geometry_;
      return {};
    }
    std::optional<double> height;
    if (height_field_) {
      SCARP_TRY(height, read_height(feature));
    }
    if (OGR_GT_IsNonLinear(OGR_G_GetGeometryType(geometry)) == 0 && OGR_G_HasCurveGeometry(geometry, 0) == 0)
      return add_geometry(geometry, height);
    const Geometry linear(OGR_G_GetLinearGeometry(geometry, 0, nullptr));
    if (!linear)
      return fail(ErrorKind::kInput,
                  fmt::format("{}: feature {} has curves that GDAL cannot make lines of", path_, id_));
    return add_geometry(linear.get(), height);
  }
  std::uint64_t without_geometry() const { return without_geometry_; }
  std::uint64_t without_extent() const { return without_extent_; }

 private:
  const char* field_name(OGRFeatureH feature) const {
    return OGR_Fld_GetNameRef(OGR_F_GetFieldDefnRef(feature, *height_field_));
  }

  /// The attribute; NaN if it is no number and --nodata omits such points.
  Result<double> read_height(OGRFeatureH feature) const {
    const bool is_set = OGR_F_IsFieldSetAndNotNull(feature, *height_field_) != 0;
    const char* text = is_set ? OGR_F_GetFieldAsString(feature, *height_field_) : "";
    char* end = nullptr;
    CPLStrtod(text, &end);
    if (end != text && *end == '\0') return OGR_F_GetFieldAsDouble(feature, *height_field_);
    if (nodata_) return std::nan("");
    if (!is_set)
      return fail(ErrorKind::kInput, fmt::format("{}: feature {} has no height: its attribute {} is empty; fill it in, "
                                                 "leave such features out with --nodata nan, or name another with "
                                                 "--z-field",
                                                 path_, id_, field_name(feature)));
    return fail(ErrorKind::kInput, fmt::format("{}: feature {} has no number as its height: its attribute {} is '{}'; "
                                               "correct it, leave such features out with --nodata nan, or name "
                                               "another with --z-field",
                                               path_, id_, field_name(feature), text));
  }

  Result<void> add_geometry(OGRGeometryH geometry, std::optional<double> height) {
    const OGRwkbGeometryType type = wkbFlatten(OGR_G_GetGeometryType(geometry));
    if (type == wkbMultiPoint || type == wkbMultiLineString || type == wkbGeometryCollection) {
      for (int i = 0; i < OGR_G_GetGeometryCount(geometry); ++i) {
        SCARP_RETURN_IF_ERROR(add_geometry(OGR_G_GetGeometryRef(geometry, i), height));
      }
      return {};
    }
    if (type != wkbPoint && type != wkbLineString)
      return fail(ErrorKind::kInput,
                  fmt::format("{}: feature {} is a {}, not a point or a line{}", path_, id_,
                              OGRGeometryTypeToName(OGR_G_GetGeometryType(geometry)),
                              type == wkbPolygon || type == wkbMultiPolygon ? ": " + make_lines(path_) : ""));
    if (OGR_G_IsEmpty(geometry) != 0) {
      ++without_geometry_;
      return {};
    }
    if (!height && OGR_G_Is3D(geometry) == 0)
      return fail(ErrorKind::kInput, fmt::format("{}: feature {} has no third coordinate, as others have: give it one, "
                                                 "or name an attribute with --z-field",
                                                 path_, id_));
    if (type == wkbPoint) return add_point(geometry, 0, height);
    return add_line(geometry, height);
  }

  Result<void> add_line(OGRGeometryH geometry, std::optional<double> height) {
    io::LinePoints line(points_);
    for (int i = 0; i < OGR_G_GetPointCount(geometry); ++i) {
      const std::size_t before = points_.size();
      SCARP_RETURN_IF_ERROR(add_point(geometry, i, height));
      if (points_.size() > before) line.add_last();
    }
    if (!line.finish(fmt::format("{} feature {}", path_, id_))) ++without_extent_;
    return {};
  }

  Result<void> add_point(OGRGeometryH geometry, int i, std::optional<double> height) {
    const double x = OGR_G_GetX(geometry, i), y = OGR_G_GetY(geometry, i);
    const double z = height ? *height : OGR_G_GetZ(geometry, i);
    if (nodata_ && (!std::isfinite(z) || z == *nodata_)) {
      ++points_.without_height;
      return {};
    }
    if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z))
      return fail(ErrorKind::kInput,
                  fmt::format("{}: feature {} has x {}, y {}, height {}, which are not all finite: remove that point{}",
                              path_, id_, x, y, z,
                              std::isfinite(z) ? "" : ", or leave out all points without a height with --nodata nan"));
    points_.x.push_back(x);
    points_.y.push_back(y);
    points_.z.push_back(z);
    return {};
  }

  const std::string& path_;
  std::optional<int> height_field_;
  std::optional<double> nodata_;
  PointSet& points_;
  GIntBig id_ = 0;
  std::uint64_t without_geometry_ = 0, without_extent_ = 0;
};

/// Converts degrees to metres by the two constants of the ellipsoid at the middle of the points; see
/// grid/local_frame.cpp.
Result<void> make_local(const Crs& crs, PointSet& points) {
  const auto [x, y] = io::middle_of(points);
  SCARP_RETURN_IF_ERROR(verify_degrees(crs, {x, y}, points.path, io::crs_command(points, "EPSG:CODE")));
  grid::MetresPerRadian metres{1, 1};
  if (OSRIsGeographic(crs.get()) != 0) {
    OGRErr error = OGRERR_NONE;
    const grid::Ellipsoid ellipsoid{OSRGetSemiMajor(crs.get(), &error), OSRGetInvFlattening(crs.get(), &error)};
    const double radians = OSRGetAngularUnits(crs.get(), nullptr), latitude = y * radians;
    const auto [low, high] = std::minmax_element(points.y.begin(), points.y.end());
    if (!(std::max(std::abs(*low), std::abs(*high)) * radians <= std::acos(0.0) + 1e-9) || !(std::cos(latitude) > 1e-3))
      return fail(
          ErrorKind::kUsage,
          fmt::format("{}: the middle of the points lies at {:.9g}, {:.9g}, at or beyond a pole, where no local "
                      "frame exists; choose a polar CRS such as EPSG:3413 or EPSG:3031",
                      points.path, x, y));
    metres = grid::metres_per_radian(ellipsoid, latitude);
    metres = {metres.east * radians, metres.north * radians};
    const double widest = std::max(std::cos(*low * radians), std::cos(*high * radians)) / std::cos(latitude),
                 narrowest = std::min(std::cos(*low * radians), std::cos(*high * radians)) / std::cos(latitude);
    if (widest > 1.05 || narrowest < 0.95)
      points.warnings.push_back(
          "the points span so many degrees of latitude that east-west lengths in the local frame are off by more than "
          "5 % at their edge; choose a projected CRS if shapes matter");
  } else {
    metres = {points.unit_in_metres, points.unit_in_metres};
  }
  io::make_local_metres({metres.east, metres.north}, short_name(crs), points);
  return {};
}

Result<void> project(const Crs& from, const std::string& wanted, PointSet& points) {
  const Crs to = find_crs(wanted);
  if (!to || (!OSRIsGeographic(to.get()) && !OSRIsProjected(to.get()) && !OSRIsLocal(to.get())))
    return fail(ErrorKind::kUsage,
                fmt::format("'{}' is no coordinate reference system of positions on a map that GDAL knows; give "
                            "'source', 'local', a code such as EPSG:32633, WKT or a PROJ string",
                            wanted));
  if (!same_crs(from, to)) {
    const auto transform = build_transform(from, to);
    if (!transform || !transform->apply(points.x, points.y))
      return fail(ErrorKind::kUsage, fmt::format("{}: some points have no place in {} (from {}); choose a CRS that "
                                                 "covers all of them",
                                                 points.path, short_name(to), short_name(from)));
    points.description = fmt::format("coordinates in {}, transformed from {}", short_name(to), short_name(from));
  }
  points.crs = crs_name(to);
  points.unit_in_metres = OSRIsGeographic(to.get()) != 0 ? 0 : OSRGetLinearUnits(to.get(), nullptr);
  return {};
}

Result<void> place(const Crs& crs, const ReadPointsOptions& options, PointSet& points) {
  const std::string& wanted = options.crs;
  if (wanted == "grid")
    return fail(ErrorKind::kUsage, points.path + ": scattered points have no grid: ask for 'source' or 'local'");
  points.crs = crs_name(crs);
  points.description = crs ? fmt::format("coordinates in {}", short_name(crs)) : "the points' own coordinates (no CRS)";
  if (crs && (OSRIsGeocentric(crs.get()) != 0 || OSRIsVertical(crs.get()) != 0))
    return fail(ErrorKind::kInput,
                fmt::format("{}: its CRS, {}, is not one of positions on a map: declare that of x and "
                            "y, such as EPSG:32633",
                            points.path, short_name(crs)));
  const bool is_geographic = crs && OSRIsGeographic(crs.get()) != 0;
  if (crs && !is_geographic) {
    char* name = nullptr;  // owned by the CRS
    points.unit_in_metres = OSRGetLinearUnits(crs.get(), &name);
    points.heights.crs_unit = name != nullptr ? name : "the unit of x and y";
    points.heights.crs_unit_in_metres = points.unit_in_metres;
  }
  if (wanted.empty() && !is_geographic && !io::becomes_local(options, points.unit_in_metres)) return {};
  if (wanted == "source") {
    if (is_geographic)
      points.warnings.push_back(
          "x and y are degrees while z is a length: the mesh is no shape in space; the frame 'local' is in metres");
    return {};
  }
  if (!crs)
    return fail(ErrorKind::kUsage, fmt::format("{} has no CRS, so its coordinates cannot be given in '{}': ask for "
                                               "'source', or give it its CRS first (ogr2ogr -a_srs EPSG:CODE {} {})",
                                               points.path, wanted, io::new_file(".gpkg"), io::file_word(points.path)));
  return wanted.empty() || wanted == "local" ? make_local(crs, points) : project(crs, wanted, points);
}

Result<void> read_layer(Session& session, const VectorLayer& from, bool is_only, const ReadPointsOptions& options,
                        PointSet& points) {
  const std::string& path = points.path;
  const std::string columns = std::exchange(points.columns, ""), unit = std::exchange(points.heights.unit, "");
  const std::size_t before = points.size();
  OGRLayerH layer = from.open();
  const bool has_field = OGR_FD_GetFieldIndex(OGR_L_GetLayerDefn(layer), options.z_field.c_str()) >= 0;
  SCARP_TRY(const auto& height_field,
            find_height_field(layer, is_only || has_field ? options.z_field : "", is_only, points));
  if (before > 0 && unit != points.heights.unit)
    return fail(ErrorKind::kInput,
                fmt::format("{}: the heights of the layer {} are in '{}', those before in '{}': read "
                            "one of them",
                            path, from.name, points.heights.unit, unit));
  if (!is_only)
    points.columns = fmt::format("{}{}{}: {}", columns, columns.empty() ? "" : "; ", from.name, points.columns);
  PointCollector collector(path, height_field, options.nodata, points);
  const std::uint64_t without_height = points.without_height;
  SCARP_RETURN_IF_ERROR(each_feature(session, layer, path, options.progress,
                                     [&](OGRFeatureH feature) { return collector.add(feature); }));
  if (points.size() == before && points.without_height > without_height)
    return fail(ErrorKind::kInput, path + ": no point has a height other than that of --nodata");
  if (points.size() == before)
    return fail(ErrorKind::kInput, fmt::format("{}: the layer {} holds no points or lines", path, from.name));
  if (collector.without_geometry() > 0)
    points.warnings.push_back(
        collector.without_geometry() == 1
            ? fmt::format("1 feature of {} has no point and was left out", path)
            : fmt::format("{} features of {} have no point and were left out", collector.without_geometry(), path));
  if (collector.without_extent() > 0)
    points.warnings.push_back(collector.without_extent() == 1
                                  ? fmt::format("1 line of {} is a single point, and counts as one", path)
                                  : fmt::format("{} lines of {} are a single point each, and count as points",
                                                collector.without_extent(), path));
  return {};
}

Result<PointSet> read(const std::string& path, const ReadPointsOptions& options) {
  if (!options.columns.empty())
    return fail(ErrorKind::kUsage,
                path + ": --columns names the columns of a text, and this is none: --z-field names an attribute");
  Session session(is_remote(path));
  SCARP_TRY(const auto& dataset,
            open_vector(session, path, "points", "neither text of columns nor vector data that GDAL can read"));
  SCARP_TRY(const auto& layers, find_layers(dataset.get(), path, options.layer));
  PointSet points;
  points.path = path;
  points.format = GDALGetDriverShortName(GDALGetDatasetDriver(dataset.get()));
  for (const VectorLayer& layer : layers) {
    SCARP_RETURN_IF_ERROR(read_layer(session, layer, layers.size() == 1, options, points));
  }
  SCARP_RETURN_IF_ERROR(io::crop(options, points));
  const Crs crs = layer_crs(layers.front().of);
  for (const VectorLayer& layer : layers) {
    if (const Crs other = layer_crs(layer.of); crs ? !other || !same_crs(crs, other) : bool{other})
      return fail(ErrorKind::kInput, fmt::format("{}: the layers {} differ in their CRS: read one of them with --layer",
                                                 path, layer_names(layers)));
  }
  SCARP_RETURN_IF_ERROR(place(crs, options, points));
  const SpaceCrs in_space = space_crs_of(declared_layer_crs(layers.front().of));
  SCARP_RETURN_IF_ERROR(io::settle_point_heights(options, in_space.unit, points));
  for (const std::string& warning : session.warnings()) points.warnings.push_back("GDAL: " + warning);
  return points;
}

}  // namespace
}  // namespace scarp::gdal

namespace scarp::io {

Result<PointSet> read_gdal_points(const std::string& path, const ReadPointsOptions& options) {
  return gdal::read(path, options);
}

Result<HeightUnit> place_lent_points(const ReadPointsOptions& options, PointSet& points) {
  gdal::Session session;
  const bool is_unnamed = points.crs.empty() && points.is_geographic;
  SCARP_TRY(const auto& crs, gdal::find_crs_of(points.path, is_unnamed ? "EPSG:4326" : points.crs));
  SCARP_RETURN_IF_ERROR(gdal::place(gdal::copy_crs(crs.get()), options, points));
  return gdal::space_crs_of(crs).unit;
}

bool opens_as_raster(const std::string& path) {
  gdal::Session session(gdal::is_remote(path));
  const auto dataset = gdal::open_raster(session, path);
  return dataset && !EQUAL(GDALGetDriverShortName(GDALGetDatasetDriver(dataset->get())), "XYZ");
}

}  // namespace scarp::io
