// What the columns of a text hold.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "scarp/points.h"
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
  /// The one sentence.
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

/// Lines of the survey by a pattern: n, N, E, H stand for number, northing, easting and height, @ for a name.
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
