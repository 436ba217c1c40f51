#include "grid/affine_map.h"
#include "grid/local_frame.h"
#include "scarp/io.h"

namespace scarp {

std::optional<PlaceInSource> place_in_source(const Frame& frame, const RasterInfo& info, int rows) {
  if (!frame.is_affine() || grid::is_degenerate(frame.affine)) return {};
  const std::array<double, 6> samples = map_affine(info, rows);
  PlaceInSource place;
  place.crs = info.crs;
  if (samples == frame.affine) return place;
  // The columns of the linear part are one unit of x, and one of y, in samples.
  const grid::MapToSamples to_samples(frame.affine);
  const grid::SamplePosition zero = to_samples.position(0, 0), x = to_samples.way(1, 0), y = to_samples.way(0, 1);
  for (const std::size_t k : {std::size_t{0}, std::size_t{3}}) {
    const double* t = &samples[k];
    place.to_source[k] = t[0] + t[1] * zero.col + t[2] * zero.row;
    place.to_source[k + 1] = t[1] * x.col + t[2] * x.row;
    place.to_source[k + 2] = t[1] * y.col + t[2] * y.row;
  }
  return place;
}

}  // namespace scarp
