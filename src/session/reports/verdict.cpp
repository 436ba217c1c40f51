#include "session/reports/verdict.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "measure/judge.h"
#include "session/text/text.h"

namespace scarp::cli {
std::string describe_rounding(double sample_rounding) {
  return sample_rounding > 0 ? fmt::format(", and values rounded to float32 by up to {:.3g},", sample_rounding) : "";
}

std::optional<std::string> find_broken_promise(const Measurement& measured, double sample_rounding, double bound,
                                               const HeightRange& heights) {
  if (!(measured.max_error + sample_rounding <= bound + judge::judging_allowance(bound, heights))) {
    return fmt::format("max error {:.10g} at column {}, row {}{} exceeds {:.10g}", measured.max_error,
                       measured.max_error_at[0], measured.max_error_at[1], describe_rounding(sample_rounding), bound);
  }
  if (measured.uncovered > 0) {
    return fmt::format("{} covered by no triangle, the first at column {}, row {}",
                       measured.uncovered == 1 ? "1 sample is" : format_count(measured.uncovered) + " samples are",
                       measured.uncovered_at[0], measured.uncovered_at[1]);
  }
  if (!measured.is_sound()) return "the mesh is not sound: " + list_faults(measured);
  return std::nullopt;
}

std::string list_faults(const Measurement& measured) {
  const std::pair<std::uint64_t, const char*> faults[] = {
      {measured.closed ? 0 : measured.down_facing, "flipped triangle"},
      {measured.degenerate, "degenerate triangle"},
      {measured.overlaps, "overlap"},
      {measured.misoriented_edges, "misoriented edge"},
      {measured.non_manifold_edges, "non-manifold edge"},
      {measured.t_junctions, "T-junction"},
      {measured.gaps, "gap"},
  };
  std::string list;
  for (const auto& [count, noun] : faults) {
    if (count > 0) list += (list.empty() ? "" : ", ") + format_plural(count, noun);
  }
  return list;
}

}  // namespace scarp::cli
