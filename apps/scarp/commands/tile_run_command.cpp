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
  const Result<std::uint64_t> number = parse_count("--shard", text->substr(0, slash), 1);
  if (!number) return tl::unexpected(number.error());
  const Result<std::uint64_t> of = parse_count("--shard", text->substr(slash + 1), 1);
  if (!of) return tl::unexpected(of.error());
  if (*number > *of || *of > 1'000'000)
    return fail(ErrorKind::kUsage, fmt::format("--shard {}: there is no such share", *text));
  return Shard{static_cast<std::uint32_t>(*number), static_cast<std::uint32_t>(*of)};
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
  const Result<Shard> shard = parse_shard(shard_);
  if (!shard) return tl::unexpected(shard.error());
  const Result<std::optional<DegreeBox>> only = parse_box(only_);
  if (!only) return tl::unexpected(only.error());
  Run run;
  const Result<int> threads = parse_threads(threads_);
  if (!threads) return tl::unexpected(threads.error());
  run.threads = *threads;
  std::uint64_t memory = kShareRasterBytes;
  if (memory_) {
    const Result<std::uint64_t> bytes = parse_bytes("--memory", *memory_);
    if (!bytes) return tl::unexpected(bytes.error());
    memory = *bytes;
  }
  Result<TileJob> job = read_tile_job(plan_);
  if (!job) return tl::unexpected(job.error());
  if (*only && job->plan.grid.is_flat())
    return fail(ErrorKind::kUsage, "--only does not go with a local grid: it is a box in degrees");
  ProgressDisplay display(ProgressDisplay::choose(json_progress_, quiet_));
  const Result<OpenedJob> opened = open_job(std::move(*job), memory, *threads);
  if (!opened) return tl::unexpected(opened.error());
  TileCounts counts;
  display.show_tiles(counts);
  run.progress = display.callback();
  const Result<PartsReport> made =
      make_parts(opened->job, opened->raster->nodes(), parts_folder(plan_, parts_, opened->job), *shard, run, *only,
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
                                shard->number, shard->of)});
  const std::string unchanged =
      made->unchanged == 0 ? "" : fmt::format(", {} of the same nodes as before", made->unchanged);
  return print_summary(fmt::format("{}, share {} of {}: {} made, {} there before{}; {}, {}; {} s\n", plan_,
                                   shard->number, shard->of, format_plural(made->blocks, "block"), made->there,
                                   unchanged, format_plural(made->tiles, "tile"), format_bytes(made->bytes),
                                   format_seconds(seconds_since(start))));
}

}  // namespace scarp::cli
