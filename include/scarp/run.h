// Choose threads and memory for a call, follow its progress, cancel it or end it early. Nothing here is part of the
// result, but for an early end.
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

/// A snapshot of a running pass.
struct Progress {
  std::string_view pass;  ///< "read", "refine", "fit", "search", "measure" or "topology"; valid during the call only
  double fraction = 0;    ///< 0..1 of this pass; an estimate that never decreases within a pass
  std::uint64_t vertices = 0;  ///< vertices so far; 0 where the pass does not count them
  double max_error = 0;        ///< current max error in z units; 0 where the pass does not know it
};

/// Called from the thread that called the library, a few times a second at most.
/// Return false to cancel: the call then ends with ErrorKind::kCancelled and no result.
using ProgressCallback = std::function<bool(const Progress&)>;

/// Bytes of memory.
struct Memory {
  /// Bytes that the whole process is to stay under; 0: no limit. Strips, threads and the blocks of the file are chosen
  /// to fit. A run that cannot fit is refused: before the work begins, or as soon as the mesh outgrows the limit. The
  /// memory of a call is estimated, not counted. DEFAULT: 0.
  std::uint64_t limit = 0;
  /// The part of the limit that others use: the program, the samples or the cache of their file. DEFAULT: 0.
  std::uint64_t taken = 0;
  /// Bytes a vertex that the caller will use in addition to the mesh, to write it. Read by simplify() alone. DEFAULT:
  /// 80, more than GLB needs.
  std::uint64_t per_vertex = 80;
};

/// The same for all calls; each function lists the members it reads, unless it reads all.
struct Run {
  int threads = 0;  ///< 0: all cores, or one where others would come too late. Never changes the result. DEFAULT: 0.
  Memory memory = {};
  ProgressCallback progress = {};
  /// Read by simplify() with more than fast effort: asked often, on any thread; once true, true for good. Then vertices
  /// are no longer removed, and the mesh so far, which keeps the promise, is the result: it depends on the time. With a
  /// budget the search then ends with the best mesh so far. DEFAULT: never.
  std::function<bool()> is_time_up = {};
  /// Polled in the same way, for a caller who stops waiting. It is a cancel request, not a deadline: max effort does
  /// not use up the time. Not asked with a budget. DEFAULT: never.
  std::function<bool()> is_enough = {};
};

/// Counters of the engine.
struct Work {
  std::uint64_t samples_scanned = 0;    ///< samples compared with a plane
  std::uint64_t triangles_scanned = 0;  ///< triangles scanned
  std::uint64_t queue_moves = 0;        ///< entries moved in the queue (kHeap) or scanned (kLocal)
  std::uint64_t passes = 0;             ///< passes over the mesh: insertions, or batches
};

}  // namespace scarp

#pragma GCC visibility pop
