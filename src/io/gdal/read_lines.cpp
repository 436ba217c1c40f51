// Lines and polygons of a vector layer.
#include <cpl_conv.h>
#include <cpl_vsi.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>

#include "base/caught.h"
#include "io/gdal/crs.h"
#include "io/gdal/earth_frame.h"
#include "io/gdal/landxml_lines.h"
#include "io/gdal/vector.h"
#include "io/line_heights.h"
#include "io/points/column_names.h"
#include "io/points/landxml.h"
#include "scarp/lines.h"

namespace scarp::gdal {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

struct OpenedLayer {
  Dataset dataset;
  std::string path, layer;  ///< layer: empty if none was named
};

bool exists(const std::string& path) {
  VSIStatBufL status{};
  return VSIStatL(vsi_path(path).c_str(), &status) == 0;
}

/// The name of a file, and of the layer in it if the layer is named.
struct NamedLayer {
  std::string file, layer;
};

/// Distinguishes "file:layer" from a name that contains a colon ("C:\lines.shp", "PG:dbname=…", a URL) by a search for
/// the file.
NamedLayer split_layer(const std::string& path) {
  const std::size_t colon = path.rfind(':');
  const bool may_name_layer = colon != std::string::npos && colon > 0 && colon + 1 < path.size();
  std::string file = may_name_layer ? path.substr(0, colon) : std::string();
  if (may_name_layer && !exists(path) && exists(file)) return {std::move(file), path.substr(colon + 1)};
  return {path, {}};
}

Result<OpenedLayer> open(Session& session, const NamedLayer& named) {
  SCARP_TRY(auto&& dataset, open_vector(session, named.file, "lines", "no vector data that GDAL can read"));
  return OpenedLayer{std::move(dataset), named.file, named.layer};
}

bool may_be_lines(OGRLayerH layer) {
  const OGRwkbGeometryType type = wkbFlatten(OGR_L_GetGeomType(layer));
  return type != wkbNone && type != wkbPoint && type != wkbMultiPoint;
}

Result<VectorLayer> find_layer(const OpenedLayer& opened) {
  const std::vector<VectorLayer> layers = list_layers(opened.dataset.get());
  const std::string names = layer_names(layers);
  std::vector<VectorLayer> fitting;
  for (const VectorLayer& layer : layers) {
    if (opened.layer.empty() ? may_be_lines(layer.of) : opened.layer == layer.name) fitting.push_back(layer);
  }
  if (!fitting.empty() && (fitting.size() == 1 || !opened.layer.empty())) return fitting.front();
  if (!fitting.empty())
    return fail(ErrorKind::kInput, fmt::format("{}: holds several layers; name one, as in {}:{}: {}", opened.path,
                                               opened.path, fitting.front().name, names));
  const std::string found = names.empty() ? "it has no layers" : "found: " + names;
  if (opened.layer.empty())
    return fail(ErrorKind::kInput, fmt::format("{} has no layer of lines or polygons ({})", opened.path, found));
  return fail(ErrorKind::kInput, fmt::format("{} has no layer '{}' ({})", opened.path, opened.layer, found));
}

class LineCollector {
 public:
  LineCollector(std::optional<int> height_field, bool ignore_z, LineSet& set)
      : height_field_(height_field), ignore_z_(ignore_z), set_(set) {
    const bool says_all = std::filesystem::path(set.path).stem().string() == set.layer;
    prefix_ = set.path + (says_all ? "" : ":" + set.layer) + " feature ";
  }

  Result<void> add(OGRFeatureH feature) {
    name_ = prefix_ + std::to_string(OGR_F_GetFID(feature));
    OGRGeometryH geometry = OGR_F_GetGeometryRef(feature);
    if (geometry == nullptr || OGR_G_IsEmpty(geometry) != 0) {
      ++without_geometry_;
      return {};
    }
    height_.reset();
    if (height_field_) {
      SCARP_RETURN_IF_ERROR(read_height(feature));
    }
    if (OGR_GT_IsNonLinear(OGR_G_GetGeometryType(geometry)) == 0 && OGR_G_HasCurveGeometry(geometry, 0) == 0)
      return add_geometry(geometry);
    const Geometry linear(OGR_G_GetLinearGeometry(geometry, 0, nullptr));
    if (!linear) return fail(ErrorKind::kInput, name_ + " has curves that GDAL cannot make lines of");
    return add_geometry(linear.get());
  }

  void warn() const {
    const auto tell = [&](std::uint64_t count, const char* one, const char* many) {
      if (count == 0) return;
      const std::string what = count == 1 ? one : many;
      set_.warnings.push_back(fmt::format("{} {} of {} left out", count, what, set_.path + ":" + set_.layer));
    };
    tell(points_, "point", "points");
    tell(without_geometry_, "feature without geometry", "features without geometry");
    if (filled_ > 0)
      set_.warnings.push_back(
          filled_ == 1
              ? "1 vertex without a height on lines that have heights lies between its neighbours: " + first_filled_
              : fmt::format("{} vertices without a height on lines that have heights lie between their "
                            "neighbours: {} is the first",
                            filled_, first_filled_));
    tell(without_extent_, "line or ring of no extent", "lines or rings of no extent");
  }

 private:
  Result<void> read_height(OGRFeatureH feature) {
    height_ = kUnknown;
    if (OGR_F_IsFieldSetAndNotNull(feature, *height_field_) == 0) return {};
    const char* text = OGR_F_GetFieldAsString(feature, *height_field_);
    char* end = nullptr;
    height_ = CPLStrtod(text, &end);
    if (end != text && *end == '\0' && std::isfinite(*height_)) {
      height_ = OGR_F_GetFieldAsDouble(feature, *height_field_);
      return {};
    }
    return fail(ErrorKind::kInput,
                fmt::format("{} has no number as its height: its attribute {} is '{}'", name_,
                            OGR_Fld_GetNameRef(OGR_F_GetFieldDefnRef(feature, *height_field_)), text));
  }

  Result<void> add_geometry(OGRGeometryH geometry) {
    const OGRwkbGeometryType type = wkbFlatten(OGR_G_GetGeometryType(geometry));
    if (type == wkbPoint) {
      points_ += OGR_G_IsEmpty(geometry) == 0 ? 1 : 0;
      return {};
    }
    if (type == wkbLineString || type == wkbLinearRing) return add_line(geometry, LineRole::kLine);
    const bool is_polygon = type == wkbPolygon || type == wkbTriangle;
    if (is_polygon) OGR_G_CloseRings(geometry);
    for (int i = 0; i < OGR_G_GetGeometryCount(geometry); ++i) {
      OGRGeometryH part = OGR_G_GetGeometryRef(geometry, i);
      const LineRole role = i == 0 ? LineRole::kOuter : LineRole::kHole;
      SCARP_RETURN_IF_ERROR(is_polygon ? add_line(part, role) : add_geometry(part));
      // if the outer ring is degenerate, its holes are, too
      if (is_polygon && (set_.lines.empty() || set_.lines.back().polygon != set_.polygons)) return {};
    }
    if (is_polygon && OGR_G_GetGeometryCount(geometry) > 0) ++set_.polygons;
    return {};
  }

  Result<void> add_line(OGRGeometryH geometry, LineRole role) {
    const int count = OGR_G_GetPointCount(geometry);
    if (count == 0) return {};
    Line line;
    line.role = role;
    line.points.resize(static_cast<std::size_t>(count));
    constexpr int kStride = sizeof(line.points[0]);
    double* first = line.points[0].data();
    OGR_G_GetPoints(geometry, first, kStride, first + 1, kStride, first + 2, kStride);
    const bool has_z = OGR_G_Is3D(geometry) != 0;
    if (has_z && !ignore_z_ && !height_) find_unknown(line);
    std::size_t kept = 0;
    for (const auto& [x, y, given_z] : line.points) {
      const double z = ignore_z_ ? kUnknown : height_ ? *height_ : has_z ? given_z : kUnknown;
      if (!std::isfinite(x) || !std::isfinite(y) || std::isinf(z))
        return fail(ErrorKind::kInput, fmt::format("{} has a vertex with x {}, y {}, z {}, which are not all finite: "
                                                   "remove that vertex",
                                                   name_, x, y, given_z));
      const std::array<double, 3> point{x, y, z};
      if (kept == 0 || !is_same(line.points[kept - 1], point)) line.points[kept++] = point;
    }
    if (kept < (line.is_ring() ? 4 : 2)) {
      ++without_extent_;
      return {};
    }
    line.points.resize(kept);
    line.polygon = line.is_ring() ? set_.polygons : kNoPolygon;
    line.name = name_;
    set_.lines.push_back(std::move(line));
    return {};
  }

  void find_unknown(Line& line) {
    const auto is_unknown = [](const std::array<double, 3>& place) { return std::isnan(place[2]); };
    const auto first = std::find_if(line.points.begin(), line.points.end(), is_unknown) - line.points.begin();
    const std::uint64_t filled = io::fill_heights(line.points, line.is_ring());
    if (filled > 0 && filled_ == 0) first_filled_ = fmt::format("vertex {} of {}", first + 1, name_);
    filled_ += filled;
  }

  static bool is_same(const std::array<double, 3>& a, const std::array<double, 3>& b) {
    return a[0] == b[0] && a[1] == b[1] && (a[2] == b[2] || (std::isnan(a[2]) && std::isnan(b[2])));
  }

  std::optional<int> height_field_;
  bool ignore_z_;
  LineSet& set_;
  std::string prefix_, name_;
  std::optional<double> height_;  ///< height of the current feature, if from an attribute
  std::uint64_t filled_ = 0;      ///< number of vertices with filled-in heights
  std::string first_filled_;
  std::uint64_t points_ = 0, without_geometry_ = 0, without_extent_ = 0;
};

Result<void> transform(const Crs& from, const Crs& to, LineSet& set) {
  const auto way = build_transform(from, to);
  const auto refuse = [&](const std::string& culprit) {
    return fail(
        ErrorKind::kInput,
        fmt::format("{} in {} (from {}): cut the lines to where the input lies, or declare their CRS (GeoJSON: WGS 84)",
                    culprit, short_name(to), short_name(from)));
  };
  if (!way) return refuse(set.path + ": nothing has a place");
  constexpr std::size_t kBatch = 1 << 16;  // vertices; a batch ends only between lines
  std::vector<double> x, y;
  for (std::size_t first = 0, last = 0; first < set.lines.size(); first = last) {
    x.clear();
    y.clear();
    for (; last < set.lines.size() && x.size() < kBatch; ++last) {
      for (const auto& point : set.lines[last].points) {
        x.push_back(point[0]);
        y.push_back(point[1]);
      }
    }
    way->apply(x, y);
    std::size_t at = 0;
    for (std::size_t k = first; k < last; ++k) {
      for (auto& point : set.lines[k].points) {
        if (!std::isfinite(x[at]) || !std::isfinite(y[at]))
          return refuse(
              fmt::format("{}: its vertex at {:.9g}, {:.9g} has no place", set.lines[k].name, point[0], point[1]));
        point[0] = x[at];
        point[1] = y[at++];
      }
    }
  }
  return {};
}

Result<void> place(const Crs& crs, const std::string& wanted, LineSet& set) {
  if (wanted.empty()) return {};
  const Crs to = find_crs(wanted);
  if (!to) return fail(ErrorKind::kUsage, fmt::format("'{}' is no CRS that GDAL knows", wanted));
  if (!crs) {
    set.warnings.push_back(
        fmt::format("{} has no CRS; its coordinates are taken to be in {}", set.path, short_name(to)));
    return {};
  }
  if (same_crs(crs, to)) return {};
  return transform(crs, to, set);
}

/// Converts heights in a known unit to units of `unit_in_metres`.
void convert_heights(OGRLayerH layer, std::optional<int> height_field, double unit_in_metres, LineSet& set) {
  io::HeightUnit unit = space_crs_of(declared_layer_crs(layer)).unit;
  const char* field =
      height_field ? OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(OGR_L_GetLayerDefn(layer), *height_field)) : "";
  if (const std::string named = io::unit_named_in(field); !named.empty())
    unit = {named, io::find_metres(named).value_or(0)};
  const double factor = unit.metres / unit_in_metres;
  if (unit.metres == 0 || factor == 1) return;
  bool has_heights = false;
  for (Line& line : set.lines) {
    for (auto& point : line.points) {
      has_heights = has_heights || !std::isnan(point[2]);
      point[2] *= factor;
    }
  }
  if (has_heights)
    set.warnings.push_back(
        fmt::format("{}: heights in {} are multiplied by {:.10g}, for the unit of the raster's heights", set.path,
                    unit.name, factor));
}

Result<LineSet> read(const std::string& path, const ReadLinesOptions& options, double unit_in_metres) {
  Session session(is_remote(path));
  const NamedLayer named = split_layer(path);
  if (io::is_landxml(named.file)) {
    SCARP_TRY(auto&& set, read_landxml_lines(session, named.file, named.layer, options));
    SCARP_RETURN_IF_ERROR(place(set.crs.empty() ? nullptr : find_crs(set.crs), options.crs, set));
    return std::move(set);
  }
  SCARP_TRY(const auto& opened, open(session, named));
  SCARP_TRY(const auto& found, find_layer(opened));
  OGRLayerH layer = found.open();
  std::optional<int> height_field;
  if (!options.z_field.empty()) {
    SCARP_TRY(height_field, find_field(layer, opened.path, options.z_field));
  }

  LineSet set;
  set.path = opened.path;
  set.layer = found.name;
  set.format = GDALGetDriverShortName(GDALGetDatasetDriver(opened.dataset.get()));
  LineCollector collector(height_field, options.ignore_z, set);
  SCARP_RETURN_IF_ERROR(each_feature(session, layer, set.path, options.progress,
                                     [&](OGRFeatureH feature) { return collector.add(feature); }));
  if (set.lines.empty())
    return fail(ErrorKind::kInput, fmt::format("{}: the layer {} holds no lines or polygons", set.path, set.layer));
  collector.warn();
  if (unit_in_metres > 0 && !options.ignore_z) convert_heights(layer, height_field, unit_in_metres, set);
  const Crs crs = layer_crs(layer);
  set.crs = crs_name(crs);
  SCARP_RETURN_IF_ERROR(place(crs, options.crs, set));
  for (const std::string& warning : session.warnings()) set.warnings.push_back("GDAL: " + warning);
  return set;
}

}  // namespace
}  // namespace scarp::gdal

namespace scarp::io {

Result<LineSet> read_lines_in(const std::string& path, const ReadLinesOptions& options, double unit_in_metres) try {
  return gdal::read(path, options, unit_in_metres);
} catch (...) {
  return caught(ErrorKind::kInput, "read " + path);
}

}  // namespace scarp::io
