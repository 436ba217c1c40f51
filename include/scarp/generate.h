// Synthetic height fields: the report's program genstm, and more, for tests, demonstrations and documents.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/result.h"

namespace scarp {

/// The letter is genstm's.
enum class FieldStyle {
  kCliff,              ///< h: a vertical cliff across x
  kStep,               ///< x: a soft step in x
  kSharpStep,          ///< X: a sharper one
  kDiagonalStep,       ///< d: a soft step along the diagonal
  kSharpDiagonalStep,  ///< D: a sharper one
  kParabola,           ///< q: a parabola in x
  kParaboloid,         ///< p
  kScaledParaboloid,   ///< P: the paraboloid over the full range
  kPyramid,            ///< o: a pyramid with its edges along the axes
  kDiagonalPyramid,    ///< r: a pyramid with its edges along the diagonals
  kFractal,            ///< midpoint displacement, by seed
};

/// "cliff", "step", …; also genstm's letter. Nothing if unknown.
std::optional<FieldStyle> find_field_style(const std::string& name);
/// The names, in the order of the enumeration.
const std::vector<std::string>& field_style_names();

/// cols · rows heights, 0 … about 1000, the same on every machine (no libm). kUsage if the size is out of range.
Result<OwnedHeightField> generate_field(FieldStyle style, int cols, int rows, std::uint64_t seed = 0);

}  // namespace scarp
