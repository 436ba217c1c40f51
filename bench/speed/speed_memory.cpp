// Peak memory of domain and refinement on a raw raster, samples included, above what the process needs before it
// starts.
//
//   speed_memory RASTER COLS ROWS ERROR     one JSON line

#include <cstring>

#include "raw.h"
#include "refine/domain.h"
#include "refine/height_judge.h"
#include "refine/refinement.h"

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
  if (argc != 5) bench::die("usage: speed_memory RASTER COLS ROWS ERROR");
  const std::size_t before = peak_memory();
  const bench::RawRaster raw = bench::read_raw(argv[1], argv[2], argv[3]);
  const scarp::Raster raster{raw.samples.data(), raw.cols, raw.rows};
  auto domain = scarp::build_domain(raster, 0, scarp::grid_frame(raster.rows));
  if (!domain) bench::die(domain.error().message);
  const scarp::HeightJudge judge(raster, std::atof(argv[4]));
  scarp::Refinement refinement(judge, domain->tin);
  while (!refinement.done()) refinement.insert_worst();
  std::printf("{\"samples\": %zu, \"vertices\": %zu, \"bytes\": %zu}\n", raw.samples.size(), domain->tin.vertex_count(),
              peak_memory() - before);
}
