#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/tiles/set_archive.h"
#include "io/tiles/sqlite.h"
#include "io/tiles/tile_levels.h"
#include "io/tiles/tile_names.h"

namespace scarp::io {
namespace {

/// Limits the steps of a query, since a hostile database's views can make it endless. The limit is far above the need
/// of an honest file of `size` bytes. Queries run one at a time.
class Question {
 public:
  Question(sqlite3* database, std::uint64_t size) : database_(database), left_((kLeastSteps + 20 * size) / kEach) {
    sqlite3_mutex_enter(sqlite3_db_mutex(database_));
    sqlite3_progress_handler(database_, kEach, &Question::count, this);
  }
  Question(const Question&) = delete;
  Question& operator=(const Question&) = delete;
  ~Question() {
    sqlite3_progress_handler(database_, 0, nullptr, nullptr);
    sqlite3_mutex_leave(sqlite3_db_mutex(database_));
  }

 private:
  static constexpr int kEach = 10000;
  static constexpr std::uint64_t kLeastSteps = 10'000'000;
  static int count(void* self) {
    auto& left = static_cast<Question*>(self)->left_;
    if (left == 0) return 1;
    --left;
    return 0;
  }

  sqlite3* database_;
  std::uint64_t left_;
};

class MbtilesReader final : public TileSetReader {
 public:
  static Result<std::unique_ptr<TileSetReader>> open(const std::string& path) {
    // also reports failures in Scarp's words
    SCARP_TRY(const auto& source, ByteSource::open(path));
    std::unique_ptr<MbtilesReader> reader(new MbtilesReader(path, source->size()));
    SCARP_RETURN_IF_ERROR(reader->read_contents());
    return reader;
  }

  TileFormat format() const override { return format_; }
  const std::vector<std::vector<std::uint64_t>>& tiles() const override { return levels_.levels(); }
  std::vector<std::string> files() const override { return files_; }
  Result<std::vector<std::uint8_t>> read_tile(TileId id) const override {
    if (!is_of_grid(id) || !levels_.has(id)) return refuse(fmt::format("holds no {}", tile_name(format_, id)));
    const Question question(database_.get(), size_);
    const auto select =
        prepare(database_.get(),
                "SELECT tile_data FROM tiles WHERE zoom_level = ? AND tile_column = ? AND tile_row = ? LIMIT 1");
    if (!select) return damaged();
    sqlite3_bind_int64(select.get(), 1, id.z);
    sqlite3_bind_int64(select.get(), 2, id.x);
    sqlite3_bind_int64(select.get(), 3, id.y);
    return read_blob(select.get());
  }
  Result<std::vector<std::uint8_t>> read_file(const std::string& name) const override {
    if (!std::binary_search(files_.begin(), files_.end(), name)) return refuse(fmt::format("holds no {}", name));
    const Question question(database_.get(), size_);
    const auto select = prepare(database_.get(), "SELECT data FROM files WHERE name = ? LIMIT 1");
    if (!select) return damaged();
    bind_text(select.get(), 1, name);
    return read_blob(select.get());
  }
  std::vector<std::string> find_faults() const override {
    std::vector<std::string> faults;
    const Question question(database_.get(), size_);
    const auto check = prepare(database_.get(), "PRAGMA integrity_check(1)");
    if (!check || sqlite3_step(check.get()) != SQLITE_ROW || column_text(check.get(), 0) != "ok")
      faults.push_back(fmt::format("{}: SQLite finds it damaged: {}", path_,
                                   check ? column_text(check.get(), 0) : sqlite3_errmsg(database_.get())));
    const auto& levels = levels_.levels();
    const auto first = std::find_if(levels.begin(), levels.end(), [](const auto& level) { return !level.empty(); });
    for (const auto& [key, level] : {std::pair{"minzoom", first - levels.begin()},
                                     std::pair{"maxzoom", static_cast<std::ptrdiff_t>(levels.size()) - 1}}) {
      const auto select = prepare(database_.get(), "SELECT value FROM metadata WHERE name = ?");
      if (!select) continue;
      bind_text(select.get(), 1, key);
      if (sqlite3_step(select.get()) == SQLITE_ROW && column_text(select.get(), 0) != std::to_string(level))
        faults.push_back(fmt::format("{}: its metadata say that {} is {}, and it is {}", path_, key,
                                     column_text(select.get(), 0), level));
    }
    return faults;
  }

 private:
  MbtilesReader(std::string path, std::uint64_t size) : path_(std::move(path)), size_(size) {}

  tl::unexpected<Error> refuse(const std::string& why) const {
    return fail(ErrorKind::kInput, fmt::format("{} {}", path_, why));
  }
  tl::unexpected<Error> damaged() const {
    return refuse(fmt::format("is no MBTiles file or is damaged: {}", sqlite3_errmsg(database_.get())));
  }
  Result<std::vector<std::uint8_t>> read_blob(sqlite3_stmt* select) const {
    const int step = sqlite3_step(select);
    if (step == SQLITE_ROW) return column_blob(select, 0);
    if (step == SQLITE_DONE) return refuse("is damaged: what it lists is not in it");
    return damaged();
  }

  Result<void> read_contents() {
    sqlite3* handle = nullptr;
    const int opened = sqlite3_open_v2(path_.c_str(), &handle, SQLITE_OPEN_READONLY | SQLITE_OPEN_FULLMUTEX, nullptr);
    database_.reset(handle);
    if (opened != SQLITE_OK) return damaged();
    constexpr int kMostBlob = 1 << 28;
    sqlite3_limit(handle, SQLITE_LIMIT_LENGTH, static_cast<int>(std::min<std::uint64_t>(kMostBlob, size_ + 4096)));
    sqlite3_db_config(handle, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_db_config(handle, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    sqlite3_exec(handle, "PRAGMA cell_size_check = ON; PRAGMA mmap_size = 0", nullptr, nullptr, nullptr);
    const Question question(handle, size_);
    SCARP_RETURN_IF_ERROR(read_metadata());
    SCARP_RETURN_IF_ERROR(read_tiles());
    return read_names();
  }

  Result<void> read_metadata() {
    const auto select = prepare(database_.get(), "SELECT name, value FROM metadata WHERE name IN ('format', 'grid')");
    if (!select) return damaged();
    std::string format, grid = "geographic";
    int step = SQLITE_DONE;
    while ((step = sqlite3_step(select.get())) == SQLITE_ROW)
      (column_text(select.get(), 0) == "grid" ? grid : format) = column_text(select.get(), 1);
    if (step != SQLITE_DONE) return damaged();
    constexpr std::string_view kOthers[] = {"quantized-mesh-1.0", "quantized-mesh", "terrain"};
    const bool is_glb = format == media_type(TileFormat::kGlb) || format == "glb";
    if (!is_glb && format.rfind(media_type(TileFormat::kQuantizedMesh), 0) != 0 &&
        std::find(std::begin(kOthers), std::end(kOthers), format) == std::end(kOthers))
      return refuse(fmt::format("is no set of terrain tiles: its format is \"{}\"", format.substr(0, 40)));
    const auto known = TileGrid::find(grid);
    if (!known) return refuse("is no set of terrain tiles of a grid that Scarp knows");
    grid_ = *known;
    format_ = is_glb ? TileFormat::kGlb : TileFormat::kQuantizedMesh;
    return {};
  }

  Result<void> read_tiles() {
    const auto select = prepare(database_.get(), "SELECT zoom_level, tile_column, tile_row FROM tiles");
    if (!select) return damaged();
    int step = SQLITE_DONE;
    while ((step = sqlite3_step(select.get())) == SQLITE_ROW) {
      std::int64_t numbers[3];
      for (int k = 0; k < 3; ++k) numbers[k] = sqlite3_column_int64(select.get(), k);
      const bool fits = numbers[0] >= 0 && numbers[0] <= kMaxTileLevel && std::min(numbers[1], numbers[2]) >= 0 &&
                        std::max(numbers[1], numbers[2]) <= UINT32_MAX;
      const TileId id{fits ? static_cast<int>(numbers[0]) : -1, static_cast<std::uint32_t>(numbers[1]),
                      static_cast<std::uint32_t>(numbers[2])};
      if (!grid_.has(id)) return refuse(fmt::format("is damaged: it has tiles that the {} grid has not", grid_.name()));
      if (levels_.count() > size_) return refuse("is damaged: it lists more tiles than it has bytes");
      levels_.add(id);
    }
    if (step != SQLITE_DONE) return damaged();
    if (!levels_.sort()) return refuse("is damaged: it has a tile twice");
    if (levels_.count() == 0) return refuse("is no set of tiles: it holds none");
    return {};
  }

  Result<void> read_names() {
    const auto exists = prepare(database_.get(), "SELECT 1 FROM sqlite_master WHERE name = 'files'");
    if (!exists) return damaged();
    const int found = sqlite3_step(exists.get());
    if (found != SQLITE_ROW) return found == SQLITE_DONE ? Result<void>() : damaged();
    const auto select = prepare(database_.get(), "SELECT name FROM files");
    if (!select) return {};  // another program's table
    int step = SQLITE_DONE;
    while ((step = sqlite3_step(select.get())) == SQLITE_ROW) {
      files_.push_back(column_text(select.get(), 0));
      if (!is_plain_name(files_.back())) return refuse("is damaged: a name in it leads elsewhere");
      if (files_.size() > size_) return refuse("is damaged: it lists more files than it has bytes");
    }
    if (step != SQLITE_DONE) return damaged();
    std::sort(files_.begin(), files_.end());
    return {};
  }

  std::string path_;
  std::uint64_t size_;
  SqliteDatabase database_;
  TileFormat format_ = TileFormat::kQuantizedMesh;
  TileGrid grid_;
  TileLevels levels_;
  std::vector<std::string> files_;
};

}  // namespace

Result<std::unique_ptr<TileSetReader>> open_mbtiles(const std::string& path) { return MbtilesReader::open(path); }

}  // namespace scarp::io
