#include "simplify/line_work.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.h"
#include "grid/line_positions.h"
#include "lines/breaklines.h"
#include "pieces/goals.h"
#include "pieces/strips.h"
#include "pieces/tiled.h"

namespace scarp {

LineWork::LineWork(const HeightField& field, const SimplifyOptions& options, double tolerance)
    : field_(field), options_(options), tolerance_(tolerance) {}

bool LineWork::may_wait() const {
  const LineConstraints& given = options_.features.breaklines;
  if (thread_count(options_.run.threads) == 1) return false;
  const bool is_too_large = std::max(field_.cols, field_.rows) > kMaxCoordinate / kLatticeSteps;
  if (field_.samples == nullptr || is_too_large || !options_.features.cutline.rings.empty()) return false;
  return std::all_of(given.lines.begin(), given.lines.end(), [&](const Line& line) {
    const bool is_soft =
        std::all_of(line.points.begin(), line.points.end(), [](const auto& p) { return std::isnan(p[2]); });
    return is_soft && !is_inserted_first(line) && check_line_positions(line.name, line.points, given.affine);
  });
}

Result<void> LineWork::prepare() {
  if (is_prepared_) return {};
  const auto start = Clock::now();
  std::vector<std::int32_t> rows;
  if (field_.samples == nullptr) rows = shared_rows(field_, strip_side(Plan(field_, options_)));
  SCARP_TRY(lines_, prepare_lines(field_, options_.features.breaklines, options_.features.cutline, tolerance_,
                                  options_.run.threads, rows));
  is_prepared_ = true;
  seconds_ = seconds_since(start);
  return {};
}

}  // namespace scarp
