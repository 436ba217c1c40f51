#include "fit/cut.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <memory>
#include <utility>

#include "base/bits.h"
#include "base/parallel.h"

namespace scarp::fit {

namespace {

/// Triangles of a square are stored block by block, so that neighbours are near each other in memory.
constexpr std::int64_t kBlocksPerSide = 8;
constexpr std::size_t kBlocks = 64;

struct PointBox {
  Point low{kMaxCoordinate, kMaxCoordinate}, high{0, 0};
  void add(Point p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  bool fits() const {
    constexpr std::int32_t kMost = kMaxFitSteps / grid::kLatticeSteps;
    return high.x - low.x <= kMost && high.y - low.y <= kMost;
  }
};

/// The rank of a half-edge in its patch, from the index of its triangle there.
std::size_t rank_in(const std::vector<std::uint32_t>& indices, tin::HalfEdge h) {
  return 3 * std::size_t{indices[h / 3]} + h % 3;
}

}  // namespace

/// Half-edges on the border of a patch: old names, in the order of cutting, and new names.
struct PatchCutter::Borders {
  std::vector<tin::HalfEdge> before, now;
};

/// A triangulation under construction.
struct PatchCutter::Parts {
  tin::Triangulation::Arrays arrays;
  std::vector<tin::Vertex> numbers;  // by old vertex
  std::vector<std::size_t> begins;   // by patch, its first triangle; the last patch: outside
  std::vector<Borders> borders;      // by patch
};

PatchCutter::PatchCutter(const grid::Raster& raster, const tin::Triangulation& tin, const grid::VertexLattice& lattice,
                         const PatchGrid& grid, const FreeSides& free_sides, int threads,
                         const ScatteredSamples* points)
    : raster_(raster), tin_(tin), lattice_(lattice), grid_(grid), free_sides_(free_sides), threads_(threads) {
  constexpr std::int64_t kSteps = grid::kLatticeSteps;
  last_ = points != nullptr ? LatticePoint{points->last().x, points->last().y}
                            : LatticePoint{(raster.cols - 1) * kSteps, (raster.rows - 1) * kSteps};
  const auto squares = [&](std::int32_t samples) {
    return static_cast<std::size_t>((std::int64_t{samples} + grid.shift) / grid.side + 1);
  };
  squares_per_row_ = squares(raster.cols);
  const std::size_t outside = squares_per_row_ * squares(raster.rows);
  const std::vector<std::uint32_t> blocks = assign_squares(outside);
  sort_by(blocks, (outside + 1) * kBlocks);
  begins_.assign(outside + 2, 0);
  for (const std::uint32_t square : square_) ++begins_[square + 1];
  for (std::size_t i = 1; i < begins_.size(); ++i) begins_[i] += begins_[i - 1];
  index_in_patch_.resize(order_.size());
  for (std::size_t n = 0; n < order_.size(); ++n)
    index_in_patch_[order_[n]] = static_cast<std::uint32_t>(n - begins_[square_[order_[n]]]);
  begins_.pop_back();
}

/// Fills square_. Returns each triangle's block, numbered in the order in memory.
std::vector<std::uint32_t> PatchCutter::assign_squares(std::size_t outside) {
  const auto count = static_cast<tin::Triangle>(tin_.triangle_count());
  std::vector<std::uint32_t> blocks(count);
  square_.resize(count);
  const std::int64_t side = 3 * std::int64_t{grid_.side}, shift = 3 * std::int64_t{grid_.shift};
  const auto assign = [&](tin::Triangle t) {
    if (tin_.is_outside(t)) {
      square_[t] = static_cast<std::uint32_t>(outside);
      blocks[t] = static_cast<std::uint32_t>(outside * kBlocks);
      return;
    }
    const auto [a, b, c] = tin_.corners(t);
    const std::int64_t x = (std::int64_t{a.x} + b.x + c.x) / lattice_.steps + shift;
    const std::int64_t y = (std::int64_t{a.y} + b.y + c.y) / lattice_.steps + shift;
    const auto square = static_cast<std::size_t>(y / side) * squares_per_row_ + static_cast<std::size_t>(x / side);
    const auto block =
        static_cast<std::size_t>(y % side * kBlocksPerSide / side * kBlocksPerSide + x % side * kBlocksPerSide / side);
    square_[t] = static_cast<std::uint32_t>(square);
    blocks[t] = static_cast<std::uint32_t>(square * kBlocks + block);
  };
  constexpr std::size_t kChunk = 65'536;
  parallel_for((count + kChunk - 1) / kChunk, threads_, [&](std::size_t chunk) {
    const auto end = std::min<std::size_t>(count, (chunk + 1) * kChunk);
    for (std::size_t t = chunk * kChunk; t < end; ++t) assign(static_cast<tin::Triangle>(t));
  });
  return blocks;
}

void PatchCutter::sort_by(const std::vector<std::uint32_t>& blocks, std::size_t count) {
  std::vector<std::size_t> begins(count + 1, 0);
  for (const std::uint32_t block : blocks) ++begins[block + 1];
  for (std::size_t i = 1; i < begins.size(); ++i) begins[i] += begins[i - 1];
  order_.resize(blocks.size());
  for (tin::Triangle t = 0; t < blocks.size(); ++t) order_[begins[blocks[t]]++] = t;
}

bool PatchCutter::is_inner(tin::HalfEdge h, std::size_t i) const {
  return !tin_.is_constrained(h) && square_[tin_.twin(h) / 3] == i;
}

Patch PatchCutter::cut(std::size_t i, Scratch& scratch, std::vector<tin::Vertex>& vertices) const {
  Patch patch;
  const bool fits = add_nodes(i, scratch, patch, vertices);
  add_faces(i, scratch, patch);
  for (const tin::Vertex v : vertices) scratch.ids[v] = tin::kNone;
  if (fits) {
    lock(patch);
  } else {
    std::fill(patch.locked_.begin(), patch.locked_.end(), std::uint8_t{1});
  }
  return patch;
}

float PatchCutter::height_of(tin::Vertex v) const {
  return lattice_.heights.empty() ? raster_.at(tin_.point(v)) : lattice_.heights[v];
}

bool PatchCutter::add_nodes(std::size_t i, Scratch& scratch, Patch& patch, std::vector<tin::Vertex>& vertices) const {
  vertices.clear();
  if (scratch.ids.size() < tin_.vertex_count()) scratch.ids.resize(tin_.vertex_count(), tin::kNone);
  PointBox box;
  for (std::size_t k = begins_[i]; k < begins_[i + 1]; ++k) {
    for (tin::HalfEdge h = 3 * order_[k]; h < 3 * order_[k] + 3; ++h) {
      const tin::Vertex v = tin_.origin(h);
      if (scratch.ids[v] != tin::kNone) continue;
      scratch.ids[v] = static_cast<std::uint32_t>(vertices.size());
      vertices.push_back(v);
      const Point p = tin_.point(v);
      const std::int32_t round_up = lattice_.steps - 1;
      box.add({p.x / lattice_.steps, p.y / lattice_.steps});
      box.add({(p.x + round_up) / lattice_.steps, (p.y + round_up) / lattice_.steps});
    }
  }
  if (!vertices.empty()) patch.window_ = {box.low, box.high.x - box.low.x + 1, box.high.y - box.low.y + 1};
  patch.nodes_.resize(vertices.size());
  patch.locked_.assign(vertices.size(), 0);
  if (!box.fits()) return false;
  const std::int32_t scale = grid::kLatticeSteps / lattice_.steps;
  bool fits = true;
  for (std::size_t n = 0; n < vertices.size(); ++n) {
    if (!lattice_.fixed.empty()) patch.locked_[n] = lattice_.fixed[vertices[n]];
    const Point p = tin_.point(vertices[n]);
    const float z = height_of(vertices[n]);
    patch.nodes_[n].at = {(p.x - box.low.x * lattice_.steps) * scale, (p.y - box.low.y * lattice_.steps) * scale, z};
    fits = fits && std::abs(z) <= geom::kMaxScanHeight;
  }
  return fits;
}

void PatchCutter::add_faces(std::size_t i, const Scratch& scratch, Patch& patch) const {
  patch.faces_.resize(begins_[i + 1] - begins_[i]);
  for (Patch::Id f = 0; f < patch.faces_.size(); ++f) {
    Patch::Face& face = patch.faces_[f];
    face.worst = face.energy = -1;
    for (unsigned k = 0; k < 3; ++k) {
      const tin::HalfEdge h = 3 * order_[begins_[i] + f] + k, g = tin_.twin(h);
      face.corners[k] = scratch.ids[tin_.origin(h)];
      patch.nodes_[face.corners[k]].face = f;
      if (g == tin::kNone) {
        face.links[k] = tin_.is_constrained(h) ? Patch::kConstrainedSide : Patch::kSide;
      } else if (is_inner(h, i)) {
        face.links[k] = index_in_patch_[g / 3] << 2 | g % 3;
      } else {
        face.links[k] = Patch::kBorder | static_cast<Patch::Link>(patch.fixed_.size());
        patch.fixed_.push_back(h);
      }
    }
  }
}

void PatchCutter::lock(Patch& patch) const {
  constexpr std::int64_t kSteps = grid::kLatticeSteps;
  const auto point_of = [&](Patch::Id v) {
    const FitCorner& at = patch.nodes_[v].at;
    return LatticePoint{at.x + patch.window_.first.x * kSteps, at.y + patch.window_.first.y * kSteps};
  };
  for (const Patch::Face& face : patch.faces_) {
    for (unsigned k = 0; k < 3; ++k) {
      const std::array<Patch::Id, 2> ends{face.corners[k], face.corners[k == 2 ? 0 : k + 1]};
      const std::array<LatticePoint, 2> at{point_of(ends[0]), point_of(ends[1])};
      const Patch::Link link = face.links[k];
      const bool is_fixed = Patch::is_border(link) && !(Patch::is_side(link) && is_on_free_side(at[0], at[1]));
      for (std::size_t i = 0; i < 2; ++i) {
        const bool is_corner = (at[i].x == 0 || at[i].x == last_.x) && (at[i].y == 0 || at[i].y == last_.y);
        if (is_fixed || is_corner) patch.locked_[ends[i]] = 1;
      }
    }
  }
}

/// True for an edge on one of the free sides.
bool PatchCutter::is_on_free_side(const LatticePoint& p, const LatticePoint& q) const {
  if (p.x == q.x) return p.x == 0 ? free_sides_.left : free_sides_.right;
  return p.y == 0 ? free_sides_.top : free_sides_.bottom;
}

tin::Triangulation PatchCutter::join(std::vector<Patch> patches, std::vector<std::vector<tin::Vertex>> vertices,
                                     std::vector<tin::Vertex>& numbers, grid::VertexLattice& joined) const {
  Parts parts;
  auto names = static_cast<tin::Vertex>(tin_.vertex_count());
  for (std::size_t i = 0; i < patches.size(); ++i) {
    while (vertices[i].size() < patches[i].node_count()) vertices[i].push_back(names++);
  }
  parts.numbers.assign(names, 0);
  number_vertices(patches, vertices, parts);
  place_vertices(patches, vertices, parts, joined);
  parts.begins.assign(1, 0);
  for (const Patch& patch : patches) parts.begins.push_back(parts.begins.back() + patch.face_count());
  const std::size_t count = parts.begins.back() + (order_.size() - begins_.back());
  parts.arrays.corners.resize(3 * count);
  parts.arrays.twins.resize(3 * count);
  parts.arrays.flags.resize(count);
  parts.borders.resize(patches.size());
  parallel_for(patches.size(), threads_, [&](std::size_t i) {
    add_patch(patches[i], vertices[i], i, parts);
    patches[i] = {};
  });
  add_outside(parts);
  const auto link = [&](tin::HalfEdge before, tin::HalfEdge now) {
    const tin::HalfEdge twin = tin_.twin(before);
    parts.arrays.twins[now] = twin == tin::kNone ? tin::kNone : name_now(twin, parts);
  };
  parallel_for(patches.size(), threads_, [&](std::size_t i) {
    const auto& [before, now] = parts.borders[i];
    // Both sides of a constrained edge are borders, mostly of the same patch.
    const auto names = make_unfilled<tin::HalfEdge>(3 * (begins_[i + 1] - begins_[i]));
    for (std::size_t n = 0; n < before.size(); ++n) names[rank_in(index_in_patch_, before[n])] = now[n];
    for (std::size_t n = 0; n < before.size(); ++n) {
      const tin::HalfEdge twin = tin_.twin(before[n]);
      if (twin != tin::kNone && square_[twin / 3] == i) {
        parts.arrays.twins[now[n]] = names[rank_in(index_in_patch_, twin)];
      } else {
        link(before[n], now[n]);
      }
    }
  });
  for (std::size_t n = begins_.back(); n < order_.size(); ++n) {
    for (tin::HalfEdge h = 3 * order_[n]; h < 3 * order_[n] + 3; ++h) link(h, name_now(h, parts));
  }
  numbers = std::move(parts.numbers);
  return tin::Triangulation(std::move(parts.arrays));
}

/// The new name of a half-edge on the border of a patch, or outside.
tin::HalfEdge PatchCutter::name_now(tin::HalfEdge before, const Parts& parts) const {
  const std::size_t square = square_[before / 3];
  if (square == count())
    return static_cast<tin::HalfEdge>(3 * (parts.begins.back() + index_in_patch_[before / 3]) + before % 3);
  const auto& [names, now] = parts.borders[square];
  const auto found = std::lower_bound(names.begin(), names.end(), before, [&](tin::HalfEdge a, tin::HalfEdge b) {
    return rank_in(index_in_patch_, a) < rank_in(index_in_patch_, b);
  });
  assert(found != names.end() && *found == before);
  return now[static_cast<std::size_t>(found - names.begin())];
}

void PatchCutter::number_vertices(const std::vector<Patch>& patches,
                                  const std::vector<std::vector<tin::Vertex>>& vertices, Parts& parts) const {
  for (std::size_t i = 0; i < patches.size(); ++i) {
    for (Patch::Id v = 0; v < patches[i].node_count(); ++v) {
      if (patches[i].is_removed(v)) parts.numbers[vertices[i][v]] = tin::kNone;
    }
  }
  tin::Vertex count = 0;
  for (tin::Vertex& number : parts.numbers) {
    if (number != tin::kNone) number = count++;
  }
  parts.arrays.points.resize(count);
}

void PatchCutter::place_vertices(const std::vector<Patch>& patches,
                                 const std::vector<std::vector<tin::Vertex>>& vertices, Parts& parts,
                                 grid::VertexLattice& joined) const {
  const bool has_heights = joined.steps > 1;
  joined.heights.assign(has_heights ? parts.arrays.points.size() : 0, 0);
  joined.fixed.assign(lattice_.fixed.empty() ? 0 : parts.arrays.points.size(), 0);
  const auto place = [&](tin::Vertex number, Point p, float z) {
    parts.arrays.points[number] = p;
    if (has_heights) joined.heights[number] = z;
  };
  const std::int32_t scale = joined.steps / lattice_.steps;
  for (tin::Vertex v = 0; v < tin_.vertex_count(); ++v) {
    if (parts.numbers[v] == tin::kNone) continue;
    const Point p = tin_.point(v);
    place(parts.numbers[v], {p.x * scale, p.y * scale}, has_heights ? height_of(v) : 0);
    if (!lattice_.fixed.empty()) joined.fixed[parts.numbers[v]] = lattice_.fixed[v];
  }
  const std::int32_t shrink = grid::kLatticeSteps / joined.steps;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const Point first = patches[i].window().first;
    for (Patch::Id v = 0; v < patches[i].node_count(); ++v) {
      if (patches[i].is_locked(v) || patches[i].is_removed(v)) continue;
      const FitCorner& at = patches[i].at(v);
      place(parts.numbers[vertices[i][v]],
            {first.x * joined.steps + at.x / shrink, first.y * joined.steps + at.y / shrink}, at.z);
    }
  }
}

/// Writes to the patch's own elements only.
void PatchCutter::add_patch(const Patch& patch, const std::vector<tin::Vertex>& names, std::size_t i,
                            Parts& parts) const {
  const auto base = static_cast<tin::Triangle>(parts.begins[i]);
  Borders& borders = parts.borders[i];
  borders.before = patch.fixed();
  borders.now.resize(borders.before.size());
  for (Patch::Id f = 0; f < patch.face_count(); ++f) {
    const Patch::Face& face = patch.face(f);
    std::uint8_t flags = 0;
    for (unsigned k = 0; k < 3; ++k) {
      const tin::HalfEdge h = 3 * (base + f) + k;
      const Patch::Link link = face.links[k];
      parts.arrays.corners[h] = parts.numbers[names[face.corners[k]]];
      parts.arrays.twins[h] = tin::kNone;
      bool is_constrained = link == Patch::kConstrainedSide;
      if (!Patch::is_border(link)) {
        parts.arrays.twins[h] = 3 * (base + Patch::triangle_of(link)) + Patch::edge_of(link);
      } else if (!Patch::is_side(link)) {
        const Patch::Link n = link & ~Patch::kBorder;
        borders.now[n] = h;
        is_constrained = tin_.is_constrained(borders.before[n]);
      }
      if (is_constrained) flags |= static_cast<std::uint8_t>(1u << k);
    }
    parts.arrays.flags[base + f] = flags;
  }
}

void PatchCutter::add_outside(Parts& parts) const {
  auto t = static_cast<tin::Triangle>(parts.begins.back());
  for (std::size_t n = begins_.back(); n < order_.size(); ++n, ++t) {
    std::uint8_t flags = tin::Triangulation::Arrays::kOutside;
    for (unsigned k = 0; k < 3; ++k) {
      const tin::HalfEdge old = 3 * order_[n] + k;
      parts.arrays.corners[3 * t + k] = parts.numbers[tin_.origin(old)];
      if (tin_.is_constrained(old)) flags |= static_cast<std::uint8_t>(1u << k);
    }
    parts.arrays.flags[t] = flags;
  }
}

}  // namespace scarp::fit
