#include "io/tiles/tile_names.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

namespace scarp {
namespace {

using Parts = std::array<std::string_view, 4>;

/// Parses a column or row as std::to_string() writes it.
std::optional<std::uint32_t> find_number(std::string_view text) {
  constexpr std::size_t kMostDigits = 9;
  if (text.empty() || text.size() > kMostDigits || (text.size() > 1 && text[0] == '0')) return {};
  std::uint32_t number = 0;
  for (const char digit : text) {
    if (digit < '0' || digit > '9') return {};
    number = 10 * number + static_cast<std::uint32_t>(digit - '0');
  }
  return number;
}

/// Stores the parts between slashes and returns their number; 0 for more than four.
std::size_t split(std::string_view name, Parts& parts) {
  std::size_t count = 0;
  for (;;) {
    if (count == parts.size()) return 0;
    const std::size_t slash = name.find('/');
    parts[count++] = name.substr(0, slash);
    if (slash == std::string_view::npos) return count;
    name.remove_prefix(slash + 1);
  }
}

}  // namespace

std::string tile_name(TileFormat format, TileId id) {
  if (format == TileFormat::kQuantizedMesh) return fmt::format("{}/{}/{}.terrain", id.z, id.x, id.y);
  const std::uint32_t root = id.x >> id.z;
  return fmt::format("{}/{}/{}/{}.glb", root, id.z, id.x - (root << id.z), id.y);
}

std::optional<TileId> find_tile_id(TileFormat format, std::string_view name) {
  const bool is_glb = format == TileFormat::kGlb;
  const std::string_view ending = is_glb ? ".glb" : ".terrain";
  if (name.size() <= ending.size() || name.substr(name.size() - ending.size()) != ending) return {};
  name.remove_suffix(ending.size());
  Parts parts;
  const std::size_t count = split(name, parts), first = is_glb ? 1 : 0;
  if (count != first + 3) return {};
  const auto root = is_glb ? find_number(parts[0]) : 0, z = find_number(parts[first]),
             x = find_number(parts[first + 1]), y = find_number(parts[first + 2]);
  if (!root || !z || !x || !y || *z > static_cast<std::uint32_t>(kMaxTileLevel) || *root > 1) return {};
  const std::uint32_t rows = std::uint32_t{1} << *z, cols = is_glb ? rows : 2 * rows;
  if (*x >= cols || *y >= rows) return {};
  return TileId{static_cast<int>(*z), *root * rows + *x, *y};
}

bool io::is_plain_name(std::string_view name) {
  for (;;) {
    const std::size_t slash = name.find('/');
    const std::string_view part = name.substr(0, slash);
    if (part.empty() || part[0] == '.') return false;
    for (const char letter : part) {
      if (letter == '\\' || static_cast<unsigned char>(letter) < ' ') return false;
    }
    if (slash == std::string_view::npos) return true;
    name.remove_prefix(slash + 1);
  }
}

bool io::is_known_name(std::string_view name) {
  constexpr std::string_view kFolder = "subtrees/", kEnding = ".subtree";
  if (name == "layer.json" || name == "tileset.json") return true;
  return is_plain_name(name) && name.substr(0, kFolder.size()) == kFolder && name.size() > kEnding.size() &&
         name.substr(name.size() - kEnding.size()) == kEnding;
}

bool io::bears_mark(std::span<const std::uint8_t> bytes) {
  using Json = nlohmann::json;
  const Json json = Json::parse(bytes.begin(), bytes.end(), nullptr, false);
  if (!json.is_object()) return false;
  if (json.contains("scarp")) return true;
  const auto asset = json.find("asset");
  if (asset == json.end() || !asset->is_object()) return false;
  const auto extras = asset->find("extras");
  return extras != asset->end() && extras->is_object() && extras->contains("scarp");
}

}  // namespace scarp
