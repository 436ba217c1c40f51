// Section 4.4: data-dependent triangulation against Delaunay.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "paper/study.h"

namespace scarp::paper {
namespace {

struct Mode {
  const char* name;
  const ModeFigures* figures;  ///< null: Scarp's own
  EdgeRule edges;
};

const std::array<Mode, 9> kModes{{{"Delaunay", &kDelaunayRmse, {}},
                                  {"sum, q 0.5", &kSumRmse, scape_edges(EdgeScore::kSum, 0.5)},
                                  {"squares, q 0.5", &kSquaresRmse, scape_edges(EdgeScore::kSquares, 0.5)},
                                  {"max, q 0.5", &kMaxRmse, scape_edges(EdgeScore::kMax, 0.5)},
                                  {"normals, q 0.5", &kNormalsRmse, scape_edges(EdgeScore::kNormals, 0.5)},
                                  {"sum, q 0", &kSumPureRmse, scape_edges(EdgeScore::kSum, 0)},
                                  {"sum, q 1", &kSumShapeRmse, scape_edges(EdgeScore::kSum, 1)},
                                  {"sum, q 0.5, settled", nullptr, {true, EdgeScore::kSum, 0.5, 0, true}},
                                  {"tight, settled", nullptr, {true, EdgeScore::kTight, -1, 0, true}}}};
constexpr std::size_t kSumMode = 1, kSumPureMode = 5, kTightMode = 8;

Result<Trial> run(Study& study, const Field& field, const Mode& mode, std::uint64_t vertices) {
  if (!mode.edges.data_dependent) return study.delaunay(field, vertices);
  return study.refine(field, vertices, with_edges(mode.edges));
}

/// All modes at 1 %, one row a mode.
using ModeTrials = std::array<std::vector<Trial>, kModes.size()>;

Result<ModeTrials> run_modes(Study& study) {
  ModeTrials trials;
  for (std::size_t k = 0; k < kModes.size(); ++k) {
    study.note(fmt::format("edge rules: {}", kModes[k].name));
    for (const Field& field : study.fields.all) {
      SCARP_TRY(const Trial& trial, run(study, field, kModes[k], field.share(1)));
      trials[k].push_back(trial);
    }
  }
  return trials;
}

void add_mode_table(Study& study, const ModeTrials& trials) {
  std::vector<std::string> header{"edges"};
  for (const Field& field : study.fields.all) header.insert(header.end(), {field.key, "against Delaunay"});
  std::vector<std::vector<std::string>> rows;
  Differences plain, scored;
  for (std::size_t k = 0; k < kModes.size(); ++k) {
    std::vector<std::string> row{kModes[k].name};
    for (std::size_t f = 0; f < study.fields.all.size(); ++f) {
      const Field& field = study.fields.all[f];
      std::optional<double> scape;
      if (kModes[k].figures != nullptr) scape = figure_of(study, kReportFields, *kModes[k].figures, field);
      row.push_back(beside(trials[k][f].rmse, scape));
      row.push_back(percent_of_change(trials[k][f].rmse, trials[0][f].rmse));
      (k == kSumPureMode ? plain : scored)
          .add(fmt::format("{} on {}", kModes[k].name, field.key), trials[k][f].rmse, scape);
    }
    rows.push_back(std::move(row));
  }
  study.page.paragraph(
      "RMS error at 1 % of the samples. q is the threshold of shape: 0 asks the score alone, 1 the shape alone. "
      "Settled (Scarp's own, and its default): after the last insertion edges are flipped as long as that lowers the "
      "squared error.");
  study.page.table(header, rows);
  std::vector<std::string> remarks;
  if (!scored.empty()) {
    remarks.push_back(scored.sentence("figures for q 0.5 and q 1"));
    remarks.push_back(plain.sentence("figures for q 0") +
                      (plain.largest() > 3 ? " Scape's scan loses samples on the edges of slivers there; here "
                                             "triangles are closed and lose none."
                                           : ""));
  }
  std::size_t better = 0, best = 0;
  for (std::size_t f = 0; f < trials[0].size(); ++f) {
    better += trials[kSumMode][f].rmse < trials[0][f].rmse ? 1 : 0;
    bool is_best = true;
    for (const auto& mode : trials) is_best = is_best && trials[kTightMode][f].rmse <= mode[f].rmse;
    best += is_best ? 1 : 0;
  }
  remarks.push_back(
      fmt::format("The sum at q 0.5 has a smaller RMS than Delaunay on {0} of {2} fields; the tight rule, settled, has "
                  "the smallest of all on {1} of {2}.",
                  better, best, trials[0].size()));
  study.page.list(remarks);
}

/// The share of vertices, in percent, that a mode saves at the RMS of Delaunay's 1 %: interpolated between runs,
/// straight in logarithms. `full`: the mode's run at 1 %.
Result<std::optional<double>> find_saving(Study& study, const Field& field, const Mode& mode, double rmse,
                                          const Trial& full) {
  const double full_vertices = static_cast<double>(full.vertices);
  double known_share = 1, known_rmse = full.rmse;
  if (known_rmse > rmse) return std::nullopt;
  for (const double share : {0.9, 0.8, 0.7}) {
    SCARP_TRY(const Trial& trial, run(study, field, mode, static_cast<std::uint64_t>(share * full_vertices)));
    if (trial.rmse > rmse) {
      const double t = std::log(rmse / known_rmse) / std::log(trial.rmse / known_rmse);
      return 100 * (1 - known_share * std::pow(share / known_share, t));
    }
    known_share = share;
    known_rmse = trial.rmse;
  }
  return std::nullopt;
}

std::string percent(const std::optional<double>& value) { return value ? fmt::format("{:.1f} %", *value) : "–"; }

Result<void> add_gain_table(Study& study, const ModeTrials& trials) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t f = 0; f < study.fields.all.size(); ++f) {
    const Field& field = study.fields.all[f];
    study.note(fmt::format("edge rules: gain on {}", field.key));
    const Trial &delaunay = trials[0][f], &sum = trials[kSumMode][f], &pure = trials[kSumPureMode][f];
    SCARP_TRY(const Trial& delaunay_5, study.delaunay(field, field.share(5)));
    SCARP_TRY(const Trial& sum_5, run(study, field, kModes[kSumMode], field.share(5)));
    SCARP_TRY(const auto& saving, find_saving(study, field, kModes[kSumMode], delaunay.rmse, sum));
    SCARP_TRY(const auto& tight, find_saving(study, field, kModes[kTightMode], delaunay.rmse, trials[kTightMode][f]));
    rows.push_back({field.key, percent_of_change(sum_5.rmse, delaunay_5.rmse), percent(saving), percent(tight),
                    fmt::format("{:.1f} %", delaunay.thin_share), fmt::format("{:.1f} %", sum.thin_share),
                    fmt::format("{:.1f} %", pure.thin_share),
                    number(static_cast<double>(sum.work.samples_scanned) /
                           static_cast<double>(std::max<std::uint64_t>(delaunay.work.samples_scanned, 1)))});
  }
  if (study.fields.are_of_paper) {
    rows.push_back({"*Scape*", fmt::format("−{:g} to −{:g} %", kGainAt5Least, kGainAt5Most),
                    fmt::format("{:g} to {:g} %", kFewerLeast, kFewerMost), "",
                    fmt::format("{:g} to {:g} %", kThinLeast[0], kThinMost[0]),
                    fmt::format("{:g} to {:g} %", kThinLeast[1], kThinMost[1]),
                    fmt::format("{:g} to {:g} %", kThinLeast[2], kThinMost[2]), number(kDataDependentScans)});
  }
  study.page.paragraph(
      "What the sum at q 0.5 gains, not settled: RMS at 5 % of the samples, vertices saved at the RMS that Delaunay "
      "has at 1 % (and what the tight rule saves). What it costs: triangles with an angle below 5° (at 1 %), samples "
      "scanned.");
  study.page.table({"field", "RMS at 5 %", "fewer vertices", "fewer, tight", "thin, Delaunay", "thin, q 0.5",
                    "thin, q 0", "samples scanned against Delaunay"},
                   rows);
  return {};
}

/// Triangles that keep the max error which Delaunay has at 1 %, rule by rule.
Result<void> add_bound_table(Study& study, const ModeTrials& trials) {
  constexpr std::array<std::size_t, 3> kShown{0, kSumMode, kTightMode};
  std::vector<std::string> header{"field", "max error"};
  for (const std::size_t k : kShown) header.push_back(kModes[k].name);
  std::vector<std::vector<std::string>> rows;
  for (std::size_t f = 0; f < study.fields.all.size(); ++f) {
    const Field& field = study.fields.all[f];
    study.note(fmt::format("edge rules: bound on {}", field.key));
    const double bound = trials[0][f].max_error;
    std::vector<std::string> row{field.key, number(bound)};
    double delaunay = 0;
    for (const std::size_t k : kShown) {
      PaperOptions options = with_edges(kModes[k].edges);
      options.goals.max_error = bound;
      SCARP_TRY(const Trial& trial, study.reach(field, options));
      const auto triangles = static_cast<double>(trial.triangles);
      if (k == 0) delaunay = triangles;
      row.push_back(k == 0 ? fmt::format("{}", trial.triangles)
                           : fmt::format("{} ({})", trial.triangles, percent_of_change(triangles, delaunay)));
    }
    rows.push_back(std::move(row));
  }
  study.page.paragraph(
      "Triangles that satisfy the max error of Delaunay at 1 % of the samples as a bound (against Delaunay):");
  study.page.table(header, rows);
  return {};
}

/// Median of three.
double middle(std::array<double, 3> values) {
  std::sort(values.begin(), values.end());
  return values[1];
}

struct TimedRule {
  const char* name;
  EdgeRule edges;
};
const std::array<TimedRule, 3> kTimedRules{{{"sum, q 0.5", scape_edges(EdgeScore::kSum, 0.5)},
                                            {"sum, q 0.5, settled", {true, EdgeScore::kSum, 0.5}},
                                            {"tight, settled", {true, EdgeScore::kTight}}}};

Result<void> add_times(Study& study) {
  std::vector<std::vector<std::string>> rows;
  for (const Field& field : study.fields.all) {
    study.note(fmt::format("edge rules: times on {}", field.key));
    std::array<std::array<double, 3>, kTimedRules.size()> ratios{};
    for (std::size_t run = 0; run < 3; ++run) {
      SCARP_TRY(const double delaunay, study.time(field, field.share(1)));
      for (std::size_t k = 0; k < kTimedRules.size(); ++k) {
        SCARP_TRY(const double seconds, study.time(field, field.share(1), with_edges(kTimedRules[k].edges)));
        ratios[k][run] = seconds / delaunay;
      }
    }
    rows.push_back({field.key});
    for (const auto& of_rule : ratios) rows.back().push_back(number(middle(of_rule)));
  }
  study.page.paragraph(
      fmt::format("*Measured once, on the machine that wrote this page:* CPU time against Delaunay at 1 %, median of "
                  "three rounds of runs in turn{}.",
                  study.fields.are_of_paper
                      ? fmt::format(" (Scape, sum: {:g} to {:g})", kDataDependentTimeLeast, kDataDependentTimeMost)
                      : ""));
  std::vector<std::string> header{"field"};
  for (const TimedRule& rule : kTimedRules) header.emplace_back(rule.name);
  study.page.table(header, rows);
  return {};
}

}  // namespace

Result<void> add_edge_rules(Study& study) {
  SCARP_TRY(const ModeTrials& trials, run_modes(study));
  study.page.heading(2, "Data-dependent triangulation, Algorithm IV (section 4.4, page 18)");
  add_mode_table(study, trials);
  SCARP_RETURN_IF_ERROR(add_gain_table(study, trials));
  SCARP_RETURN_IF_ERROR(add_bound_table(study, trials));
  return study.timing ? add_times(study) : Result<void>{};
}

Result<void> add_edge_sweep(Study& study) {
  const std::vector<const Field*> fields = study.choose(kThreeFields);
  if (fields.empty()) return {};
  std::vector<std::string> header{"q"};
  std::vector<std::vector<std::string>> rows(11);
  Plot plot{
      "The threshold of shape: sum, 1 % of the samples", "q", "RMS against Delaunay", false, false, "top center", {}};
  Differences differences;
  int color = 0;
  for (const Field* field : fields) {
    header.push_back(field->key);
    SCARP_TRY(const Trial& delaunay, study.delaunay(*field, field->share(1)));
    ++color;
    Curve ours{field->key, Curve::Style::kLineAndPoints, {}, color};
    Curve theirs{field->key + ", Scape", Curve::Style::kDashes, {}, color};
    for (std::size_t k = 0; k <= 10; ++k) {
      const double q = static_cast<double>(k) / 10;
      study.note(fmt::format("edge rules: sweep of {}, q {:g}", field->key, q));
      SCARP_TRY(const Trial& trial, study.refine(*field, field->share(1), with_edges(scape_edges(EdgeScore::kSum, q))));
      std::optional<double> scape;
      if (const int at = position_of(kThreeFields, field->key); study.fields.are_of_paper && at >= 0) {
        scape = kSweep[static_cast<std::size_t>(at)][k];
        theirs.points.push_back({q, *scape / *figure_of(study, kReportFields, kDelaunayRmse, *field)});
      }
      if (rows[k].empty()) rows[k].push_back(fmt::format("{:g}", q));
      rows[k].push_back(beside(trial.rmse, scape));
      differences.add(fmt::format("q {:g} on {}", q, field->key), trial.rmse, scape);
      ours.points.push_back({q, trial.rmse / delaunay.rmse});
    }
    plot.curves.push_back(std::move(ours));
    if (!theirs.points.empty()) plot.curves.push_back(std::move(theirs));
  }
  study.page.heading(3, "The threshold of shape");
  study.page.paragraph("RMS of the sum at 1 % of the samples.");
  study.page.table(header, rows);
  SCARP_RETURN_IF_ERROR(study.add_plot("sweep", plot));
  if (!differences.empty()) study.page.list({differences.sentence("figures")});
  return {};
}

}  // namespace scarp::paper
