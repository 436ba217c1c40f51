// Random strategies, and errors by definition: every sample against every triangle that contains it.
#pragma once

#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "laws/fields.h"
#include "scarp/paper.h"

namespace scarp::testing {

inline EdgeRule any_edge_rule() {
  EdgeRule rule;
  rule.data_dependent = true;
  rule.score = *rc::gen::element(EdgeScore::kSum, EdgeScore::kMax, EdgeScore::kSquares, EdgeScore::kNormals,
                                 EdgeScore::kTight, EdgeScore::kTight);
  rule.shape_threshold = *rc::gen::element(-1.0, -1.0, 0.0, 0.3, 1.0);
  rule.supersample = *rc::gen::element(0.0, 0.0, 0.8);
  rule.settle = *rc::gen::arbitrary<bool>();
  return rule;
}

inline Importance any_importance() {
  Importance importance;
  importance.feature =
      *rc::gen::element(Importance::Feature::kNoFeature, Importance::Feature::kLocal4, Importance::Feature::kLocal8,
                        Importance::Feature::kCurvature, Importance::Feature::kDistance);
  importance.damping = *rc::gen::element(Importance::Damping::kUndamped, Importance::Damping::kPlusOne,
                                         Importance::Damping::kSqrtPlusOne);
  if (importance.feature != Importance::Feature::kNoFeature) importance.global = *rc::gen::arbitrary<bool>();
  return importance;
}

/// Any combination of settings, at a small scale.
inline PaperOptions any_strategy() {
  PaperOptions options;
  options.run.threads = 1;
  options.strategy.algorithm =
      *rc::gen::element(Algorithm::kHeap, Algorithm::kHeap, Algorithm::kLocal, Algorithm::kBruteForce);
  options.strategy.importance = any_importance();
  const bool one_pass = !options.strategy.importance.global &&
                        options.strategy.importance.feature != Importance::Feature::kDistance &&
                        *rc::gen::arbitrary<bool>();
  options.strategy.importance.one_pass = one_pass;
  if (!one_pass) {
    options.strategy.batch.rule = *rc::gen::element(Batch::Rule::kSequential, Batch::Rule::kConstant,
                                                    Batch::Rule::kFraction, Batch::Rule::kIndependent);
    options.strategy.batch.fraction = *rc::gen::element(1.0, 0.7, 0.2);
  }
  if (*rc::gen::arbitrary<bool>()) options.strategy.edges = any_edge_rule();
  options.goals.norm = *rc::gen::element(Norm::kSum, Norm::kSquares, Norm::kMax);
  return options;
}

/// Values of the mesh's surface at a sample in the grid frame, one per triangle that contains it (closed): the height
/// (channel < 0) or a channel.
inline std::vector<double> surface_at(const Mesh& mesh, const HeightField& field, int col, int row, int channel = -1) {
  std::vector<double> values;
  const auto [x, y] = field.frame.apply_affine(col, row);
  const auto value = [&](std::uint32_t v) {
    return channel < 0 ? mesh.vertex(v)[2]
                       : double{mesh.channels[static_cast<std::size_t>(mesh.channel_count) * v +
                                              static_cast<std::size_t>(channel)]};
  };
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const std::uint32_t* ids = &mesh.triangles[3 * t];
    double area = 0, sum = 0;
    bool inside = true;
    for (int k = 0; k < 3; ++k) {
      const auto a = mesh.vertex(ids[(k + 1) % 3]), b = mesh.vertex(ids[(k + 2) % 3]);
      const double w = (a[0] - x) * (b[1] - y) - (b[0] - x) * (a[1] - y);
      inside = inside && w >= 0;
      area += w;
      sum += w * value(ids[k]);
    }
    if (inside) values.push_back(sum / area);
  }
  return values;
}

/// Largest |surface − value| over the triangles that contain the sample; NaN if none.
inline double error_at(const Mesh& mesh, const HeightField& field, int col, int row, int channel = -1) {
  const auto index =
      static_cast<std::size_t>(row) * static_cast<std::size_t>(field.cols) + static_cast<std::size_t>(col);
  const double sample =
      channel < 0 ? field.samples[index] : field.channels[static_cast<std::size_t>(channel)].samples[index];
  double worst = NAN;
  for (double value : surface_at(mesh, field, col, row, channel)) worst = std::fmax(worst, std::abs(value - sample));
  return worst;
}

}  // namespace scarp::testing
