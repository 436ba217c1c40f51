// 3MF files and their archives.
#include <gtest/gtest.h>

#include <string>

#include "io/mesh/file_bytes.h"
#include "io/zip.h"
#include "mesh_samples.h"
#include "scarp/io.h"
#include "scarp/mesh.h"

namespace scarp::threemf_test {
namespace {

Mesh sample_solid() {
  Mesh mesh = test::sample_mesh();
  mesh.normals.clear();
  return *build_solid(mesh, -3.25);
}

std::vector<std::uint8_t> bytes_of(std::string_view text) { return {text.begin(), text.end()}; }

/// A 3MF file around a model.
std::vector<std::uint8_t> package(std::string_view model, std::string_view name = "3D/3dmodel.model") {
  const io::ZipEntry entry{std::string(name), bytes_of(model)};
  return *io::encode_zip({&entry, 1});
}

std::string complaint(std::span<const std::uint8_t> bytes) {
  const auto mesh = decode_mesh(bytes, "x.3mf");
  return mesh ? "" : mesh.error().message;
}

TEST(Zip, GivesBackWhatWasPutIn) {
  std::vector<std::uint8_t> long_one(3000000);
  for (std::size_t k = 0; k < long_one.size(); ++k) long_one[k] = static_cast<std::uint8_t>(k * k / 7);
  const io::ZipEntry entries[] = {{"a", {}}, {"b/C.txt", bytes_of("hello hello hello hello")}, {"long", long_one}};
  const auto archive = io::encode_zip(entries);
  ASSERT_TRUE(archive);
  EXPECT_EQ(*io::encode_zip(entries), *archive);
  const auto zip = io::ZipReader::open(*archive);
  ASSERT_TRUE(zip);
  EXPECT_EQ(zip->find("B/c.TXT"), "b/C.txt");
  EXPECT_EQ(zip->find("d"), "");
  for (const io::ZipEntry& entry : entries) EXPECT_EQ(zip->extract(entry.name).value(), entry.bytes);
  EXPECT_FALSE(zip->extract("d"));
}

TEST(Zip, NoticesDamage) {
  const io::ZipEntry entry{"a", bytes_of("some words, some words, some words")};
  const auto archive = *io::encode_zip({&entry, 1});
  for (std::size_t size = 0; size < archive.size(); ++size)
    EXPECT_FALSE(io::ZipReader::open(std::span(archive).first(size))) << size;
  int noticed = 0;
  for (std::size_t k = 0; k < archive.size(); ++k) {
    auto damaged = archive;
    damaged[k] ^= 0x55;
    const auto zip = io::ZipReader::open(damaged);
    const auto bytes = zip ? zip->extract("a") : tl::unexpected(zip.error());
    if (bytes) {
      EXPECT_EQ(*bytes, entry.bytes) << k;
    } else {
      ++noticed;
    }
  }
  EXPECT_GT(noticed, 40);
  // A size that is impossible for deflate is rejected.
  auto bomb = archive;
  const std::size_t directory = io::load_number<std::uint32_t>(&bomb[bomb.size() - 6]);
  for (std::size_t k = 24; k < 28; ++k) bomb[directory + k] = 0xfe;
  EXPECT_FALSE(io::ZipReader::open(bomb)->extract("a"));
}

TEST(ThreeMf, ReadsBackTheSame) {
  const Mesh solid = sample_solid();
  const auto bytes = encode_mesh(solid, MeshFormat::k3mf);
  ASSERT_TRUE(bytes) << bytes.error().message;
  EXPECT_EQ(*encode_mesh(solid, MeshFormat::k3mf), *bytes);
  const auto back = decode_mesh(*bytes, "x.3mf");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->triangles, solid.triangles);
  EXPECT_EQ(back->positions, solid.positions);
  EXPECT_EQ(back->origin, solid.origin);
  EXPECT_EQ(back->metadata, solid.metadata);
  EXPECT_EQ(*encode_mesh(*back, MeshFormat::k3mf), *bytes);
}

TEST(ThreeMf, SeveralObjectsAreBuilt) {
  std::vector<Mesh> solids{sample_solid(), sample_solid()};
  solids[1].origin[0] += 1000;
  const auto back = decode_mesh(*encode_3mf(solids), "x.3mf");
  ASSERT_TRUE(back);
  EXPECT_EQ(back->triangle_count(), 2 * solids[0].triangle_count());
  const SolidFacts facts = measure_solid(*back);
  EXPECT_EQ(facts.parts, 2u);
  EXPECT_TRUE(facts.is_solid());
  EXPECT_DOUBLE_EQ(facts.high[0], measure_solid(solids[0]).high[0] + 1000);
  EXPECT_FALSE(encode_3mf({}));
}

TEST(ThreeMf, HoldsSolidsOnly) {
  const auto open = encode_mesh(test::sample_mesh(), MeshFormat::k3mf);
  ASSERT_FALSE(open);
  EXPECT_EQ(open.error().kind, ErrorKind::kOutput);
  EXPECT_NE(open.error().message.find("closed solids"), std::string::npos);
}

constexpr const char* kTetrahedron =
    "<vertices><vertex x='0' y='0' z='0'/><vertex x='1' y='0' z='0'/><vertex x='0' y='1' z='0'/>"
    "<vertex x='0' y='0' z='1e0'/></vertices><triangles><triangle v1='0' v2='2' v3='1'/>"
    "<triangle v1='0' v2='1' v3='3'/><triangle v1='1' v2='2' v3='3'/><triangle v1='2' v2='0' v3='3'/></triangles>";

std::string model(const std::string& object, const std::string& build) {
  return "<?xml version='1.0'?><model unit='inch'><resources><object id='7'>" + object +
         "</object></resources><build>" + build + "</build></model>";
}

TEST(ThreeMf, MovesObjectsToTheirPlaces) {
  const auto mesh = decode_mesh(package(model(std::string("<mesh>") + kTetrahedron + "</mesh>",
                                              "<item objectid='7' transform='2 0 0 0 3 0 0 0 4 10 20 30'/>")),
                                "x.3mf");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->vertex(1), (std::array<double, 3>{12, 20, 30}));
  EXPECT_EQ(mesh->vertex(2), (std::array<double, 3>{10, 23, 30}));
  EXPECT_EQ(mesh->vertex(3), (std::array<double, 3>{10, 20, 34}));
}

TEST(ThreeMf, RefusesWithASentence) {
  const std::string mesh = std::string("<mesh>") + kTetrahedron + "</mesh>", item = "<item objectid='7'/>";
  const std::pair<std::string, const char*> cases[] = {
      {model(mesh, ""), "builds no object"},
      {model(mesh, "<item objectid='8'/>"), "not there"},
      {model(mesh, item + item), "built twice"},
      {model("<components><component objectid='7'/></components>", item), "made of others"},
      {model("<mesh><vertices><vertex x='1' y='2'/></vertices></mesh>", item), "three finite numbers"},
      {model("<mesh><triangles><triangle v1='0' v2='1' v3='2'/></triangles></mesh>", item), "does not have"},
      {model(mesh, "<item objectid='7' transform='1 0 0'/>"), "twelve finite numbers"},
      {"<model><resources>", "line 1"}};
  for (const auto& [text, words] : cases) EXPECT_NE(complaint(package(text)).find(words), std::string::npos) << text;
  EXPECT_NE(complaint(package("<model/>", "word/document.xml")).find("without a 3MF model"), std::string::npos);
  EXPECT_NE(complaint(bytes_of("PK\3\4 and no more")).find("cut off"), std::string::npos);
}

TEST(StlPlacement, IsInTheHeaderHoweverLong) {
  for (const Placement& placement : {Placement{{1, 2, 3}, {0.5, 0.5, 1}},
                                     Placement{{1.0 / 3, 2e300 / 3, -1e-9 / 7}, {1.0 / 7, 1.0 / 9, 1.0 / 11}}}) {
    Mesh mesh = sample_solid();
    mesh.origin = placement.origin;
    place_mesh(mesh, placement);
    const auto back = decode_mesh(*encode_mesh(mesh, MeshFormat::kStl), "x.stl");
    ASSERT_TRUE(back);
    EXPECT_EQ(back->metadata.at("placement"), mesh.metadata.at("placement"));
    EXPECT_EQ(back->origin, (std::array<double, 3>{0, 0, 0}));
  }
}

}  // namespace
}  // namespace scarp::threemf_test
