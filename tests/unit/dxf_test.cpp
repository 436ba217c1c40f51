#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "mesh_samples.h"
#include "scarp/io.h"

namespace scarp::dxf_test {
namespace {

using test::sample_mesh;
using test::to_bytes;

std::vector<std::array<double, 3>> corners(const Mesh& mesh) {
  std::vector<std::array<double, 3>> list;
  for (const std::uint32_t v : mesh.triangles) list.push_back(mesh.vertex(v));
  return list;
}

TEST(Dxf, RoundTripKeepsEveryBitOfEveryCorner) {
  Mesh mesh = sample_mesh();
  mesh.positions[2] = 0.1;
  mesh.positions[5] = -1e-7 / 3;
  mesh.metadata["long"] = std::string(1000, 'x') + "%\n\xC3\xA4";
  const auto bytes = *encode_mesh(mesh, MeshFormat::kDxf);
  const auto back = decode_mesh(bytes, "x.dxf");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(corners(*back), corners(mesh));
  EXPECT_EQ(back->vertex_count(), mesh.vertex_count());
  EXPECT_EQ(back->origin, mesh.origin);
  EXPECT_EQ(back->metadata, mesh.metadata);
}

TEST(Dxf, IsPairsOfShortLinesOfAscii) {
  Mesh mesh = sample_mesh();
  mesh.metadata["long"] = std::string(1000, 'x') + "\xC3\xA4";
  const auto bytes = *encode_mesh(mesh, MeshFormat::kDxf);
  EXPECT_TRUE(std::all_of(bytes.begin(), bytes.end(),
                          [](std::uint8_t byte) { return byte == '\n' || (byte >= 32 && byte < 127); }));
  std::size_t lines = 0, length = 0;
  for (const std::uint8_t byte : bytes) {
    length = byte == '\n' ? 0 : length + 1;
    lines += byte == '\n';
    ASSERT_LE(length, 255u);
  }
  EXPECT_EQ(lines % 2, 0u);
}

TEST(Dxf, ReadsForeignDialects) {
  const auto mesh = decode_mesh(
      to_bytes(
          "  0\r\nSECTION\r\n  2\r\nBLOCKS\r\n  0\r\n3DFACE\r\n 10\r\n9\r\n  0\r\nENDSEC\r\n  0\r\nSECTION\r\n  2\r\n"
          "ENTITIES\r\n  0\r\nPOINT\r\n 10\r\n5\r\n  0\r\n3DFACE\r\n  8\r\n0\r\n 62\r\n7\r\n"
          " 10\r\n0.0\r\n 20\r\n0\r\n 30\r\n1\r\n 11\r\n1.0\r\n 21\r\n0.\r\n 31\r\n2\r\n"
          " 12\r\n1\r\n 22\r\n1\r\n 32\r\n3\r\n 13\r\n0\r\n 23\r\n1\r\n 33\r\n4\r\n"
          "  0\r\n3DFACE\r\n 10\r\n1\r\n 20\r\n0\r\n 11\r\n2\r\n 21\r\n0\r\n 12\r\n2\r\n 22\r\n1\r\n"
          "  0\r\nENDSEC\r\n  0\r\nEOF\r\n"),
      "x.dxf");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->positions, (std::vector<double>{0, 0, 1, 1, 0, 2, 1, 1, 3, 0, 1, 4, 1, 0, 0, 2, 0, 0, 2, 1, 0}));
  EXPECT_EQ(mesh->triangles, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3, 4, 5, 6}));
}

TEST(Dxf, NamesTheFault) {
  const std::string head = "0\nSECTION\n2\nENTITIES\n0\n3DFACE\n";
  const struct {
    std::string text;
    const char* words;
  } kCases[] = {
      {head + "10\nx\n", "line 8: a coordinate is no finite number"},
      {head + "10\n1\n0\nENDSEC\n0\nEOF\n", "line 10: a 3DFACE ends without its three corners"},
      {head + "ten\n1\n", "line 7: no group's number"},
      {"0\nSECTION\n2\nENTITIES\n0\nENDSEC\n", "no end mark"},
      {"0\nSECTION\n2\nENTITIES\n0\nENDSEC\n0\nEOF\n", "no triangles"},
  };
  for (const auto& c : kCases) {
    const auto mesh = decode_mesh(to_bytes(c.text), "x.dxf");
    ASSERT_FALSE(mesh) << c.text;
    EXPECT_EQ(mesh.error().kind, ErrorKind::kInput);
    EXPECT_NE(mesh.error().message.find(c.words), std::string::npos) << mesh.error().message;
  }
}

}  // namespace
}  // namespace scarp::dxf_test
