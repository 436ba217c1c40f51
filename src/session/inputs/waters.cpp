#include "session/inputs/waters.h"

#include <fmt/format.h>

#include <utility>

#include "scarp/read_lines.h"
#include "session/inputs/lines.h"

namespace scarp::cli {
namespace {

ReadLinesOptions plan_reading(const OwnedHeightField& field, const ProgressCallback& progress) {
  ReadLinesOptions reading;
  reading.crs = field.info.crs;
  reading.ignore_z = true;
  reading.progress = progress;
  return reading;
}

Result<std::vector<Lake>> add_lakes(const LineArguments& given, const ProgressCallback& progress,
                                    const MemoryShare& memory, OwnedHeightField& field,
                                    const std::array<double, 6>& affine, std::vector<std::string>& warnings) {
  if (given.flats) {
    auto flats = find_flats(field, {affine,
                                    *parse_count("--detect-flats", *given.flats, 3),
                                    {.memory = {memory.limit, memory.taken}, .progress = progress}});
    if (flats && flats->empty()) warnings.push_back("--detect-flats finds no flat area: it changes nothing");
    return flats;
  }
  if (given.water.empty()) return std::vector<Lake>();
  SCARP_TRY(const auto& polygons, read_files(given.water, plan_reading(field, progress), warnings));
  SCARP_RETURN_IF_ERROR(check_polygons(polygons, "--water", "--rivers"));
  WaterOptions options;
  options.affine = affine;
  options.run.memory.limit = memory.limit;
  options.run.memory.taken = memory.taken;
  options.run.progress = progress;
  if (given.percentile) options.percentile = *parse_non_negative("--water-percentile", *given.percentile);
  auto lakes = flatten_lakes(field, polygons, options);
  if (lakes && lakes->empty()) warnings.push_back("--water names no lake in the raster: it changes nothing");
  return lakes;
}

Result<std::vector<Line>> read_streams(const LineArguments& given, const ProgressCallback& progress,
                                       const OwnedHeightField& field, std::vector<std::string>& warnings) {
  if (given.rivers.empty()) return std::vector<Line>();
  return read_files(given.rivers, plan_reading(field, progress), warnings);
}

}  // namespace

Result<void> read_waters(const LineArguments& given, const ProgressCallback& progress, const MemoryShare& memory,
                         OwnedHeightField& field, Features& features, std::vector<std::string>& warnings) {
  SCARP_TRY(features.lakes, add_lakes(given, progress, memory, field, features.breaklines.affine, warnings));
  SCARP_TRY(features.rivers, read_streams(given, progress, field, warnings));
  return {};
}

std::uint64_t bytes_of(const std::vector<Lake>& lakes) {
  std::uint64_t bytes = 0;
  for (const Lake& lake : lakes) bytes += lake.bytes;
  return bytes;
}

}  // namespace scarp::cli
