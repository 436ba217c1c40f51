// Media types by file ending, as browsers and globes expect them.
#pragma once

#include <string_view>

namespace scarp::cli {

/// "application/octet-stream" for an unknown ending.
std::string_view media_type_of(std::string_view name);

}  // namespace scarp::cli
