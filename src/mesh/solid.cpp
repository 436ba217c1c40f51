// Facts about a solid as printing software sees it, and solids that pass the checks of such software.
//
// Such software reads positions as float32 and merges vertices at equal positions. So positions are rounded and merged
// before judging. The requirements for a surface: every edge runs once in each direction, the triangles at each vertex
// form one fan, every triangle has an area, and each part encloses a volume.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <locale>
#include <numeric>
#include <sstream>
#include <utility>

#include "mesh/close_solid.h"
#include "mesh/exact_orient.h"
#include "mesh/half_edges.h"
#include "scarp/mesh.h"

namespace scarp {
namespace {

constexpr const char* kPlacementEntry = "placement";

float rounded(double value) { return static_cast<float>(value) + 0.0f; }  // and no −0

/// The triangles, with the lowest vertex id at each position.
std::vector<std::uint32_t> weld(const std::vector<float>& places, const std::vector<std::uint32_t>& triangles) {
  const std::size_t count = places.size() / 3;
  std::vector<std::uint32_t> order(count), first(count);
  std::iota(order.begin(), order.end(), 0u);
  const auto place = [&](std::uint32_t v) {
    const float* p = &places[3 * std::size_t{v}];
    return std::array{p[0], p[1], p[2]};
  };
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return place(a) != place(b) ? place(a) < place(b) : a < b; });
  for (std::size_t k = 0; k < count; ++k) {
    const bool is_new = k == 0 || place(order[k]) != place(order[k - 1]);
    first[order[k]] = is_new ? order[k] : first[order[k - 1]];
  }
  std::vector<std::uint32_t> welded(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) welded[i] = first[triangles[i]];
  return welded;
}

class Inspection {
 public:
  explicit Inspection(const Mesh& mesh) : origin_(mesh.origin), places_(mesh.positions.size()) {
    for (std::size_t i = 0; i < places_.size(); ++i) places_[i] = rounded(mesh.positions[i]);
    triangles_ = weld(places_, mesh.triangles);
    twins_ = mesh::build_twins(triangles_);
  }

  SolidFacts run() {
    facts_.triangles = triangles_.size() / 3;
    find_extent();
    for (std::size_t t = 0; t < facts_.triangles; ++t) facts_.degenerate += is_degenerate(t);
    count_faulty_edges();
    if (facts_.faulty_edges == 0) count_pinched_vertices();
    find_parts();
    return facts_;
  }

 private:
  std::array<double, 3> at(std::uint32_t v) const {
    const float* p = &places_[3 * std::size_t{v}];
    return {double{p[0]}, double{p[1]}, double{p[2]}};
  }

  void find_extent() {
    if (triangles_.empty()) return;
    low_ = at(triangles_[0]);
    std::array<double, 3> high = low_;
    for (const std::uint32_t v : triangles_) {
      for (std::size_t k = 0; k < 3; ++k) {
        low_[k] = std::min(low_[k], at(v)[k]);
        high[k] = std::max(high[k], at(v)[k]);
      }
    }
    for (std::size_t k = 0; k < 3; ++k) {
      facts_.low[k] = origin_[k] + low_[k];
      facts_.high[k] = origin_[k] + high[k];
    }
  }

  bool is_degenerate(std::size_t t) const {
    const auto a = at(triangles_[3 * t]), b = at(triangles_[3 * t + 1]), c = at(triangles_[3 * t + 2]);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
      if (mesh::exact_orient({a[u], a[v]}, {b[u], b[v]}, {c[u], c[v]}) != 0) return false;
    }
    return true;
  }

  void count_faulty_edges() {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (std::uint32_t h = 0; h < twins_.size(); ++h) {
      if (twins_[h] == mesh::kNoHalfEdge)
        edges.push_back(std::minmax(triangles_[h], triangles_[mesh::next_half_edge(h)]));
    }
    std::sort(edges.begin(), edges.end());
    facts_.faulty_edges = static_cast<std::uint64_t>(std::unique(edges.begin(), edges.end()) - edges.begin());
  }

  void count_pinched_vertices() {
    std::vector<std::uint8_t> fans(places_.size() / 3, 0);
    std::vector<bool> is_seen(triangles_.size(), false);
    for (std::uint32_t h = 0; h < triangles_.size(); ++h) {
      if (is_seen[h]) continue;
      std::uint8_t& count = fans[triangles_[h]];
      if (count < 2) facts_.pinched_vertices += ++count == 2;
      for (std::uint32_t around = h; !is_seen[around]; around = twins_[mesh::previous_half_edge(around)])
        is_seen[around] = true;
    }
  }

  void find_parts() {
    std::vector<bool> is_seen(static_cast<std::size_t>(facts_.triangles), false);
    std::vector<std::uint32_t> pending;
    for (std::uint32_t start = 0; start < facts_.triangles; ++start) {
      if (is_seen[start]) continue;
      is_seen[start] = true;
      pending.push_back(start);
      double volume = 0;
      while (!pending.empty()) {
        const std::uint32_t t = pending.back();
        pending.pop_back();
        volume += volume_under(t);
        for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
          const std::uint32_t beside = twins_[h] == mesh::kNoHalfEdge ? t : twins_[h] / 3;
          if (is_seen[beside]) continue;
          is_seen[beside] = true;
          pending.push_back(beside);
        }
      }
      ++facts_.parts;
      facts_.inside_out += !(volume > 0);
      facts_.volume += volume;
    }
  }

  /// Volume below the triangle down to the lowest vertex; negative for a triangle that faces down.
  double volume_under(std::uint32_t t) const {
    const auto a = at(triangles_[3 * t]), b = at(triangles_[3 * t + 1]), c = at(triangles_[3 * t + 2]);
    const double area = ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
    return area * ((a[2] - low_[2]) + (b[2] - low_[2]) + (c[2] - low_[2])) / 3;
  }

  std::array<double, 3> origin_, low_{};
  std::vector<float> places_;
  std::vector<std::uint32_t> triangles_, twins_;
  SolidFacts facts_;
};

}  // namespace

void place_mesh(Mesh& mesh, const Placement& placement) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const std::size_t k = i % 3;
    mesh.positions[i] =
        double{rounded(((mesh.origin[k] - placement.origin[k]) + mesh.positions[i]) * placement.scale[k])};
  }
  mesh.origin = {0, 0, 0};
  mesh.normals.clear();
  const auto &o = placement.origin, &s = placement.scale;
  mesh.metadata[kPlacementEntry] = fmt::format("{} {} {} {} {} {}", o[0], o[1], o[2], s[0], s[1], s[2]);
}

bool undo_placement(Mesh& mesh) {
  const auto told = mesh.metadata.find(kPlacementEntry);
  if (told == mesh.metadata.end()) return false;
  std::istringstream text(told->second);
  text.imbue(std::locale::classic());
  Placement placement;
  for (double& number : placement.origin) text >> number;
  for (double& number : placement.scale) text >> number;
  if (!text) return false;
  for (const double number : placement.scale) {
    if (!(number > 0) || !std::isfinite(number)) return false;
  }
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    mesh.positions[i] = (mesh.origin[i % 3] + mesh.positions[i]) / placement.scale[i % 3];
  }
  mesh.origin = placement.origin;
  mesh.metadata.erase(told);
  return true;
}

Result<Mesh> build_solid(Mesh terrain, double base) {
  terrain.normals.clear();
  terrain.uvs.clear();
  terrain.colors.clear();
  terrain.channels.clear();
  terrain.channel_count = 0;
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < terrain.positions.size(); ++i) {
    terrain.positions[i] = double{rounded(terrain.positions[i])};
    if (i % 3 == 2) lowest = std::min(lowest, terrain.origin[2] + terrain.positions[i]);
  }
  if (!mesh::is_below_all(terrain, base)) {
    return fail(ErrorKind::kUsage,
                fmt::format("the base, at {:.10g}, is not below the lowest vertex, which is at {:.10g}", base, lowest));
  }
  mesh::close_solid(terrain, base, true);
  const SolidFacts facts = measure_solid(terrain);
  if (!facts.is_solid()) {
    return fail(
        ErrorKind::kPromise,
        fmt::format("rounded to float32 the solid is not closed ({}): the mesh is too fine for its size, so ask "
                    "for a larger error or a larger size",
                    facts.list_faults()));
  }
  return terrain;
}

std::string SolidFacts::list_faults() const {
  std::string text;
  const auto add = [&](std::uint64_t count, const char* one, const char* many) {
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, count == 1 ? one : many);
  };
  if (triangles == 0) return "no triangles";
  add(degenerate, "degenerate triangle", "degenerate triangles");
  add(faulty_edges, "faulty edge", "faulty edges");
  add(pinched_vertices, "pinched vertex", "pinched vertices");
  add(inside_out, "part inside out", "parts inside out");
  return text;
}

SolidFacts measure_solid(const Mesh& mesh) { return Inspection(mesh).run(); }

}  // namespace scarp
