#include "measure/judge_kernels.h"

#include <vector>

#include "base/instruction_sets.h"

namespace scarp::judge {

const JudgeKernels& judge_kernels() {
  static const JudgeKernels& kernels = choose_kernels(available_judge_kernels());
  return kernels;
}

std::span<const JudgeKernels> available_judge_kernels() {
  static const std::vector<JudgeKernels> all = [] {
    const std::span<const JudgeKernels> vectors = detail::vector_judge_kernels();
    std::vector<JudgeKernels> kernels(vectors.begin(), vectors.end());
    kernels.push_back(detail::scalar_judge_kernels());
    return kernels;
  }();
  return all;
}

}  // namespace scarp::judge
