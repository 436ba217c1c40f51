#include "io/gdal/crs.h"

#include <cpl_conv.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <vector>

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

struct DestroyTransformation {
  void operator()(OGRCoordinateTransformationH handle) const { OCTDestroyCoordinateTransformation(handle); }
};
using Handle = std::unique_ptr<std::remove_pointer_t<OGRCoordinateTransformationH>, DestroyTransformation>;

/// A handle serves one call at a time; idle ones wait in a pool, and a new one is made when all are out.
class ProjTransform final : public PointTransform {
 public:
  ProjTransform(const Crs& from, const Crs& to) : from_(OSRClone(from.get())), to_(OSRClone(to.get())) {}

  /// False if PROJ knows no way.
  bool usable() const {
    Handle handle = take();
    if (!handle) return false;
    give_back(std::move(handle));
    return true;
  }

  bool apply(std::span<double> x, std::span<double> y) const override {
    if (x.empty()) return true;
    Session quiet;
    Handle handle = take();
    bool all = handle != nullptr;
    constexpr std::size_t kBatch = 4096;
    std::vector<int> success(std::min(x.size(), kBatch));
    for (std::size_t at = 0; handle && at < x.size(); at += kBatch) {
      const std::size_t count = std::min(kBatch, x.size() - at);
      OCTTransformEx(handle.get(), static_cast<int>(count), x.data() + at, y.data() + at, nullptr, success.data());
      for (std::size_t k = 0; k < count; ++k) {
        if (success[k] != 0 && std::isfinite(x[at + k]) && std::isfinite(y[at + k])) continue;
        x[at + k] = y[at + k] = std::numeric_limits<double>::quiet_NaN();
        all = false;
      }
    }
    if (handle) {
      give_back(std::move(handle));
    } else {
      std::fill(x.begin(), x.end(), std::numeric_limits<double>::quiet_NaN());
      std::fill(y.begin(), y.end(), std::numeric_limits<double>::quiet_NaN());
    }
    return all;
  }

 private:
  Handle take() const {
    const std::lock_guard lock(mutex_);
    if (!idle_.empty()) {
      Handle handle = std::move(idle_.back());
      idle_.pop_back();
      return handle;
    }
    // Left to itself GDAL chooses among PROJ's operations by the mean of the points of a call; PROJ does so point by
    // point.
    Session session;
    session.set_option("OGR_CT_OP_SELECTION", "PROJ");
    return Handle(OCTNewCoordinateTransformation(from_.get(), to_.get()));
  }

  void give_back(Handle handle) const {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(handle));
  }

  Crs from_, to_;
  mutable std::mutex mutex_;
  mutable std::vector<Handle> idle_;
};

}  // namespace

Crs crs_of(GDALDatasetH dataset) { return copy_crs(GDALGetSpatialRef(dataset)); }

Crs copy_crs(OGRSpatialReferenceH borrowed) {
  if (borrowed == nullptr || OSRGetName(borrowed) == nullptr) return nullptr;
  return flattened(OSRClone(borrowed));
}

Crs find_crs(const std::string& definition) {
  const bool is_code = !definition.empty() && definition.find_first_not_of("0123456789") == std::string::npos;
  OGRSpatialReferenceH crs = OSRNewSpatialReference(nullptr);
  if (OSRSetFromUserInput(crs, ((is_code ? "EPSG:" : "") + definition).c_str()) != OGRERR_NONE) {
    OSRDestroySpatialReference(crs);
    return nullptr;
  }
  return flattened(crs);
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

std::shared_ptr<const PointTransform> build_transform(const Crs& from, const Crs& to) {
  auto transform = std::make_shared<ProjTransform>(from, to);
  if (!transform->usable()) return nullptr;
  return transform;
}

}  // namespace scarp::gdal

namespace scarp {

std::optional<CrsDescription> describe_crs(const std::string& crs) {
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

bool is_same_crs(const std::string& a, const std::string& b) {
  if (a == b) return true;
  gdal::Session quiet;
  return gdal::same_crs(gdal::find_crs(a), gdal::find_crs(b));
}

}  // namespace scarp
