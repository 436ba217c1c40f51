#include "refine/lazy_levels.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <vector>

#include "base/bits.h"
#include "base/point.h"

namespace scarp::refine {

namespace {

using Id = tin::TileMesh::Id;
using Limits = std::numeric_limits<float>;

// The bits of a positive float, read as an integer, are its logarithm except for a curve within each octave. That
// suffices for an estimate, and is the same on every machine.
constexpr int kMantissaBits = 23;
constexpr int kBucketBits = 3;  // 8 buckets per octave
constexpr unsigned kSlack = 2;  // in buckets; a candidate up to this far below the level is inserted at once

std::int64_t bits_of(float value) { return bit_cast<std::int32_t>(value); }

/// First in, first out. An emptied bucket reuses its memory.
class Bucket {
 public:
  bool empty() const { return head_ == ids_.size(); }
  void push(Id t) { ids_.push_back(t); }
  Id pop() {
    const Id t = ids_[head_++];
    if (empty()) {
      ids_.clear();
      head_ = 0;
    }
    return t;
  }

 private:
  std::vector<Id> ids_;
  std::size_t head_ = 0;
};

/// Keys are those of TileScanner, or estimates: the bits of an error above a low word of 0, which no candidate has (the
/// complement of a point of a tile is never 0).
class Levels {
 public:
  Levels(tin::TileMesh& mesh, TileScanner& scanner, AreaPower power)
      : mesh_(mesh),
        scanner_(scanner),
        power_(power),
        floor_(bits_of(static_cast<float>(std::clamp<double>(scanner.threshold(), Limits::min(), Limits::max())))),
        base_(floor_ >> (kMantissaBits - kBucketBits)) {
    std::vector<Id> all(mesh.triangle_count());
    for (Id t = 0; t < all.size(); ++t) all[t] = t;
    scanner.scan(mesh, all, {});
    for (const Id t : all) {
      if (mesh[t].key > 0) push(t);
    }
  }

  DominantRun run(std::size_t most) {
    for (Id t = 0; next(t);) {
      if (mesh_.vertex_count() >= most) {
        done_.finished = false;
        return done_;
      }
      insert(t);
    }
    return done_;
  }

 private:
  static bool is_estimate(std::int64_t key) { return key > 0 && static_cast<std::uint32_t>(key) == 0; }

  unsigned bucket_of(std::int64_t key) const {
    return static_cast<unsigned>(
        std::clamp<std::int64_t>((key >> (32 + kMantissaBits - kBucketBits)) - base_, 0, kBuckets - 1));
  }

  void push(Id t) {
    const unsigned bucket = bucket_of(mesh_[t].key);
    buckets_[bucket].push(t);
    filled_ |= std::uint64_t{1} << bucket;
    ++done_.moves;
  }

  /// Finds the triangle whose candidate is to be inserted; false if there is none.
  bool next(Id& t) {
    for (;;) {
      if (filled_ == 0) {
        if (!sweep(t)) return false;
        if (scan(t) != 0) return true;
        continue;
      }
      const auto level = static_cast<unsigned>(63 - std::countl_zero(filled_));
      t = buckets_[level].pop();
      if (buckets_[level].empty()) filled_ &= ~(std::uint64_t{1} << level);
      std::int64_t key = mesh_[t].key;
      if (key <= 0 || bucket_of(key) < level) continue;  // now another triangle, which waits elsewhere or need not wait
      if (is_estimate(key)) {
        key = scan(t);
        if (key == 0) continue;
        if (bucket_of(key) + kSlack < level) {
          push(t);
          continue;
        }
      }
      return true;
    }
  }

  /// Finds the next triangle that was never scanned, cyclically; false if a whole round found none.
  bool sweep(Id& t) {
    for (;;) {
      while (cursor_ < mesh_.triangle_count() && !is_estimate(mesh_[cursor_].key)) ++cursor_;
      if (cursor_ < mesh_.triangle_count()) {
        has_found_ = true;
        t = cursor_++;
        return true;
      }
      if (!has_found_) return false;
      has_found_ = false;
      cursor_ = 0;
    }
  }

  std::int64_t scan(Id t) {
    scanner_.scan(mesh_, {&t, 1}, {});
    return mesh_[t].key;
  }

  std::int64_t twice_area(Id t) const {
    const auto& corners = mesh_[t].corners;
    return orient(geom::point_of(corners[0]), geom::point_of(corners[1]), geom::point_of(corners[2]));
  }
  static std::int64_t log_of(std::int64_t area) { return bits_of(static_cast<float>(area)); }

  void insert(Id t) {
    const geom::TilePoint p = candidate_of(mesh_[t].key);
    const std::int64_t error = mesh_[t].key >> 32, area = log_of(twice_area(t));
    mesh_.find_cavity(t, p);
    for (const Id fresh : mesh_.fill_cavity(p)) {
      if (mesh_.is_outside(fresh)) continue;
      const std::int64_t fresh_area = twice_area(fresh);
      if (fresh_area == 1) continue;  // holds no sample but its corners (Pick)
      const std::int64_t growth = log_of(fresh_area) - area;
      const std::int64_t guess = error + (power_ == AreaPower::kHalf ? growth >> 1 : growth);
      mesh_[fresh].key = std::clamp(guess, floor_, bits_of(Limits::max())) << 32;
      if (bucket_of(mesh_[fresh].key) > 0) push(fresh);
    }
    ++done_.insertions;
  }

  static constexpr int kBuckets = 64;

  tin::TileMesh& mesh_;
  TileScanner& scanner_;
  AreaPower power_;
  std::int64_t floor_;  // smallest estimate; never 0, which means that no triangle waits
  std::int64_t base_;   // value of the lowest bucket
  std::array<Bucket, kBuckets> buckets_;
  std::uint64_t filled_ = 0;  // bit per bucket
  Id cursor_ = 0;             // position of the sweep
  bool has_found_ = false;    // in this round of the sweep
  DominantRun done_;
};

}  // namespace

DominantRun refine_lazily(tin::TileMesh& mesh, TileScanner& scanner, AreaPower power, std::size_t most) {
  return Levels(mesh, scanner, power).run(most);
}

}  // namespace scarp::refine
