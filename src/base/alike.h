// Names that are like a word: what a typo may have meant.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#pragma GCC visibility push(default)

namespace scarp {

/// Letters to change, add, omit or exchange with their neighbours until one word is the other.
std::size_t count_typos(std::string_view a, std::string_view b);

/// Those of the names that begin with the word, else those with the fewest typos (at most 2, and one for three letters
/// of the word), else the only one that holds the word. Empty if none is.
std::vector<std::string> find_alike(const std::string& word, const std::vector<std::string>& names);

/// "did you mean a.tif or b.tif?", the first few of them, each behind the prefix; empty without any.
std::string ask_for(const std::vector<std::string>& alike, const std::string& prefix = "");

}  // namespace scarp

#pragma GCC visibility pop
