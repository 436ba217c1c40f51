#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "commands/commands.h"
#include "jobs/live_tiles.h"
#include "serve/http_server.h"
#include "serve/preparation.h"
#include "serve/tile_answers.h"
#include "session/options/memory_options.h"
#include "session/plan/tile_plan.h"
#include "session/reports/tile_report.h"
#include "session/table/option_table.h"
#include "session/text/paths.h"
#include "session/text/text.h"
#include "terminal/progress_display.h"
#include "terminal/signals.h"

namespace scarp::cli {
namespace {

using enum OptionId;

constexpr std::uint64_t kDefaultPort = 8080;
constexpr const char* kDefaultHost = "127.0.0.1";
constexpr const char* kDefaultMemory = "1G";

std::string describe(const std::string& input, const TileSetReader& set, const jobs::LiveTileSet* live,
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

struct Served {
  OpenedJob job;  ///< job of a raster or a plan
  jobs::LiveTileSet* live = nullptr;
  std::unique_ptr<TileAnswers> answers;
};

/// Fails for options that a finished set or a plan already determines.
Result<void> check_alone(const GivenOptions& given) {
  const bool is_plan = lower_extension(given.input()) == ".json";
  constexpr std::array kFree{kPort, kHost, kThreads, kQuiet, kJsonProgress};
  for (const OptionRow* row : given.given()) {
    if (std::ranges::count(kFree, row->id) > 0 || (is_plan && row->id == OptionId::kMemory)) continue;
    return fail(ErrorKind::kUsage, fmt::format("{} is for rasters, whose tiles are made when they are asked for: {} is "
                                               "finished, or a plan that has decided it",
                                               row->title(), given.input()));
  }
  if (given.inputs().size() > 1)
    return fail(ErrorKind::kUsage, fmt::format("{} is no raster: one set or plan is served at a time", given.input()));
  return {};
}

Result<Served> open(const GivenOptions& given, int threads) {
  Served served;
  const std::string& path = given.input();
  const bool is_plan = lower_extension(path) == ".json";
  if (is_plan || names_tile_set(path)) {
    SCARP_RETURN_IF_ERROR(check_alone(given));
  }
  if (!is_plan && names_tile_set(path)) {
    SCARP_TRY(served.answers, TileAnswers::open(path));
    return served;
  }
  SCARP_TRY(const std::uint64_t memory,
            parse_bytes(name_of(OptionId::kMemory), given[OptionId::kMemory].value_or(kDefaultMemory)));
  ProgressDisplay display(ProgressDisplay::choose(given.has(kJsonProgress), given.has(kQuiet)));
  if (is_plan) {
    SCARP_TRY(auto&& job, read_tile_job(path));
    SCARP_TRY(served.job, open_job(std::move(job), memory / 2, threads));
  } else {
    SCARP_TRY(served.job, open_tiles(given, display.callback(), memory / 2));
  }
  Run run;
  run.threads = threads;
  run.progress = display.callback();
  SCARP_TRY(auto&& set, jobs::LiveTileSet::open(served.job.job, served.job.raster->nodes(), memory / 2, run));
  display.finish();
  served.live = set.get();
  served.answers = std::make_unique<TileAnswers>(std::move(set), base_name(path));
  return served;
}

}  // namespace

Result<void> run_serve(const GivenOptions& given, const std::string&) {
  SCARP_TRY(const auto port, given.count(kPort));
  SCARP_TRY(const int threads, given.threads());
  SCARP_TRY(const Served& served, open(given, threads));
  const TileAnswers& answers = *served.answers;
  SCARP_TRY(auto&& server,
            HttpServer::listen(given[kHost].value_or(kDefaultHost), static_cast<int>(port.value_or(kDefaultPort))));
  if (!given.has(kQuiet)) {
    if (served.job.raster) print_warnings(warnings_of_raster(*served.job.raster));
    print_warnings(served.job.warnings);
    SCARP_RETURN_IF_ERROR(print_summary(
        describe(given.input(), *answers.set(), served.live, served.job.job.facts.heights_above, server.url())));
  }
  std::optional<Preparation> preparation;
  if (served.live != nullptr) preparation.emplace(*served.live, threads);
  return server.run([&](const Request& request) { return answers.answer(request); }, threads, interrupted);
}

}  // namespace scarp::cli
