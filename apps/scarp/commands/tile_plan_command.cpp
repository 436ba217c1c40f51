#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

#include "commands/commands.h"
#include "scarp/io.h"
#include "session/plan/outputs.h"
#include "session/plan/tile_parts.h"
#include "session/plan/tile_plan.h"
#include "session/reports/tile_report.h"
#include "session/table/option_table.h"
#include "session/tasks/slurm_script.h"
#include "session/text/text.h"
#include "terminal/progress_display.h"

namespace scarp::cli {
namespace {

using enum OptionId;

/// The default limit for the number of array tasks on clusters.
constexpr std::uint64_t kMostShards = 1000;
std::string format_hours(double seconds) {
  return seconds < 7200 ? fmt::format("{} minutes", format_number(std::ceil(seconds / 6) / 10))
                        : fmt::format("{} hours", format_number(std::ceil(seconds / 360) / 10));
}

std::string make_summary(const TileJob& job, const std::string& plan, const TileEstimate& estimate,
                         std::uint64_t shards) {
  std::string text = fmt::format("{} -> {}\n", job.facts.name, plan);
  text += fmt::format("  heights above  {}\n", job.facts.heights_above);
  text += grid_lines(job);
  text += waters_line(job);
  text += fmt::format("  levels         0 to {}, {} of level {}\n", job.plan.max_zoom(),
                      format_plural(estimate.blocks, "block"), job.plan.block_level);
  if (!job.costs.empty()) {
    const auto empty = static_cast<std::uint64_t>(std::ranges::count(job.costs, 1u));
    text += fmt::format("  survey         {} with heights, {} without\n",
                        format_plural(job.costs.size() - empty, "block"), empty);
  }
  text += fmt::format("  max error      {}, level {}; {}, level {}\n",
                      format_length(job, job.plan.levels.back().max_error), job.plan.max_zoom(),
                      format_length(job, job.plan.levels[static_cast<std::size_t>(job.plan.block_level)].max_error),
                      job.plan.block_level);
  text += "  of a few tiles made to see, about:\n";
  text += fmt::format("    tiles        {}, {} of them of level {}\n", format_count(estimate.tiles),
                      format_count(estimate.finest_tiles), job.plan.max_zoom());
  text += fmt::format("    bytes        {}, and {} of parts until the set is finished\n", format_bytes(estimate.bytes),
                      format_bytes(estimate.parts));
  text += fmt::format("    time         {} of one core of this machine\n", format_hours(estimate.core_seconds));
  text += fmt::format("    memory       {} a process, and the raster's\n", format_bytes(estimate.memory));
  text += fmt::format(
      "next: scarp tile run {} --shard 1/{} … {}/{}, anywhere, in any order; then scarp tile finish {} "
      "OUTPUT\n",
      shell_word(plan), shards, shards, shards, shell_word(plan));
  return text;
}

/// Opens a job that follows the earlier plan.
Result<OpenedJob> follow(const GivenOptions& given, const ProgressCallback& progress) {
  constexpr std::array kFree{kChangedSince, kHash, kSurvey, kShards, kSlurm, kOverwrite, kQuiet, kJsonProgress};
  for (const OptionRow* row : given.given()) {
    if (std::ranges::count(kFree, row->id) == 0)
      return fail(ErrorKind::kUsage, fmt::format("{} does not go with {}: {} has decided it", row->title(),
                                                 kChangedSince, *given[kChangedSince]));
  }
  SCARP_TRY(const TileJob& earlier, read_tile_job(*given[kChangedSince]));
  SCARP_TRY(auto&& opened, follow_tiles(given, earlier, progress));
  std::error_code error;
  opened.job.parts =
      std::filesystem::absolute(parts_folder(*given[kChangedSince], {}, earlier), error).lexically_normal().string();
  return opened;
}

Result<OpenedJob> open(const GivenOptions& given, const ProgressCallback& progress) {
  constexpr Choice<bool> kHashes[] = {{"stamp", false}, {"content", true}};
  SCARP_TRY(const auto reads_all, given.choice(kHash, kHashes));
  Result<OpenedJob> opened = given[kChangedSince] ? follow(given, progress) : open_tiles(given, progress);
  if (opened && reads_all.value_or(false)) {
    SCARP_RETURN_IF_ERROR(add_contents(opened->job));
  }
  return opened;
}

}  // namespace

Result<void> run_tile_plan(const GivenOptions& given, const std::string&) {
  std::vector<PlannedOutput> outputs{{name_of(kPlan), *given[kPlan]}};
  if (given[kSlurm]) outputs.push_back({name_of(kSlurm), *given[kSlurm]});
  SCARP_RETURN_IF_ERROR(check_outputs(outputs, given.files_read(), given.has(kOverwrite)));
  ProgressDisplay display(ProgressDisplay::choose(given.has(kJsonProgress), given.has(kQuiet)));
  SCARP_TRY(OpenedJob opened, open(given, display.callback()));
  SCARP_TRY(const TileEstimate& estimate, estimate_tiles(opened.job, opened.raster->nodes()));
  opened.job.estimate = estimate;
  if (given.has(kSurvey)) {
    Run run;
    run.progress = display.callback();
    SCARP_RETURN_IF_ERROR(survey_blocks(opened.job, opened.raster->nodes(), run));
  }
  const std::uint64_t blocks = std::max<std::uint64_t>(estimate.blocks, 1);
  std::uint64_t shards = std::min(blocks, kMostShards);
  SCARP_TRY(const auto asked, given.count(kShards));
  if (asked) shards = std::min(*asked, blocks);
  const std::vector<std::uint8_t> plan = encode_tile_job(opened.job);
  const std::string script = slurm_script(*given[kPlan], shards, estimate.memory + kShareRasterBytes);
  std::vector<FileBytes> files{{*given[kPlan], plan}};
  if (given[kSlurm])
    files.push_back({*given[kSlurm], std::span(reinterpret_cast<const std::uint8_t*>(script.data()), script.size())});
  SCARP_RETURN_IF_ERROR(write_files(files, given.has(kOverwrite)));
  display.finish();
  if (given.has(kQuiet)) return {};
  print_warnings(warnings_of_raster(*opened.raster));
  print_warnings(opened.warnings);
  return print_summary(make_summary(opened.job, *given[kPlan], estimate, shards));
}

}  // namespace scarp::cli
