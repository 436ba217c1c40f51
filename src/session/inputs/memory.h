// Input larger than memory.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "scarp/io.h"
#include "session/options/memory_options.h"

namespace scarp::cli {

/// The limit of the process in bytes, 0 for none, and the bytes that it already uses.
struct MemoryShare {
  std::uint64_t limit = 0, taken = 0;
};

/// Bytes that GDAL loads to read a file of lines or polygons.
inline constexpr std::uint64_t kVectorBytes = 6'000'000;

/// The memory that a run needs in addition to the mesh.
struct MemoryNeeds {
  std::uint64_t others = 0;      ///< bytes of files other than the raster
  std::uint64_t per_sample = 4;  ///< bytes of a sample in memory, with its bound
};

/// Bytes of a sample in memory that has its own bound.
inline constexpr std::uint64_t kBoundedSampleBytes = 24;

/// Calls read_height_field() or, with a limit, open_height_field(). Half of the memory that the program does not use is
/// for the samples and their bounds, or for their file's cache.
Result<OwnedHeightField> read_within(const std::string& path, ReadOptions options,
                                     const std::optional<std::uint64_t>& limit, const MemoryNeeds& needs = {});

/// The bytes of `limit` that are no longer available after a field was read within it: those of the program, of samples
/// or their file's cache, and of other files.
std::uint64_t bytes_taken(const OwnedHeightField& field, std::uint64_t limit);

/// Opens another raster on the grid of a field that was read within the limit and has a source. If this raster is in
/// memory, it has at most a quarter of the memory that the program does not use; otherwise it shares the cache.
Result<OwnedHeightField> read_beside(const std::string& path, ReadOptions options, std::uint64_t limit);
/// The bytes of `other` in addition to bytes_taken().
std::uint64_t bytes_beside(const OwnedHeightField& other, const OwnedHeightField& field, std::uint64_t limit);

/// Fails with kUsage if the limit has no room for the bytes that `options` need.
Result<void> check_room(const OwnedHeightField& field, std::uint64_t limit, std::uint64_t bytes,
                        const std::string& options);

/// The side of a picture that fits in memory next to a mesh: 1400 pixels, fewer if samples are streamed.
int picture_side(const OwnedHeightField& field, const MemoryShare& memory, std::uint64_t vertices);

/// Fails with kUsage if the field's samples are not in memory as one array, which `option` needs. The message names a
/// sufficient memory limit.
Result<void> check_in_memory(const OwnedHeightField& field, const std::string& option, const MemoryNeeds& needs = {});

/// Names --memory in the library's errors about a memory limit.
Error name_limit(const GivenOptions& given, Error error);
/// Rewrites the library's errors about a memory limit, or about rasters not entirely in memory, in terms of --memory.
Error name_memory(const GivenOptions& given, const OwnedHeightField& field, Error error);

/// Adds the range that the judge found to the info of a raster that was not read.
void complete_info(const HeightRange& judged, RasterInfo& info);
/// Adds the range in `now`, if any.
void complete_info(const RasterInfo& now, RasterInfo& info);

}  // namespace scarp::cli
