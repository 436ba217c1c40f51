// A script that submits a plan to SLURM: an array of jobs for shares, then a job that joins them.
#pragma once

#include <cstdint>
#include <string>

namespace scarp::cli {

/// `plan`: path of the plan file. `memory`: bytes of a share. Run as "bash SCRIPT OUTPUT".
std::string slurm_script(const std::string& plan, std::uint64_t shards, std::uint64_t memory);

}  // namespace scarp::cli
