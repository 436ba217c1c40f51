#include "io/mesh/srgb.h"

#include <algorithm>

namespace scarp::io {
namespace {

/// x^2.4 = x² · (x^⅕)² by Newton's method, using only operations that IEEE 754 rounds identically everywhere.
constexpr double power_2_4(double x) {
  double root = 1;
  for (int round = 0; round < 60; ++round) root = (4 * root + x / (root * root * root * root)) / 5;
  return x * x * root * root;
}

constexpr double linear_of(double srgb) { return srgb <= 0.04045 ? srgb / 12.92 : power_2_4((srgb + 0.055) / 1.055); }

constexpr auto make_linear() {
  std::array<float, 256> linear{};
  for (int b = 0; b < 256; ++b) linear[static_cast<std::size_t>(b)] = static_cast<float>(linear_of(b / 255.0));
  return linear;
}

/// The limits between the colours of successive bytes.
constexpr auto make_ends() {
  std::array<double, 255> ends{};
  for (int b = 0; b < 255; ++b) ends[static_cast<std::size_t>(b)] = linear_of((b + 0.5) / 255);
  return ends;
}

constexpr std::array<double, 255> kEnds = make_ends();

}  // namespace

constinit const std::array<float, 256> kLinearOfSrgb = make_linear();

std::uint8_t srgb_of_linear(double linear) {
  if (!(linear > 0)) return 0;
  return static_cast<std::uint8_t>(std::upper_bound(kEnds.begin(), kEnds.end(), linear) - kEnds.begin());
}

}  // namespace scarp::io
