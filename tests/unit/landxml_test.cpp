#include <gtest/gtest.h>

#include "mesh_samples.h"
#include "scarp/io.h"

namespace scarp::landxml_test {
namespace {

using test::sample_mesh;
using test::to_bytes;

std::string text_of(const Mesh& mesh) {
  const auto bytes = encode_mesh(mesh, MeshFormat::kLandXml);
  EXPECT_TRUE(bytes) << bytes.error().message;
  return bytes ? std::string(bytes->begin(), bytes->end()) : "";
}

std::string refusal(const Mesh& mesh) {
  const auto bytes = encode_mesh(mesh, MeshFormat::kLandXml);
  EXPECT_FALSE(bytes);
  return bytes ? "" : bytes.error().message;
}

Mesh triangle() {
  Mesh mesh;
  mesh.positions = {100, 2000, 1.5, 110, 2000, 2, 100, 2010, 0.1};
  mesh.triangles = {0, 1, 2};
  return mesh;
}

TEST(LandXml, RoundTripKeepsEveryBit) {
  Mesh mesh = sample_mesh();
  mesh.positions[2] = 0.1;
  mesh.positions[5] = -1e-7 / 3;
  mesh.metadata["file"] = "a<b>&\"c\xC3\xA4.tif";
  const auto bytes = encode_mesh(mesh, MeshFormat::kLandXml);
  ASSERT_TRUE(bytes) << bytes.error().message;
  const auto back = decode_mesh(*bytes, "x.xml");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_TRUE(test::same_geometry(mesh, *back));
  EXPECT_EQ(back->metadata, mesh.metadata);
  EXPECT_EQ(*encode_mesh(*back, MeshFormat::kLandXml), *bytes);
}

TEST(LandXml, PointsAreNorthingEastingElevation) {
  const std::string text = text_of(triangle());
  EXPECT_NE(text.find("<P id=\"1\">2000 100 1.5</P>\n<P id=\"2\">2000 110 2</P>\n<P id=\"3\">2010 100 0.1</P>"),
            std::string::npos);
  EXPECT_NE(text.find("<F>1 2 3</F>"), std::string::npos);
}

TEST(LandXml, UnitsAreThoseOfTheCrs) {
  Mesh mesh = triangle();
  EXPECT_NE(text_of(mesh).find("<Metric areaUnit=\"squareMeter\" linearUnit=\"meter\""), std::string::npos);
  EXPECT_EQ(text_of(mesh).find("CoordinateSystem"), std::string::npos);
  mesh.metadata["crs"] = "EPSG:32611";
  EXPECT_NE(text_of(mesh).find("linearUnit=\"meter\""), std::string::npos);
  EXPECT_NE(
      text_of(mesh).find("<CoordinateSystem name=\"WGS 84 / UTM zone 11N\" epsgCode=\"32611\" ogcWktCode=\"PROJCS["),
      std::string::npos);
  mesh.metadata["crs"] = "EPSG:2227";  // California zone 3, US survey feet
  EXPECT_NE(text_of(mesh).find("<Imperial areaUnit=\"squareFoot\" linearUnit=\"USSurveyFoot\""), std::string::npos);
  mesh.metadata["crs"] = "EPSG:2222";  // Arizona East, international feet
  EXPECT_NE(text_of(mesh).find("linearUnit=\"foot\""), std::string::npos);
}

TEST(LandXml, DegreesAndMixedUnitsAreRefused) {
  Mesh mesh = triangle();
  mesh.metadata["crs"] = "EPSG:4326";
  EXPECT_NE(refusal(mesh).find("has degrees"), std::string::npos) << refusal(mesh);
  mesh.metadata["crs"] = "nonsense";
  EXPECT_NE(refusal(mesh).find("unknown here"), std::string::npos) << refusal(mesh);
  mesh.metadata["crs"] = "EPSG:27700";
  mesh.metadata["unit"] = "Feet";
  EXPECT_NE(refusal(mesh).find("x and y are in meter but heights in foot"), std::string::npos) << refusal(mesh);
  mesh.metadata["unit"] = "m";
  EXPECT_NE(text_of(mesh), "");
  mesh.metadata["unit"] = "something";
  EXPECT_NE(text_of(mesh), "");
}

TEST(LandXml, ReadsForeignDialects) {
  const auto mesh = decode_mesh(
      to_bytes(
          "\xEF\xBB\xBF<?xml version='1.0'?><!-- made elsewhere -->\r\n"
          "<l:LandXML xmlns:l='http://www.landxml.org/schema/LandXML-1.2'><l:Surfaces>"
          "<l:Surface name='a'><l:SourceData><l:Boundaries><l:Boundary><l:PntList3D>1 2 3</l:PntList3D></l:Boundary>"
          "</l:Boundaries></l:SourceData><l:Definition surfType='TIN'><l:Pnts><l:P id='40'> 0\r\n0 1.0 </l:P>"
          "<l:P id='7'>0 1 2</l:P><l:P id='12'>1 <![CDATA[1]]> 3</l:P></l:Pnts>"
          "<l:Faces><l:F n='0 2 0'>40 7 12</l:F><l:F i='1'>12 7 40</l:F></l:Faces></l:Definition></l:Surface>"
          "<l:Surface name='b'><l:Definition surfType='TIN'><l:Pnts><l:P id='1'>5 5 5</l:P><l:P id='2'>5 6 5</l:P>"
          "<l:P id='3'>6 6 5</l:P></l:Pnts><l:Faces><l:F>1 2 3</l:F></l:Faces></l:Definition></l:Surface>"
          "</l:Surfaces></l:LandXML>\r\n"),
      "x.xml");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->positions, (std::vector<double>{0, 0, 1, 1, 0, 2, 1, 1, 3, 5, 5, 5, 6, 5, 5, 6, 6, 5}));
  EXPECT_EQ(mesh->triangles, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5}));
}

TEST(LandXml, NamesTheFault) {
  const std::string head = "<LandXML><Surfaces><Surface>\n<Definition><Pnts><P id='1'>0 0 0</P><P id='2'>0 1 0</P>";
  const struct {
    std::string text;
    const char* words;
  } kCases[] = {
      {head + "<P id='3'>1 0</P>", "line 2: a point needs its northing, easting and elevation"},
      {head + "<P>1 0 0</P>", "a point needs a whole number"},
      {head + "</Pnts><Faces><F>1 2</F>", "a face needs at least three points"},
      {head + "</Pnts><Faces><F>1 2 x</F>", "no whole number"},
      {head + "</Pnts><Faces><F>1 2 9</F></Faces></Definition></Surface>", "a face names point 9"},
      {head + "<P id='2'>1 0 0</P></Pnts></Definition></Surface>", "two points of a surface have the number 2"},
      {head + "</Pnts></Definition></Surface></Surfaces></LandXML>", "no triangles"},
      {head + "</Faces>", "'Faces' ends, which was not the last to begin"},
      {head, "it ends within 'Pnts': it was cut off"},
      {head + "<P id='3", "the tag 'P' is broken or cut off"},
  };
  for (const auto& c : kCases) {
    const auto mesh = decode_mesh(to_bytes(c.text), "x.xml");
    ASSERT_FALSE(mesh) << c.text;
    EXPECT_EQ(mesh.error().kind, ErrorKind::kInput);
    EXPECT_NE(mesh.error().message.find(c.words), std::string::npos) << mesh.error().message;
  }
}

}  // namespace
}  // namespace scarp::landxml_test
