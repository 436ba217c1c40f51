// Suggestions for misspelt names.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#pragma GCC visibility push(default)

namespace scarp {

/// Edit distance: letters to change, add, omit or swap with a neighbour.
std::size_t count_typos(std::string_view a, std::string_view b);

/// The names that begin with the word; else those with the fewest typos (at most 2, and one per three letters of the
/// word); else the name that contains the word, if it is the only one. Empty if none is similar.
std::vector<std::string> find_alike(const std::string& word, const std::vector<std::string>& names);

/// "did you mean a.tif or b.tif?" for the first few, each behind the prefix. Empty if `alike` is.
std::string ask_for(const std::vector<std::string>& alike, const std::string& prefix = "");

}  // namespace scarp

#pragma GCC visibility pop
