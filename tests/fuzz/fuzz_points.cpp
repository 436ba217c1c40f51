// Any bytes as text of columns: points for which simplify_points() satisfies its guarantee, or an error with a message.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "io/points/point_source.h"
#include "scarp/measure.h"
#include "scarp/points.h"

namespace {

constexpr std::size_t kMostPoints = 200;

void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  scarp::PointOptions options;
  options.max_error = data[0] / 4.0;
  options.float32_positions = data[1] % 2 == 0;
  options.run.threads = 1;
  const auto policy = static_cast<scarp::DuplicatePolicy>(data[1] / 2 % 5);
  options.duplicates = policy;
  const auto points = scarp::io::decode_columns({data + 2, size - 2}, "fuzz.csv", {});
  if (!points) {
    require(points.error().kind == scarp::ErrorKind::kInput || points.error().kind == scarp::ErrorKind::kUsage);
    require(points.error().message.find('\n') == std::string::npos);
    return 0;
  }
  if (points->size() > kMostPoints) return 0;
  const auto result = scarp::simplify_points(*points, options);
  if (!result) {
    require(!result.error().message.empty() && result.error().kind != scarp::ErrorKind::kInternal);
    return 0;
  }
  const auto judged = scarp::measure_points(*points, result->simplified.mesh, policy);
  require(judged.has_value());
  require(judged->uncovered == 0);
  require(judged->max_error == result->simplified.measurement.max_error);
  double largest = *options.max_error;
  for (const double z : points->z) largest = std::max(largest, std::abs(z));
  const double judges_rounding = 1e-12 * largest;
  if (result->simplified.stop == scarp::StopReason::kMaxError)
    require(judged->max_error <= *options.max_error + judges_rounding);
  return 0;
}
