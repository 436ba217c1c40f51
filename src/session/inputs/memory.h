// Rasters larger than memory.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "scarp/io.h"
#include "session/options/memory_options.h"

namespace scarp::cli {

/// Bytes that the process may take, 0 for any, and those that it has taken.
struct MemoryShare {
  std::uint64_t limit = 0, taken = 0;
};

/// What GDAL loads to read a file of lines or polygons.
inline constexpr std::uint64_t kVectorBytes = 6'000'000;

/// What a run needs beside the mesh.
struct MemoryNeeds {
  std::uint64_t others = 0;      ///< bytes, of files beside the raster's
  std::uint64_t per_sample = 4;  ///< bytes, where all samples are in memory: the samples, and bounds of their own
};

/// Of a sample in memory that has a bound of its own.
inline constexpr std::uint64_t kBoundedSampleBytes = 24;

/// read_height_field(), or, with a limit, open_height_field(): one half of what the program itself leaves of it is for
/// the samples, with what each of them needs, or their file's cache.
Result<OwnedHeightField> read_within(const std::string& path, ReadOptions options,
                                     const std::optional<std::uint64_t>& limit, const MemoryNeeds& needs = {});

/// What of `limit` a run on a field that was read within it has not for itself: the program, and the samples or the
/// cache of their file, with what others have of it.
std::uint64_t bytes_taken(const OwnedHeightField& field, std::uint64_t limit);

/// Opens another raster on the same grid, where the field was read within the limit and has a source. What it has in
/// memory is a quarter of what the program leaves at most; one that stays in its file shares the cache.
Result<OwnedHeightField> read_beside(const std::string& path, ReadOptions options, std::uint64_t limit);
/// What it takes beside bytes_taken().
std::uint64_t bytes_beside(const OwnedHeightField& other, const OwnedHeightField& field, std::uint64_t limit);

/// Fails with kUsage if the limit has no room for so many bytes more of what `options` name.
Result<void> check_room(const OwnedHeightField& field, std::uint64_t limit, std::uint64_t bytes, const char* options);

/// The side of a picture that memory has room for beside a mesh: 1400 pixels, less where samples are streamed.
int picture_side(const OwnedHeightField& field, const MemoryShare& memory, std::uint64_t vertices);

/// Fails with kUsage if the field's samples are not in memory as one array, which `option` needs; says what would do.
Result<void> check_in_memory(const OwnedHeightField& field, const std::string& option, const MemoryNeeds& needs = {});

/// What the library says of a memory limit, and of rasters that were not read as a whole, in the words of --memory.
Error name_memory(const MemoryArguments& given, const OwnedHeightField& field, Error error);

/// Gives a raster that was not read before the range that the judge has found.
void complete_info(const HeightRange& judged, RasterInfo& info);
/// The same of the range in `now`, if it has one.
void complete_info(const RasterInfo& now, RasterInfo& info);

}  // namespace scarp::cli
