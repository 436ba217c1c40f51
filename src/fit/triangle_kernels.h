// The scan of a trial triangle against one threshold, in vectors: the inner loops of triangle_error.h.
//
// One source is compiled for every instruction set, like the engine's scan (geom/scan_kernels.h); the best one for the
// machine is chosen at run time. All of them, and the version in vectors of four, return the same bits. An error
// results from the same sequence of separately rounded operations everywhere. Sums have the same number of parts for
// any vector width, and the parts are added in the same order.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "fit/triangle_error.h"

namespace scarp::fit {

struct TriangleTask;

/// Samples from the first of the window to `end`, which is excluded.
struct SampleRows {
  const float* first;
  std::ptrdiff_t stride;
  const float* end;
};

struct ErrorLimits {
  float cut;         ///< an error above it breaks the limit
  float energy;      ///< a triangle is costly from this value on
  float per_square;  ///< 1 / threshold², or 0
};

struct TriangleSums {
  TriangleError::Verdict::Kind kind = TriangleError::Verdict::Kind::kKeeps;
  float worst = 0, energy = 0;              ///< kKeeps, or kCostly after a scan of all samples; else 0
  std::int32_t y = 0, first = 0, last = 0;  ///< kBreaks: the samples among which one breaks the limit
};

/// The dependence of a triangle's errors on the height of its first corner.
struct CornerWeight {
  float slope_x, slope_y;  ///< slopes of the corner's weight, which is 1 at the corner
  float per_threshold;     ///< 1 / threshold, or 0
};

struct CornerPull {
  double stiffness = 0, push = 0;
};

struct TriangleKernels {
  const char* name;  ///< name as in ScanKernels
  using Assess = TriangleSums (*)(const TriangleTask& task, const SampleRows& rows, const ErrorLimits& limits);
  using Pull = CornerPull (*)(const TriangleTask& task, const SampleRows& rows, const CornerWeight& weight);
  /// Adds the moments of a triangle.
  using Moments = void (*)(const TriangleTask& task, const SampleRows& rows, const CornerWeight& weight,
                           TriangleError::Moments& moments);
  /// For squares and for eighth powers, as ErrorRule::Power.
  std::array<Assess, 2> assess;
  std::array<Pull, 2> pull;
  std::array<Moments, 2> add_moments;
  void (*narrow)(const TriangleTask& task, const SampleRows& rows, const CornerWeight& weight,
                 TriangleError::Room& room);
};

/// The best for this machine, or the one that SCARP_KERNEL in the environment names (base/instruction_sets.h).
const TriangleKernels& triangle_kernels();

/// All that this machine can run, best first; the last is the version in vectors of four.
std::span<const TriangleKernels> available_triangle_kernels();

namespace trial {

const TriangleKernels& plain_triangle_kernels();
std::span<const TriangleKernels> vector_triangle_kernels();

}  // namespace trial

/// Corners with less weight at a sample do not affect it.
inline constexpr float kLeastShare = 1e-5f;

}  // namespace scarp::fit
