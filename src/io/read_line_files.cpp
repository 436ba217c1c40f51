// Lines of several vector files.
#include <iterator>
#include <utility>

#include "scarp/lines.h"

namespace scarp {

Result<LineSet> read_lines(std::span<const std::string> paths, const ReadLinesOptions& options) {
  LineSet all;
  for (const std::string& path : paths) {
    auto set = read_lines(path, options);
    if (!set) return tl::unexpected(std::move(set.error()));
    for (Line& line : set->lines) {
      if (line.polygon != kNoPolygon) line.polygon += all.polygons;
    }
    std::move(set->lines.begin(), set->lines.end(), std::back_inserter(all.lines));
    std::move(set->warnings.begin(), set->warnings.end(), std::back_inserter(all.warnings));
    all.polygons += set->polygons;
  }
  return all;
}

}  // namespace scarp
