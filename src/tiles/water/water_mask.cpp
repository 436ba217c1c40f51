// The water mask of a tile: the share of each texel in polygons.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "base/bits.h"
#include "globe/node_places.h"
#include "tiles/water/tile_waters.h"

namespace scarp::tiles {
namespace {

constexpr int kMaskSide = 256;  ///< texels, as in quantized-mesh
constexpr int kMaskParts = 4;   ///< places per texel in each direction
constexpr int kMaskPlaces = kMaskSide * kMaskParts;

/// The places of a tile inside polygons.
class MaskPlaces {
 public:
  MaskPlaces(const TileWaters& waters, TileId id) : is_water_(std::size_t{kMaskPlaces} * kMaskPlaces, 0) {
    const DegreeBox box = waters.grid.bounds_of(id);
    const globe::NodePlaces nodes(waters.grid, waters.per_turn);
    left_ = nodes.col(box.west);
    per_col_ = kMaskPlaces / (nodes.col(box.east) - left_);
    // Texels are equally spaced in degrees.
    for (int j = 0; j < kMaskPlaces; ++j)
      rows_.push_back(nodes.row(box.north + (box.south - box.north) * ((j + 0.5) / kMaskPlaces)));
  }

  /// Adds a lake by the even-odd rule, shifted by `shift` columns.
  void add(const TileLake& lake, double shift) {
    crossings_.resize(kMaskPlaces);
    for (auto& row : crossings_) row.clear();
    for (const auto& ring : lake.rings) {
      for (std::size_t k = 0; k + 1 < ring.size(); ++k) {
        auto p = ring[k], q = ring[k + 1];
        if (p[1] > q[1]) std::swap(p, q);
        // Half open, so that a vertex on a row counts once.
        const auto first = std::lower_bound(rows_.begin(), rows_.end(), p[1]) - rows_.begin();
        const auto end = std::lower_bound(rows_.begin(), rows_.end(), q[1]) - rows_.begin();
        for (auto j = first; j < end; ++j) {
          const double row = rows_[static_cast<std::size_t>(j)];
          crossings_[static_cast<std::size_t>(j)].push_back(p[0] + (row - p[1]) / (q[1] - p[1]) * (q[0] - p[0]));
        }
      }
    }
    for (std::size_t j = 0; j < crossings_.size(); ++j) {
      std::vector<double>& row = crossings_[j];
      std::sort(row.begin(), row.end());
      for (std::size_t k = 0; k + 1 < row.size(); k += 2) {
        const int begin = place_at(row[k] + shift), end = place_at(row[k + 1] + shift);
        if (begin < end)
          std::fill_n(is_water_.begin() + static_cast<std::ptrdiff_t>(j) * kMaskPlaces + begin, end - begin, 1);
      }
    }
  }

  std::vector<std::uint8_t> mask() const {
    std::vector<std::uint8_t> texels;
    texels.reserve(std::size_t{kMaskSide} * kMaskSide);
    for (std::size_t y = 0; y < kMaskSide; ++y) {
      for (std::size_t x = 0; x < kMaskSide; ++x) {
        unsigned count = 0;
        for (std::size_t j = 0; j < kMaskParts; ++j) {
          for (std::size_t i = 0; i < kMaskParts; ++i)
            count += is_water_[(y * kMaskParts + j) * kMaskPlaces + x * kMaskParts + i];
        }
        texels.push_back(
            static_cast<std::uint8_t>((255 * count + kMaskParts * kMaskParts / 2) / (kMaskParts * kMaskParts)));
      }
    }
    if (std::all_of(texels.begin(), texels.end(), [&](std::uint8_t texel) { return texel == texels.front(); }))
      texels.resize(1);
    return texels;
  }

 private:
  /// The first place whose middle is at or east of this column.
  int place_at(double col) const {
    return static_cast<int>(std::clamp(std::ceil((col - left_) * per_col_ - 0.5), 0.0, double{kMaskPlaces}));
  }

  double left_ = 0, per_col_ = 0;
  std::vector<double> rows_;
  std::vector<std::vector<double>> crossings_;
  std::vector<std::uint8_t> is_water_;
};

}  // namespace

WaterMasks::WaterMasks(const TileWaters& waters) : waters_(&waters) {
  for (const TileLake& lake : waters.lakes) {
    Box box{INFINITY, -INFINITY, INFINITY, -INFINITY};
    for (const auto& ring : lake.rings) {
      for (const auto& [col, row] : ring)
        box = {std::min(box.west, col), std::max(box.east, col), std::min(box.north, row), std::max(box.south, row)};
    }
    boxes_.push_back(box);
  }
}

template <class Use>
void WaterMasks::each_lake(TileId id, const Use& use) const {
  const DegreeBox tile = waters_->grid.bounds_of(id);
  const globe::NodePlaces nodes(waters_->grid, waters_->per_turn);
  const double west = nodes.col(tile.west), east = nodes.col(tile.east);
  const double north = nodes.row(tile.north), south = nodes.row(tile.south);
  const auto turn = static_cast<double>(waters_->per_turn);
  for (std::size_t k = 0; k < boxes_.size(); ++k) {
    const Box& box = boxes_[k];
    if (box.south < north || box.north > south) continue;
    for (const double shift : {-2 * turn, -turn, 0.0, turn, 2 * turn}) {
      if (box.east + shift >= west && box.west + shift <= east) use(waters_->lakes[k], shift);
    }
  }
}

std::vector<std::uint8_t> WaterMasks::draw(TileId id) const {
  std::optional<MaskPlaces> places;
  each_lake(id, [&](const TileLake& lake, double shift) {
    if (!places) places.emplace(*waters_, id);
    places->add(lake, shift);
  });
  return places ? places->mask() : std::vector<std::uint8_t>{0};
}

std::uint64_t WaterMasks::hash(TileId id) const {
  std::uint64_t hash = 0;
  const auto mix = [&](double value) {
    hash = (hash ^ bit_cast<std::uint64_t>(value)) * 0xff51afd7ed558ccd;
    hash ^= hash >> 32;
  };
  each_lake(id, [&](const TileLake& lake, double shift) {
    mix(shift + 1);
    for (const auto& ring : lake.rings) {
      for (const auto& [col, row] : ring) {
        mix(col);
        mix(row);
      }
    }
  });
  return hash;
}

}  // namespace scarp::tiles
