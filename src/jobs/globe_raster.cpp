#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "grid/small_voids.h"
#include "io/commands.h"
#include "io/globe_place.h"
#include "io/raster/raster_finish.h"
#include "scarp/io.h"
#include "scarp/lines.h"
#include "scarp/tile.h"
#include "scarp/tile_job.h"
#include "tiles/water/tile_waters.h"

namespace scarp {
namespace {

/// Bytes per sample that max_samples() assumes.
constexpr std::uint64_t kBytesPerSample = 5;
constexpr std::uint64_t kLeastMemory = 4'000'000;

/// One mosaic of the stack.
struct GlobeSource {
  OwnedHeightField field;
  RasterOnGlobe globe;
  std::optional<RasterOnPlane> plane;
  DegreeBox covered;
  std::unique_ptr<NodeSource> samples, raised;
  /// In a stack: the field with small voids filled, used where no source of the stack has a height.
  std::shared_ptr<const SampleSource> filled;
  std::unique_ptr<NodeSource> filled_samples, filled_raised;

  const NodeSource& nodes() const { return raised ? *raised : *samples; }
  const NodeSource& filled_nodes() const { return filled_raised ? *filled_raised : *filled_samples; }
  /// Bytes of the samples in memory.
  std::uint64_t bytes() const {
    const std::uint64_t codes = field.source && field.source->is_in_memory() ? sizeof(std::uint16_t) : 0;
    return field.samples.size() * sizeof(float) +
           codes * static_cast<std::uint64_t>(field.cols) * static_cast<std::uint64_t>(field.rows);
  }
};

Result<void> place_source(GlobeSource& source, const Datum& datum) {
  const OwnedHeightField& raster = source.field;
  SCARP_TRY(source.globe, io::place_on_globe(raster.info, raster.cols, raster.rows, datum, raster.info.path));
  const auto covered = degrees_covered(raster, source.globe.place.affine, source.globe.to_degrees.get());
  if (!covered) return fail(covered.error().kind, fmt::format("{}: {}", raster.info.path, covered.error().message));
  source.covered = *covered;
  SCARP_TRY(source.samples, make_node_source(raster, source.globe.place));
  if (source.globe.zero) source.raised = make_raised_source(*source.samples, source.globe.zero);
  return {};
}

Result<void> fill_source(GlobeSource& source, int side) {
  HeightField field = source.field.view();
  source.filled = grid::without_small_voids(field, side);
  field.samples = nullptr;
  field.source = source.filled.get();
  SCARP_TRY(source.filled_samples, make_node_source(field, source.globe.place));
  if (source.globe.zero) source.filled_raised = make_raised_source(*source.filled_samples, source.globe.zero);
  return {};
}

/// Places a source on the plane of a local grid.
Result<void> lay_source(GlobeSource& source, const std::optional<double>& cell_size, const Datum& datum) {
  const OwnedHeightField& raster = source.field;
  SCARP_TRY(source.plane, io::place_on_plane(raster.info, raster.cols, raster.rows, cell_size, datum));
  source.globe.vertical = source.plane->vertical;
  source.globe.ellipsoid = source.plane->ellipsoid;
  source.globe.body = source.plane->body;
  source.covered = {0, 0, raster.cols - 1.0, raster.rows - 1.0};
  source.samples = make_local_nodes(raster);
  return {};
}

/// `grid`: if empty, set to one that suits the raster.
Result<std::unique_ptr<GlobeSource>> open_source(const std::vector<std::string>& mosaic, ReadOptions options,
                                                 const Datum& datum, std::optional<GridKind>& grid) {
  auto source = std::make_unique<GlobeSource>();
  options.crs = "";
  options.default_frame = DefaultFrame::kSource;
  options.heights_in = HeightsIn::kMetres;
  // The last raster of a mosaic is on top.
  const std::string& path = mosaic.back();
  options.view.more.assign(mosaic.rbegin() + 1, mosaic.rend());
  SCARP_TRY(source->field, open_height_field(path, options));
  source->field.info.path = mosaic.front();
  if (!grid) grid = io::grid_for(source->field.info);
  SCARP_RETURN_IF_ERROR(grid == GridKind::kLocal ? lay_source(*source, options.cell_size, datum)
                                                 : place_source(*source, datum));
  return source;
}

/// The stamp of FILE, or of FILE:LAYER. Makes the file's name absolute.
FileStamp stamp_lines(std::string& file) {
  FileStamp stamp = stamp_of(file);
  const std::size_t colon = file.rfind(':');
  const std::string layer = stamp.size > 0 || colon == std::string::npos ? "" : file.substr(colon);
  if (!layer.empty()) stamp = stamp_of(file.substr(0, colon));
  if (stamp.size > 0) file = stamp.path + layer;
  return stamp;
}

/// The raster's EPSG code, or EPSG:CODE as a placeholder.
std::string code_of(const RasterInfo& info) { return info.crs.starts_with("EPSG:") ? info.crs : "EPSG:CODE"; }

/// Sources of a stack must share one globe, and a common setting must not contradict any of them.
Result<void> check_stack(const GlobeSource& first, const GlobeSource& source, const Datum& datum) {
  const RasterInfo& info = source.field.info;
  const Geodetic &one = first.globe.ellipsoid, &other = source.globe.ellipsoid;
  if (one.semi_major != other.semi_major || one.inverse_flattening != other.inverse_flattening)
    return fail(
        ErrorKind::kInput,
        fmt::format("{} lies on an ellipsoid of {:.0f} m, and {} on one of {:.0f} m: give rasters of one planet, "
                    "or --ellipsoid",
                    info.path, other.semi_major, first.field.info.path, one.semi_major));
  const std::string says = info.is_ellipsoidal ? "the ellipsoid" : info.vertical;
  if (datum.vertical == Vertical::kAuto || says.empty() || says == source.globe.vertical) return {};
  return fail(
      ErrorKind::kUsage,
      fmt::format(
          "the heights of {} are above {}, as its CRS says, and not above {}: leave --vertical and "
          "--geoid out, and name in the CRS of each other raster what its heights are above, such as the sea ({})",
          info.path, says, source.globe.vertical,
          io::translate_command("-a_srs " + code_of(first.field.info) + "+5773", first.field.info.path)));
}

}  // namespace

struct GlobeRaster::Impl {
  GridKind grid = GridKind::kGeographic;
  std::vector<std::unique_ptr<GlobeSource>> sources;
  std::unique_ptr<NodeSource> stack;    ///< for more than one source
  std::unique_ptr<NodeSource> watered;  ///< with water
  std::vector<std::string> warnings;    ///< warnings about water

  const NodeSource& land() const { return stack ? *stack : sources.front()->nodes(); }
};

GlobeRaster::GlobeRaster(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

GlobeRaster::~GlobeRaster() = default;

Result<std::unique_ptr<GlobeRaster>> GlobeRaster::open(const std::vector<std::vector<std::string>>& mosaics,
                                                       const ReadOptions& options, const Datum& datum,
                                                       std::optional<GridKind> grid) {
  if (mosaics.size() > 1 && (options.view.extent || options.view.resolution))
    return fail(
        ErrorKind::kUsage,
        fmt::format("--te and --resolution are for one raster or mosaic, and {} is no mosaic with {}: cut each of "
                    "them first ({})",
                    mosaics[1].front(), mosaics[0].front(),
                    io::warp_command("-te XMIN YMIN XMAX YMAX -tr WIDTH HEIGHT", mosaics[0].front())));
  auto impl = std::make_unique<Impl>();
  ReadOptions reading = options;
  if (mosaics.size() > 1) reading.void_side = 0;
  std::uint64_t& memory = reading.run.memory.limit;
  if (mosaics.size() > 1 && memory == 0) memory = kBytesPerSample * max_samples(0);
  for (const std::vector<std::string>& mosaic : mosaics) {
    SCARP_TRY(auto&& source, open_source(mosaic, reading, datum, grid));
    impl->grid = *grid;
    if (mosaics.size() > 1 && grid == GridKind::kLocal)
      return fail(ErrorKind::kUsage,
                  fmt::format("a local grid has the samples of one raster, and {} is no mosaic with {}: put them "
                              "together first ({}), or take --grid geographic",
                              mosaics[1].front(), mosaics[0].front(),
                              io::warp_command(io::file_word(mosaics[0].front()), mosaics[1].front())));
    // Later sources have less memory, but always a little for windows of files.
    if (mosaics.size() > 1) memory -= std::min(source->bytes(), memory - std::min(memory, kLeastMemory));
    if (mosaics.size() > 1) {
      const GlobeSource& first = impl->sources.empty() ? *source : *impl->sources.front();
      SCARP_RETURN_IF_ERROR(check_stack(first, *source, datum));
    }
    impl->sources.push_back(std::move(source));
  }
  if (!impl->sources.front()->plane) {
    std::vector<StackedSource> stack;
    for (const auto& source : impl->sources) stack.push_back({&source->nodes(), source->covered});
    for (const auto& source : impl->sources) {
      if (mosaics.size() == 1 || options.void_side == 0) break;
      SCARP_RETURN_IF_ERROR(fill_source(*source, options.void_side));
      stack.push_back({&source->filled_nodes(), source->covered});
    }
    impl->stack = make_stacked_source(std::move(stack));
  }
  return std::unique_ptr<GlobeRaster>(new GlobeRaster(std::move(impl)));
}

const NodeSource& GlobeRaster::nodes() const { return impl_->watered ? *impl_->watered : impl_->land(); }

void GlobeRaster::add_waters(const PyramidPlan& plan) {
  if (plan.waters) impl_->watered = tiles::make_watered_source(impl_->land(), plan.waters, place().zero);
}

std::vector<SourceFacts> GlobeRaster::facts() const {
  std::vector<SourceFacts> facts;
  for (const auto& source : impl_->sources) {
    const RasterInfo& raster = source->field.info;
    const double reserve = source->globe.zero_reach;
    const bool are_degrees = !source->plane && source->globe.to_degrees == nullptr;
    const double cell2 =
        source->plane ? source->plane->cell_x * source->plane->cell_y : raster.cell_x_m * raster.cell_y_m;
    facts.push_back({source->covered, std::sqrt(cell2), raster.min - reserve, raster.max + reserve,
                     are_degrees ? std::sqrt(raster.cell_x * raster.cell_y) : 0});
  }
  return facts;
}

TileGrid GlobeRaster::grid(int cells) const {
  if (impl_->grid != GridKind::kLocal) return {.kind = impl_->grid};
  const GlobeSource& source = *impl_->sources.front();
  return TileGrid::of_raster(source.field.cols, source.field.rows, source.plane->cell_x, source.plane->cell_y, cells);
}

const std::optional<RasterOnPlane>& GlobeRaster::plane() const { return impl_->sources.front()->plane; }

const RasterInfo& GlobeRaster::info() const { return impl_->sources.front()->field.info; }

const RasterOnGlobe& GlobeRaster::place() const { return impl_->sources.front()->globe; }

VoidCount GlobeRaster::voids() const {
  VoidCount all;
  for (const auto& source : impl_->sources) {
    const VoidCount& voids = source->field.info.voids;
    all.filled += voids.filled;
    if (voids.left == 0) continue;
    all.least = all.left == 0 ? voids.least : std::max(all.least, voids.least);
    all.most = all.left == 0 ? voids.most : std::min(all.most, voids.most);
    all.left += voids.left;
  }
  return all;
}

std::string GlobeRaster::heights_above() const {
  std::vector<std::string> different;
  for (const auto& source : impl_->sources) {
    const std::string& one = source->globe.vertical;
    if (std::find(different.begin(), different.end(), one) == different.end()) different.push_back(one);
  }
  return fmt::format("{}", fmt::join(different, ", "));
}

std::vector<std::string> GlobeRaster::warnings() const {
  std::vector<std::string> warnings;
  for (const auto& source : impl_->sources) {
    const RasterInfo& raster = source->field.info;
    for (const std::string& one : raster.warnings)
      warnings.push_back(impl_->stack ? fmt::format("{}: {}", raster.path, one) : one);
    if (source->plane) warnings.insert(warnings.end(), source->plane->warnings.begin(), source->plane->warnings.end());
  }
  warnings.insert(warnings.end(), impl_->warnings.begin(), impl_->warnings.end());
  return warnings;
}

Result<void> find_waters(TileJob& job, GlobeRaster& raster) {
  if (job.waters.is_empty()) return {};
  auto& impl = *raster.impl_;
  ReadLinesOptions reading;
  reading.crs = raster.place().degrees;
  reading.ignore_z = true;
  SCARP_TRY(auto&& lakes, read_lines(job.waters.lakes, reading));
  SCARP_RETURN_IF_ERROR(check_polygons(lakes.lines, "--water", "--rivers"));
  SCARP_TRY(auto&& rivers, read_lines(job.waters.rivers, reading));
  for (const LineSet* set : {&lakes, &rivers})
    impl.warnings.insert(impl.warnings.end(), set->warnings.begin(), set->warnings.end());
  for (auto* files : {&job.waters.lakes, &job.waters.rivers}) {
    for (std::string& file : *files) job.files.push_back(stamp_lines(file));
  }
  DegreeBox covered = impl.sources.front()->covered;
  for (const auto& source : impl.sources) {
    const DegreeBox& one = source->covered;
    covered = {std::min(covered.west, one.west), std::min(covered.south, one.south), std::max(covered.east, one.east),
               std::max(covered.north, one.north)};
  }
  const std::size_t lines = rivers.lines.size();
  SCARP_TRY(auto&& waters,
            tiles::find_tile_waters(job.plan, impl.land(), raster.place().zero, covered,
                                    {std::move(lakes.lines), std::move(rivers.lines), job.waters.percentile}));
  const auto flat = std::count_if(waters.lakes.begin(), waters.lakes.end(),
                                  [](const tiles::TileLake& lake) { return !std::isnan(lake.level); });
  if (!job.waters.lakes.empty() && flat == 0)
    impl.warnings.push_back("--water names no lake in the raster: it changes nothing");
  if (waters.rivers.size() < lines)
    impl.warnings.push_back(fmt::format("--rivers: {} of {} lines are beside the raster or closed: no rivers",
                                        lines - waters.rivers.size(), lines));
  job.plan.waters = std::make_shared<const TileWaters>(std::move(waters));
  raster.add_waters(job.plan);
  return {};
}

}  // namespace scarp
