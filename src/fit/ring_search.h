// The best triangulation of the ring around a removed vertex.
//
// Klincsek's dynamic programme: the best triangulation between corners i and j of the ring is the best over all q
// between them with the triangle (i, q, j). Most of the k³/6 triangles break the bound, so few are scanned:
//
//   1. Pairwise cross products around a sample give, for all triangles at once, their orientation, whether they contain
//      the sample, and their height there. The first sample is the vertex itself, which exists because the surface
//      needs it. Triangles are excluded if they are not positive, too thin, or break the bound at the sample.
//   2. Bit sets mark the intervals (i, j) that can still be triangulated, and those that a triangulation of the whole
//      ring can use. If the whole ring cannot be triangulated, the vertex stays, and no row was scanned.
//   3. The remaining triangles are scanned, short intervals first, each only until its energy exceeds the best.
//      If a triangle breaks the bound at a sample, steps 1 and 2 are repeated with this sample, which excludes other
//      triangles.
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

namespace scarp::fit {

class RingSearch {
 public:
  /// Longer rings, at most two in ten thousand, are not searched.
  static constexpr std::size_t kMostCorners = 16;

  /// The errors must outlive this object.
  explicit RingSearch(const TriangleError& error, const ShapeRule& shape = {})
      : error_(error), shape_(shape), more_z_(error.field_count() - 1) {}

  /// Finds the triangulation of the ring with the least energy. Its triangles are positive and within the limit of
  /// `error`, and their shapes are allowed if the triangles around the hub are removed. False if there is no such
  /// triangulation. `hub`: position of the vertex. `witness`: a sample that excluded triangles last time; updated if
  /// the result is false. REQUIRES: 3 <= ring.size() <= kMostCorners.
  bool find(std::span<const FitCorner> ring, const FitCorner& hub, Point& witness);

  /// Energy of the triangulation found. In a tie the first triangle in the order of the search wins.
  float energy() const { return cost_[0][size_ - 1]; }
  /// Its triangles in few bits: their middle corners in the order of Patch::RingTriangle.
  std::uint64_t code() const;
  /// Its triangles with their errors.
  void triangles(std::vector<Patch::RingTriangle>& list) const;

  /// The triangles of a code, with unknown errors.
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
  std::array<double, kMostCorners> x_, y_, z_;            // corners relative to a sample
  std::vector<std::array<double, kMostCorners>> more_z_;  // heights of the fields after the first
  double limit_ = 0;                                      // limit of that sample
  Table<double> cross_;                                   // cross products of the corners
  Table<double> square_;                                  // squares of edges and diagonals, if there is a floor of
                                                          // shapes
  std::array<Set, kMostCorners> right_of_;                // last by first: where they are not positive
  Table<Set> allowed_;                                    // middles of triangles that are not excluded
  Table<Set> choices_;                                    // allowed middles with triangulations on both sides
  std::array<Set, kMostCorners> needed_from_, needed_to_;
  Table<float> cost_, worst_, energy_;  // cost of the best triangulation; errors and energy of its triangle at the
                                        // interval
  Table<std::uint8_t> middle_;
};

}  // namespace scarp::fit
