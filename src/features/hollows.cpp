#include "features/hollows.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "base/parallel.h"

namespace scarp::features {
namespace {

struct Side {
  Hollow rise = Hollow::kNone;
  std::int32_t level = 0;  // samples of the same height as the centre
  bool is_cut = false;     // no other samples follow
};

class Profiles {
 public:
  Profiles(const grid::Raster& raster, double height) : raster_(raster), height_(height) {}

  Hollow at(Point p) const {
    if (!raster_.is_valid(p)) return Hollow::kNone;
    // Most samples are rejected here.
    std::array<Point, 4> ways{};
    std::size_t count = 0;
    for (const Point way : {Point{1, 0}, Point{0, 1}, Point{1, 1}, Point{1, -1}}) {
      if (!falls(p, {-way.x, -way.y}) && !falls(p, way)) ways[count++] = way;
    }
    if (count < 2) return Hollow::kNone;
    // Number of profiles that are at least this good, and number of those with both sides.
    std::array<int, 3> profiles{}, whole{};
    for (std::size_t w = 0; w < count; ++w) {
      const Point way = ways[w];
      const Side before = look(p, {-way.x, -way.y});
      if (before.rise == Hollow::kNone && !before.is_cut) continue;
      const Side behind = look(p, way);
      if (before.is_cut && behind.is_cut) continue;
      if (std::abs(before.level - behind.level) > 1) continue;
      const Hollow good = before.is_cut   ? behind.rise
                          : behind.is_cut ? before.rise
                                          : std::min(before.rise, behind.rise);
      for (std::size_t k = 1; k <= static_cast<std::size_t>(good); ++k) {
        ++profiles[k];
        whole[k] += before.is_cut || behind.is_cut ? 0 : 1;
      }
    }
    for (const Hollow good : {Hollow::kClear, Hollow::kFaint}) {
      const auto k = static_cast<std::size_t>(good);
      if (profiles[k] >= 2 && whole[k] >= 1) return good;
    }
    return Hollow::kNone;
  }

 private:
  bool has_height(Point p) const {
    return p.x >= 0 && p.y >= 0 && p.x < raster_.cols && p.y < raster_.rows && raster_.is_valid(p);
  }
  bool falls(Point p, Point way) const {
    const Point q{p.x + way.x, p.y + way.y};
    return has_height(q) && raster_.at(q) < raster_.at(p);
  }

  Side look(Point p, Point way) const {
    const float here = raster_.at(p);
    Side side;
    side.is_cut = true;
    bool is_level = true;
    for (std::int32_t k = 1; k <= kHollowReach; ++k) {
      const Point q{p.x + k * way.x, p.y + k * way.y};
      if (!has_height(q)) return side;
      const float there = raster_.at(q);
      is_level = is_level && there == here;
      if (is_level) {
        ++side.level;
        continue;
      }
      side.is_cut = false;
      if (there < here) return side;
      const double rise = double{there} - double{here};
      if (rise >= height_ / 2) side.rise = Hollow::kFaint;
      if (rise >= height_) {
        side.rise = Hollow::kClear;
        return side;
      }
    }
    side.is_cut = false;
    return side;
  }

  const grid::Raster& raster_;
  double height_;
};

}  // namespace

std::vector<Hollow> find_hollows(const grid::Raster& raster, double height, int threads) {
  return find_hollows(raster, height, threads, 0, raster.rows);
}

std::vector<Hollow> find_hollows(const grid::Raster& raster, double height, int threads, std::int32_t begin,
                                 std::int32_t end) {
  const auto cols = static_cast<std::size_t>(raster.cols), rows = static_cast<std::size_t>(end - begin);
  std::vector<Hollow> hollows(cols * rows, Hollow::kNone);
  const Profiles profiles(raster, height);
  parallel_for(rows, threads, [&](std::size_t row) {
    for (std::size_t col = 0; col < cols; ++col)
      hollows[row * cols + col] = profiles.at({static_cast<std::int32_t>(col), begin + static_cast<std::int32_t>(row)});
  });
  return hollows;
}

}  // namespace scarp::features
