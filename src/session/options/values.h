// What the commands' options have in common: reading numbers, rasters' options, checks of output files.
#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scarp/io.h"
#include "scarp/result.h"
#include "session/text/text.h"

namespace CLI {
class App;
}

namespace scarp::cli {

/// The text of an option as the user gave it; nothing if the option was not given. Every value is parsed by the
/// functions below, so that each complaint names its option and its value.
using Given = std::optional<std::string>;

/// A finite number.
Result<double> parse_number(std::string_view option, const std::string& text);
/// A finite number that is at least 0.
Result<double> parse_non_negative(std::string_view option, const std::string& text);
/// --nodata: a number or NaN, nothing where it is not given. Fails with kUsage for another word.
Result<std::optional<double>> parse_nodata(const Given& nodata);

/// --fill-distance in samples; without it 100 if nodata is filled, else 0. Fails with kUsage where nothing is filled.
Result<double> parse_fill_distance(const Given& text, bool is_filled);
/// A whole number that is at least `least`.
Result<std::uint64_t> parse_count(std::string_view option, const std::string& text, std::uint64_t least);
/// Threads: 0 (all cores, also if not given) to 1024.
Result<int> parse_threads(const Given& text);

/// A word that an option takes, and what it stands for.
template <class T>
struct Choice {
  const char* name;
  T value;
};

/// The value that the word names. Else the sentence lists the words.
template <class T, std::size_t N>
Result<T> choose(std::string_view option, const std::string& word, const Choice<T> (&choices)[N]) {
  std::string names;
  for (std::size_t k = 0; k < N; ++k) {
    if (word == choices[k].name) return choices[k].value;
    names += (k == 0 ? "" : k + 1 == N ? " or " : ", ") + std::string(choices[k].name);
  }
  return fail(ErrorKind::kUsage, fmt::format("{} {} is unknown: choose {}", option, shell_word(word), names));
}

/// The word for the value.
template <class T, std::size_t N>
const char* name_of(T value, const Choice<T> (&choices)[N]) {
  for (const Choice<T>& choice : choices) {
    if (choice.value == value) return choice.name;
  }
  return "";
}

/// " --name value" if the option was given: a piece of a canonical command.
std::string canonical_option(const char* name, const Given& text);

/// The value of -e/--max-error.
struct ErrorGoal {
  double value = 0;
  bool percent_of_relief = false;
  bool is_on_print = false;  ///< in millimetres of a print
  std::string unit;          ///< of the value, "m" or "ft"; empty: that of the heights
  /// In z units, for a raster of the given relief.
  double absolute(double relief) const { return percent_of_relief ? value / 100 * relief : value; }
};
/// A number, perhaps with % or a unit behind it: m, cm, ft, or mm of a print.
Result<ErrorGoal> parse_error_goal(std::string_view option, const std::string& text);
/// Fails for a goal in millimetres of a print, where there is none.
Result<void> refuse_print(std::string_view option, const ErrorGoal& goal);
/// Puts a goal that names its unit into that of the heights. A warning says where theirs is taken for granted; kUsage
/// where it is no length.
Result<void> settle_goal(std::string_view option, const RasterInfo& heights, ErrorGoal& goal,
                         std::vector<std::string>& warnings);
/// What the library says of a max error, with the share of the relief that was asked for.
Error name_goal(const ErrorGoal& goal, double relief, Error error);

/// The options of every command that reads a raster.
struct RasterArguments {
  std::vector<std::string> paths;  ///< one, or those of a mosaic
  Given band, nodata, decode, crs, z_scale, z_offset, z_unit, cell_size, resolution;
  std::vector<std::string> extent;

  const std::string& path() const { return paths.front(); }
  /// Adds the options; the paths are arguments of their own.
  void add_to(CLI::App& command);
  Result<ReadOptions> parse() const;
  /// " --band 2 --crs local": those that were given.
  std::string canonical() const;
  /// What the library says of a raster that cannot be read, and what else standard input and vector data can be.
  Error explain(Error error) const;
};

/// A file that the run will write, and the option that asked for it ("OUTPUT", "--report", …).
struct PlannedOutput {
  std::string option;
  std::string path;
};

/// Everything that can be known about output files before the work begins: their folders exist and can be written,
/// nothing is replaced without `overwrite`, none is an input or another output.
Result<void> check_outputs(const std::vector<PlannedOutput>& outputs, const std::vector<std::string>& inputs,
                           bool overwrite);
/// The path's extension in lower case, with its point (".png"); empty if there is none.
std::string lower_extension(const std::string& path);
/// Whether the path can be a set of tiles: a folder, or a file with the ending of an archive of tiles.
bool names_tile_set(const std::string& path);
/// Fails unless the path ends in .png or is a device.
Result<void> check_png_name(const PlannedOutput& output);
/// Fails unless the path ends in .tif or .tiff or is a device.
Result<void> check_tiff_name(const PlannedOutput& output);
/// True if writing to the path is writing to standard output ("-", /dev/stdout).
bool is_stdout(const std::string& path);

}  // namespace scarp::cli
