#include "base/alike.h"

#include <algorithm>
#include <iterator>

namespace scarp {

std::size_t count_typos(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> steps(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      std::size_t& least = steps[i][j];
      if (i == 0 || j == 0) {
        least = i + j;
        continue;
      }
      least = std::min({steps[i - 1][j] + 1, steps[i][j - 1] + 1, steps[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        least = std::min(least, steps[i - 2][j - 2] + 1);
    }
  }
  return steps[a.size()][b.size()];
}

std::vector<std::string> find_alike(const std::string& word, const std::vector<std::string>& names) {
  std::vector<std::string> alike;
  const auto choose = [&](const auto& is_chosen) {
    std::copy_if(names.begin(), names.end(), std::back_inserter(alike), is_chosen);
  };
  if (word.size() >= 2) choose([&](const std::string& name) { return name.starts_with(word); });
  constexpr std::size_t kLongest = 64;  // longer words are not compared: the cost is quadratic
  if (!alike.empty() || word.size() > kLongest) return alike;
  const std::size_t most = std::min<std::size_t>(2, word.size() / 3);
  for (std::size_t steps = 1; alike.empty() && steps <= most; ++steps)
    choose([&](const std::string& name) { return count_typos(word, name) == steps; });
  if (!alike.empty() || word.size() < 4) return alike;
  choose([&](const std::string& name) { return name.find(word) != std::string::npos; });
  return alike.size() == 1 ? alike : std::vector<std::string>();
}

std::string ask_for(const std::vector<std::string>& alike, const std::string& prefix) {
  constexpr std::size_t kMost = 4;
  const std::size_t count = std::min(alike.size(), kMost);
  std::string text;
  for (std::size_t k = 0; k < count; ++k)
    text += (k == 0 ? "did you mean " : k + 1 < count ? ", " : " or ") + (prefix + alike[k]);
  return text.empty() ? text : text + "?";
}

}  // namespace scarp
