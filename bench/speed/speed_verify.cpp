// Times one verification of Scarp's finished mesh by the scan kernels: every triangle is scanned once against the
// mesh's threshold. No proof needs less work, so refinement is measured in multiples of it.
//
//   speed_verify RASTER COLS ROWS ERROR [SIDE]     one JSON line
//
// Triangles are first sorted by tiles of SIDE samples (256); the buffer of each tile covers all of its triangles.
// "seconds": time of the scans, with samples in the cache if they fit; "load_seconds": time to fill the buffers and
// their blocks. One thread; one pass as warm-up, then a timed pass.

#include <algorithm>
#include <array>
#include <map>
#include <utility>
#include <vector>

#include "engines.h"
#include "geom/scan_kernels.h"
#include "refine/tile.h"
#include "scarp/version.h"

namespace {

struct Patch {
  std::vector<std::array<scarp::Point, 3>> triangles;
  scarp::Point low{INT32_MAX, INT32_MAX}, high{0, 0};

  scarp::refine::TileWindow window() const { return {low.x, low.y, high.x - low.x + 1, high.y - low.y + 1}; }
};

void add(Patch& patch, const std::array<scarp::Point, 3>& corners) {
  patch.triangles.push_back(corners);
  for (const scarp::Point p : corners) {
    patch.low = {std::min(patch.low.x, p.x), std::min(patch.low.y, p.y)};
    patch.high = {std::max(patch.high.x, p.x), std::max(patch.high.y, p.y)};
  }
}

std::vector<Patch> sort_by_tiles(const scarp::tin::Triangulation& tin, int side) {
  std::map<std::pair<int, int>, Patch> patches;
  for (scarp::tin::Triangle t = 0; t < tin.triangle_count(); ++t) {
    if (tin.is_outside(t)) continue;
    const std::array corners{tin.point(tin.origin(3 * t)), tin.point(tin.origin(3 * t + 1)),
                             tin.point(tin.origin(3 * t + 2))};
    const int x = (corners[0].x + corners[1].x + corners[2].x) / 3,
              y = (corners[0].y + corners[1].y + corners[2].y) / 3;
    add(patches[{y / side, x / side}], corners);
  }
  std::vector<Patch> sorted;
  for (auto& [key, patch] : patches) {
    const scarp::refine::TileWindow window = patch.window();
    if (std::max(window.cols, window.rows) > scarp::geom::kMaxTileSide)
      bench::die("the triangles of a tile reach farther than a buffer holds");
    sorted.push_back(std::move(patch));
  }
  return sorted;
}

/// One thread's buffers.
class Verifier {
 public:
  Verifier(const bench::RawRaster& raw, double threshold) : field_(bench::field_of(raw)), threshold_(threshold) {}

  struct Pass {
    bench::Times load, scan;
    std::uint64_t compared = 0, decided_exactly = 0, broken = 0;
  };

  Pass verify(const std::vector<Patch>& patches) {
    Pass pass;
    for (const Patch& patch : patches) {
      const bench::Stopwatch loading;
      if (const auto loaded = tile_.load(field_, patch.window()); !loaded) bench::die(loaded.error().message);
      pass.load += loading.read();
      localize(patch);
      const bench::Stopwatch scanning;
      scan(pass);
      pass.scan += scanning.read();
    }
    return pass;
  }

 private:
  void localize(const Patch& patch) {
    corners_.clear();
    for (const auto& triangle : patch.triangles) {
      std::array<scarp::geom::TilePoint, 3> corners{};
      for (std::size_t k = 0; k < 3; ++k)
        corners[k] = scarp::geom::tile_point(triangle[k].x - patch.low.x, triangle[k].y - patch.low.y);
      corners_.push_back(corners);
    }
    hits_.resize(corners_.size());
  }

  void scan(Pass& pass) {
    const scarp::geom::TileView& view = tile_.view();
    pass.compared += scarp::geom::scan_kernels().scan(view, threshold_, corners_, {}, hits_.data());
    const scarp::metric::HeightMetric metric({view.samples, static_cast<std::int32_t>(view.stride), view.rows},
                                             threshold_);
    for (std::size_t i = 0; i < hits_.size(); ++i) {
      if (hits_[i].error == 0) continue;
      ++pass.decided_exactly;
      const std::array corners{scarp::geom::point_of(corners_[i][0]), scarp::geom::point_of(corners_[i][1]),
                               scarp::geom::point_of(corners_[i][2])};
      pass.broken += metric.find_candidate(corners, metric.fit(corners, {})).has_value() ? 1 : 0;
    }
  }

  scarp::HeightField field_;
  double threshold_;
  scarp::refine::Tile tile_;
  std::vector<std::array<scarp::geom::TilePoint, 3>> corners_;
  std::vector<scarp::geom::ScanHit> hits_;
};

}  // namespace

int main(int argc, char** argv) {
  const bench::Arguments arguments(argc, argv, "speed_verify RASTER COLS ROWS ERROR [SIDE]");
  const bench::RawRaster raster = bench::read_raw(arguments);
  const double error = arguments.number(3);
  const scarp::refine::DomainMesh domain = bench::refine_dominantly(raster, error, 1).domain;
  const auto patches = sort_by_tiles(domain.tin, arguments.count() > 4 ? static_cast<int>(arguments.number(4)) : 256);
  Verifier verifier(raster, error);
  verifier.verify(patches);
  const Verifier::Pass pass = verifier.verify(patches);
  if (pass.broken != 0) bench::die("the mesh breaks its bound in " + std::to_string(pass.broken) + " triangles");
  bench::print_result(scarp::version(), pass.scan, domain.tin.vertex_count(), domain.tin.triangle_count(),
                      ", \"kernel\": \"" + std::string(scarp::geom::scan_kernels().name) +
                          "\", \"load_seconds\": " + std::to_string(pass.load.cpu()) +
                          ", \"decided_exactly\": " + std::to_string(pass.decided_exactly));
}
