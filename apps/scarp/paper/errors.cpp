// Section 5: the rows that the engine is held to, and error against the number of vertices.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "paper/reference_rows.h"
#include "paper/study.h"
#include "terminal/signals.h"

namespace scarp::paper {

Result<void> add_reference_rows(Study& study) {
  std::vector<std::vector<std::string>> rows;
  Differences rmse, triangles, max_error;
  const auto add_row = [&](const Field& field, std::uint64_t vertices, const ReferenceRow* scape) -> Result<void> {
    study.note(fmt::format("reference: {}, {} vertices", field.key, vertices));
    SCARP_TRY(const Trial& trial, study.delaunay(field, vertices));
    std::optional<double> their_triangles, their_max, their_rmse;
    if (scape != nullptr) {
      their_triangles = static_cast<double>(scape->triangles);
      their_max = scape->max_error;
      their_rmse = scape->rmse;
    }
    const std::string what = fmt::format("{} at {} vertices", field.key, vertices);
    triangles.add(what, static_cast<double>(trial.triangles), their_triangles);
    max_error.add(what, trial.max_error, their_max);
    rmse.add(what, trial.rmse, their_rmse);
    rows.push_back({field.key, fmt::format("{}", trial.vertices), beside_count(trial.triangles, their_triangles),
                    beside(trial.max_error, their_max), beside(trial.rmse, their_rmse),
                    fmt::format("{:.2f} %", 100 * trial.max_error / field.relief()),
                    fmt::format("{:.2f} %", 100 * trial.rmse / field.relief())});
    return {};
  };
  if (study.fields.are_of_paper) {
    for (const ReferenceRow& row : kReferenceRows) {
      const Field* field = study.find(row.field);
      if (field == nullptr) continue;
      SCARP_RETURN_IF_ERROR(add_row(*field, row.vertices, &row));
    }
  } else {
    for (const Field& field : study.fields.all) {
      for (const double share : {0.1, 1.0, 5.0, 10.0}) {
        SCARP_RETURN_IF_ERROR(add_row(field, std::max<std::uint64_t>(field.share(share), 5), nullptr));
      }
    }
  }
  study.page.heading(2, "Results (section 5, page 22)");
  study.page.paragraph("Delaunay, exactly this many vertices, corners included. Errors over all samples.");
  study.page.table({"field", "m", "triangles", "max error", "RMS", "max / relief", "RMS / relief"}, rows);
  if (!rmse.empty()) {
    study.page.list({rmse.sentence("RMS errors"), triangles.sentence("counts of triangles"),
                     max_error.sentence("max errors") +
                         " Ties and the first diagonal decide it, and it is not monotone in m, as below."});
  }
  return {};
}

Result<void> add_cross_checks(Study& study) {
  std::vector<std::vector<std::string>> rows;
  double ours = 0, farthest = 0;
  for (const CrossCheck& check : kCrossChecks) {
    const Field* field = study.fields.are_of_paper ? study.find(check.field) : nullptr;
    if (field == nullptr) continue;
    if (rows.empty() || rows.back().front() != check.field) {
      SCARP_TRY(const Trial& trial, study.delaunay(*field, check.vertices));
      rows.push_back(
          {field->key, fmt::format("{}", check.vertices), "Scarp", number(trial.max_error), number(trial.rmse)});
      ours = trial.rmse;
    }
    farthest = std::max(farthest, 100 * std::abs(ours / check.rmse - 1));
    rows.push_back(
        {field->key, fmt::format("{}", check.vertices), check.program, number(check.max_error), number(check.rmse)});
  }
  if (rows.empty()) return {};
  study.page.heading(3, "Other programs");
  study.page.paragraph("The same greedy insertion, Delaunay, by other programs. Terra is the paper's second program.");
  study.page.table({"field", "m", "program", "max error", "RMS"}, rows);
  study.page.list({fmt::format(
      "The RMS errors lie within {:.1f} % of Scarp's. The max errors need not, for the same reasons.", farthest)});
  return {};
}

namespace {

/// Numbers of vertices, `steps` to a factor of ten, and the last.
std::vector<std::uint64_t> stations(double first, double last, int steps) {
  std::vector<std::uint64_t> list;
  for (int k = 0;; ++k) {
    const double m = first * std::pow(10.0, static_cast<double>(k) / steps);
    if (m >= last) break;
    list.push_back(static_cast<std::uint64_t>(std::llround(m)));
  }
  list.push_back(static_cast<std::uint64_t>(std::llround(last)));
  return list;
}

struct Curves {
  Curve max_error, rmse;
};

/// Max error at many stations, RMS at a few, both in percent of the relief.
Result<Curves> trace(const Field& field, int color) {
  Curves curves{{field.key, Curve::Style::kLine, {}, color}, {field.key, Curve::Style::kLineAndPoints, {}, color}};
  auto refiner = Refiner::create(field.heights);
  if (!refiner) return fail(refiner.error().kind, fmt::format("{}: {}", field.file, refiner.error().message));
  const double last = 0.1 * static_cast<double>(field.samples());
  const std::vector<std::uint64_t> dense = stations(10, last, 60), sparse = stations(10, last, 4);
  auto next = sparse.begin();
  for (const std::uint64_t m : dense) {
    while (refiner->vertex_count() < m && refiner->insert_worst()) {
      if (refiner->vertex_count() % 1024 == 0 && cli::interrupted()) return fail(ErrorKind::kCancelled, "interrupted");
    }
    if (refiner->vertex_count() < m || !(refiner->max_error() > 0)) break;
    curves.max_error.points.push_back({static_cast<double>(m), 100 * refiner->max_error() / field.relief()});
    if (next == sparse.end() || m < *next) continue;
    ++next;
    MeasureOptions heights_only;
    heights_only.topology = false;
    heights_only.run.threads = 0;
    SCARP_TRY(const auto& judged, measure(field.heights, refiner->mesh(), heights_only));
    curves.rmse.points.push_back({static_cast<double>(m), 100 * judged.rmse / field.relief()});
  }
  return curves;
}

Result<void> add_spikes(Study& study) {
  const Field* crater = study.fields.are_of_paper ? study.find("crater") : nullptr;
  if (crater == nullptr) return {};
  std::vector<std::vector<std::string>> rows;
  Differences differences;
  for (const MaxErrorFigure& figure : kCraterSpikes) {
    SCARP_TRY(const Trial& trial, study.delaunay(*crater, figure.vertices));
    rows.push_back({fmt::format("{}", trial.vertices), beside(trial.max_error, figure.max_error)});
    differences.add(fmt::format("{} vertices", figure.vertices), trial.max_error, figure.max_error);
  }
  study.page.paragraph(
      "The max error has spikes, where a single sample suddenly lies under a long triangle. So `scarp simplify -p` "
      "returns the best mesh near its budget. Crater:");
  study.page.table({"m", "max error"}, rows);
  if (const std::string far = differences.list_far(kFarPercent); !far.empty()) {
    study.page.list(
        {fmt::format("**Max error at {}:** less is better. Scape's run stops on a spike; Scarp's spikes are at other "
                     "numbers of vertices.",
                     far)});
  }
  return {};
}

}  // namespace

Result<void> add_error_curves(Study& study) {
  Plot max_plot{"Max error against vertices", "vertices m", "max error, % of the relief", true, true, "top right", {}};
  Plot rmse_plot{"RMS error against vertices", "vertices m", "RMS error, % of the relief", true, true, "top right", {}};
  int color = 0;
  for (const Field& field : study.fields.all) {
    study.note(fmt::format("error curves: {}", field.key));
    color = color % 8 + 1;
    SCARP_TRY(Curves curves, trace(field, color));
    if (curves.max_error.points.empty()) continue;
    max_plot.curves.push_back(std::move(curves.max_error));
    rmse_plot.curves.push_back(std::move(curves.rmse));
    Curve their_max{"", Curve::Style::kPoints, {}, color}, their_rmse = their_max;
    for (const ReferenceRow& row : kReferenceRows) {
      const auto m = static_cast<double>(row.vertices);
      if (!study.fields.are_of_paper || field.key != row.field || row.vertices > field.samples() / 10 + 1) continue;
      their_max.points.push_back({m, 100 * row.max_error / field.relief()});
      their_rmse.points.push_back({m, 100 * row.rmse / field.relief()});
    }
    if (their_max.points.empty()) continue;
    max_plot.curves.push_back(std::move(their_max));
    rmse_plot.curves.push_back(std::move(their_rmse));
  }
  if (max_plot.curves.empty()) return {};
  study.page.heading(3, "Error against vertices");
  study.page.paragraph(study.fields.are_of_paper ? "Circles: Scape's rows above." : "Greedy insertion, Delaunay.");
  Result<void> drawn = study.add_plot("rms_error", rmse_plot);
  if (drawn) drawn = study.add_plot("max_error", max_plot);
  return drawn ? add_spikes(study) : drawn;
}

}  // namespace scarp::paper
