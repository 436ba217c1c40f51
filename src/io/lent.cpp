#include "io/lent.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>
#include <vector>

#include "grid/local_frame.h"
#include "io/points/point_heights.h"
#include "io/raster/crs_description.h"
#include "io/raster/height_unit.h"
#include "io/raster/raster_finish.h"

namespace scarp::io {
namespace {

using LentThing = std::variant<const LentRaster*, const Mesh*, const PointSet*>;

std::vector<std::pair<std::string, LentThing>>& lent_things() {
  thread_local std::vector<std::pair<std::string, LentThing>> things;
  return things;
}

template <class T>
const T* find_lent(const std::string& name) {
  const auto& things = lent_things();
  for (auto thing = things.rbegin(); thing != things.rend(); ++thing) {
    if (thing->first != name) continue;
    if (const T* const* found = std::get_if<const T*>(&thing->second)) return *found;
  }
  return nullptr;
}

struct Unfit {
  std::uint64_t nodata = 0, infinities = 0;
};

Unfit count_unfit(const LentRaster& raster) {
  Unfit unfit;
  const std::size_t count = static_cast<std::size_t>(raster.cols) * static_cast<std::size_t>(raster.rows);
  for (std::size_t i = 0; i < count; ++i) {
    const float z = raster.samples[i];
    unfit.nodata += raster.nodata && z == *raster.nodata ? 1 : 0;
    unfit.infinities += std::isinf(z) ? 1 : 0;
  }
  return unfit;
}

/// Copies the samples if any must change. Returns the number of infinities.
std::uint64_t clean_samples(const LentRaster& raster, const ReadOptions& options, OwnedHeightField& field) {
  const Unfit unfit = count_unfit(raster);
  const bool is_changed = scales_heights(options) || options.as_values;  // callers change the values
  if (unfit.nodata == 0 && unfit.infinities == 0 && !is_changed) return 0;
  field.own();
  for (float& z : field.samples) {
    if (std::isinf(z) || (raster.nodata && z == *raster.nodata)) z = std::numeric_limits<float>::quiet_NaN();
  }
  return unfit.infinities;
}

}  // namespace

Lent::Lent(std::string name, const LentRaster& raster) { lent_things().emplace_back(std::move(name), &raster); }
Lent::Lent(std::string name, const Mesh& mesh) { lent_things().emplace_back(std::move(name), &mesh); }
Lent::Lent(std::string name, const PointSet& points) { lent_things().emplace_back(std::move(name), &points); }
Lent::~Lent() { lent_things().pop_back(); }

const LentRaster* find_lent_raster(const std::string& name) { return find_lent<LentRaster>(name); }
const Mesh* find_lent_mesh(const std::string& name) { return find_lent<Mesh>(name); }
const PointSet* find_lent_points(const std::string& name) { return find_lent<PointSet>(name); }

Result<PointSet> read_lent_points(const PointSet& lent, const std::string& name, const ReadPointsOptions& options) {
  for (const auto& [option, value] : {std::pair{"--layer", &options.layer}, std::pair{"--z-field", &options.z_field},
                                      std::pair{"--columns", &options.columns}}) {
    if (!value->empty())
      return fail(ErrorKind::kUsage,
                  fmt::format("{} is about files, and {} are in memory: leave it out", option, name));
  }
  if (options.choice != PointChoice())
    return fail(ErrorKind::kUsage,
                fmt::format("--class and --returns are about LAS files, and {} are in memory: leave them out", name));
  if (lent.size() == 0) return fail(ErrorKind::kInput, name + ": there are no points");
  const bool needs_crs = !options.crs.empty() && options.crs != "source" && options.crs != "grid";
  if (needs_crs && lent.crs.empty() && !lent.is_geographic)
    return fail(ErrorKind::kUsage,
                fmt::format("{}: these points have no CRS, so their coordinates cannot be given in '{}': ask for "
                            "'source', or give crs with them",
                            name, options.crs));
  PointSet points = lent;
  points.path = name;
  if (options.nodata) {
    SCARP_RETURN_IF_ERROR(leave_out_nodata(*options.nodata, points));
  }
  SCARP_RETURN_IF_ERROR(crop(options, points));
  SCARP_TRY(const auto& vertical, place_lent_points(options, points));
  SCARP_RETURN_IF_ERROR(settle_point_heights(options, vertical, points));
  return points;
}

Result<OwnedHeightField> read_lent_raster(const LentRaster& raster, const std::string& name,
                                          const ReadOptions& options) {
  if (options.band != 1) return fail(ErrorKind::kInput, name + " has 1 band: leave the band out");
  if (options.decode != Decode::kNone || !options.view.is_whole())
    return fail(ErrorKind::kUsage, name + " is in memory: decode it, and cut or join it, before it is given");
  if (raster.cols < 0 || raster.rows < 0)
    return fail(ErrorKind::kInput,
                fmt::format("{}: {} x {} samples: neither number can be negative", name, raster.cols, raster.rows));
  const auto size = [](int side) { return static_cast<std::uint64_t>(side); };
  SCARP_RETURN_IF_ERROR(check_raster_sides(name, size(raster.cols), size(raster.rows)));
  if (raster.samples == nullptr) return fail(ErrorKind::kUsage, name + " has no samples: its pointer is null");
  OwnedHeightField field;
  field.cols = raster.cols;
  field.rows = raster.rows;
  field.lent = raster.samples;
  field.sample_rounding = raster.sample_rounding;
  field.info.path = name;
  field.info.format = "memory";
  field.info.sample_type = "Float32";
  field.info.unit = raster.unit;
  field.info.crs = raster.crs;
  field.info.is_geographic = raster.is_geographic;
  field.info.nodata = options.nodata;
  LentRaster read = raster;
  if (options.nodata) read.nodata = static_cast<float>(*options.nodata);
  if (read.nodata) field.info.nodata = *read.nodata;
  if (raster.geotransform) {
    const auto& gt = *raster.geotransform;
    field.info.geotransform = gt;
    field.info.has_georeference = true;
    field.info.cell_x = std::sqrt(gt[1] * gt[1] + gt[4] * gt[4]);
    field.info.cell_y = std::sqrt(gt[2] * gt[2] + gt[5] * gt[5]);
    if (grid::is_degenerate(gt))
      return fail(ErrorKind::kInput, name + ": its transform maps the samples to a line or to infinity");
    if (!raster.is_geographic && options.crs != "grid" && looks_like_degrees(gt, raster.cols, raster.rows) &&
        !describe_crs(raster.crs)) {
      field.info.warnings.push_back(
          name +
          " has no CRS that is known here, but its coordinates look like degrees, which do not mix with heights: if "
          "so, give their CRS, such as EPSG:4326");
    }
  }
  const bool is_placed = raster.geotransform.has_value(),
             needs_place = !options.crs.empty() && options.crs != "grid" && options.crs != "local";
  if (!is_placed && needs_place)
    return fail(ErrorKind::kUsage,
                fmt::format("{} has no georeference, so its coordinates cannot be given in '{}': ask for 'grid' or "
                            "'local', or give transform and crs with the samples",
                            name, options.crs));
  SCARP_TRY(field.frame, is_placed ? place_lent_raster(raster, options, field.info)
                                   : ungeoreferenced_frame(name, raster.cols, raster.rows, options));
  SCARP_TRY(const auto& settled, settle_heights(options, field.frame, field.info));
  const std::uint64_t infinities = clean_samples(read, settled, field);
  scale_values(settled, field);
  SCARP_RETURN_IF_ERROR(finish_raster(field, infinities, options));
  return field;
}

}  // namespace scarp::io
