#include "io/points/point_spool.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>

#include "base/curve.h"
#include "io/spool.h"

namespace scarp::io {

namespace {

constexpr std::size_t kTogether = 1 << 15;  // places read or written at once

}  // namespace

/// A grid of cells over the extent.
class PointSpool::Cells {
 public:
  static constexpr std::uint32_t kSide = 1 << 10;

  explicit Cells(const PointSpool& points) {
    for (std::size_t k = 0; k < 2; ++k) {
      least_[k] = points.least_[k];
      const double size = points.most_[k] - points.least_[k];
      scale_[k] = size > 0 ? kSide / size : 0;
    }
  }
  std::uint32_t operator()(const Place& p) const {
    return static_cast<std::uint32_t>(curve_place(step(0, p.x), step(1, p.y)));
  }

 private:
  std::uint64_t step(std::size_t k, double value) const {
    return static_cast<std::uint64_t>(std::clamp((value - least_[k]) * scale_[k], 0.0, kSide - 1.0));
  }
  std::array<double, 2> least_{}, scale_{};
};

PointSpool::~PointSpool() {
  if (file_ >= 0) ::close(file_);
}

Result<void> PointSpool::write(std::uint64_t first, std::span<const Place> places) {
  if (file_ < 0) {
    SCARP_TRY(file_, open_scratch("points"));
  }
  return write_scratch(file_, first * sizeof(Place), std::as_bytes(places), "points");
}

Result<void> PointSpool::read(std::uint64_t first, std::span<Place> places) const {
  return read_scratch(file_, first * sizeof(Place), std::as_writable_bytes(places), "points");
}

Result<void> PointSpool::add(std::span<const double> x, std::span<const double> y, std::span<const double> z) {
  std::vector<Place> places;
  places.reserve(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) {
    places.push_back({x[i], y[i], z[i]});
    least_ = {std::min(least_[0], x[i]), std::min(least_[1], y[i])};
    most_ = {std::max(most_[0], x[i]), std::max(most_[1], y[i])};
  }
  SCARP_RETURN_IF_ERROR(write(size_, places));
  size_ += places.size();
  return {};
}

template <class Visit>
Result<void> PointSpool::visit_added(const Visit& visit) const {
  std::vector<Place> places;
  for (std::uint64_t first = 0; first < size_; first += kTogether) {
    places.resize(std::min<std::uint64_t>(kTogether, size_ - first));
    SCARP_RETURN_IF_ERROR(read(first, places));
    for (const Place& place : places) {
      SCARP_RETURN_IF_ERROR(visit(place));
    }
  }
  return {};
}

Result<void> PointSpool::divide(std::uint64_t most) {
  const Cells cells(*this);
  std::vector<std::uint32_t> of_cell(std::size_t{Cells::kSide} * Cells::kSide);  // counts, then blocks
  SCARP_RETURN_IF_ERROR(visit_added([&](const Place& place) -> Result<void> {
    ++of_cell[cells(place)];
    return {};
  }));
  std::uint64_t first = size_;
  for (std::uint32_t& cell : of_cell) {
    const std::uint64_t count = cell;
    if (count > most)
      return fail(
          ErrorKind::kMemory,
          fmt::format("the memory limit has space for {} points at a time, and {} of {} lie within 1/{} of their "
                      "extent: allow more memory, or remove points far from all others",
                      most, count, size_, Cells::kSide));
    if (blocks_.empty() || blocks_.back().count + count > most) blocks_.push_back({first, 0});
    blocks_.back().count += count;
    first += count;
    cell = static_cast<std::uint32_t>(blocks_.size() - 1);
  }
  // Each block has a buffer, written when it is full.
  const std::size_t held = std::clamp<std::size_t>(1'000'000 / blocks_.size(), 64, 4096);
  std::vector<std::vector<Place>> buffers(blocks_.size());
  std::vector<std::uint64_t> ends(blocks_.size());
  for (std::size_t i = 0; i < blocks_.size(); ++i) ends[i] = blocks_[i].first;
  const auto flush = [&](std::size_t i) {
    const std::uint64_t at = ends[i];
    ends[i] += buffers[i].size();
    const Result<void> written = write(at, buffers[i]);
    buffers[i].clear();
    return written;
  };
  SCARP_RETURN_IF_ERROR(visit_added([&](const Place& place) -> Result<void> {
    const std::size_t i = of_cell[cells(place)];
    buffers[i].push_back(place);
    if (buffers[i].size() < held) return {};
    return flush(i);
  }));
  for (std::size_t i = 0; i < blocks_.size(); ++i) {
    SCARP_RETURN_IF_ERROR(flush(i));
  }
  return {};
}

Result<void> PointSpool::replace(std::size_t block, const PointSet& points) {
  std::vector<Place> places;
  places.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) places.push_back({points.x[i], points.y[i], points.z[i]});
  SCARP_RETURN_IF_ERROR(write(blocks_[block].first, places));
  size_ -= blocks_[block].count - points.size();
  blocks_[block].count = points.size();
  return {};
}

Result<PointSet> PointSpool::read(std::size_t block) const {
  std::vector<Place> places(blocks_[block].count);
  SCARP_RETURN_IF_ERROR(read(blocks_[block].first, places));
  PointSet points;
  for (auto* const values : {&points.x, &points.y, &points.z}) values->reserve(places.size());
  for (const Place& place : places) {
    points.x.push_back(place.x);
    points.y.push_back(place.y);
    points.z.push_back(place.z);
  }
  return points;
}

}  // namespace scarp::io
