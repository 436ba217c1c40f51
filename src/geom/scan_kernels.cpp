#include "geom/scan_kernels.h"

#include <vector>

#include "base/instruction_sets.h"
#include "geom/scan_kernels_task.h"

namespace scarp::geom {

const ScanKernels& scan_kernels() {
  static const ScanKernels& kernels = choose_kernels(available_kernels());
  return kernels;
}

std::span<const ScanKernels> available_kernels() {
  static const std::vector<ScanKernels> all = list_kernels<&detail::scalar_scan_kernels>(detail::vector_scan_kernels());
  return all;
}

}  // namespace scarp::geom
