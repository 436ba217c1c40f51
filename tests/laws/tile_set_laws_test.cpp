// Laws of containers: a set read back equals the written one, for every container and order; nothing else is replaced;
// damaged files are refused or read safely.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <sqlite3.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "base/parallel.h"
#include "io/gzip.h"
#include "io/tiles/md5.h"
#include "io/tiles/pmtiles_parts.h"
#include "io/zip.h"
#include "laws/sanitized.h"
#include "scarp/tile_set.h"

namespace scarp::tile_set_laws_test {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

const std::string kEndings[] = {"", ".pmtiles", ".mbtiles", ".3tz"};

bool is_before(const TileId& a, const TileId& b) { return std::tie(a.z, a.y, a.x) < std::tie(b.z, b.y, b.x); }

/// A folder for each test, removed with it.
class Scratch {
 public:
  Scratch() {
    std::string name = (fs::temp_directory_path() / "scarp-sets-XXXXXX").string();
    EXPECT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
  }
  ~Scratch() { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::size_t count() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

 private:
  fs::path folder_;
};

Bytes read_whole(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}
void write_whole(const std::string& path, const Bytes& bytes) {
  fs::create_directories(fs::path(path).parent_path());
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}
Bytes bytes_of(const std::string& text) { return {text.begin(), text.end()}; }

struct AnySet {
  TileFormat format = TileFormat::kQuantizedMesh;
  std::vector<std::pair<TileId, Bytes>> tiles;
  std::map<std::string, Bytes> files;
};

Bytes any_bytes(std::mt19937& random, std::size_t most) {
  Bytes bytes(1 + random() % most);
  for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
  return bytes;
}

AnySet any_set(std::mt19937& random, std::size_t count) {
  AnySet set;
  set.format = random() % 2 == 0 ? TileFormat::kQuantizedMesh : TileFormat::kGlb;
  std::set<TileId, decltype(&is_before)> ids(&is_before);
  while (ids.size() < count) {
    const int z = static_cast<int>(random() % (kMaxTileLevel + 1));
    ids.insert(
        {z, static_cast<std::uint32_t>(random() % (2ull << z)), static_cast<std::uint32_t>(random() % (1ull << z))});
    if (ids.size() + 8 > count) ids.insert({0, static_cast<std::uint32_t>(random() % 2), 0});
  }
  const bool packs = random() % 2 == 0;
  for (const TileId id : ids) {
    const Bytes bytes = any_bytes(random, 300);
    set.tiles.push_back({id, packs ? *io::compress_gzip(bytes) : bytes});
  }
  std::shuffle(set.tiles.begin(), set.tiles.end(), random);
  set.files["layer.json"] = bytes_of(R"({"name":"Ж","bounds":[1,2,3,4.5],"scarp":{"generator":"scarp"}})");
  if (random() % 2 == 0) set.files["subtrees/0/0/0.subtree"] = any_bytes(random, 500);
  if (random() % 2 == 0) set.files["notes.txt"] = bytes_of("not JSON\xff");
  if (random() % 4 == 0) set.files["empty"] = {};
  return set;
}

Result<void> write_set(const AnySet& set, const std::string& path, bool overwrite = false) {
  auto writer = create_tile_set(path, set.format, overwrite);
  if (!writer) return tl::unexpected(writer.error());
  for (const auto& [id, bytes] : set.tiles) {
    if (auto put = (*writer)->put_tile(id, bytes); !put) return put;
  }
  for (const auto& [name, bytes] : set.files) {
    if (auto put = (*writer)->put_file(name, bytes); !put) return put;
  }
  return (*writer)->finish();
}

void expect_same(const AnySet& set, const std::string& path) {
  const auto reader = open_tile_set(path);
  ASSERT_TRUE(reader) << reader.error().message;
  EXPECT_EQ((*reader)->format(), set.format);
  std::vector<std::vector<std::uint64_t>> levels;
  for (const auto& [id, bytes] : set.tiles) {
    const auto z = static_cast<std::size_t>(id.z);
    if (levels.size() <= z) levels.resize(z + 1);
    levels[z].push_back(std::uint64_t{id.y} << 32 | id.x);
    const auto kept = (*reader)->read_tile(id);
    ASSERT_TRUE(kept) << kept.error().message;
    EXPECT_EQ(*kept, bytes);
  }
  for (auto& level : levels) std::sort(level.begin(), level.end());
  EXPECT_EQ((*reader)->tiles(), levels);
  std::vector<std::string> names;
  for (const auto& [name, bytes] : set.files) {
    names.push_back(name);
    const auto kept = (*reader)->read_file(name);
    ASSERT_TRUE(kept) << kept.error().message;
    EXPECT_EQ(*kept, bytes) << name;
  }
  EXPECT_EQ((*reader)->files(), names);
  EXPECT_FALSE((*reader)->read_file("nothing"));
  EXPECT_FALSE((*reader)->read_file("../nothing"));
  EXPECT_FALSE((*reader)->read_tile({kMaxTileLevel + 1, 0, 0}));
  EXPECT_FALSE((*reader)->read_tile({0, 2, 0}));
}

RC_GTEST_PROP(tile_sets, what_goes_in_comes_out_in_any_order, ()) {
  std::mt19937 random(*rc::gen::arbitrary<std::uint32_t>());
  AnySet set = any_set(random, 1 + random() % 60);
  const Scratch scratch;
  for (const std::string& ending : kEndings) {
    const auto written = write_set(set, scratch.path("a" + ending));
    RC_ASSERT(written);
    expect_same(set, scratch.path("a" + ending));
    std::shuffle(set.tiles.begin(), set.tiles.end(), random);
    RC_ASSERT(write_set(set, scratch.path("b" + ending)));
    if (!ending.empty()) RC_ASSERT(read_whole(scratch.path("a" + ending)) == read_whole(scratch.path("b" + ending)));
  }
  RC_ASSERT(scratch.count() == 8u);  // no temporary files
}

TEST(tile_sets, thousands_of_tiles_have_leaves_in_pmtiles) {
  std::mt19937 random(3);
  AnySet set;
  for (std::uint32_t k = 0; k < 40000; ++k) {
    if (random() % 5 != 0) set.tiles.push_back({{9, k % 1024, k / 1024}, any_bytes(random, 9)});
  }
  const Scratch scratch;
  for (const char* const ending : {".pmtiles", ".mbtiles", ".3tz"}) {
    ASSERT_TRUE(write_set(set, scratch.path(std::string("a") + ending)));
    expect_same(set, scratch.path(std::string("a") + ending));
  }
  const Bytes bytes = read_whole(scratch.path("a.pmtiles"));
  const auto header = io::decode_pmtiles_header(bytes);
  ASSERT_TRUE(header);
  EXPECT_GT(header->leaves.length, 0u);
  EXPECT_LE(header->root.offset + header->root.length, 16384u);
}

TEST(tile_sets, threads_read_at_once) {
  std::mt19937 random(6);
  const AnySet set = any_set(random, 300);
  const Scratch scratch;
  for (const std::string& ending : kEndings) {
    ASSERT_TRUE(write_set(set, scratch.path("a" + ending)));
    const auto reader = open_tile_set(scratch.path("a" + ending));
    ASSERT_TRUE(reader);
    std::vector<char> same(set.tiles.size());
    parallel_for(set.tiles.size(), 4, [&](std::size_t k) {
      const auto bytes = (*reader)->read_tile(set.tiles[k].first);
      same[k] = bytes && *bytes == set.tiles[k].second && (*reader)->read_file("layer.json") ? 1 : 0;
    });
    EXPECT_EQ(std::count(same.begin(), same.end(), 1), static_cast<std::ptrdiff_t>(same.size())) << ending;
  }
}

TEST(tile_sets, what_is_there_stays) {
  std::mt19937 random(4);
  AnySet set = any_set(random, 5);
  set.files.erase("notes.txt");  // folders with such a file are not only Scarp's
  set.files.erase("empty");
  const Scratch scratch;
  for (const std::string& ending : kEndings) {
    const std::string path = scratch.path("a" + ending);
    ASSERT_TRUE(write_set(set, path));
    const auto refused = write_set(set, path);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().kind, ErrorKind::kOutput);
    EXPECT_TRUE(write_set(set, path, true));
    // A set without Scarp's mark is not replaced.
    AnySet other = set;
    other.files["layer.json"] = bytes_of("{}");
    const std::string foreign = scratch.path("foreign" + ending);
    ASSERT_TRUE(write_set(other, foreign));
    EXPECT_FALSE(write_set(set, foreign, true));
    expect_same(other, foreign);
    if (ending.empty()) continue;
    const std::string rubbish = scratch.path("rubbish" + ending);
    write_whole(rubbish, bytes_of("letters"));
    EXPECT_FALSE(write_set(set, rubbish, true));
    EXPECT_EQ(read_whole(rubbish), bytes_of("letters"));
    fs::create_directory(scratch.path("folder" + ending));
    EXPECT_FALSE(write_set(set, scratch.path("folder" + ending), true));
  }
  // A set that another program created meanwhile.
  for (const std::string& ending : kEndings) {
    const std::string path = scratch.path("late" + ending);
    auto writer = create_tile_set(path, set.format, true);
    ASSERT_TRUE(writer);
    EXPECT_TRUE((*writer)->put_tile({0, 0, 0}, bytes_of("tile")));
    write_whole(ending.empty() ? path + "/mine" : path, bytes_of("mine"));
    EXPECT_FALSE((*writer)->finish());
    EXPECT_EQ(read_whole(ending.empty() ? path + "/mine" : path), bytes_of("mine"));
  }
}

TEST(tile_sets, unfinished_ones_leave_nothing) {
  const Scratch scratch;
  for (const std::string& ending : kEndings) {
    const auto writer = create_tile_set(scratch.path("a" + ending), TileFormat::kGlb, false);
    ASSERT_TRUE(writer);
    EXPECT_TRUE((*writer)->put_tile({3, 9, 4}, bytes_of("tile")));
  }
  EXPECT_EQ(scratch.count(), 0u);
}

TEST(tile_sets, folders_of_other_programs_open) {
  const Scratch scratch;
  const std::string folder = scratch.path("ctb");
  write_whole(folder + "/0/0/0.terrain", bytes_of("not packed"));
  write_whole(folder + "/5/33/24.terrain", *io::compress_gzip(bytes_of("packed")));
  write_whole(folder + "/5/033/24.terrain", bytes_of("a second name of a tile"));
  write_whole(folder + "/5/99/24.terrain", bytes_of("no tile of the grid"));
  write_whole(folder + "/layer.json", bytes_of("{\"tilejson\":\"2.1.0\"}"));
  write_whole(folder + "/.hidden", bytes_of("a secret"));
  write_whole(scratch.path("outside"), bytes_of("a secret"));
  fs::create_symlink(scratch.path("outside"), folder + "/link");
  const auto reader = open_tile_set(folder);
  ASSERT_TRUE(reader);
  EXPECT_EQ((*reader)->tiles(), (std::vector<std::vector<std::uint64_t>>{{0}, {}, {}, {}, {}, {24ull << 32 | 33}}));
  EXPECT_EQ((*reader)->files(), (std::vector<std::string>{"5/033/24.terrain", "5/99/24.terrain", "layer.json"}));
  EXPECT_EQ(*(*reader)->read_tile({0, 0, 0}), bytes_of("not packed"));
  for (const char* const name : {"link", ".hidden", "../outside", "5/33/24.terrain", ""})
    EXPECT_FALSE((*reader)->read_file(name)) << name;

  const std::string bare = scratch.path("bare");
  fs::create_directory(bare);
  for (const std::string& path :
       {bare, scratch.path("missing"), scratch.path("missing.pmtiles"), folder + "/layer.json"}) {
    const auto refused = open_tile_set(path);
    ASSERT_FALSE(refused) << path;
    EXPECT_EQ(refused.error().kind, ErrorKind::kInput);
    EXPECT_NE(refused.error().message.find(path), std::string::npos);
  }
}

/// Calls everything that a reader offers.
void read_all(const std::string& path) {
  const auto reader = open_tile_set(path);
  if (!reader) {
    ASSERT_EQ(reader.error().kind, ErrorKind::kInput);
    ASSERT_NE(reader.error().message.find(path), std::string::npos) << reader.error().message;
    return;
  }
  for (std::size_t z = 0; z < (*reader)->tiles().size(); ++z) {
    for (const std::uint64_t at : (*reader)->tiles()[z]) {
      const TileId id{static_cast<int>(z), static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(at >> 32)};
      const auto tile = (*reader)->read_tile(id);
      ASSERT_TRUE(tile || tile.error().kind == ErrorKind::kInput);
    }
  }
  for (const std::string& name : (*reader)->files()) (void)(*reader)->read_file(name);
}

TEST(tile_sets, damaged_ones_are_refused_or_read_without_harm) {
  std::mt19937 random(5);
  AnySet set = any_set(random, 12);
  set.files["subtrees/0/0/0.subtree"] = any_bytes(random, 500);
  const Scratch scratch;
  const int trials = testing::kIsSanitized ? 150 : 600;
  for (const char* const ending : {".pmtiles", ".mbtiles", ".3tz"}) {
    const std::string path = scratch.path(std::string("a") + ending), damaged = scratch.path(std::string("b") + ending);
    ASSERT_TRUE(write_set(set, path));
    const Bytes whole = read_whole(path);
    for (int trial = 0; trial < trials; ++trial) {
      Bytes bytes = whole;
      if (trial % 3 == 0) bytes.resize(random() % bytes.size());
      // Changes headers and directories, at either end, more often.
      for (int k = 0; k < 1 + trial % 4 && !bytes.empty(); ++k) {
        const std::size_t range = k % 2 == 0 ? bytes.size() : std::min<std::size_t>(bytes.size(), 512);
        const std::size_t at = trial % 2 == 0 ? random() % range : bytes.size() - 1 - random() % range;
        bytes[at] = static_cast<std::uint8_t>(random() % 2 == 0 ? random() : random() % 2 * 255);
      }
      write_whole(damaged, bytes);
      read_all(damaged);
      if (HasFatalFailure()) FAIL() << ending << ", trial " << trial;
    }
  }
}

TEST(mbtiles, questions_without_an_end_are_given_up) {
  const Scratch scratch;
  const std::string path = scratch.path("endless.mbtiles"),
                    endless = "(WITH RECURSIVE n(k) AS (SELECT 1 UNION ALL SELECT k + 1 FROM n) SELECT max(k) FROM n)";
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
  const std::string schema =
      "CREATE TABLE metadata (name text, value text); INSERT INTO metadata VALUES ('format', 'terrain');"
      "CREATE TABLE map (zoom_level, tile_column, tile_row); INSERT INTO map VALUES (0, 0, 0);"
      "CREATE VIEW tiles AS SELECT *, " +
      endless +
      " AS tile_data FROM map;"
      "CREATE TABLE files (name text, data blob)";
  EXPECT_EQ(sqlite3_exec(database, schema.c_str(), nullptr, nullptr, nullptr), SQLITE_OK);
  {
    const auto reader = open_tile_set(path);
    ASSERT_TRUE(reader) << reader.error().message;
    EXPECT_FALSE((*reader)->read_tile({0, 0, 0}));
  }
  const std::string list = "DROP TABLE files; CREATE VIEW files AS SELECT " + endless + " AS name";
  EXPECT_EQ(sqlite3_exec(database, list.c_str(), nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_close(database);
  EXPECT_FALSE(open_tile_set(path));
}

TEST(pmtiles, numbers_are_those_of_the_specification) {
  const TileGrid geographic, mercator{GridKind::kMercator};
  EXPECT_EQ(io::pmtiles_number({0, 0, 0}, geographic), 1u);                   // 1/0/0
  EXPECT_EQ(io::pmtiles_number({0, 1, 0}, geographic), 4u);                   // 1/1/0
  EXPECT_EQ(io::pmtiles_number({1, 0, 1}, geographic), 5u);                   // 2/0/0
  EXPECT_EQ(io::pmtiles_number({17, 39, 131068}, geographic), 22906496015u);  // 18/39/3
  EXPECT_EQ(io::pmtiles_number({18, 39, (1u << 18) - 4}, mercator), 22906496015u);
  for (const TileGrid& grid : {geographic, mercator}) {
    std::set<std::uint64_t> numbers;
    for (int z = 0; z < 7; ++z) {
      for (std::uint32_t y = 0; y < grid.rows(z); ++y) {
        for (std::uint32_t x = 0; x < grid.columns(z); ++x) {
          const std::uint64_t number = io::pmtiles_number({z, x, y}, grid);
          EXPECT_TRUE(numbers.insert(number).second);
          EXPECT_EQ(io::find_pmtiles_id(number, grid), (TileId{z, x, y}));
        }
      }
    }
    EXPECT_FALSE(io::find_pmtiles_id(UINT64_MAX, grid));
    const TileId last{kMaxTileLevel, grid.columns(kMaxTileLevel) - 1, 0};
    EXPECT_EQ(io::find_pmtiles_id(io::pmtiles_number(last, grid), grid), last);
  }
  EXPECT_FALSE(io::find_pmtiles_id(0, geographic));
  EXPECT_FALSE(io::find_pmtiles_id(2, geographic));  // 1/0/1, in the southern half of a square world
  EXPECT_EQ(io::find_pmtiles_id(0, mercator), (TileId{0, 0, 0}));
}

TEST(md5, is_that_of_rfc_1321) {
  const auto hex = [](std::string_view text) {
    std::string digits;
    for (const std::uint8_t byte : io::md5_of(text)) {
      digits += "0123456789abcdef"[byte >> 4];
      digits += "0123456789abcdef"[byte & 15];
    }
    return digits;
  };
  EXPECT_EQ(hex(""), "d41d8cd98f00b204e9800998ecf8427e");
  EXPECT_EQ(hex("message digest"), "f96b697d7cb7938d525a2f31aaf161d0");
  EXPECT_EQ(hex("12345678901234567890123456789012345678901234567890123456789012345678901234567890"),
            "57edf4a22be3c955ac49da2e2107b67a");
}

TEST(zip, numbers_beyond_32_bits_are_read_back) {
  io::ZipRecord record;
  record.name = "far/away.glb";
  record.size = record.packed = 77;
  record.offset = 5ull << 32;
  record.checksum = 0x12345678;
  Bytes directory;
  io::append_zip_record(directory, record);
  const std::uint64_t start = 6ull << 32, size = directory.size(), count = 1;
  io::append_zip_end(directory, count, start, size);
  const auto found = io::find_zip_directory(directory, start + directory.size());
  ASSERT_TRUE(found);
  EXPECT_EQ(found->start, start);
  EXPECT_EQ(found->count, count);
  const auto records = io::read_zip_directory(directory, found->count);
  ASSERT_TRUE(records);
  ASSERT_EQ(records->size(), 1u);
  EXPECT_EQ((*records)[0].name, record.name);
  EXPECT_EQ((*records)[0].offset, record.offset);
  EXPECT_EQ((*records)[0].size, record.size);
}

}  // namespace
}  // namespace scarp::tile_set_laws_test
