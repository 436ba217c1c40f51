// Common steps of all raster readers before and after reading samples.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "scarp/io.h"

namespace scarp::io {

/// Fails with kInput if the size is below 2×2, or a side exceeds an int.
Result<void> check_raster_sides(const std::string& name, std::uint64_t cols, std::uint64_t rows);

/// Like check_raster_sides(); also fails with kInput if the raster needs more memory than `options` or the machine
/// allow. The message contains both figures.
Result<void> check_raster_size(const std::string& name, std::uint64_t cols, std::uint64_t rows,
                               const ReadOptions& options, std::uint64_t bands = 1);

/// Allocates the samples; fails with kInput. Call check_raster_size() first.
Result<void> allocate_samples(const std::string& name, OwnedHeightField& field, int threads = 1);

/// Sets valid, min and max; then calls finish_info().
Result<void> finish_raster(OwnedHeightField& field, std::uint64_t infinities, const ReadOptions& options);

/// Warns of `infinities` samples that became nodata. Fails with kInput if all samples are nodata, unless they are read
/// as values.
Result<void> finish_info(OwnedHeightField& field, std::uint64_t infinities, const ReadOptions& options);

/// True if heights differ from the file's values.
bool scales_heights(const ReadOptions& options);
/// Scales integer values by the z_scale and z_offset of settle_heights(), and sets their rounding. REQUIRES: the file
/// declares no scale.
void scale_values(const ReadOptions& options, OwnedHeightField& field);

/// The grid frame, or, if a cell size is given, a frame centred on the raster.
Result<Frame> grid_or_cells(const std::string& name, int cols, int rows, const ReadOptions& options);

/// The frame of a raster without georeference. Fails with kUsage if options.crs requests a position.
Result<Frame> ungeoreferenced_frame(const std::string& name, int cols, int rows, const ReadOptions& options);

/// Like ungeoreferenced_frame(), for a format with a single band (`kind`: "a PGM", …). Also fails with kInput for
/// options that request another band or packed colours.
Result<Frame> bare_grid_frame(const std::string& name, const char* kind, int cols, int rows,
                              const ReadOptions& options);

/// True if GDAL's geotransform is plausible for the earth in degrees.
bool looks_like_degrees(const std::array<double, 6>& geotransform, int cols, int rows);

/// "1.5 GiB", "37.0 MiB".
std::string format_memory(double bytes);

}  // namespace scarp::io
