// Thread-safe conversion between two CRSs.
#include <algorithm>
#include <cmath>
#include <limits>

#include "io/gdal/crs.h"
#include "io/gdal/session.h"

namespace scarp::gdal {

void Passage::Destroy::operator()(OGRCoordinateTransformationH handle) const {
  OCTDestroyCoordinateTransformation(handle);
}

Passage::Passage(const Crs& from, const Crs& to, bool is_strict)
    : from_(OSRClone(from.get())), to_(OSRClone(to.get())), is_strict_(is_strict) {}

bool Passage::usable() const {
  Handle handle = take();
  if (!handle) return false;
  give_back(std::move(handle));
  return true;
}

bool Passage::apply(std::span<double> x, std::span<double> y, std::span<double> z) const {
  constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  if (x.empty()) return true;
  Session quiet;
  Handle handle = take();
  if (!handle) {
    for (const std::span<double> all : {x, y, z}) std::fill(all.begin(), all.end(), kNowhere);
    return false;
  }
  bool all = true;
  constexpr std::size_t kBatch = 4096;
  std::vector<int> success(std::min(x.size(), kBatch));
  for (std::size_t at = 0; at < x.size(); at += kBatch) {
    const std::size_t count = std::min(kBatch, x.size() - at);
    double* heights = z.empty() ? nullptr : z.data() + at;
    OCTTransformEx(handle.get(), static_cast<int>(count), x.data() + at, y.data() + at, heights, success.data());
    for (std::size_t k = 0; k < count; ++k) {
      const bool has_height = z.empty() || std::isfinite(z[at + k]);
      if (success[k] != 0 && std::isfinite(x[at + k]) && std::isfinite(y[at + k]) && has_height) continue;
      x[at + k] = y[at + k] = kNowhere;
      if (!z.empty()) z[at + k] = kNowhere;
      all = false;
    }
  }
  give_back(std::move(handle));
  return all;
}

Passage::Handle Passage::take() const {
  const std::lock_guard lock(mutex_);
  if (!idle_.empty()) {
    Handle handle = std::move(idle_.back());
    idle_.pop_back();
    return handle;
  }
  // By default, GDAL selects one of PROJ's operations by the mean of a call's points. PROJ selects one for each point.
  Session session;
  session.set_option("OGR_CT_OP_SELECTION", "PROJ");
  OGRCoordinateTransformationOptionsH options = OCTNewCoordinateTransformationOptions();
  if (is_strict_) OCTCoordinateTransformationOptionsSetBallparkAllowed(options, FALSE);
  Handle handle(OCTNewCoordinateTransformationEx(from_.get(), to_.get(), options));
  OCTDestroyCoordinateTransformationOptions(options);
  return handle;
}

void Passage::give_back(Handle handle) const {
  const std::lock_guard lock(mutex_);
  idle_.push_back(std::move(handle));
}

}  // namespace scarp::gdal
