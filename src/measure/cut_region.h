// The region within the cutline of a mesh.
//
// The rings are used as given, in double arithmetic. The mesh contains them rounded to its lattice, by at most 3/512
// sample. So the mesh need not cover samples near the rings. kNear is more than twice that distance.
#pragma once

#include <cstdint>
#include <vector>

#include "scarp/lines.h"

namespace scarp::judge {

class CutRegion {
 public:
  static constexpr double kNear = 1.0 / 64;  ///< in samples

  /// REQUIRES: the affine map is invertible. Cost: O(rows + segments · rows that each crosses).
  CutRegion(const Cutline& cutline, int cols, int rows);

  enum class Place : std::uint8_t { kOutside, kNear, kInside };
  /// The places of the samples of some rows, row-major. Cost: O(samples + segments in those rows).
  std::vector<Place> places(int first, int rows) const;
  /// True if a point of the grid lies in a polygon. REQUIRES: its row is in the field. Cost: O(segments in that row).
  bool holds(double x, double y) const;
  /// True if a ring is within `distance`, at most 2 · kNear. Requirements and cost as holds().
  bool is_near(double x, double y, double distance) const;

 private:
  struct Segment {
    double x0, y0, x1, y1;
    std::uint32_t polygon;
  };
  static double distance(const Segment& s, double x, double y);
  static bool crosses(const Segment& s, double x, double y);
  const std::vector<Segment>& segments_at(double y) const;
  void add(const Segment& segment);
  void mark_inside(int row, Place* places) const;
  void mark_near(int row, Place* places) const;

  int cols_, rows_;
  std::vector<std::vector<Segment>> segments_;  // by row of cells: segments within 2 kNear of it; each polygon's are
                                                // consecutive
};

}  // namespace scarp::judge
