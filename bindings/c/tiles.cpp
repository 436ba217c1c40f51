// Tiles, all at once or on demand, through the program's own plans.
#include <CLI/CLI.hpp>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "door.h"
#include "inputs.h"
#include "jobs/live_tiles.h"
#include "mesh.h"
#include "session/options/tile_options.h"
#include "session/options/values.h"
#include "session/plan/tile_plan.h"
#include "session/reports/tile_report.h"
#include "session/table/option_table.h"
#include "session/tasks/tile_work.h"
#include "session/text/json_text.h"
#include "session/text/tile_counts.h"
#include "settings.h"

struct scarp_tiles {
  scarp::cli::OpenedJob opened;
  std::unique_ptr<scarp::jobs::LiveTileSet> set;
  std::vector<std::vector<std::uint32_t>> lists;  ///< by level: column and row of each tile
  std::string layer = {};
};

namespace scarp::door {
namespace {

constexpr std::uint64_t kCacheBytes = std::uint64_t{64} << 20;

std::vector<std::vector<std::uint32_t>> list_tiles(const jobs::LiveTileSet& set) {
  std::vector<std::vector<std::uint32_t>> lists;
  for (const auto& level : set.tiles()) {
    lists.emplace_back();
    for (const std::uint64_t tile : level) {
      lists.back().push_back(static_cast<std::uint32_t>(tile));
      lists.back().push_back(static_cast<std::uint32_t>(tile >> 32));
    }
  }
  return lists;
}

/// The command's options as in a run of the program.
struct TileWords {
  CLI::App program;
  cli::GivenOptions given{cli::kTile};
  Run run;

  TileWords() { given.add_to(program); }
  Result<void> parse(const std::vector<std::string>& inputs, const std::string& to, const scarp_options& asked,
                     const cli::TileCounts* counts = nullptr) {
    std::vector<std::string> words{"tile"};
    words.insert(words.end(), inputs.begin(), inputs.end());
    words.push_back(to);
    SCARP_RETURN_IF_ERROR(parse_options(program, cli::kTile, words, asked));
    SCARP_TRY(run.threads, given.threads());
    run.progress = progress_of(asked, counts);
    return {};
  }
};

scarp_status open_tiles(const std::string& input, const scarp_options& asked, scarp_tiles** out) {
  TileWords words;
  if (auto parsed = words.parse({input}, "-", asked); !parsed) return report(parsed.error());
  if (words.given[cli::OptionId::kOf].value_or("qm") != "qm")
    return report(ErrorKind::kUsage, "tiles that are made as they are asked for are quantized-mesh: leave of out");
  auto opened = cli::open_tiles(words.given, words.run.progress);
  if (!opened) return report(opened.error());
  auto set = jobs::LiveTileSet::open(opened->job, opened->raster->nodes(), kCacheBytes, words.run);
  if (!set) return report(set.error());
  auto tiles = std::make_unique<scarp_tiles>();
  tiles->opened = std::move(*opened);
  tiles->set = std::move(*set);
  tiles->lists = list_tiles(*tiles->set);
  *out = tiles.release();
  return SCARP_OK;
}

scarp_status make_all_tiles(const std::vector<std::string>& inputs, const scarp_options& asked, const char* output,
                            bool overwrite, scarp_bytes** out) {
  if (output == nullptr || *output == '\0') return report(ErrorKind::kUsage, "the output's path is empty");
  cli::TileCounts counts;
  TileWords words;
  if (auto parsed = words.parse(inputs, output, asked, &counts); !parsed) return report(parsed.error());
  const auto made = cli::make_tiles(words.given, output, overwrite, words.run, counts);
  if (!made) return report(made.error());
  if (out == nullptr) return SCARP_OK;
  cli::Json json{{"input", inputs}};
  if (made->points) json["points"] = cli::describe(*made->points);
  cli::add_tiles(json, made->opened.job, output, made->report);
  json["warnings"] = cli::Json::array();
  for (const std::string& warning : made->warnings) json["warnings"].push_back(in_words_of_door(warning));
  const std::string text = cli::to_text(json);
  *out = new scarp_bytes{{text.begin(), text.end()}};
  return SCARP_OK;
}

}  // namespace
}  // namespace scarp::door

using namespace scarp::door;
using scarp::ErrorKind;

extern "C" {

scarp_status scarp_tiles_open(const char* path, const scarp_options* options, scarp_tiles** out) {
  return guarded([&]() -> scarp_status {
    if (out == nullptr) return report(ErrorKind::kUsage, "the place for the tiles is a null pointer");
    *out = nullptr;
    if (path == nullptr || *path == '\0') return report(ErrorKind::kUsage, "the path is empty");
    return open_tiles(path, known(options, scarp_options_init), out);
  });
}

scarp_status scarp_tiles_open_field(const scarp_field* field, const scarp_options* options, scarp_tiles** out) {
  return guarded([&]() -> scarp_status {
    if (out == nullptr) return report(ErrorKind::kUsage, "the place for the tiles is a null pointer");
    *out = nullptr;
    const scarp_options asked = known(options, scarp_options_init);
    const LentInputs inputs(field, asked);
    if (auto checked = inputs.check(); !checked) return report(checked.error());
    return open_tiles(inputs.name(), asked, out);
  });
}

scarp_status scarp_tile(const scarp_field* field, const scarp_options* options, const char* output, int32_t overwrite,
                        scarp_bytes** out) {
  return guarded([&]() -> scarp_status {
    if (out != nullptr) *out = nullptr;
    const scarp_options asked = known(options, scarp_options_init);
    const LentInputs inputs(field, asked);
    if (auto checked = inputs.check(); !checked) return report(checked.error());
    return make_all_tiles({inputs.name()}, asked, output, overwrite != 0, out);
  });
}

scarp_status scarp_tile_files(const char* const* paths, uint64_t count, const scarp_options* options,
                              const char* output, int32_t overwrite, scarp_bytes** out) {
  return guarded([&]() -> scarp_status {
    if (out != nullptr) *out = nullptr;
    if (paths == nullptr || count == 0) return report(ErrorKind::kUsage, "no path of a raster is given");
    std::vector<std::string> inputs;
    for (uint64_t k = 0; k < count; ++k) {
      if (paths[k] == nullptr || *paths[k] == '\0') return report(ErrorKind::kUsage, "a path is empty");
      inputs.emplace_back(paths[k]);
    }
    return make_all_tiles(inputs, known(options, scarp_options_init), output, overwrite != 0, out);
  });
}

int32_t scarp_tiles_max_level(const scarp_tiles* tiles) { return static_cast<int32_t>(tiles->lists.size()) - 1; }

uint64_t scarp_tiles_count(const scarp_tiles* tiles, int32_t level) {
  if (level < 0 || level > scarp_tiles_max_level(tiles)) return 0;
  return tiles->lists[static_cast<std::size_t>(level)].size() / 2;
}

const uint32_t* scarp_tiles_list(const scarp_tiles* tiles, int32_t level) {
  return scarp_tiles_count(tiles, level) == 0 ? nullptr : tiles->lists[static_cast<std::size_t>(level)].data();
}

scarp_status scarp_tiles_read(const scarp_tiles* tiles, int32_t level, uint32_t x, uint32_t y, scarp_bytes** out,
                              double* bound) {
  return guarded([&]() -> scarp_status {
    if (tiles == nullptr || out == nullptr)
      return report(ErrorKind::kUsage, "the tiles, or the place for the bytes, are a null pointer");
    *out = nullptr;
    auto tile = tiles->set->make({level, x, y});
    if (!tile) return report(tile.error());
    if (bound != nullptr) *bound = (*tile)->bound.value_or(std::numeric_limits<double>::quiet_NaN());
    *out = new scarp_bytes{(*tile)->bytes};
    return SCARP_OK;
  });
}

scarp_status scarp_tiles_read_file(const scarp_tiles* tiles, const char* name, scarp_bytes** out) {
  return guarded([&]() -> scarp_status {
    if (tiles == nullptr || name == nullptr || out == nullptr)
      return report(ErrorKind::kUsage, "the tiles, the name or the place for the bytes is a null pointer");
    *out = nullptr;
    auto bytes = tiles->set->read_file(name);
    if (!bytes) return report(bytes.error());
    *out = new scarp_bytes{std::move(*bytes)};
    return SCARP_OK;
  });
}

void scarp_tiles_free(scarp_tiles* tiles) { delete tiles; }

}  // extern "C"
