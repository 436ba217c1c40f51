#include "io/tiles/set_archive.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "io/tiles/tile_names.h"

namespace scarp::io {
namespace {

constexpr Archive kArchives[] = {{".pmtiles", write_pmtiles, open_pmtiles},
                                 {".mbtiles", write_mbtiles, open_mbtiles},
                                 {".3tz", write_3tz, open_3tz}};

/// Fails if the existing file is not Scarp's.
Result<void> check_replaced(const Archive& archive, const std::string& path) {
  const auto refuse = [&](const std::string& why) {
    return fail(ErrorKind::kOutput, fmt::format("{} is there and is not Scarp's{}: give another name", path, why));
  };
  const auto set = archive.open(path);
  if (!set) return refuse(fmt::format(" (as a set of tiles it cannot be read: {})", set.error().message));
  for (const char* const name : {"layer.json", "tileset.json"}) {
    const auto bytes = (*set)->read_file(name);
    if (bytes && bears_mark(*bytes)) return {};
  }
  return refuse("");
}

class ArchiveWriter final : public TileSetWriter {
 public:
  ArchiveWriter(const Archive& archive, TileFormat format, std::unique_ptr<TileSpool> spool, StagedFile file,
                bool replaces)
      : archive_(&archive), format_(format), spool_(std::move(spool)), file_(std::move(file)), replaces_(replaces) {}

  Result<void> put_tile(TileId id, std::span<const std::uint8_t> bytes) override { return spool_->add(id, bytes); }
  Result<void> put_file(const std::string& name, std::span<const std::uint8_t> bytes) override {
    return spool_->add(name, bytes);
  }
  Result<void> finish() override {
    SCARP_RETURN_IF_ERROR(archive_->write(*spool_, format_, file_));
    SCARP_RETURN_IF_ERROR(file_.end());
    return file_.take_name(replaces_);
  }

 private:
  const Archive* archive_;
  TileFormat format_;
  std::unique_ptr<TileSpool> spool_;
  StagedFile file_;
  bool replaces_;
};

}  // namespace

const Archive* find_archive(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char& c : ending) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  for (const Archive& archive : kArchives) {
    if (ending == archive.ending) return &archive;
  }
  return nullptr;
}

Result<std::unique_ptr<TileSetWriter>> create_archive_set(const Archive& archive, const std::string& path,
                                                          TileFormat format, bool overwrite) {
  std::error_code error;
  const bool is_there = std::filesystem::is_regular_file(path, error);
  if (is_there && overwrite) {
    SCARP_RETURN_IF_ERROR(check_replaced(archive, path));
  }
  SCARP_TRY(auto&& file, StagedFile::begin(path, overwrite, true));
  if (file.is_direct())
    return fail(ErrorKind::kOutput, fmt::format("cannot write {}: a set of tiles goes to a file or a folder", path));
  SCARP_TRY(auto&& spool, TileSpool::create_beside(path));
  return std::make_unique<ArchiveWriter>(archive, format, std::move(spool), std::move(file), is_there);
}

Result<void> ChunkedOutput::add(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kChunk = std::size_t{1} << 20;
  position_ += bytes.size();
  waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
  if (waiting_.size() < kChunk) return {};
  return flush();
}

Result<void> ChunkedOutput::flush() {
  auto written = file_->write(waiting_);
  waiting_.clear();
  return written;
}

SetFacts facts_of(const TileSpool& spool) {
  using Json = nlohmann::json;
  SetFacts facts;
  for (const TileSpool::File& file : spool.files()) {
    if (file.name != "layer.json") continue;
    const auto bytes = spool.read(file);
    const Json layer = bytes ? Json::parse(bytes->begin(), bytes->end(), nullptr, false) : Json();
    if (!layer.is_object()) continue;
    const auto take = [&](const char* key, std::string& text) {
      const auto found = layer.find(key);
      if (found != layer.end() && found->is_string()) text = found->get<std::string>();
    };
    take("name", facts.name);
    take("description", facts.description);
    take("attribution", facts.attribution);
    std::string projection;
    take("projection", projection);
    facts.grid = TileGrid::find_projection(projection).value_or(TileGrid{});
    const auto bounds = layer.find("bounds");
    if (bounds == layer.end() || !bounds->is_array() || bounds->size() != 4) continue;
    double* const sides[] = {&facts.bounds.west, &facts.bounds.south, &facts.bounds.east, &facts.bounds.north};
    for (std::size_t k = 0; k < 4; ++k) {
      if ((*bounds)[k].is_number()) *sides[k] = std::clamp((*bounds)[k].get<double>(), -360.0, 360.0);
    }
  }
  return facts;
}

std::string_view media_type(TileFormat format) {
  return format == TileFormat::kGlb ? "model/gltf-binary" : "application/vnd.quantized-mesh";
}

}  // namespace scarp::io
