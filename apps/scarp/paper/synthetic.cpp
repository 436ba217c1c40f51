// Section 4.4: fields that are curved in one direction, where data-dependent edges are decisive.
#include <fmt/format.h>

#include <cmath>

#include "paper/study.h"
#include "scarp/generate.h"

namespace scarp::paper {
namespace {

constexpr int kSide = 256;
constexpr std::uint64_t kBudget = 200;

struct Column {
  const char* name;
  EdgeRule edges;
};
const std::array<Column, 4> kColumns{{{"Delaunay", {}},
                                      {"sum, q 0.5", scape_edges(EdgeScore::kSum, 0.5)},
                                      {"sum, q 0", scape_edges(EdgeScore::kSum, 0)},
                                      {"normals, q 0", scape_edges(EdgeScore::kNormals, 0)}}};

Result<Field> make_field(const std::string& name) {
  SCARP_TRY(OwnedHeightField heights, generate_field(*find_field_style(name), kSide, kSide));
  return Field{name, name, std::move(heights)};
}

Result<std::vector<std::string>> measure_errors(Study& study, const SyntheticFigures& figures,
                                                Differences& differences) {
  SCARP_TRY(const Field& field, make_field(figures.style));
  std::vector<std::string> row{figures.style};
  for (std::size_t k = 0; k < kColumns.size(); ++k) {
    SCARP_TRY(const Trial& trial, study.refine(field, kBudget, with_edges(kColumns[k].edges)));
    row.push_back(beside(trial.max_error, figures.max_error[k]));
    differences.add(fmt::format("{}, {}", figures.style, kColumns[k].name), trial.max_error, figures.max_error[k]);
  }
  return row;
}

Result<std::vector<std::string>> count_vertices(Study& study, const char* style) {
  SCARP_TRY(const Field& field, make_field(style));
  std::vector<std::string> row{style};
  for (std::size_t k = 0; k < kColumns.size(); ++k) {
    PaperOptions options = with_edges(kColumns[k].edges);
    options.goals.max_error = 0;
    SCARP_TRY(const Trial& trial, study.reach(field, options));
    const bool known = k < kPyramidVertices.size();
    row.push_back(
        fmt::format("exact with {} ({})", trial.vertices, known ? fmt::format("{}", kPyramidVertices[k]) : "11 to 12"));
  }
  return row;
}

}  // namespace

Result<void> add_synthetic(Study& study) {
  std::vector<std::vector<std::string>> rows;
  Differences differences;
  for (const SyntheticFigures& figures : kSynthetic) {
    study.note(fmt::format("synthetic fields: {}", figures.style));
    SCARP_TRY(const auto& row, measure_errors(study, figures, differences));
    rows.push_back(row);
  }
  for (const char* style : {"pyramid", "diagonal-pyramid"}) {
    SCARP_TRY(const auto& row, count_vertices(study, style));
    rows.push_back(row);
  }
  std::vector<std::string> header{fmt::format("field of {0} × {0}", kSide)};
  for (const Column& column : kColumns) header.push_back(column.name);
  study.page.heading(3, "Fields curved in one direction");
  study.page.paragraph(
      fmt::format("Max error at {} vertices on the fields of `scarp generate`, which are those of Scape's genstm. "
                  "Pyramids: vertices that reproduce every sample.",
                  kBudget));
  study.page.table(header, rows);
  std::vector<std::string> remarks;
  if (const std::string far = differences.list_far(kFarPercent); !far.empty()) {
    remarks.push_back(
        fmt::format("**Max error of {}:** less is better, and here a judge measures every sample of the finished mesh; "
                    "Scape loses samples at q 0 (below).",
                    far));
  }
  remarks.insert(remarks.end(),
                 {differences.sentence("max errors"),
                  "These fields are full of ties, whole heights in straight rows, which decide the max error at one "
                  "number of vertices (here by raster order), so that figures for the same field may lie far apart in "
                  "percent. At q 0 Scape may also have lost samples on the edges of slivers, and kept their errors.",
                  "The cliff has a jump of 1000 between two columns: no edge rule helps as long as fewer vertices than "
                  "rows are allowed."});
  study.page.list(remarks);
  return {};
}

}  // namespace scarp::paper
