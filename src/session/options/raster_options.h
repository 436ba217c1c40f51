// The options of every command that reads a raster.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scarp/io.h"
#include "session/options/values.h"

namespace CLI {
class App;
}

namespace scarp::cli {

struct RasterArguments {
  std::vector<std::string> paths;  ///< one, or those of a mosaic
  Given band, nodata, decode, crs, z_scale, z_offset, z_unit, cell_size, resolution;
  std::vector<std::string> extent;

  const std::string& path() const { return paths.front(); }
  /// Adds the options; the paths are arguments of their own.
  void add_to(CLI::App& command);
  Result<ReadOptions> parse() const;
  /// " --band 2 --crs local": those that were given.
  std::string canonical() const;
  /// Completes the library's error about a raster that cannot be read: what else standard input and vector data can be.
  Error explain(Error error) const;
};

/// --nodata: a number or NaN, nothing where it is not given. Fails with kUsage for another word.
Result<std::optional<double>> parse_nodata(const Given& nodata);
/// --fill-distance in samples; without it 100 if nodata is filled, else 0. Fails with kUsage where nothing is filled.
Result<double> parse_fill_distance(const Given& text, bool is_filled);

}  // namespace scarp::cli
