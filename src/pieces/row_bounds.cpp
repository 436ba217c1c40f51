#include "pieces/row_bounds.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "metric/sample_judge.h"
#include "pieces/border_chain.h"
#include "pieces/row_refinement.h"
#include "refine/refinement.h"

namespace scarp {

namespace {

/// Samples strictly within a row of the row's samples that are vertices, ascending.
std::vector<std::int32_t> vertices_along(const TileRow& row, std::int32_t y) {
  std::vector<std::int32_t> cols;
  for (Vertex v = 0; v < row.tin.vertex_count(); ++v) {
    const Point p = row.tin.point(v);
    if (p.y == y && p.x > 0 && p.x < row.samples.cols - 1) cols.push_back(p.x);
  }
  std::sort(cols.begin(), cols.end());
  return cols;
}

}  // namespace

Result<void> RowBounds::load(const TileRow& row) {
  const Raster& samples = row.samples;
  aims_.resize(static_cast<std::size_t>(samples.cols) * static_cast<std::size_t>(samples.rows));
  return bounds_.read_aims(row.first, samples, aims_.data());
}

Result<void> RowBounds::split_shared(TileRow& row, bool is_top) {
  const std::int32_t y = is_top ? 0 : row.samples.rows - 1, around = y + (row.has_above ? 1 : 0);
  const HeightField field{row.around.samples, row.around.cols, row.around.rows};
  const BorderLine line{0, around, field.cols - 1, false};
  const std::span<float> own = along(aims_, row, y);
  const auto more = makes_whole() ? simplify_border(field, line, LineBound(own))
                                  : split_border(field, line, vertices_along(row, y), LineBound(own));
  if (!more) return tl::unexpected(more.error());
  for (const std::int32_t col : *more) {
    const Point p{col, y};
    row.tin.insert(p, row.tin.locate(p, row.tin.last_touched()));
  }
  std::fill(own.begin(), own.end(), std::numeric_limits<float>::infinity());
  return {};
}

Result<FinishedRow> RowBounds::refine(TileRow row) {
  if (makes_whole()) {
    if (auto started = start_row(row); !started) return tl::unexpected(started.error());
  }
  for (const bool is_top : {true, false}) {
    if (!(is_top ? row.has_above : row.has_below)) continue;
    if (auto split = split_shared(row, is_top); !split) return tl::unexpected(split.error());
  }
  // What a judge of triangles cannot decide about a sample on a shared row, that of lines could: it is not asked.
  const SampleJudge judge(judging_by_bounds(row.samples, aims_));
  Refinement refinement(judge, row.tin);
  if (auto refined = refine_row(row, refinement, work_); !refined) return tl::unexpected(refined.error());
  return FinishedRow{std::move(row.tin), {}};
}

}  // namespace scarp
