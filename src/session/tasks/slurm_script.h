// A script that hands a plan to SLURM: an array of shares, and what joins them when all have ended.
#pragma once

#include <cstdint>
#include <string>

namespace scarp::cli {

/// `plan`: path of the plan file. `memory`: bytes of a share. Run as "bash SCRIPT OUTPUT".
std::string slurm_script(const std::string& plan, std::uint64_t shards, std::uint64_t memory);

}  // namespace scarp::cli
