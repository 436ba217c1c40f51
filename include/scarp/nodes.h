// Heights by place: what tiles are made of.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "scarp/degrees.h"
#include "scarp/geoid.h"
#include "scarp/height_field.h"
#include "scarp/result.h"
#include "scarp/tile_grid.h"

#pragma GCC visibility push(default)

namespace scarp {

/// Samples of a source side by side on a straight line, at equal steps of degrees; NaN where there is none.
struct SampleRow {
  double longitude = 0, latitude = 0;            ///< position of the first sample
  double step_longitude = 0, step_latitude = 0;  ///< to the next
  std::span<const float> heights;                ///< metres, as NodeSource::read() has them
};
using SampleVisitor = std::function<void(const SampleRow&)>;

/// Heights by place.
class NodeSource {
 public:
  virtual ~NodeSource() = default;
  /// Writes cols × rows heights in metres to `out`, the northern row first, NaN where there is none. A node's height is
  /// a function of its place alone. Several threads may call it at once. Fails as the samples' source does.
  virtual Result<void> read(const NodeWindow& window, std::span<float> out) const = 0;
  /// A part of the window outside which no node has a height; without columns or rows where none has. DEFAULT: all of
  /// it.
  virtual NodeWindow land(const NodeWindow& window) const { return window; }
  /// True if nodes are made of samples that visit_samples() shows. DEFAULT: false.
  virtual bool has_samples() const { return false; }
  /// Shows all samples that lie in the box, and others around it, some perhaps twice; longitudes continue beyond 180°
  /// where the box does. A row is valid during its visit. Several threads may call it at once. Fails as the samples'
  /// source does. DEFAULT: shows none.
  virtual Result<void> visit_samples(const DegreeBox& /*box*/, const SampleVisitor& /*visit*/) const { return {}; }
};

/// Nodes by interpolation between the samples of a raster: cubic (Catmull-Rom) where all 16 samples around a node are
/// heights, else bilinear between those of four that are. No height where the nearest sample has none. The raster's
/// place of a node is exact at each 16th node and interpolated between where `from_degrees` is given; so is the place
/// of a sample on the globe. Borrows the field's samples. Fails with kUsage for an affine map without an inverse.
Result<std::unique_ptr<NodeSource>> make_node_source(const HeightField& field, const RasterPlace& place);

/// The samples of the raster of a local grid, whose north is up: nodes of its finest level, or every second, fourth …
/// one. Beyond the raster its outermost samples are repeated: tiles read them, and end before. Borrows the field's
/// samples.
std::unique_ptr<NodeSource> make_local_nodes(const HeightField& field);

/// The nodes of `source`, raised by their zero's height, which is exact at most 1/32° apart and interpolated between.
/// Its read() fails with kInput for a height whose zero is not known. Borrows the source.
std::unique_ptr<NodeSource> make_raised_source(const NodeSource& source, std::shared_ptr<const HeightZero> zero);

/// A source of a stack.
struct StackedSource {
  const NodeSource* nodes = nullptr;  ///< borrowed
  DegreeBox covered = {};             ///< it has no heights elsewhere
};
/// Several sources as one: a node has the height of the first that has one there. The samples are shown of one source
/// alone. Cost: each source reads what those before it left open, as a rectangle.
std::unique_ptr<NodeSource> make_stacked_source(std::vector<StackedSource> sources);

/// Degrees that the raster covers, half a cell around the outer samples included. Fails with kInput where its outline
/// has no longitude or latitude, or lies beyond a pole or 720 degrees from Greenwich. `to_degrees`: from x and y to
/// degrees, null as in RasterPlace.
Result<DegreeBox> degrees_covered(const HeightField& field, const std::array<double, 6>& affine,
                                  const PointTransform* to_degrees);

}  // namespace scarp

#pragma GCC visibility pop
