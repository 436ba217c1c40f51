// How good the mesh is to be for its goals: the order of insertion, the work after it, where vertices may lie, and the
// shapes of triangles.
#pragma once

#include <optional>

#include "scarp/shape.h"

#pragma GCC visibility push(default)

namespace scarp {

/// In which order candidates are inserted.
enum class Order {
  kAuto,      ///< kDominant where it applies, else kGreedy
  kGreedy,    ///< the worst sample of the whole raster first, as the paper's Algorithm III
  kDominant,  ///< the worst sample of its neighbourhood first, tile by tile: many times faster, on all threads, with as
              ///< many vertices. For one error, on heights alone, with Delaunay edges; see simplify().
};

/// How much work follows refinement: for a smaller mesh that satisfies the same bound; with a budget, for a better mesh
/// of the same size.
enum class Effort {
  kAuto,    ///< kNormal; kFast in the greedy order if that is asked for, unless min_shape or the like ask for more,
            ///< and where a memory limit has no room for removal. Simplified::why_fast reports the reason.
  kFast,    ///< none: the refined mesh stays
  kNormal,  ///< removes vertices while every sample stays within the bound: half the triangles, for a few times the
            ///< time. Works strip by strip if samples are not in memory; see simplify().
  kHigh,  ///< removes more, and repairs broken bounds by flipping edges and moving vertices (see Vertices): a third of
          ///< the triangles, for some ten times the time of the greedy order. Possible where kNormal is.
  kMax,   ///< the same, deeper, for some hundred times the time. Ends when Run::is_time_up asks for it, or when there
          ///< is nothing more to gain. Possible where kNormal is.
};

/// Positions allowed for vertices.
enum class Vertices {
  kAuto,     ///< kFree where kHigh and kMax can move them: in affine frames, without channels; else kSamples
  kSamples,  ///< on samples, with their heights
  kFree,     ///< between samples too, in steps of an eighth, with float32 heights of their own. For kHigh and kMax, in
             ///< affine frames, on heights alone; vertices on outlines of nodata, and corners, stay on samples
};

struct Quality {
  /// DEFAULT: kAuto.
  Effort effort = Effort::kAuto;
  /// kFree fails with kUsage below kHigh. DEFAULT: kAuto.
  Vertices vertices = Vertices::kAuto;
  /// Floor of the shapes of triangles, height over longest edge, 0 … 0.5, 0 for none: no vertex is removed or moved, no
  /// edge flipped if that makes a triangle below it, unless it removes one that is as bad. Triangles of refinement, and
  /// those that the outline of nodata forces, may lie below. The default yields: what kNormal removes is removed first,
  /// whatever the shapes, and where more than 15 % of the triangles lie below by then it binds nothing. DEFAULT: 0.1
  /// where vertices are free, else 0.
  std::optional<double> min_shape = std::nullopt;
  /// Angles, edge lengths and their growth, for simulations: vertices are added until they hold, then removed as far as
  /// they still do (with a grade the other way round). With a budget an error is searched for, as with lines. Fails
  /// with kUsage without a max error or a budget, for goals out of range, and for a budget below what they need.
  /// DEFAULT: none.
  ShapeGoals shape = {};
  /// kAuto is kDominant towards an error where that order has no conflicts (list_conflicts()) and, in memory, samples
  /// have no bounds of their own; else kGreedy. kDominant with such bounds refines tiles to the largest, then greedily
  /// to each sample's own; if some sample has none, greedily from the start. kDominant with a budget searches for the
  /// error, or the factor of tolerances, whose mesh fits. DEFAULT: kAuto.
  Order order = Order::kAuto;
};

}  // namespace scarp

#pragma GCC visibility pop
