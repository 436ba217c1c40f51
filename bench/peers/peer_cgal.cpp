// CGAL's edge collapse (Surface_mesh_simplification) on the full grid of a raw raster.
//
//   peer_cgal RASTER COLS ROWS Z_SCALE POLICY PREFIX EDGES...
//
// For each of the numbers EDGES, descending, writes the mesh once at most that many edges remain. A run that stops
// there yields the same mesh, since the order of collapses does not depend on the end. Surfaces are in PREFIX.EDGES;
// each line has the time so far, without copies. Z_SCALE: as in peer_meshopt. POLICY: lt (Lindstrom and Turk's cost and
// placement, CGAL's default) or gh (Garland and Heckbert's quadrics of planes), both with CGAL's filter against
// inverted normals.

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/Bounded_normal_change_filter.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/GarlandHeckbert_plane_policies.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_cost.h>
#include <CGAL/Surface_mesh_simplification/Policies/Edge_collapse/LindstromTurk_placement.h>
#include <CGAL/Surface_mesh_simplification/edge_collapse.h>
#include <CGAL/version.h>

#include <functional>
#include <string_view>

#include "surface.h"

namespace {

namespace collapse = CGAL::Surface_mesh_simplification;
using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Mesh = CGAL::Surface_mesh<Point>;
using Id = Mesh::Vertex_index;

Mesh mesh_of(const bench::Surface& surface, double z_scale) {
  Mesh mesh;
  for (std::size_t v = 0; v < surface.points.size(); v += 3)
    mesh.add_vertex(Point(surface.points[v], surface.points[v + 1], z_scale * surface.points[v + 2]));
  for (std::size_t t = 0; t < surface.triangles.size(); t += 3)
    mesh.add_face(Id(surface.triangles[t]), Id(surface.triangles[t + 1]), Id(surface.triangles[t + 2]));
  return mesh;
}

/// The mesh without removed parts that have not been collected yet.
bench::Surface surface_of(const Mesh& mesh, double z_scale) {
  bench::Surface surface;
  std::vector<std::uint32_t> names(mesh.number_of_vertices() + mesh.number_of_removed_vertices());
  for (const Id v : mesh.vertices()) {
    names[v] = static_cast<std::uint32_t>(surface.points.size() / 3);
    const Point& p = mesh.point(v);
    surface.points.insert(surface.points.end(), {p.x(), p.y(), p.z() / z_scale});
  }
  for (const auto face : mesh.faces()) {
    for (const Id v : mesh.vertices_around_face(mesh.halfedge(face))) surface.triangles.push_back(names[v]);
  }
  return surface;
}

/// Called before each collapse; stops at the last of the numbers.
class Checkpoints {
 public:
  using Visit = std::function<void(const Mesh& mesh, std::size_t edges, double cpu_seconds)>;
  Checkpoints(std::vector<std::size_t> edges, Visit visit) : edges_(std::move(edges)), visit_(std::move(visit)) {}

  bool stop_at(const Mesh& mesh, std::size_t edges_left) {
    while (next_ < edges_.size() && edges_left <= edges_[next_]) {
      const double now = watch_.cpu();
      visit_(mesh, edges_[next_++], now - spent_on_visits_);
      spent_on_visits_ += watch_.cpu() - now;
    }
    return next_ == edges_.size();
  }

 private:
  std::vector<std::size_t> edges_;
  Visit visit_;
  std::size_t next_ = 0;
  bench::Stopwatch watch_;
  double spent_on_visits_ = 0;
};

/// The copyable handle for CGAL.
struct Stop {
  Checkpoints* checkpoints;

  template <class Cost, class Profile>
  bool operator()(const Cost& /*cost*/, const Profile& profile, std::size_t /*edges*/, std::size_t edges_left) const {
    return checkpoints->stop_at(profile.surface_mesh(), edges_left);
  }
};

template <class CostOf, class Placement>
void collapse_edges(Mesh& mesh, Checkpoints& checkpoints, const CostOf& cost, const Placement& placement) {
  collapse::edge_collapse(
      mesh, Stop{&checkpoints},
      CGAL::parameters::get_cost(cost).get_placement(placement).filter(collapse::Bounded_normal_change_filter<>()));
}

void simplify(Mesh& mesh, Checkpoints& checkpoints, std::string_view policy) {
  if (policy == "gh") {
    const collapse::GarlandHeckbert_plane_policies<Mesh, Kernel> quadrics(mesh);
    collapse_edges(mesh, checkpoints, quadrics.get_cost(), quadrics.get_placement());
  } else {
    collapse_edges(mesh, checkpoints, collapse::LindstromTurk_cost<Mesh>(), collapse::LindstromTurk_placement<Mesh>());
  }
}

}  // namespace

int main(int argc, char** argv) {
  const bench::Arguments arguments(argc, argv, "peer_cgal RASTER COLS ROWS Z_SCALE POLICY PREFIX EDGES...");
  const bench::RawRaster raster = bench::read_raw(arguments);
  const double z_scale = arguments.number(3);
  std::vector<std::size_t> edges;
  for (const std::string& size : arguments.from(6)) edges.push_back(std::stoull(size));
  Mesh mesh = mesh_of(bench::full_grid(raster), z_scale);
  Checkpoints checkpoints(edges, [&](const Mesh& left, std::size_t wanted, double cpu_seconds) {
    const bench::Surface surface = surface_of(left, z_scale);
    bench::write_mesh(arguments[5] + "." + std::to_string(wanted), surface);
    std::printf("{\"version\": \"%s\", \"edges\": %zu, \"cpu_seconds\": %.6f, \"triangles\": %zu}\n", CGAL_VERSION_STR,
                wanted, cpu_seconds, surface.triangles.size() / 3);
    std::fflush(stdout);
  });
  simplify(mesh, checkpoints, arguments[4]);
}
