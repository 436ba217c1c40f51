#include <gtest/gtest.h>

#include <string>

#include "mesh_samples.h"
#include "scarp/io.h"
#include "simplify/zones.h"

namespace scarp {
namespace {

std::string gmsh_text(const Mesh& mesh, const MeshZones& zones) {
  const auto bytes = encode_mesh(mesh, MeshFormat::kMsh, {.zones = &zones});
  EXPECT_TRUE(bytes) << bytes.error().message;
  return bytes ? std::string(bytes->begin(), bytes->end()) : "";
}

TEST(Gmsh, RoundTripKeepsEveryBit) {
  Mesh mesh = test::sample_mesh();
  mesh.positions[5] = 1.0 / 3;  // a height: x and y are rounded to doubles of absolute coordinates
  mesh.metadata["command"] = "scarp simplify $HOME/a.tif b.msh\n$Nodes";
  const auto bytes = encode_mesh(mesh, MeshFormat::kMsh);
  ASSERT_TRUE(bytes) << bytes.error().message;
  const auto back = decode_mesh(*bytes, "x.msh");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_TRUE(test::same_geometry(mesh, *back));
  EXPECT_EQ(back->metadata, mesh.metadata);
  EXPECT_EQ(*encode_mesh(*back, MeshFormat::kMsh), *bytes);
}

TEST(Gmsh, MaterialsAreSurfacesAndNodeStringsAreCurves) {
  Mesh mesh;
  mesh.positions = {0, 0, 1, 1, 0, 2, 1, 1, 3, 0, 1, 4};
  mesh.triangles = {0, 1, 2, 0, 2, 3};
  // Parts of one line form a group, a material 0 gets a free number, and names have no quotes.
  const std::string text =
      gmsh_text(mesh, {{5, 0}, {{"in \"a\"", {0, 1, 2}}, {"in \"a\"", {2, 3}}, {"out", {0, 3}}, {"point", {1}}}});
  EXPECT_NE(text.find("$PhysicalNames\n4\n2 1 \"material_0\"\n2 5 \"material_5\"\n1 1 \"in _a_\"\n1 2 \"out\"\n"),
            std::string::npos);
  EXPECT_NE(text.find("$Entities\n0 3 2 0\n1 0 0 1 1 1 3 1 1 0\n2 0 1 3 1 1 4 1 1 0\n3 0 0 1 0 1 4 1 2 0\n"
                      "1 0 0 1 1 1 4 1 1 0\n2 0 0 1 1 1 3 1 5 0\n$EndEntities\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("$Nodes\n1 4 1 4\n2 1 0 4\n1\n2\n3\n4\n0 0 1\n1 0 2\n1 1 3\n0 1 4\n$EndNodes\n"),
            std::string::npos);
  EXPECT_NE(text.find("$Elements\n5 6 1 6\n2 1 2 1\n2 1 3 4\n2 2 2 1\n1 1 2 3\n1 1 1 2\n3 1 2\n4 2 3\n1 2 1 1\n5 3 4\n"
                      "1 3 1 1\n6 1 4\n$EndElements\n"),
            std::string::npos);
  const auto back = decode_mesh(test::to_bytes(text), "x.msh");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->triangles, (std::vector<std::uint32_t>{0, 2, 3, 0, 1, 2}));
  EXPECT_EQ(back->positions, mesh.positions);
}

TEST(Gmsh, ReadsForeignDialects) {
  // Version 2, nodes with numbers in any order, a quadrangle, a line and a point, and irrelevant sections.
  const auto old = decode_mesh(
      test::to_bytes("$MeshFormat\r\n2.2 0 8\r\n$EndMeshFormat\r\n$Nodes\r\n4\r\n7 0 0 1\r\n3 1 0 2\r\n9 1 1 3\r\n"
                     "2 0 1 4e0\r\n$EndNodes\r\n$Elements\r\n3\r\n1 15 2 0 1 7\r\n2 1 2 0 1 7 3\r\n"
                     "3 3 2 99 2 7 3 9 2\r\n$EndElements\r\n$NodeData\r\n1\r\n$EndNodeData\r\n"),
      "x.msh");
  ASSERT_TRUE(old) << old.error().message;
  EXPECT_EQ(old->triangles, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(old->vertex(3), (std::array{0.0, 1.0, 4.0}));
  // Nodes with parameters, in several blocks.
  const auto blocks = decode_mesh(
      test::to_bytes("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n2 3 1 3\n0 1 1 1\n1\n0 0 1\n2 1 1 2\n2\n3\n"
                     "1 0 2 0.5 0.5\n0 1 3 0.25 0.5\n$EndNodes\n$Elements\n1 1 1 1\n2 1 2 1\n1 1 2 3\n$EndElements"),
      "x.msh");
  ASSERT_TRUE(blocks) << blocks.error().message;
  EXPECT_EQ(blocks->positions, (std::vector<double>{0, 0, 1, 1, 0, 2, 0, 1, 3}));
}

TEST(Gmsh, NamesTheFault) {
  const std::string head = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n",
                    nodes = "$Nodes\n1 3 1 3\n2 1 0 3\n1\n2\n3\n0 0 0\n1 0 0\n0 1 0\n$EndNodes\n";
  const struct {
    std::string text, words;
  } cases[] = {
      {"$MeshFormat\n4.1 1 8\n", "it is binary"},
      {"$MeshFormat\n4 0 8\n$EndMeshFormat\n", "version '4' is not read"},
      {head + nodes, "it was cut off"},
      {head + nodes + nodes, "$Nodes is there twice"},
      {head + "stray\n", "begins with a '$'"},
      {head + "$Nodes\n1 4 1 3\n2 1 0 3\n1\n2\n3\n0 0 0\n1 0 0\n0 1 0\n$EndNodes\n", "announces 4 nodes and has 3"},
      {head + "$Nodes\n1 3 1 3\n2 1 0 3\n1\n2\n3\n0 0 0\n1 0 0\n0 nan 0\n$EndNodes\n", "three finite coordinates"},
      {head +
           "$Nodes\n1 3 1 3\n2 1 0 3\n1\n2\n2\n0 0 0\n1 0 0\n0 1 0\n$EndNodes\n$Elements\n1 1 1 1\n2 1 2 1\n1 1 2 2\n"
           "$EndElements\n",
       "two of its nodes have the number 2"},
      {head + nodes + "$Elements\n1 1 1 1\n2 1 2 1\n1 1 2 8\n$EndElements\n", "names node 8"},
      {head + nodes + "$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 1\n$EndElements\n", "element of type 4"},
      {head + nodes + "$Elements\n1 2 1 1\n2 1 2 1\n1 1 2 3\n$EndElements\n", "announces 2 elements and has 1"},
      {head + nodes + "$Elements\n1 1 1 1\n1 1 1 1\n1 1 2\n$EndElements\n", "no triangles"},
  };
  for (const auto& c : cases) {
    const auto mesh = decode_mesh(test::to_bytes(c.text), "x.msh");
    ASSERT_FALSE(mesh) << c.text;
    EXPECT_NE(mesh.error().message.find(c.words), std::string::npos) << mesh.error().message;
  }
}

}  // namespace
}  // namespace scarp
