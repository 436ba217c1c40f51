// Levels of detail and sheets next to each other in one GLB file.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "laws/fields.h"
#include "scarp/io.h"
#include "scarp/simplify.h"

namespace scarp::glb_levels_test {
namespace {

TEST(glb_levels, are_nodes_of_which_the_scene_shows_the_finest) {
  const testing::Field field = testing::random_field(3, 60, 50, testing::Relief::kRidges);
  SimplifyOptions options;
  options.goals.max_error = 1;
  options.output.uvs = true;
  const auto levels = simplify_levels(field.view(), options, {3, 3});
  ASSERT_TRUE(levels) << levels.error().message;
  std::vector<std::vector<std::uint8_t>> files;
  for (const Simplified& level : *levels) files.push_back(*encode_mesh(level.mesh, MeshFormat::kGlb));
  const auto joined = join_glb_levels(files, 3);
  ASSERT_TRUE(joined) << joined.error().message;
  const auto length = static_cast<std::ptrdiff_t>(std::size_t{(*joined)[12]} + ((*joined)[13] << 8));
  const auto json = nlohmann::json::parse(joined->begin() + 20, joined->begin() + 20 + length);
  EXPECT_EQ(json["nodes"].size(), 3u);
  EXPECT_EQ(json["nodes"][2]["name"], "terrain_LOD2");
  EXPECT_EQ(json["nodes"][0]["extensions"]["MSFT_lod"]["ids"], (nlohmann::json{1, 2}));
  EXPECT_EQ(json["scenes"][0]["nodes"], (nlohmann::json{0}));
  EXPECT_EQ(json["meshes"][2]["primitives"][0]["material"], 2);
  EXPECT_EQ(json["materials"][2]["pbrMetallicRoughness"]["baseColorTexture"]["index"], 2);
  for (std::size_t k = 0; k < 3; ++k) {
    // A file whose scene is another level is read as that level.
    auto text = json;
    text["scenes"][0]["nodes"] = {k};
    std::string changed = text.dump();
    changed.resize(static_cast<std::size_t>(length), ' ');
    std::vector<std::uint8_t> bytes = *joined;
    std::copy(changed.begin(), changed.end(), bytes.begin() + 20);
    const auto mesh = decode_mesh(bytes, "levels.glb");
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_EQ(mesh->positions, (*levels)[k].mesh.positions);
    EXPECT_EQ(mesh->triangles, (*levels)[k].mesh.triangles);
    EXPECT_EQ(mesh->uvs, (*levels)[k].mesh.uvs);
  }
}

TEST(glb_levels, sheets_are_beside_each_other_each_under_its_image) {
  Mesh plain;
  plain.positions = {0, 0, 1, 1, 0, 2, 0, 1, 3};
  plain.triangles = {0, 1, 2};
  Mesh under = plain;
  under.origin = {1, 0, 0};
  under.uvs = {0, 1, 1, 1, 0, 0};
  const std::vector<std::uint8_t> picture{1, 2, 3, 4};
  std::vector<std::vector<std::uint8_t>> files{*encode_glb(plain, {})};
  for (const char* type : {"image/jpeg", "image/webp"})
    files.push_back(*encode_glb(under, {.base_color = {picture, type}}));
  const auto joined = join_glbs(files);
  ASSERT_TRUE(joined) << joined.error().message;
  const auto length = static_cast<std::ptrdiff_t>(std::size_t{(*joined)[12]} + ((*joined)[13] << 8));
  const auto json = nlohmann::json::parse(joined->begin() + 20, joined->begin() + 20 + length);
  EXPECT_EQ(json["scenes"][0]["nodes"], (nlohmann::json{0, 1, 2}));
  EXPECT_EQ(json["extensionsRequired"], (nlohmann::json{"EXT_texture_webp"}));
  EXPECT_FALSE(json["materials"][0]["pbrMetallicRoughness"].contains("baseColorTexture"));
  EXPECT_EQ(json["materials"][2]["pbrMetallicRoughness"]["baseColorTexture"]["index"], 1);
  EXPECT_EQ(json["textures"][1]["extensions"]["EXT_texture_webp"]["source"], 1);
  const auto& view = json["bufferViews"][json["images"][1]["bufferView"].get<std::size_t>()];
  const auto at = joined->begin() + 28 + length + view["byteOffset"].get<std::ptrdiff_t>();
  EXPECT_EQ(std::vector<std::uint8_t>(at, at + 4), picture);
  const auto mesh = decode_mesh(*joined, "sheets.glb");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->triangle_count(), 3u);
  EXPECT_EQ(mesh->vertex(8), (std::array<double, 3>{1, 1, 3}));
}

}  // namespace
}  // namespace scarp::glb_levels_test
