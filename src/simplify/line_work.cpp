#include "simplify/line_work.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/clock.h"
#include "base/parallel.h"
#include "grid/line_positions.h"
#include "lines/breaklines.h"
#include "pieces/strips.h"
#include "pieces/tiled.h"

namespace scarp::run {

bool LineWork::may_wait() const {
  const HeightField& field = recipe_.field;
  const Features& features = recipe_.options.features;
  const LineConstraints& given = features.breaklines;
  if (thread_count(recipe_.options.run.threads) == 1) return false;
  const bool is_too_large = std::max(field.cols, field.rows) > kMaxCoordinate / grid::kLatticeSteps;
  if (recipe_.is_streamed || is_too_large || !features.cutline.rings.empty()) return false;
  return std::all_of(given.lines.begin(), given.lines.end(), [&](const Line& line) {
    const bool is_soft =
        std::all_of(line.points.begin(), line.points.end(), [](const auto& p) { return std::isnan(p[2]); });
    return is_soft && !lines::is_inserted_first(line) &&
           grid::check_line_positions(line.name, line.points, given.affine);
  });
}

Result<void> LineWork::prepare() {
  if (is_prepared_) return {};
  const auto start = Clock::now();
  std::vector<std::int32_t> rows;
  const Features& features = recipe_.options.features;
  if (recipe_.is_streamed) rows = pieces::shared_rows(recipe_.field, pieces::strip_side(recipe_));
  SCARP_TRY(lines_, lines::prepare_lines(recipe_.field, features.breaklines, features.cutline, tolerance_,
                                         recipe_.options.run.threads, rows));
  is_prepared_ = true;
  seconds_ = seconds_since(start);
  return {};
}

}  // namespace scarp::run
