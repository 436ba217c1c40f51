// Synthetic height fields for tests, demonstrations and documents: those of Scape's program genstm, and more.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/result.h"

#pragma GCC visibility push(default)

namespace scarp::grid {

/// Letters and formulas are genstm's: nx and ny are the numbers of columns and rows, x and y the sample. Integer
/// divisions drop the fraction. Heights are truncated to integers (except for kFractal and kSmooth).
enum class FieldStyle {
  kCliff,              ///< h: a vertical cliff across x, 1000 where x > nx/2, else 0
  kStep,               ///< x: a soft step in x, 1000 (1 + tanh((x − nx/2) / (nx/8.0)))
  kSharpStep,          ///< X: sharper, nx/64.0
  kDiagonalStep,       ///< d: a soft step along the diagonal, 1000 (1 + tanh((x + y − nx) / (nx/8.0)))
  kSharpDiagonalStep,  ///< D: sharper, nx/64.0
  kParabola,           ///< q: a parabola in x, 1000 (x / nx)²
  kParaboloid,         ///< p: (x − nx/2)² + (y − ny/2)²
  kScaledParaboloid,   ///< P: the paraboloid over the full 15-bit range, · 4 · 32767 / (nx² + ny²)
  kPyramid,            ///< o: an inverted pyramid with its edges along the axes, |x − nx/3| + |y − ny/4|
  kDiagonalPyramid,    ///< r: the same with edges along the diagonals, 2 max(|x − nx/3|, |y − ny/4|)
  kFractal,            ///< seeded noise in octaves of decreasing scale and height; 0 … 1000, not integers
  kSmooth,  ///< 64 plane waves of at least an eighth of the longer side, with seeded directions, lengths and phases: a
            ///< band-limited, nearly Gaussian surface; 0 … 1000, not integers
};

/// The style named "cliff", "sharp-step", … or by genstm's letter; nothing if unknown.
std::optional<FieldStyle> find_field_style(const std::string& name);
/// The names, in enumeration order.
const std::vector<std::string>& field_style_names();

/// cols · rows heights of at least 0 in the grid frame, the same on every machine (no libm). The seed affects kFractal
/// and kSmooth only. Unlike genstm's 16-bit heights, they do not wrap round beyond 65535 (paraboloids of 363 samples
/// and more). Fails with kUsage unless sides are 2 … 65536 samples and their product is at most 2³⁰.
Result<OwnedHeightField> generate_field(FieldStyle style, int cols, int rows, std::uint64_t seed = 0);

}  // namespace scarp::grid

#pragma GCC visibility pop
