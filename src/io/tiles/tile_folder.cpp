#include "scarp/tile_folder.h"

#include <fmt/format.h>
#include <stdlib.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "scarp/version.h"

namespace scarp {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

bool is_number(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

/// What a folder holds that no set of tiles of Scarp's does; empty if there is no such thing.
std::string find_foreign(const fs::path& folder) {
  std::error_code error;
  for (auto at = fs::recursive_directory_iterator(folder, error); !error && at != fs::recursive_directory_iterator();
       at.increment(error)) {
    const fs::path& path = at->path();
    const bool is_level = at.depth() < 2 && at->is_directory() && is_number(path.filename().string());
    const bool is_tile = at.depth() == 2 && path.extension() == ".terrain" && is_number(path.stem().string());
    if (!is_level && !is_tile && !(at.depth() == 0 && path.filename() == "layer.json")) return path.string();
  }
  if (error) return folder.string();
  std::ifstream layer(folder / "layer.json");
  const Json json = Json::parse(layer, nullptr, false);
  if (json.is_object() && json.contains("scarp")) return "";
  return (folder / "layer.json").string();
}

/// Tiles of a level from x to end_x and from y to end_y.
struct TileRange {
  std::uint32_t x = 0, y = 0, end_x = 0, end_y = 0;
};

/// A level's tiles, sorted by row and column, as rectangles.
std::vector<TileRange> find_ranges(const std::vector<std::uint64_t>& tiles) {
  std::vector<TileRange> ranges, open;
  for (std::size_t k = 0; k < tiles.size();) {
    const auto y = static_cast<std::uint32_t>(tiles[k] >> 32);
    std::vector<TileRange> row;
    while (k < tiles.size() && static_cast<std::uint32_t>(tiles[k] >> 32) == y) {
      const auto x = static_cast<std::uint32_t>(tiles[k]);
      if (!row.empty() && row.back().end_x + 1 == x) {
        row.back().end_x = x;
      } else {
        row.push_back({x, y, x, y});
      }
      ++k;
    }
    // A run grows upwards where the row before has the same one.
    for (TileRange& run : row) {
      const auto below = std::find_if(open.begin(), open.end(), [&](const TileRange& one) {
        return one.x == run.x && one.end_x == run.end_x && one.end_y + 1 == y;
      });
      if (below == open.end()) continue;
      run.y = below->y;
      open.erase(below);
    }
    ranges.insert(ranges.end(), open.begin(), open.end());
    open = std::move(row);
  }
  ranges.insert(ranges.end(), open.begin(), open.end());
  return ranges;
}

Result<void> write_whole(const std::string& path, std::span<const std::uint8_t> bytes) {
  std::FILE* file = std::fopen(path.c_str(), "wbx");
  int reason = file == nullptr ? errno : 0;
  if (file != nullptr && std::fwrite(bytes.data(), 1, bytes.size(), file) != bytes.size()) reason = errno;
  if (file != nullptr && std::fclose(file) != 0 && reason == 0) reason = errno;
  if (reason == 0) return {};
  return fail(ErrorKind::kOutput, fmt::format("{} cannot be written: {}", path, std::strerror(reason)));
}

}  // namespace

struct TileFolder::Impl {
  fs::path target, folder;
  PyramidPlan plan;
  bool overwrite = false;
  std::set<std::pair<int, std::uint32_t>> columns;  ///< whose folders are there
  std::uint64_t hash = 0xcbf29ce484222325;          ///< FNV-1a of all tiles in their order

  void add_to_hash(std::span<const std::uint8_t> bytes) {
    for (const std::uint8_t byte : bytes) hash = (hash ^ byte) * 0x100000001b3;
  }
};

TileFolder::TileFolder(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}

TileFolder::~TileFolder() {
  std::error_code ignored;
  if (!impl_->folder.empty()) fs::remove_all(impl_->folder, ignored);
}

Result<std::unique_ptr<TileFolder>> TileFolder::create(const std::string& path, const PyramidPlan& plan,
                                                       bool overwrite) {
  auto impl = std::make_unique<Impl>();
  impl->plan = plan;
  impl->overwrite = overwrite;
  // Without the slash at its end.
  impl->target = fs::path(path).has_filename() ? fs::path(path) : fs::path(path).parent_path();
  std::error_code error;
  if (path.empty()) return fail(ErrorKind::kUsage, "OUTPUT is empty: give the name of a folder to make");
  if (fs::is_symlink(impl->target, error)) impl->target = fs::canonical(impl->target, error);
  if (fs::exists(impl->target, error)) {
    const bool is_empty = fs::is_directory(impl->target, error) && fs::is_empty(impl->target, error);
    const bool is_set = fs::exists(impl->target / "layer.json", error);
    if (!is_empty && !is_set)
      return fail(ErrorKind::kOutput, fmt::format("{} is there and is no set of tiles: give another name", path));
    if (is_set && !overwrite)
      return fail(ErrorKind::kOutput, fmt::format("{} is there already: give another name, or --overwrite", path));
    const std::string foreign = is_set ? find_foreign(impl->target) : "";
    if (!foreign.empty())
      return fail(ErrorKind::kOutput,
                  fmt::format("{} is not Scarp's, and would be deleted with the tiles: give another name", foreign));
  }
  const fs::path beside = fs::absolute(impl->target, error).parent_path();
  std::string name = (beside / ".scarp-tiles-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr)
    return fail(ErrorKind::kOutput,
                fmt::format("no folder can be made in {}: {}", beside.string(), std::strerror(errno)));
  impl->folder = name;
  fs::permissions(impl->folder, fs::perms(0755), error);
  return std::unique_ptr<TileFolder>(new TileFolder(std::move(impl)));
}

Result<std::vector<std::uint8_t>> TileFolder::encode(const TerrainTile& tile) const {
  return compress_gzip(encode_quantized_mesh(tile, impl_->plan.ellipsoid));
}

Result<void> TileFolder::put(TileId id, std::span<const std::uint8_t> bytes) {
  const fs::path column = impl_->folder / std::to_string(id.z) / std::to_string(id.x);
  if (impl_->columns.insert({id.z, id.x}).second) {
    std::error_code error;
    fs::create_directories(column, error);
    if (error) return fail(ErrorKind::kOutput, fmt::format("{} cannot be made: {}", column.string(), error.message()));
  }
  impl_->add_to_hash(bytes);
  return write_whole((column / fmt::format("{}.terrain", id.y)).string(), bytes);
}

Result<void> TileFolder::finish(const PyramidReport& report, const LayerFacts& facts) {
  const PyramidPlan& plan = impl_->plan;
  Json layer{{"tilejson", "2.1.0"},
             {"name", facts.name},
             {"description", facts.description},
             {"version", fmt::format("{:016x}", impl_->hash)},
             {"format", "quantized-mesh-1.0"},
             {"attribution", facts.attribution},
             {"schema", "tms"},
             {"tiles", {"{z}/{x}/{y}.terrain?v={version}"}},
             {"projection", "EPSG:4326"},
             {"bounds", {plan.covered.west, plan.covered.south, plan.covered.east, plan.covered.north}},
             {"minzoom", 0},
             {"maxzoom", plan.max_zoom()},
             {"extensions", {"octvertexnormals"}}};
  Json available = Json::array(), levels = Json::array();
  for (std::size_t z = 0; z < report.tiles.size(); ++z) {
    Json ranges = Json::array();
    for (const TileRange& range : find_ranges(report.tiles[z])) {
      ranges.push_back({{"startX", range.x}, {"startY", range.y}, {"endX", range.end_x}, {"endY", range.end_y}});
    }
    available.push_back(std::move(ranges));
    levels.push_back({{"geometric_error", plan.levels[z].geometric_error},
                      {"max_error", plan.levels[z].max_error},
                      {"quantum", plan.levels[z].quantum},
                      {"node_error", report.levels[z].node_error},
                      {"bound", report.levels[z].bound},
                      {"tiles", report.levels[z].tiles}});
  }
  layer["available"] = std::move(available);
  layer["scarp"] = Json{{"generator", std::string("scarp ") + version()}, {"levels", std::move(levels)}};
  const std::string text = layer.dump(1) + "\n";
  const std::vector<std::uint8_t> bytes(text.begin(), text.end());
  if (auto written = write_whole((impl_->folder / "layer.json").string(), bytes); !written) return written;

  std::error_code error;
  fs::path old;
  if (fs::exists(impl_->target, error)) {
    old = impl_->folder;
    old += ".old";
    fs::rename(impl_->target, old, error);
  }
  if (!error) fs::rename(impl_->folder, impl_->target, error);
  if (error) {
    std::error_code ignored;
    if (!old.empty() && !fs::exists(impl_->target, ignored)) fs::rename(old, impl_->target, ignored);
    return fail(ErrorKind::kOutput,
                fmt::format("{} cannot take its name: {}", impl_->target.string(), error.message()));
  }
  impl_->folder.clear();
  if (!old.empty()) fs::remove_all(old, error);
  return {};
}

}  // namespace scarp
