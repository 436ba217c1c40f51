// Checks if `high` ever needs more triangles than `normal` for the same max error, and what its default floor of shapes
// yields: rasters and generated fields × errors → triangles, max errors, RMSE, thin triangles, as measure() judges
// them.
//
//   scarp_high_normal PROJECT TABLE.csv [NAME...]
//
// All of PROJECT/bench/quality/rasters.txt and the fields below, or the named ones, whose rows then are put in place of
// the old ones. `hard` is high with --min-shape 0.1, which does not yield; it is run where a raster is small. Ends with
// 3 as soon as a mesh breaks its bound, does not cover a sample or is not sound; and, when all is done, if `high`
// needed more triangles than `normal` anywhere.

#include <fmt/format.h>

#include <cstdio>

#include "files.h"
#include "judge.h"
#include "scarp/scarp.h"
#include "variants.h"

namespace {

constexpr double kPercentsOfRelief[] = {5, 1};
constexpr std::uint64_t kMostOfFine = 600'000;  ///< rasters of more samples: the first error only, and not `hard`
constexpr int kSide = 384;

constexpr const char* kHeader =
    "raster,cols,rows,valid,percent_of_relief,max_error_asked,variant,triangles,max_error,rmse,angle_p1,thin_percent\n";

/// Heights of samples by column and row.
using Shape = float (*)(int col, int row);

/// Whole numbers that appear random and are the same everywhere.
std::uint32_t scramble(std::uint32_t a, std::uint32_t b) {
  std::uint32_t x = a * 0x9E3779B1U ^ (b + 0x7F4A7C15U) * 0x85EBCA77U;
  x = (x ^ x >> 15) * 0xC2B2AE3DU;
  return x ^ x >> 13;
}

/// Houses with level roofs on lots of 24 × 24 samples, streets of 6 between them.
float blocks(int col, int row) {
  const auto lot_col = static_cast<std::uint32_t>(col / 24), lot_row = static_cast<std::uint32_t>(row / 24);
  return col % 24 < 6 || row % 24 < 6 ? 0.0F : static_cast<float>(5 + scramble(lot_col, lot_row) % 25);
}

/// A flight of 12 steps across the raster's corner, each 3 high.
float stairs(int col, int row) { return static_cast<float>(3 * ((2 * col + row) / (kSide / 4))); }

/// Heaps of 1 to 40 samples' radius on a slope, cut off at the height of 20.
float heaps(int col, int row) {
  const int lot_col = col / 96, lot_row = row / 96;
  const std::uint32_t chance = scramble(static_cast<std::uint32_t>(lot_col), static_cast<std::uint32_t>(lot_row));
  const double radius = 1 + chance % 40, far = std::hypot(col - 96 * lot_col - 48, row - 96 * lot_row - 48);
  return static_cast<float>(0.02 * col + std::clamp(2 * (radius - far), 0.0, 20.0));
}

struct Generated {
  const char* name;
  Shape shape;
};
constexpr Generated kGenerated[] = {{"blocks", blocks}, {"stairs", stairs}, {"heaps", heaps}};
/// Styles of `scarp generate`.
constexpr const char* kStyles[] = {
    "cliff",      "step",    "sharp-step", "diagonal-step", "sharp-diagonal-step", "pyramid", "diagonal-pyramid",
    "paraboloid", "fractal", "smooth"};

scarp::Result<scarp::OwnedHeightField> field_of(const std::filesystem::path& project, const std::string& name) {
  for (const Generated& generated : kGenerated) {
    if (name != generated.name) continue;
    scarp::OwnedHeightField field;
    field.cols = field.rows = kSide;
    field.frame = scarp::grid_frame(kSide);
    for (int row = 0; row < kSide; ++row) {
      for (int col = 0; col < kSide; ++col) field.samples.push_back(generated.shape(col, row));
    }
    const auto [least, most] = std::minmax_element(field.samples.begin(), field.samples.end());
    field.info.min = *least;
    field.info.max = *most;
    field.info.valid = field.samples.size();
    return field;
  }
  if (const auto style = scarp::find_field_style(name)) return scarp::generate_field(*style, kSide, kSide);
  return bench::read_field(project, name);
}

scarp::SimplifyOptions options_of(std::string_view variant, double max_error) {
  scarp::SimplifyOptions options;
  options.goals.max_error = max_error;
  options.quality.effort = variant == "normal" ? scarp::Effort::kNormal : scarp::Effort::kHigh;
  if (variant == "hard") options.quality.min_shape = 0.1;
  options.run.threads = 1;
  return options;
}

/// All errors and variants of one field; the program's exit code.
int run(const std::string& name, const scarp::OwnedHeightField& field, std::string& table, int& worse) {
  const bool is_small = field.info.valid <= kMostOfFine;
  for (const double percent : kPercentsOfRelief) {
    if (!is_small && percent < kPercentsOfRelief[0]) continue;
    const double max_error = percent / 100 * (field.info.max - field.info.min);
    std::uint64_t normal = 0;
    for (const std::string_view variant : {"normal", "high", "hard"}) {
      if (!is_small && variant == "hard") continue;
      const auto made = bench::make(field, options_of(variant, max_error));
      const std::string fault = made ? bench::find_fault(made->judged, max_error) : made.error().message;
      if (!fault.empty()) {
        fmt::print(stderr, "{}, {:g} % of the relief, {}: {}\n", name, percent, variant, fault);
        return 3;
      }
      const scarp::Measurement& judged = made->judged;
      table += fmt::format("{},{},{},{},{:g},{:.9g},{},{},{:.7g},{:.7g},{:.3f},{:.2f}\n", name, field.cols, field.rows,
                           field.info.valid, percent, max_error, variant, judged.triangles, judged.max_error,
                           judged.rmse, judged.angle_percentiles[0], made->thin_percent);
      fmt::print("{:28}{:4g} %  {:8}{:9}{:9.3f} s\n", name, percent, variant, judged.triangles, made->seconds);
      std::fflush(stdout);
      if (variant == "normal") normal = judged.triangles;
      worse += variant == "high" && judged.triangles > normal ? 1 : 0;
    }
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr, "usage: scarp_high_normal PROJECT TABLE.csv [NAME...]\n");
    return 1;
  }
  const std::filesystem::path project = argv[1];
  std::vector<std::string> all = bench::read_names(project / "bench/quality/rasters.txt");
  all.insert(all.end(), std::begin(kStyles), std::end(kStyles));
  for (const Generated& generated : kGenerated) all.emplace_back(generated.name);
  std::vector<std::string> names(argv + 3, argv + argc);
  if (names.empty()) names = all;
  int worse = 0;
  for (const std::string& name : names) {
    const auto field = field_of(project, name);
    if (!field) return bench::fail_with(field.error().message);
    std::string table = kHeader;
    if (const int code = run(name, *field, table, worse)) return code;
    if (const int code = bench::write_table(argv[2], bench::replace_rows(argv[2], table, name, all))) return code;
  }
  if (worse > 0) fmt::print(stderr, "high took more triangles than normal in {} cases\n", worse);
  return worse == 0 ? 0 : 3;
}
