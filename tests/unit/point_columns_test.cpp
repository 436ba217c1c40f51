// The meaning of text columns.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/io.h"
#include "unit/raster_files.h"

namespace scarp::point_columns_test {
namespace {

using testing::contains;

/// Three points of a survey: easting, northing, height.
const std::vector<double> kEast{500042.82, 500050.5, 500061.25}, kNorth{4000238.78, 4000240.5, 4000251.75},
    kHeight{87.39, 88.5, 91.25};

class PointColumns : public ::testing::Test {
 protected:
  Result<PointSet> try_to_read(const std::string& text, const std::string& columns = "") {
    testing::write_text(scratch_.file("p.csv"), text);
    return read_points(scratch_.file("p.csv"), {.columns = columns});
  }
  PointSet read(const std::string& text, const std::string& columns = "") {
    auto points = try_to_read(text, columns);
    if (points) return std::move(*points);
    ADD_FAILURE() << points.error().message << "\n" << text;
    return {};
  }
  /// Returns the only message.
  std::string refuse(const std::string& text, const std::string& columns = "") {
    const auto points = try_to_read(text, columns);
    if (points) {
      ADD_FAILURE() << "read: " << text << points->columns;
      return {};
    }
    EXPECT_EQ(points.error().message.find('\n'), std::string::npos);
    return points.error().message;
  }
  void expect_survey(const std::string& text, const std::string& columns = "") {
    const PointSet points = read(text, columns);
    EXPECT_EQ(points.x, kEast) << text;
    EXPECT_EQ(points.y, kNorth) << text;
    EXPECT_EQ(points.z, kHeight) << text;
    EXPECT_FALSE(points.columns.empty()) << text;
  }
  testing::ScratchFolder scratch_;
};

/// Lines of the survey by a pattern: n, N, E and H mean number, northing, easting and height, @ a name.
std::string survey(const std::string& pattern, const std::string& header = "", int first = 1, int step = 1) {
  std::string text = header;
  for (std::size_t k = 0; k < kEast.size(); ++k) {
    for (const char c : pattern) {
      const auto number = [&](double value) {
        std::string digits = fmt::format("{}", value);
        if (pattern.find(';') != std::string::npos) digits.replace(digits.find('.'), 1, ",");
        return digits;
      };
      const int count = first + step * static_cast<int>(k);
      text += c == 'N'   ? number(kNorth[k])
              : c == 'E' ? number(kEast[k])
              : c == 'H' ? number(kHeight[k])
              : c == 'n' ? fmt::format("{}", count)
              : c == '@' ? fmt::format("BM{}", count)
                         : std::string(1, c);
    }
    text += '\n';
  }
  return text;
}

TEST_F(PointColumns, a_first_column_that_counts_is_a_number) {
  for (const char* pattern :
       {"n,N,E,H", "n,N,E,H,tree", "n,E,N,H", "n N E H", "n\tN\tE\tH\ttop of kerb", "n;N;E;H;tree", "@,N,E,H",
        "@ E N H", "@;N;E;H;x", "n,tree,E,N,H", "n,N,E,H,", "\"n\",N,E,H,\"a, b\""})
    expect_survey(survey(pattern));
  for (const int step : {1, 5, -1, 100}) {
    expect_survey(survey("n,N,E,H", "", 1001, step));
    expect_survey(survey("n,E,N,H", "\xef\xbb\xbf# of May\n\n", 1001, step));
  }
  EXPECT_TRUE(contains(read(survey("n,N,E,H")).columns, "1 not read, 2 y, 3 x, 4 height"));
  EXPECT_TRUE(contains(read(survey("n,N,E,H")).warnings.at(0), "--columns penz"));
}

TEST_F(PointColumns, northing_and_easting_that_look_alike_are_asked_for) {
  const std::string local = "1,1000.5,2000.25,87.3\n2,1010.5,2003.25,88.4\n3,1001.5,2013.25,89.1\n";
  EXPECT_TRUE(
      contains(refuse(local), "which of the columns 2 and 3 is the easting: give --columns penz or --columns pnez"));
  EXPECT_EQ(read(local, "pnez").y, (std::vector<double>{1000.5, 1010.5, 1001.5}));
  EXPECT_EQ(read(local, "penz").x, (std::vector<double>{1000.5, 1010.5, 1001.5}));
  const std::string gauss_krueger = "P1;5401234,5;3501234,25;87,3\nP2;5401240,5;3501244,25;87,5\n";
  EXPECT_TRUE(contains(refuse(gauss_krueger), "--columns"));
  EXPECT_EQ(read(gauss_krueger, "number,northing,easting,height").x, (std::vector<double>{3501234.25, 3501244.25}));
  // Three columns are x, y, z, unless the first is as large as a northing.
  EXPECT_EQ(read("1,2,3\n4,5,6\n").x, (std::vector<double>{1, 4}));
  EXPECT_TRUE(contains(refuse(survey("N,E,H")), "--columns enz or --columns nez"));
  expect_survey(survey("N,E,H"), "nez");
  expect_survey(survey("E,N,H"));
}

TEST_F(PointColumns, what_cannot_be_a_height_is_asked_for) {
  EXPECT_TRUE(contains(refuse(survey("n,N,E")), "column 3 would be the height"));
  EXPECT_TRUE(
      contains(refuse("1700000000.5,500042.8,4000238.7,87.3\n1700000001.5,500045.8,4000239.7,87.4\n"), "--columns"));
  expect_survey(survey("12:00:00,E,N,H"));  // times
  expect_survey(survey("2024-05-01 12:00:00;N;E;H"));
}

TEST_F(PointColumns, what_is_less_like_a_height_than_a_later_column_is_asked_about) {
  for (const auto& [text, option] : {std::pair{survey("n,E,N,n,H"), "--columns pen-z or --columns penz"},
                                     {survey("E,N,n,H"), "--columns en-z or --columns enz"},
                                     {survey("n,E,N,0,H"), "--columns pen-z"},
                                     {survey("n,N,E,72,H"), "--columns pne-z"},
                                     {survey("n,E,N,0.012,0.013,H,0.02"), "--columns pen--z"},
                                     {survey("118 35 44 E N H"), "--columns ---enz"},
                                     {survey("n,48,E,N,H"), "--columns --enz"}})
    EXPECT_TRUE(contains(refuse(text), option)) << text << refuse(text);
  const std::string whole = "500042.8,4000238.7,0,87\n500045.8,4000239.7,0,88\n500049.8,4000249.7,0,91\n";
  EXPECT_TRUE(contains(read(whole).warnings.at(0), "column 3 would be the height and is 0 everywhere"));
  // Extra columns of scanners, and grids of integers.
  for (const char* silent :
       {"1.5,2.5,7.25,251,2,1,1\n2.75,3.5,8.5,66,2,1,1\n3.5,1.5,8,59,2,1,1\n",
        "10 20 812 0.5\n20 20 815 12.5\n10 10 813 0.7\n", "1.5 2.5 3 0.1 0.2 0.97\n2.5 3.5 4 0.1 0.3 0.9\n"})
    EXPECT_TRUE(read(silent).warnings.empty()) << silent;
}

TEST_F(PointColumns, x_may_be_the_northing_of_a_national_grid) {
  const auto text = [](const char* header, const char* format, double one, double other) {
    std::string rows = header;
    for (int k = 0; k < 5; ++k)
      rows += fmt::format(fmt::runtime(format), k + 1, one + 7.5 * k * k, other + 9.25 * k, 80.5 + k);
    return rows;
  };
  const std::vector<std::array<double, 2>> north_east{
      {5400192.3, 3500187.5}, {5400192.3, 4500187.5}, {5650192.3, 5400187.5}, {5260192.3, -22812.5},
      {5560192.3, 7500187.5}, {4000238.7, 500042.8},  {1200192.3, 2600187.5}};
  for (const auto& [north, east] : north_east) {
    EXPECT_TRUE(contains(refuse(text("", "{1},{2},{3}\n", north, east)), "--columns nez")) << north;
    EXPECT_TRUE(read(text("", "{1},{2},{3}\n", east, north)).warnings.empty()) << north;
    const PointSet turned = read(text("Nr,X,Y,H\n", "{0},{1},{2},{3}\n", north, east));
    ASSERT_FALSE(turned.warnings.empty()) << north;
    EXPECT_TRUE(contains(turned.warnings.at(0), "if x is the northing here")) << north;
    EXPECT_TRUE(read(text("Nr,X (m),Y (m),H\n", "{0},{1},{2},{3}\n", east, north)).warnings.empty()) << north;
  }
  // State planes in feet.
  EXPECT_TRUE(read(text("id,x,y,z\n", "{0},{1},{2},{3}\n", 6500187.5, 1900192.3)).warnings.empty());
  EXPECT_TRUE(
      contains(refuse(text("", "{0},{1},{2},{3}\n", 2200378.8, 6000153.5)), "--columns penz or --columns pnez"));
}

TEST_F(PointColumns, headers_name_units) {
  const auto unit = [&](const std::string& header) { return read(survey("n,E,N,H", header + "\n")).heights.unit; };
  EXPECT_EQ(unit("id,E,N,Elevation (ft)"), "ft");
  EXPECT_EQ(unit("id,E,N,elev_ft"), "ft");
  EXPECT_EQ(unit("id,E,N,Elevation in feet"), "feet");
  EXPECT_EQ(unit("id,E,N,ELEVFT"), "ft");
  EXPECT_EQ(unit("id,E,N,Elevation [mm]"), "mm");
  EXPECT_EQ(unit("id,E,N,Height (US survey feet)"), "us survey feet");
  EXPECT_EQ(unit("id,E,N,elev_us_ft"), "us ft");
  EXPECT_EQ(unit("id,E,N,H (m above sea)"), "m");
  EXPECT_EQ(unit("id,E,N,elevation"), "");
  const PointSet feet = read(survey("n,E,N,H", "id,Easting (ft),Northing (ft),Elev (ft)\n"));
  EXPECT_EQ(feet.unit_in_metres, 0.3048);
  EXPECT_EQ(feet.z, kHeight);
  const auto metres =
      read_points(scratch_.file("p.csv"), {.heights_in = HeightsIn::kMetres, .default_frame = DefaultFrame::kLocal});
  ASSERT_TRUE(metres);
  EXPECT_DOUBLE_EQ(metres->z[0], kHeight[0] * 0.3048);
  EXPECT_NEAR(metres->x[1] - metres->x[0], (kEast[1] - kEast[0]) * 0.3048, 1e-9);
  EXPECT_EQ(metres->heights.unit, "m");
}

TEST_F(PointColumns, texts_of_another_kind_are_refused_in_a_sentence) {
  EXPECT_TRUE(contains(refuse(survey("n,E,N,H", "Job: 17\nDate: 2024-05-01\nPoint,Easting,Northing,Elevation\n")),
                       "put # in front of all lines up to 2 that do not (sed '1,2s/^/#/' "));
  EXPECT_TRUE(contains(refuse(survey("n,E,N,H", "Job: 17\n")), "sed '1,1s/^/#/' "));
  EXPECT_TRUE(
      contains(refuse("1,4000378,862,500153,546,448,187\n2,4000384,695,500285,139,407,530\n"), "decimal comma"));
  EXPECT_TRUE(contains(refuse("no,N,E,H\n1,4000378,862,500153,546,448,187\n2,4000384,695,500285,139,407,530\n"),
                       "decimal comma"));
  EXPECT_TRUE(read("500153,4000378,448,118,135,144\n500285,4000384,407,138,119,160\n").warnings.empty());
  std::string wide = "\xff\xfe";
  for (const char c : survey("E,N,H")) (wide += c) += '\0';
  EXPECT_TRUE(contains(refuse(wide), "UTF-16")) << refuse(wide);
  EXPECT_TRUE(contains(refuse(wide.substr(2)), "iconv -f UTF-16LE -t UTF-8 "));
}

TEST_F(PointColumns, a_point_far_from_all_others_is_warned_of) {
  const std::string five =
      "x,y,z\n500001,4000001,7\n500002,4050003,8\n500404,4000001,9\n500003,4000002,9\n500005,4000007,8\n";
  EXPECT_TRUE(read(five).warnings.empty());
  EXPECT_TRUE(contains(read(five + "0,0,8\n").warnings.at(0), "1 point lies at 0, 0 (point 5, counted from 0)"));
  const std::string near = "x,y,z\n1,2,7\n3,2,8\n1,4,9\n2,3,9\n2,1,8\n";
  EXPECT_TRUE(read(near + "200,2,8\n").warnings.empty());
  EXPECT_TRUE(contains(read(near + "2000,2,8\n").warnings.at(0), "1 point lies at 2000, 2"));
}

TEST_F(PointColumns, what_follows_the_height_is_not_read) {
  for (const char* pattern : {"E,N,H,n", "E,N,H,255,0,13", "E,N,H,tree,n", "E N H 17 255 0 13", "E,N,H,", "E;N;H;;"})
    expect_survey(survey(pattern));
}

TEST_F(PointColumns, headers_name_columns_in_several_languages) {
  for (const char* header : {"Point,Northing,Easting,Elevation", "P,N,E,Z", "nr,Hochwert,Rechtswert,H\xc3\xb6he",
                             "Pkt,HOCHWERT,RECHTSWERT,H\xd6HE", "#id,nord,est,alt",
                             "\"Pt No\",\"Northing (m)\",\"Easting (m)\",\"Elev. [m]\"", "id,POINT_Y,POINT_X,POINT_Z",
                             "# n,UTM_N,UTM_E,ortho height", "// P,N,E,Z"})
    expect_survey(survey("n,N,E,H", std::string(header) + "\n"));
  expect_survey(survey("H;code;E;n;N", "Hoehe;Code;Ost;Nr;Nord\n"));
  EXPECT_EQ(read("lat,lon,alt\n48.5,11.5,520\n48.6,11.6,560\n").y, (std::vector<double>{48.5, 48.6}));
  EXPECT_TRUE(contains(read(survey("N,E,H", "x,y,z\n")).warnings.at(0), "if x is the northing here"));
  const std::string geodetic = "Y;X;Z\n3501234,5;5401234,5;87\n3501244,5;5401240,5;88\n";
  EXPECT_TRUE(contains(read(geodetic).warnings.at(0), "--columns enz"));
  EXPECT_TRUE(read(geodetic, "enz").warnings.empty());
  EXPECT_TRUE(contains(refuse("a,b,c\n1,2,3\n"), "--columns"));
  EXPECT_EQ(read("a,b,c\n1,2,3\n", "yxz").x, (std::vector<double>{2}));
}

TEST_F(PointColumns, a_column_of_zeros_yields_to_another_height) {
  const PointSet points = read("x,y,z,elevation\n1,2,0,7\n4,5,0,8\n6,1,0,9\n");
  EXPECT_EQ(points.z, (std::vector<double>{7, 8, 9}));
  EXPECT_TRUE(contains(points.warnings.at(0), "are all 0, so those of 'elevation' count"));
  EXPECT_TRUE(contains(read("x,y,z,elevation\n1,2,1,7\n4,5,0,8\n").warnings.at(0), "--z-field elevation"));
  EXPECT_EQ(read("x,y,z,elevation\n1,2,-9999,7\n4,5,-9999,8\n").z, (std::vector<double>{7, 8}));
}

TEST_F(PointColumns, degrees_are_told_apart_or_asked_for) {
  const std::string europe = "48.137154,11.576124,520.5\n48.137254,11.576324,530.5\n48.137354,11.576524,525.5\n";
  EXPECT_TRUE(contains(refuse(europe), "which is the longitude"));
  EXPECT_EQ(read(europe, "lat,lon,height").x.at(0), 11.576124);
  EXPECT_EQ(read("36.137154,-111.576124,520.5\n36.137254,-111.576324,530.5\n").x.at(0), -111.576124);
  EXPECT_EQ(read("-111.576124,36.137154,520.5\n-111.576324,36.137254,530.5\n").x.at(0), -111.576124);
}

TEST_F(PointColumns, named_columns_hold_what_they_are_named) {
  expect_survey(survey("n,N,E,H,tree"), "number,northing,easting,height,code");
  expect_survey(survey("tree,H,n,E,N"), "-,height,skip,x,y");
  expect_survey(survey("n,N,E,H", "a,b,c,d\n"), "pnez");
  EXPECT_TRUE(contains(refuse("1,2,3\n", "number,northing,colour,height"), "'colour' is no column"));
  EXPECT_TRUE(contains(refuse("1,2,3\n", "pnz"), "names no x (easting)"));
  EXPECT_TRUE(contains(refuse("1,2,3\n", "pnnez"), "names two columns y"));
  EXPECT_TRUE(contains(refuse("1,2,3\n", "pnez"), "line 1 has 3 columns"));
}

TEST_F(PointColumns, missing_heights_are_refused_or_left_out) {
  for (const char* missing : {"nan", "", "n/a", "-"}) {
    const std::string text = std::string("x,y,z\n1,2,3\n4,5,") + missing + "\n7,1,9\n";
    EXPECT_TRUE(contains(refuse(text), "line 3")) << missing;
    EXPECT_TRUE(contains(refuse(text), "--nodata nan")) << missing;
    const auto points = read_points(scratch_.file("p.csv"), {.nodata = std::nan("")});
    ASSERT_TRUE(points) << points.error().message;
    EXPECT_EQ(points->z, (std::vector<double>{3, 9}));
    EXPECT_EQ(points->without_height, 1U);
  }
  EXPECT_TRUE(try_to_read("x,y,z\n1,2,-9999\n4,5,6\n"));
  EXPECT_EQ(read_points(scratch_.file("p.csv"), {.nodata = -9999})->z, (std::vector<double>{6}));
}

}  // namespace
}  // namespace scarp::point_columns_test
