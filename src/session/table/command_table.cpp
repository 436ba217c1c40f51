// The commands, and the text of their help below the options.
#include "session/table/option_table.h"

namespace scarp::cli {
namespace {

constexpr CommandRow kCommandRows[] = {
    {kSimplify, "simplify", "Turn a raster of heights into a small mesh with a proven error bound",
     "INPUT OUTPUT [OPTIONS]",
     "Examples:\n"
     "  scarp simplify dem.tif hills.glb -e 1                  every sample within 1 m\n"
     "  scarp simplify dem.tif hills.glb -e 1 --effort high    fewer triangles, more time\n"
     "  scarp simplify dem.tif hills.obj -e 0.5%               half a percent of the relief\n"
     "  scarp simplify dem.tif hills.glb -t 50k --preview hills.png --report hills.json\n"
     "  scarp simplify dem.tif flood.2dm -e 0.5 --breaklines dikes.gpkg --min-angle 25\n"
     "  scarp simplify dem.tif print.3mf -e 0.1mm --solid size=120mm\n"
     "  scarp simplify survey.csv hills.glb -e 0.5             scattered points: x, y, z\n"
     "  scarp simplify tile.png tile.glb -e 1 --decode terrarium    a tile from the web\n"
     "'scarp info dem.tif' suggests errors. 'scarp measure dem.tif hills.glb' checks a mesh.\n"
     "Exit codes: 0 ok, 1 usage, 2 input, 3 promise not met, 4 output, 5 interrupted, 70 internal error.\n"},
    {kClassic, "classic", "Simplify by the strategies of the 1995 paper", "INPUT OUTPUT [OPTIONS]",
     "All options of simplify apply. The error bound is proven in the same way.\n"
     "Examples:\n"
     "  scarp classic dem.tif hills.glb -e 1 --order greedy           the paper's algorithm III\n"
     "  scarp classic dem.tif hills.glb -t 5k --edges data            data-dependent triangulation\n"
     "  scarp classic dem.tif hills.glb -t 5k --importance curvature --one-pass\n"
     "Exit codes: 0 ok, 1 usage, 2 input, 3 promise not met, 4 output, 5 interrupted, 70 internal error.\n"},
    {kMeasure, "measure", "Judge a mesh file against its raster, sample by sample; or measure volumes between meshes",
     "RASTER MESH [OPTIONS]",
     "Repeat --mask, --script, --cutline, --texture and --image as given to simplify.\n"
     "Errors are vertical, mesh minus sample, in the units of the heights.\n"
     "Examples:\n"
     "  scarp measure dem.tif hills.glb                      a table of errors and faults\n"
     "  scarp measure dem.tif hills.glb --fail-above 1       exit code 3 unless every error is within 1 m\n"
     "  scarp measure dem.tif hills.obj --json --map error.png\n"
     "  scarp measure dem.tif hills.glb --tolerance t.tif    exit code 3 if a sample breaks its tolerance\n"
     "  scarp measure dem.tif hills.glb --script outliers.txt --fail-above 1\n"
     "  scarp measure photo.png photo.glb --image --fail-above 8\n"
     "  scarp measure before.glb after.glb --volume          cut and fill, from before to after\n"
     "  scarp measure pit.glb level=512.5 --volume           volumes above and below that level\n"
     "Exit codes: 0 ok, 1 usage, 2 input, 3 promise not met, 4 output, 5 interrupted, 70 internal error.\n"},
    {kView, "view", "Write a page that shows a mesh and its errors in a browser", "MESH [RASTER] [OPTIONS]",
     "One HTML file that opens from disk and needs no network: hillshade, wireframe, error map, profile.\n"
     "Examples:\n"
     "  scarp view hills.glb dem.tif                         hills.html\n"
     "  scarp view hills.glb dem.tif -o page.html --open     also opens the page\n"
     "  scarp view hills_lod0.glb dem.tif                    all levels of --lods\n"
     "  scarp view globe.pmtiles                             the finest levels of a set of tiles\n"
     "Exit codes: 0 ok, 1 usage, 2 input, 3 promise not met, 4 output, 70 internal error.\n"},
    {kTile, "tile", "Make a pyramid of terrain tiles for globes: quantized-mesh or 3D Tiles, for CesiumJS and others",
     "INPUT OUTPUT [OPTIONS]",
     "Neighbouring tiles have identical edges. The error bound of each includes the earth's curve.\n"
     "OUTPUT is a folder, or one file: .pmtiles, .mbtiles or .3tz.\n"
     "Serve the folder with the header 'Content-Encoding: gzip' for its .terrain files.\n"
     "Examples:\n"
     "  scarp tile dem.tif globe --vertical egm96            heights above the sea, all levels\n"
     "  scarp tile dem.tif globe                             the raster's CRS names its vertical datum\n"
     "  scarp tile dem.tif globe.pmtiles                     all tiles in one file\n"
     "  scarp tile north.tif south.tif globe --effort high   a mosaic, in fewer triangles\n"
     "  scarp tile ground.laz globe --vertical egm96         points, which become a raster first\n"
     "  scarp tile dem.tif globe -e 2 --zoom 14              the finest level and its max error\n"
     "  scarp tile dem.tif globe --of 3dtiles                3D Tiles: tileset.json, subtrees, GLB files\n"
     "Exit codes: 0 ok, 1 usage, 2 input, 3 promise not met, 4 output, 5 interrupted, 70 internal error.\n"},
    {kTilePlan, "tile-plan", "Plan tiles that many processes make, on one machine or a cluster", "INPUT PLAN [OPTIONS]",
     "Also spelled scarp tile plan. It makes a few tiles to estimate the cost of all.\n"
     "Examples:\n"
     "  scarp tile plan dem.tif world.json --vertical egm96\n"
     "  scarp tile plan dem.tif world.json --slurm run.sh    then: bash run.sh world\n"
     "  scarp tile plan dem.tif new.json --changed-since world.json    only changed blocks\n"
     "Exit codes: 0 ok, 1 usage, 2 input, 4 output, 5 interrupted, 70 internal error.\n"},
    {kTileRun, "tile-run", "Make a share of the tiles of a plan", "PLAN [OPTIONS]",
     "Also spelled scarp tile run. Any process may make any share; the tiles are the same. Each finished\n"
     "block is saved at once, so a killed run resumes where it stopped.\n"
     "Examples:\n"
     "  scarp tile run world.json                     all blocks that are missing\n"
     "  scarp tile run world.json --shard 3/200 -j 1\n"
     "Exit codes: 0 ok, 1 usage, 2 input, 4 output, 5 interrupted, 70 internal error.\n"},
    {kTileFinish, "tile-finish", "Join the parts of a plan into a set of tiles", "PLAN OUTPUT [OPTIONS]",
     "Also spelled scarp tile finish. It makes the levels above the blocks. The set is the same as that of\n"
     "scarp tile, byte for byte.\n"
     "Examples:\n"
     "  scarp tile finish world.json world\n"
     "Exit codes: 0 ok, 1 usage, 2 input, 4 output, 5 interrupted, 70 internal error.\n"},
    {kTileCheck, "tile-check", "Check a finished set of tiles: borders, bounds, coverage, headers, availability",
     "SET [OPTIONS]",
     "Also spelled scarp tile check. SET is a folder, .pmtiles, .mbtiles or .3tz, of Scarp or another\n"
     "program.\n"
     "With --source each tile is compared with all nodes below it; repeat the raster's options as given\n"
     "to scarp tile.\n"
     "Examples:\n"
     "  scarp tile check globe                                     exit code 3 on any fault\n"
     "  scarp tile check globe --source dem.tif --vertical egm96   checks bounds, too\n"
     "  scarp tile check world.pmtiles --source world.json --json\n"
     "Exit codes: 0 ok, 1 usage, 2 input, 3 promise not met, 4 output, 5 interrupted, 70 internal error.\n"},
    {kServe, "serve", "Serve tiles over HTTP, from a set or a raster, by default only to this machine",
     "INPUT [OPTIONS]",
     "Tiles have the headers that clients need; a set in one file also supports range requests.\n"
     "Tiles of a raster or a plan are made on request. Ctrl-C ends the server.\n"
     "Examples:\n"
     "  scarp serve globe                                    at http://127.0.0.1:8080/\n"
     "  scarp serve dem.tif --vertical egm96                 tiles made on request\n"
     "  scarp serve world.pmtiles --port 0                   on a free port, which is printed\n"
     "  scarp serve world.mbtiles --host 0.0.0.0             to other machines\n"
     "Exit codes: 0 ok, 1 usage, 2 input, 4 output, 5 interrupted, 70 internal error.\n"},
    {kInfo, "info", "Describe a raster, points or a mesh, and suggest errors for a raster", "FILE [OPTIONS]",
     "Facts are printed at once. Suggested errors follow. The engine finds them on a whole raster of up\n"
     "to 2 million samples, and estimates them on windows of a larger raster.\n"
     "Examples:\n"
     "  scarp info dem.tif\n"
     "  scarp info huge.tif --no-suggest\n"
     "  scarp info hills.glb\n"
     "  scarp info N27E086.hgt.zip --json\n"
     "Exit codes: 0 ok, 1 usage, 2 input, 4 output, 5 interrupted, 70 internal error.\n"},
    {kGenerate, "generate", "Make a synthetic raster of heights", "STYLE COLS ROWS OUTPUT [OPTIONS]",
     "Styles: cliff (h), step (x), sharp-step (X), diagonal-step (d), sharp-diagonal-step (D),\n"
     "parabola (q), paraboloid (p), scaled-paraboloid (P), pyramid (o), diagonal-pyramid (r), fractal,\n"
     "smooth.\n"
     "The bytes are the same on every machine.\n"
     "Examples:\n"
     "  scarp generate cliff 256 256 cliff.tif\n"
     "  scarp generate fractal 1000 800 hills.tif --seed 7 --range 1200 --size 30\n"
     "  scarp generate D 256 256 step.pgm\n"
     "Exit codes: 0 ok, 1 usage, 4 output, 70 internal error.\n"},
    {kHelpCommand, "help", "Explain a command, or print the table of options", "[COMMAND] [OPTIONS]",
     "Examples:\n"
     "  scarp help simplify              the same as scarp simplify --help\n"
     "  scarp help simplify --all        the same as scarp simplify --help-all\n"
     "  scarp help --json                every command and option, for programs that build on Scarp\n"
     "Exit codes: 0 ok, 1 usage, 4 output, 70 internal error.\n"},
    {kVersionCommand, "version", "Print the version", "", "Exit codes: 0 ok, 1 usage, 4 output.\n"},
};

}  // namespace

std::span<const CommandRow> command_rows() { return kCommandRows; }

}  // namespace scarp::cli
