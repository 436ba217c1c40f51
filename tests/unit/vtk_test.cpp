#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "mesh_samples.h"
#include "scarp/io.h"

namespace scarp::vtk_test {
namespace {

using test::sample_mesh;
using test::to_bytes;

class Vtk : public ::testing::TestWithParam<MeshFormat> {};

TEST_P(Vtk, RoundTripKeepsEveryBit) {
  Mesh mesh = sample_mesh(true);
  mesh.positions[2] = 0.1;
  mesh.positions[5] = -1e-7 / 3;
  mesh.metadata["hyphens"] = "---a--b-";
  mesh.metadata["file"] = "a<b>&\"c\xC3\xA4.tif";
  test::add_attributes(mesh, 3);
  const auto bytes = encode_mesh(mesh, GetParam());
  ASSERT_TRUE(bytes);
  const auto back = decode_mesh(*bytes, "x");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_TRUE(test::same_geometry(mesh, *back));
  EXPECT_EQ(back->metadata, mesh.metadata);
  EXPECT_EQ(back->uvs, mesh.uvs);
  EXPECT_EQ(back->colors, mesh.colors);
  EXPECT_EQ(back->channels, mesh.channels);
  EXPECT_EQ(*encode_mesh(*back, GetParam()), *bytes);
}

TEST_P(Vtk, ChannelsWithoutAValueStayNan) {
  Mesh mesh = sample_mesh();
  test::add_attributes(mesh, 1);
  mesh.channels[3] = std::numeric_limits<float>::quiet_NaN();
  const auto back = decode_mesh(*encode_mesh(mesh, GetParam()), "x");
  ASSERT_TRUE(back);
  EXPECT_TRUE(std::isnan(back->channels[3]));
  EXPECT_EQ(back->channels[4], mesh.channels[4]);
}

INSTANTIATE_TEST_SUITE_P(Both, Vtk, ::testing::Values(MeshFormat::kVtu, MeshFormat::kVtp),
                         [](const auto& format) { return format.param == MeshFormat::kVtu ? "vtu" : "vtp"; });

std::string grid(const std::string& attributes, const std::string& inside, const std::string& behind = "") {
  return "<VTKFile type=\"UnstructuredGrid\" " + attributes + "><UnstructuredGrid>" + inside + "</UnstructuredGrid>" +
         behind + "</VTKFile>";
}

const std::string kText =
    "<Piece NumberOfPoints=\"4\" NumberOfCells=\"3\"><Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" "
    "format=\"ascii\">0 0 1 1 0 2\n1 1 3 0 1 4</DataArray></Points><Cells>"
    "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2 3 0 1 0 1 3 2</DataArray>"
    "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">4 6 10</DataArray>"
    "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">9 3 8</DataArray></Cells></Piece>";

TEST(VtkDialects, ArraysAsTextWithQuadsLinesAndPixels) {
  const auto mesh = decode_mesh(to_bytes(grid("", kText)), "x.vtu");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->positions, (std::vector<double>{0, 0, 1, 1, 0, 2, 1, 1, 3, 0, 1, 4}));
  EXPECT_EQ(mesh->triangles, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3, 0, 1, 2, 0, 2, 3}));
}

TEST(VtkDialects, PiecesAreJoined) {
  const auto mesh = decode_mesh(to_bytes(grid("", kText + kText)), "x.vtu");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->vertex_count(), 8u);
  EXPECT_EQ(mesh->triangle_count(), 8u);
  EXPECT_EQ(mesh->triangles[12], 4u);
}

/// One triangle with base64 arrays: the points inline, the rest after the XML, with 32-bit lengths.
TEST(VtkDialects, Base64WithLengthsOf32Bits) {
  // 36 bytes: float32 0 0 0, 1 0 0, 0 1 0. After it: int32 0 1 2 (12 bytes); int32 3 (4 bytes) with its separately
  // padded length; uint8 5 (1 byte).
  const std::string inside =
      "<Piece NumberOfPoints=\"3\" NumberOfCells=\"1\"><Points><DataArray type=\"Float32\" format=\"binary\">\n"
      "  JAAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAA==\n</DataArray></Points><Cells>"
      "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"appended\" offset=\"0  \"/>"
      "<DataArray type=\"Int32\" Name=\"offsets\" format=\"appended\" offset=\"24\"/>"
      "<DataArray type=\"UInt8\" Name=\"types\" format=\"appended\" offset=\"40\"/></Cells></Piece>";
  const std::string behind =
      "<AppendedData encoding=\"base64\">_DAAAAAAAAAABAAAAAgAAAA==BAAAAA==AwAAAA==AQAAAAU=</AppendedData>";
  const auto mesh = decode_mesh(to_bytes(grid("byte_order=\"LittleEndian\"", inside, behind)), "x.vtu");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->positions, (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0}));
  EXPECT_EQ(mesh->triangles, (std::vector<std::uint32_t>{0, 1, 2}));
}

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(VtkDialects, NamesTheFault) {
  const struct {
    std::string text;
    const char* words;
  } kCases[] = {
      {changed(grid("", kText), "UnstructuredGrid", "ImageData"), "it is VTK's 'ImageData'"},
      {grid("compressor=\"vtkZLibDataCompressor\"", kText), "arrays are compressed"},
      {grid("", ""), "no piece"},
      {grid("", changed(kText, "=\"4\"", "=\"5\"")), "announces 5 points and has 4"},
      {grid("", changed(kText, "=\"4\"", "=\"-4\"")), "announces -4 points"},
      {grid("", changed(kText, "=\"3\"", "=\"2\"")), "announces 2 cells and has 3"},
      {grid("", changed(kText, "0 1 2 3", "0 1 2 4")), "names point 4"},
      {grid("", changed(kText, "4 6 10", "4 6 11")), "cell 2 (counting from 0) has no end"},
      {grid("", changed(kText, "4 6 10", "4 3 10")), "cell 1 (counting from 0) has no end"},
      {grid("", changed(kText, "9 3 8", "10 3 8")), "is of kind 10, which is no polygon"},
      {grid("", changed(kText, "1 1 3", "1 1 x")), "array 'Points' holds a word that is no number"},
      {grid("", changed(kText, "1 1 3", "1 1 inf")), "is not a finite number"},
      {grid("", changed(kText, "offsets", "ends")), "no array 'Cells/offsets'"},
      {grid("", changed(kText, "format=\"ascii\"", "format=\"appended\"")), "does not say where it is"},
      {grid("", changed(kText, "format=\"ascii\"", "format=\"appended\" offset=\"7\"")), "begins behind the end"},
      {grid("", changed(kText, "format=\"ascii\"", "format=\"binary\"")), "damaged or cut off"},
      {grid("", kText, "<AppendedData encoding=\"raw\"> "), "it was cut off"},
  };
  for (const auto& c : kCases) {
    const auto mesh = decode_mesh(to_bytes(c.text), "x.vtu");
    ASSERT_FALSE(mesh) << c.text;
    EXPECT_EQ(mesh.error().kind, ErrorKind::kInput);
    EXPECT_NE(mesh.error().message.find(c.words), std::string::npos) << mesh.error().message;
  }
}

TEST(VtkDialects, ArraysThatShareBytesAreRefused) {
  std::string piece =
      "<Piece NumberOfPoints=\"3\" NumberOfCells=\"1\"><Points><DataArray type=\"Int8\" format=\"appended\" "
      "offset=\"0\"/></Points><Cells><DataArray type=\"Int8\" Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray>"
      "<DataArray type=\"Int8\" Name=\"offsets\" format=\"ascii\">3</DataArray>"
      "<DataArray type=\"Int8\" Name=\"types\" format=\"ascii\">5</DataArray></Cells></Piece>";
  std::string points(90000, '\1');
  piece = changed(piece, "\"3\"", "\"30000\"");
  const std::string behind =
      "<AppendedData encoding=\"raw\">_" + std::string("\x90\x5F\x01\x00", 4) + points + "</AppendedData>";
  EXPECT_TRUE(decode_mesh(to_bytes(grid("", piece, behind)), "x.vtu"));
  const auto mesh = decode_mesh(to_bytes(grid("", piece + piece, behind)), "x.vtu");
  ASSERT_FALSE(mesh);
  EXPECT_NE(mesh.error().message.find("its arrays overlap"), std::string::npos) << mesh.error().message;
}

}  // namespace
}  // namespace scarp::vtk_test
