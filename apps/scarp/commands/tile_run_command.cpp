#include <fmt/format.h>

#include <utility>

#include "commands/commands.h"
#include "scarp/tile_job.h"
#include "session/options/memory_options.h"
#include "session/options/tile_options.h"
#include "session/plan/tile_parts.h"
#include "session/plan/tile_plan.h"
#include "session/table/option_table.h"
#include "session/text/clock.h"
#include "session/text/text.h"
#include "session/text/tile_counts.h"
#include "terminal/progress_display.h"

namespace scarp::cli {
namespace {

using enum OptionId;

/// Parses "3/200".
Result<Shard> parse_shard(const GivenOptions& given) {
  const Given& text = given[kShard];
  if (!text) return Shard{};
  const std::size_t slash = text->find('/');
  if (slash == std::string::npos)
    return fail(ErrorKind::kUsage,
                fmt::format("{} {}: give its number and how many there are, as 3/200", kShard, *text));
  SCARP_TRY(const std::uint64_t number, parse_count(name_of(kShard), text->substr(0, slash), 1));
  SCARP_TRY(const std::uint64_t of, parse_count(name_of(kShard), text->substr(slash + 1), 1));
  if (number > of || of > 1'000'000)
    return fail(ErrorKind::kUsage, fmt::format("{} {}: there is no such share", kShard, *text));
  return Shard{static_cast<std::uint32_t>(number), static_cast<std::uint32_t>(of)};
}

}  // namespace

Result<void> run_tile_run(const GivenOptions& given, const std::string&) {
  const Clock::time_point start = Clock::now();
  SCARP_TRY(const Shard& shard, parse_shard(given));
  SCARP_TRY(const std::optional<DegreeBox>& only, parse_box(given));
  Run run;
  SCARP_TRY(const int threads, given.threads());
  run.threads = threads;
  std::uint64_t memory = kShareRasterBytes;
  if (given[OptionId::kMemory]) {
    SCARP_TRY(memory, parse_bytes(name_of(OptionId::kMemory), *given[OptionId::kMemory]));
  }
  SCARP_TRY(TileJob job, read_tile_job(*given[kPlan]));
  if (only && job.plan.grid.is_flat())
    return fail(ErrorKind::kUsage, fmt::format("{} does not go with a local grid: it is a box in degrees", kOnly));
  ProgressDisplay display(ProgressDisplay::choose(given.has(kJsonProgress), given.has(kQuiet)));
  SCARP_TRY(const OpenedJob& opened, open_job(std::move(job), memory, threads));
  TileCounts counts;
  display.show_tiles(counts);
  run.progress = display.callback();
  const Result<PartsReport> made =
      make_parts(opened.job, opened.raster->nodes(), parts_folder(*given[kPlan], given[kParts], opened.job), shard, run,
                 only, [&](const PartsReport& so_far) {
                   counts = {so_far.tiles, so_far.bytes};
                 });
  if (!made) {
    if (made.error().kind != ErrorKind::kCancelled) return tl::unexpected(made.error());
    display.finish();
    return fail(ErrorKind::kCancelled, "interrupted; the blocks made so far stay, the same command goes on");
  }
  display.finish();
  if (given.has(kQuiet)) return {};
  if (made->has_company)
    print_warnings({fmt::format("another process made share {} of {} at the same time: each block is kept once",
                                shard.number, shard.of)});
  const std::string unchanged =
      made->unchanged == 0 ? "" : fmt::format(", {} of the same nodes as before", made->unchanged);
  return print_summary(fmt::format("{}, share {} of {}: {} made, {} there before{}; {}, {}; {} s\n", *given[kPlan],
                                   shard.number, shard.of, format_plural(made->blocks, "block"), made->there, unchanged,
                                   format_plural(made->tiles, "tile"), format_bytes(made->bytes),
                                   format_seconds(seconds_since(start))));
}

}  // namespace scarp::cli
