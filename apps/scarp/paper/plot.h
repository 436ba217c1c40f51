// Curves drawn by gnuplot.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "scarp/result.h"

namespace scarp::paper {

struct Curve {
  enum class Style { kLine, kPoints, kLineAndPoints, kDashes };
  std::string title;  ///< empty: not in the key
  Style style = Style::kLine;
  std::vector<std::array<double, 2>> points;
  int color = 0;  ///< 1 … 8; curves of one colour belong together
};

struct Plot {
  std::string title, x_label, y_label;
  bool log_x = true, log_y = true;
  std::string key_place = "top right";
  std::vector<Curve> curves;
};

/// kOutput, in one sentence that names the package, if gnuplot cannot be run.
Result<void> find_gnuplot();
/// A PNG of 900 x 540 pixels. kOutput with gnuplot's own words if it refuses.
Result<std::vector<std::uint8_t>> draw_plot(const Plot& plot);

}  // namespace scarp::paper
