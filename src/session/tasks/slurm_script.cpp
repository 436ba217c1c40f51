#include "session/tasks/slurm_script.h"

#include <fmt/format.h>

#include <filesystem>

#include "session/text/text.h"

namespace scarp::cli {

std::string slurm_script(const std::string& plan, std::uint64_t shards, std::uint64_t memory) {
  std::error_code error;
  const std::string program = std::filesystem::read_symlink("/proc/self/exe", error).string();
  const std::string path = std::filesystem::absolute(plan, error).lexically_normal().string();
  constexpr std::uint64_t kMegabyte = 1'000'000;
  return fmt::format(
      "#!/bin/bash\n"
      "# Makes a set of tiles on a cluster: bash THIS OUTPUT [OPTIONS OF SBATCH]\n"
      "# A share that fails, or whose node is lost, is run again and goes on where it was.\n"
      "set -euo pipefail\n"
      "output=$(realpath -m \"${{1:?give OUTPUT, the set to make}}\")\n"
      "shift\n"
      "scarp=${{SCARP:-{0}}}\n"
      "plan={1}\n"
      "shares=$(sbatch --parsable --requeue --job-name=scarp-tiles --array=1-{2} --cpus-per-task=1 --mem={3}M "
      "--output=\"$plan.%a.log\" --open-mode=append \"$@\" \\\n"
      "  --wrap \"$(printf '%q ' \"$scarp\" tile run \"$plan\") --shard \\$SLURM_ARRAY_TASK_ID/{2} -j 1 --quiet\")\n"
      "finish=$(sbatch --parsable --job-name=scarp-finish --dependency=afterok:\"$shares\" --kill-on-invalid-dep=yes "
      "--output=\"$plan.finish.log\" \"$@\" \\\n"
      "  --wrap \"$(printf '%q ' \"$scarp\" tile finish \"$plan\" \"$output\")\")\n"
      "echo \"$shares $finish\"\n",
      shell_word(program), shell_word(path), shards, (memory + kMegabyte - 1) / kMegabyte);
}

}  // namespace scarp::cli
