// An image on the globe, read box by box.
#include "io/globe_image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include "base/caught.h"
#include "io/commands.h"
#include "io/gdal/georeference.h"
#include "io/gdal/warp_image.h"

namespace scarp::gdal {
namespace {

/// Larger differences of radii mean different planets.
constexpr double kSamePlanet = 0.01;

/// Pixels first … end − 1 along a side that intersect or touch the span.
std::pair<int, int> pixels_within(double start, double step, int side, double from, double to) {
  const auto pixel = [&](double at) { return std::clamp(at, 0.0, static_cast<double>(side)); };
  return {static_cast<int>(pixel(std::floor((from - start) / step))),
          static_cast<int>(pixel(std::ceil((to - start) / step)))};
}

/// A copy that does not depend on `image`.
Result<Dataset> arrange(Session& session, GDALDatasetH image, const std::string& path) {
  SCARP_TRY(const auto& arranged, arrange_bands(session, image, path, true));
  return open_virtual(session, arranged.get(), path);
}

class WarpedImage final : public io::GlobeImage {
 public:
  WarpedImage(std::string path, Crs degrees) : path_(std::move(path)), degrees_(std::move(degrees)) {}

  /// Sets the image's position. Fails with kInput.
  Result<void> find_place(const Georeference& geo) {
    auto to_degrees = build_transform(geo.crs, degrees_);
    if (!to_degrees)
      return fail(ErrorKind::kInput,
                  fmt::format("{}: PROJ knows no way from {} to longitude and latitude", path_, short_name(geo.crs)));
    HeightField field;
    field.cols = geo.cols;
    field.rows = geo.rows;
    const auto covered = degrees_covered(field, geo.samples, to_degrees.get());
    if (!covered) return fail(ErrorKind::kInput, fmt::format("{}: {}", path_, covered.error().message));
    covered_ = *covered;
    per_degree_ = {geo.cols / (covered_.east - covered_.west), geo.rows / (covered_.north - covered_.south)};
    return {};
  }
  void keep(Dataset image) const {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(image));
  }

  DegreeBox covered() const override { return covered_; }
  std::array<double, 2> per_degree() const override { return per_degree_; }

  Result<std::optional<Picture>> read(const DegreeBox& box, int side,
                                      const std::array<std::uint8_t, 3>& ground) const override try {
    Session session(is_remote(path_));
    SCARP_TRY(auto&& image, take(session));
    Picture picture{side, side, {}};
    for (int k = 0; k < side * side; ++k) picture.rgb.insert(picture.rgb.end(), ground.begin(), ground.end());
    bool has_colour = false;
    for (const double turn : {0.0, -360.0, 360.0}) {
      SCARP_TRY(const auto& laid,
                lay(session, image.get(), {box.west + turn, box.south, box.east + turn, box.north}, picture));
      has_colour |= laid;
    }
    keep(std::move(image));
    if (!has_colour) return std::optional<Picture>();
    return std::optional(std::move(picture));
  } catch (...) {
    return caught(ErrorKind::kInput, "read " + path_);
  }

 private:
  /// The open image, for one thread.
  Result<Dataset> take(Session& session) const {
    {
      const std::lock_guard lock(mutex_);
      if (!idle_.empty()) {
        Dataset image = std::move(idle_.back());
        idle_.pop_back();
        return image;
      }
    }
    SCARP_TRY(auto&& opened, open_raster(session, path_));
    return arrange(session, opened.get(), path_);
  }

  /// Warps the image to the box's picture; true if it has colour there.
  Result<bool> lay(Session& session, GDALDatasetH image, const DegreeBox& box, Picture& picture) const {
    const int side = picture.width;
    const double east = (box.east - box.west) / side, south = (box.north - box.south) / side;
    const auto [left, right] = pixels_within(box.west, east, side, covered_.west, covered_.east);
    const auto [top, bottom] = pixels_within(-box.north, south, side, -covered_.north, -covered_.south);
    if (left >= right || top >= bottom) return false;
    const int width = right - left, height = bottom - top;
    const Transform6 place{box.west + left * east, width * east, 0, box.north - top * south, 0, -height * south};
    const Dataset target = make_target(place, degrees_, width, height);
    if (!target) return fail(ErrorKind::kInput, fmt::format("{}: {}", path_, session.reason()));
    session.clear();
    SCARP_RETURN_IF_ERROR(warp(session, image, target.get(), path_, {}));
    SCARP_TRY(const auto& pixels, take_pixels(session, target.get(), path_));
    bool has_colour = false;
    for (int row = 0; row < height; ++row) {
      for (int col = 0; col < width; ++col) {
        const auto from =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(col);
        if (pixels.alpha[from] == 0) continue;
        const auto to =
            static_cast<std::size_t>(row + top) * static_cast<std::size_t>(side) + static_cast<std::size_t>(col + left);
        std::copy_n(&pixels.picture.rgb[3 * from], 3, &picture.rgb[3 * to]);
        has_colour = true;
      }
    }
    return has_colour;
  }

  std::string path_;
  Crs degrees_;
  DegreeBox covered_ = {};
  std::array<double, 2> per_degree_{};
  mutable std::mutex mutex_;
  mutable std::vector<Dataset> idle_;
};

Result<std::shared_ptr<const io::GlobeImage>> open(const std::string& path, const Geodetic& ellipsoid) {
  Session session(is_remote(path));
  SCARP_TRY(auto&& image, open_raster(session, path));
  SCARP_TRY(const auto& geo, read_georeference(image.get(), path));
  if (!geo.located || !geo.crs)
    return fail(ErrorKind::kInput,
                fmt::format("{} does not say where on the globe it lies: give it a position and a CRS ({})", path,
                            io::translate_command("-a_srs EPSG:4326 -a_ullr WEST NORTH EAST SOUTH", path)));
  const double radius = OSRGetSemiMajor(geo.crs.get(), nullptr);
  if (!(std::abs(radius / ellipsoid.semi_major - 1) <= kSamePlanet))
    return fail(ErrorKind::kInput, fmt::format("{} lies on a planet of {:.0f} m, and the tiles on one of {:.0f} m",
                                               path, radius, ellipsoid.semi_major));
  const bool is_earth = ellipsoid.semi_major == Geodetic{}.semi_major;
  const Crs own(is_earth ? nullptr : OSRCloneGeogCS(geo.crs.get()));
  auto opened = std::make_shared<WarpedImage>(path, is_earth ? find_crs("EPSG:4326") : copy_crs(own.get()));
  SCARP_RETURN_IF_ERROR(opened->find_place(geo));
  SCARP_TRY(auto&& arranged, arrange(session, image.get(), path));
  opened->keep(std::move(arranged));
  return opened;
}

}  // namespace
}  // namespace scarp::gdal

namespace scarp::io {

Result<std::shared_ptr<const GlobeImage>> open_globe_image(const std::string& path, const Geodetic& ellipsoid) try {
  return gdal::open(path, ellipsoid);
} catch (...) {
  return caught(ErrorKind::kInput, "read " + path);
}

}  // namespace scarp::io
