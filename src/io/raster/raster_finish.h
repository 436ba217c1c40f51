// Common parts of all raster readers, before and after they read samples.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "scarp/io.h"

namespace scarp {

/// kInput if the size is below 2×2, or a side is beyond an int.
Result<void> check_raster_sides(const std::string& name, std::uint64_t cols, std::uint64_t rows);

/// The same; kInput too if it needs more memory than `options` or the machine allow. The message has the
/// figures.
Result<void> check_raster_size(const std::string& name, std::uint64_t cols, std::uint64_t rows,
                               const ReadOptions& options, std::uint64_t bands = 1);

/// Memory for the samples; kInput if the machine refuses it. Call check_raster_size() first.
Result<void> allocate_samples(const std::string& name, OwnedHeightField& field, int threads = 1);

/// Fills in valid, min and max; then finish_info().
Result<void> finish_raster(OwnedHeightField& field, std::uint64_t infinities, const ReadOptions& options);

/// Warns of `infinities` samples that became nodata; kInput if no sample is a height, unless they are read as values.
Result<void> finish_info(OwnedHeightField& field, std::uint64_t infinities, const ReadOptions& options);

/// True if heights are other than the file's values.
bool scales_heights(const ReadOptions& options);
/// Scales whole values of a file without a scale of its own, already read: z_scale and z_offset of settle_heights(),
/// and their rounding.
void scale_values(const ReadOptions& options, OwnedHeightField& field);

/// The grid frame; with a cell size one around the raster's centre.
Result<Frame> grid_or_cells(const std::string& name, int cols, int rows, const ReadOptions& options);

/// The frame of a raster without georeference: kUsage if options.crs asks for a place.
Result<Frame> ungeoreferenced_frame(const std::string& name, int cols, int rows, const ReadOptions& options);

/// The same for a format of one band and nothing else (`kind`: "a PGM", …), which also refuses (kInput) options that
/// ask for another band or for packed colours.
Result<Frame> bare_grid_frame(const std::string& name, const char* kind, int cols, int rows,
                              const ReadOptions& options);

/// GDAL's geotransform as a world in degrees would have it.
bool looks_like_degrees(const std::array<double, 6>& geotransform, int cols, int rows);

/// "1.5 GiB", "37.0 MiB".
std::string format_memory(double bytes);

}  // namespace scarp
