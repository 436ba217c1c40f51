#include "session/inputs/waters.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "session/reports/report.h"
#include "session/reports/simplify_run.h"
#include "session/text/text.h"

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
  const auto polygons = read_files(given.water, plan_reading(field, progress), warnings);
  if (!polygons) return tl::unexpected(polygons.error());
  if (auto closed = check_polygons(*polygons, "--water", "--rivers"); !closed) return tl::unexpected(closed.error());
  WaterOptions options;
  options.affine = affine;
  options.run.memory.limit = memory.limit;
  options.run.memory.taken = memory.taken;
  options.run.progress = progress;
  if (given.percentile) options.percentile = *parse_non_negative("--water-percentile", *given.percentile);
  auto lakes = flatten_lakes(field, *polygons, options);
  if (lakes && lakes->empty()) warnings.push_back("--water names no lake in the raster: it changes nothing");
  return lakes;
}

Result<std::vector<Line>> read_streams(const LineArguments& given, const ProgressCallback& progress,
                                       const OwnedHeightField& field, std::vector<std::string>& warnings) {
  if (given.rivers.empty()) return std::vector<Line>();
  return read_files(given.rivers, plan_reading(field, progress), warnings);
}

std::string lakes_line(const std::vector<Lake>& lakes) {
  if (lakes.empty()) return "";
  std::uint64_t samples = 0;
  double largest = 0;
  for (const Lake& lake : lakes) {
    samples += lake.samples + lake.raised;
    largest = std::max(largest, lake.largest_change);
  }
  const std::string changed =
      samples == 0 ? ", flat as they are"
                   : fmt::format(" flattened ({} changed, at most {}); errors are relative to the flattened raster",
                                 format_plural(samples, "sample"), format_number(largest));
  return summary_line("water", format_plural(lakes.size(), "lake") + changed);
}

std::string rivers_line(const std::vector<River>& rivers) {
  if (rivers.empty()) return "";
  double deepest = 0;
  for (const River& river : rivers) deepest = std::max(deepest, river.deepest_cut);
  return summary_line("rivers", fmt::format("{}, up to {} below the raster", format_plural(rivers.size(), "line"),
                                            format_number(deepest)));
}

}  // namespace

Result<void> read_waters(const LineArguments& given, const ProgressCallback& progress, const MemoryShare& memory,
                         OwnedHeightField& field, Features& features, std::vector<std::string>& warnings) {
  auto lakes = add_lakes(given, progress, memory, field, features.breaklines.affine, warnings);
  if (!lakes) return tl::unexpected(lakes.error());
  features.lakes = std::move(*lakes);
  auto streams = read_streams(given, progress, field, warnings);
  if (!streams) return tl::unexpected(streams.error());
  features.rivers = std::move(*streams);
  return {};
}

std::uint64_t bytes_of(const std::vector<Lake>& lakes) {
  std::uint64_t bytes = 0;
  for (const Lake& lake : lakes) bytes += lake.bytes;
  return bytes;
}

void warn_of_dry_lines(const Features& features, const std::vector<River>& rivers, std::vector<std::string>& warnings) {
  if (rivers.size() == features.rivers.size()) return;
  warnings.push_back(fmt::format("--rivers: {} beside the raster or closed: no river",
                                 format_plural(features.rivers.size() - rivers.size(), "line")));
}

Json describe_lakes(const std::vector<Lake>& lakes) {
  Json list = Json::array();
  for (const Lake& lake : lakes)
    list.push_back(Json{{"name", lake.name},
                        {"level", lake.level},
                        {"edited_samples", lake.samples},
                        {"raised_around", lake.raised},
                        {"largest_edit", lake.largest_change}});
  return list;
}

Json describe_rivers(const std::vector<River>& rivers) {
  Json list = Json::array();
  for (const River& river : rivers)
    list.push_back(Json{{"name", river.name},
                        {"source", river.source},
                        {"mouth", river.mouth},
                        {"deepest_cut", river.deepest_cut},
                        {"turned", river.is_turned}});
  return list;
}

std::string waters_lines(const std::vector<Lake>& lakes, const std::vector<River>& rivers) {
  return lakes_line(lakes) + rivers_line(rivers);
}

}  // namespace scarp::cli
