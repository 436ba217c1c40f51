// The samples of a raster at their places on the globe, as straight rows.
#pragma once

#include "scarp/height_field.h"
#include "scarp/tile.h"

namespace scarp::tiles {

class SampleRows {
 public:
  /// Borrows `field` and `place`.
  SampleRows(const HeightField& field, const RasterPlace& place);

  /// Like NodeSource::visit_samples(), for a raster in degrees; `turn` is added to x.
  Result<void> visit_in_degrees(const DegreeBox& box, double turn, const SampleVisitor& visit) const;
  /// Visits the samples of a raster in another CRS. Each 16th sample of each 16th row is placed exactly, others by
  /// bilinear interpolation; near poles all are exact. REQUIRES: place.to_degrees.
  Result<void> visit_placed(const DegreeBox& box, const SampleVisitor& visit) const;

 private:
  struct Window {
    int col = 0, row = 0, cols = 0, rows = 0;

    bool is_empty() const { return cols <= 0 || rows <= 0; }
  };
  class Reach;

  std::array<double, 2> to_raster(double x, double y) const;
  Window window_over(const Reach& reach) const;
  /// Reads the window in bands of rows, a multiple of 16 each.
  template <class Take>
  Result<void> read_bands(const Window& window, const Take& take) const;
  void visit_one_by_one(const Window& window, int row, double longitude, const float* heights,
                        const SampleVisitor& visit) const;

  const HeightField& field_;
  const RasterPlace& place_;
  double determinant_ = 0;
};

}  // namespace scarp::tiles
