// Scarp's own: flips over the whole mesh, after the last insertion.
#include <fmt/format.h>

#include <utility>

#include "paper/study.h"

namespace scarp::paper {
namespace {

struct Start {
  const char* name;
  EdgeRule edges;
};
const std::array<Start, 5> kStarts{{{"shape alone (sum, q 1)", scape_edges(EdgeScore::kSum, 1)},
                                    {"sum, q 0.5", scape_edges(EdgeScore::kSum, 0.5)},
                                    {"squares, q 0.5", scape_edges(EdgeScore::kSquares, 0.5)},
                                    {"max, q 0.5", scape_edges(EdgeScore::kMax, 0.5)},
                                    {"sum, q 0", scape_edges(EdgeScore::kSum, 0)}}};

}  // namespace

Result<void> add_settling(Study& study) {
  const std::vector<const Field*> fields = study.choose(kThreeFields);
  if (fields.empty()) return {};
  std::vector<std::string> header{"edges"};
  for (const Field* field : fields)
    header.insert(header.end(), {field->key + " RMS", "settled", "max error", "settled"});
  std::vector<std::vector<std::string>> rows;
  for (const Start& start : kStarts) {
    study.note(fmt::format("settling: {}", start.name));
    std::vector<std::string> row{start.name};
    for (const Field* field : fields) {
      EdgeRule settled = start.edges;
      settled.settle = true;
      SCARP_TRY(const Trial& before, study.refine(*field, field->share(1), with_edges(start.edges)));
      SCARP_TRY(const Trial& after, study.refine(*field, field->share(1), with_edges(settled)));
      row.insert(row.end(), {number(before.rmse),
                             fmt::format("{} ({})", number(after.rmse), percent_of_change(after.rmse, before.rmse)),
                             number(before.max_error), number(after.max_error)});
    }
    rows.push_back(std::move(row));
  }
  study.page.heading(3, "Swaps over the whole mesh, by squared error (L2)");
  study.page.paragraph(
      "Algorithm IV tries swaps around each new vertex only. Settled: after the last insertion any edge of the mesh is "
      "swapped where that lowers the sum of squared errors and raises no largest error, until none is left. The same "
      "vertices, 1 % of the samples.");
  study.page.table(header, rows);
  return {};
}

}  // namespace scarp::paper
