// Common parts of all functions of the C door: statuses, sentences, structs of any age, and no exception that goes out.
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

/// Keeps the sentence, in the words of the door: an option by its name there.
scarp_status report(const Error& error);
scarp_status report(ErrorKind kind, const std::string& sentence);
/// "--max-error" and "-e" become "max_error", or the name that name_option() gave.
std::string in_words_of_door(const std::string& sentence);
/// How callers and sentences name an option from now on. kUsage if there is no such option.
Result<void> name_option(const std::string& name, const std::string& shown);
/// "--num-threads" of "threads": an option by its name here; empty where no option has another name here.
std::string find_named_here(const std::string& name);
/// Reports the exception that is being handled.
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

/// A call that is refused from within; guarded() reports it.
struct Refused {
  Error error;
};

constexpr const char* name_of(const scarp_field*) { return "scarp_field"; }
constexpr const char* name_of(const scarp_points*) { return "scarp_points"; }
constexpr const char* name_of(const scarp_options*) { return "scarp_options"; }
constexpr const char* name_of(const scarp_report*) { return "scarp_report"; }

/// True if a size is that of a struct, of any version.
constexpr bool is_struct_size(std::uint32_t size) {
  constexpr std::uint32_t kLargest = 1 << 16;  // values in uninitialised memory are larger, mostly
  return size >= 2 * sizeof(std::uint32_t) && size <= kLargest;
}

/// Throws Refused for a struct whose size was never set, or set to something else.
template <class T>
void check_size(const T* given) {
  if (is_struct_size(given->struct_size)) return;
  const std::string name = name_of(given);
  throw Refused{{ErrorKind::kUsage, "the " + name + " is not initialised: its struct_size is " +
                                        std::to_string(given->struct_size) + ", and should be sizeof(" + name + ")"}};
}

/// The caller's part of a struct; the rest has the defaults of init.
template <class T>
T known(const T* given, void (*init)(T*, std::uint32_t)) {
  T all;
  init(&all, sizeof all);
  if (given == nullptr) return all;
  check_size(given);
  std::memcpy(&all, given, std::min<std::size_t>(given->struct_size, sizeof all));
  return all;
}

/// Fills in as much of the caller's struct as it has.
template <class T>
void hand_out(const T& all, T* out) {
  check_size(out);
  const std::uint32_t size = out->struct_size;
  std::memcpy(out, &all, std::min<std::size_t>(size, sizeof all));
  out->struct_size = size;
}

/// `counts`, if not null: the tiles that the call has written.
ProgressCallback progress_of(const scarp_options& asked, const cli::TileCounts* counts = nullptr);

}  // namespace scarp::door
