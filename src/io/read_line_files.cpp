// Lines of several vector files.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "io/commands.h"
#include "io/line_heights.h"
#include "io/raster/height_unit.h"
#include "scarp/lines.h"

namespace scarp {
namespace {

Result<LineSet> read_all(std::span<const std::string> paths, const ReadLinesOptions& options, double unit_in_metres) {
  LineSet all;
  for (const std::string& path : paths) {
    SCARP_TRY(auto&& set, io::read_lines_in(path, options, unit_in_metres));
    for (Line& line : set.lines) {
      if (line.polygon != kNoPolygon) line.polygon += all.polygons;
    }
    std::move(set.lines.begin(), set.lines.end(), std::back_inserter(all.lines));
    std::move(set.warnings.begin(), set.warnings.end(), std::back_inserter(all.warnings));
    all.polygons += set.polygons;
  }
  return all;
}

}  // namespace

Result<LineSet> read_lines(const std::string& path, const ReadLinesOptions& options) {
  return io::read_lines_in(path, options, 0);
}

Result<LineSet> read_lines(std::span<const std::string> paths, const ReadLinesOptions& options) {
  return read_all(paths, options, 0);
}

Result<LineSet> read_lines(std::span<const std::string> paths, const ReadLinesOptions& options,
                           const RasterInfo& raster) {
  return read_all(paths, options, io::metres_in_file(raster));
}

Result<void> check_polygons(std::span<const Line> lines, const std::string& user, const std::string& otherwise) {
  const auto open = std::find_if(lines.begin(), lines.end(), [](const Line& line) { return !line.is_ring(); });
  if (open == lines.end()) return {};
  const auto &first = open->points.front(), &last = open->points.back();
  const bool is_closed = first[0] == last[0] && first[1] == last[1];
  return fail(ErrorKind::kInput,
              fmt::format("{} is a {}line, and {} needs polygons{}", open->name, is_closed ? "closed " : "", user,
                          is_closed ? fmt::format(": make polygons of such lines first (ogr2ogr -nlt POLYGON {} FILE)",
                                                  io::new_file(".gpkg"))
                          : otherwise.empty() ? ""
                                              : fmt::format(": {} takes lines", otherwise)));
}

}  // namespace scarp
