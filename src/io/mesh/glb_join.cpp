// Joins several GLB files. The arrays, accessors, images and materials of each are kept and renumbered.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/mesh/file_bytes.h"
#include "io/mesh/glb_json.h"
#include "io/mesh/glb_numbers.h"
#include "scarp/io.h"

namespace scarp::io {
namespace {

constexpr std::size_t kHeader = 12, kChunkHeader = 8;

/// A file written by encode_mesh().
struct Part {
  Json json;
  std::span<const std::uint8_t> binary;

  explicit Part(std::span<const std::uint8_t> bytes) {
    const std::size_t text = load_number<std::uint32_t>(&bytes[kHeader]), begin = kHeader + kChunkHeader;
    json = Json::parse(bytes.begin() + begin, bytes.begin() + static_cast<std::ptrdiff_t>(begin + text));
    binary = bytes.subspan(begin + text + kChunkHeader);
  }
};

std::size_t count(const Json& json, const char* list) { return json.contains(list) ? json[list].size() : 0; }

void shift(Json& object, const char* key, std::size_t by) {
  if (object.contains(key)) object[key] = object[key].get<std::size_t>() + by;
}

/// In materials and their extensions, "index" refers to a texture.
void shift_textures(Json& value, std::size_t by) {
  if (value.is_object() && value.contains("index")) shift(value, "index", by);
  if (!value.is_structured()) return;
  for (auto& child : value) shift_textures(child, by);
}

/// Appends parts to the first.
class Joining {
 public:
  explicit Joining(Part first) : json_(std::move(first.json)), binary_(first.binary.begin(), first.binary.end()) {}

  void append(Part part) {
    Json& more = part.json;
    const std::size_t views = count(json_, "bufferViews"), buffers = count(json_, "buffers") - 1;
    const auto place = [&](Json& view) {
      if (view["buffer"] != 0) return shift(view, "buffer", buffers);
      view["byteOffset"] = view.value("byteOffset", std::size_t{0}) + binary_.size();
    };
    for (Json& view : more["bufferViews"]) {
      place(view);
      if (!view.contains("extensions")) continue;
      for (Json& extension : view["extensions"]) {
        if (extension.contains("buffer")) place(extension);
      }
    }
    for (const char* list : {"accessors", "images"}) {
      for (std::size_t k = 0; k < count(more, list); ++k) shift(more[list][k], "bufferView", views);
    }
    for (std::size_t k = 0; k < count(more, "textures"); ++k) {
      Json& texture = more["textures"][k];
      shift(texture, "source", count(json_, "images"));
      shift(texture, "sampler", count(json_, "samplers"));
      if (!texture.contains("extensions")) continue;
      for (Json& extension : texture["extensions"]) shift(extension, "source", count(json_, "images"));
    }
    for (std::size_t k = 0; k < count(more, "materials"); ++k)
      shift_textures(more["materials"][k], count(json_, "textures"));
    for (Json& mesh : more["meshes"]) {
      for (Json& primitive : mesh["primitives"]) {
        for (Json& accessor : primitive["attributes"])
          accessor = accessor.get<std::size_t>() + count(json_, "accessors");
        shift(primitive, "indices", count(json_, "accessors"));
        shift(primitive, "material", count(json_, "materials"));
      }
    }
    for (Json& node : more["nodes"]) shift(node, "mesh", count(json_, "meshes"));
    for (const char* list : {"accessors", "bufferViews", "images", "textures", "samplers", "materials", "meshes"}) {
      for (std::size_t k = 0; k < count(more, list); ++k) json_[list].push_back(more[list][k]);
    }
    for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
      for (std::size_t k = 0; k < count(more, list); ++k) {
        Json& known = json_[list];
        if (std::find(known.begin(), known.end(), more[list][k]) == known.end()) known.push_back(more[list][k]);
      }
    }
    json_["nodes"].push_back(more["nodes"][0]);
    for (std::size_t k = 1; k < count(more, "buffers"); ++k) json_["buffers"].push_back(more["buffers"][k]);
    binary_.insert(binary_.end(), part.binary.begin(), part.binary.end());
  }

  void make_levels(double ratio) {
    Json& nodes = json_["nodes"];
    Json others = Json::array(), coverage = Json::array();
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      nodes[k]["name"] = fmt::format("{}_LOD{}", nodes[k].value("name", "terrain"), k);
      if (k > 0) others.push_back(k);
      coverage.push_back(k + 1 == nodes.size() ? 0.0 : std::pow(ratio, -2.0 * static_cast<double>(k + 1)));
    }
    nodes[0]["extensions"]["MSFT_lod"] = {{"ids", others}};
    nodes[0]["extras"]["MSFT_screencoverage"] = coverage;
    json_["extensionsUsed"].push_back("MSFT_lod");
  }

  void show_all() {
    Json& nodes = json_["scenes"][0]["nodes"] = Json::array();
    for (std::size_t k = 0; k < json_["nodes"].size(); ++k) nodes.push_back(k);
  }

  Result<std::vector<std::uint8_t>> finish() {
    json_["buffers"][0]["byteLength"] = binary_.size();
    std::string text = print_json(json_);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::uint64_t total = kHeader + 2 * kChunkHeader + text.size() + binary_.size();
    if (total > std::numeric_limits<std::uint32_t>::max())
      return fail(ErrorKind::kOutput,
                  "a GLB file holds less than 4 GiB, and these meshes need more: write a file each");
    std::vector<std::uint8_t> bytes(total);
    std::uint8_t* at = bytes.data();
    constexpr std::uint32_t kMagic = 0x46546C67;
    for (const std::uint32_t word : {kMagic, std::uint32_t{2}, static_cast<std::uint32_t>(total),
                                     static_cast<std::uint32_t>(text.size()), kJsonChunk})
      store_number(at, word);
    std::memcpy(at, text.data(), text.size());
    at += text.size();
    store_number(at, static_cast<std::uint32_t>(binary_.size()));
    store_number(at, kBinaryChunk);
    std::memcpy(at, binary_.data(), binary_.size());
    return bytes;
  }

 private:
  Json json_;
  std::vector<std::uint8_t> binary_;
};

Joining join(std::span<const std::vector<std::uint8_t>> files) {
  Joining joining{Part(files.front())};
  for (const auto& file : files.subspan(1)) joining.append(Part(file));
  return joining;
}

}  // namespace

}  // namespace scarp::io

namespace scarp {

Result<std::vector<std::uint8_t>> join_glb_levels(std::span<const std::vector<std::uint8_t>> levels, double ratio) {
  io::Joining joining = io::join(levels);
  joining.make_levels(ratio);
  return joining.finish();
}

Result<std::vector<std::uint8_t>> join_glbs(std::span<const std::vector<std::uint8_t>> files) {
  io::Joining joining = io::join(files);
  joining.show_all();
  return joining.finish();
}

}  // namespace scarp
