// Set threads and memory of a call, follow its progress, cancel it or end it early. The result changes only if a run
// ends early, or if Effort::kAuto finds too little memory for removal.
//
// Example:
//     scarp::Run run;  // SimplifyOptions::run, MeasureOptions::run, …
//     run.threads = 2;
//     run.memory.limit = std::uint64_t{4} << 30;
//     run.progress = [](const scarp::Progress& now) {
//       std::printf("%s: %.0f %%\n", std::string(now.pass).c_str(), 100 * now.fraction);
//       return true;  // false cancels the call
//     };
#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

#pragma GCC visibility push(default)

namespace scarp {

// Progress and cancellation.

struct Progress {
  std::string_view pass;  ///< "read", "refine", "fit", "search", "measure" or "topology"; valid during the call only
  double fraction = 0;    ///< 0..1 of this pass: an estimate that never decreases within a pass
  std::uint64_t vertices = 0;  ///< vertices so far; 0 if the pass does not count them
  double max_error = 0;        ///< current max error in z units; 0 if the pass does not know it
};

/// Called on the thread that called the library, at most a few times a second. Return false to cancel: the call then
/// fails with ErrorKind::kCancelled.
using ProgressCallback = std::function<bool(const Progress&)>;

struct Memory {
  /// Memory limit of the whole process; 0: no limit. Strips, threads and the blocks of the file are chosen to fit the
  /// limit. A run that does not fit fails before the work begins, or as soon as the mesh exceeds the limit. The memory
  /// of a call is estimated, not counted. DEFAULT: 0.
  std::uint64_t limit = 0;
  /// The part of the limit already in use: by the program, by samples or the cache of their file. DEFAULT: 0.
  std::uint64_t taken = 0;
  /// Bytes per vertex that the caller will need to write the mesh, in addition to the mesh. Used by simplify() only.
  /// DEFAULT: 80, more than GLB needs.
  std::uint64_t per_vertex = 80;
};

/// Settings of any call. Each function lists the members that it reads, unless it reads all.
struct Run {
  int threads = 0;  ///< 0: all cores, but one for work too short to share. Never changes the result. DEFAULT: 0.
  Memory memory = {};
  ProgressCallback progress = {};
  /// Polled often by simplify() with more than fast effort, from any thread. Once it has returned true, it must always
  /// return true. Removal then ends, and the result is the mesh so far, which satisfies the bound but depends on the
  /// time. A search for a budget ends with the best mesh so far. DEFAULT: never.
  std::function<bool()> is_time_up = {};
  /// Polled in the same way, for a caller that stops waiting. It is a request to end, not a deadline: max effort does
  /// not continue until it returns true. Not polled with a budget. DEFAULT: never.
  std::function<bool()> is_enough = {};
};

struct Work {
  std::uint64_t samples_scanned = 0;    ///< samples compared with a plane
  std::uint64_t triangles_scanned = 0;  ///< triangles scanned
  std::uint64_t queue_moves = 0;        ///< queue entries moved (kHeap) or scanned (kLocal)
  std::uint64_t passes = 0;             ///< passes over the mesh: insertions, or batches
};

}  // namespace scarp

#pragma GCC visibility pop
