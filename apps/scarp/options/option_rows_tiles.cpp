// Pyramids of tiles on the globe.
#include "options/option_rows.h"

namespace scarp::cli {
namespace {

using enum OptionId;
using enum OptionType;

constexpr OptionRow kTileRows[] = {
    {.id = kMaxError,
     .name = "--max-error",
     .short_name = "-e",
     .commands = kTile,
     .group = OptionGroup::kLevels,
     .type = kNumber,
     .value = "M",
     .unit = "metres",
     .by_default = "a quarter of the geometric error that clients assume for the finest level",
     .range = "above 0",
     .help = "Max error of the tiles of the finest level, at their nodes.",
     .brief = "Max error of the finest level, in metres"},
    {.id = kQuality,
     .name = "--quality",
     .commands = kTile,
     .group = OptionGroup::kLevels,
     .type = kNumber,
     .value = "Q",
     .by_default = "2",
     .range = "at least 0.5",
     .help = "Max error of the coarser levels: the geometric error that clients assume, over Q."},
    {.id = kZoom,
     .name = "--zoom",
     .commands = kTile,
     .group = OptionGroup::kLevels,
     .type = kCount,
     .value = "Z",
     .unit = "level",
     .by_default = "the first level whose nodes are at most 1.1 cells of the raster apart",
     .range = "0 to 23",
     .help = "The finest level. All from 0 to Z are made.",
     .brief = "The finest level"},
    {.id = kCells,
     .name = "--cells",
     .commands = kTile,
     .group = OptionGroup::kLevels,
     .type = kChoice,
     .value = "N",
     .choices = "16 32 64 128 256",
     .by_default = "128",
     .help = "Cells between the nodes of a tile of the finest level, each way."},
    {.id = kEffort,
     .name = "--effort",
     .commands = kTile,
     .group = OptionGroup::kEffort,
     .type = kChoice,
     .value = "LEVEL",
     .choices = "fast normal high",
     .by_default = "normal",
     .help = "How much work to do for fewer triangles. The max errors are the same.",
     .brief = "fast, normal or high: fewer triangles for more time"},
    {.id = kVertical,
     .name = "--vertical",
     .commands = kTile,
     .group = OptionGroup::kInput,
     .type = kChoice,
     .value = "DATUM",
     .choices = "auto egm96 ellipsoid",
     .by_default = "auto",
     .help = "What the heights are above. auto: what the raster's CRS says, which must name a vertical datum. egm96: "
             "the sea. ellipsoid: the ellipsoid of WGS 84, as GPS gives heights.",
     .brief = "What heights are above: egm96 (the sea) or ellipsoid"},
    {.id = kBackground,
     .name = "--background",
     .commands = kTile,
     .group = OptionGroup::kNodata,
     .type = kNumber,
     .value = "V",
     .unit = "metres above the ellipsoid",
     .by_default = "0",
     .help = "Height of nodata, and of the globe around the raster, above the ellipsoid, whatever --vertical says.",
     .brief = "Height of nodata and of the globe around, above the ellipsoid"},
};

}  // namespace

std::span<const OptionRow> tile_rows() { return kTileRows; }

}  // namespace scarp::cli
