// Types of files by their names' endings, as browsers and globes expect them.
#pragma once

#include <string_view>

namespace scarp::cli {

/// "application/octet-stream" where the ending is not known.
std::string_view media_type_of(std::string_view name);

}  // namespace scarp::cli
