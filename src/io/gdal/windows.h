// Reading a raster window by window.
#pragma once

#include <fmt/format.h>
#include <gdal.h>

#include <algorithm>
#include <chrono>
#include <string>

#include "io/gdal/session.h"
#include "scarp/result.h"
#include "scarp/run.h"

namespace scarp::gdal {

struct Window {
  int col = 0, row = 0, cols = 0, rows = 0;
};

constexpr int kWindowSamples = 1 << 18;  // 2 MB of doubles

/// The order in which a raster is read, so that each block of the file is read once. A window consists of as many whole
/// blocks as fit kWindowSamples. It has full rows if the blocks do. A larger block is read in successive slices, which
/// are the windows of one stack.
class WindowOrder {
 public:
  WindowOrder(GDALRasterBandH band, int cols, int rows);

  /// Number of stacks. Their rows are ordered from the top.
  std::size_t count() const { return across_ * ((static_cast<std::size_t>(rows_) - 1) / stack_rows() + 1); }
  Window stack(std::size_t i) const;
  /// Rows of a window; may exceed the rows of a stack, which is then a single window.
  int rows_at_once() const { return size_.rows; }
  /// Number of stacks that fit the block cache at once.
  std::size_t most_at_once() const { return most_at_once_; }

 private:
  std::size_t stack_rows() const { return static_cast<std::size_t>(stack_rows_); }

  int cols_, rows_, stack_rows_ = 1;
  Window size_;
  std::size_t across_ = 1, most_at_once_ = 1;
};

/// The first unreadable row of a window, found by reading it row by row; for an error message.
template <class Read>
std::string name_damaged_rows(Session& session, const Window& window, Read read) {
  for (int row = window.row; row < window.row + window.rows; ++row) {
    session.clear();
    if (!read(Window{window.col, row, window.cols, 1}) || session.failed()) return fmt::format("row {}", row);
  }
  return fmt::format("rows {} to {}", window.row, window.row + window.rows - 1);
}

/// Calls read(window) -> bool once. Fails with kInput if read() returns false or GDAL reports a failure, since a driver
/// may report a failure and still return zeros. The message names `path`.
template <class Read>
Result<void> read_or_explain(Session& session, const Window& window, const std::string& path, Read read) {
  session.clear();
  if (read(window) && !session.failed()) return {};
  const std::string reason = session.reason();
  if (session.out_of_memory()) {
    return fail(ErrorKind::kInput,
                fmt::format("{}: the machine refuses the memory that reading it needs ({})", path, reason));
  }
  return fail(ErrorKind::kInput, fmt::format("{}: {} cannot be read, the file is truncated or damaged: {}", path,
                                             name_damaged_rows(session, window, read), reason));
}

/// The raster whose windows are read.
struct Extent {
  const std::string& path;
  int cols = 0, rows = 0;
};

/// Reports to the callback at most ten times a second.
class ReadProgress {
 public:
  ReadProgress(const Extent& raster, const ProgressCallback& progress) : raster_(raster), progress_(progress) {}
  /// Counts the samples of another window as read. Fails with kCancelled if the callback requests it.
  Result<void> add(const Window& window);

 private:
  using Clock = std::chrono::steady_clock;
  const Extent raster_;
  const ProgressCallback& progress_;
  Clock::time_point last_ = Clock::now();
  double samples_ = 0;
};

/// Calls use(window) -> Result<void> for the windows of a stack.
template <class Use>
Result<void> for_each_slice(const Window& stack, int rows_at_once, Use use) {
  for (int row = 0; row < stack.rows; row += std::min(rows_at_once, stack.rows - row)) {
    const Window window{stack.col, stack.row + row, stack.cols, std::min(rows_at_once, stack.rows - row)};
    SCARP_RETURN_IF_ERROR(use(window));
  }
  return {};
}

/// Calls read(window) -> bool for all windows, stack by stack. Fails as read_or_explain() does, and with kCancelled if
/// the callback requests it.
template <class Read>
Result<void> for_each_window(Session& session, GDALRasterBandH band, const Extent& raster,
                             const ProgressCallback& progress, Read read) {
  const WindowOrder order(band, raster.cols, raster.rows);
  ReadProgress done(raster, progress);
  for (std::size_t i = 0; i < order.count(); ++i) {
    const auto all = for_each_slice(order.stack(i), order.rows_at_once(), [&](const Window& window) {
      const auto seen = read_or_explain(session, window, raster.path, read);
      return seen ? done.add(window) : seen;
    });
    SCARP_RETURN_IF_ERROR(all);
  }
  return {};
}

}  // namespace scarp::gdal
