#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "io/mesh/file_bytes.h"
#include "mesh_samples.h"
#include "scarp/io.h"

namespace scarp {
namespace {

using test::sample_mesh;
using test::to_bytes;

/// Triangles as positions, first corner lowest, in a set.
std::multiset<std::vector<double>> triangle_set(const Mesh& mesh) {
  std::multiset<std::vector<double>> set;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    std::vector<double> best;
    for (std::size_t turn = 0; turn < 3; ++turn) {
      std::vector<double> corners;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto p = mesh.vertex(mesh.triangles[t + (turn + k) % 3]);
        corners.insert(corners.end(), p.begin(), p.end());
      }
      if (best.empty() || corners < best) best = corners;
    }
    set.insert(best);
  }
  return set;
}

TEST(Stl, RoundTripWeldsTheSameMesh) {
  const Mesh mesh = sample_mesh(true);
  const auto bytes = encode_mesh(mesh, MeshFormat::kStl);
  ASSERT_TRUE(bytes);
  EXPECT_EQ(bytes->size(), 84 + 50 * mesh.triangle_count());
  EXPECT_EQ(std::string(bytes->begin(), bytes->begin() + 13), "scarp origin ");
  const auto back = decode_mesh(*bytes, "x.stl");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->vertex_count(), mesh.vertex_count());
  EXPECT_EQ(back->origin, mesh.origin);
  EXPECT_EQ(triangle_set(*back), triangle_set(mesh));
}

TEST(Stl, KeepsEveryOrigin) {
  Mesh mesh = sample_mesh();
  mesh.origin = {-1.2345678901234567e-300, 9.8765432109876543e+299, -1.1111111111111112e-100};
  const auto back = decode_mesh(*encode_mesh(mesh, MeshFormat::kStl), "x.stl");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->origin, mesh.origin);
}

TEST(Stl, NormalsAreUnitAndUp) {
  const Mesh mesh = sample_mesh();
  const auto bytes = *encode_mesh(mesh, MeshFormat::kStl);
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const std::uint8_t* at = &bytes[84 + 50 * t];
    const double x = io::load_number<float>(at), y = io::load_number<float>(at + 4), z = io::load_number<float>(at + 8);
    EXPECT_NEAR(x * x + y * y + z * z, 1, 1e-6);
    EXPECT_GT(z, 0);
  }
}

TEST(Stl, ReadsText) {
  const auto mesh =
      decode_mesh(to_bytes("solid hill\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n"
                           "   vertex 0 1 2.5\n  endloop\n endfacet\nFACET NORMAL 0 0 1\nOUTER LOOP\n"
                           "VERTEX 1 0 -0\nVERTEX 1 1 0\nVERTEX 0 1 2.5\nENDLOOP\nENDFACET\nendsolid hill\n"),
                  "x");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->vertex_count(), 4u);
  EXPECT_EQ(mesh->triangles, (std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2}));
}

TEST(Stl, NamesTheFault) {
  auto bytes = *encode_mesh(sample_mesh(), MeshFormat::kStl);
  const auto message = [](std::span<const std::uint8_t> b) {
    const auto mesh = decode_mesh(b, "x.stl");
    return mesh ? std::string("accepted") : mesh.error().message;
  };
  EXPECT_NE(message(std::span(bytes).first(bytes.size() / 2)).find("of 24 triangles: it was cut off"),
            std::string::npos);
  EXPECT_NE(message(std::span(bytes).first(60)).find("within the header"), std::string::npos);
  std::uint8_t* at = &bytes[84 + 50 + 12];
  io::store_number(at, std::nanf(""));
  EXPECT_NE(message(bytes).find("triangle 1"), std::string::npos);
  EXPECT_NE(message(to_bytes("solid\nfacet\nouter loop\nvertex 1 2 3\n")).find("without 'endsolid'"),
            std::string::npos);
  EXPECT_NE(message(to_bytes("solid\nvertex 1 2 x\n")).find("line 2"), std::string::npos);
  EXPECT_NE(message(to_bytes("solid\nvertex 1 2 3\nendloop\nendsolid\n")).find("line 3"), std::string::npos);
  EXPECT_NE(message(to_bytes("solid empty\nendsolid empty\n")).find("no triangles"), std::string::npos);
}

}  // namespace
}  // namespace scarp
