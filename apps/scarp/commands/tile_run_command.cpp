#include "commands/tile_run_command.h"

#include <fmt/format.h>

#include <utility>

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

/// "3/200".
Result<Shard> parse_shard(const Given& text) {
  if (!text) return Shard{};
  const std::size_t slash = text->find('/');
  if (slash == std::string::npos)
    return fail(ErrorKind::kUsage, fmt::format("--shard {}: give its number and how many there are, as 3/200", *text));
  SCARP_TRY(const std::uint64_t number, parse_count("--shard", text->substr(0, slash), 1));
  SCARP_TRY(const std::uint64_t of, parse_count("--shard", text->substr(slash + 1), 1));
  if (number > of || of > 1'000'000)
    return fail(ErrorKind::kUsage, fmt::format("--shard {}: there is no such share", *text));
  return Shard{static_cast<std::uint32_t>(number), static_cast<std::uint32_t>(of)};
}

}  // namespace

TileRunCommand::TileRunCommand(CLI::App& program) : command_(add_command(program, kTileRun)) {
  add_option(*command_, OptionId::kPlan, plan_);
  add_option(*command_, OptionId::kShard, shard_);
  add_option(*command_, OptionId::kOnly, only_);
  add_option(*command_, OptionId::kParts, parts_);
  add_option(*command_, OptionId::kMemory, memory_);
  add_option(*command_, OptionId::kThreads, threads_);
  add_flag(*command_, OptionId::kQuiet, quiet_);
  add_flag(*command_, OptionId::kJsonProgress, json_progress_);
}

Result<void> TileRunCommand::run() const {
  const Clock::time_point start = Clock::now();
  SCARP_TRY(const Shard& shard, parse_shard(shard_));
  SCARP_TRY(const std::optional<DegreeBox>& only, parse_box(only_));
  Run run;
  SCARP_TRY(const int threads, parse_threads(threads_));
  run.threads = threads;
  std::uint64_t memory = kShareRasterBytes;
  if (memory_) {
    SCARP_TRY(memory, parse_bytes("--memory", *memory_));
  }
  SCARP_TRY(TileJob job, read_tile_job(plan_));
  if (only && job.plan.grid.is_flat())
    return fail(ErrorKind::kUsage, "--only does not go with a local grid: it is a box in degrees");
  ProgressDisplay display(ProgressDisplay::choose(json_progress_, quiet_));
  SCARP_TRY(const OpenedJob& opened, open_job(std::move(job), memory, threads));
  TileCounts counts;
  display.show_tiles(counts);
  run.progress = display.callback();
  const Result<PartsReport> made =
      make_parts(opened.job, opened.raster->nodes(), parts_folder(plan_, parts_, opened.job), shard, run, only,
                 [&](const PartsReport& so_far) {
                   counts = {so_far.tiles, so_far.bytes};
                 });
  if (!made) {
    if (made.error().kind != ErrorKind::kCancelled) return tl::unexpected(made.error());
    display.finish();
    return fail(ErrorKind::kCancelled, "interrupted; the blocks made so far stay, the same command goes on");
  }
  display.finish();
  if (quiet_) return {};
  if (made->has_company)
    print_warnings({fmt::format("another process made share {} of {} at the same time: each block is kept once",
                                shard.number, shard.of)});
  const std::string unchanged =
      made->unchanged == 0 ? "" : fmt::format(", {} of the same nodes as before", made->unchanged);
  return print_summary(fmt::format("{}, share {} of {}: {} made, {} there before{}; {}, {}; {} s\n", plan_,
                                   shard.number, shard.of, format_plural(made->blocks, "block"), made->there, unchanged,
                                   format_plural(made->tiles, "tile"), format_bytes(made->bytes),
                                   format_seconds(seconds_since(start))));
}

}  // namespace scarp::cli
