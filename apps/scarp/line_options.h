// Vector files whose lines the mesh must hold.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "options.h"
#include "report.h"
#include "scarp/lines.h"
#include "scarp/simplify.h"
#include "scarp/water.h"

namespace scarp::cli {

struct LineArguments {
  std::vector<std::string> breaklines, water;  ///< FILE or FILE:LAYER
  Given z_field, conflict, percentile;
  bool are_soft = false;

  void add_to(CLI::App& verb);
  /// Refuses options that need others, and words that are unknown.
  Result<void> check() const;
  /// The option that asks for lines in the mesh; null if there is none.
  const char* find_lines() const;
  /// The options as they can change the mesh, for the canonical command.
  std::string canonical() const;
  /// The lines of all files, in the CRS of the raster; sentences for the user in `warnings`.
  Result<LineConstraints> read(const RasterInfo& raster, int rows, const ProgressCallback& progress,
                               std::vector<std::string>& warnings) const;
};

/// The lines of all files; polygons are counted on from file to file. Sentences for the user in `warnings`.
Result<std::vector<Line>> read_line_files(const std::vector<std::string>& files, const ReadLinesOptions& options,
                                          std::vector<std::string>& warnings);

/// Makes the lakes of --water flat, and their shores lines of the mesh.
Result<std::vector<Lake>> flatten_water(const LineArguments& given, const ProgressCallback& progress,
                                        OwnedHeightField& field, LineConstraints& lines,
                                        std::vector<std::string>& warnings);

/// Puts the samples on hard lines at the heights that simplify() gave them.
void apply_edits(const std::vector<SampleEdit>& edits, OwnedHeightField& field);

/// The "breaklines" object of a report; null without lines.
Json describe_lines(const LineArguments& given, std::uint64_t lines, const Simplified& simplified);
/// Of the summary; empty without lines.
std::string lines_line(std::uint64_t lines, const Simplified& simplified);

/// The "water" list of a report.
Json describe_water(const std::vector<Lake>& lakes);
/// Of the summary; empty without lakes.
std::string water_line(const std::vector<Lake>& lakes);

}  // namespace scarp::cli
