// Files that hold something else than rasters or points that Scarp reads.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace scarp {

/// The kind of the file, by its first bytes, else by the end of its name, and the way to a file that is read: the rest
/// of a sentence. Empty for what is not known. `by_name`: false, the first bytes decide alone.
std::string describe_kind(const std::string& path, std::string_view head, std::uint64_t bytes, bool by_name = true);

}  // namespace scarp
