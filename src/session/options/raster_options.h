// Options shared by all commands that read a raster.
#pragma once

#include <optional>

#include "scarp/io.h"
#include "session/options/given_options.h"

namespace scarp::cli {

/// The options for reading: band, extent, resolution, coding, CRS and heights.
Result<ReadOptions> parse_reading(const GivenOptions& given);
/// Completes the library's error about a raster that cannot be read, with the alternatives for standard input and
/// vector data.
Error explain_reading(const GivenOptions& given, Error error);
/// --nodata: a number or NaN; nothing if not given. Fails with kUsage for other words.
Result<std::optional<double>> parse_nodata(const GivenOptions& given);
/// The largest distance from which nodata is filled. DEFAULT: 100 if nodata is filled, else 0.
Result<double> parse_fill_distance(const GivenOptions& given, bool is_filled);

}  // namespace scarp::cli
