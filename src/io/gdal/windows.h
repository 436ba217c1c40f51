// Going through a raster window by window.
#pragma once

#include <fmt/format.h>
#include <gdal.h>

#include <algorithm>
#include <chrono>
#include <string>

#include "io/gdal/session.h"
#include "scarp/progress.h"
#include "scarp/result.h"

namespace scarp::gdal {

struct Window {
  int col = 0, row = 0, cols = 0, rows = 0;
};

constexpr int kWindowSamples = 1 << 18;  // 2 MB of doubles

/// A window's size that reads each of the file's blocks once: whole blocks, as many as kWindowSamples hold, and full
/// rows where blocks are full rows. Blocks larger than that are read in slices, one after the other.
inline Window window_size(GDALRasterBandH band, int cols, int rows) {
  int block_cols = 1, block_rows = 1;
  GDALGetBlockSize(band, &block_cols, &block_rows);
  block_cols = std::clamp(block_cols, 1, cols);
  block_rows = std::clamp(block_rows, 1, rows);
  Window window;
  window.cols = block_cols == cols ? cols : std::max(block_cols, kWindowSamples / block_rows / block_cols * block_cols);
  window.cols = std::min(window.cols, cols);
  const int most_rows = std::max(1, kWindowSamples / window.cols);
  window.rows =
      block_rows > most_rows ? most_rows : (block_cols == cols ? most_rows / block_rows * block_rows : block_rows);
  window.rows = std::min(window.rows, rows);
  return window;
}

/// The first row of a window that could not be read, found by reading it again row by row; for a message.
template <class Read>
std::string name_damaged_rows(Session& session, const Window& window, Read read) {
  for (int row = window.row; row < window.row + window.rows; ++row) {
    session.clear();
    if (!read(Window{window.col, row, window.cols, 1}) || session.failed()) return fmt::format("row {}", row);
  }
  return fmt::format("rows {} to {}", window.row, window.row + window.rows - 1);
}

/// Calls read(window) -> bool once. Fails with kInput if it returns false or GDAL has reported a failure meanwhile (a
/// driver may report one and still hand out zeros); `path` is named.
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

/// Calls read(window) -> bool for all windows, rows of windows from the top. Fails as read_or_explain(), with
/// kCancelled if the callback says so; calls the callback at most ten times a second.
template <class Read>
Result<void> for_each_window(Session& session, GDALRasterBandH band, const Extent& raster,
                             const ProgressCallback& progress, Read read) {
  using Clock = std::chrono::steady_clock;
  const Window size = window_size(band, raster.cols, raster.rows);
  auto last = Clock::now();
  for (int row = 0; row < raster.rows; row += size.rows) {
    const int rows = std::min(size.rows, raster.rows - row);
    for (int col = 0; col < raster.cols; col += size.cols) {
      const Window window{col, row, std::min(size.cols, raster.cols - col), rows};
      if (auto done = read_or_explain(session, window, raster.path, read); !done) return done;
      if (progress && Clock::now() - last > std::chrono::milliseconds(100)) {
        last = Clock::now();
        Progress now;
        now.pass = "read";
        now.fraction = (row + static_cast<double>(rows) * (col + window.cols) / raster.cols) / raster.rows;
        if (!progress(now)) return fail(ErrorKind::kCancelled, raster.path + ": reading was cancelled");
      }
    }
    if (row > raster.rows - size.rows) break;  // row + size.rows may overflow
  }
  return {};
}

}  // namespace scarp::gdal
