// Tiles with buffers, and triangles in them, for the laws of the scan kernels.
#pragma once

#include <cstring>
#include <random>
#include <vector>

#include "base/point.h"
#include "geom/scan_kernels.h"
#include "laws/fields.h"

namespace scarp::testing {

/// The padding contains values that a reader must ignore.
class ScanTile {
 public:
  explicit ScanTile(const Field& field) {
    view_.cols = field.cols;
    view_.rows = field.rows;
    view_.stride = field.cols + geom::kTilePadding + 3;
    const std::int32_t blocks = (field.cols + geom::kBlock - 1) / geom::kBlock,
                       block_rows = (field.rows + geom::kBlock - 1) / geom::kBlock;
    view_.block_stride = blocks + geom::kTilePadding;
    samples_.assign(static_cast<std::size_t>(view_.stride * (field.rows + geom::kTilePadding)), 1e30f);
    for (std::size_t i = 0; i < samples_.size(); i += 3) samples_[i] = std::numeric_limits<float>::quiet_NaN();
    for (std::int32_t y = 0; y < field.rows; ++y)
      std::copy_n(field.samples.data() + static_cast<std::ptrdiff_t>(y) * field.cols, field.cols,
                  samples_.data() + y * view_.stride);
    low_.assign(static_cast<std::size_t>(view_.block_stride * block_rows), 0);
    high_ = low_;
    view_.samples = samples_.data();
    view_.block_low = low_.data();
    view_.block_high = high_.data();
    fill(geom::available_kernels().back());
  }
  ScanTile(const ScanTile&) = delete;
  ScanTile& operator=(const ScanTile&) = delete;

  float fill(const geom::ScanKernels& kernels) {
    return kernels.fill_blocks(view_, low_.data(), high_.data(), nodata_);
  }

  const geom::TileView& view() const { return view_; }
  std::uint64_t nodata() const { return nodata_; }
  const std::vector<float>& low() const { return low_; }
  const std::vector<float>& high() const { return high_; }
  bool is_nodata(Point p) const { return std::isnan(view_.at(geom::tile_point(p.x, p.y))); }

 private:
  std::vector<float> samples_, low_, high_;
  geom::TileView view_;
  std::uint64_t nodata_ = 0;
};

/// Counter-clockwise triangles within the tile, with valid corners that are anywhere or near each other.
inline std::vector<std::array<geom::TilePoint, 3>> random_triangles(const ScanTile& tile, std::mt19937& random,
                                                                    int count) {
  const geom::TileView& view = tile.view();
  std::vector<std::array<geom::TilePoint, 3>> triangles;
  for (int tries = 0; tries < 50 * count && triangles.size() < static_cast<std::size_t>(count); ++tries) {
    const std::int32_t reach_x = 1 << random() % 13, reach_y = 1 << random() % 13;
    const auto below = [&](std::int32_t n) { return static_cast<std::int32_t>(random() % static_cast<unsigned>(n)); };
    const std::int32_t x = below(view.cols), y = below(view.rows);
    std::array<Point, 3> p;
    for (Point& corner : p)
      corner = {std::min(view.cols - 1, x + below(reach_x + 1)), std::min(view.rows - 1, y + below(reach_y + 1))};
    if (orient(p[0], p[1], p[2]) < 0) std::swap(p[1], p[2]);
    if (orient(p[0], p[1], p[2]) <= 0 || tile.is_nodata(p[0]) || tile.is_nodata(p[1]) || tile.is_nodata(p[2])) continue;
    triangles.push_back(
        {geom::tile_point(p[0].x, p[0].y), geom::tile_point(p[1].x, p[1].y), geom::tile_point(p[2].x, p[2].y)});
  }
  return triangles;
}

inline bool is_same(const geom::ScanHit& a, const geom::ScanHit& b) {
  return std::memcmp(&a.error, &b.error, sizeof a.error) == 0 && a.at == b.at &&
         std::memcmp(&a.guard, &b.guard, sizeof a.guard) == 0;
}

}  // namespace scarp::testing
