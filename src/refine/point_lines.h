// Lines through scattered points, as chains of edges.
//
// A chain passes those points of its line that are vertices. Its edges are the chords between successive vertices. So
// the only vertices that it adds to the surface are its ends and vertices that separate two chains. Chords that meet
// are split at the farthest point of their line until none meet. This ends, since whole lines meet only where they have
// the same height.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geom/segments.h"
#include "grid/snapped_points.h"
#include "refine/scattered.h"
#include "scarp/height_field.h"
#include "scarp/result.h"

namespace scarp::refine {

class PointLines {
 public:
  /// Fails with kInput if two lines meet with different heights, which the error names. `points` and `snapped` must
  /// outlive the result.
  static Result<PointLines> build(const PointSet& points, const grid::SnappedPoints& snapped);

  bool empty() const { return lines_.empty(); }
  /// By point: true if a line passes it.
  const std::vector<bool>& on_lines() const { return is_on_line_; }
  /// Points that must be vertices: the ends of lines, and three points per ring.
  std::vector<std::uint32_t> ends() const;
  /// Points to insert to separate chords that meet; empty once no separable chords meet. `is_vertex`: by point.
  std::vector<std::uint32_t> find_splits(const std::vector<bool>& is_vertex) const;
  /// Constrains only the chords and the hull. Returns the number of chords that cannot be constrained, since they cross
  /// others.
  std::uint64_t hold(ScatteredDomain& domain) const;

 private:
  /// Points [begin, end] of a line, of which only the ends are vertices.
  struct Chord {
    std::uint32_t line, begin, end;
  };

  PointLines(const PointSet& points, const grid::SnappedPoints& snapped) : points_(&points), snapped_(&snapped) {}
  Result<void> check_meetings() const;
  std::vector<Chord> find_chords(const std::vector<bool>& is_vertex) const;
  std::uint32_t farthest(const Chord& chord) const;
  Point at(std::uint32_t line, std::uint32_t k) const { return snapped_->at[lines_[line][k]]; }
  geom::Segment segment_of(const Chord& chord) const {
    return {at(chord.line, chord.begin), at(chord.line, chord.end)};
  }

  const PointSet* points_;
  const grid::SnappedPoints* snapped_;
  std::vector<std::vector<std::uint32_t>> lines_;    ///< lattice points; successive points differ
  std::vector<std::vector<std::uint32_t>> sources_;  ///< for each: the point of the set
  std::vector<std::uint32_t> given_;                 ///< for each: the line of the set
  std::vector<bool> is_on_line_;
};

/// By point: true if it is a vertex of the domain.
std::vector<bool> find_vertices(const ScatteredDomain& domain, std::size_t points);

}  // namespace scarp::refine
