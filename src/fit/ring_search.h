// The best triangulation of the ring around a removed vertex.
//
// Klincsek's dynamic programme: the best triangulation between corners i and j of the ring is the best of those whose
// triangle at the edge i–j ends in q, for all q between. Most of k³/6 triangles break the bound, so little is scanned:
//
//   1. Pairwise cross products around a sample give, for all triangles at once, their orientation, whether they hold
//      the sample, and their height there. The first such sample is the vertex itself: it is there because the surface
//      needs it. Triangles that are not positive, too thin, or that break the bound at the sample, are crossed out.
//   2. Bit sets hold which intervals (i, j) can still be triangulated, and which of those are part of a whole. If the
//      ring is none of them, the vertex stays, and not one row was scanned.
//   3. The triangles that are left are scanned, short intervals first, each only until its energy exceeds the best.
//      Where one breaks the bound, the sample that shows it crosses out others: 1 and 2 again.
//
// Any triangulation of the ring by positive triangles covers its inside exactly, so no test examines edges.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "fit/patch.h"
#include "fit/rules.h"
#include "fit/triangle_error.h"

namespace scarp {

class RingSearch {
 public:
  /// Longer rings are ignored: at most two in ten thousand are.
  static constexpr std::size_t kMostCorners = 16;

  /// The errors stay alive.
  explicit RingSearch(const TriangleError& error, const ShapeRule& shape = {})
      : error_(error), shape_(shape), more_z_(error.field_count() - 1) {}

  /// True if the ring has a triangulation whose triangles are positive, keep the limit of `error` and have an allowed
  /// shape, those around the hub excluded; then the one with the least energy is found. `hub` is where the vertex is;
  /// `witness` a sample that has spoken against the ring last time, and afterwards, if the answer is no, the one that
  /// did now. REQUIRES: 3 <= ring.size() <= kMostCorners.
  bool find(std::span<const FitCorner> ring, const FitCorner& hub, Point& witness);

  /// Energy of the triangulation that was found. Ties go to the first triangle in the order of the search.
  float energy() const { return cost_[0][size_ - 1]; }
  /// Its triangles in few bits: the middle corner of each, in order (Patch::RingTriangle).
  std::uint64_t code() const;
  /// Its triangles with their errors.
  void triangles(std::vector<Patch::RingTriangle>& list) const;

  /// The triangles of a code, their errors not known.
  static void decode(std::uint64_t code, std::size_t corners, std::vector<Patch::RingTriangle>& list);

 private:
  using Set = std::uint32_t;  // set of corners

  /// A table over intervals first < last.
  template <class T>
  using Table = std::array<std::array<T, kMostCorners>, kMostCorners>;

  void look_from(Point sample);
  void keep_positive();
  void keep_shapely(const FitCorner& hub);
  template <class AddMore>
  bool cross_out_by(const AddMore& add_more);
  bool cross_out();
  bool connect();
  bool is_needed(std::size_t first, std::size_t last) const {
    return ((needed_from_[first] >> last | needed_to_[last] >> first) & 1) != 0;
  }
  bool improve(std::size_t first, std::size_t last, Point& witness);

  const TriangleError& error_;
  ShapeRule shape_;
  std::size_t size_ = 0;
  std::span<const FitCorner> ring_;
  std::array<double, kMostCorners> x_, y_, z_;            // corners as seen from a sample
  std::vector<std::array<double, kMostCorners>> more_z_;  // heights of the second field on
  double limit_ = 0;                                      // limit of that sample
  Table<double> cross_;                                   // products of them
  Table<double> square_;                                  // squares of edges and diagonals, where there is a floor of
                                                          // shapes
  std::array<Set, kMostCorners> right_of_;                // last by first: where they are not positive
  Table<Set> allowed_;                                    // middles of triangles that are not crossed out
  Table<Set> choices_;                                    // those with intervals that have triangulations on both sides
  std::array<Set, kMostCorners> needed_from_, needed_to_;
  Table<float> cost_, worst_, energy_;  // cost of the best triangulation; errors and energy of its triangle at the
                                        // interval
  Table<std::uint8_t> middle_;
};

}  // namespace scarp
