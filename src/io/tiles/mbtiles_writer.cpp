// MBTiles 1.3 in SQLite. The specification assumes the Mercator grid. Level, column and row here are those of the
// geographic grid, as in other programs that store terrain in MBTiles. Files other than tiles are in a separate table.
#include <fmt/format.h>

#include <tuple>
#include <utility>

#include "io/tiles/set_archive.h"
#include "io/tiles/sqlite.h"
#include "scarp/version.h"

namespace scarp::io {
namespace {

/// The application id, "MPBX", is given by the specification.
constexpr const char* kSchema = R"(
PRAGMA application_id = 0x4d504258;
PRAGMA journal_mode = OFF;
PRAGMA synchronous = OFF;
PRAGMA locking_mode = EXCLUSIVE;
BEGIN;
CREATE TABLE metadata (name text, value text);
CREATE TABLE tiles (zoom_level integer, tile_column integer, tile_row integer, tile_data blob);
CREATE TABLE files (name text, data blob);
)";
constexpr const char* kIndices = R"(
CREATE UNIQUE INDEX tile_index ON tiles (zoom_level, tile_column, tile_row);
CREATE UNIQUE INDEX metadata_index ON metadata (name);
CREATE UNIQUE INDEX file_index ON files (name);
COMMIT;
)";

}  // namespace

Result<void> write_mbtiles(TileSpool& spool, TileFormat format, StagedFile& file) {
  spool.sort_tiles([](const TileSpool::Tile& a, const TileSpool::Tile& b) {
    return std::tie(a.id.z, a.id.x, a.id.y) < std::tie(b.id.z, b.id.x, b.id.y);
  });
  spool.sort_files();
  sqlite3* handle = nullptr;
  const int opened =
      sqlite3_open_v2(file.name().c_str(), &handle, SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX, nullptr);
  const SqliteDatabase database(handle);
  const auto refuse = [&] {
    return fail(ErrorKind::kOutput, fmt::format("cannot write {}: {}", file.path(), sqlite3_errmsg(handle)));
  };
  if (opened != SQLITE_OK || sqlite3_exec(handle, kSchema, nullptr, nullptr, nullptr) != SQLITE_OK) return refuse();

  const auto insert_metadata = prepare(handle, "INSERT INTO metadata VALUES (?, ?)");
  const auto insert_file = prepare(handle, "INSERT INTO files VALUES (?, ?)");
  const auto insert_tile = prepare(handle, "INSERT INTO tiles VALUES (?, ?, ?, ?)");
  if (!insert_metadata || !insert_file || !insert_tile) return refuse();
  const auto run = [](const SqliteStatement& statement) {
    const bool done = sqlite3_step(statement.get()) == SQLITE_DONE;
    return sqlite3_reset(statement.get()) == SQLITE_OK && done;
  };

  const SetFacts facts = facts_of(spool);
  const bool has_tiles = !spool.tiles().empty();
  const std::pair<std::string_view, std::string> metadata[] = {
      {"name", facts.name},
      {"format", std::string(media_type(format))},
      {"type", "baselayer"},
      {"description", facts.description},
      {"attribution", facts.attribution},
      {"bounds",
       fmt::format("{},{},{},{}", facts.bounds.west, facts.bounds.south, facts.bounds.east, facts.bounds.north)},
      {"minzoom", std::to_string(has_tiles ? spool.tiles().front().id.z : 0)},
      {"maxzoom", std::to_string(has_tiles ? spool.tiles().back().id.z : 0)},
      {"scheme", "tms"},
      {"grid", std::string(facts.grid.name())},
      {"generator", std::string("scarp ") + version()}};
  for (const auto& [name, value] : metadata) {
    bind_text(insert_metadata.get(), 1, name);
    bind_text(insert_metadata.get(), 2, value);
    if (!run(insert_metadata)) return refuse();
  }
  for (const TileSpool::File& one : spool.files()) {
    SCARP_TRY(const auto& bytes, spool.read(one));
    bind_text(insert_file.get(), 1, one.name);
    bind_blob(insert_file.get(), 2, bytes);
    if (!run(insert_file)) return refuse();
  }
  for (const TileSpool::Tile& tile : spool.tiles()) {
    SCARP_TRY(const auto& bytes, spool.read(tile));
    sqlite3_bind_int64(insert_tile.get(), 1, tile.id.z);
    sqlite3_bind_int64(insert_tile.get(), 2, tile.id.x);
    sqlite3_bind_int64(insert_tile.get(), 3, tile.id.y);
    bind_blob(insert_tile.get(), 4, bytes);
    if (!run(insert_tile)) return refuse();
  }
  if (sqlite3_exec(handle, kIndices, nullptr, nullptr, nullptr) != SQLITE_OK) return refuse();
  return {};
}

}  // namespace scarp::io
