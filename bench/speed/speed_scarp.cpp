// Times Scarp's triangulation of a raw raster: domain and refinement until every sample is within ERROR; nothing is
// read, measured or written inside the timed part.
//
//   speed_scarp RASTER COLS ROWS ERROR [MESH]     one JSON line; the mesh for speed_judge
//   speed_scarp RASTER COLS ROWS --find SHARE     the error that keeps about SHARE of the samples

#include <algorithm>
#include <cstring>
#include <limits>

#include "raw.h"
#include "refine/domain.h"
#include "refine/height_judge.h"
#include "refine/refinement.h"
#include "scarp/version.h"

namespace {

scarp::Domain build(const scarp::Raster& raster) {
  auto domain = scarp::build_domain(raster, 0, scarp::grid_frame(raster.rows));
  if (!domain) bench::die(domain.error().message);
  return std::move(*domain);
}

scarp::Domain refine(const bench::RawRaster& raw, double error) {
  const scarp::Raster raster{raw.samples.data(), raw.cols, raw.rows};
  scarp::Domain domain = build(raster);
  const scarp::HeightJudge judge(raster, error);
  scarp::Refinement refinement(judge, domain.tin);
  while (!refinement.done()) refinement.insert_worst();
  return domain;
}

/// Max error is not monotone in the vertices: the smallest that was seen on the way to SHARE.
double find_error(const bench::RawRaster& raw, double share) {
  const scarp::Raster raster{raw.samples.data(), raw.cols, raw.rows};
  scarp::Domain domain = build(raster);
  const scarp::HeightJudge judge(raster, 0);
  scarp::Refinement refinement(judge, domain.tin);
  const double most = share * static_cast<double>(raw.samples.size());
  double error = std::numeric_limits<double>::infinity();
  while (!refinement.done() && static_cast<double>(domain.tin.vertex_count()) < most) {
    refinement.insert_worst();
    error = std::min(error, refinement.worst_error());
  }
  return error;
}

bench::RawMesh mesh_of(const scarp::Triangulation& tin) {
  bench::RawMesh mesh;
  for (scarp::Vertex v = 0; v < tin.vertex_count(); ++v) {
    mesh.vertices.push_back(static_cast<std::uint32_t>(tin.point(v).x));
    mesh.vertices.push_back(static_cast<std::uint32_t>(tin.point(v).y));
  }
  for (scarp::HalfEdge h = 0; h < 3 * tin.triangle_count(); ++h) mesh.triangles.push_back(tin.origin(h));
  return mesh;
}

}  // namespace

int main(int argc, char** argv) {
  const bool finds = argc == 6 && std::strcmp(argv[4], "--find") == 0;
  if (argc != 5 && argc != 6) bench::die("usage: speed_scarp RASTER COLS ROWS (ERROR [MESH] | --find SHARE)");
  const bench::RawRaster raster = bench::read_raw(argv[1], argv[2], argv[3]);
  if (finds) {
    std::printf("%.9g\n", find_error(raster, std::atof(argv[5])));
    return 0;
  }
  const double error = std::atof(argv[4]);
  refine(bench::warm_up_part(raster), error);
  const bench::Stopwatch watch;
  const scarp::Domain domain = refine(raster, error);
  const double wall = watch.wall(), cpu = watch.cpu();
  bench::print_result(scarp::version(), wall, cpu, domain.tin.vertex_count(), domain.tin.triangle_count());
  if (argc == 6) bench::write_raw_mesh(argv[5], mesh_of(domain.tin));
}
