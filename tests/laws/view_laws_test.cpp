// Laws of views: several rasters as one raster, parts, and coarser cells have the values of the rasters, sample by
// sample.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scarp/io.h"
#include "unit/raster_files.h"

namespace scarp::view_laws_test {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// The metadata of a raster's only band.
struct Said {
  std::string type = "Float32", unit;
  double scale = 1, offset = 0;
  std::optional<double> nodata;
};

/// The position of a raster, and its units.
struct Place {
  std::string crs = "EPSG:32617";
  double west = 500000, top = 4000000,
         cell = 30;  // the cell's height is negative if the first row is the northern one
  double down = -30;
  bool is_point = false;
};

/// A window of cells with their values.
struct Sheet {
  int col = 0, row = 0, cols = 0, rows = 0;
  std::vector<double> values;
  Said said;
};

template <class T>
std::string bytes_of(const std::vector<double>& values) {
  std::string bytes;
  for (const double value : values) {
    const T raw = static_cast<T>(value);
    bytes.append(reinterpret_cast<const char*>(&raw), sizeof raw);
  }
  return bytes;
}

std::pair<std::string, int> encode(const Sheet& sheet) {
  const std::string& type = sheet.said.type;
  if (type == "Byte") return {bytes_of<std::uint8_t>(sheet.values), 1};
  if (type == "Int16") return {bytes_of<std::int16_t>(sheet.values), 2};
  if (type == "UInt16") return {bytes_of<std::uint16_t>(sheet.values), 2};
  if (type == "Int32") return {bytes_of<std::int32_t>(sheet.values), 4};
  if (type == "Float32") return {bytes_of<float>(sheet.values), 4};
  return {bytes_of<double>(sheet.values), 8};
}

std::string text(double value) {
  char words[40];
  std::snprintf(words, sizeof words, "%.17g", value);
  return words;
}

void write(const std::string& path, const Sheet& sheet, const Place& place) {
  const auto [bytes, size] = encode(sheet);
  testing::write_text(path + ".raw", bytes);
  const Said& said = sheet.said;
  const std::string position =
      testing::vrt_position(place.crs, text(place.west + sheet.col * place.cell) + "," + text(place.cell) + ",0," +
                                           text(place.top + sheet.row * place.down) + ",0," + text(place.down));
  const std::string point = place.is_point ? "<Metadata><MDI key=\"AREA_OR_POINT\">Point</MDI></Metadata>" : "";
  testing::write_text(
      path, "<VRTDataset rasterXSize=\"" + std::to_string(sheet.cols) + "\" rasterYSize=\"" +
                std::to_string(sheet.rows) + "\">" + position + point + "<VRTRasterBand dataType=\"" + said.type +
                "\" band=\"1\" subClass=\"VRTRawRasterBand\">" +
                (said.nodata ? "<NoDataValue>" + text(*said.nodata) + "</NoDataValue>" : "") +
                (said.unit.empty() ? "" : "<UnitType>" + said.unit + "</UnitType>") + "<Offset>" + text(said.offset) +
                "</Offset><Scale>" + text(said.scale) + "</Scale><SourceFilename relativeToVRT=\"0\">" + path +
                ".raw</SourceFilename><ImageOffset>0</ImageOffset><PixelOffset>" + std::to_string(size) +
                "</PixelOffset><LineOffset>" + std::to_string(size * sheet.cols) +
                "</LineOffset><ByteOrder>LSB</ByteOrder></VRTRasterBand></VRTDataset>");
}

Said any_said() {
  Said said;
  said.type = *rc::gen::elementOf(std::vector<std::string>{"Byte", "Int16", "UInt16", "Int32", "Float32", "Float64"});
  said.unit = *rc::gen::elementOf(std::vector<std::string>{"", "m", "metre", "ft", "US survey foot", "fathom"});
  std::tie(said.scale, said.offset) =
      *rc::gen::elementOf(std::vector<std::pair<double, double>>{{1, 0}, {1, 0}, {0.1, 0}, {0.3048, -20}, {-2, 1000}});
  // Some nodata values are equal, and some are not values of the type.
  const double nodata =
      *rc::gen::elementOf(std::vector<double>{-1, 0, 3, 7, -9999, 255, 4e9, -3.4028234663852886e38, kNone});
  if (*rc::gen::arbitrary<bool>()) said.nodata = nodata;
  if (said.nodata && std::isnan(nodata) && !said.type.starts_with("Float")) said.nodata.reset();
  return said;
}

Place any_place() {
  Place place;
  place.crs = *rc::gen::elementOf(std::vector<std::string>{"EPSG:32617", "EPSG:32617+5773", "EPSG:26917+5703"});
  if (*rc::gen::arbitrary<bool>()) place.down = 30;
  place.is_point = *rc::gen::arbitrary<bool>();
  return place;
}

double any_value(const Said& said, bool has_nan) {
  if (said.nodata && *rc::gen::inRange(0, 6) == 0 && std::abs(*said.nodata) < 1e4 && *said.nodata >= 0)
    return *said.nodata;
  if (has_nan && said.type.starts_with("Float") && *rc::gen::inRange(0, 12) == 0) return kNone;
  const int whole = *rc::gen::inRange(said.type == "Byte" || said.type.starts_with("U") ? 0 : -9, 12);
  return said.type.starts_with("Float") ? whole + 1 / 3.0 : whole;
}

Sheet any_sheet(int col, int row, int cols, int rows, const Said& said, bool has_nan = true) {
  Sheet sheet{col, row, cols, rows, {}, said};
  for (int k = 0; k < cols * rows; ++k) sheet.values.push_back(any_value(said, has_nan));
  return sheet;
}

Sheet window(const Sheet& of, int col, int row, int cols, int rows) {
  Sheet sheet{of.col + col, of.row + row, cols, rows, {}, of.said};
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < cols; ++x)
      sheet.values.push_back(of.values[static_cast<std::size_t>((row + y) * of.cols + col + x)]);
  }
  return sheet;
}

bool same(float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }

void expect_said(const RasterInfo& view, const RasterInfo& raster) {
  RC_ASSERT(view.unit == raster.unit);
  RC_ASSERT(view.crs == raster.crs);
  RC_ASSERT(view.vertical == raster.vertical);
  RC_ASSERT(view.is_ellipsoidal == raster.is_ellipsoidal);
}

void expect_one_said(const RasterInfo& view, const RasterInfo& raster) {
  expect_said(view, raster);
  RC_ASSERT(view.scale == raster.scale);
  RC_ASSERT(view.offset == raster.offset);
  RC_ASSERT(view.nodata.has_value() == raster.nodata.has_value());
  // GDAL changes values next to the largest float to that float; such nodata is compared by magnitude.
  const auto moved = [](double nodata) { return std::abs(nodata) < 3.4e38 ? nodata : double{static_cast<float>(nodata)}; };
  if (view.nodata) RC_ASSERT(text(moved(*view.nodata)) == text(moved(*raster.nodata)));
}

/// An external value may replace the declared one.
ReadOptions any_options() {
  ReadOptions options;
  options.crs = "source";
  if (*rc::gen::inRange(0, 3) == 0) options.nodata = *rc::gen::element(3.0, -1.0, 0.0);
  if (*rc::gen::inRange(0, 3) == 0) options.z_scale = 0.3048;
  return options;
}

RC_GTEST_PROP(views, of_a_raster_in_pieces_are_the_raster, ()) {
  const testing::ScratchFolder folder;
  const Place place = any_place();
  const Sheet whole = any_sheet(0, 0, *rc::gen::inRange(4, 9), *rc::gen::inRange(4, 9), any_said());
  const int x = *rc::gen::inRange(2, whole.cols - 1), y = *rc::gen::inRange(2, whole.rows - 1);
  const std::vector<Sheet> pieces{window(whole, 0, 0, x, whole.rows), window(whole, x, 0, whole.cols - x, y),
                                  window(whole, x, y, whole.cols - x, whole.rows - y)};
  ReadOptions options = any_options();
  write(folder.file("whole.vrt"), whole, place);
  const auto raster = read_height_field(folder.file("whole.vrt"), options);
  RC_PRE(raster.has_value());
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    const std::string name = folder.file("piece" + std::to_string(k) + ".vrt");
    write(name, pieces[k], place);
    options.view.more.push_back(name);
  }
  const std::string first = options.view.more.back();
  options.view.more.pop_back();
  const auto view = read_height_field(first, options);
  if (!view) RC_FAIL(view.error().message);
  RC_ASSERT(view->cols == whole.cols);
  RC_ASSERT(view->rows == whole.rows);
  RC_ASSERT(view->info.geotransform == raster->info.geotransform);
  expect_one_said(view->info, raster->info);
  for (std::size_t k = 0; k < view->samples.size(); ++k) RC_ASSERT(same(view->samples[k], raster->samples[k]));
  RC_ASSERT(view->sample_rounding == raster->sample_rounding);
}

RC_GTEST_PROP(views, of_a_part_are_that_part, ()) {
  const testing::ScratchFolder folder;
  const Place place = any_place();
  const Sheet whole = any_sheet(0, 0, *rc::gen::inRange(4, 9), *rc::gen::inRange(4, 9), any_said());
  const int cols = *rc::gen::inRange(2, whole.cols), rows = *rc::gen::inRange(2, whole.rows);
  const int col = *rc::gen::inRange(0, whole.cols - cols + 1), row = *rc::gen::inRange(0, whole.rows - rows + 1);
  ReadOptions options = any_options();
  write(folder.file("whole.vrt"), whole, place);
  write(folder.file("part.vrt"), window(whole, col, row, cols, rows), place);
  const auto part = read_height_field(folder.file("part.vrt"), options);
  RC_PRE(part.has_value());
  const double west = place.west + col * place.cell, top = place.top + row * place.down;
  const auto [low, high] = std::minmax({top, top + rows * place.down});
  options.view.extent = {{west, low, west + cols * place.cell, high}};
  const auto view = read_height_field(folder.file("whole.vrt"), options);
  if (!view) RC_FAIL(view.error().message);
  RC_ASSERT(view->samples.size() == part->samples.size());
  expect_one_said(view->info, part->info);
  for (std::size_t k = 0; k < view->samples.size(); ++k) RC_ASSERT(same(view->samples[k], part->samples[k]));
}

RC_GTEST_PROP(views, of_unlike_rasters_have_the_samples_that_each_has_alone, ()) {
  const testing::ScratchFolder folder;
  const Place place = any_place();
  const ReadOptions options = any_options();
  const std::string unit = any_said().unit;
  std::vector<Sheet> sheets;
  std::vector<std::vector<float>> samples;
  ReadOptions all = options;
  std::string unit_alone;
  for (int k = 0; k < 3; ++k) {
    Said said = any_said();
    said.unit = unit;
    sheets.push_back(any_sheet(*rc::gen::inRange(0, 6), *rc::gen::inRange(0, 6), *rc::gen::inRange(2, 5),
                               *rc::gen::inRange(2, 5), said, said.nodata && std::isnan(*said.nodata)));
    const std::string name = folder.file("sheet" + std::to_string(k) + ".vrt");
    write(name, sheets.back(), place);
    const auto alone = read_height_field(name, options);
    RC_PRE(alone.has_value());
    samples.push_back(alone->samples);
    unit_alone = alone->info.unit;
    all.view.more.push_back(name);
  }
  const std::string first = all.view.more.front();
  all.view.more.erase(all.view.more.begin());
  const auto view = read_height_field(first, all);
  if (!view) RC_FAIL(view.error().message);
  RC_ASSERT(view->info.unit == unit_alone);
  int left = 99, top = 99;
  for (const Sheet& sheet : sheets) left = std::min(left, sheet.col), top = std::min(top, sheet.row);
  std::vector<float> wanted(view->samples.size(), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t k = 0; k < sheets.size(); ++k) {
    for (int i = 0; i < sheets[k].cols * sheets[k].rows; ++i) {
      const int col = sheets[k].col - left + i % sheets[k].cols, row = sheets[k].row - top + i / sheets[k].cols;
      const float z = samples[k][static_cast<std::size_t>(i)];
      if (!std::isnan(z)) wanted[static_cast<std::size_t>(row * view->cols + col)] = z;
    }
  }
  for (std::size_t k = 0; k < wanted.size(); ++k) RC_ASSERT(same(view->samples[k], wanted[k]));
}

RC_GTEST_PROP(views, with_coarser_cells_have_the_mean_of_the_heights_in_them, ()) {
  const testing::ScratchFolder folder;
  const Place place = any_place();
  const Sheet whole = any_sheet(0, 0, *rc::gen::inRange(4, 9), *rc::gen::inRange(4, 9), any_said());
  ReadOptions options = any_options();
  write(folder.file("whole.vrt"), whole, place);
  const auto raster = read_height_field(folder.file("whole.vrt"), options);
  RC_PRE(raster.has_value());
  options.view.resolution = 60;
  const auto view = read_height_field(folder.file("whole.vrt"), options);
  RC_PRE(view.has_value());
  expect_one_said(view->info, raster->info);
  for (int row = 0; row < view->rows; ++row) {
    for (int col = 0; col < view->cols; ++col) {
      double sum = 0;
      int count = 0;
      for (int k = 0; k < 4; ++k) {
        const float z = raster->samples[static_cast<std::size_t>((2 * row + k / 2) * raster->cols + 2 * col + k % 2)];
        if (std::isnan(z)) continue;
        sum += z;
        ++count;
      }
      const float z = view->samples[static_cast<std::size_t>(row * view->cols + col)];
      RC_ASSERT(std::isnan(z) == (count == 0));
      if (count > 0) RC_ASSERT(std::abs(z - sum / count) <= view->sample_rounding + raster->sample_rounding + 1e-4);
    }
  }
}

}  // namespace
}  // namespace scarp::view_laws_test
