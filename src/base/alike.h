// Suggestions for misspelt names.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#pragma GCC visibility push(default)

namespace scarp {

/// Edit distance: the number of letters to change, add, remove or swap with a neighbour.
std::size_t count_typos(std::string_view a, std::string_view b);

/// The names that begin with the word; else those with the fewest typos (at most 2, and at most one per three letters
/// of the word); else the only name that contains the word. Empty if no name is similar.
std::vector<std::string> find_alike(const std::string& word, const std::vector<std::string>& names);

/// A question, "did you mean a.tif or b.tif?", about the first few names, each with the prefix. Empty if `alike` is
/// empty.
std::string ask_for(const std::vector<std::string>& alike, const std::string& prefix = "");

}  // namespace scarp

#pragma GCC visibility pop
