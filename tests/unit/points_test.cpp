// Points from files, and points without a surface.
#include "scarp/points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "grid/far_points.h"
#include "grid/snapped_points.h"
#include "laws/sanitized.h"
#include "scarp/io.h"
#include "scarp/measure.h"
#include "unit/raster_files.h"

namespace scarp {
namespace {

using testing::contains;

class PointFiles : public ::testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) {
    testing::write_text(scratch_.file(name), text);
    return scratch_.file(name);
  }
  PointSet read(const std::string& name, const std::string& text, const ReadPointsOptions& options = {}) {
    auto points = read_points(write(name, text), options);
    if (points) return std::move(*points);
    ADD_FAILURE() << points.error().message;
    return {};
  }
  /// Returns the one-line message, which must name the file.
  std::string refuse(const std::string& name, const std::string& text, const ReadPointsOptions& options = {}) {
    const std::string path = write(name, text);
    const auto points = read_points(path, options);
    if (points) {
      ADD_FAILURE() << "read: " << text;
      return {};
    }
    EXPECT_NE(points.error().message.find(path), std::string::npos) << points.error().message;
    EXPECT_EQ(points.error().message.find('\n'), std::string::npos) << points.error().message;
    return points.error().message;
  }
  testing::ScratchFolder scratch_;
};

const std::vector<double> kX{1, 2.5, -3}, kY{4, 5, 6e2}, kZ{7, 8.25, 9};

TEST_F(PointFiles, columns_may_be_separated_by_anything_usual) {
  for (const char* text :
       {"1,4,7\n2.5,5,8.25\n-3,6e2,9\n", "1;4;7\n2.5; 5 ;8.25\n-3;6e2;9", "1\t4\t7\n2.5\t5\t8.25\n-3\t6e2\t9\n",
        "  1 4   7\n2.5 \t5 8.25  \n-3 6e2 9 \n", "1,4,7\r\n2.5,5,8.25\r\n-3,6e2,9\r\n",
        "# survey of 1999\n\n1,4,7\n# half\n2.5,5,8.25\n\n-3,6e2,9\n",
        "\xef\xbb\xbf+1,4,7,a\n2.5,+5,8.25,b\n-3,6e2,9\n"}) {
    const PointSet points = read("p.csv", text);
    EXPECT_EQ(points.x, kX) << text;
    EXPECT_EQ(points.y, kY) << text;
    EXPECT_EQ(points.z, kZ) << text;
  }
}

TEST_F(PointFiles, a_header_names_the_columns_in_any_order) {
  for (const char* text : {"x,y,z\n1,4,7\n2.5,5,8.25\n-3,6e2,9\n", "id;\"Z\";Y;x\na;7;4;1\nb;8.25;5;2.5\nc;9;6e2;-3\n",
                           "h north East\n7 4 1\n8.25 5 2.5\n9 6e2 -3\n"}) {
    const PointSet points = read("p.csv", text);
    EXPECT_EQ(points.x, kX) << text;
    EXPECT_EQ(points.y, kY) << text;
    EXPECT_EQ(points.z, kZ) << text;
  }
  EXPECT_EQ(read("p.csv", "x,y,z,bed\n1,4,0,7\n2.5,5,0,8.25\n-3,6e2,0,9\n", {.z_field = "Bed"}).z, kZ);
}

TEST_F(PointFiles, text_that_holds_no_points_is_refused_by_line) {
  EXPECT_TRUE(contains(refuse("p.csv", ""), "empty"));
  EXPECT_TRUE(contains(refuse("p.csv", "# nothing\n\n"), "no points"));
  EXPECT_TRUE(contains(refuse("p.csv", "x,y,z\n"), "no points"));
  EXPECT_TRUE(contains(refuse("p.csv", "x,y,depth\n1,2,3\n"), "names no column z"));
  EXPECT_TRUE(contains(refuse("p.csv", "1,2,3\n", {.z_field = "bed"}), "no column 'bed'"));
  EXPECT_TRUE(contains(refuse("p.csv", "x,y,z\n1,2,3\n1,2,3\n", {.z_field = "bed"}), "names no column z"));
  EXPECT_TRUE(contains(refuse("p.csv", "1,2,3\n\n4,5\n"), "line 3 has 2 columns"));
  EXPECT_TRUE(contains(refuse("p.csv", "1,2,3\n4,5,x6\n"), "line 2: z is 'x6'"));
  EXPECT_TRUE(contains(refuse("p.csv", "1,2,3\n4,,6\n"), "line 2: y is empty"));
  EXPECT_TRUE(contains(refuse("p.csv", "1,2,3\n4,nan,6\n"), "line 2: y is 'nan', which is no finite number"));
  EXPECT_TRUE(contains(refuse("p.csv", "1,2,3\n-inf,5,6\n"), "no finite number"));
  EXPECT_TRUE(contains(refuse("p.csv", "1,2,3\n4,5,1e999\n"), "no finite number"));
  EXPECT_TRUE(contains(refuse("p.csv", "1,2,3\n", {.crs = "EPSG:32611"}), "CRS"));
  EXPECT_TRUE(contains(refuse("p.csv", "1,2,3\n", {.layer = "a"}), "layer"));
  EXPECT_TRUE(contains(read_points(scratch_.file("none.csv")).error().message, "no such file"));
  EXPECT_TRUE(contains(read_points(scratch_.file("none.gpkg")).error().message, "no such file"));
}

TEST_F(PointFiles, decimal_commas_are_read_where_commas_do_not_separate) {
  for (const char* text : {"1,5;2,25;3\n", "1,5\t2,25\t3\n", "1,5 2,25 3\n", "x;y;z\n1.5;2,25;+3\n"}) {
    const PointSet points = read("p.csv", text);
    EXPECT_EQ(points.x, std::vector<double>{1.5}) << text;
    EXPECT_EQ(points.y, std::vector<double>{2.25}) << text;
    EXPECT_EQ(points.z, std::vector<double>{3}) << text;
  }
  EXPECT_TRUE(contains(refuse("p.csv", "1,2,3\n4,5 6\n"), "line 2: '4,5' has a decimal comma"));
  EXPECT_TRUE(contains(refuse("p.csv", "1;2;3\n1.000,5;2;3\n"), "line 2: x is '1.000,5', which is no number"));
  EXPECT_TRUE(contains(refuse("p.csv", "1,2,3\n4,5\n"), "line 2 has 2 columns"));
}

TEST_F(PointFiles, values_too_small_for_a_double_are_zero) {
  const std::string tiny = "0." + std::string(400, '0') + "1", huge = "1" + std::string(400, '0');
  EXPECT_EQ(
      read("p.csv", "1e-400,-2E-999999999999999999999," + tiny + "\n" + huge + "e-400,1e-320," + tiny + "e401\n").x,
      (std::vector<double>{0, 1}));
  EXPECT_EQ(read("p.csv", "1,1e-320,-1e-400\n").y, (std::vector<double>{1e-320}));
  for (const std::string& text :
       {std::string("1e400"), huge, std::string("1e+999999999999999999999"), tiny + "e999", std::string("-1e400")})
    EXPECT_TRUE(contains(refuse("p.csv", "1,2," + text + "\n"), "no finite number")) << text;
}

TEST_F(PointFiles, names_tell_points_from_rasters) {
  for (const char* name : {"a.csv", "a.XYZ", "a.geojson", "a.shp", "a.tsv"}) EXPECT_TRUE(is_point_file(name)) << name;
  for (const char* name : {"a.tif", "a.pgm", "a", "a.asc", "csv"}) EXPECT_FALSE(is_point_file(name)) << name;
  EXPECT_TRUE(is_point_file(write("a.txt", "1 2 3\n")));
  EXPECT_FALSE(is_point_file(write("b.txt", "NCOLS 3\nnrows 3\n")));
}

std::string geojson(const std::string& features) {
  return R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:EPSG::32611"}},)"
         R"("features":[)" +
         features + "]}";
}
std::string feature(const std::string& type, const std::string& coordinates, const std::string& properties = "") {
  return R"({"type":"Feature","properties":{)" + properties + R"(},"geometry":{"type":")" + type +
         R"(","coordinates":)" + coordinates + "}}";
}

TEST_F(PointFiles, vector_layers_are_read_through_gdal) {
  const std::string three = feature("Point", "[1,4,7]") + "," + feature("MultiPoint", "[[2.5,5,8.25],[-3,600,9]]");
  const PointSet points = read("p.geojson", geojson(three));
  EXPECT_EQ(points.x, kX);
  EXPECT_EQ(points.y, kY);
  EXPECT_EQ(points.z, kZ);
  EXPECT_EQ(points.crs, "EPSG:32611");
  EXPECT_EQ(points.format, "GeoJSON");
  const std::string flat =
      feature("Point", "[1,4]", R"("elev":7,"bed":1)") + "," + feature("Point", "[2.5,5]", R"("elev":8.25,"bed":2)");
  EXPECT_EQ(read("p.geojson", geojson(flat)).z, (std::vector<double>{7, 8.25}));
  EXPECT_EQ(read("p.geojson", geojson(flat), {.z_field = "bed"}).z, (std::vector<double>{1, 2}));
}

TEST_F(PointFiles, vector_layers_without_heights_or_points_are_refused) {
  const std::string point = feature("Point", "[1,4,7]");
  EXPECT_TRUE(contains(refuse("p.geojson", geojson(feature("Point", "[1,4]"))), "--z-field"));
  EXPECT_TRUE(contains(refuse("p.geojson", geojson(point), {.z_field = "bed"}), "no attribute 'bed'"));
  EXPECT_TRUE(contains(refuse("p.geojson", geojson(point), {.layer = "roads"}), "no layer 'roads'"));
  EXPECT_TRUE(
      contains(refuse("p.geojson", geojson(point + "," + feature("Polygon", "[[[1,2,3],[4,5,6],[4,2,1],[1,2,3]]]"))),
               "not a point"));
  EXPECT_TRUE(contains(refuse("p.geojson", geojson(feature("Point", "[1,4]", R"("z":1)") + "," +
                                                   feature("Point", "[1,5]", R"("z":null)"))),
                       "no height"));
  EXPECT_TRUE(contains(refuse("p.geojson", "{}"), "p.geojson"));
  EXPECT_TRUE(contains(refuse("p.geojson", geojson(point), {.crs = "grid"}), "no grid"));
  EXPECT_EQ(read_points(write("p.geojson", geojson(point)), {.crs = "EPSG:0"}).error().kind, ErrorKind::kUsage);
}

TEST_F(PointFiles, degrees_become_metres_around_the_middle) {
  testing::write_text(scratch_.file("p.geojson"), R"({"type":"FeatureCollection","features":[)" +
                                                      feature("Point", "[10,45,7]") + "," +
                                                      feature("Point", "[10.002,45.002,8]") + "]}");
  const auto points = *read_points(scratch_.file("p.geojson"));
  EXPECT_NEAR(points.x[1] - points.x[0], 157.7, 0.1);
  EXPECT_NEAR(points.y[1] - points.y[0], 222.3, 0.1);
  EXPECT_NEAR(points.x[1] + points.x[0], 0, 1e-6);
  EXPECT_TRUE(contains(points.description, "local metres")) << points.description;
  const auto utm = *read_points(scratch_.file("p.geojson"), {.crs = "EPSG:32632"});
  EXPECT_EQ(utm.crs, "EPSG:32632");
  EXPECT_NEAR(utm.x[0], 578815, 1);
  const auto degrees = *read_points(scratch_.file("p.geojson"), {.crs = "source"});
  EXPECT_EQ(degrees.x, (std::vector<double>{10, 10.002}));
  EXPECT_FALSE(degrees.warnings.empty());
}

PointSet set_of(std::vector<std::array<double, 3>> list) {
  PointSet points;
  for (const auto& [x, y, z] : list) {
    points.x.push_back(x);
    points.y.push_back(y);
    points.z.push_back(z);
  }
  return points;
}

TEST(point_sets, without_area_have_no_surface) {
  const PointOptions options{.max_error = 1.0};
  const auto message = [&](const PointSet& points) {
    const auto result = simplify_points(points, options);
    EXPECT_FALSE(result);
    return result ? std::string() : result.error().message;
  };
  EXPECT_TRUE(contains(message({}), "no points"));
  EXPECT_TRUE(contains(message(set_of({{1, 1, 1}, {1, 1, 2}})), "one place"));
  const double undecimal = 0.1 + 0.2;
  EXPECT_TRUE(contains(message(set_of({{undecimal, 1, 1}, {undecimal, 1, 2}})), "one place"));
  EXPECT_TRUE(contains(message(set_of({{1, 1, 1}, {2, 1, 2}, {1, 1, 5}})), "two places"));
  EXPECT_TRUE(contains(message(set_of({{1, 1, 1}, {2, 2, 2}, {7, 7, 5}, {3, 3, 9}})), "one line"));
  EXPECT_TRUE(contains(message(set_of({{0.1, 1, 1}, {0.2, 1, 2}, {1 / 3.0, 1, 5}})), "one line"));
  EXPECT_TRUE(contains(message(set_of({{0, 0, 1}, {1, NAN, 2}, {0, 1, 5}})), "point 1"));
  EXPECT_TRUE(contains(message(set_of({{0, 0, 1}, {1, 0, 2}, {0, 1, 1e200}})), "1e100"));
}

TEST(point_sets, need_a_goal_that_makes_sense) {
  const PointSet points = set_of({{0, 0, 1}, {1, 0, 2}, {0, 1, 5}});
  EXPECT_TRUE(simplify_points(points, {.max_error = 1.0}));
  EXPECT_EQ(simplify_points(points, {}).error().kind, ErrorKind::kUsage);
  EXPECT_EQ(simplify_points(points, {.max_error = -1.0}).error().kind, ErrorKind::kUsage);
}

TEST(point_sets, wider_than_float32_need_double_positions) {
  const PointSet points = set_of({{0, 0, 1}, {1e99, 0, 2}, {0, 1e99, 3}});
  PointOptions options{.max_error = 1.0};
  EXPECT_EQ(simplify_points(points, options).error().kind, ErrorKind::kPromise);
  options.float32_positions = false;
  EXPECT_TRUE(simplify_points(points, options));
}

TEST(point_sets, give_up_duplicates_by_the_policy) {
  const PointSet points = set_of({{0, 0, 3}, {4, 0, 0}, {0, 0, 9}, {0, 4, 0}, {0, 0, 1}, {0, 0, 2}});
  const std::pair<DuplicatePolicy, double> kept[] = {{DuplicatePolicy::kFirst, 3},
                                                     {DuplicatePolicy::kLast, 2},
                                                     {DuplicatePolicy::kHighest, 9},
                                                     {DuplicatePolicy::kLowest, 1},
                                                     {DuplicatePolicy::kMean, 3.75}};
  for (const auto& [policy, z] : kept) {
    const auto result = *simplify_points(points, {.max_error = 0.0, .duplicates = policy});
    EXPECT_EQ(result.duplicates, 3u);
    EXPECT_EQ(result.simplified.measurement.samples, 3u);
    EXPECT_EQ(result.simplified.measurement.max_error, 0);
    const Mesh& mesh = result.simplified.mesh;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
      const auto [x, y, height] = mesh.vertex(v);
      EXPECT_EQ(height, x + y == 0 ? z : 0);
    }
  }
}

TEST(point_sets, give_up_duplicates_that_share_the_lattice_point_of_another) {
  const PointSet points =
      set_of({{0, 0, 0}, {1e9, 0, 1}, {0, 1e9, 2}, {4, 4, 900}, {4, 4, 100}, {8, 4.25, -900}, {4, 4, 200}});
  const auto made = simplify_points(points, {.max_error = 2000, .duplicates = DuplicatePolicy::kLowest});
  ASSERT_TRUE(made) << made.error().message;
  const SimplifiedPoints& result = *made;
  EXPECT_EQ(result.duplicates, 2u);
  EXPECT_EQ(result.simplified.measurement.samples, 5u);
  const auto judged = *measure_points(points, result.simplified.mesh, DuplicatePolicy::kLowest);
  EXPECT_EQ(judged.samples, 5u);
  EXPECT_EQ(judged.max_error, result.simplified.measurement.max_error);
}

TEST(point_sets, sorted_along_the_curve_keep_their_lines_and_duplicates) {
  PointSet points = set_of({{9, 0, 1}, {0, 9, 2}, {0, 0, 3}, {9, 9, 4}, {0, 9, 5}, {1, 9, 6}});
  points.lines.emplace_back().points = {0, 3, 1};
  points.boundary = {{2, 0, 3}};
  sort_points(points);
  const auto at = [&](std::uint32_t i) { return std::tuple(points.x[i], points.y[i], points.z[i]); };
  EXPECT_EQ(at(0), std::tuple(0.0, 0.0, 3.0));
  const std::vector<std::uint32_t>& line = points.lines[0].points;
  EXPECT_EQ(at(line[0]), std::tuple(9.0, 0.0, 1.0));
  EXPECT_EQ(at(line[1]), std::tuple(9.0, 9.0, 4.0));
  EXPECT_EQ(at(line[2]), std::tuple(0.0, 9.0, 2.0));
  EXPECT_EQ(at(line[2] + 1), std::tuple(0.0, 9.0, 5.0));
  EXPECT_EQ(at(points.boundary[0][0]), std::tuple(0.0, 0.0, 3.0));
}

TEST(point_sets, omitted_sorted_and_joined_points_keep_their_tolerances) {
  PointSet points = set_of({{9, 0, 1}, {0, 9, 2}, {0, 0, 3}, {9, 9, 4}, {5, 5, 5}});
  points.tolerances = {1, 2, 3, 4};
  const auto bounds = [&] {
    std::map<double, float> of_heights;
    for (std::size_t i = 0; i < points.tolerances.size(); ++i) of_heights[points.z[i]] = points.tolerances[i];
    return of_heights;
  };
  Line corner;
  corner.points = {{-1, 8, 0}, {1, 8, 0}, {1, 11, 0}, {-1, 8, 0}};
  corner.role = LineRole::kOuter;
  EXPECT_EQ(drop_inside(std::vector{corner}, points), 1u);
  EXPECT_EQ(bounds(), (std::map<double, float>{{1, 1}, {3, 3}, {4, 4}}));
  const float none = std::numeric_limits<float>::infinity();
  sort_points(points);
  EXPECT_EQ(bounds(), (std::map<double, float>{{1, 1}, {3, 3}, {4, 4}, {5, none}}));
  PointSet more = set_of({{1, 1, 6}, {2, 2, 7}});
  ASSERT_TRUE(append_points(more, points));
  EXPECT_EQ(points.tolerances.size(), 4u);
  more.z = {8, 9};
  more.tolerances = {8};
  ASSERT_TRUE(append_points(more, points));
  EXPECT_EQ(bounds(), (std::map<double, float>{{1, 1}, {3, 3}, {4, 4}, {5, none}, {6, none}, {7, none}, {8, 8}}));
}

TEST(point_sets, too_near_for_their_extent_are_named_and_not_merged) {
  const PointSet wide =
      set_of({{0, 0, 0}, {1e9, 0, 1}, {0, 1e9, 2}, {0.001, 0.001, 900}, {0.002, 0.001, -900}, {0, 0, 5}});
  const auto check = [](const Error& error) {
    EXPECT_EQ(error.kind, ErrorKind::kInput);
    EXPECT_TRUE(contains(error.message, "the points at (0, 0) and (0.001, 0.001)"));
    EXPECT_TRUE(contains(error.message,
                         "the extent of 1000000000; the point at (1000000000, 0) and 1 "
                         "more lie far from all others, which span 0.002"))
        << error.message;
  };
  check(simplify_points(wide, {.max_error = 0.5}).error());
  const PointSet apart = set_of({{0, 0, 0}, {1e9, 0, 1}, {0, 1e9, 2}, {4, 4, 900}, {8, 4.25, -900}, {0, 0, 5}});
  const auto result = simplify_points(apart, {.max_error = 0.0, .float32_positions = false});
  ASSERT_TRUE(result) << result.error().message;
  EXPECT_EQ(result->duplicates, 1u);
  EXPECT_EQ(result->simplified.measurement.samples, 5u);
}

TEST(point_sets, refuse_a_floor_of_shapes_that_they_cannot_keep) {
  const PointSet points = set_of({{0, 0, 1}, {1, 0, 2}, {0, 1, 5}});
  for (const auto& [effort, floor] : {std::pair{Effort::kFast, 0.1}, std::pair{Effort::kNormal, 0.6}}) {
    const auto result = simplify_points(points, {.max_error = 1, .quality = {.effort = effort, .min_shape = floor}});
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().kind, ErrorKind::kUsage);
  }
}

TEST(point_sets, too_small_for_arithmetic_are_refused) {
  const auto tiny = simplify_points(set_of({{0, 0, 1}, {1e-320, 0, 2}, {0, 1e-320, 3}}), {.max_error = 0.5});
  EXPECT_TRUE(contains(tiny.error().message, "smaller unit")) << tiny.error().message;
  EXPECT_TRUE(simplify_points(set_of({{0, 0, 1}, {1e-99, 0, 2}, {0, 1e-99, 3}}),
                              {.max_error = 0.5, .float32_positions = false}));
}

TEST(point_sets, name_the_few_points_that_lie_far_from_all_others) {
  PointSet points;
  for (int i = 0; i < 400; ++i) {
    points.x.push_back(500000 + i % 20);
    points.y.push_back(4649000 + i / 20);
    points.z.push_back(i % 7);
  }
  EXPECT_EQ(grid::describe_far_points(points), "");
  const auto add = [&](double x, double y) {
    points.x.push_back(x);
    points.y.push_back(y);
    points.z.push_back(0);
  };
  add(500100, 4649100);
  EXPECT_EQ(grid::describe_far_points(points), "") << "not so far";
  add(0, 0);
  EXPECT_EQ(grid::describe_far_points(points),
            "the point at (0, 0) lies far from all others, which span 100: remove it if it is an "
            "error");
  add(5e5, -9999999999);
  EXPECT_TRUE(contains(grid::describe_far_points(points), "the point at (0, 0) and 1 more lie far"));
  for (int i = 0; i < 5; ++i) add(0, i);
  EXPECT_EQ(grid::describe_far_points(points), "") << "too many for errors";
  EXPECT_EQ(grid::describe_far_points({}), "");
  EXPECT_EQ(grid::describe_far_points(set_of({{7, 7, 1}})), "");
}

TEST(point_sets, the_lattice_is_the_coarsest_that_holds_the_decimals) {
  const auto step = [](std::vector<std::array<double, 3>> list) {
    return grid::snap_points(set_of(std::move(list)), DuplicatePolicy::kFirst)->lattice.step;
  };
  EXPECT_EQ(step({{0.1, 0, 0}, {0.25, 4, 0}}), 0.05);
  EXPECT_EQ(step({{500015, 4000000, 0}, {500045, 4000090, 0}}), 30);
  EXPECT_EQ(step({{1e15, 0, 0}, {3e15, 0, 0}}), 2e15);
  const double third = step({{1 / 3.0, 0, 0}, {1, 2 / 7.0, 0}});
  EXPECT_EQ(std::log2(third), std::floor(std::log2(third)));
  EXPECT_LT(third, 2e-9);
}

TEST(point_sets, whose_hull_bends_by_less_than_float32_tells_apart_keep_their_bound) {
  PointSet points;
  for (int row = 0; row < 60; ++row) {
    for (int col = 0; col < 200; ++col) {
      const double x = col * 90.0 + row * 1e-4, bend = 1e-9 * (x - 9000) * (x - 9000);
      points.x.push_back(500000 + x + 1e-10 * row * row);
      points.y.push_back(4e6 + row * 90.0 + (row < 30 ? bend : -bend));
      points.z.push_back(40 * std::sin(0.2 * col) * std::cos(0.3 * row) + (col * 7 + row * 13) % 11);
    }
  }
  for (const auto& [float32, effort] : {std::pair{true, Effort::kFast}, std::pair{false, Effort::kFast},
                                        std::pair{true, Effort::kHigh}, std::pair{false, Effort::kHigh}}) {
    if (testing::kIsSanitized && float32 == (effort == Effort::kHigh)) continue;
    const auto result =
        simplify_points(points, {.max_error = 2.0, .float32_positions = float32, .quality = {.effort = effort}});
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_GT(result->on_hull, effort == Effort::kFast ? 100u : 50u);
    const auto judged = *measure_points(points, result->simplified.mesh, DuplicatePolicy::kFirst);
    EXPECT_LE(judged.max_error, 2.0 + 1e-10);
    EXPECT_TRUE(judged.is_sound());
    EXPECT_EQ(judged.uncovered, 0u);
  }
}

TEST(point_sets, of_many_decimals_take_as_few_triangles_as_those_of_few) {
  std::map<int, std::size_t> triangles;
  for (const int decimals : {2, 7}) {
    PointSet points;
    for (int i = 0; i < 2000; ++i) {
      const double x = std::fmod(i * 0.6180339887498949, 1) * 400, y = std::fmod(i * 0.7548776662466927, 1) * 300;
      const auto rounded = [&](double value) {
        return std::nearbyint(value * std::pow(10, decimals)) / std::pow(10, decimals);
      };
      points.x.push_back(rounded(x));
      points.y.push_back(rounded(y));
      points.z.push_back(20 * std::sin(0.05 * x) * std::cos(0.04 * y));
    }
    PointOptions options{.max_error = 0.5, .float32_positions = false};
    options.quality.effort = Effort::kHigh;
    const auto result = simplify_points(points, options);
    ASSERT_TRUE(result) << result.error().message;
    EXPECT_LE(measure_points(points, result->simplified.mesh, DuplicatePolicy::kFirst)->max_error, 0.5 + 1e-10);
    triangles[decimals] = result->simplified.mesh.triangle_count();
  }
  EXPECT_NEAR(static_cast<double>(triangles[7]), static_cast<double>(triangles[2]),
              0.1 * static_cast<double>(triangles[2]));
}

TEST(point_judge, sees_a_missing_triangle_and_a_moved_vertex) {
  PointSet points;
  for (int i = 0; i < 100; ++i) {
    points.x.push_back(i % 10);
    points.y.push_back(i / 10);
    points.z.push_back((i * 37) % 17);
  }
  auto result = *simplify_points(points, {.max_error = 0.0});
  Mesh& mesh = result.simplified.mesh;
  const auto whole = *measure_points(points, mesh, DuplicatePolicy::kFirst);
  EXPECT_EQ(whole.max_error, 0);
  EXPECT_EQ(whole.samples, 100u);
  Mesh moved = mesh;
  moved.positions[2] += 0.5;
  const auto off = *measure_points(points, moved, DuplicatePolicy::kFirst, {.collect_above = 0.25});
  EXPECT_EQ(off.max_error, 0.5);
  EXPECT_TRUE(std::any_of(off.offenders.begin(), off.offenders.end(),
                          [&](const Offender& o) { return o.col == off.max_error_at[0] && o.error == 0.5; }));
  EXPECT_EQ(points.x[static_cast<std::size_t>(off.max_error_at[0])], moved.vertex(0)[0]);
  Mesh torn = mesh;
  torn.triangles.resize(torn.triangles.size() - 3);
  const auto hole = *measure_points(points, torn, DuplicatePolicy::kFirst);
  EXPECT_FALSE(hole.is_sound());
  EXPECT_GT(hole.gaps, 0u);
  Mesh half = mesh;
  half.triangles.resize(half.triangles.size() / 2);
  EXPECT_GT(measure_points(points, half, DuplicatePolicy::kFirst)->uncovered, 0u);
}

TEST(point_judge, takes_the_upper_side_of_a_solid) {
  const PointSet points = set_of({{0, 0, 1}, {4, 0, 2}, {0, 4, 5}, {4, 4, 3}, {2, 1, 9}});
  auto result = *simplify_points(points, {.max_error = 0.0});
  ASSERT_TRUE(add_base(result.simplified.mesh, -1));
  const auto judged = *measure_points(points, result.simplified.mesh, DuplicatePolicy::kFirst);
  EXPECT_TRUE(judged.closed);
  EXPECT_TRUE(judged.is_sound());
  EXPECT_EQ(judged.max_error, 0);
}

}  // namespace
}  // namespace scarp
