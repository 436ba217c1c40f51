#include "io/gdal/crs.h"

#include <cpl_conv.h>
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "io/gdal/cf_axes.h"
#include "io/gdal/session.h"
#include "io/raster/crs_description.h"
#include "io/raster/raster_source.h"
#include "scarp/io.h"

namespace scarp::gdal {
namespace {

Crs flattened(OGRSpatialReferenceH crs) {
  OSRStripVertical(crs);
  if (OSRGetAxesCount(crs) == 3) OSRDemoteTo2D(crs, nullptr);
  OSRSetAxisMappingStrategy(crs, OAMS_TRADITIONAL_GIS_ORDER);
  return Crs(crs);
}

class MapTransform final : public PointTransform {
 public:
  MapTransform(const Crs& from, const Crs& to) : passage_(from, to) {}
  bool usable() const { return passage_.usable(); }
  bool apply(std::span<double> x, std::span<double> y) const override { return passage_.apply(x, y, {}); }

 private:
  Passage passage_;
};

}  // namespace

Crs declared_crs(GDALDatasetH dataset) {
  if (const OGRSpatialReferenceH borrowed = GDALGetSpatialRef(dataset)) return Crs(OSRClone(borrowed));
  return is_in_degrees(dataset) ? find_crs("EPSG:4326") : nullptr;
}

Crs crs_of(GDALDatasetH dataset) { return copy_crs(declared_crs(dataset).get()); }

Crs copy_crs(OGRSpatialReferenceH borrowed) {
  if (borrowed == nullptr || OSRGetName(borrowed) == nullptr) return nullptr;
  return flattened(OSRClone(borrowed));
}

Crs find_declared_crs(const std::string& definition) {
  const bool is_code = !definition.empty() && definition.find_first_not_of("0123456789") == std::string::npos;
  OGRSpatialReferenceH crs = OSRNewSpatialReference(nullptr);
  if (OSRSetFromUserInput(crs, ((is_code ? "EPSG:" : "") + definition).c_str()) != OGRERR_NONE) {
    OSRDestroySpatialReference(crs);
    return nullptr;
  }
  return Crs(crs);
}

Result<Crs> find_crs_of(const std::string& name, const std::string& definition) {
  if (definition.empty()) return Crs();
  Crs crs = find_declared_crs(definition);
  if (crs) return crs;
  return fail(ErrorKind::kUsage,
              fmt::format("the CRS of {}, '{}', is none that GDAL knows: give a code such as EPSG:32633, WKT or a PROJ "
                          "string",
                          name, definition));
}

Crs find_crs(const std::string& definition) {
  Crs crs = find_declared_crs(definition);
  return crs ? flattened(crs.release()) : nullptr;
}

std::string crs_name(const Crs& crs) {
  if (!crs) return {};
  const Crs identified(OSRClone(crs.get()));
  if (OSRGetAuthorityCode(identified.get(), nullptr) == nullptr) OSRAutoIdentifyEPSG(identified.get());
  const char* authority = OSRGetAuthorityName(identified.get(), nullptr);
  const char* code = OSRGetAuthorityCode(identified.get(), nullptr);
  if (authority != nullptr && code != nullptr) return std::string(authority) + ":" + code;
  char* wkt = nullptr;
  std::string name;
  if (OSRExportToWkt(crs.get(), &wkt) == OGRERR_NONE && wkt != nullptr) name = wkt;
  CPLFree(wkt);
  return name;
}

std::string wkt_with_heights(const Crs& crs) {
  const char* options[] = {"FORMAT=WKT2_2019", nullptr};
  char* wkt = nullptr;
  std::string text;
  if (crs && OSRExportToWktEx(crs.get(), &wkt, options) == OGRERR_NONE && wkt != nullptr) text = wkt;
  CPLFree(wkt);
  return text;
}

std::string name_with_heights(const Crs& crs) {
  if (!crs) return {};
  const auto code_of = [&](const char* part) {
    const char* authority = OSRGetAuthorityName(crs.get(), part);
    const char* code = OSRGetAuthorityCode(crs.get(), part);
    return authority != nullptr && EQUAL(authority, "EPSG") && code != nullptr ? std::string(code) : std::string();
  };
  if (OSRIsCompound(crs.get()) == 0) return code_of(nullptr).empty() ? "" : "EPSG:" + code_of(nullptr);
  const std::string map = code_of(OSRIsProjected(crs.get()) != 0 ? "PROJCS" : "GEOGCS"), heights = code_of("VERT_CS");
  return map.empty() || heights.empty() ? "" : "EPSG:" + map + "+" + heights;
}

std::string short_name(const Crs& crs) {
  const std::string name = crs_name(crs);
  if (name.size() < 40) return name;
  const char* title = OSRGetName(crs.get());
  return title != nullptr ? title : "unnamed CRS";
}

bool same_crs(const Crs& a, const Crs& b) {
  const char* options[] = {"IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES", nullptr};
  return a && b && OSRIsSameEx(a.get(), b.get(), options) != 0;
}

Result<void> verify_degrees(const Crs& crs, const std::array<double, 2>& centre, const std::string& path,
                            const std::string& way) {
  if (!crs || OSRIsGeographic(crs.get()) == 0) return {};
  constexpr double kFarthest = 4 * std::numbers::pi, kHighest = 5 * std::numbers::pi / 9;  // 720 and 100 degrees
  char* unit = nullptr;                                                                    // owned by the CRS
  const double radians = OSRGetAngularUnits(crs.get(), &unit);
  const auto [x, y] = centre;
  if (std::abs(x) * radians <= kFarthest && std::abs(y) * radians <= kHighest) return {};
  return fail(ErrorKind::kInput,
              fmt::format("{}: its CRS, {}, has the unit {}, but its middle lies at {:.9g}, {:.9g}, which is no place "
                          "there: that is the wrong CRS; name the one that x and y are in{}",
                          path, short_name(crs), unit != nullptr ? unit : "degree", x, y,
                          way.empty() ? "" : fmt::format(" first ({})", way)));
}

std::shared_ptr<const PointTransform> build_transform(const Crs& from, const Crs& to) {
  auto transform = std::make_shared<MapTransform>(from, to);
  if (!transform->usable()) return nullptr;
  return transform;
}

}  // namespace scarp::gdal

namespace scarp {

bool io::can_describe_crs() { return true; }

std::optional<io::CrsDescription> io::describe_crs(const std::string& crs) {
  gdal::Session quiet;
  const gdal::Crs known = gdal::find_crs(crs);
  if (!known) return {};
  CrsDescription description;
  const char* name = OSRGetName(known.get());
  description.name = name != nullptr ? name : "";
  constexpr std::string_view kEpsg = "EPSG:";
  if (const std::string code = gdal::crs_name(known); code.starts_with(kEpsg)) {
    description.epsg = code.substr(kEpsg.size());
  }
  const char* options[] = {"FORMAT=WKT1_GDAL", nullptr};
  char* wkt = nullptr;
  if (OSRExportToWktEx(known.get(), &wkt, options) == OGRERR_NONE && wkt != nullptr) description.wkt = wkt;
  CPLFree(wkt);
  description.is_geographic = OSRIsGeographic(known.get()) != 0;
  if (!description.is_geographic) description.unit_in_metres = OSRGetLinearUnits(known.get(), nullptr);
  return description;
}

std::optional<std::string> projection_text(const std::string& crs) {
  gdal::Session quiet;
  const gdal::Crs known = crs.empty() ? nullptr : gdal::find_crs(crs);
  if (!known) return {};
  const char* options[] = {"FORMAT=WKT1_ESRI", nullptr};
  char* wkt = nullptr;
  std::optional<std::string> text;
  if (OSRExportToWktEx(known.get(), &wkt, options) == OGRERR_NONE && wkt != nullptr) text = wkt;
  CPLFree(wkt);
  return text;
}

std::optional<std::array<double, 2>> find_degrees(const std::string& crs, double x, double y) {
  gdal::Session quiet;
  const gdal::Crs from = gdal::find_crs(crs);
  if (!from) return {};
  const gdal::Crs own = gdal::copy_crs(gdal::Crs(OSRCloneGeogCS(from.get())).get());
  for (const gdal::Crs& to : {gdal::find_crs("EPSG:4326"), gdal::copy_crs(own.get())}) {
    const auto transform = to ? gdal::build_transform(from, to) : nullptr;
    if (transform && transform->apply({&x, 1}, {&y, 1}) && std::isfinite(x) && std::isfinite(y)) return {{x, y}};
  }
  return {};
}

bool io::is_same_crs(const std::string& a, const std::string& b) {
  if (a == b) return true;
  gdal::Session quiet;
  return gdal::same_crs(gdal::find_crs(a), gdal::find_crs(b));
}

}  // namespace scarp
