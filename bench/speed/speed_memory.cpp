// Peak memory of the engine on a raw raster, from samples in memory to the frozen mesh, including samples, minus the
// process's memory before.
//
//   speed_memory RASTER COLS ROWS ERROR [--order dominant|greedy] [--threads N]     one JSON line

#include "engines.h"
#include "pieces/freeze.h"

namespace {

/// Peak resident bytes of this process so far.
std::size_t peak_memory() {
  const bench::File status = bench::open_file("/proc/self/status", "r");
  char line[256];
  unsigned long long kilobytes = 0;
  while (std::fgets(line, sizeof line, status.get()) != nullptr) {
    if (std::sscanf(line, "VmHWM: %llu kB", &kilobytes) == 1) return 1024 * kilobytes;
  }
  bench::die("/proc/self/status tells no VmHWM");
}

}  // namespace

int main(int argc, char** argv) {
  const bench::Arguments arguments(argc, argv,
                                   "speed_memory RASTER COLS ROWS ERROR [--order dominant|greedy] [--threads N]");
  const double error = arguments.number(3);
  const bool is_greedy = arguments.value("--order", "dominant") == "greedy";
  const int threads = arguments.number("--threads", 1);
  const std::size_t before = peak_memory();
  const bench::RawRaster raw = bench::read_raw(arguments);
  bench::EngineRun run = is_greedy ? bench::refine_greedily(raw, error) : bench::refine_dominantly(raw, error, threads);
  const scarp::pieces::SampleHeights heights(bench::view_of(raw));
  const scarp::Frame frame = scarp::grid_frame(raw.rows);
  const scarp::grid::VertexLattice lattice;
  scarp::pieces::MeltDown melting(std::move(run.domain.tin), {heights, lattice, frame, true}, threads);
  melting.order();
  const scarp::Mesh mesh = melting.finish();
  std::printf("{\"samples\": %zu, \"order\": \"%s\", \"threads\": %d, \"vertices\": %zu, \"bytes\": %zu}\n",
              raw.samples.size(), bench::name_of(run.order), threads, mesh.vertex_count(), peak_memory() - before);
}
