#include "session/tasks/points_raster.h"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "io/lend.h"
#include "session/reports/points_report.h"
#include "session/tasks/points_files.h"
#include "session/tasks/points_work.h"
#include "session/text/json_text.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

using enum OptionId;

/// The options by which points are read.
constexpr OptionId kOfReading[] = {kPoints, kLayer,    kZField, kColumns, kClass,   kReturns, kDuplicates, kDespike,
                                   kExtent, kBoundary, kNodata, kZScale,  kZOffset, kZUnit,   kCellSize};

void copy(OptionId id, const GivenOptions& from, GivenOptions& to) {
  if (from[id]) to.set(id, from[id]);
  if (!from.all(id).empty()) to.set(id, from.all(id));
}

}  // namespace

struct PointsRaster::Impl {
  std::uint64_t count = 0;
  double cell_size = 0;
  std::vector<std::string> warnings;
  OwnedHeightField field;
  io::LentRaster raster;
  std::string name;
  std::optional<io::Lent> lent;
};

PointsRaster::PointsRaster(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
PointsRaster::~PointsRaster() = default;

Result<std::unique_ptr<PointsRaster>> PointsRaster::make(const GivenOptions& given, const Runner& runner) {
  GivenOptions asked(kSimplify);
  for (const OptionId id : kOfReading) copy(id, given, asked);
  for (const OptionId id : {kInput, kThreads}) copy(id, given, asked);
  asked.set(kMaxError, "0");
  asked.set(kEffort, "fast");
  asked.set(kOutput, "-");
  asked.set(kOf, "dem");
  auto impl = std::make_unique<Impl>();
  SimplifyPlan plan;
  PointsOutcome outcome;
  SCARP_RETURN_IF_ERROR(make_points_mesh(asked, runner, plan, outcome));
  SCARP_TRY(impl->field, draw_surface(plan, outcome));
  impl->count = outcome.points.size();
  impl->cell_size = *outcome.cell_size;
  impl->warnings = std::move(outcome.warnings);
  const OwnedHeightField& field = impl->field;
  impl->name = given.input();
  impl->raster = {.samples = field.samples.data(),
                  .cols = field.cols,
                  .rows = field.rows,
                  .geotransform = field.info.geotransform,
                  .crs = field.info.crs,
                  .is_geographic = outcome.points.is_local && field.info.crs.empty(),
                  .unit = field.info.unit};
  impl->lent.emplace(impl->name, impl->raster);
  return std::unique_ptr<PointsRaster>(new PointsRaster(std::move(impl)));
}

GivenOptions PointsRaster::options(const GivenOptions& given) const {
  GivenOptions asked = given;
  for (const OptionId id : kOfReading) asked.set(id, Given());
  asked.set(kExtent, GivenOptions::Texts());
  asked.set(kInput, GivenOptions::Texts{impl_->name});
  return asked;
}

std::uint64_t PointsRaster::count() const { return impl_->count; }
double PointsRaster::cell_size() const { return impl_->cell_size; }
const std::vector<std::string>& PointsRaster::warnings() const { return impl_->warnings; }

Json describe(const PointsRaster& raster) { return {{"count", raster.count()}, {"cell_size", raster.cell_size()}}; }

std::string points_line(const PointsRaster& raster) {
  return fmt::format("  points         {}, as a raster of cells {} wide\n", format_count(raster.count()),
                     format_number(raster.cell_size()));
}

}  // namespace scarp::cli
