// Lines and polygons from vector files.
#include "scarp/lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "unit/raster_files.h"

namespace scarp {
namespace {

using testing::contains;

/// GeoJSON with one feature per geometry; FIDs count from 0.
std::string geojson(const std::vector<std::string>& geometries, const std::string& crs = "EPSG::32611",
                    const std::string& properties = "{}") {
  std::string text = R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:)";
  text.append(crs).append(R"("}},"features":[)");
  for (const std::string& geometry : geometries) {
    if (&geometry != &geometries.front()) text.append(",");
    text.append(R"({"type":"Feature","properties":)").append(properties);
    text.append(R"(,"geometry":)").append(geometry).append("}");
  }
  return text.append("]}");
}

class LineFiles : public ::testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) {
    testing::write_text(scratch_.file(name), text);
    return scratch_.file(name);
  }
  LineSet read(const std::string& path, const ReadLinesOptions& options = {}) {
    auto lines = read_lines(path, options);
    if (lines) return std::move(*lines);
    ADD_FAILURE() << lines.error().message;
    return {};
  }
  /// Returns the one-line message, which must name the file.
  std::string refuse(const std::string& path, const ReadLinesOptions& options = {},
                     ErrorKind kind = ErrorKind::kInput) {
    const auto lines = read_lines(path, options);
    if (lines) {
      ADD_FAILURE() << "read: " << path;
      return {};
    }
    EXPECT_EQ(lines.error().kind, kind) << lines.error().message;
    EXPECT_EQ(lines.error().message.find('\n'), std::string::npos) << lines.error().message;
    return lines.error().message;
  }
  testing::ScratchFolder scratch_;
};

constexpr const char* kPlain = R"({"type":"LineString","coordinates":[[1,2],[3,4.5],[3,4.5],[6,7]]})";
constexpr const char* kDeep = R"({"type":"LineString","coordinates":[[1,2,10],[3,4,11.5]]})";
constexpr const char* kSquareWithHole =
    R"({"type":"Polygon","coordinates":[[[0,0],[9,0],[9,9],[0,9],[0,0]],[[1,1],[1,2],[2,2],[1,1]]]})";

TEST_F(LineFiles, a_line_keeps_its_vertices_but_not_twice) {
  const LineSet set = read(write("a.geojson", geojson({kPlain})));
  ASSERT_EQ(set.lines.size(), 1u);
  const Line& line = set.lines[0];
  ASSERT_EQ(line.points.size(), 3u);
  EXPECT_EQ(line.points[1][0], 3);
  EXPECT_EQ(line.points[1][1], 4.5);
  for (const auto& point : line.points) EXPECT_TRUE(std::isnan(point[2]));
  EXPECT_EQ(line.role, LineRole::kLine);
  EXPECT_EQ(line.polygon, kNoPolygon);
  EXPECT_TRUE(contains(line.name, "a.geojson feature 0")) << line.name;
  EXPECT_EQ(set.format, "GeoJSON");
  EXPECT_EQ(set.crs, "EPSG:32611");
  EXPECT_TRUE(set.warnings.empty());
}

TEST_F(LineFiles, boundaries_of_landxml_are_polygons_with_voids_as_holes) {
  const auto drawing = [&](const std::string& boundaries, const std::string& unit = "meter") {
    return write("a.xml", "<LandXML><Units><Metric linearUnit=\"" + unit + "\"/></Units><Surface name=\"s\">" +
                              boundaries + "</Surface></LandXML>");
  };
  const std::string outer = "<Boundary><PntList2D>0 10 0 19 9 19 9 10</PntList2D></Boundary>",
                    hole = "<Boundary bndType=\"void\"><PntList3D>1 11 5 1 12 5 2 12 5 1 11 5</PntList3D></Boundary>",
                    island = "<Boundary bndType=\"island\"><PntList2D>20 0 20 1 21 1</PntList2D></Boundary>";
  const LineSet plain = read(drawing(outer + island));
  ASSERT_EQ(plain.lines.size(), 2u);
  EXPECT_EQ(plain.polygons, 2u);
  EXPECT_EQ(plain.format, "LandXML");
  EXPECT_EQ(plain.layer, "s");
  ASSERT_EQ(plain.lines[0].points.size(), 5u);
  EXPECT_EQ(plain.lines[0].points[1][0], 19);
  EXPECT_EQ(plain.lines[0].points[1][1], 0);
  for (const Line& line : plain.lines) {
    EXPECT_EQ(line.role, LineRole::kOuter);
    for (const auto& point : line.points) EXPECT_TRUE(std::isnan(point[2]));
  }
  const LineSet holed = read(drawing(hole + outer));
  ASSERT_EQ(holed.lines.size(), 2u);
  EXPECT_EQ(holed.polygons, 1u);
  EXPECT_EQ(holed.lines[0].role, LineRole::kOuter);
  EXPECT_EQ(holed.lines[1].role, LineRole::kHole);
  EXPECT_EQ(holed.lines[1].points.size(), 4u);
  EXPECT_EQ(read(drawing(outer), {.unit_in_metres = 1}).lines.size(), 1u);
  EXPECT_TRUE(contains(refuse(drawing(outer, "foot"), {.unit_in_metres = 1}), "its unit is foot"));
  EXPECT_TRUE(contains(refuse(drawing("")), "LandXML without boundaries"));
  EXPECT_TRUE(contains(refuse(drawing(hole)), "has no outer boundary"));
  EXPECT_TRUE(contains(refuse(drawing(outer) + ":t"), "has no surface 't'"));
  EXPECT_TRUE(contains(refuse(drawing("<Boundary><PntList2D>0 1 2</PntList2D></Boundary>")), "2 does not divide"));
}

TEST_F(LineFiles, the_third_coordinate_is_the_height_unless_told_otherwise) {
  const std::string path = write("a.geojson", geojson({kDeep}, "EPSG::32611", R"({"elev":7,"name":"x","empty":null})"));
  EXPECT_EQ(read(path).lines[0].points[1][2], 11.5);
  EXPECT_TRUE(std::isnan(read(path, {.ignore_z = true}).lines[0].points[1][2]));
  EXPECT_EQ(read(path, {.z_field = "elev"}).lines[0].points[1][2], 7);
  EXPECT_TRUE(std::isnan(read(path, {.z_field = "empty"}).lines[0].points[1][2]));
  EXPECT_TRUE(contains(refuse(path, {.z_field = "name"}), "feature 0 has no number as its height"));
  EXPECT_TRUE(contains(refuse(path, {.z_field = "level"}), "no attribute 'level', only elev, name, empty"));
}

TEST_F(LineFiles, unknown_heights_lie_between_the_known_ones_of_their_line) {
  const auto heights = [&](const std::string& geometry) {
    const LineSet set = read(write("z.geojson", geojson({geometry})));
    std::vector<double> z;
    for (const auto& point : set.lines.at(0).points) z.push_back(point[2]);
    return std::pair{z, set.warnings};
  };
  const auto warns = [](const std::vector<std::string>& warnings, const char* words) {
    return std::any_of(warnings.begin(), warnings.end(), [&](const std::string& w) { return contains(w, words); });
  };
  const std::string one =
      "1 vertex without a height on lines that have heights lies between its neighbours: vertex 2 of ";
  auto [middle, warnings] = heights(R"({"type":"LineString","coordinates":[[0,0,4],[3,0,NaN],[4,0,8]]})");
  EXPECT_EQ(middle, (std::vector<double>{4, 7, 8}));
  EXPECT_TRUE(warns(warnings, one.c_str()));
  EXPECT_TRUE(warns(warnings, "feature 0"));
  std::tie(middle, warnings) =
      heights(R"({"type":"LineString","coordinates":[[0,0,NaN],[1,0,4],[2,0,NaN],[2,2,NaN],[3,2,8],[9,9,NaN]]})");
  EXPECT_EQ(middle, (std::vector<double>{4, 4, 5, 7, 8, 8}));
  EXPECT_TRUE(warns(
      warnings, "4 vertices without a height on lines that have heights lie between their neighbours: vertex 1 of"));
  std::tie(middle, warnings) =
      heights(R"({"type":"Polygon","coordinates":[[[0,0,NaN],[2,0,2],[2,2,NaN],[0,2,4],[0,0,NaN]]]})");
  EXPECT_EQ(middle, (std::vector<double>{3, 2, 3, 4, 3}));
  std::tie(middle, warnings) =
      heights(R"({"type":"Polygon","coordinates":[[[0,0,NaN],[2,0,2],[2,2,NaN],[0,2,NaN],[0,0,NaN]]]})");
  EXPECT_EQ(middle, (std::vector<double>(5, 2)));
  std::tie(middle, warnings) = heights(R"({"type":"LineString","coordinates":[[0,0,NaN],[3,0,NaN]]})");
  EXPECT_TRUE(std::isnan(middle[0]) && std::isnan(middle[1]));
  EXPECT_FALSE(warns(warnings, "without a height"));
}

TEST_F(LineFiles, rings_know_their_polygon) {
  const std::string multi =
      R"({"type":"MultiPolygon","coordinates":[[[[0,0],[1,0],[1,1],[0,0]]],[[[5,5],[6,5],[6,6],[5,5]]]]})";
  const LineSet set = read(write("a.geojson", geojson({kSquareWithHole, kPlain, multi})));
  ASSERT_EQ(set.lines.size(), 5u);
  EXPECT_EQ(set.polygons, 3u);
  const std::vector<LineRole> roles{LineRole::kOuter, LineRole::kHole, LineRole::kLine, LineRole::kOuter,
                                    LineRole::kOuter};
  const std::vector<std::uint32_t> polygons{0, 0, kNoPolygon, 1, 2};
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(set.lines[k].role, roles[k]);
    EXPECT_EQ(set.lines[k].polygon, polygons[k]);
    if (set.lines[k].is_ring()) {
      EXPECT_EQ(set.lines[k].points.front()[0], set.lines[k].points.back()[0]);
    }
  }
}

TEST_F(LineFiles, collections_and_curves_become_lines) {
  const LineSet set = read(write("a.csv",
                                 "id,WKT\n"
                                 "1,\"GEOMETRYCOLLECTION(POINT(1 1),LINESTRING(0 0,1 1),POLYGON((0 0,1 0,1 1,0 0)))\"\n"
                                 "2,\"CIRCULARSTRING(0 0,1 1,2 0)\"\n"
                                 "3,\"MULTILINESTRING((0 0,1 1),(2 2,3 3))\"\n"
                                 "4,\"CURVEPOLYGON(CIRCULARSTRING(0 0,4 0,4 4,0 4,0 0))\"\n"
                                 "5,\"TIN(((0 0 1,1 0 2,1 1 3,0 0 1)))\"\n"));
  ASSERT_EQ(set.lines.size(), 7u);
  const Line& arc = set.lines[2];
  EXPECT_GT(arc.points.size(), 40u);
  for (const auto& point : arc.points) EXPECT_NEAR(std::hypot(point[0] - 1, point[1]), 1, 1e-9);
  EXPECT_EQ(set.lines[5].role, LineRole::kOuter);
  EXPECT_GT(set.lines[5].points.size(), 80u);
  EXPECT_EQ(set.lines[6].points[2][2], 3);
  ASSERT_EQ(set.warnings.size(), 1u);
  EXPECT_TRUE(contains(set.warnings[0], "1 point of")) << set.warnings[0];
}

TEST_F(LineFiles, what_has_no_extent_is_left_out_and_counted) {
  const LineSet set =
      read(write("a.geojson", geojson({"null", R"({"type":"LineString","coordinates":[[1,2],[1,2]]})",
                                       R"({"type":"Polygon","coordinates":[[[1,2],[3,4],[1,2]]]})",
                                       R"({"type":"MultiPoint","coordinates":[[1,2],[3,4]]})", kPlain})));
  EXPECT_EQ(set.lines.size(), 1u);
  EXPECT_EQ(set.polygons, 0u);
  ASSERT_EQ(set.warnings.size(), 3u);
  EXPECT_TRUE(contains(set.warnings[0], "2 points of")) << set.warnings[0];
  EXPECT_TRUE(contains(set.warnings[1], "1 feature without geometry")) << set.warnings[1];
  EXPECT_TRUE(contains(set.warnings[2], "2 lines or rings of no extent")) << set.warnings[2];
}

TEST_F(LineFiles, coordinates_come_in_the_wanted_crs) {
  const std::string degrees = R"({"type":"LineString","coordinates":[[-117,34,5],[-116.9,34.1,6]]})";
  const std::string path = write("a.geojson", geojson({degrees}, "OGC:1.3:CRS84"));
  const LineSet same = read(path, {.crs = "EPSG:4326"});
  EXPECT_EQ(same.lines[0].points[0][0], -117);
  EXPECT_EQ(same.lines[0].points[0][1], 34);
  const LineSet utm = read(path, {.crs = "EPSG:32611"});
  EXPECT_NEAR(utm.lines[0].points[0][0], 500000, 1e-3);
  EXPECT_NEAR(utm.lines[0].points[0][1], 3762155.4, 1);
  EXPECT_EQ(utm.lines[0].points[1][2], 6);
  EXPECT_TRUE(contains(refuse(path, {.crs = "nonsense"}, ErrorKind::kUsage), "nonsense"));
  const std::string beyond = R"({"type":"LineString","coordinates":[[-117,34],[-117,95]]})";
  const std::string message =
      refuse(write("b.geojson", geojson({kPlain, beyond}, "OGC:1.3:CRS84")), {.crs = "EPSG:32611"});
  EXPECT_TRUE(contains(message, "feature 1") && contains(message, "-117, 95")) << message;
}

TEST_F(LineFiles, a_layer_without_crs_is_taken_to_be_where_it_is_wanted) {
  const std::string path = write("a.csv", "id,WKT\n1,\"LINESTRING(1 2,3 4)\"\n");
  const LineSet set = read(path, {.crs = "EPSG:32611"});
  EXPECT_EQ(set.lines[0].points[1][0], 3);
  ASSERT_EQ(set.warnings.size(), 1u);
  EXPECT_TRUE(contains(set.warnings[0], "has no CRS")) << set.warnings[0];
  EXPECT_TRUE(read(path).warnings.empty());
}

TEST_F(LineFiles, a_colon_names_the_layer) {
  std::filesystem::create_directory(scratch_.file("two"));
  write("two/roads.csv", "id,WKT\n1,\"LINESTRING(1 2,3 4)\"\n");
  write("two/shores.csv", "id,WKT\n7,\"LINESTRING(5 6,7 8)\"\n");
  const std::string folder = scratch_.file("two");
  EXPECT_EQ(read(folder + ":shores").lines[0].points[0][0], 5);
  EXPECT_TRUE(contains(read(folder + ":roads").lines[0].name, "two:roads feature 1"));
  EXPECT_TRUE(contains(refuse(folder + ":rivers"), "has no layer 'rivers' (found: "));
  EXPECT_TRUE(contains(refuse(folder), "holds several layers; name one"));
  const std::string with_colon = write("with:colon.geojson", geojson({kPlain}));
  EXPECT_EQ(read(with_colon).lines.size(), 1u);
}

TEST_F(LineFiles, what_cannot_be_used_is_refused_by_name) {
  EXPECT_TRUE(contains(refuse(scratch_.file("missing.gpkg")), "missing.gpkg: no such file"));
  EXPECT_TRUE(contains(refuse(scratch_.file("missing.gpkg:layer")), "no such file"));
  EXPECT_TRUE(contains(refuse(""), "empty"));
  EXPECT_TRUE(contains(refuse(write("empty.geojson", "")), "the file is empty"));
  EXPECT_TRUE(contains(refuse(write("text.txt", "no lines here")), "no vector data"));
  EXPECT_TRUE(contains(refuse(write("a.geojson", geojson({}))), "holds no lines or polygons"));
  EXPECT_TRUE(contains(refuse(write("b.geojson", geojson({R"({"type":"Point","coordinates":[1,2]})"}))),
                       "has no layer of lines or polygons"));
  EXPECT_TRUE(contains(refuse(write("c.csv", "id,WKT\n1,\"LINESTRING(1 2,3 4)\"\n2,\"LINESTRING(1 2,1e999 4)\"\n")),
                       "feature 2 has a vertex"));
}

TEST_F(LineFiles, reading_can_be_cancelled) {
  std::string text = "id,WKT\n";
  for (int k = 0; k < 70000; ++k) text += "1,\"LINESTRING(1 2,3 4)\"\n";
  ReadLinesOptions options;
  options.progress = [](const Progress&) { return false; };
  EXPECT_TRUE(contains(refuse(write("a.csv", text), options, ErrorKind::kCancelled), "cancelled"));
}

}  // namespace
}  // namespace scarp
