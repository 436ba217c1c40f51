// Progress messages of a running command.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "scarp/run.h"
#include "session/text/tile_counts.h"

namespace scarp::cli {

/// Shows a run's progress on stderr and turns Ctrl-C into cancellation.
///
/// kLine rewrites one line, starting after one second, with pass, percent, vertices, current error, time left in this
/// pass. kJson prints one object per line, at most five per second plus one at the end of each pass. Its keys are pass,
/// fraction, vertices, max_error, seconds (since construction). In the pass "tiles", the keys tiles, bytes and
/// seconds_left (null before an estimate) replace vertices and max_error.
class ProgressDisplay {
 public:
  enum class Style { kSilent, kLine, kJson };

  explicit ProgressDisplay(Style style);
  /// Erases the line.
  ~ProgressDisplay();
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;

  /// Makes an interrupt in the pass of that name finish the pass (content_with_interrupt()) instead of ending the run.
  void let_interrupt_finish(std::string_view pass) { finished_by_interrupt_ = pass; }
  /// Tiles and bytes so far, shown in the pass "tiles". They must outlive the last pass.
  void show_tiles(const TileCounts& counts) { tiles_ = &counts; }
  /// The callback for the library's options. The display must outlive the call that uses it.
  ProgressCallback callback();
  /// Ends the last pass and erases the line; nothing is shown afterwards. Call after success.
  void finish();

  /// The style for the flags: kJson if requested, else kLine if stderr is a terminal and `quiet` is false, else none.
  static Style choose(bool json, bool quiet);

 private:
  using Clock = std::chrono::steady_clock;

  bool show(const Progress& progress);
  void end_pass();
  bool counts_tiles() const { return tiles_ != nullptr && pass_ == "tiles"; }
  /// Seconds left of this pass.
  std::optional<double> seconds_left() const;
  void print_line();
  void print_json(double fraction) const;
  void erase_line();

  Style style_;
  Clock::time_point start_;
  Clock::time_point pass_start_;
  Clock::time_point last_shown_;
  bool has_pass_ = false;
  bool line_shown_ = false;
  std::string pass_, finished_by_interrupt_;
  double fraction_ = 0;
  std::uint64_t vertices_ = 0;
  double max_error_ = 0;
  const TileCounts* tiles_ = nullptr;
};

}  // namespace scarp::cli
