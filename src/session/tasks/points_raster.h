// Scattered points for commands that read rasters.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "scarp/io.h"
#include "session/options/given_options.h"
#include "session/tasks/runner.h"
#include "session/text/json.h"

namespace scarp::cli {

/// The surface through all points as a raster, drawn into cells of --cell-size. While it lives, readers of its thread
/// find the raster under the name of the first file.
class PointsRaster {
 public:
  /// Reads the points by their options. Fails like make_points_mesh() and draw_surface().
  static Result<std::unique_ptr<PointsRaster>> make(const GivenOptions& given, const Runner& runner);
  ~PointsRaster();

  /// `given` with the raster as its only input, without the options that reading the points has consumed.
  GivenOptions options(const GivenOptions& given) const;

  std::uint64_t count() const;  ///< number of points
  double cell_size() const;
  const std::vector<std::string>& warnings() const;

 private:
  struct Impl;
  explicit PointsRaster(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

/// "points" of a report, and a line of a summary.
Json describe(const PointsRaster& raster);
std::string points_line(const PointsRaster& raster);

}  // namespace scarp::cli
