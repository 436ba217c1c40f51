// Prints the rows of the table of options that are also settings of the npm package, for pack.mjs: a line each, its
// values separated by tabs.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "scarp/io.h"
#include "scarp/options.h"
#include "session/table/option_table.h"

namespace scarp {

/// No setting names a file's format.
std::span<const MeshFormatTraits* const> mesh_formats() { return {}; }

}  // namespace scarp

namespace {

using namespace scarp::cli;
using enum OptionId;

struct Setting {
  const char* name;
  OptionId id;
  /// The library numbers the choices backwards.
  bool is_reversed = false;
};

constexpr Setting kOfSimplify[] = {{"maxError", kMaxError},       {"maxTriangles", kMaxTriangles},
                                   {"maxVertices", kMaxPoints},   {"effort", kEffort},
                                   {"vertices", kVertices, true}, {"order", kOrder, true},
                                   {"objective", kObjective},     {"duplicates", kDuplicates},
                                   {"minShape", kMinShape},       {"outlineTolerance", kOutlineTolerance},
                                   {"normals", kNormals},         {"uvs", kUvs},
                                   {"doubles", kDouble},          {"compress", kCompress},
                                   {"lockBorder", kLockBorder},   {"mask", kMask},
                                   {"tolerance", kTolerance},     {"nodata", kNodata}};
static_assert(scarp::Vertices::kSamples < scarp::Vertices::kFree && scarp::Order::kGreedy < scarp::Order::kDominant);
constexpr Setting kOfTile[] = {{"cells", kCells},     {"maxZoom", kZoom},  {"maxError", kMaxError},
                               {"quality", kQuality}, {"effort", kEffort}, {"background", kBackground}};

void print(Commands command, std::span<const Setting> settings) {
  for (const Setting& setting : settings) {
    const OptionRow* const found = find_option(command, setting.id);
    if (found == nullptr) throw std::logic_error(setting.name);
    const OptionRow& row = *found;
    auto choices = row.list_choices();
    if (setting.is_reversed) std::reverse(choices.begin(), choices.end());
    fmt::print("{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\n", command_name(command), setting.name, type_name(row.type),
               fmt::join(choices, " "), row.least, row.above, row.most, row.range, row.by_default, row.help);
  }
}

}  // namespace

int main() {
  print(kSimplify, kOfSimplify);
  print(kTile, kOfTile);
}
