#include <gtest/gtest.h>

#include <bit>
#include <cstring>

#include "mesh_samples.h"
#include "scarp/io.h"

namespace scarp {
namespace {

using test::sample_mesh;
using test::to_bytes;

TEST(Ply, RoundTripKeepsEveryBit) {
  for (const bool normals : {false, true}) {
    const Mesh mesh = sample_mesh(normals);
    const auto bytes = encode_mesh(mesh, MeshFormat::kPly);
    ASSERT_TRUE(bytes);
    const auto back = decode_mesh(*bytes, "x.ply");
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_TRUE(test::same_geometry(mesh, *back));
    EXPECT_EQ(back->metadata, mesh.metadata);
    EXPECT_NE(std::string(bytes->begin(), bytes->end()).find("\ncomment crs EPSG:32611\n"), std::string::npos);
  }
}

TEST(Ply, HasFloatsWhereTheySayItAll) {
  const auto header_holds = [](const Mesh& mesh, bool doubles, const std::string& words) {
    const auto bytes = encode_mesh(mesh, MeshFormat::kPly, {.double_positions = doubles});
    const auto back = decode_mesh(*bytes, "x.ply");
    EXPECT_TRUE(test::same_geometry(mesh, *back));
    return std::string(bytes->begin(), bytes->end()).find(words) != std::string::npos;
  };
  Mesh mesh = sample_mesh();
  EXPECT_TRUE(header_holds(mesh, false, "property double x")) << "its origin needs them";
  mesh.origin = {0, 0, 0};
  EXPECT_TRUE(header_holds(mesh, false, "property float x"));
  EXPECT_TRUE(header_holds(mesh, true, "property double x"));
  mesh.positions[5] = 0.1;
  EXPECT_TRUE(header_holds(mesh, false, "property double x"));
}

TEST(Ply, ReadsTextWithUnknownElementsAndPolygons) {
  const auto mesh =
      decode_mesh(to_bytes("ply\nformat ascii 1.0\ncomment crs EPSG:4326\nelement nothing 99999999999\n"
                           "element material 2\nproperty list uchar float weights\nproperty int id\n"
                           "element vertex 4\nproperty uchar red\nproperty float z\nproperty double y\n"
                           "property short x\nelement face 2\nproperty int flag\n"
                           "property list uchar int vertex_index\nend_header\n"
                           "2 0.5 0.5 7\n0 8\n255 1.5 0 0\n0 2 0 1\n0 3 1 1\n0 4 1 0\n9 4 0 1 2 3\n9 3 0 1 2"),
                  "x.ply");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->positions, (std::vector<double>{0, 0, 1.5, 1, 0, 2, 1, 1, 3, 0, 1, 4}));
  EXPECT_EQ(mesh->triangles, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3, 0, 1, 2}));
  EXPECT_EQ(mesh->metadata.at("crs"), "EPSG:4326");
}

TEST(Ply, ReadsBigEndian) {
  std::vector<std::uint8_t> bytes = to_bytes(
      "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uint8 uint16 vertex_indices\nend_header\n");
  for (const float value : {0.f, 0.f, 1.25f, 8.f, 0.f, -2.f, 0.f, 8.f, 3.f}) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::uint8_t>(bits >> shift));
  }
  for (const int byte : {3, 0, 0, 0, 1, 0, 2}) bytes.push_back(static_cast<std::uint8_t>(byte));
  const auto mesh = decode_mesh(bytes, "x.ply");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->positions, (std::vector<double>{0, 0, 1.25, 8, 0, -2, 0, 8, 3}));
  EXPECT_EQ(mesh->triangles, (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(Ply, NamesTheFault) {
  const std::string vertices = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string faces = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n", ascii = "ply\nformat ascii 1.0\n";
  const std::pair<std::string, const char*> kCases[] = {
      {"ply\nformat ascii 1.0\n", "no end"},
      {"ply\n" + vertices + faces + points + "3 0 1 2\n", "names no format"},
      {"ply\nformat sideways 1.0\n" + vertices + faces, "line 2"},
      {ascii + "element vertex -3\nend_header\n", "line 3"},
      {ascii + "element vertex 99999999999999\nproperty float x\nproperty float y\nproperty float z\n" + faces,
       "99999999999999"},
      {ascii + "element vertex 3\nproperty float x\nproperty float y\n" + faces, "lack x, y or z"},
      {ascii + vertices + faces + points + "3 0 1 3\n", "names vertex 3"},
      {ascii + vertices + faces + points + "3 0 1 -1\n", "face 0"},
      {ascii + vertices + faces + points + "3 0 1 1.5\n", "face 0"},
      {ascii + vertices + faces + points + "2 0 1\n", "face 0"},
      {ascii + vertices + faces + points + "3 0 1\n", "face 0"},
      {ascii + vertices + faces + "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n", "vertex 1 is not a finite"},
      {ascii + vertices + faces + "0 0 0\n1 hello 0\n0 1 0\n3 0 1 2\n", "vertex 1"},
      {ascii + vertices + "element face 0\nproperty list uchar int vertex_indices\nend_header\n" + points,
       "no triangles"},
  };
  for (const auto& [text, words] : kCases) {
    const auto mesh = decode_mesh(to_bytes(text), "x.ply");
    ASSERT_FALSE(mesh) << text;
    EXPECT_NE(mesh.error().message.find(words), std::string::npos) << mesh.error().message << " lacks " << words;
  }
}

}  // namespace
}  // namespace scarp
