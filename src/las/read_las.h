// Points of LAS and LAZ files: those that a selection wants, in the order of the file.
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <optional>
#include <vector>

#include "las/bytes.h"
#include "las/copc.h"
#include "las/header.h"
#include "scarp/result.h"
#include "scarp/run.h"

namespace scarp::las {

enum class Returns { kAll, kFirst, kLast, kOnly };

struct Selection {
  std::bitset<256> classes = std::bitset<256>().set();
  Returns returns = Returns::kAll;
  bool has_overlap = true, has_withheld = false;
  std::optional<Extent> extent = std::nullopt;
};

/// Every point of the file counts once: as used, or by the first reason that omits it, in this order.
struct Tally {
  std::array<std::uint64_t, 256> classes{};  ///< all points but those outside or withheld, used or not
  std::uint64_t outside = 0, withheld = 0, other_classes = 0, overlap = 0, other_returns = 0, used = 0;

  void add(const Tally& other);
};

struct Points {
  std::vector<double> x, y, z;
  Tally tally;
};

/// The points on `threads` threads (0: all cores), which do not change the result. Memory for them grows as they are
/// decoded, whatever the header announces; besides, each thread has about a megabyte, and the points of a chunk. Fails
/// with kInput for a file that is damaged or cut off, and with kCancelled. REQUIRES: the header of that source.
Result<Points> read_points(const Source& source, const Header& header, const Selection& selection, const Run& run);

}  // namespace scarp::las
