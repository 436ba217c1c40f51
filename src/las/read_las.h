// Reads the selected points of LAS and LAZ files, in the order of the file.
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <functional>
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

/// Every point of the file is counted once: either as used, or under the first reason to omit it, in the order of the
/// fields.
struct Tally {
  std::array<std::uint64_t, 256> classes{};  ///< all points, used or not, except those outside or withheld
  std::uint64_t outside = 0, withheld = 0, other_classes = 0, overlap = 0, other_returns = 0, used = 0;

  void add(const Tally& other);
};

struct Points {
  std::vector<double> x, y, z;
  Tally tally;
};

/// Receives the points of consecutive parts, in the order of the file; an error ends the reading.
using TakePoints = std::function<Result<void>(const Points&)>;

/// read_points() for points that one array cannot hold.
Result<Tally> read_points(const Source& source, const Header& header, const Selection& selection, const Run& run,
                          const TakePoints& take);

/// Reads the points on `run.threads` threads (0: all cores), whose number does not change the result. The memory for
/// points grows as they are decoded, whatever the header announces. In addition, each thread needs about a megabyte and
/// the points of a chunk. Fails with kInput for a damaged or truncated file, and with kCancelled. REQUIRES: the header
/// of that source.
Result<Points> read_points(const Source& source, const Header& header, const Selection& selection, const Run& run);

}  // namespace scarp::las
