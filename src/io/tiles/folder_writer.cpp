#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <set>
#include <utility>

#include "io/file_reason.h"
#include "io/tiles/byte_source.h"
#include "io/tiles/folder_set.h"
#include "io/tiles/staged_folder.h"
#include "io/tiles/tile_names.h"

namespace scarp::io {
namespace {

namespace fs = std::filesystem;

/// A file or folder that does not belong to a set of Scarp's tiles; empty if none.
std::string find_foreign(const fs::path& folder) {
  std::error_code error;
  for (auto at = fs::recursive_directory_iterator(folder, error); !error && at != fs::recursive_directory_iterator();
       at.increment(error)) {
    const std::string name = at->path().lexically_relative(folder).generic_string();
    const bool is_part = name.find_first_not_of("0123456789/") == std::string::npos || name == "subtrees" ||
                         name.rfind("subtrees/", 0) == 0;
    const bool is_file =
        find_tile_id(TileFormat::kQuantizedMesh, name) || find_tile_id(TileFormat::kGlb, name) || is_known_name(name);
    if (!(at->is_directory() && !at->is_symlink() ? is_part : is_file)) return at->path().string();
  }
  if (error) return folder.string();
  std::string foreign;
  for (const char* const name : {"layer.json", "tileset.json"}) {
    const fs::path path = folder / name;
    const auto source = ByteSource::open(path.string());
    if (!source) continue;
    const auto bytes = (*source)->read(0, (*source)->size());
    if (bytes && bears_mark(*bytes)) return "";
    foreign = path.string();
  }
  return foreign.empty() ? folder.string() : foreign;
}

Result<void> check_ours(const fs::path& folder) {
  const std::string foreign = find_foreign(folder);
  if (foreign.empty()) return {};
  return fail(ErrorKind::kOutput,
              fmt::format("{} is not Scarp's, and would be deleted with the tiles: give another name", foreign));
}

/// 0, or an errno.
int write_whole(const std::string& path, std::span<const std::uint8_t> bytes) {
  std::FILE* file = std::fopen(path.c_str(), "wbx");
  int reason = file == nullptr ? errno : 0;
  if (file != nullptr && std::fwrite(bytes.data(), 1, bytes.size(), file) != bytes.size()) reason = errno;
  if (file != nullptr && std::fclose(file) != 0 && reason == 0) reason = errno;
  return reason;
}

class FolderWriter final : public TileSetWriter {
 public:
  FolderWriter(fs::path target, StagedFolder folder, TileFormat format, bool replaces)
      : target_(std::move(target)), folder_(std::move(folder)), format_(format), replaces_(replaces) {}

  Result<void> put_tile(TileId id, std::span<const std::uint8_t> bytes) override {
    return put_file(tile_name(format_, id), bytes);
  }
  Result<void> put_file(const std::string& name, std::span<const std::uint8_t> bytes) override {
    const fs::path path = folder_.path() / name;
    std::error_code error;
    if (folders_.insert(path.parent_path().string()).second) fs::create_directories(path.parent_path(), error);
    const int reason = error ? error.value() : write_whole(path.string(), bytes);
    if (reason == 0) return {};
    return fail(ErrorKind::kOutput,
                fmt::format("cannot write {} of {}: {}", name, target_.string(), reason_of(reason)));
  }
  Result<void> finish() override {
    std::error_code error;
    fs::path old;
    if (replaces_) {
      // Its contents may have changed.
      SCARP_RETURN_IF_ERROR(check_ours(target_));
      old = folder_.path_of_old();
      fs::rename(target_, old, error);
    }
    if (!error) fs::rename(folder_.path(), target_, error);
    if (error) {
      std::error_code ignored;
      if (!old.empty() && !fs::exists(target_, ignored)) fs::rename(old, target_, ignored);
      return fail(ErrorKind::kOutput, fmt::format("{} cannot take its name: {}", target_.string(), error.message()));
    }
    folder_.release();
    if (!old.empty()) fs::remove_all(old, error);
    return {};
  }

 private:
  fs::path target_;
  StagedFolder folder_;
  TileFormat format_;
  bool replaces_;                  ///< an existing set of Scarp's
  std::set<std::string> folders_;  ///< folders created
};

}  // namespace

Result<std::unique_ptr<TileSetWriter>> create_folder_set(const std::string& path, TileFormat format, bool overwrite) {
  // Without a trailing slash.
  fs::path target = fs::path(path).has_filename() ? fs::path(path) : fs::path(path).parent_path();
  bool replaces = false;
  std::error_code error;
  if (fs::is_symlink(target, error)) target = fs::canonical(target, error);
  if (fs::exists(target, error)) {
    const bool is_empty = fs::is_directory(target, error) && fs::is_empty(target, error);
    const bool is_set = fs::exists(target / "layer.json", error) || fs::exists(target / "tileset.json", error);
    if (!is_empty && !is_set)
      return fail(ErrorKind::kOutput, fmt::format("{} is there and is no set of tiles: give another name", path));
    if (is_set && !overwrite)
      return fail(ErrorKind::kOutput, fmt::format("{} is there already: give another name, or --overwrite", path));
    if (is_set) {
      SCARP_RETURN_IF_ERROR(check_ours(target));
    }
    replaces = is_set;
  }
  SCARP_TRY(auto&& folder, StagedFolder::create_beside(target));
  return std::make_unique<FolderWriter>(std::move(target), std::move(folder), format, replaces);
}

}  // namespace scarp::io
