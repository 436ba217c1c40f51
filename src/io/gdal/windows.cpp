#include "io/gdal/windows.h"

namespace scarp::gdal {

WindowOrder::WindowOrder(GDALRasterBandH band, int cols, int rows) : cols_(cols), rows_(rows) {
  constexpr int kWindowSamples = 1 << 18;  // 2 MB of doubles
  int block_cols = 1, block_rows = 1;
  GDALGetBlockSize(band, &block_cols, &block_rows);
  block_cols = std::clamp(block_cols, 1, cols);
  block_rows = std::clamp(block_rows, 1, rows);
  size_.cols = block_cols == cols ? cols : std::max(block_cols, kWindowSamples / block_rows / block_cols * block_cols);
  size_.cols = std::min(size_.cols, cols);
  const int most_rows = std::max(1, kWindowSamples / size_.cols);
  size_.rows =
      block_rows > most_rows ? most_rows : (block_cols == cols ? most_rows / block_rows * block_rows : block_rows);
  size_.rows = std::min(size_.rows, rows);
  stack_rows_ = std::max(size_.rows, block_rows);
  across_ = (static_cast<std::size_t>(cols) - 1) / static_cast<std::size_t>(size_.cols) + 1;
  most_at_once_ = count();
  if (size_.rows >= block_rows) return;
  // A block being read in slices must remain cached.
  const auto sample = static_cast<GIntBig>(GDALGetDataTypeSizeBytes(GDALGetRasterDataType(band)));
  const GIntBig block = sample * block_cols * block_rows;
  most_at_once_ = static_cast<std::size_t>(std::max<GIntBig>(1, GDALGetCacheMax64() / std::max<GIntBig>(1, block)));
}

Window WindowOrder::stack(std::size_t i) const {
  const int col = static_cast<int>(i % across_ * static_cast<std::size_t>(size_.cols));
  const int row = static_cast<int>(i / across_ * stack_rows());
  return {col, row, std::min(size_.cols, cols_ - col), std::min(stack_rows_, rows_ - row)};
}

Result<void> ReadProgress::add(const Window& window) {
  samples_ += static_cast<double>(window.rows) * window.cols;
  if (!progress_ || Clock::now() - last_ <= std::chrono::milliseconds(100)) return {};
  last_ = Clock::now();
  Progress now;
  now.pass = "read";
  now.fraction = samples_ / raster_.rows / raster_.cols;
  if (!progress_(now)) return fail(ErrorKind::kCancelled, raster_.path + ": reading was cancelled");
  return {};
}

}  // namespace scarp::gdal
