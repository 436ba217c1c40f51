#include "geom/scan_kernels.h"

#include <cctype>
#include <cstdlib>
#include <string_view>
#include <vector>

#include "geom/scan_kernels_task.h"

namespace scarp {

namespace {

bool is_same_name(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](char x, char y) { return lower(x) == lower(y); });
}

const ScanKernels& choose_kernels() {
  const std::span<const ScanKernels> available = available_kernels();
  if (const char* wanted = std::getenv("SCARP_KERNEL")) {
    for (const ScanKernels& kernels : available) {
      if (is_same_name(kernels.name, wanted)) return kernels;
    }
  }
  return available.front();
}

}  // namespace

const ScanKernels& scan_kernels() {
  static const ScanKernels& kernels = choose_kernels();
  return kernels;
}

std::span<const ScanKernels> available_kernels() {
  static const std::vector<ScanKernels> all = [] {
    const std::span<const ScanKernels> vectors = detail::vector_scan_kernels();
    std::vector<ScanKernels> kernels(vectors.begin(), vectors.end());
    kernels.push_back(detail::scalar_scan_kernels());
    return kernels;
  }();
  return all;
}

}  // namespace scarp
