// Vector files whose lines the mesh must hold.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scarp/lines.h"
#include "scarp/simplify.h"
#include "session/options/values.h"
#include "session/text/json.h"

namespace CLI {
class App;
}

namespace scarp::cli {

struct LineArguments {
  std::vector<std::string> breaklines, water, rivers;  ///< FILE or FILE:LAYER
  Given z_field, conflict, percentile, flats;
  bool are_soft = false;

  void add_to(CLI::App& command);
  /// Refuses options that need others, and words that are unknown.
  Result<void> check() const;
  /// The option that asks for lines in the mesh; null if there is none.
  const char* find_lines() const;
  /// The option that asks for lakes; null if there is none.
  const char* find_lakes() const;
  /// The options as they can change the mesh, for the canonical command.
  std::string canonical() const;
  /// The lines of all files, in the CRS of the raster; sentences for the user in `warnings`.
  Result<LineConstraints> read(const RasterInfo& raster, int rows, const ProgressCallback& progress,
                               std::vector<std::string>& warnings) const;
};

/// The lines of all files.
Result<std::vector<Line>> read_files(const std::vector<std::string>& files, const ReadLinesOptions& options,
                                     std::vector<std::string>& warnings);

/// Refuses lines where the CRS that --crs names bends the grid of the raster.
/// `lines`: the option that asks for them; null: there are none.
Result<void> check_frame_of_lines(const char* lines, const Frame& frame, const std::string& crs_option,
                                  const std::string& input);

/// The "breaklines" object of a report; null without lines.
Json describe_lines(const LineArguments& given, const Simplified& simplified);
/// Of the summary; empty without lines.
std::string lines_line(std::uint64_t lines, std::uint64_t inserted, const std::vector<SampleEdit>& edits);
/// Sentences for breaklines and rivers that lie farther from the raster than any error explains: ten times `error`.
void warn_of_far_lines(const Simplified& simplified, double error, std::vector<std::string>& warnings);

}  // namespace scarp::cli
