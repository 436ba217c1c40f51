// Any bytes as a LAS or LAZ file: points, each counted once, or an error with a message; the same on two threads.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "las/header.h"
#include "las/read_las.h"

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace scarp::las;
  const auto read = [&](std::uint64_t offset, std::span<std::uint8_t> into) {
    require(offset <= size && into.size() <= size - offset);
    std::copy_n(data + offset, into.size(), into.begin());
    return true;
  };
  const Source source{"fuzz.laz", size, read};
  const auto header = read_header(source);
  const auto is_sentence = [](const scarp::Error& error) {
    return error.kind == scarp::ErrorKind::kInput && error.message.starts_with("fuzz.laz: ") &&
           error.message.find('\n') == std::string::npos;
  };
  if (!header) {
    require(is_sentence(header.error()));
    return 0;
  }
  if (header->points > 100'000) return 0;  // few bytes may be many equal points
  Selection selection;
  selection.returns = static_cast<Returns>(size % 4);
  selection.has_withheld = size % 3 == 0;
  if (size % 2 == 0) {
    const auto &a = header->least, &b = header->most;
    selection.extent = {a[0], a[1], a[0] + (b[0] - a[0]) / 3, a[1] + (b[1] - a[1]) / 2};
  }
  scarp::Run run;
  run.threads = 1;
  const auto points = read_points(source, *header, selection, run);
  if (!points) {
    require(is_sentence(points.error()));
    return 0;
  }
  const Tally& tally = points->tally;
  require(tally.used == points->x.size() && points->y.size() == points->x.size() &&
          points->z.size() == points->x.size());
  require(tally.used + tally.outside + tally.withheld + tally.other_classes + tally.overlap + tally.other_returns ==
          header->points);
  require(std::all_of(points->x.begin(), points->x.end(), [](double x) { return std::isfinite(x); }));
  run.threads = 2;
  const auto again = read_points(source, *header, selection, run);
  require(again.has_value() && again->x == points->x && again->z == points->z);
  return 0;
}
