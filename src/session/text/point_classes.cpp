#include "session/text/point_classes.h"

#include <algorithm>
#include <charconv>
#include <system_error>

namespace scarp::cli {
namespace {

struct ClassRow {
  int number;
  std::string_view name;
  std::string_view group = {};  ///< a word for several
};

constexpr ClassRow kClasses[] = {{0, "created", "unclassified"},
                                 {1, "unclassified"},
                                 {2, "ground"},
                                 {3, "low-vegetation", "vegetation"},
                                 {4, "medium-vegetation", "vegetation"},
                                 {5, "high-vegetation", "vegetation"},
                                 {6, "building"},
                                 {7, "low-noise", "noise"},
                                 {8, "key-point"},
                                 {9, "water"},
                                 {10, "rail"},
                                 {11, "road"},
                                 {12, "overlap"},
                                 {13, "wire-guard", "wire"},
                                 {14, "wire-conductor", "wire"},
                                 {15, "transmission-tower"},
                                 {16, "wire-connector", "wire"},
                                 {17, "bridge"},
                                 {18, "high-noise", "noise"},
                                 {19, "overhead"},
                                 {20, "ignored-ground"},
                                 {21, "snow"},
                                 {22, "temporal-exclusion"}};

}  // namespace

std::string_view class_name(int number) {
  for (const ClassRow& row : kClasses) {
    if (row.number == number) return row.name;
  }
  return "";
}

std::vector<std::uint8_t> find_classes(std::string_view word) {
  if (word.empty()) return {};
  std::uint8_t number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (!word.empty() && end == word.data() + word.size() && error == std::errc()) return {number};
  std::vector<std::uint8_t> found;
  for (const ClassRow& row : kClasses) {
    if (row.name == word || row.group == word) found.push_back(static_cast<std::uint8_t>(row.number));
  }
  return found;
}

std::string list_class_names() {
  std::vector<std::string_view> names;
  for (const ClassRow& row : kClasses) {
    const std::string_view name = row.group.empty() ? row.name : row.group;
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  std::string text;
  for (const std::string_view name : names) text += (text.empty() ? "" : ", ") + std::string(name);
  return text;
}

}  // namespace scarp::cli
