// Unsupported kinds of files.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace scarp {

/// The rest of an error message: the kind of the file, by its first bytes or else its extension, and how to convert it
/// to a supported one. Empty if unknown. `by_name`: also use the extension.
std::string describe_kind(const std::string& path, std::string_view head, std::uint64_t bytes, bool by_name = true);

}  // namespace scarp
