// Laws of units: a height, a distance and a bound have their length on the ground in every frame.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "scarp/measure.h"
#include "scarp/simplify.h"
#include "unit/raster_files.h"

namespace scarp::height_unit_laws_test {
namespace {

constexpr int kCols = 9, kRows = 7;
constexpr double kFoot = 0.3048, kSurveyFoot = 1200.0 / 3937;

struct Unit {
  std::string name;
  double metres;
};
struct Place {
  std::string crs, geotransform;
  double metres;  ///< unit of x and y; 0: degrees, or unknown
};

Unit any_unit() {
  return *rc::gen::elementOf(std::vector<Unit>{{"", 0},
                                               {"m", 1},
                                               {"Meters", 1},
                                               {"ft", kFoot},
                                               {"US survey foot", kSurveyFoot},
                                               {"cm", 0.01},
                                               {"fathoms", 1.8288},
                                               {"km", 1000}});
}

Place any_place() {
  return *rc::gen::elementOf(std::vector<Place>{{"EPSG:32616", "300000, 10, 0, 4100000, 0, -10", 1},
                                                {"EPSG:2264", "1500000, 30, 0, 700000, 0, -30", kSurveyFoot},
                                                {"EPSG:2222", "500000, 30, 0, 1000000, 0, -30", kFoot},
                                                {"EPSG:4326", "-84, 0.001, 0, 36, 0, -0.001", 0},
                                                {"", "100, 2, 0, 50, 0, -2", 0}});
}

/// A VRT over floats, and its properties.
struct Raster {
  testing::ScratchFolder folder;
  std::vector<float> values;
  Unit unit = any_unit();
  Place place = any_place();
  double scale = *rc::gen::element(1.0, 0.1, 2.0);  ///< the band's own
  double turn = *rc::gen::element(1.0, -1.0);       ///< z_scale

  Raster() {
    for (int k = 0; k < kCols * kRows; ++k) values.push_back(static_cast<float>(*rc::gen::inRange(-2000, 9000)) / 8);
    testing::write_envi<float>(folder.file("raw"), kCols, kRows, values);
    const std::string named = unit.name.empty() ? "" : "<UnitType>" + unit.name + "</UnitType>";
    testing::write_vrt(path(), "raw", kCols, kRows, "Float32", testing::vrt_position(place.crs, place.geotransform),
                       named + (scale == 1 ? "" : "<Scale>" + std::to_string(scale) + "</Scale>"));
  }
  std::string path() const { return folder.file("dem.vrt"); }
  /// Length of a unit of the file's heights.
  double metres() const { return !unit.name.empty() ? unit.metres : place.metres > 0 ? place.metres : 1; }
  double physical(std::size_t k) const { return turn * scale * metres() * static_cast<double>(values[k]); }
};

ReadOptions options_of(const Raster& raster, const std::string& frame) {
  ReadOptions options;
  options.crs = frame;
  options.z_scale = raster.turn;
  options.heights_in = *rc::gen::element(HeightsIn::kFrame, HeightsIn::kMetres, HeightsIn::kFile);
  return options;
}

RC_GTEST_PROP(height_units, heights_and_distances_are_those_on_the_ground, ()) {
  const Raster raster;
  const std::string frame = *rc::gen::element<std::string>("", "local", "source", "grid");
  const ReadOptions options = options_of(raster, frame);
  const auto field = read_height_field(raster.path(), options);
  RC_ASSERT(field.has_value());
  const RasterInfo& info = field->info;
  const bool is_local = (frame.empty() || frame == "local") && !raster.place.crs.empty();
  const bool is_metric =
      options.heights_in == HeightsIn::kMetres || (options.heights_in == HeightsIn::kFrame && is_local);
  RC_ASSERT(std::abs(info.unit_in_metres / (is_metric ? 1 : raster.metres()) - 1) < 1e-9);
  for (std::size_t k = 0; k < raster.values.size(); ++k) {
    const double height = double{field->samples[k]} * info.unit_in_metres;
    RC_ASSERT(std::abs(height - raster.physical(k)) <=
              field->sample_rounding * info.unit_in_metres + 1e-9 * std::abs(raster.physical(k)));
  }
  // The word names the unit, if a unit was declared.
  RC_ASSERT(info.unit == (is_metric && raster.metres() != 1 ? "m" : raster.unit.name));
  RC_ASSERT(!is_metric || raster.metres() == 1 || !info.warnings.empty());
  if (raster.place.metres > 0 && frame != "grid") {
    const double cell = std::hypot(field->frame.affine[1], field->frame.affine[4]) * field->frame.unit_in_metres;
    const double on_ground = (raster.place.crs == "EPSG:32616" ? 10 : 30) * raster.place.metres;
    RC_ASSERT(std::abs(cell / on_ground - 1) < 1e-5);
  }
  // With the factor and the unit of the result, reading gives the same samples again.
  ReadOptions again = options;
  again.z_scale = info.z_scale;
  again.z_unit = info.unit;
  if (info.unit.empty()) return;
  const auto same = read_height_field(raster.path(), again);
  RC_ASSERT(same.has_value());
  RC_ASSERT(same->samples == field->samples);
}

RC_GTEST_PROP(height_units, a_bound_holds_in_the_unit_of_the_frame, ()) {
  const Raster raster;
  ReadOptions options = options_of(raster, *rc::gen::element<std::string>("", "source"));
  const auto field = read_height_field(raster.path(), options);
  RC_ASSERT(field.has_value());
  const double metres = *rc::gen::element(1.0, 25.0, 400.0) * raster.metres();
  const auto result = simplify(field->view(), {.max_error = metres / field->info.unit_in_metres});
  RC_ASSERT(result.has_value());
  options.heights_in = HeightsIn::kMetres;
  const auto on_ground = read_height_field(raster.path(), options);
  RC_ASSERT(on_ground.has_value());
  Mesh mesh = result->mesh;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) mesh.positions[3 * v + 2] *= field->info.unit_in_metres;
  const auto measured = measure(*on_ground, mesh);
  RC_ASSERT(measured.has_value());
  RC_ASSERT(measured->uncovered == 0);
  RC_ASSERT(measured->max_error <= metres * (1 + 1e-6) + 2 * on_ground->sample_rounding);
}

TEST(HeightUnits, ThatAreNoLengthsAreRefusedWhereMetresAreDue) {
  testing::ScratchFolder folder;
  testing::write_envi<float>(folder.file("raw"), 3, 3, std::vector<float>(9, 280));
  testing::write_vrt(folder.file("dem.vrt"), "raw", 3, 3, "Float32",
                     testing::vrt_position("EPSG:32616", "300000, 10, 0, 4100000, 0, -10"), "<UnitType>K</UnitType>");
  const Error error = testing::read_error(folder.file("dem.vrt"));
  EXPECT_EQ(error.kind, ErrorKind::kUsage);
  EXPECT_TRUE(testing::contains(error.message, "--z-unit")) << error.message;
  ReadOptions options;
  options.z_unit = "m";
  EXPECT_TRUE(read_height_field(folder.file("dem.vrt"), options));
  options = {.z_scale = 2};
  EXPECT_TRUE(read_height_field(folder.file("dem.vrt"), options)) << "scaled by hand: metres";
  options = {.crs = "source"};
  const auto kept = read_height_field(folder.file("dem.vrt"), options);
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->info.unit, "K");
  EXPECT_EQ(kept->info.unit_in_metres, 0);
}

}  // namespace
}  // namespace scarp::height_unit_laws_test
