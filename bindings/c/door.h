// Common parts of all functions of the C interface: statuses, messages, structs of any version. No exception escapes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <exception>
#include <new>
#include <string>

#include "scarp/result.h"
#include "scarp/run.h"
#include "scarp_c.h"
#include "session/text/tile_counts.h"

namespace scarp::door {

/// Stores the error's message, with options by their names in the interface.
scarp_status report(const Error& error);
scarp_status report(ErrorKind kind, const std::string& sentence);
/// Replaces "--max-error" and "-e" by "max_error", or the name given to name_option().
std::string in_words_of_door(const std::string& sentence);
/// Renames an option for callers and messages. kUsage if there is no such option.
Result<void> name_option(const std::string& name, const std::string& shown);
/// The option with this changed name, "--num-threads" for "threads"; empty if there is none.
std::string find_named_here(const std::string& name);
/// Reports the current exception.
scarp_status report_exception();

/// Runs `work`, which returns a scarp_status.
template <class Work>
scarp_status guarded(Work&& work) noexcept {
  try {
    return work();
  } catch (...) {
    return report_exception();
  }
}

/// A refusal from inside a call, reported by guarded().
struct Refused {
  Error error;
};

constexpr const char* name_of(const scarp_field*) { return "scarp_field"; }
constexpr const char* name_of(const scarp_points*) { return "scarp_points"; }
constexpr const char* name_of(const scarp_options*) { return "scarp_options"; }
constexpr const char* name_of(const scarp_report*) { return "scarp_report"; }
constexpr const char* name_of(const scarp_volumes*) { return "scarp_volumes"; }
constexpr const char* name_of(const scarp_live_options*) { return "scarp_live_options"; }
constexpr const char* name_of(const scarp_live_cell*) { return "scarp_live_cell"; }

/// True if a struct, of any version, can have this size.
constexpr bool is_struct_size(std::uint32_t size) {
  constexpr std::uint32_t kLargest = 1 << 16;  // most uninitialised values are larger
  return size >= 2 * sizeof(std::uint32_t) && size <= kLargest;
}

/// Throws Refused for a struct with a missing or wrong size.
template <class T>
void check_size(const T* given) {
  if (is_struct_size(given->struct_size)) return;
  const std::string name = name_of(given);
  throw Refused{{ErrorKind::kUsage, "the " + name + " is not initialised: its struct_size is " +
                                        std::to_string(given->struct_size) + ", and should be sizeof(" + name + ")"}};
}

/// A struct of this version with the caller's members; the other members have the defaults of init.
template <class T>
T known(const T* given, void (*init)(T*, std::uint32_t)) {
  T all;
  init(&all, sizeof all);
  if (given == nullptr) return all;
  check_size(given);
  std::memcpy(&all, given, std::min<std::size_t>(given->struct_size, sizeof all));
  return all;
}

/// Fills in the caller's part of the struct.
template <class T>
void hand_out(const T& all, T* out) {
  check_size(out);
  const std::uint32_t size = out->struct_size;
  std::memcpy(out, &all, std::min<std::size_t>(size, sizeof all));
  out->struct_size = size;
}

/// `counts`: the tiles written by the call; may be null.
ProgressCallback progress_of(const scarp_options& asked, const cli::TileCounts* counts = nullptr);

}  // namespace scarp::door
