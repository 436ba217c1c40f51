// `high` against `normal` at the same max error, and how its default shape floor yields: rasters and generated fields ×
// errors → triangles, max errors, RMSE, thin triangles. `hard` is high with --min-shape 0.1, which does not yield, on
// small rasters. Fails if `high` has more triangles than `normal`.

#include <algorithm>
#include <cmath>

#include "suite.h"

namespace bench {
namespace {

constexpr char kList[] = "rasters";
constexpr double kPercentsOfRelief[] = {5, 1};
constexpr std::uint64_t kMostOfFine = 600'000;  ///< larger rasters: only the first error, without `hard`
constexpr int kSide = 384;

/// Height of a sample by column and row.
using Shape = float (*)(int col, int row);

/// Pseudo-random integers, the same everywhere.
std::uint32_t scramble(std::uint32_t a, std::uint32_t b) {
  std::uint32_t x = a * 0x9E3779B1U ^ (b + 0x7F4A7C15U) * 0x85EBCA77U;
  x = (x ^ x >> 15) * 0xC2B2AE3DU;
  return x ^ x >> 13;
}

/// Houses with level roofs on lots of 24 × 24 samples, with streets of 6 samples in between.
float blocks(int col, int row) {
  const auto lot_col = static_cast<std::uint32_t>(col / 24), lot_row = static_cast<std::uint32_t>(row / 24);
  return col % 24 < 6 || row % 24 < 6 ? 0.0F : static_cast<float>(5 + scramble(lot_col, lot_row) % 25);
}

/// A flight of 12 steps across the raster's corner, each 3 high.
float stairs(int col, int row) { return static_cast<float>(3 * ((2 * col + row) / (kSide / 4))); }

/// Heaps with radii of 1 to 40 samples on a slope, cut off at a height of 20.
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

std::vector<std::string> names(const std::filesystem::path& project) {
  std::vector<std::string> all = names_in<kList>(project);
  all.insert(all.end(), std::begin(kStyles), std::end(kStyles));
  for (const Generated& generated : kGenerated) all.emplace_back(generated.name);
  return all;
}

scarp::Result<scarp::OwnedHeightField> read(const std::filesystem::path& project, const std::string& name) {
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
  return read_field(project, name, kSide);
}

scarp::SimplifyOptions options_of(std::string_view variant, double max_error) {
  scarp::SimplifyOptions options;
  options.goals.max_error = max_error;
  options.quality.effort = variant == "normal" ? scarp::Effort::kNormal : scarp::Effort::kHigh;
  if (variant == "hard") options.quality.min_shape = 0.1;
  options.run.threads = 1;
  return options;
}

void measure(const std::string& name, const scarp::OwnedHeightField& field, Rows& rows) {
  const bool is_small = field.info.valid <= kMostOfFine;
  for (const double percent : kPercentsOfRelief) {
    if (!is_small && percent < kPercentsOfRelief[0]) continue;
    const double max_error = percent / 100 * relief_of(field);
    std::uint64_t normal = 0;
    for (const std::string_view variant : {"normal", "high", "hard"}) {
      if (!is_small && variant == "hard") continue;
      const std::string what = fmt::format("{}, {:g} % of the relief, {}", name, percent, variant);
      const Made made = make(what, field, options_of(variant, max_error));
      const scarp::Measurement& judged = made.judged;
      rows.add(fmt::format("{},{},{},{},{:g},{:.9g},{},{},{:.7g},{:.7g},{:.3f},{:.2f}", name, field.cols, field.rows,
                           field.info.valid, percent, max_error, variant, judged.triangles, judged.max_error,
                           judged.rmse, judged.angle_percentiles[0], made.thin_percent));
      if (variant == "normal") normal = judged.triangles;
      if (variant == "high" && judged.triangles > normal) die(what + ": more triangles than normal", 3);
    }
  }
}

}  // namespace

const Suite kHighNormal{"high_normal",
                        "raster,cols,rows,valid,percent_of_relief,max_error_asked,variant,triangles,max_error,rmse,"
                        "angle_p1,thin_percent",
                        names, measure, read};

}  // namespace bench
