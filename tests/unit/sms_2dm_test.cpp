#include <gtest/gtest.h>

#include "mesh_samples.h"
#include "scarp/io.h"

namespace scarp::sms_2dm_test {
namespace {

using test::sample_mesh;
using test::to_bytes;

TEST(Sms2dm, RoundTripKeepsEveryBit) {
  Mesh mesh = sample_mesh();
  mesh.positions[2] = 0.1;
  mesh.positions[5] = -1e-7 / 3;
  const auto bytes = encode_mesh(mesh, MeshFormat::k2dm);
  ASSERT_TRUE(bytes);
  const auto back = decode_mesh(*bytes, "x.2dm");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_TRUE(test::same_geometry(mesh, *back));
  EXPECT_EQ(back->metadata, mesh.metadata);
  EXPECT_EQ(*encode_mesh(*back, MeshFormat::k2dm), *bytes);
}

TEST(Sms2dm, HasACardForEveryNodeAndTriangle) {
  Mesh mesh;
  mesh.positions = {0, 0, 1.5, 10, 0, 2, 0, 10, 0.1};
  mesh.triangles = {0, 1, 2};
  const auto bytes = *encode_mesh(mesh, MeshFormat::k2dm);
  const std::string text(bytes.begin(), bytes.end());
  EXPECT_TRUE(text.starts_with("MESH2D\n"));
  EXPECT_NE(text.find("\nE3T 1 1 2 3 1\n"), std::string::npos);
  EXPECT_NE(text.find("\nND 1 0 0 1.5\nND 2 10 0 2\nND 3 0 10 0.1\n"), std::string::npos);
}

TEST(Sms2dm, ReadsForeignDialects) {
  const auto mesh = decode_mesh(to_bytes("MESH2D\r\nMESHNAME \"a # b\"\r\nNUM_MATERIALS_PER_ELEM 2\r\n"
                                         "ND 40 0 0 1e0\r\nND 7 1 0 2.\r\nND 12 1 1 3\r\nND 3 0 1 4 # corner\r\n"
                                         "E4Q 1 40 7 12 3 1 5\r\nE3T 2 40 7 12 1.5\r\nE2L 9 40 7 1\r\nNS 40 7 -12\r\n"
                                         "BEGPARAMDEF\r\nGM \"Mesh\"\r\nENDPARAMDEF\r\n"),
                                "x.2dm");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->positions, (std::vector<double>{0, 0, 1, 1, 0, 2, 1, 1, 3, 0, 1, 4}));
  EXPECT_EQ(mesh->triangles, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3, 0, 1, 2}));
}

TEST(Sms2dm, NamesTheFault) {
  const struct {
    const char* text;
    const char* words;
  } kCases[] = {
      {"MESH2D\nND 1 0 0\n", "line 2: a node needs three finite coordinates"},
      {"MESH2D\nND a 0 0 0\n", "line 2: a node needs a whole number"},
      {"MESH2D\nND 1 0 0 inf\n", "line 2: a node needs three finite coordinates"},
      {"MESH2D\nE3T 1 2 3\n", "line 2: an element needs its number and those of its 3 nodes"},
      {"MESH2D\nE6T 1 1 2 3 4 5 6 1\n", "line 2: E6T is an element with curved edges"},
      {"MESH2D\nE3T 1 1 2 4 1\nND 1 0 0 0\nND 2 1 0 0\nND 3 0 1 0\n", "an element names node 4"},
      {"MESH2D\nE3T 1 1 2 3 1\nND 1 0 0 0\nND 2 1 0 0\nND 3 0 1 0\nND 2 0 1 0\n", "two of its nodes have the number 2"},
      {"MESH2D\nND 1 0 0 0\n", "no triangles"},
      {"MESH2D\n# scarp.counts: 3 1\nE3T 1 1 2 3 1\nND 1 0 0 0\nND 2 1 0 0\nND 3 0 1 0\n", "was cut off"},
  };
  for (const auto& c : kCases) {
    const auto mesh = decode_mesh(to_bytes(c.text), "x.2dm");
    ASSERT_FALSE(mesh) << c.text;
    EXPECT_EQ(mesh.error().kind, ErrorKind::kInput);
    EXPECT_NE(mesh.error().message.find(c.words), std::string::npos) << mesh.error().message;
  }
}

}  // namespace
}  // namespace scarp::sms_2dm_test
