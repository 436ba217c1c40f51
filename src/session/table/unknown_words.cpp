#include "session/table/unknown_words.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <iterator>
#include <string_view>
#include <vector>

#include "base/alike.h"
#include "session/table/help.h"
#include "session/table/missing_value.h"
#include "session/table/option_table.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

struct Foreign {
  const char* words;   ///< words of other programs, without dashes, separated by blanks
  OptionId meant;      ///< Scarp's option; kNone if Scarp has none
  const char* advice;  ///< instead of "did you mean"; may be empty
};

/// Names from GDAL, hmm, delatin, gltfpack and mesh programs. Entries for options that the command lacks are skipped.
constexpr Foreign kForeign[] = {
    {"error err epsilon eps zerror z-error max-err maxerror tol threshold", OptionId::kMaxError, ""},
    {"percent percentage relative", OptionId::kMaxError, "a share of the relief is an error with a % behind it: -e 1%"},
    {"triangles faces target-faces target-triangles tris num-triangles", OptionId::kMaxTriangles, ""},
    {"num-points num-vertices max-vertices", OptionId::kMaxPoints, ""},
    {"ratio si simplify-ratio decimate", OptionId::kMaxTriangles,
     "give the number of triangles with -t, or the error with -e"},
    {"a-srs s-srs", OptionId::kNone,
     "the input's CRS is the file's own: gdal_translate -a_srs EPSG:CODE FILE NEW.tif gives it another; --crs is the "
     "mesh's"},
    {"t-srs srs epsg proj projection", OptionId::kCrs, ""},
    {"a-nodata srcnodata dstnodata no-data nodata-value nodatavalue", OptionId::kNodata, ""},
    {"of f format output-format", OptionId::kOf, ""},
    {"o output out", OptionId::kReport, "the output is the word behind the input: scarp simplify INPUT OUTPUT"},
    {"i input in", OptionId::kCrs, "the input is a word of its own, without an option"},
    {"te bbox extent bounds projwin", OptionId::kExtent, ""},
    {"tr res outsize", OptionId::kResolution, ""},
    {"te bbox extent bounds projwin srcwin", OptionId::kNone,
     "cut the raster first (gdal_translate -projwin WEST NORTH EAST SOUTH FILE NEW.tif)"},
    {"tr ts res outsize", OptionId::kNone,
     "change the raster first (gdal_translate -r average -outsize COLUMNS 0 FILE NEW.tif)"},
    {"z zscale z-exaggeration vertical-exaggeration exaggerate exaggeration", OptionId::kZScale, ""},
    {"exaggerate exaggeration z-exaggeration vertical-exaggeration", OptionId::kSolid,
     "give it as --solid exaggerate=2"},
    {"force y overwrite-existing clobber", OptionId::kOverwrite, ""},
    {"threads jobs nt", OptionId::kThreads, ""},
    {"b", OptionId::kBand, ""},
    {"l", OptionId::kLayer, ""},
    {"zfield z-column", OptionId::kZField, ""},
    {"concave concave-hull alpha alpha-shape chi-shape hull", OptionId::kBoundary,
     "give it as --boundary concave:LENGTH"},
    {"classes classification class-filter keep-class", OptionId::kClass, ""},
    {"return returns last-only first-only", OptionId::kClass, "give it as --class returns=last"},
    {"column fields format order pnezd", OptionId::kColumns, ""},
    {"clip cutlines crop-to-cutline csql cl", OptionId::kCutline, ""},
    {"lakes", OptionId::kWater, ""},
    {"bl breakline", OptionId::kBreaklines, ""},
    {"v V verbose debug", OptionId::kTiming, "--timing tells what each pass took, --version the version"},
    {"contours contour isolines", OptionId::kPoints,
     "contour lines are an input: scarp simplify contours.gpkg OUTPUT -e 2"},
    {"co", OptionId::kNone, "formats have no creation options"},
    {"optimize quality level compression-level", OptionId::kEffort, ""},
};

/// The word without leading dashes and value, with dashes for underscores, in lower case unless it is a single letter.
std::string bare(const std::string& word) {
  std::string name = word.substr(std::min(word.find_first_not_of('-'), word.size()));
  name.resize(std::min(name.find('='), name.size()));
  for (char& c : name) {
    if (c == '_') c = '-';
    if (name.size() > 1) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return name;
}

/// True if one of `words` equals `word` or, if it has four letters or more, is at most `most` edits away.
bool holds_word(std::string_view words, std::string_view word, std::size_t most = 0) {
  constexpr std::size_t kLongest = 64;  // length of the longest word
  if (word.size() > kLongest) return false;
  for (std::size_t begin = 0; begin < words.size();) {
    const std::size_t end = std::min(words.find(' ', begin), words.size());
    const std::string_view here = words.substr(begin, end - begin);
    if (here == word || (here.size() >= 4 && count_typos(here, word) <= most)) return true;
    begin = end + 1;
  }
  return false;
}

std::vector<std::string> names_of(const CLI::App* command) {
  std::vector<std::string> names;
  const CommandRow* const row = command != nullptr ? find_command(command->get_name()) : nullptr;
  if (row == nullptr) return {"help", "help-all", "version"};
  for (const OptionRow* option : rows_of(row->command)) {
    if (!option->is_argument()) names.emplace_back(bare(option->name));
  }
  return names;
}

/// The text of ask_for(), or better advice; empty if no word is similar.
std::string advise(const CLI::App* command, const std::string& word) {
  const std::string name = bare(word);
  const std::vector<std::string> names = names_of(command);
  const auto has = [&](const std::string& option) {
    return std::find(names.begin(), names.end(), option) != names.end();
  };
  if (has(name)) return fmt::format("did you mean --{}?", name);
  const auto advise_on_foreign = [&](std::size_t most) -> std::string {
    for (const Foreign& foreign : kForeign) {
      if (!holds_word(foreign.words, name, most) || command == nullptr) continue;
      if (foreign.meant != OptionId::kNone && !has(bare(name_of(foreign.meant)))) continue;
      return foreign.advice[0] != 0 ? foreign.advice : fmt::format("did you mean {}?", foreign.meant);
    }
    return {};
  };
  std::string advice = advise_on_foreign(0);
  if (advice.empty()) advice = ask_for(find_alike(name, names), "--");
  return advice.empty() && name.size() >= 4 ? advise_on_foreign(1) : advice;
}

}  // namespace

std::string describe_unknown_option(const CLI::App* command, const std::string& word) {
  const std::string advice = advise(command, word);
  const std::string sentence = fmt::format("option {} is unknown", shell_word(word));
  return advice.empty() ? sentence : fmt::format("{} ({})", sentence, advice);
}

std::optional<std::string> find_foreign_option(const CLI::App& program, int argc, const char* const* argv) {
  const CLI::App* command = argc > 1 ? find_command(program, argv[1]) : nullptr;
  if (command == nullptr) return std::nullopt;
  for (int k = 2; k < argc && std::string_view(argv[k]) != "--"; ++k) {
    const std::string word = argv[k];
    const bool is_option = word.size() > 2 && word[0] == '-' && std::isalpha(static_cast<unsigned char>(word[1]));
    const std::size_t equals = word.find('=');
    const CLI::Option* option = word[0] == '-' ? command->get_option_no_throw(word.substr(0, equals)) : nullptr;
    if (option != nullptr) {
      if (option->get_items_expected_max() > 0 && equals == std::string::npos) ++k;
    } else if (is_option && !advise(command, word).empty() && bare(word).size() > 1) {
      const std::string name = bare(word);
      const bool is_known = holds_word("help version", name) || command->get_option_no_throw("--" + name) != nullptr;
      const bool is_foreign = std::any_of(std::begin(kForeign), std::end(kForeign),
                                          [&](const Foreign& foreign) { return holds_word(foreign.words, name); });
      if (is_known || is_foreign) return describe_unknown_option(command, word);
    }
  }
  return std::nullopt;
}

Error unknown_command(const std::string& word) {
  constexpr std::pair<const char*, const char*> kMeant[] = {
      {"simplify", "decimate reduce mesh tin convert triangulate simplification translate"},
      {"measure", "check validate judge compare verify error diff"},
      {"info", "gdalinfo describe stats show inspect"},
      {"generate", "create make synthesize"}};
  if (bare(word) == "paper")
    return {ErrorKind::kUsage,
            "unknown command 'paper': make paper, in Scarp's source tree, repeats the experiments of the 1995 paper"};
  std::vector<std::string> names;
  for (const CommandRow& row : command_rows()) names.emplace_back(row.name);
  std::vector<std::string> meant;
  for (const auto& [name, words] : kMeant) {
    if (holds_word(words, bare(word))) meant.assign(1, name);
  }
  if (meant.empty()) meant = find_alike(bare(word), names);
  const bool is_file = meant.empty() && word.find_first_of("./") != std::string::npos;
  const std::string hint = !meant.empty() ? fmt::format(" ({})", ask_for(meant)) : ": " + choose_command();
  return {
      ErrorKind::kUsage,
      is_file
          ? fmt::format(
                "unknown command '{}': a file comes behind one, as in scarp simplify {} OUTPUT -e 1; see scarp --help",
                word, shell_word(word))
          : fmt::format("unknown command '{}'{}; see scarp --help", word, hint)};
}

}  // namespace scarp::cli
