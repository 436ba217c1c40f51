// The layers that --layer names.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

namespace scarp::io {

/// The names in `wanted`: all of it if it is a layer's name, even with commas; else the parts between commas.
template <class Exists>
std::vector<std::string> layer_list(const std::string& wanted, Exists&& exists) {
  if (exists(wanted)) return {wanted};
  std::vector<std::string> names;
  for (std::size_t begin = 0; begin < wanted.size();) {
    const std::size_t end = std::min(wanted.find(',', begin), wanted.size());
    names.push_back(wanted.substr(begin, end - begin));
    begin = end + 1;
  }
  return names;
}

}  // namespace scarp::io
