// Efforts against the least number of triangles possible, on smooth fields with known second derivatives.
//
// As the max error e falls, the least number of triangles, with free vertices, tends to ∫ sqrt|det H| / (c·e) over the
// field, H its Hessian. Where det H > 0, c = 3√3: triangles equilateral in the metric of H, errors of both signs equal.
// Where det H < 0, c = 8/√3: the best periodic triangulations found (Pottmann et al. 2000; Atariah, Rote and
// Wintraecken 2018). Vertices on the surface need twice as many where det H > 0.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "suite.h"
#include "variants.h"

namespace bench {
namespace {

constexpr int kSide = 1025;  ///< samples over −1 … 1 in both directions
constexpr double kHeight = 1000;
constexpr double kTriangles[] = {500, 2000, 8000};

/// A height and its second derivatives.
struct Jet {
  double z = 0, xx = 0, xy = 0, yy = 0;

  Jet& operator+=(const Jet& other) {
    z += other.z;
    xx += other.xx;
    xy += other.xy;
    yy += other.yy;
    return *this;
  }
};

Jet quadric(double x, double y, double xx, double xy, double yy) {
  return {(xx * x * x + yy * y * y) / 2 + xy * x * y, xx, xy, yy};
}

/// A·sin(f·x + g·y + phase).
Jet wave(double x, double y, double f, double g, double phase, double amplitude) {
  const double z = amplitude * std::sin(f * x + g * y + phase);
  return {z, -f * f * z, -f * g * z, -g * g * z};
}

/// A bump of standard deviation s about (u, v).
Jet bump(double x, double y, double u, double v, double s, double amplitude) {
  const double dx = (x - u) / s, dy = (y - v) / s, z = amplitude * std::exp(-(dx * dx + dy * dy) / 2);
  return {z, z * (dx * dx - 1) / (s * s), z * dx * dy / (s * s), z * (dy * dy - 1) / (s * s)};
}

/// Pseudo-random numbers from 0 to 1, the same everywhere (the congruential generator of Numerical Recipes).
class Dice {
 public:
  double next() {
    state_ = state_ * 1664525U + 1013904223U;
    return static_cast<double>(state_ >> 8) / 0x1p24;
  }

 private:
  std::uint32_t state_ = 1995;
};

Jet sines(double x, double y) {
  constexpr double k = 2 * std::numbers::pi;
  // sin(k·x)·sin(k·y)
  Jet jet = wave(x, y, k, -k, std::numbers::pi / 2, 0.5);
  return jet += wave(x, y, k, k, std::numbers::pi / 2, -0.5);
}

Jet bumps(double x, double y) {
  static const auto kAll = [] {
    std::array<std::array<double, 4>, 12> all;
    Dice dice;
    for (auto& [u, v, s, amplitude] : all) {
      u = 2 * dice.next() - 1;
      v = 2 * dice.next() - 1;
      s = 0.15 + 0.2 * dice.next();
      amplitude = 2 * dice.next() - 1;
    }
    return all;
  }();
  Jet jet;
  for (const auto& [u, v, s, amplitude] : kAll) jet += bump(x, y, u, v, s, amplitude);
  return jet;
}

Jet waves(double x, double y) {
  static const auto kAll = [] {
    std::array<std::array<double, 4>, 60> all;
    Dice dice;
    for (auto& [f, g, phase, amplitude] : all) {
      const double angle = 2 * std::numbers::pi * dice.next(), frequency = 2 + 18 * dice.next();
      f = frequency * std::cos(angle);
      g = frequency * std::sin(angle);
      phase = 2 * std::numbers::pi * dice.next();
      amplitude = 1 / frequency;
    }
    return all;
  }();
  Jet jet;
  for (const auto& [f, g, phase, amplitude] : kAll) jet += wave(x, y, f, g, phase, amplitude);
  return jet;
}

struct Field {
  const char* name;
  Jet (*at)(double x, double y);
};
constexpr Field kFields[] = {
    {"paraboloid", [](double x, double y) { return quadric(x, y, 1, 0, 1); }},
    {"paraboloid 10:1", [](double x, double y) { return quadric(x, y, 1, 0, 0.01); }},
    {"saddle", [](double x, double y) { return quadric(x, y, 1, 0, -1); }},
    {"turned saddle", [](double x, double y) { return quadric(x, y, 0, 1, 0); }},
    {"sines", sines},
    {"bumps", bumps},
    {"60 waves", waves},
};

const Field& field_of(const std::string& name) {
  return *std::find_if(std::begin(kFields), std::end(kFields), [&](const Field& field) { return name == field.name; });
}

std::vector<std::string> names(const std::filesystem::path&) {
  std::vector<std::string> all;
  for (const Field& field : kFields) all.emplace_back(field.name);
  return all;
}

double at_sample(int i) { return 2.0 * i / (kSide - 1) - 1; }

scarp::Result<scarp::OwnedHeightField> read(const std::filesystem::path&, const std::string& name) {
  scarp::OwnedHeightField field;
  field.cols = field.rows = kSide;
  field.frame = scarp::grid_frame(kSide);
  for (int row = 0; row < kSide; ++row) {
    for (int col = 0; col < kSide; ++col)
      field.samples.push_back(static_cast<float>(kHeight * field_of(name).at(at_sample(col), at_sample(row)).z));
  }
  const auto [least, most] = std::minmax_element(field.samples.begin(), field.samples.end());
  field.info.min = *least;
  field.info.max = *most;
  field.info.valid = field.samples.size();
  return field;
}

/// The optimum times the max error: midpoint rule, a point for each cell of the grid.
double cost_of(const Field& field) {
  const double elliptic = 3 * std::numbers::sqrt3, hyperbolic = 8 / std::numbers::sqrt3;
  const double cell = 2.0 / (kSide - 1);
  double sum = 0;
  for (int row = 0; row + 1 < kSide; ++row) {
    for (int col = 0; col + 1 < kSide; ++col) {
      const Jet jet = field.at(at_sample(col) + cell / 2, at_sample(row) + cell / 2);
      const double det = jet.xx * jet.yy - jet.xy * jet.xy;
      sum += std::sqrt(std::abs(det)) / (det > 0 ? elliptic : hyperbolic);
    }
  }
  return kHeight * sum * cell * cell;
}

void measure(const std::string& name, const scarp::OwnedHeightField& field, Rows& rows) {
  const double cost = cost_of(field_of(name));
  for (const double optimum : kTriangles) {
    const double max_error = cost / optimum;
    double greedy_seconds = 0;
    for (const Variant& variant : kVariants) {
      const Made made = make(fmt::format("{}, {:g} triangles, {}", name, optimum, variant.name), field,
                             options_of(variant, max_error));
      if (greedy_seconds == 0) greedy_seconds = made.seconds;
      const scarp::Measurement& judged = made.judged;
      rows.add_time(variant.name, made.seconds / greedy_seconds);
      rows.add(fmt::format("{},{:g},{:.9g},{},{},{},{:.4f},{:.7g},{:.7g},{:.3f},{:.2f}", name, optimum, max_error,
                           variant.name, variant.vertices, judged.triangles,
                           static_cast<double>(judged.triangles) / optimum, judged.max_error, judged.rmse,
                           judged.angle_percentiles[0], judged.angle_percentiles[2]));
    }
  }
}

}  // namespace

const Suite kOptimum{"optimum",
                     "field,optimum,max_error_asked,effort,vertices,triangles,ratio,max_error,rmse,angle_p1,"
                     "angle_median",
                     names, measure, read};

}  // namespace bench
