#include "measure/judge_kernels.h"

#include <vector>

#include "base/instruction_sets.h"

namespace scarp::judge {

const JudgeKernels& judge_kernels() {
  static const JudgeKernels& kernels = choose_kernels(available_judge_kernels());
  return kernels;
}

std::span<const JudgeKernels> available_judge_kernels() {
  static const std::vector<JudgeKernels> all =
      list_kernels<&detail::scalar_judge_kernels>(detail::vector_judge_kernels());
  return all;
}

}  // namespace scarp::judge
