#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "glb_files.h"
#include "mesh_samples.h"
#include "scarp/io.h"

namespace scarp {
namespace {

using nlohmann::json;
using test::sample_mesh;

using test::load_u32;
using test::with_json;

json json_of(const std::vector<std::uint8_t>& bytes) { return test::glb_json(bytes); }

TEST(Glb, RoundTripKeepsEveryBit) {
  for (const bool normals : {false, true}) {
    const Mesh mesh = sample_mesh(normals);
    const auto bytes = encode_mesh(mesh, MeshFormat::kGlb);
    ASSERT_TRUE(bytes) << bytes.error().message;
    const auto back = decode_mesh(*bytes, "x.glb");
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_TRUE(test::same_geometry(mesh, *back));
    EXPECT_EQ(back->metadata, mesh.metadata);
    EXPECT_EQ(*encode_mesh(*back, MeshFormat::kGlb), *bytes);
  }
}

TEST(Glb, IsYUpWithExactBoundsAndEmbeddedReport) {
  const auto bytes = encode_mesh(sample_mesh(), MeshFormat::kGlb);
  const json j = json_of(*bytes);
  EXPECT_EQ(j["asset"]["generator"], "Scarp 0.2.0");
  EXPECT_EQ(j["asset"]["extras"]["report"]["max_error"], 4.9375);
  EXPECT_EQ(j["asset"]["extras"]["number"], "1.50");
  EXPECT_EQ(j["nodes"][0]["name"], "terrain");
  EXPECT_EQ(j["nodes"][0]["translation"], json({512345.625, 0.0, -4023456.0625}));
  // Our y is −3·29.875 to 0, so glTF's z is 0 to 89.625.
  EXPECT_EQ(j["accessors"][0]["min"][0], 0.0);
  EXPECT_EQ(j["accessors"][0]["min"][2], 0.0);
  EXPECT_EQ(j["accessors"][0]["max"][0], 121.0);
  EXPECT_EQ(j["accessors"][0]["max"][2], 89.625);
  EXPECT_EQ(j["accessors"][1]["componentType"], 5123);
}

using Place = std::array<double, 3>;
using Corners = std::array<Place, 3>;

/// Triangles as places, each from its least corner, in any order.
std::vector<Corners> places_of(const Mesh& mesh) {
  std::vector<Corners> all;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    Corners corners;
    for (std::size_t k = 0; k < 3; ++k) corners[k] = mesh.vertex(mesh.triangles[3 * t + k]);
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    all.push_back(corners);
  }
  std::sort(all.begin(), all.end());
  return all;
}

TEST(Glb, HasIndicesOf16BitsOnlyBySplittingLargeMeshes) {
  for (const auto [cols, rows, parts] : {std::array{32766, 1, 1}, std::array{32767, 1, 2}, std::array{300, 400, 2}}) {
    Mesh mesh = test::grid_mesh(cols, rows, [](int, int) { return true; });
    test::add_attributes(mesh, 1);
    const auto bytes = encode_mesh(mesh, MeshFormat::kGlb);
    ASSERT_TRUE(bytes);
    const json j = json_of(*bytes);
    const json& primitives = j["meshes"][0]["primitives"];
    EXPECT_EQ(primitives.size(), static_cast<std::size_t>(parts));
    for (const json& primitive : primitives) {
      EXPECT_EQ(j["accessors"][primitive["indices"].get<int>()]["componentType"], 5123);
      EXPECT_LE(j["accessors"][primitive["attributes"]["POSITION"].get<int>()]["count"], 65535);
    }
    const auto back = decode_mesh(*bytes, "x.glb");
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(places_of(*back), places_of(mesh));
    // Only vertices between parts are in both.
    EXPECT_LT(back->vertex_count(), mesh.vertex_count() + 450);
  }
}

TEST(Glb, HonoursTheNodeTree) {
  const Mesh mesh = sample_mesh();
  const auto bytes = *encode_mesh(mesh, MeshFormat::kGlb);
  json j = json_of(bytes);
  // The node is below a parent that rotates by 90° about glTF's y (our z), doubles, and shifts by (1, 2, 3).
  const double half = std::sqrt(0.5);
  j["nodes"] = json::array(
      {{{"children", {1}}, {"rotation", {0, half, 0, half}}, {"scale", {2, 2, 2}}, {"translation", {1, 2, 3}}},
       {{"mesh", 0}, {"translation", {10, 20, 30}}}});
  const auto back = decode_mesh(with_json(bytes, j), "x.glb");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->triangles, mesh.triangles);
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const double x = mesh.positions[3 * v] + 10, up = mesh.positions[3 * v + 2] + 20,
                 south = 30 - mesh.positions[3 * v + 1];
    const auto p = back->vertex(v);
    EXPECT_NEAR(p[0], 2 * south + 1, 1e-9);  // rotation about y: (x, z) → (z, −x)
    EXPECT_NEAR(p[1], -(-2 * x + 3), 1e-9);
    EXPECT_NEAR(p[2], 2 * up + 2, 1e-9);
  }
}

TEST(Glb, ReadsTwoNodesAndMirrors) {
  const Mesh mesh = sample_mesh();
  const auto bytes = *encode_mesh(mesh, MeshFormat::kGlb);
  json j = json_of(bytes);
  j["scenes"][0]["nodes"] = {0, 1};
  j["nodes"].push_back({{"mesh", 0}, {"matrix", {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1}}});
  const auto back = decode_mesh(with_json(bytes, j), "x.glb");
  ASSERT_TRUE(back) << back.error().message;
  const std::size_t count = mesh.vertex_count();
  ASSERT_EQ(back->vertex_count(), 2 * count);
  ASSERT_EQ(back->triangle_count(), 2 * mesh.triangle_count());
  EXPECT_EQ(back->vertex(count + 1)[0], 5 - mesh.positions[3]);
  // A mirror flips triangles; the reader flips them back.
  const std::size_t t = mesh.triangles.size();
  EXPECT_EQ(back->triangles[t], mesh.triangles[0] + count);
  EXPECT_EQ(back->triangles[t + 1], mesh.triangles[2] + count);
  EXPECT_EQ(back->triangles[t + 2], mesh.triangles[1] + count);
}

TEST(Glb, RefusesWhatItCannotHonourByName) {
  const auto bytes = *encode_mesh(sample_mesh(), MeshFormat::kGlb);
  const json good = json_of(bytes);
  const auto message = [&](const json& changed) {
    const auto result = decode_mesh(with_json(bytes, changed), "x.glb");
    return result ? std::string("accepted") : result.error().message;
  };
  const auto expect_says = [&](const json& changed, const char* words) {
    EXPECT_NE(message(changed).find(words), std::string::npos) << message(changed) << " lacks: " << words;
  };
  EXPECT_EQ(message(good), "accepted");
  json j = good;
  j["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  expect_says(j, "KHR_draco_mesh_compression");
  j = good;
  j["meshes"][0]["primitives"][0]["mode"] = 1;
  expect_says(j, "mode 1");
  j = good;
  j["accessors"][0]["sparse"] = json::object();
  expect_says(j, "sparse");
  j = good;
  j["accessors"][0]["count"] = 1000000000000;
  expect_says(j, "accessor 0 reaches beyond");
  j = good;
  j["accessors"][0]["count"] = -1;
  expect_says(j, "'count'");
  j = good;
  j["accessors"][0]["byteOffset"] = std::numeric_limits<std::uint64_t>::max() - 3;
  expect_says(j, "accessor 0 reaches beyond");
  j = good;
  j["bufferViews"][1]["byteOffset"] = std::numeric_limits<std::uint64_t>::max() - 3;
  expect_says(j, "buffer view 1 reaches beyond");
  j = good;
  j["accessors"][0]["count"] = 3;
  expect_says(j, "names vertex");
  j = good;
  j["nodes"][0]["children"] = {0};
  expect_says(j, "more than one parent");
  j = good;
  j["nodes"][0]["mesh"] = 7;
  expect_says(j, "meshes 7");
  j = good;
  j["buffers"][0]["uri"] = "hills.bin";
  expect_says(j, "outside of the file");
  j = good;
  j["meshes"][0]["primitives"] = json::array();
  expect_says(j, "no triangles");
}

TEST(Glb, SurvivesDeepAndWideJson) {
  const auto bytes = *encode_mesh(sample_mesh(), MeshFormat::kGlb);
  json j = json_of(bytes);
  json wide = json::object();
  for (int i = 0; i < 20000; ++i) wide[std::to_string(i)] = i;
  j["extras"] = wide;
  EXPECT_FALSE(decode_mesh(with_json(bytes, j), "x.glb"));
  // A deeply nested value in metadata stays a string.
  Mesh mesh = sample_mesh();
  mesh.metadata["deep"] = std::string(100000, '[') + std::string(100000, ']');
  const auto back = decode_mesh(*encode_mesh(mesh, MeshFormat::kGlb), "x.glb");
  ASSERT_TRUE(back);
  EXPECT_EQ(back->metadata, mesh.metadata);
}

TEST(Glb, RefusesPositionsBeyondFloat) {
  Mesh mesh = sample_mesh();
  mesh.positions[4] = 1e39;
  const auto bytes = encode_mesh(mesh, MeshFormat::kGlb);
  ASSERT_FALSE(bytes);
  EXPECT_EQ(bytes.error().kind, ErrorKind::kOutput);
  EXPECT_NE(bytes.error().message.find("vertex 1"), std::string::npos);
}

}  // namespace
}  // namespace scarp
