#include "io/tiles/subtree_claims.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "io/mesh/file_bytes.h"
#include "io/tiles/json_members.h"

namespace scarp::io {
namespace {

constexpr std::uint32_t kSubtreeMark = 0x74627573;
constexpr std::size_t kHead = 24;
constexpr std::uint64_t kMostLevels = 10;

/// Substitutes {level}, {x} and {y} in a name.
std::string fill_in(std::string name, std::uint64_t level, std::uint64_t x, std::uint64_t y) {
  for (const auto& [key, value] : {std::pair{"{level}", level}, {"{x}", x}, {"{y}", y}}) {
    const std::size_t at = name.find(key);
    if (at != std::string::npos) name.replace(at, std::strlen(key), std::to_string(value));
  }
  return name;
}

/// Collects every second bit, starting with the first.
std::uint32_t gather_bits(std::uint64_t code) {
  std::uint32_t value = 0;
  for (unsigned bit = 0; bit < 32; ++bit) value |= static_cast<std::uint32_t>((code >> (2 * bit)) & 1) << bit;
  return value;
}

/// A subtree file: JSON, and the bytes that it refers to.
class Subtree {
 public:
  /// False for other files.
  bool open(std::span<const std::uint8_t> bytes) {
    if (bytes.size() < kHead || load_number<std::uint32_t>(bytes.data()) != kSubtreeMark) return false;
    const auto length = load_number<std::uint64_t>(bytes.data() + 8),
               rest = load_number<std::uint64_t>(bytes.data() + 16);
    if (length > bytes.size() - kHead || rest != bytes.size() - kHead - length) return false;
    auto json = parse_json({reinterpret_cast<const char*>(bytes.data()) + kHead, length});
    if (!json || !json->is_object()) return false;
    json_ = std::move(*json);
    binary_ = bytes.subspan(kHead + length);
    return true;
  }

  const Json* find(const char* key) const { return find_member(&json_, key); }

  /// `count` bits of an availability; false if unreadable, or miscounted.
  bool read_bits(const Json* availability, std::size_t count, std::vector<bool>& bits) const {
    bits.assign(count, false);
    if (const auto constant = find_count(availability, "constant")) {
      bits.assign(count, *constant == 1);
      return *constant <= 1;
    }
    const auto view = find_count(availability, "bitstream");
    std::span<const std::uint8_t> bytes;
    if (!view || !find_view(*view, bytes) || bytes.size() != (count + 7) / 8) return false;
    for (std::size_t k = 0; k < count; ++k) bits[k] = ((bytes[k / 8] >> (k % 8)) & 1) != 0;
    const auto claimed = find_count(availability, "availableCount");
    return !claimed || *claimed == static_cast<std::uint64_t>(std::count(bits.begin(), bits.end(), true));
  }

  /// The numbers of a property, `width` for each of `count` tiles; empty if unreadable.
  std::vector<double> read_property(const char* name, std::size_t count, std::size_t width) const {
    const Json* const tables = find("propertyTables");
    if (tables == nullptr || !tables->is_array() || tables->empty()) return {};
    const Json* const property = find_member(find_member(&tables->front(), "properties"), name);
    const auto view = find_count(property, "values");
    std::span<const std::uint8_t> bytes;
    if (!view || !find_view(*view, bytes) || bytes.size() < 8 * count * width) return {};
    std::vector<double> numbers(count * width);
    for (std::size_t k = 0; k < numbers.size(); ++k) numbers[k] = load_number<double>(bytes.data() + 8 * k);
    return numbers;
  }

 private:
  bool find_view(std::uint64_t index, std::span<const std::uint8_t>& bytes) const {
    const Json* const views = find("bufferViews");
    if (views == nullptr || !views->is_array() || index >= views->size()) return false;
    const Json& view = (*views)[index];
    const auto offset = find_count(&view, "byteOffset"), size = find_count(&view, "byteLength");
    if (!offset || !size || *offset > binary_.size() || *size > binary_.size() - *offset) return false;
    bytes = binary_.subspan(*offset, *size);
    return true;
  }

  Json json_;
  std::span<const std::uint8_t> binary_;
};

class SubtreeWalk {
 public:
  SubtreeWalk(const TileSetReader& set, SetClaims& claims) : set_(set), claims_(claims), names_(set.files()) {}

  void walk(const Json& tileset) {
    std::vector<const Json*> waiting{find_member(&tileset, "root")};
    while (!waiting.empty()) {
      const Json* const tile = waiting.back();
      waiting.pop_back();
      if (const Json* const tiling = find_member(tile, "implicitTiling")) walk_root(*tile, *tiling);
      const Json* const children = find_member(tile, "children");
      if (children == nullptr || !children->is_array()) continue;
      for (const Json& child : *children) waiting.push_back(&child);
    }
    if (roots_ == 0) claims_.faults.emplace_back("tileset.json has no tile with implicit tiling");
    for (const std::string& name : names_) {
      if (name.rfind("subtrees/", 0) == 0 && !std::binary_search(seen_.begin(), seen_.end(), name))
        claims_.faults.push_back(fmt::format("{} belongs to no tile that is announced", name));
    }
  }

 private:
  void walk_root(const Json& tile, const Json& tiling) {
    ++roots_;
    content_ = find_text(find_member(&tile, "content"), "uri");
    subtrees_ = find_text(find_member(&tiling, "subtrees"), "uri");
    const auto levels = find_count(&tiling, "subtreeLevels");
    if (!levels || *levels < 1 || *levels > kMostLevels || content_.empty() || subtrees_.empty()) {
      claims_.faults.emplace_back("tileset.json has an implicit tiling that makes no sense");
      return;
    }
    levels_ = static_cast<int>(*levels);
    struct Corner {
      int z;
      std::uint32_t x, y;
    };
    std::vector<Corner> waiting{{0, 0, 0}};
    while (!waiting.empty()) {
      const Corner at = waiting.back();
      waiting.pop_back();
      const std::string name = fill_in(subtrees_, static_cast<std::uint64_t>(at.z), at.x, at.y);
      seen_.insert(std::lower_bound(seen_.begin(), seen_.end(), name), name);
      std::vector<bool> below;
      if (!read(name, at.z, at.x, at.y, below)) {
        claims_.faults.push_back(
            fmt::format("{} is missing, damaged, or is not of {} levels (subtreeLevels)", name, levels_));
        continue;
      }
      for (std::size_t k = 0; k < below.size(); ++k) {
        if (below[k] && at.z + levels_ <= kMaxTileLevel)
          waiting.push_back(
              {at.z + levels_, (at.x << levels_) + gather_bits(k), (at.y << levels_) + gather_bits(k >> 1)});
      }
    }
  }

  bool read(const std::string& name, int z, std::uint32_t x, std::uint32_t y, std::vector<bool>& below) {
    if (!std::binary_search(names_.begin(), names_.end(), name)) return false;
    const auto bytes = set_.read_file(name);
    Subtree subtree;
    if (!bytes || !subtree.open(*bytes)) return false;
    const std::size_t count = ((std::size_t{1} << (2 * levels_)) - 1) / 3;
    std::vector<bool> tiles, contents;
    const Json* const of_contents = subtree.find("contentAvailability");
    if (of_contents == nullptr || !of_contents->is_array() || of_contents->size() != 1) return false;
    if (!subtree.read_bits(subtree.find("tileAvailability"), count, tiles) ||
        !subtree.read_bits(&of_contents->front(), count, contents) ||
        !subtree.read_bits(subtree.find("childSubtreeAvailability"), std::size_t{1} << (2 * levels_), below))
      return false;
    const auto there = static_cast<std::size_t>(std::count(tiles.begin(), tiles.end(), true));
    const std::vector<double> lows = subtree.read_property("min_height", there, 1),
                              highs = subtree.read_property("max_height", there, 1),
                              spheres = subtree.read_property("sphere", there, 4),
                              horizons = subtree.read_property("horizon_point", there, 3);
    const bool has_facts = !lows.empty() && !highs.empty() && !spheres.empty();
    std::size_t first = 0, row = 0;
    for (int deeper = 0; deeper < levels_; ++deeper) {
      const std::size_t of_level = std::size_t{1} << (2 * deeper);
      for (std::size_t code = 0; code < of_level; ++code) {
        if (!tiles[first + code]) {
          if (contents[first + code]) return false;
          continue;
        }
        const std::size_t k = row++;
        if (!contents[first + code]) continue;
        const std::string tile = fill_in(content_, static_cast<std::uint64_t>(z + deeper),
                                         (x << deeper) + gather_bits(code), (y << deeper) + gather_bits(code >> 1));
        const auto id = find_tile_id(set_.format(), tile);
        if (!id) return false;
        announce(*id);
        if (!has_facts) continue;
        TileFacts& facts = claims_.facts[{id->z, id->y, id->x}];
        facts.min_height = lows[k];
        facts.max_height = highs[k];
        std::copy_n(spheres.begin() + static_cast<std::ptrdiff_t>(4 * k), 4, facts.sphere.begin());
        if (!horizons.empty())
          std::copy_n(horizons.begin() + static_cast<std::ptrdiff_t>(3 * k), 3, facts.horizon_point.begin());
      }
      first += of_level;
    }
    return true;
  }

  void announce(TileId id) {
    const auto z = static_cast<std::size_t>(id.z);
    if (claims_.levels.size() <= z) claims_.levels.resize(z + 1);
    claims_.levels[z].push_back({id.x, id.y, id.x, id.y});
  }

  const TileSetReader& set_;
  SetClaims& claims_;
  std::vector<std::string> names_, seen_;
  std::string content_, subtrees_;
  int levels_ = 1, roots_ = 0;
};

}  // namespace

void read_subtrees(const TileSetReader& set, const Json& tileset, SetClaims& claims) {
  SubtreeWalk(set, claims).walk(tileset);
}

}  // namespace scarp::io
