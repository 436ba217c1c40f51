// LAS and LAZ: files of every format made by the tests, and pairs from other writers if the shared folder exists.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <random>

#include "las/decimal_axis.h"
#include "las/header.h"
#include "las/read_las.h"
#include "scarp/io.h"
#include "scarp/points.h"
#include "unit/las_files.h"
#include "unit/raster_files.h"

namespace scarp {
namespace {

using testing::Bytes;
using testing::contains;
using testing::FilePoint;
using testing::geo_keys;
using testing::LasFile;
using testing::put;

/// Reads a file in memory.
Result<las::Points> decode(const Bytes& bytes, const las::Selection& selection = {}, int threads = 1) {
  const auto read = [&](std::uint64_t offset, std::span<std::uint8_t> into) {
    EXPECT_LE(offset + into.size(), bytes.size());
    std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(offset), into.size(), into.begin());
    return true;
  };
  const las::Source source{"survey.laz", bytes.size(), read};
  SCARP_TRY(const auto& header, las::read_header(source));
  Run run;
  run.threads = threads;
  return las::read_points(source, header, selection, run);
}

std::string fault_of(const Bytes& bytes) {
  const auto points = decode(bytes);
  return points ? "" : points.error().message;
}

/// Points of a walk with several returns, classes and channels: everything that a format can store.
std::vector<FilePoint> make_points(std::size_t count, std::uint8_t format) {
  std::mt19937 random(format + 1);
  const auto any = [&](std::uint32_t below) { return static_cast<std::uint8_t>(random() % below); };
  const bool is_extended = las::is_extended(format);
  std::vector<FilePoint> points(count);
  std::int32_t x = 50'000'000, y = 465'000'000;
  for (FilePoint& of : points) {
    x += static_cast<std::int32_t>(random() % 200) - 90;
    y += static_cast<std::int32_t>(random() % 100) - 50;
    of.point.x = x;
    of.point.y = y;
    of.point.z = static_cast<std::int32_t>(random() % 5000) - (any(50) == 0 ? 2'000'000'000 : 0);
    of.point.return_count = any(is_extended ? 16 : 8);
    of.point.return_number = any(is_extended ? 16 : 8);
    of.point.number = any(4) == 0 ? any(is_extended ? 255 : 32) : 2;
    of.point.is_withheld = any(40) == 0;
    of.point.is_overlap = is_extended ? any(10) == 0 : of.point.number == 12;
    of.channel = is_extended && any(20) == 0 ? any(4) : 0;
    of.has_new_time = is_extended && any(3) == 0;
  }
  return points;
}

LasFile make_file(std::uint8_t format, std::size_t count = 700, std::uint16_t extra_bytes = 0) {
  LasFile file;
  file.format = format;
  file.minor_version = las::is_extended(format) ? 4 : format >= 4 ? 3 : 2;
  file.extra_bytes = extra_bytes;
  file.points = make_points(count, format);
  return file;
}

las::Selection everything() {
  las::Selection all;
  all.has_withheld = true;
  return all;
}

void expect_points(const LasFile& file, const las::Points& read) {
  ASSERT_EQ(read.x.size(), file.points.size());
  std::array<std::uint64_t, 256> classes{};
  for (std::size_t k = 0; k < read.x.size(); ++k) {
    EXPECT_EQ(read.x[k], file.points[k].point.x / 100.0) << k;
    EXPECT_EQ(read.y[k], file.points[k].point.y / 100.0) << k;
    EXPECT_EQ(read.z[k], file.points[k].point.z / 100.0) << k;
    ++classes[file.points[k].point.number];
  }
  EXPECT_EQ(read.tally.classes, classes);
}

TEST(Las, points_of_every_format_are_read) {
  for (std::uint8_t format = 0; format < las::kFormats; ++format) {
    SCOPED_TRACE(static_cast<int>(format));
    const LasFile file = make_file(format, 700, format % 3);
    const auto read = decode(file.las(), everything());
    ASSERT_TRUE(read.has_value()) << read.error().message;
    expect_points(file, *read);
  }
}

TEST(Las, compressed_points_of_every_format_are_read) {
  for (std::uint8_t format = 0; format < las::kFormats; ++format) {
    for (const bool is_varying : {false, true}) {
      SCOPED_TRACE(static_cast<int>(format) + (is_varying ? 100 : 0));
      const LasFile file = make_file(format, 700, format % 3);
      const std::vector<std::size_t> ends =
          is_varying ? std::vector<std::size_t>{1, 301, 302} : std::vector<std::size_t>{256, 512};
      const auto read = decode(make_laz(file, ends, is_varying), everything());
      ASSERT_TRUE(read.has_value()) << read.error().message;
      expect_points(file, *read);
    }
  }
}

TEST(Las, threads_change_nothing) {
  const LasFile file = make_file(7, 5000);
  std::vector<std::size_t> ends;
  for (std::size_t end = 100; end < 5000; end += 100) ends.push_back(end);
  const Bytes laz = make_laz(file, ends, false);
  const auto one = decode(laz), four = decode(laz, {}, 4);
  ASSERT_TRUE(one && four);
  EXPECT_EQ(one->x, four->x);
  EXPECT_EQ(one->y, four->y);
  EXPECT_EQ(one->z, four->z);
  EXPECT_EQ(one->tally.classes, four->tally.classes);
}

TEST(Las, coordinates_are_the_doubles_nearest_to_the_decimals) {
  EXPECT_EQ(las::DecimalAxis(0.01, 0)(123456789), 1234567.89);
  EXPECT_EQ(las::DecimalAxis(0.001, 1e6)(-2147483647), -1147483.647);
  EXPECT_EQ(las::DecimalAxis(1e-7, -123.5)(1), -123.4999999);
  EXPECT_EQ(las::DecimalAxis(100, 7)(3), 307);
  EXPECT_EQ(las::DecimalAxis(0.00025, 515384.8225)(-1), 515384.82225);
  EXPECT_EQ(las::DecimalAxis(-0.01, 0)(5), -0.05);
  EXPECT_EQ(las::DecimalAxis(1e-5, 2014969.123479005)(123456789), 2016203.691369005);
  EXPECT_EQ(las::DecimalAxis(1e-30, 0)(1), 1e-30);
  EXPECT_EQ(las::DecimalAxis(1e200, 1e210)(2), std::fma(2, 1e200, 1e210));
  // Compares with text that has more digits than a double.
  std::mt19937 random(1);
  for (int k = 0; k < 2000; ++k) {
    const auto i = static_cast<std::int32_t>(random());
    constexpr std::int64_t kUnit = 10'000'000'000;
    const std::int64_t value = 12'345'671'234'567'890 + i;
    const std::string text = std::to_string(value / kUnit) + "." + std::to_string(kUnit + value % kUnit).substr(1);
    EXPECT_EQ(las::DecimalAxis(1e-10, 1234567.123456789)(i), std::strtod(text.c_str(), nullptr)) << text;
  }
}

TEST(Las, a_survey_lies_on_its_own_lattice) {
  testing::ScratchFolder scratch;
  LasFile file = make_file(1, 300);
  for (FilePoint& of : file.points) of.point.z = std::abs(of.point.z % 1000);
  file.scale[0] = file.scale[1] = 0.02;
  file.offset = {300000, 5000000, 0};
  const Bytes bytes = file.las();
  testing::write_text(scratch.file("a.las"), {bytes.begin(), bytes.end()});
  const auto points = read_points(scratch.file("a.las"));
  ASSERT_TRUE(points.has_value()) << points.error().message;
  EXPECT_EQ(points->format, "LAS");
  PointOptions options;
  options.max_error = 1;
  options.quality.effort = Effort::kFast;
  const auto made = simplify_points(*points, options);
  ASSERT_TRUE(made.has_value()) << made.error().message;
  int exponent = 0;  // the lattice of the file, or that divided by a power of two
  EXPECT_EQ(std::frexp(0.02 / made->lattice_step, &exponent), 0.5) << made->lattice_step;
}

TEST(Las, a_selection_counts_each_point_once) {
  const LasFile file = make_file(6, 3000);
  las::Selection selection;
  selection.classes.reset();
  selection.classes.set(2);
  selection.has_overlap = false;
  selection.returns = las::Returns::kLast;
  const auto read = decode(file.las(), selection);
  ASSERT_TRUE(read.has_value());
  las::Tally wanted;
  for (const FilePoint& of : file.points) {
    const las::LasPoint& point = of.point;
    if (!point.is_withheld) ++wanted.classes[point.number];
    ++(point.is_withheld                          ? wanted.withheld
       : point.number != 2                        ? wanted.other_classes
       : point.is_overlap                         ? wanted.overlap
       : point.return_number < point.return_count ? wanted.other_returns
                                                  : wanted.used);
  }
  EXPECT_EQ(read->tally.classes, wanted.classes);
  EXPECT_EQ(read->tally.withheld, wanted.withheld);
  EXPECT_EQ(read->tally.other_classes, wanted.other_classes);
  EXPECT_EQ(read->tally.overlap, wanted.overlap);
  EXPECT_EQ(read->tally.other_returns, wanted.other_returns);
  EXPECT_EQ(read->tally.used, wanted.used);
  EXPECT_EQ(read->x.size(), wanted.used);
  EXPECT_GT(wanted.withheld * wanted.other_classes * wanted.overlap * wanted.other_returns * wanted.used, 0U);
}

/// Expects an error that names the file for every proper prefix of a file.
void expect_sentences_of_prefixes(const Bytes& bytes) {
  ASSERT_EQ(fault_of(bytes), "");
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const std::string fault = fault_of({bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)});
    if (bytes.size() - size <= 6 && fault.empty()) continue;  // zeros that end a stream
    ASSERT_TRUE(fault.starts_with("survey.laz: ") && !contains(fault, "\n"))
        << size << " of " << bytes.size() << ": " << fault;
  }
}

TEST(Las, files_that_are_cut_off_are_refused_in_a_sentence) {
  for (const std::uint8_t format : std::array<std::uint8_t, 4>{0, 3, 6, 8}) {
    SCOPED_TRACE(static_cast<int>(format));
    const LasFile file = make_file(format, 60, 2);
    expect_sentences_of_prefixes(file.las());
    expect_sentences_of_prefixes(make_laz(file, {20, 40}, false));
    expect_sentences_of_prefixes(make_laz(file, {7, 40}, true));
  }
}

TEST(Las, damaged_bytes_never_crash) {
  std::mt19937 random(7);
  for (const std::uint8_t format : std::array<std::uint8_t, 7>{0, 1, 3, 5, 6, 8, 10}) {
    const LasFile file = make_file(format, 120, 3);
    for (const Bytes& whole : {file.las(), make_laz(file, {50}, true)}) {
      for (int k = 0; k < 400; ++k) {
        Bytes bytes = whole;
        const std::size_t changes = 1 + random() % 4;
        for (std::size_t c = 0; c < changes; ++c) {
          const std::size_t at =
              random() % 3 == 0 ? random() % bytes.size() : random() % std::min<std::size_t>(bytes.size(), 500);
          bytes[at] = random() % 4 == 0 ? 0xFF : static_cast<std::uint8_t>(random());
        }
        const std::string fault = fault_of(bytes);
        EXPECT_TRUE(fault.empty() || fault.starts_with("survey.laz: ")) << fault;
      }
    }
  }
}

TEST(Las, headers_that_lie_are_refused_with_their_fault) {
  const LasFile file = make_file(6, 30);
  const Bytes las = file.las(), laz = make_laz(file, {10, 20}, false);
  const auto refuse = [](Bytes bytes, std::size_t at, auto value) {
    put(bytes, at, value);
    return fault_of(bytes);
  };
  using U8 = std::uint8_t;
  using U16 = std::uint16_t;
  using U32 = std::uint32_t;
  using U64 = std::uint64_t;
  EXPECT_EQ(refuse(las, 0, U8{'M'}), "survey.laz: is no LAS file: it does not begin with LASF");
  EXPECT_TRUE(contains(refuse(las, 25, U8{9}), "is of LAS version 1.9"));
  EXPECT_TRUE(contains(refuse(las, 94, U16{100}), "a header of 100 bytes"));
  EXPECT_TRUE(contains(refuse(las, 96, U32{10}), "begin at byte 10, within its header"));
  EXPECT_TRUE(contains(refuse(las, 96, U32{0xFFFFFFFF}), "begin at byte 4294967295: the file is cut off"));
  EXPECT_TRUE(contains(refuse(las, 100, U32{0xFFFFFFFF}), "announces 4294967295 records of variable length"));
  EXPECT_TRUE(contains(refuse(las, 104, U8{11}), "points of format 11"));
  EXPECT_TRUE(contains(refuse(las, 104, U8{0x86}), "the record that describes how is missing"));
  EXPECT_TRUE(contains(refuse(las, 105, U16{29}), "records of 29 bytes"));
  EXPECT_TRUE(contains(refuse(las, 247, U64{1} << 60), "announces 1152921504606846976 points, and has room for 30"));
  EXPECT_TRUE(contains(refuse(las, 131, 0.0), "its x cannot be known: the scale is 0"));
  EXPECT_TRUE(contains(refuse(las, 147, std::nan("")), "its z cannot be known"));
  EXPECT_TRUE(contains(refuse(las, 163, HUGE_VAL), "its y cannot be known"));
  EXPECT_TRUE(contains(refuse(laz, 247, U64{1} << 60), "has 30 points, and the header announces"));
  const std::size_t record = 375 + 54, points = record + 40;
  EXPECT_TRUE(contains(refuse(laz, record, U16{7}), "compressor 7"));
  EXPECT_TRUE(contains(refuse(laz, record + 12, U32{0}), "chunks of 0 points"));
  EXPECT_TRUE(contains(refuse(laz, record + 32, U16{999}), "too few for 999 items"));
  EXPECT_TRUE(contains(refuse(laz, record + 34, U16{3}), "type 3, which is unknown"));
  EXPECT_TRUE(contains(refuse(laz, record + 38, U16{9}), "compressed by version 9"));
  EXPECT_TRUE(contains(refuse(laz, points, U64{1} << 50), "its table of chunks lies beyond its end"));
  const auto table = las::load<U64>(laz.data() + points);
  EXPECT_TRUE(contains(refuse(laz, table + 4, U32{0xFFFFFFFF}), "announces 4294967295 chunks"));
}

TEST(Las, a_file_without_points_is_refused_in_a_sentence) {
  testing::ScratchFolder scratch;
  const LasFile file = make_file(0, 0);
  for (const Bytes& bytes : {file.las(), make_laz(file, {}, false)}) {
    testing::write_text(scratch.file("no.laz"), {bytes.begin(), bytes.end()});
    const auto points = read_points(scratch.file("no.laz"));
    ASSERT_FALSE(points.has_value());
    EXPECT_EQ(points.error().message, scratch.file("no.laz") + ": holds no points");
  }
}

Result<PointSet> read_with(const LasFile& file, const ReadPointsOptions& options = {}) {
  testing::ScratchFolder scratch;
  const Bytes bytes = file.las();
  testing::write_text(scratch.file("a.las"), {bytes.begin(), bytes.end()});
  return read_points(scratch.file("a.las"), options);
}

TEST(Las, codes_and_wkt_name_the_crs_and_the_unit_of_heights) {
  LasFile file = make_file(0, 20);
  for (FilePoint& of : file.points) of.point.z = 1000;
  file.records = {geo_keys({{1024, 1}, {3072, 26910}, {4099, 9002}})};
  auto points = read_with(file);
  ASSERT_TRUE(points.has_value()) << points.error().message;
  EXPECT_EQ(points->crs, "EPSG:26910");
  EXPECT_EQ(points->heights.unit, "foot");
  points = read_with(file, {.heights_in = HeightsIn::kMetres});
  ASSERT_TRUE(points.has_value()) << points.error().message;
  EXPECT_NEAR(points->z[0], 3.048, 1e-12);

  file.records = {geo_keys({{1024, 1}, {3072, 2992}, {4096, 5103}})};  // the old code of NAVD88
  points = read_with(file);
  ASSERT_TRUE(points.has_value()) << points.error().message;
  EXPECT_EQ(points->crs, "EPSG:2992");

  file.records = {geo_keys({{1024, 2}, {2048, 4326}})};
  file.scale = {1e-7, 1e-8, 0.01};
  points = read_with(file, {.crs = "source"});
  ASSERT_TRUE(points.has_value()) << points.error().message;
  EXPECT_EQ(points->crs, "EPSG:4326");
  points = read_with(file);
  ASSERT_TRUE(points.has_value()) << points.error().message;
  EXPECT_TRUE(points->is_local);
}

TEST(Las, keys_with_parameters_are_a_crs) {
  LasFile file = make_file(0, 20);
  file.records = {
      geo_keys({{1024, 1}, {1025, 1}, {2048, 4326}, {3072, 32767}, {3074, 32767}, {3075, 1}, {3076, 9001}})};
  testing::VariableRecord doubles{"LASF_Projection", 34736, {}};
  std::uint16_t index = 0;
  for (const auto& [key, value] :
       {std::pair<std::uint16_t, double>{3080, 15.5}, {3081, 0}, {3082, 500000}, {3083, 0}, {3092, 0.9996}}) {
    put(doubles.bytes, doubles.bytes.size(), value);
    Bytes& directory = file.records[0].bytes;
    for (const std::uint16_t word : {key, std::uint16_t{34736}, std::uint16_t{1}, index})
      put(directory, directory.size(), word);
    ++index;
    put(directory, 6, static_cast<std::uint16_t>(directory.size() / 8 - 1));
  }
  file.records.push_back(doubles);
  const auto points = read_with(file);
  ASSERT_TRUE(points.has_value()) << points.error().message;
  EXPECT_TRUE(contains(points->crs, "Transverse_Mercator") && contains(points->crs, "15.5")) << points->crs;
  EXPECT_EQ(points->unit_in_metres, 1);

  file.records.pop_back();  // without their parameters
  const auto unknown = read_with(file);
  ASSERT_TRUE(unknown.has_value());
}

TEST(Las, options_of_other_files_are_refused) {
  const LasFile file = make_file(0, 20);
  for (const auto& options :
       {ReadPointsOptions{.layer = "a"}, ReadPointsOptions{.z_field = "a"}, ReadPointsOptions{.columns = "a"}}) {
    const auto points = read_with(file, options);
    ASSERT_FALSE(points.has_value());
    EXPECT_EQ(points.error().kind, ErrorKind::kUsage);
  }
  testing::ScratchFolder scratch;
  testing::write_text(scratch.file("a.csv"), "1,2,3\n4,5,6\n7,9,9\n");
  const auto points = read_points(scratch.file("a.csv"), {.choice = {.classes = {2}}});
  ASSERT_FALSE(points.has_value());
  EXPECT_TRUE(contains(points.error().message, "LAS"));
  const auto none = read_with(file, {.choice = {.classes = {200}}});
  ASSERT_FALSE(none.has_value());
  EXPECT_TRUE(contains(none.error().message, "none of its 20 points is left")) << none.error().message;
}

// Files of other writers.

std::vector<std::string> shared_files() {
  const std::string folder = testing::reference_folder();
  std::vector<std::string> files;
  if (folder.empty() || !std::filesystem::is_directory(folder + "las")) return files;
  for (const auto& entry : std::filesystem::directory_iterator(folder + "las")) files.push_back(entry.path().string());
  std::sort(files.begin(), files.end());
  return files;
}

Bytes bytes_of(const std::string& path) {
  const std::string text = testing::read_text(path);
  return {text.begin(), text.end()};
}

TEST(LasShared, pairs_have_the_same_points) {
  const std::vector<std::string> files = shared_files();
  if (files.empty()) GTEST_SKIP() << "the shared files are not here";
  int pairs = 0;
  for (const std::string& las : files) {
    const bool is_simple = las.ends_with("pdal_simple.las");  // its pair is from the first version of the compressor
    const std::string laz =
        las.substr(0, las.size() - 4) + (is_simple ? "-laszip-compressor-version-1.2r0.laz" : ".laz");
    if (!las.ends_with(".las") || !std::filesystem::exists(laz)) continue;
    SCOPED_TRACE(las);
    const auto raw = decode(bytes_of(las), everything()), compressed = decode(bytes_of(laz), everything());
    ASSERT_TRUE(raw && compressed);
    EXPECT_EQ(raw->x, compressed->x);
    EXPECT_EQ(raw->y, compressed->y);
    EXPECT_EQ(raw->z, compressed->z);
    EXPECT_EQ(raw->tally.classes, compressed->tally.classes);
    ++pairs;
  }
  EXPECT_GE(pairs, 10);
}

TEST(LasShared, points_fill_the_box_of_the_header) {
  const std::vector<std::string> files = shared_files();
  if (files.empty()) GTEST_SKIP() << "the shared files are not here";
  for (const std::string& path : files) {
    SCOPED_TRACE(path);
    if (contains(path, "spurious") || contains(path, "pdal_lone-star.laz") || contains(path, "no-points"))
      continue;  // headers with different boxes
    const Bytes bytes = bytes_of(path);
    const auto read = [&](std::uint64_t offset, std::span<std::uint8_t> into) {
      std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(offset), into.size(), into.begin());
      return true;
    };
    const auto header = las::read_header({path, bytes.size(), read});
    const auto points = decode(bytes, everything());
    ASSERT_TRUE(header && points);
    EXPECT_EQ(points->x.size(), header->points);
    const std::vector<double>* const axes[] = {&points->x, &points->y, &points->z};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [least, most] = std::minmax_element(axes[k]->begin(), axes[k]->end());
      EXPECT_NEAR(*least, header->least[k], header->scale[k]) << k;
      EXPECT_NEAR(*most, header->most[k], header->scale[k]) << k;
    }
  }
}

TEST(LasShared, copc_has_the_points_of_its_laz) {
  const std::vector<std::string> files = shared_files();
  if (files.empty()) GTEST_SKIP() << "the shared files are not here";
  const std::string folder = testing::reference_folder() + "las/";
  const auto laz = decode(bytes_of(folder + "pdal_lone-star.laz")),
             copc = decode(bytes_of(folder + "pdal_lone-star.copc.laz"));
  ASSERT_TRUE(laz && copc);
  const auto sorted = [](const las::Points& points) {
    std::vector<std::array<std::int64_t, 3>> all(points.x.size());
    for (std::size_t k = 0; k < all.size(); ++k) {
      const auto steps = [](double value) { return std::llround(value / 0.00025); };
      all[k] = {steps(points.x[k]), steps(points.y[k]), steps(points.z[k])};
    }
    std::sort(all.begin(), all.end());
    return all;
  };
  EXPECT_EQ(sorted(*laz), sorted(*copc));

  // Its octree excludes chunks, but no point of a rectangle.
  const Bytes bytes = bytes_of(folder + "pdal_lone-star.copc.laz");
  std::uint64_t read_bytes = 0;
  const auto read = [&](std::uint64_t offset, std::span<std::uint8_t> into) {
    read_bytes += into.size();
    std::copy_n(bytes.data() + offset, into.size(), into.begin());
    return true;
  };
  const las::Source source{"copc.laz", bytes.size(), read};
  const auto header = las::read_header(source);
  ASSERT_TRUE(header);
  for (const double side : {1.0, 7.5, 30.0}) {
    for (const double at : {0.0, 3.3, 14.7}) {
      las::Selection selection;
      selection.extent = {header->least[0] + at, header->least[1] + at, header->least[0] + at + side,
                          header->least[1] + at + side};
      const auto is_inside = [&](double x, double y) {
        const auto& [west, south, east, north] = *selection.extent;
        return x >= west && x <= east && y >= south && y <= north;
      };
      std::size_t expected = 0;
      for (std::size_t k = 0; k < copc->x.size(); ++k) expected += is_inside(copc->x[k], copc->y[k]);
      read_bytes = 0;
      const auto part = las::read_points(source, *header, selection, {.threads = 1});
      ASSERT_TRUE(part);
      EXPECT_EQ(part->x.size(), expected);
      EXPECT_EQ(part->tally.used + part->tally.outside + part->tally.withheld, copc->x.size() + copc->tally.withheld);
      if (side == 1.0) {
        EXPECT_LT(read_bytes, bytes.size() / 3);
      }
    }
  }
}

}  // namespace
}  // namespace scarp
