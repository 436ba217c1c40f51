// Frames in space.
//
// Heights are above the ellipsoid. PROJ applies a geoid if the raster's CRS names one and its grid is on this machine;
// otherwise heights are used unchanged, with a warning.
//
// The tangent frame is the earth-centred one, moved to the raster's centre on the ellipsoid and rotated, so bounds
// proven in one hold in the other.
#include "io/gdal/earth_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "io/commands.h"
#include "io/gdal/georeference.h"
#include "io/gdal/session.h"

namespace scarp::gdal {
namespace {

using Vector = std::array<double, 3>;

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector unit(const Vector& a) {
  const double length = std::sqrt(dot(a, a));
  return {a[0] / length, a[1] / length, a[2] / length};
}

/// Length of a vertical step, in metres; large relative to the rounding of coordinates.
constexpr double kRise = 1000;

struct Points {
  std::vector<double> x, y, z;

  void add(double px, double py, double pz) {
    x.push_back(px);
    y.push_back(py);
    z.push_back(pz);
  }
  Vector at(std::size_t k) const { return {x[k], y[k], z[k]}; }
};

struct Axes {
  Vector origin{}, east{1, 0, 0}, north{0, 1, 0}, up{0, 0, 1};
};

class EarthTransform final : public SpaceTransform {
 public:
  /// `turn`: a whole turn in units of x, if x is a longitude; else 0. `up`: metres per unit of heights in `from`.
  EarthTransform(const Crs& from, const Crs& earth, bool is_strict, double centre_x, double turn, double up)
      : forth_(from, earth, is_strict), back_(earth, from, is_strict), centre_x_(centre_x), turn_(turn), up_(up) {}

  bool usable() const { return forth_.usable() && back_.usable(); }
  /// Selects the tangent frame of the axes, or earth-centred positions.
  void settle(const Axes& axes, bool is_tangent) {
    axes_ = axes;
    is_tangent_ = is_tangent;
  }

  bool to_space(std::span<double> x, std::span<double> y, std::span<double> z) const override {
    for (double& height : up_ != 1 ? z : std::span<double>()) height /= up_;
    const bool all = forth_.apply(x, y, z);
    for (std::size_t k = 0; is_tangent_ && k < x.size(); ++k) {
      const Vector away = minus({x[k], y[k], z[k]}, axes_.origin);
      x[k] = dot(away, axes_.east);
      y[k] = dot(away, axes_.north);
      z[k] = dot(away, axes_.up);
    }
    return all;
  }
  bool from_space(std::span<double> x, std::span<double> y, std::span<double> z) const override {
    for (std::size_t i = 0; is_tangent_ && i < x.size(); ++i) {
      const Vector at{x[i], y[i], z[i]};
      const auto sum = [&](std::size_t k) {
        return axes_.origin[k] + (at[0] * axes_.east[k] + at[1] * axes_.north[k] + at[2] * axes_.up[k]);
      };
      x[i] = sum(0);
      y[i] = sum(1);
      z[i] = sum(2);
    }
    const bool all = back_.apply(x, y, z);
    for (double& longitude : turn_ > 0 ? x : std::span<double>())
      longitude = centre_x_ + std::remainder(longitude - centre_x_, turn_);
    for (double& height : up_ != 1 ? z : std::span<double>()) height *= up_;
    return all;
  }
  /// Whole metres, so that the sum with a float32 offset is exactly a double.
  Vector origin() const override {
    if (is_tangent_) return {0, 0, 0};
    return {std::nearbyint(axes_.origin[0]), std::nearbyint(axes_.origin[1]), std::nearbyint(axes_.origin[2])};
  }
  Vector up() const override { return is_tangent_ ? Vector{0, 0, 1} : axes_.up; }
  std::array<double, 12> to_earth() const override {
    const auto& [o, e, n, u] = axes_;
    if (!is_tangent_) return {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    return {e[0], n[0], u[0], o[0], e[1], n[1], u[1], o[1], e[2], n[2], u[2], o[2]};
  }

 private:
  Passage forth_, back_;
  double centre_x_, turn_, up_;
  Axes axes_;
  bool is_tangent_ = false;
};

Crs find_geocentric(const std::string& definition) {
  const bool is_code = !definition.empty() && definition.find_first_not_of("0123456789") == std::string::npos;
  Crs crs(OSRNewSpatialReference(nullptr));
  if (OSRSetFromUserInput(crs.get(), ((is_code ? "EPSG:" : "") + definition).c_str()) != OGRERR_NONE) return nullptr;
  return OSRIsGeocentric(crs.get()) != 0 ? std::move(crs) : nullptr;
}

/// The geocentric CRS of the raster's own ellipsoid, for other planets and for a datum of unknown position.
Crs own_geocentric(const Georeference& geo) {
  OGRErr error = OGRERR_NONE;
  const double a = OSRGetSemiMajor(geo.crs.get(), &error), rf = OSRGetInvFlattening(geo.crs.get(), &error);
  const std::string shape = rf > 0 ? fmt::format("+a={:.17g} +rf={:.17g}", a, rf) : fmt::format("+R={:.17g}", a);
  return find_geocentric("+proj=geocent " + shape + " +units=m +no_defs");
}

/// Null if PROJ knows no conversion for the raster's centre.
std::shared_ptr<EarthTransform> find_way(const Georeference& geo, const Crs& from, const Crs& earth, bool is_strict,
                                         double up = 1) {
  const double turn = geo.geographic ? 2 * std::numbers::pi / geo.unit_in_metres : 0;
  const auto [x, y] = geo.centre();
  auto way = std::make_shared<EarthTransform>(from, earth, is_strict, x, turn, up);
  Points centre;
  centre.add(x, y, 0);
  if (!way->usable() || !way->to_space(centre.x, centre.y, centre.z)) return nullptr;
  return way;
}

/// East, north and up at the raster's centre; at a pole, those of longitude 0.
Axes axes_of(const EarthTransform& way, const Georeference& geo) {
  const auto [x, y] = geo.centre();
  Points ends;
  ends.add(x, y, 0);
  ends.add(x, y, kRise);
  way.to_space(ends.x, ends.y, ends.z);
  Axes axes;
  axes.origin = ends.at(0);
  axes.up = unit(minus(ends.at(1), ends.at(0)));
  const Vector east = cross({0, 0, 1}, axes.up);
  constexpr double kPole = 1e-9;
  axes.east = dot(east, east) < kPole * kPole ? Vector{0, 1, 0} : unit(east);
  axes.north = cross(axes.up, axes.east);
  return axes;
}

/// Checks a net of points over the raster, including its edges. Fails with kUsage unless the net is within 60 degrees
/// of the raster's centre, keeps one orientation, and is recovered by the inverse conversion. If x is a longitude, the
/// net must also span less than half a turn.
Result<void> verify(const EarthTransform& way, const Axes& axes, const Georeference& geo, const std::string& path) {
  constexpr int kNet = 32;
  constexpr double kLeastCosine = 0.5, kBack = 1.0 / 1024;
  const int across = std::min(kNet, geo.cols - 1), down = std::min(kNet, geo.rows - 1);
  const auto stride = static_cast<std::size_t>(across) + 1, count = stride * (static_cast<std::size_t>(down) + 1);
  const auto& a = geo.samples;
  Points map, top;
  for (const double height : {0.0, kRise}) {
    for (int j = 0; j <= down; ++j) {
      for (int i = 0; i <= across; ++i) {
        const double col = (geo.cols - 1.0) * i / across, row = (geo.rows - 1.0) * j / down;
        (height == 0 ? map : top).add(a[0] + a[1] * col + a[2] * row, a[3] + a[4] * col + a[5] * row, height);
      }
    }
  }
  Points foot = map;
  if (!way.to_space(foot.x, foot.y, foot.z) || !way.to_space(top.x, top.y, top.z))
    return fail(ErrorKind::kUsage,
                fmt::format("{}: parts of the raster have no place on the earth in {}; cut them off with --te", path,
                            short_name(geo.crs)));
  for (std::size_t k = 0; k < count; ++k) {
    if (dot(minus(top.at(k), foot.at(k)), axes.up) / kRise >= kLeastCosine) continue;
    return fail(ErrorKind::kUsage,
                fmt::format("{}: the raster reaches more than 60 degrees away from its centre, where the tangent plane "
                            "shows nothing; take it in parts with --te",
                            path));
  }
  int positive = 0, negative = 0;
  for (std::size_t j = 0; j < static_cast<std::size_t>(down); ++j) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(across); ++i) {
      const std::size_t p = j * stride + i;
      for (const auto& [q, r, s] : {std::array{p, p + 1, p + stride}, std::array{p + 1, p + stride + 1, p + stride}}) {
        const double side =
            dot(cross(minus(foot.at(r), foot.at(q)), minus(foot.at(s), foot.at(q))), minus(top.at(q), foot.at(q)));
        positive += side > 0 ? 1 : 0;
        negative += side < 0 ? 1 : 0;
      }
    }
  }
  Points back = foot;
  bool is_back = way.from_space(back.x, back.y, back.z);
  const double cell_x = std::hypot(a[1], a[2]), cell_y = std::hypot(a[4], a[5]);
  for (std::size_t k = 0; k < count; ++k) {
    is_back =
        is_back && std::abs(back.x[k] - map.x[k]) <= kBack * cell_x && std::abs(back.y[k] - map.y[k]) <= kBack * cell_y;
  }
  const int all = 2 * across * down;
  const bool is_wide =
      geo.geographic && (std::abs(a[1]) * geo.cols + std::abs(a[2]) * geo.rows) * geo.unit_in_metres > std::numbers::pi;
  if ((positive == all || negative == all) && is_back && !is_wide) return {};
  return fail(ErrorKind::kUsage,
              fmt::format("{}: the raster holds a pole or goes more than half around the earth, where places have no "
                          "one column and row; cut that off with --te",
                          path));
}

void warn_of_heights(const Georeference& geo, bool is_applied, RasterInfo& info) {
  const SpaceCrs& crs = geo.in_space;
  if (crs.is_ellipsoidal || is_applied) return;
  const std::string name = crs_name(geo.crs);
  const std::string code = name.starts_with("EPSG:") ? name : "EPSG:CODE";
  info.warnings.push_back(
      crs.vertical.empty()
          ? fmt::format("heights are taken as heights above the ellipsoid of the raster's CRS; if they are above sea "
                        "level, which lies up to 107 m beside it, name their CRS first ({})",
                        io::translate_command("-a_srs " + code + "+5773", info.path))
          : fmt::format("heights are above {}, for which PROJ has no grid on this machine: they are taken as heights "
                        "above the ellipsoid of the raster's CRS",
                        crs.vertical));
}

}  // namespace

SpaceCrs space_crs_of(const Crs& declared) {
  const OGRSpatialReferenceH borrowed = declared.get();
  SpaceCrs space;
  if (borrowed == nullptr || OSRGetName(borrowed) == nullptr) return space;
  space.crs.reset(OSRClone(borrowed));
  if (OSRIsCompound(borrowed) != 0) {
    const char* name = OSRGetAttrValue(borrowed, "COMPD_CS|VERT_CS", 0);
    space.vertical = name != nullptr ? name : "a vertical datum";
    char* unit = nullptr;  // owned by the CRS
    space.unit.metres = OSRGetTargetLinearUnits(borrowed, "COMPD_CS|VERT_CS", &unit);
    if (unit != nullptr) space.unit.name = unit;
    OGRAxisOrientation orientation = OAO_Other;
    OSRGetAxis(borrowed, "COMPD_CS|VERT_CS", 0, &orientation);
    space.is_down = orientation == OAO_Down;
  } else {
    space.is_ellipsoidal = OSRGetAxesCount(borrowed) == 3;
    if (!space.is_ellipsoidal) OSRPromoteTo3D(space.crs.get(), nullptr);
  }
  OSRSetAxisMappingStrategy(space.crs.get(), OAMS_TRADITIONAL_GIS_ORDER);
  return space;
}

Result<Frame> earth_frame(const Georeference& geo, const std::string& wanted, RasterInfo& info) {
  const bool is_tangent = wanted == "enu";
  Crs earth = find_geocentric(is_tangent ? "EPSG:4978" : wanted);
  Crs flat(OSRClone(geo.crs.get()));
  OSRPromoteTo3D(flat.get(), nullptr);
  bool is_applied = !geo.in_space.vertical.empty() && !geo.in_space.is_down;  // z points up now, regardless of the file
  auto way = is_applied ? find_way(geo, geo.in_space.crs, earth, true, geo.in_space.unit.metres) : nullptr;
  if (!way) {
    is_applied = false;
    way = find_way(geo, flat, earth, false);
  }
  if (!way && is_tangent) {
    earth = own_geocentric(geo);
    way = earth ? find_way(geo, flat, earth, false) : nullptr;
  }
  if (!way) {
    return fail(ErrorKind::kUsage, fmt::format("{}: there is no way from {} to {}; choose another CRS", info.path,
                                               short_name(geo.crs), is_tangent ? "earth-centred coordinates" : wanted));
  }
  const Axes axes = axes_of(*way, geo);
  SCARP_RETURN_IF_ERROR(verify(*way, axes, geo, info.path));
  warn_of_heights(geo, is_applied, info);
  way->settle(axes, is_tangent);
  const auto [x, y] = geo.centre();
  const Vector& o = axes.origin;
  Frame frame;
  frame.kind = is_tangent ? Frame::Kind::kTangent : Frame::Kind::kGeocentric;
  frame.affine = geo.samples;
  frame.unit_in_metres = 1;
  if (!is_tangent) frame.crs = crs_name(earth);
  frame.description =
      is_tangent ? fmt::format(
                       "metres east, north and up of {:.9g}, {:.9g} ({}) on the ellipsoid, which lies at "
                       "{:.3f}, {:.3f}, {:.3f} in {}",
                       x, y, short_name(geo.crs), o[0], o[1], o[2], short_name(earth))
                 : fmt::format("earth-centred metres in {}, x to longitude 0, z to the north pole", short_name(earth));
  frame.space = std::move(way);
  return frame;
}

}  // namespace scarp::gdal

namespace scarp {

bool is_in_space(const std::string& crs) {
  if (crs.empty()) return false;
  gdal::Session quiet;
  return crs == "enu" || gdal::find_geocentric(crs) != nullptr;
}

}  // namespace scarp
