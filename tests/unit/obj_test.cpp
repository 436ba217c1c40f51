#include <gtest/gtest.h>

#include <clocale>

#include "mesh_samples.h"
#include "scarp/io.h"

namespace scarp {
namespace {

using test::sample_mesh;
using test::to_bytes;

TEST(Obj, RoundTripKeepsEveryBit) {
  for (const bool normals : {false, true}) {
    Mesh mesh = sample_mesh(normals);
    mesh.positions[2] = static_cast<double>(0.1f);
    mesh.positions[5] = static_cast<double>(-1e-7f);
    const auto bytes = encode_mesh(mesh, MeshFormat::kObj);
    ASSERT_TRUE(bytes);
    const auto back = decode_mesh(*bytes, "x.obj");
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_TRUE(test::same_geometry(mesh, *back));
    EXPECT_EQ(back->metadata, mesh.metadata);
    EXPECT_EQ(*encode_mesh(*back, MeshFormat::kObj), *bytes);
  }
}

TEST(Obj, CommentsHoldNoBackslash) {  // some readers interpret it as a line continuation, even there
  const auto bytes = *encode_mesh(sample_mesh(), MeshFormat::kObj);
  EXPECT_EQ(std::string(bytes.begin(), bytes.end()).find('\\'), std::string::npos);
}

TEST(Obj, ReadsForeignDialects) {
  const auto mesh = decode_mesh(to_bytes("# made elsewhere\r\nmtllib a.mtl\r\nv 0 0 1.5e0 1.0\r\nv 1 0 0 255 0 0\r\n"
                                         "v 1 1 -.25\r\nv +0 1 0\r\nvt 0 0\r\nvn 0 0 1\r\nusemtl none\r\n"
                                         "f 1/1/1 2/1/1 \\\r\n 3/1/1 4/1/1\r\nf -4//1 -2//1 -1//1\r\nl 1 2\r\n"),
                                "x.obj");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->positions, (std::vector<double>{0, 0, 1.5, 1, 0, 0, 1, 1, -.25, 0, 1, 0}));
  EXPECT_EQ(mesh->triangles, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3, 0, 2, 3}));
  EXPECT_TRUE(mesh->normals.empty());  // one for all corners, not per vertex
}

TEST(Obj, ReadsFacesBeforeTheirVertices) {
  const auto mesh = decode_mesh(to_bytes("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0"), "x.obj");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->triangle_count(), 1u);
}

TEST(Obj, NamesTheLineOfAFault) {
  const struct {
    const char* text;
    const char* words;
  } kCases[] = {
      {"v 0 0 0\nv 1 0\nf 1 2 3\n", "line 2: a vertex needs"},
      {"v 0 0 nan\n", "line 1: a vertex needs"},
      {"v 0 0 1e999\n", "line 1: a vertex needs"},
      {"v 0 0 0x\n", "line 1: a vertex needs"},
      {"v 0 0 0\nf 1 2\n", "line 2: a face needs"},
      {"v 0 0 0\nf 0 1 1\n", "line 2: a face has the corner '0'"},
      {"v 0 0 0\nf 1 1 -2\n", "line 2: a face has the corner '-2'"},
      {"v 0 0 0\nf 1 1 99999999999999999999\n", "line 2: a face has the corner"},
      {"v 0 0 0\nf 1 1 4000000000\n", "names vertex 3999999999"},
      {"v 0 0 0\n", "no triangles"},
  };
  for (const auto& c : kCases) {
    const auto mesh = decode_mesh(to_bytes(c.text), "x.obj");
    ASSERT_FALSE(mesh) << c.text;
    EXPECT_EQ(mesh.error().kind, ErrorKind::kInput);
    EXPECT_NE(mesh.error().message.find(c.words), std::string::npos) << mesh.error().message;
    EXPECT_NE(mesh.error().message.find("x.obj"), std::string::npos);
  }
}

TEST(Obj, DoesNotDependOnTheLocale) {
  const char* kLocales[] = {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8"};
  const Mesh mesh = sample_mesh();
  const auto expected = *encode_mesh(mesh, MeshFormat::kObj);
  for (const char* name : kLocales) {
    if (std::setlocale(LC_NUMERIC, name) == nullptr) continue;
    const auto bytes = *encode_mesh(mesh, MeshFormat::kObj);
    const auto back = decode_mesh(bytes, "x.obj");
    std::setlocale(LC_NUMERIC, "C");
    EXPECT_EQ(bytes, expected);
    ASSERT_TRUE(back);
    EXPECT_TRUE(test::same_geometry(mesh, *back));
    return;
  }
  GTEST_SKIP() << "no locale with a decimal comma is installed";
}

TEST(Obj, AChangedFileKeepsItsPositionsRatherThanItsOrigin) {
  // 0.1 cannot be stored exactly as an offset from 1e17: the reader then keeps positions absolute.
  const auto mesh = decode_mesh(to_bytes("# scarp.origin: 1e17 0 0\nv 0.1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "x.obj");
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->vertex(0)[0], 0.1);
  EXPECT_EQ(mesh->origin[0], 0.0);
}

TEST(Obj, APolygonOfTooManyCornersIsRefused) {
  std::string text;
  for (int k = 0; k < 20000; ++k) text += "v " + std::to_string(k) + " " + std::to_string(k % 7) + " 0\n";
  text += "f";
  for (int k = 1; k <= 20000; ++k) text += " " + std::to_string(k);
  const auto mesh = decode_mesh(to_bytes(text + "\n"), "gon.obj");
  ASSERT_FALSE(mesh);
  EXPECT_NE(mesh.error().message.find("a polygon has 20000 corners, more than 16384"), std::string::npos)
      << mesh.error().message;
}

}  // namespace
}  // namespace scarp
