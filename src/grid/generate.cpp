// Synthetic fields. Formulas, integer divisions, float32 arguments and truncation of heights are those of genstm, so
// that its figures can be reproduced. Only the hyperbolic tangent and the cosine are computed here, since libm differs
// between machines.
#include "grid/generate.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/caught.h"

namespace scarp::grid {
namespace {

constexpr int kMaxSide = 65536;
constexpr std::uint64_t kMaxSamples = std::uint64_t{1} << 30;

constexpr std::array kLetters{'h', 'x', 'X', 'd', 'D', 'q', 'p', 'P', 'o', 'r', '\0', '\0'};

/// e⁻ʸ for y >= 0, using only +, −, ·, /: Taylor's series about the nearest multiple of ln 2. Precise to about 10⁻¹⁶.
double exp_minus(double y) {
  constexpr double kLn2High = 0x1.62e42fefa39ep-1, kLn2Low = 0x1.f35793c7673p-45;
  const auto halvings = static_cast<int>(y / (kLn2High + kLn2Low) + 0.5);
  const double r = (halvings * kLn2High - y) + halvings * kLn2Low;
  double sum = 1;
  for (int k = 15; k >= 1; --k) sum = 1 + sum * r / k;
  for (int k = 0; k < halvings; ++k) sum *= 0.5;
  return sum;
}

double tanh_of(double s) {
  const double size = std::abs(s);
  const double e = size < 40 ? exp_minus(2 * size) : 0;
  const double t = (1 - e) / (1 + e);
  return s < 0 ? -t : t;
}

/// 1000 · (1 + tanh(offset / width)), truncated.
float step_height(int offset, double width) {
  const auto s = static_cast<float>(offset / width);
  return static_cast<float>(static_cast<int>(1000 * (1 + tanh_of(static_cast<double>(s)))));
}

/// A hash of the position (splitmix64's finish), as −1 … 1, independent of other calls.
double noise_at(std::uint64_t seed, int octave, std::uint64_t col, std::uint64_t row) {
  std::uint64_t h = seed + 0x9e3779b97f4a7c15u * (static_cast<std::uint64_t>(octave) + 1);
  for (const std::uint64_t part : {col, row}) {
    h += 0x9e3779b97f4a7c15u * (part + 1);
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
    h ^= h >> 31;
  }
  return static_cast<double>(h >> 11) * 0x1p-52 - 1;
}

/// Noise on a lattice of `cell` samples, with cubic interpolation between its nodes.
double noise_between(std::uint64_t seed, int octave, int cell, int col, int row) {
  const auto blend = [](double t) { return t * t * (3 - 2 * t); };
  const double u = blend(static_cast<double>(col % cell) / cell), v = blend(static_cast<double>(row % cell) / cell);
  const auto i = static_cast<std::uint64_t>(col / cell), j = static_cast<std::uint64_t>(row / cell);
  const auto along = [&](std::uint64_t line) {
    const double left = noise_at(seed, octave, i, line), right = noise_at(seed, octave, i + 1, line);
    return left + u * (right - left);
  };
  const double top = along(j), bottom = along(j + 1);
  return top + v * (bottom - top);
}

/// cos(2π turns), using only +, −, ·, /: Taylor's series within half a turn. Precise to about 10⁻¹³.
double cosine_of(double turns) {
  constexpr double kTwoPi = 6.283185307179586;
  const double angle = kTwoPi * (turns - std::floor(turns + 0.5)), square = angle * angle;
  double sum = 1;
  for (int k = 26; k >= 2; k -= 2) sum = 1 - sum * square / (k * (k - 1));
  return sum;
}

/// Each octave has half the scale and 0.55 times the height of the previous one.
double fractal_height(std::uint64_t seed, int first_cell, int col, int row) {
  double sum = 0, amplitude = 1;
  int octave = 0;
  for (int cell = first_cell; cell >= 1; cell /= 2, amplitude *= 0.55)
    sum += amplitude * noise_between(seed, octave++, cell, col, row);
  return sum;
}

/// Stretches heights to 0 … 1000. REQUIRES: two heights differ.
void stretch(OwnedHeightField& field) {
  const auto [low, high] = std::minmax_element(field.samples.begin(), field.samples.end());
  const double least = static_cast<double>(*low), relief = static_cast<double>(*high) - least;
  for (float& z : field.samples) z = static_cast<float>(1000 * ((static_cast<double>(z) - least) / relief));
}

void fill_fractal(OwnedHeightField& field, std::uint64_t seed) {
  int cell = 1;
  while (2 * cell < std::max(field.cols, field.rows)) cell *= 2;
  std::size_t at = 0;
  for (int y = 0; y < field.rows; ++y) {
    for (int x = 0; x < field.cols; ++x) field.samples[at++] = static_cast<float>(fractal_height(seed, cell, x, y));
  }
  stretch(field);
}

/// A plane wave as products of {cosine, sine} per column and per row: cos(a + b) = cos a cos b − sin a sin b.
struct PlaneWave {
  std::vector<std::array<double, 2>> cols, rows;
};

/// cos(2π (step · k + phase)) and the sine for k = 0 … count − 1.
std::vector<std::array<double, 2>> sample_wave(double step, double phase, int count) {
  std::vector<std::array<double, 2>> wave;
  for (int k = 0; k < count; ++k) {
    const double turns = step * k + phase;
    wave.push_back({cosine_of(turns), cosine_of(turns - 0.25)});
  }
  return wave;
}

/// Wave vectors are uniformly distributed in the disc of at most kMostPeriods periods over the longer side.
std::vector<PlaneWave> draw_waves(std::uint64_t seed, int cols, int rows) {
  constexpr int kWaves = 64;
  constexpr double kMostPeriods = 8;
  const double most = kMostPeriods / std::max(cols, rows);
  std::vector<PlaneWave> waves;
  for (std::uint64_t drawn = 0; waves.size() < kWaves; ++drawn) {
    const double u = noise_at(seed, 0, drawn, 0), v = noise_at(seed, 0, drawn, 1);
    if (u * u + v * v > 1) continue;
    waves.push_back({sample_wave(most * u, 0, cols), sample_wave(most * v, noise_at(seed, 0, drawn, 2), rows)});
  }
  return waves;
}

void fill_smooth(OwnedHeightField& field, std::uint64_t seed) {
  const std::vector<PlaneWave> waves = draw_waves(seed, field.cols, field.rows);
  std::vector<double> heights(static_cast<std::size_t>(field.cols));
  auto out = field.samples.begin();
  for (std::size_t y = 0; y < static_cast<std::size_t>(field.rows); ++y) {
    std::fill(heights.begin(), heights.end(), 0.0);
    for (const PlaneWave& wave : waves) {
      const auto [cosine, sine] = wave.rows[y];
      for (std::size_t x = 0; x < heights.size(); ++x) heights[x] += wave.cols[x][0] * cosine - wave.cols[x][1] * sine;
    }
    out = std::transform(heights.begin(), heights.end(), out, [](double z) { return static_cast<float>(z); });
  }
  stretch(field);
}

/// Calls height(x, y) for every sample.
template <class Height>
void fill(OwnedHeightField& field, const Height& height) {
  std::size_t at = 0;
  for (int y = 0; y < field.rows; ++y) {
    for (int x = 0; x < field.cols; ++x) field.samples[at++] = static_cast<float>(height(x, y));
  }
}

/// A step along x (`diagonal`: along x + y), nx / parts samples wide.
void fill_step(OwnedHeightField& field, bool diagonal, double parts) {
  const int nx = field.cols, centre = diagonal ? nx : nx / 2, reach = diagonal ? nx + field.rows - 1 : nx;
  std::vector<float> profile;
  for (int k = 0; k < reach; ++k) profile.push_back(step_height(k - centre, nx / parts));
  fill(field, [&](int x, int y) { return profile[static_cast<std::size_t>(diagonal ? x + y : x)]; });
}

void fill_paraboloid(OwnedHeightField& field, bool scaled) {
  const int nx = field.cols, ny = field.rows;
  const auto diameter = static_cast<float>(static_cast<double>(nx) * nx + static_cast<double>(ny) * ny);
  fill(field, [&](int x, int y) {
    const auto sx = static_cast<float>(x - nx / 2), sy = static_cast<float>(y - ny / 2);
    const float height = sx * sx + sy * sy;
    return scaled ? std::floor(height * 32767 * 4 / diameter) : height;
  });
}

void fill_style(OwnedHeightField& field, FieldStyle style, std::uint64_t seed) {
  const int nx = field.cols, ny = field.rows;
  switch (style) {
    case FieldStyle::kCliff:
      return fill(field, [&](int x, int) { return x > nx / 2 ? 1000 : 0; });
    case FieldStyle::kStep:
      return fill_step(field, false, 8);
    case FieldStyle::kSharpStep:
      return fill_step(field, false, 64);
    case FieldStyle::kDiagonalStep:
      return fill_step(field, true, 8);
    case FieldStyle::kSharpDiagonalStep:
      return fill_step(field, true, 64);
    case FieldStyle::kParabola:
      return fill(field, [&](int x, int) {
        const auto s = static_cast<float>(static_cast<double>(x) / nx);
        return static_cast<int>(1000 * s * s);
      });
    case FieldStyle::kParaboloid:
      return fill_paraboloid(field, false);
    case FieldStyle::kScaledParaboloid:
      return fill_paraboloid(field, true);
    case FieldStyle::kPyramid:
      return fill(field, [&](int x, int y) { return std::abs(x - nx / 3) + std::abs(y - ny / 4); });
    case FieldStyle::kDiagonalPyramid:
      return fill(field, [&](int x, int y) {
        const int dx = x - nx / 3, dy = y - ny / 4;
        return std::abs(dx + dy) + std::abs(dx - dy);
      });
    case FieldStyle::kFractal:
      return fill_fractal(field, seed);
    case FieldStyle::kSmooth:
      return fill_smooth(field, seed);
  }
}

}  // namespace

const std::vector<std::string>& field_style_names() {
  static const std::vector<std::string> names{
      "cliff",    "step",       "sharp-step",        "diagonal-step", "sharp-diagonal-step",
      "parabola", "paraboloid", "scaled-paraboloid", "pyramid",       "diagonal-pyramid",
      "fractal",  "smooth"};
  return names;
}

std::optional<FieldStyle> find_field_style(const std::string& name) {
  const std::vector<std::string>& names = field_style_names();
  for (std::size_t k = 0; k < names.size(); ++k) {
    const bool is_letter = name.size() == 1 && kLetters[k] != '\0' && name[0] == kLetters[k];
    if (is_letter || name == names[k]) return static_cast<FieldStyle>(k);
  }
  return std::nullopt;
}

Result<OwnedHeightField> generate_field(FieldStyle style, int cols, int rows, std::uint64_t seed) try {
  for (const int side : {cols, rows}) {
    if (side < 2 || side > kMaxSide)
      return fail(ErrorKind::kUsage,
                  fmt::format("a field of {} x {} samples cannot be made: each side must be 2 to {} samples", cols,
                              rows, kMaxSide));
  }
  const std::uint64_t count = static_cast<std::uint64_t>(cols) * static_cast<std::uint64_t>(rows);
  if (count > kMaxSamples)
    return fail(ErrorKind::kUsage,
                fmt::format("a field of {} x {} samples cannot be made: at most {} samples", cols, rows, kMaxSamples));
  OwnedHeightField field;
  field.cols = cols;
  field.rows = rows;
  field.samples.resize(count);
  field.frame = grid_frame(rows);
  fill_style(field, style, seed);
  const auto [low, high] = std::minmax_element(field.samples.begin(), field.samples.end());
  field.info.path = field_style_names()[static_cast<std::size_t>(style)];
  field.info.format = "generated";
  field.info.sample_type = "Float32";
  field.info.valid = count;
  field.info.min = static_cast<double>(*low);
  field.info.max = static_cast<double>(*high);
  return field;
} catch (...) {
  return caught(ErrorKind::kInput, fmt::format("make a field of {} x {} samples", cols, rows));
}

}  // namespace scarp::grid
