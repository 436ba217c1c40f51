// The options that stand for the library's settings.
#pragma once

#include <iterator>

#include "scarp/conflicts.h"

namespace scarp::cli {

/// In the order of Field; null where no option gives the setting.
inline constexpr const char* kFieldOptions[] = {
    "--max-error",
    "--max-triangles",
    "--max-points",
    "--outline-tolerance",
    "--lock-border",
    nullptr,  // positions are as the format has them
    "--mask",
    "--mask",
    "--tolerance",
    "--tolerance",
    "--breaklines",
    "--cliff",
    "--ridges",
    "--cutline",
    "--script",
    "--script",
    "--order greedy",
    "--order dominant",
    "--effort fast",
    "--effort normal",
    "--effort high",
    "--effort max",
    "--vertices samples",
    "--vertices free",
    "--min-shape",
    "--min-angle",
    "--time-limit",
    nullptr,  // Ctrl-C
    "--objective rms",
    "--importance",
    "--lods",
    "--norm",
    "--compress",
    "--uvs",
    "--normals",
    "--num-threads",
    "--memory",
    "--texture",
    "--crs",
    "--crs enu",
    "--memory",
    "--grid mercator",
    "--grid local",
    "--of qm",
    "--of 3dtiles",
    "--water",
    "--rivers",
    "--watermask",
    "--breaklines",
    "--drape",
    "--only",
    "--geoid",
    "--vertical",
};
static_assert(std::size(kFieldOptions) == kFieldCount);

/// The option that gives a setting, with its value where that matters; null where none does.
constexpr const char* option_of(Field field) { return kFieldOptions[static_cast<int>(field)]; }

}  // namespace scarp::cli
