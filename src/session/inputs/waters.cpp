#include "session/inputs/waters.h"

#include <fmt/format.h>

#include <utility>

#include "scarp/lines.h"
#include "session/inputs/lines.h"

namespace scarp::cli {
namespace {

using enum OptionId;

ReadLinesOptions plan_reading(const OwnedHeightField& field, const ProgressCallback& progress) {
  ReadLinesOptions reading;
  reading.crs = field.info.crs;
  reading.ignore_z = true;
  reading.progress = progress;
  return reading;
}

Result<std::vector<Lake>> add_lakes(const GivenOptions& given, const ProgressCallback& progress,
                                    const MemoryShare& memory, OwnedHeightField& field,
                                    const std::array<double, 6>& affine, std::vector<std::string>& warnings) {
  if (given.has(kDetectFlats)) {
    auto flats = find_flats(
        field, {affine, **given.count(kDetectFlats), {.memory = {memory.limit, memory.taken}, .progress = progress}});
    if (flats && flats->empty())
      warnings.push_back(fmt::format("{} finds no flat area: it changes nothing", kDetectFlats));
    return flats;
  }
  if (given.all(kWater).empty()) return std::vector<Lake>();
  SCARP_TRY(const auto& polygons, read_files(given.all(kWater), plan_reading(field, progress), warnings));
  SCARP_RETURN_IF_ERROR(check_polygons(polygons, name_of(kWater).c_str(), name_of(kRivers).c_str()));
  WaterOptions options;
  options.affine = affine;
  options.run.memory.limit = memory.limit;
  options.run.memory.taken = memory.taken;
  options.run.progress = progress;
  options.percentile = given.number(kWaterPercentile)->value_or(options.percentile);
  auto lakes = flatten_lakes(field, polygons, options);
  if (lakes && lakes->empty())
    warnings.push_back(fmt::format("{} names no lake in the raster: it changes nothing", kWater));
  return lakes;
}

Result<std::vector<Line>> read_streams(const GivenOptions& given, const ProgressCallback& progress,
                                       const OwnedHeightField& field, std::vector<std::string>& warnings) {
  if (given.all(kRivers).empty()) return std::vector<Line>();
  return read_files(given.all(kRivers), plan_reading(field, progress), warnings);
}

}  // namespace

Result<void> read_waters(const GivenOptions& given, const ProgressCallback& progress, const MemoryShare& memory,
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
