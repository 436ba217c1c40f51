#include "session/table/format_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <vector>

namespace scarp::cli {
namespace {

constexpr const char* kOtherFormats[] = {"svg", "eps", "dem"};
constexpr const char* kOtherEndings[] = {".svg", ".eps", ".tif", ".pgm"};

using Words = std::vector<std::string>;

std::string list(const Words& words, std::string_view last) {
  if (words.size() < 2) return words.empty() ? "" : words[0];
  return fmt::format("{} {} {}", fmt::join(words.begin(), words.end() - 1, ", "), last, words.back());
}

bool is_any(const MeshFormatTraits& /*traits*/) { return true; }

bool is_readable(const MeshFormatTraits& traits) { return traits.is_read; }

/// The usual ending of each selected format, or all its endings.
Words endings_of(OfFormat is_so, bool all = false) {
  Words words;
  for (const MeshFormatTraits* traits : mesh_formats()) {
    if (!is_so(*traits)) continue;
    const Words endings = list_endings(*traits);
    words.insert(words.end(), endings.begin(), all ? endings.end() : endings.begin() + 1);
  }
  return words;
}

Words names() {
  Words words;
  for (const MeshFormatTraits* traits : mesh_formats()) words.emplace_back(traits->name);
  words.insert(words.end(), std::begin(kOtherFormats), std::end(kOtherFormats));
  return words;
}

Words with_others(Words endings) {
  endings.insert(endings.end(), std::begin(kOtherEndings), std::end(kOtherEndings));
  return endings;
}

const char* keep_words(const Words& words) { return keep(fmt::format("{}", fmt::join(words, " "))); }

}  // namespace

std::vector<std::string> list_endings(const MeshFormatTraits& traits) {
  std::vector<std::string> words;
  for (std::string_view rest = traits.endings; !rest.empty();) {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    words.push_back("." + std::string(rest.substr(0, end)));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return words;
}

std::string list_mesh_endings(OfFormat is_so, std::string_view last) { return list(endings_of(is_so), last); }

std::string list_readable_meshes() {
  Words titles;
  for (const MeshFormatTraits* traits : mesh_formats()) {
    if (traits->is_read) titles.emplace_back(traits->title);
  }
  return list(titles, "or");
}

std::string list_output_formats() { return list(names(), "or"); }

std::string list_output_endings() { return list(with_others(endings_of(is_any)), "or"); }

const char* output_formats() { return keep_words(names()); }

const char* output_endings() { return keep_words(with_others(endings_of(is_any, true))); }

const char* mesh_endings() { return keep_words(endings_of(is_readable, true)); }

const char* keep(std::string text) {
  static std::deque<std::string> kept;
  return kept.emplace_back(std::move(text)).c_str();
}

}  // namespace scarp::cli
