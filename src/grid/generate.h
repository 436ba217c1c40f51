// Synthetic height fields: the paper's program genstm, and more, for tests, demonstrations and documents.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/result.h"

#pragma GCC visibility push(default)

namespace scarp {

/// Letters and formulas are genstm's: nx, ny are columns and rows, x, y the sample. Integer divisions drop the
/// fraction. Heights are truncated to whole numbers (except for kFractal and kSmooth).
enum class FieldStyle {
  kCliff,              ///< h: a vertical cliff across x, 1000 where x > nx/2, else 0
  kStep,               ///< x: a soft step in x, 1000 (1 + tanh((x − nx/2) / (nx/8.0)))
  kSharpStep,          ///< X: a sharper one, nx/64.0
  kDiagonalStep,       ///< d: a soft step along the diagonal, 1000 (1 + tanh((x + y − nx) / (nx/8.0)))
  kSharpDiagonalStep,  ///< D: a sharper one, nx/64.0
  kParabola,           ///< q: a parabola in x, 1000 (x / nx)²
  kParaboloid,         ///< p: (x − nx/2)² + (y − ny/2)²
  kScaledParaboloid,   ///< P: the paraboloid over the full range of 15 bits, · 4 · 32767 / (nx² + ny²)
  kPyramid,            ///< o: a pyramid upside down with its edges along the axes, |x − nx/3| + |y − ny/4|
  kDiagonalPyramid,    ///< r: with its edges along the diagonals, 2 max(|x − nx/3|, |y − ny/4|)
  kFractal,            ///< noise of halving scale and height, by seed; 0 … 1000, not whole
  kSmooth,  ///< 64 plane waves, each at least an eighth of the longer side long, directions, lengths and phases by
            ///< seed: a band-limited, nearly Gaussian surface; 0 … 1000, not whole
};

/// "cliff", "sharp-step", …; also genstm's letter. Nothing if unknown.
std::optional<FieldStyle> find_field_style(const std::string& name);
/// The names, in the order of the enumeration.
const std::vector<std::string>& field_style_names();

/// cols · rows heights of at least 0, the same on every machine (no libm); in the grid frame. The seed matters to
/// kFractal and kSmooth only. genstm's heights are 16-bit and wrap round beyond 65535 (paraboloids of 363 samples and
/// more); these do not. kUsage if a side is not 2 … 65536 samples, or if they are more than 2³⁰ together.
Result<OwnedHeightField> generate_field(FieldStyle style, int cols, int rows, std::uint64_t seed = 0);

}  // namespace scarp

#pragma GCC visibility pop
