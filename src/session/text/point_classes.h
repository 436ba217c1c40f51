// Names of the ASPRS point classes of LAS files.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace scarp::cli {

/// "ground" for 2; empty for a number without a name.
std::string_view class_name(int number);
/// The numbers that the word stands for: {2} for "ground" and "2", {3, 4, 5} for "vegetation"; empty for other words.
std::vector<std::uint8_t> find_classes(std::string_view word);
/// "ground, water, noise …", for sentences.
std::string list_class_names();

}  // namespace scarp::cli
