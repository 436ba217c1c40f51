#include "commands/serve_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "scarp/live_tiles.h"
#include "serve/http_server.h"
#include "serve/preparation.h"
#include "session/options/memory_options.h"
#include "session/reports/tile_report.h"
#include "session/table/option_table.h"
#include "session/text/paths.h"
#include "session/text/text.h"
#include "terminal/progress_display.h"
#include "terminal/signals.h"

namespace scarp::cli {
namespace {

constexpr const char* kPort = "8080";
constexpr const char* kHost = "127.0.0.1";
constexpr const char* kMemory = "1G";
constexpr std::uint64_t kMostPort = 65535;

std::string describe(const std::string& input, const TileSetReader& set, const LiveTileSet* live,
                     const std::string& heights_above, const std::string& url) {
  std::uint64_t tiles = 0;
  for (const auto& level : set.tiles()) tiles += level.size();
  std::string text = fmt::format("{}: {}, levels 0 to {}{}\n", input, format_plural(tiles, "tile"),
                                 set.tiles().size() - 1, live != nullptr ? ", made when asked for" : "");
  if (!heights_above.empty()) text += fmt::format("  heights   above {}\n", heights_above);
  text += fmt::format("  at        {}\n", url);
  text += set.format() == TileFormat::kGlb
              ? fmt::format("  CesiumJS  await Cesium.Cesium3DTileset.fromUrl(\"{}tileset.json\")\n", url)
              : fmt::format(
                    "  CesiumJS  await Cesium.CesiumTerrainProvider.fromUrl(\"{}\", {{requestVertexNormals: true}})\n",
                    url);
  return text + "  until     Ctrl-C\n";
}

}  // namespace

ServeCommand::ServeCommand(CLI::App& program) : command_(add_command(program, kServe)) {
  tiles_.default_effort = Effort::kFast;
  tiles_.takes_local = false;
  add_arguments(*command_, OptionId::kInput, tiles_.raster.paths);
  tiles_.add_to(*command_);
  add_option(*command_, OptionId::kMemory, memory_);
  add_option(*command_, OptionId::kPort, port_);
  add_option(*command_, OptionId::kHost, host_);
  add_option(*command_, OptionId::kThreads, threads_);
  add_flag(*command_, OptionId::kQuiet, quiet_);
  add_flag(*command_, OptionId::kJsonProgress, json_progress_);
}

Result<void> ServeCommand::check_alone() const {
  const bool is_plan = lower_extension(tiles_.raster.path()) == ".json";
  for (const CLI::Option* option : command_->get_options()) {
    const std::string name = option->get_name();
    constexpr std::array kFree{"--port", "--host", "--num-threads", "--quiet", "--json-progress"};
    if (option->count() == 0 || name.rfind("--", 0) != 0 || std::ranges::count(kFree, name) > 0) continue;
    if (is_plan && name == "--memory") continue;
    return fail(ErrorKind::kUsage, fmt::format("{} is for rasters, whose tiles are made when they are asked for: {} is "
                                               "finished, or a plan that has decided it",
                                               name, tiles_.raster.path()));
  }
  if (tiles_.raster.paths.size() > 1)
    return fail(ErrorKind::kUsage,
                fmt::format("{} is no raster: one set or plan is served at a time", tiles_.raster.path()));
  return {};
}

Result<ServeCommand::Served> ServeCommand::open(int threads) const {
  Served served;
  const std::string& path = tiles_.raster.path();
  const bool is_plan = lower_extension(path) == ".json";
  if (is_plan || names_tile_set(path)) {
    SCARP_RETURN_IF_ERROR(check_alone());
  }
  if (!is_plan && names_tile_set(path)) {
    SCARP_TRY(served.answers, TileAnswers::open(path));
    return served;
  }
  SCARP_TRY(const std::uint64_t memory, parse_bytes("--memory", memory_.value_or(kMemory)));
  ProgressDisplay display(ProgressDisplay::choose(json_progress_, quiet_));
  if (is_plan) {
    SCARP_TRY(auto&& job, read_tile_job(path));
    SCARP_TRY(served.job, open_job(std::move(job), memory / 2, threads));
  } else {
    SCARP_TRY(served.job, open_tiles(tiles_, display.callback(), memory / 2));
  }
  Run run;
  run.threads = threads;
  run.progress = display.callback();
  SCARP_TRY(auto&& set, LiveTileSet::open(served.job.job, served.job.raster->nodes(), memory / 2, run));
  display.finish();
  served.live = set.get();
  served.answers = std::make_unique<TileAnswers>(std::move(set), base_name(path));
  return served;
}

Result<void> ServeCommand::run() const {
  SCARP_TRY(const std::uint64_t port, parse_count("--port", port_.value_or(kPort), 0));
  if (port > kMostPort) return fail(ErrorKind::kUsage, fmt::format("--port {} must be at most {}", port, kMostPort));
  SCARP_TRY(const int threads, parse_threads(threads_));
  SCARP_TRY(const Served& served, open(threads));
  const TileAnswers& answers = *served.answers;
  SCARP_TRY(auto&& server, HttpServer::listen(host_.value_or(kHost), static_cast<int>(port)));
  if (!quiet_) {
    if (served.job.raster) print_warnings(warnings_of_raster(*served.job.raster));
    print_warnings(served.job.warnings);
    SCARP_RETURN_IF_ERROR(print_summary(
        describe(tiles_.raster.path(), *answers.set(), served.live, served.job.job.facts.heights_above, server.url())));
  }
  std::optional<Preparation> preparation;
  if (served.live != nullptr) preparation.emplace(*served.live, threads);
  return server.run([&](const Request& request) { return answers.answer(request); }, threads, interrupted);
}

}  // namespace scarp::cli
