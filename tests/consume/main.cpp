// A minimal user of the library: simplifies a hill within 0.5 and judges the mesh.
#include <scarp/scarp.h>

#include <cmath>
#include <cstdio>
#include <vector>

int main() {
  constexpr int kCols = 60, kRows = 40;
  std::vector<float> samples;
  for (int row = 0; row < kRows; ++row)
    for (int col = 0; col < kCols; ++col)
      samples.push_back(static_cast<float>(20 * std::sin(col * 0.2) * std::cos(row * 0.15)));
  scarp::HeightField field;
  field.samples = samples.data();
  field.cols = kCols;
  field.rows = kRows;
  field.frame = scarp::grid_frame(kRows);

  scarp::SimplifyOptions options;
  options.goals.max_error = 0.5;
  const auto result = scarp::simplify(field, options);
  if (!result) {
    std::fprintf(stderr, "simplify: %s\n", result.error().message.c_str());
    return 1;
  }
  const auto judged = scarp::measure(field, result->mesh);
  const std::size_t triangles = result->mesh.triangle_count(), full = 2 * (kCols - 1) * (kRows - 1);
  if (!judged || judged->max_error > 0.5 || judged->samples != samples.size() || triangles == 0 || triangles >= full) {
    std::fprintf(stderr, "the mesh does not keep its promise\n");
    return 1;
  }
  // A library without the paper's strategies (SCARP_WITH_PAPER=OFF) refuses them.
  scarp::PaperOptions paper{.goals = options.goals};
  paper.strategy.batch.rule = scarp::Batch::Rule::kConstant;
  const auto by_paper = scarp::simplify_by_paper(field, paper);
  if (!by_paper) std::printf("%s\n", by_paper.error().message.c_str());

  const auto bytes = scarp::encode_mesh(result->mesh, scarp::MeshFormat::kGlb);
  if (!bytes || bytes->size() < 100) return 1;
  std::printf("scarp %s: %zu of %zu triangles, max error %.3f\n", scarp::version(), triangles, full, judged->max_error);
  return 0;
}
