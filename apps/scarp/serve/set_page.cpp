#include "serve/set_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "session/plan/page_template.h"
#include "session/reports/level_pages.h"
#include "session/reports/view_page.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

constexpr std::size_t kMostMadeTiles = 64, kMostDrawnTiles = 2000;

/// The finest level with at most `most_tiles` tiles.
std::size_t find_level(const TileSetReader& set, std::size_t most_tiles) {
  const auto& levels = set.tiles();
  std::size_t found = 0;
  for (std::size_t z = 0; z < levels.size(); ++z) {
    if (!levels[z].empty() && (levels[z].size() <= most_tiles || levels[found].empty())) found = z;
  }
  return found;
}

/// One level of a set, since each further level would cost as much time.
class OneLevel final : public TileSetReader {
 public:
  OneLevel(const TileSetReader& set, std::size_t z) : set_(set), tiles_(z + 1) { tiles_[z] = set.tiles()[z]; }
  TileFormat format() const override { return set_.format(); }
  const std::vector<std::vector<std::uint64_t>>& tiles() const override { return tiles_; }
  std::vector<std::string> files() const override { return set_.files(); }
  Result<std::vector<std::uint8_t>> read_tile(TileId id) const override { return set_.read_tile(id); }
  Result<std::vector<std::uint8_t>> read_file(const std::string& name) const override { return set_.read_file(name); }

 private:
  const TileSetReader& set_;
  std::vector<std::vector<std::uint64_t>> tiles_;
};

std::string escape_html(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '<' || c == '>' || c == '&' || c == '"')
      safe += fmt::format("&#{};", static_cast<int>(c));
    else
      safe += c;
  }
  return safe;
}

std::string draw_tiles(const TileSetReader& set, std::size_t z) {
  if (z >= set.tiles().size()) return "";
  const TileGrid grid = find_grid(set);
  std::optional<DegreeBox> all;
  std::string tiles;
  for (const std::uint64_t at : set.tiles()[z]) {
    const DegreeBox box =
        grid.bounds_of({static_cast<int>(z), static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(at >> 32)});
    if (!all) all = box;
    all = {std::min(all->west, box.west), std::min(all->south, box.south), std::max(all->east, box.east),
           std::max(all->north, box.north)};
    tiles += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>", box.west, -box.north,
                         box.east - box.west, box.north - box.south);
  }
  if (!all) return "";
  return fmt::format(
      "<svg viewBox=\"{} {} {} {}\" fill=\"#9db8a0\" stroke=\"#fff\">{}</svg>\n<p>Level {}: {}, x {:.6g} to {:.6g}, y "
      "{:.6g} to {:.6g}.</p>\n",
      all->west, -all->north, all->east - all->west, all->north - all->south, tiles, z,
      format_plural(set.tiles()[z].size(), "tile"), all->west, all->east, all->south, all->north);
}

std::string make_map_page(const std::string& name, const TileSetReader& set) {
  std::string links;
  for (const std::string& file : set.files()) {
    if (file.find('/') == std::string::npos) links += fmt::format("<li><a href=\"{0}\">{0}</a>\n", escape_html(file));
  }
  const bool is_terrain = set.format() == TileFormat::kQuantizedMesh;
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><meta charset=\"utf-8\"><title>{0}</title>\n"
      "<style>body{{font:16px/1.5 sans-serif;max-width:60em;margin:2em auto;padding:0 1em}}"
      "svg{{width:100%;max-height:60vh;background:#e8eef2}}rect{{vector-effect:non-scaling-stroke}}"
      "pre{{background:#f4f4f4;padding:.5em;overflow:auto}}</style>\n"
      "<h1>{0}</h1>\n{1}<ul>\n{2}<li><a href=\"index.txt\">index.txt</a>: all files\n</ul>\n"
      "<p>CesiumJS shows it by</p>\n<pre>await Cesium.{3}</pre>\n",
      escape_html(name), draw_tiles(set, find_level(set, kMostDrawnTiles)), links,
      is_terrain ? "CesiumTerrainProvider.fromUrl(\"/\", {requestVertexNormals: true})"
                 : "Cesium3DTileset.fromUrl(\"/tileset.json\")");
}

}  // namespace

std::vector<std::uint8_t> make_set_page(const std::string& name, const TileSetReader& set, bool makes_tiles) {
  if (const auto page_template = read_page_template()) {
    std::optional<OneLevel> level;
    if (makes_tiles) level.emplace(set, find_level(set, kMostMadeTiles));
    const auto levels = check::read_level_meshes(level ? *level : set, kMostTileBytes);
    const auto meshes = levels ? encode_levels(name, *levels) : tl::unexpected(levels.error());
    if (meshes) {
      if (auto page = make_view_page(*page_template, name, *meshes, nullptr)) return std::move(page->html);
    }
  }
  const std::string page = make_map_page(name, set);
  return {page.begin(), page.end()};
}

std::string list_set(const TileSetReader& set, const std::string& file_url) {
  std::string text = "scarp serve\n";
  for (const std::string& name : set.files()) {
    if (name.rfind("subtrees/", 0) != 0) text += "/" + name + "\n";
  }
  text += set.format() == TileFormat::kGlb ? "/{root}/{z}/{x}/{y}.glb\n" : "/{z}/{x}/{y}.terrain\n";
  return text + file_url;
}

}  // namespace scarp::cli
