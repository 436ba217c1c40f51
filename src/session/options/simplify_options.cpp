#include "session/options/simplify_options.h"

#include <fmt/format.h>

#include <utility>

#include "session/table/option_table.h"

namespace scarp::cli {

void SimplifyArguments::add_to(CLI::App& command) {
  add_arguments(command, OptionId::kInput, raster.paths, OptionId::kOutput, output);
  add_option(command, OptionId::kMaxError, max_error);
  add_option(command, OptionId::kMaxTriangles, max_triangles);
  add_option(command, OptionId::kMaxPoints, max_points);
  raster.add_to(command);
  add_option(command, OptionId::kNodataPolicy, nodata_policy);
  add_option(command, OptionId::kFillDistance, fill_distance);
  add_option(command, OptionId::kBackground, background);
  add_option(command, OptionId::kOutlineTolerance, outline_tolerance);
  levels.add_to(command);
  companions.add_to(command);
  lines.add_to(command);
  cliff.add_to(command);
  ridges.add_to(command);
  cut.add_to(command);
  zones.add_to(command);
  channels.add_to(command);
  shape.add_to(command);
  strategy.add_to(command);
  add_option(command, OptionId::kOf, format);
  add_option(command, OptionId::kUp, up);
  add_flag(command, OptionId::kDouble, doubles);
  add_flag(command, OptionId::kNormals, normals);
  add_flag(command, OptionId::kUvs, uvs);
  add_flag(command, OptionId::kCompress, compress);
  images.add_to(command);
  add_option(command, OptionId::kBase, base);
  solid.add_to(command);
  add_option(command, OptionId::kPreview, preview);
  add_option(command, OptionId::kRender, render);
  add_option(command, OptionId::kErrorRaster, error_raster);
  add_option(command, OptionId::kHtml, html);
  add_option(command, OptionId::kReport, report);
  add_flag(command, OptionId::kOverwrite, overwrite);
  add_option(command, OptionId::kThreads, threads);
  memory.add_to(command);
  add_flag(command, OptionId::kQuiet, quiet);
  add_flag(command, OptionId::kTiming, timing);
  add_flag(command, OptionId::kJsonProgress, json_progress);
}

std::string SimplifyArguments::canonical() const {
  std::string command = "scarp simplify";
  for (const std::string& path : raster.paths) command += " " + shell_word(base_name(path));
  command += " OUTPUT" + canonical_option("--max-error", max_error) +
             canonical_option("--max-triangles", max_triangles) + canonical_option("--max-points", max_points) +
             raster.canonical();
  const std::pair<const char*, const Given*> options[] = {
      {"--nodata-policy", &nodata_policy},
      {"--fill-distance", &fill_distance},
      {"--background", &background},
      {"--outline-tolerance", &outline_tolerance},
      {"--base", &base},
      {"--up", &up},
  };
  for (const auto& [name, value] : options) {
    command += canonical_option(name, *value);
  }
  command += solid.canonical() + levels.canonical();
  command += companions.canonical() + lines.canonical() + cliff.canonical() + ridges.canonical() + cut.canonical() +
             zones.canonical() + shape.canonical() + channels.canonical() + strategy.canonical();
  if (strategy.asks_for_greedy()) command += " --order greedy";
  return command + (normals ? " --normals" : "") + (uvs ? " --uvs" : "") + (doubles ? " --double" : "") +
         (compress ? " --compress" : "") + images.canonical();
}

}  // namespace scarp::cli
