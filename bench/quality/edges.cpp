// Triangles at equal max error under each edge rule and batch rule, all in the greedy order, so that only the rules
// differ; for rasters of up to 2 million samples.

#include "suite.h"

namespace bench {
namespace {

constexpr char kList[] = "rasters";
constexpr std::size_t kMostSamples = 2'000'000;
constexpr double kErrorOfRelief = 0.02;

struct Rule {
  scarp::EdgeRule edges;
  scarp::Batch batch;
};

/// In the order of the columns.
const Rule kRules[] = {
    {{}, {}},
    {{true, scarp::EdgeScore::kSum}, {}},
    {{true, scarp::EdgeScore::kMax}, {}},
    {{true, scarp::EdgeScore::kSquares}, {}},
    {{true, scarp::EdgeScore::kMax, 0.2}, {}},
    {{true, scarp::EdgeScore::kTight}, {}},
    {{}, {scarp::Batch::Rule::kIndependent}},
    {{}, {scarp::Batch::Rule::kConstant}},
};

void measure(const std::string& name, const scarp::OwnedHeightField& field, Rows& rows) {
  if (field.samples.size() > kMostSamples) return;
  scarp::PaperOptions options;
  options.goals.max_error = kErrorOfRelief * relief_of(field);
  std::string row = fmt::format("{},{:.9g}", name, *options.goals.max_error);
  for (const Rule& rule : kRules) {
    options.strategy.edges = rule.edges;
    options.strategy.batch = rule.batch;
    row += fmt::format(",{}", check(scarp::simplify_by_paper(field, options)).mesh.triangle_count());
  }
  rows.add(row);
}

}  // namespace

const Suite kEdges{"edges", "raster,asked,delaunay,sum,max,sqerr,max0.2,tight,independent,const", names_in<kList>,
                   measure};

}  // namespace bench
