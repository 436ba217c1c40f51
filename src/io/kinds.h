// Unsupported kinds of files.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace scarp::io {

/// The end of an error message for text in UTF-16, with a command that converts it. Empty for other files.
std::string describe_wide_text(const std::string& path, std::string_view head);

/// The same for text with the mark of UTF-8, which drivers for grids and drawings do not recognise; XML may have one.
std::string describe_marked_text(const std::string& path, std::string_view head);

/// The end of an error message: the kind of the file, and how to convert it to a supported kind. The kind is found by
/// the first bytes or else, if `by_name`, by the extension. Empty if unknown.
std::string describe_kind(const std::string& path, std::string_view head, std::uint64_t bytes, bool by_name = true);

}  // namespace scarp::io
