// --memory, and sizes of memory.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "scarp/result.h"
#include "session/options/given_options.h"

namespace scarp::cli {

/// The process's memory limit in bytes; nothing if not given.
Result<std::optional<std::uint64_t>> parse_memory(const GivenOptions& given);

/// Bytes of the code, including GDAL, and of memory that every run uses.
inline constexpr std::uint64_t kProgramBytes = 72'000'000;

/// "1G", "1.5 GiB", "800M" in bytes. k, M, G, T are powers of 1000, and Ki, Mi, Gi, Ti of 1024; a B may follow.
Result<std::uint64_t> parse_bytes(std::string_view option, const std::string& text);

}  // namespace scarp::cli
