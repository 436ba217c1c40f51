// Section 5: RMS error against vertices, of Delaunay and of data-dependent edges.
#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "paper/study.h"

namespace scarp::paper {

Result<void> add_edge_curves(Study& study) {
  Plot errors{"RMS error against vertices: data-dependent edges, and Delaunay (dashes)",
              "vertices m",
              "RMS error, % of the relief",
              true,
              true,
              "top right",
              {}};
  Plot ratios{"RMS error of data-dependent edges (sum, q 0.5) against Delaunay",
              "vertices m, % of the samples",
              "ratio of RMS errors",
              true,
              false,
              "top right",
              {}};
  int color = 0;
  std::size_t better = 0, runs = 0;
  for (const Field& field : study.fields.all) {
    study.note(fmt::format("edge curves: {}", field.key));
    color = color % 8 + 1;
    Curve with{field.key, Curve::Style::kLine, {}, color}, without{"", Curve::Style::kDashes, {}, color};
    Curve ratio{field.key, Curve::Style::kLineAndPoints, {}, color};
    for (const double share : {0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0}) {
      const std::uint64_t vertices = field.share(share);
      if (vertices < 5) continue;
      SCARP_TRY(const Trial& delaunay, study.delaunay(field, vertices));
      SCARP_TRY(const Trial& trial, study.refine(field, vertices, with_edges(scape_edges(EdgeScore::kSum, 0.5))));
      if (!(trial.rmse > 0) || !(delaunay.rmse > 0)) break;
      const auto m = static_cast<double>(vertices);
      with.points.push_back({m, 100 * trial.rmse / field.relief()});
      without.points.push_back({m, 100 * delaunay.rmse / field.relief()});
      ratio.points.push_back({share, trial.rmse / delaunay.rmse});
      better += trial.rmse < delaunay.rmse ? 1 : 0;
      ++runs;
    }
    if (with.points.empty()) continue;
    errors.curves.push_back(std::move(with));
    errors.curves.push_back(std::move(without));
    ratios.curves.push_back(std::move(ratio));
  }
  if (errors.curves.empty()) return {};
  study.page.heading(3, "Delaunay and data-dependent edges against vertices");
  SCARP_RETURN_IF_ERROR(study.add_plot("edge_rms", errors));
  SCARP_RETURN_IF_ERROR(study.add_plot("edge_ratio", ratios));
  study.page.list({fmt::format("Data-dependent edges have the smaller RMS in {} of {} runs.", better, runs)});
  return {};
}

}  // namespace scarp::paper
