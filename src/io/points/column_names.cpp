#include "io/points/column_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <vector>

#include "io/mesh/mesh_file_text.h"
#include "io/raster/height_unit.h"

namespace scarp::io {
namespace {

using Words = std::span<const std::string_view>;

constexpr std::string_view kXWords[] = {"x",           "easting",     "east",   "e",          "eastings", "rechtswert",
                                        "rechts",      "rw",          "este",   "ostwert",    "ost",      "est",
                                        "xcoordinate", "xkoordinate", "xcoord", "coordx",     "lon",      "long",
                                        "lng",         "longitude",   "laenge", "laengengrad"};
constexpr std::string_view kYWords[] = {"y",        "northing", "north",       "n",           "northings",
                                        "hochwert", "hoch",     "hw",          "norte",       "nordwert",
                                        "nord",     "latitude", "ycoordinate", "ykoordinate", "ycoord",
                                        "coordy",   "lat",      "breite",      "breitengrad"};
constexpr std::string_view kHeightWords[] = {
    "z",     "height", "elevation", "elev", "h",       "altitude", "alt",    "ele",         "hoehe",       "hauteur",
    "quota", "cota",   "kote",      "rl",   "heights", "el",       "zcoord", "zcoordinate", "zkoordinate", "coordz"};
constexpr std::string_view kNumberWords[] = {"number",      "no",      "nr",    "num",     "id",     "fid",
                                             "p",           "pt",      "point", "pointno", "name",   "pointname",
                                             "pointnumber", "pointid", "punkt", "pkt",     "pktnr",  "punktnr",
                                             "punktnummer", "station", "index", "numero",  "nummer", "numeropunto"};
constexpr std::string_view kCodeWords[] = {"code", "description", "desc", "d", "c", "feature", "remark", "note"};

constexpr std::array<Words, 5> kWords{kXWords, kYWords, kHeightWords, kNumberWords, kCodeWords};

/// True for words that name no quantity, such as units and frames.
bool says_nothing(std::string_view word) {
  constexpr std::string_view kIdle[] = {
      "utm", "wgs84", "etrs89",      "coord",         "coordinate", "coordinates", "point",  "ortho",
      "msl", "us",    "survey",      "international", "surface",    "ground",      "value",  "intl",
      "deg", "dd",    "ellipsoidal", "orthometric",   "terrain",    "degree",      "degrees"};
  return std::find(std::begin(kIdle), std::end(kIdle), word) != std::end(kIdle) || find_metres(std::string(word));
}

/// Lower-case ASCII, with umlauts as two letters, from UTF-8 and Latin-1.
std::string spelled_out(std::string_view name) {
  std::string text;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const auto at = [&](std::size_t k) { return k < name.size() ? static_cast<unsigned char>(name[k]) : 0U; };
    const bool is_pair = at(i) == 0xc3 && i + 1 < name.size();
    if (at(i) < 0x80) {
      text += name[i];
      continue;
    }
    const unsigned letter = is_pair ? at(++i) + 0x40 : at(i);  // Latin-1
    switch (letter | 0x20U) {
      case 0xe4:
        text += "ae";
        break;
      case 0xf6:
        text += "oe";
        break;
      case 0xfc:
        text += "ue";
        break;
      case 0xe8:
      case 0xe9:
        text += "e";
        break;
      case 0xfa:
        text += "u";
        break;
      default:
        text += '?';
    }
  }
  return lowered(text);
}

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words(1);
  for (const char c : text) {
    const bool is_part = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '?';
    if (is_part) words.back() += c;
    if (!is_part && !words.back().empty()) words.emplace_back();
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

/// The parts of a name before its brackets and in them.
std::array<std::string, 2> split_at_bracket(std::string_view name) {
  const std::string text = spelled_out(name);
  const std::size_t bracket = std::min(text.find_first_of("([{"), text.size());
  return {text.substr(0, bracket), text.substr(bracket)};
}

/// The longest run of words that is a unit of length ("in feet"); of several, the last one. Empty if there is none.
std::string longest_unit(const std::vector<std::string>& words, std::size_t first) {
  for (std::size_t size = words.size(); size > 0; --size) {
    for (std::size_t k = words.size() - size + 1; k-- > first;) {
      std::string run = words[k];
      for (std::size_t i = k + 1; i < k + size; ++i) run += " " + words[i];
      if (find_metres(run)) return run;
    }
  }
  return {};
}

/// The position of the unit in a word such as "elevft"; the word's size without a unit.
std::size_t find_joined_unit(const std::string& word) {
  for (std::size_t k = 3; k + 2 <= word.size(); ++k) {
    const bool is_height =
        std::find(std::begin(kHeightWords), std::end(kHeightWords), word.substr(0, k)) != std::end(kHeightWords);
    if (is_height && find_metres(word.substr(k))) return k;
  }
  return word.size();
}

std::string plain(std::string_view name) {
  std::string joined, all;
  for (const std::string& word : words_of(split_at_bracket(name)[0])) {
    all += word;
    if (!says_nothing(word)) joined += word.substr(0, find_joined_unit(word));
  }
  return joined.empty() ? all : joined;
}

struct Found {
  ColumnRole role = ColumnRole::kSkipped;
  std::size_t rank = 0;
};

Found find(std::string_view name) {
  const std::string word = plain(name);
  for (std::size_t k = 0; k < kWords.size(); ++k) {
    const auto at = std::find(kWords[k].begin(), kWords[k].end(), word);
    if (at != kWords[k].end()) return {static_cast<ColumnRole>(k), static_cast<std::size_t>(at - kWords[k].begin())};
  }
  return {};
}

std::vector<std::string> split(const std::string& given) {
  std::vector<std::string> parts;
  if (given.find(',') == std::string::npos) {
    for (const char c : given) parts.emplace_back(1, c);
    return parts;
  }
  for (std::size_t begin = 0; begin <= given.size();) {
    const std::size_t end = std::min(given.find(',', begin), given.size());
    std::string part = given.substr(begin, end - begin);
    part.erase(0, part.find_first_not_of(' '));
    part.resize(part.find_last_not_of(' ') + 1);
    parts.push_back(std::move(part));
    begin = end + 1;
  }
  return parts;
}

}  // namespace

const char* role_name(ColumnRole role) {
  constexpr const char* kNames[] = {"x", "y", "height", "number", "code", ""};
  return kNames[static_cast<std::size_t>(role)];
}

ColumnRole role_of(std::string_view name) { return find(name).role; }
std::size_t rank_of(std::string_view name) { return find(name).rank; }

std::string unit_named_in(std::string_view name) {
  const auto [before, within] = split_at_bracket(name);
  if (std::string unit = longest_unit(words_of(within), 0); !unit.empty()) return unit;
  const std::vector<std::string> words = words_of(before);
  if (std::string unit = longest_unit(words, 1); !unit.empty()) return unit;
  return words.empty() ? "" : words[0].substr(find_joined_unit(words[0]));
}

bool is_axis_letter(std::string_view name) {
  const std::string word = plain(name);
  return word.starts_with('x') || word.starts_with('y');
}

bool names_degrees(std::string_view name) {
  const std::string word = plain(name);
  const auto begins = [&](std::string_view with) { return word.starts_with(with); };
  return begins("lon") || begins("lat") || word == "lng" || begins("laenge") || begins("breite");
}

Result<std::array<std::size_t, 3>> parse_columns(const std::string& given, std::string& words) {
  std::array<std::optional<std::size_t>, 3> at;
  const std::vector<std::string> parts = split(given);
  for (std::size_t column = 0; column < parts.size(); ++column) {
    const std::string& part = parts[column];
    const bool is_skipped = part == "-" || part == "_" || lowered(part) == "skip" || part.empty();
    const ColumnRole role = role_of(part);
    if (!is_skipped && role == ColumnRole::kSkipped)
      return fail(ErrorKind::kUsage,
                  fmt::format("--columns: {} is no column that can be named: give words such as "
                              "number,northing,easting,height,code, with - for others, or letters such as pnezd",
                              in_quotes(part)));
    words += fmt::format("{}{}{}", words.empty() ? "" : ", ", column + 1,
                         is_skipped ? " not read" : " " + std::string(role_name(role)));
    const auto axis = static_cast<std::size_t>(role);
    if (is_skipped || axis >= at.size()) continue;
    if (at[axis])
      return fail(ErrorKind::kUsage,
                  fmt::format("--columns {} names two columns {}: name each once", given, role_name(role)));
    at[axis] = column;
  }
  for (std::size_t axis = 0; axis < at.size(); ++axis) {
    constexpr const char* kMissing[] = {"x (easting)", "y (northing)", "height"};
    if (!at[axis])
      return fail(ErrorKind::kUsage,
                  fmt::format("--columns {} names no {}: name all three, such as easting,northing,height", given,
                              kMissing[axis]));
  }
  return std::array<std::size_t, 3>{*at[0], *at[1], *at[2]};
}

}  // namespace scarp::io
