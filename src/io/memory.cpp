// The largest possible size of a raster.
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

#include "scarp/io.h"

namespace scarp {
namespace {

constexpr std::uint64_t kBytesPerSample = 5;  // documented need of simplify(), without vertices

/// Memory available without swapping, as reported by the kernel and limited by the container and by `ulimit -v`.
std::uint64_t available_memory() {
  std::uint64_t available = std::numeric_limits<std::uint64_t>::max();
  std::ifstream meminfo("/proc/meminfo");
  for (std::string key; meminfo >> key;) {
    std::uint64_t kilobytes = 0;
    if (key == "MemAvailable:" && meminfo >> kilobytes) {
      available = kilobytes * 1024;
      break;
    }
    meminfo.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  if (std::uint64_t bytes = 0; std::ifstream("/sys/fs/cgroup/memory.max") >> bytes)
    available = std::min(available, bytes);
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
    available = std::min<std::uint64_t>(available, limit.rlim_cur);
  }
  return available;
}

}  // namespace

std::uint64_t max_samples(std::uint64_t memory_limit) {
  return (memory_limit != 0 ? memory_limit : available_memory()) / kBytesPerSample;
}

}  // namespace scarp
