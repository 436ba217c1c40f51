#include "commands/tile_plan_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

#include "scarp/io.h"
#include "session/plan/outputs.h"
#include "session/plan/tile_parts.h"
#include "session/reports/tile_report.h"
#include "session/table/option_table.h"
#include "session/tasks/slurm_script.h"
#include "session/text/text.h"
#include "terminal/progress_display.h"

namespace scarp::cli {
namespace {

/// The number of tasks that clusters accept in an array by default.
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

}  // namespace

TilePlanCommand::TilePlanCommand(CLI::App& program) : command_(add_command(program, kTilePlan)) {
  add_arguments(*command_, OptionId::kInput, tiles_.raster.paths, OptionId::kPlan, plan_);
  tiles_.add_to(*command_);
  add_option(*command_, OptionId::kChangedSince, changed_since_);
  add_option(*command_, OptionId::kHash, hash_);
  add_flag(*command_, OptionId::kSurvey, survey_);
  add_option(*command_, OptionId::kShards, shards_);
  add_option(*command_, OptionId::kSlurm, slurm_);
  add_flag(*command_, OptionId::kOverwrite, overwrite_);
  add_flag(*command_, OptionId::kQuiet, quiet_);
  add_flag(*command_, OptionId::kJsonProgress, json_progress_);
}

Result<OpenedJob> TilePlanCommand::open(const ProgressCallback& progress) const {
  constexpr Choice<bool> kHashes[] = {{"stamp", false}, {"content", true}};
  SCARP_TRY(const bool reads_all, choose("--hash", hash_.value_or("stamp"), kHashes));
  Result<OpenedJob> opened = changed_since_ ? follow(progress) : open_tiles(tiles_, progress);
  if (opened && reads_all) {
    SCARP_RETURN_IF_ERROR(add_contents(opened->job));
  }
  return opened;
}

Result<OpenedJob> TilePlanCommand::follow(const ProgressCallback& progress) const {
  constexpr std::array kFree{"--changed-since", "--hash",      "--survey", "--shards",
                             "--slurm",         "--overwrite", "--quiet",  "--json-progress"};
  for (const CLI::Option* option : command_->get_options()) {
    const std::string name = option->get_name();
    if (option->count() > 0 && name.starts_with("--") && std::ranges::count(kFree, name) == 0)
      return fail(ErrorKind::kUsage,
                  fmt::format("{} does not go with --changed-since: {} has decided it", name, *changed_since_));
  }
  SCARP_TRY(const TileJob& earlier, read_tile_job(*changed_since_));
  SCARP_TRY(auto&& opened, follow_tiles(tiles_, earlier, progress));
  std::error_code error;
  opened.job.parts =
      std::filesystem::absolute(parts_folder(*changed_since_, {}, earlier), error).lexically_normal().string();
  return opened;
}

Result<void> TilePlanCommand::run() const {
  std::vector<PlannedOutput> outputs{{"PLAN", plan_}};
  if (slurm_) outputs.push_back({"--slurm", *slurm_});
  SCARP_RETURN_IF_ERROR(check_outputs(outputs, files_read(*command_), overwrite_));
  ProgressDisplay display(ProgressDisplay::choose(json_progress_, quiet_));
  SCARP_TRY(OpenedJob opened, open(display.callback()));
  SCARP_TRY(const TileEstimate& estimate, estimate_tiles(opened.job, opened.raster->nodes()));
  opened.job.estimate = estimate;
  if (survey_) {
    Run run;
    run.progress = display.callback();
    SCARP_RETURN_IF_ERROR(survey_blocks(opened.job, opened.raster->nodes(), run));
  }
  const std::uint64_t blocks = std::max<std::uint64_t>(estimate.blocks, 1);
  std::uint64_t shards = std::min(blocks, kMostShards);
  if (shards_) {
    SCARP_TRY(const std::uint64_t count, parse_count("--shards", *shards_, 1));
    shards = std::min(count, blocks);
  }
  const std::vector<std::uint8_t> plan = encode_tile_job(opened.job);
  const std::string script = slurm_script(plan_, shards, estimate.memory + kShareRasterBytes);
  std::vector<FileBytes> files{{plan_, plan}};
  if (slurm_)
    files.push_back({*slurm_, std::span(reinterpret_cast<const std::uint8_t*>(script.data()), script.size())});
  SCARP_RETURN_IF_ERROR(write_files(files, overwrite_));
  display.finish();
  if (quiet_) return {};
  print_warnings(warnings_of_raster(*opened.raster));
  print_warnings(opened.warnings);
  return print_summary(make_summary(opened.job, plan_, estimate, shards));
}

}  // namespace scarp::cli
