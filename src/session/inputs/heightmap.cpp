#include "session/inputs/heightmap.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "session/text/text.h"

namespace scarp::cli {

std::optional<std::string> find_needle(const OwnedHeightField& field, const RasterInfo& info) {
  constexpr double kNeedle = 5;
  if (info.has_georeference || !info.has_range || info.valid == 0) return std::nullopt;
  const double cell = std::abs(field.frame.affine[1]);
  const double relief = info.max - info.min, width = cell * std::max(field.cols, field.rows);
  if (!(relief > kNeedle * width)) return std::nullopt;
  return fmt::format(
      "the relief of {} is {:.3g} times the width of {}, for {} has no georeference and its cells are "
      "taken to be {} wide: give their width (--cell-size) or scale the heights (--z-scale)",
      format_number(relief), relief / width, format_number(width), info.path, format_number(cell));
}

}  // namespace scarp::cli
