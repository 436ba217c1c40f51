// The options of `scarp simplify`, as --help lists them.
#include <CLI/CLI.hpp>

#include "options/simplify_plan.h"
namespace scarp::cli {

void SimplifyArguments::add_to(CLI::App& verb) {
  const char* goals = "Goals (at least one; the first that is reached ends the run)";
  verb.add_option(
          "INPUT", raster.path,
          "Raster of heights: a file or URL that GDAL opens, PGM\nor STM; with --image any image; or scattered points")
      ->type_name("")
      ->required();
  verb.add_option("OUTPUT", output,
                  "Mesh to write: .glb, .obj, .ply, .stl, .tin, .2dm, .vtu,\n.vtp, .xml (LandXML), .dxf or .gpkg; "
                  "solids also .3mf;\n"
                  "its edges as .svg or .eps; or the approximation as .tif\nor .pgm")
      ->type_name("")
      ->required();

  verb.add_option(
          "-e,--max-error", max_error,
          "No sample is farther than this from the mesh,\nmeasured vertically: in the units of the heights, or\n"
          "as a percentage of the relief (0.5%); 0 keeps\nevery sample exactly")
      ->type_name("M|P%")
      ->group(goals);
  verb.add_option("-t,--max-triangles", max_triangles, "At most this many triangles")->type_name("N")->group(goals);
  verb.add_option("-p,--max-points", max_points, "At most this many vertices")->type_name("N")->group(goals);

  raster.add_to(
      verb,
      "Coordinates of the mesh: source (the raster's own),\nlocal (metres around its centre), grid "
      "(columns and\nrows) or a CRS such as EPSG:32611. Default: local for\ndegrees (source for .2dm, .dxf and "
      ".gpkg), else source,\nelse grid");

  verb.add_option("--nodata-policy", nodata_policy,
                  "Missing samples become: hole (default; the mesh\nhas none there), fill (interpolated) or background")
      ->type_name("POLICY")
      ->group("Missing samples");
  verb.add_option(
          "--fill-distance", fill_distance,
          "fill: farthest valid sample to interpolate from, in\nsamples (default 100); what is farther stays a hole")
      ->type_name("S")
      ->group("Missing samples");
  verb.add_option("--background", background, "background: the height to use, in the raster's units")
      ->type_name("V")
      ->group("Missing samples");
  verb.add_option("--outline-tolerance", outline_tolerance,
                  "How far the outline of the valid data may move\noutwards to become simpler, in samples (default 0)")
      ->type_name("S")
      ->group("Missing samples");

  companions.add_to(verb,
                    "Lines 's COL ROW' (becomes a vertex), 'i COL ROW' or\n'u COL ROW' (never does, and has no bound)");
  lines.add_to(verb);
  cliff.add_to(verb);
  ridges.add_to(verb);
  cut.add_to(verb);
  channels.add_to(verb);
  shape.add_to(verb);
  strategy.add_to(verb);

  verb.add_option(
          "--of", format,
          "Format: glb, obj, ply, stl, tin (triangles as text),\n2dm, vtu, vtp, landxml, dxf, gpkg, 3mf, svg or eps\n"
          "(edges), dem (the approximation as a raster).\nDefault: by OUTPUT's extension")
      ->type_name("FORMAT")
      ->group("Output");
  verb.add_flag("--normals", normals, "Vertex normals from the full-resolution raster")->group("Output");
  verb.add_flag("--uvs", uvs, "Texture coordinates of the raster's image (always\nwith --texture and --image)")
      ->group("Output");
  verb.add_option("--base", base,
                  "Close the mesh into a watertight solid with a flat\nbase at this height, in the raster's units")
      ->type_name("H")
      ->group("Output");
  solid.add_to(verb);
  verb.add_option("--preview", preview, "Also draw a hillshade with the mesh over it")
      ->type_name("FILE.png")
      ->group("Output");
  verb.add_option("--render", render,
                  "Also draw the approximation, one pixel a sample: in\nits colours or as a hillshade")
      ->type_name("FILE.png")
      ->group("Output");
  verb.add_option("--error-raster", error_raster,
                  "Also write the errors, mesh minus sample, as GeoTIFF\n(--image: their norm over the bands)")
      ->type_name("FILE.tif")
      ->group("Output");
  verb.add_option("--report", report, "Also write the numbers of this run as JSON")
      ->type_name("FILE.json")
      ->group("Output");
  verb.add_flag("--overwrite", overwrite, "Replace files that exist (default: refuse)")->group("Output");

  verb.add_option("-j,--num-threads", threads, "Threads, 0 = all cores (default); never changes the result")
      ->type_name("N")
      ->group("Run");
  memory.add_to(
      verb,
      "Most memory that this run may take, such as 1G; what a\nlarger raster holds is read where it is needed "
      "(see\ndocs/cli.md for what that leaves out)");
  verb.add_flag("-q,--quiet", quiet, "No summary, no progress, no warnings")->group("Run");
  verb.add_flag("--timing", timing, "After the summary: what each pass took and did")->group("Run");
  verb.add_flag("--json-progress", json_progress, "Progress as one JSON object a line on stderr")->group("Run");
  verb.footer(
      "Examples:\n"
      "  scarp simplify dem.tif hills.glb -e 1            every sample within 1 m\n"
      "  scarp simplify dem.tif hills.obj -e 0.5%         within half a percent of the relief\n"
      "  scarp simplify dem.tif hills.glb -t 5000 --preview hills.png --report hills.json\n"
      "  scarp simplify dem.tif print.3mf -e 1 --solid size=120mm                 a solid for a 3-D printer\n"
      "  scarp simplify tile.png tile.glb -e 1 --decode terrarium\n"
      "  scarp simplify survey.csv hills.glb -e 0.5       scattered points: x, y, z\n"
      "  scarp simplify dem.tif hills.glb -e 1 --edges data --edge-score tight    fewer triangles\n"
      "  scarp simplify dem.tif hills.glb -e 1 --texture ortho.tif                colours count too\n"
      "  scarp simplify photo.png photo.glb -p 2000 --image --render seen.png\n"
      "'scarp info dem.tif' suggests errors. 'scarp measure dem.tif hills.glb' checks a mesh.\n"
      "Exit codes: 0 ok, 1 usage, 2 input, 3 promise not met, 4 output, 5 interrupted, 70 internal error.");
}

}  // namespace scarp::cli
