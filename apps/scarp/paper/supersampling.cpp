// Errors between the samples, for the score of thin triangles (Scape's -frac).
#include <fmt/format.h>

#include <utility>

#include "paper/study.h"

namespace scarp::paper {
namespace {

/// 0: off. Scape's program calls 0.8 moderate.
constexpr std::array kFractions{0.0, 1.6, 0.8, 0.4};
constexpr std::array kThresholds{0.5, 0.0};

}  // namespace

Result<void> add_supersampling(Study& study) {
  const std::vector<const Field*> fields = study.choose(kThreeFields);
  if (fields.empty()) return {};
  std::vector<std::string> header{"supersampling"};
  for (const Field* field : fields)
    header.insert(header.end(), {field->key + " RMS", "against none", "thin", "scanned"});
  std::vector<std::vector<std::string>> rows;
  const std::size_t runs = (kFractions.size() - 1) * fields.size();  // with supersampling, for each threshold
  std::string outcome;
  for (const double threshold : kThresholds) {
    std::vector<Trial> without;
    std::size_t better = 0;
    for (const double fraction : kFractions) {
      study.note(fmt::format("supersampling: q {:g}, {:g}", threshold, fraction));
      std::vector<std::string> row{fraction == 0 ? fmt::format("q {:g}, none", threshold)
                                                 : fmt::format("q {:g}, {:g}", threshold, fraction)};
      for (std::size_t f = 0; f < fields.size(); ++f) {
        EdgeRule edges = scape_edges(EdgeScore::kSum, threshold);
        edges.supersample = fraction;
        SCARP_TRY(const Trial& trial, study.refine(*fields[f], fields[f]->share(1), with_edges(edges)));
        if (fraction == 0) without.push_back(trial);
        better += trial.rmse < without[f].rmse ? 1 : 0;
        row.insert(row.end(),
                   {number(trial.rmse), percent_of_change(trial.rmse, without[f].rmse),
                    fmt::format("{:.1f} %", trial.thin_share),
                    number(static_cast<double>(trial.work.samples_scanned) /
                           static_cast<double>(std::max<std::uint64_t>(without[f].work.samples_scanned, 1)))});
      }
      rows.push_back(std::move(row));
    }
    outcome += fmt::format("{} at q {:g} in {} of {} runs", outcome.empty() ? "" : ",", threshold, better, runs);
    if (threshold == 0 && better == runs) outcome += ", for there are more thin triangles";
  }
  study.page.heading(3, "Supersampling");
  study.page.paragraph(
      "A thin triangle holds few samples, perhaps none, for its score. With supersampling f the score uses the "
      "bilinear interpolant of the samples on a lattice that is ⌈(width + height) / (2 · area · f)⌉ times finer; only "
      "samples are inserted. Sum, 1 % of the samples, not settled; thin: triangles with an angle below 5°; scanned: "
      "samples and points of the lattice, in those of a run without.");
  study.page.table(header, rows);
  study.page.list({fmt::format("Supersampling lowers the RMS{}.", outcome)});
  return {};
}

}  // namespace scarp::paper
