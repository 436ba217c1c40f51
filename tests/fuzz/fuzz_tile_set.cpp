// Any bytes as a tileset in one file: a set that can be checked, read and rewritten, or an error with a message. The
// first byte chooses the container.
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "scarp/tile_set.h"

namespace {

/// Removed with the process.
struct Scratch {
  std::string folder = (std::filesystem::temp_directory_path() / ("scarp-fuzz-" + std::to_string(getpid()))).string();
  Scratch() { std::filesystem::create_directory(folder); }
  ~Scratch() { std::filesystem::remove_all(folder); }
};

void check(const scarp::Error& error) {
  if (error.message.empty() || error.kind != scarp::ErrorKind::kInput) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Scratch scratch;
  static const char* const kEndings[] = {"pmtiles", "mbtiles", "3tz"};
  if (size == 0) return 0;
  const std::string ending = kEndings[data[0] % 3], path = scratch.folder + "/set." + ending;
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(data + 1), static_cast<std::streamsize>(size - 1));
  const auto reader = scarp::open_tile_set(path);
  if (!reader) {
    check(reader.error());
    return 0;
  }
  std::size_t tiles = 0;
  for (const auto& level : (*reader)->tiles()) tiles += level.size();
  constexpr std::size_t kMostChecked = 4096;
  scarp::TileCheckOptions options;
  options.run.threads = 1;
  if (tiles <= kMostChecked && !scarp::check_tiles(**reader, options)) std::abort();
  const std::string copy = scratch.folder + "/copy." + ending;
  auto writer = scarp::create_tile_set(copy, (*reader)->format(), false);
  if (!writer) std::abort();
  bool is_whole = true;
  for (std::size_t z = 0; z < (*reader)->tiles().size(); ++z) {
    for (const std::uint64_t at : (*reader)->tiles()[z]) {
      const scarp::TileId id{static_cast<int>(z), static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(at >> 32)};
      const auto tile = (*reader)->read_tile(id);
      if (!tile) check(tile.error());
      is_whole = is_whole && tile && (*writer)->put_tile(id, *tile);
    }
  }
  for (const std::string& name : (*reader)->files()) {
    const auto file = (*reader)->read_file(name);
    if (!file) check(file.error());
    is_whole = is_whole && file && (*writer)->put_file(name, *file);
  }
  if (!is_whole || !(*writer)->finish()) return 0;
  const auto again = scarp::open_tile_set(copy);
  if (!again || (*again)->tiles() != (*reader)->tiles() || (*again)->files() != (*reader)->files()) std::abort();
  std::filesystem::remove(copy);
  return 0;
}
