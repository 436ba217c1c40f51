// The same scenes under the same max error by greedy insertion and by each effort: the mesh over the relief, all of a
// scene in the same light and scale.
//
//   scarp_pictures PROJECT FOLDER PICTURES.csv     FOLDER/effort_SCENE_VARIANT.png, and how many triangles each shows

#include <fmt/format.h>

#include <cstdio>

#include "files.h"
#include "scarp/scarp.h"
#include "variants.h"

namespace {

/// A square window of a raster.
struct Scene {
  const char* name;
  const char* file;
  int first_col, first_row, side;
  double max_error;  ///< in z units
  int pixels;        ///< of the picture's side
};

constexpr Scene kScenes[] = {
    {"fuji", "fuji.tif", 204, 114, 192, 25, 384},
    {"essen", "nrw_dom1_essen.tif", 300, 300, 128, 2, 384},
};
constexpr std::string_view kShown[] = {"greedy", "normal", "high"};

scarp::OwnedHeightField cut(const scarp::OwnedHeightField& field, const Scene& scene) {
  scarp::OwnedHeightField window;
  window.cols = window.rows = scene.side;
  window.frame = scarp::grid_frame(scene.side);
  for (int row = 0; row < scene.side; ++row) {
    const auto first = field.samples.begin() + std::ptrdiff_t{scene.first_row + row} * field.cols + scene.first_col;
    window.samples.insert(window.samples.end(), first, first + scene.side);
  }
  return window;
}

int draw(const Scene& scene, const scarp::OwnedHeightField& window, const std::string& folder, std::string& table) {
  for (const std::string_view variant : kShown) {
    const auto made = scarp::simplify(window, bench::options_of(*bench::find_variant(variant), scene.max_error));
    if (!made) return bench::fail_with(made.error().message);
    const auto png = scarp::encode_png(*scarp::draw_preview(window, made->mesh, scene.pixels));
    if (!png) return bench::fail_with(png.error().message);
    const std::string picture = fmt::format("effort_{}_{}.png", scene.name, variant);
    if (const auto written = scarp::write_file(folder + "/" + picture, *png); !written)
      return bench::fail_with(written.error().message);
    table += fmt::format("{},{},{},{:g},{},{},{},{:.7g}\n", scene.name, scene.file, scene.side, scene.max_error,
                         variant, picture, made->mesh.triangle_count(), made->measurement.max_error);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    fmt::print(stderr, "usage: scarp_pictures PROJECT FOLDER PICTURES.csv\n");
    return 1;
  }
  std::string table = "scene,raster,side,max_error_asked,effort,picture,triangles,max_error\n";
  for (const Scene& scene : kScenes) {
    const auto path = bench::find_raster(argv[1], scene.file);
    if (!path) return bench::fail_with(fmt::format("{} is not there", scene.file));
    const auto field = scarp::read_height_field(*path);
    if (!field) return bench::fail_with(field.error().message);
    if (const int code = draw(scene, cut(*field, scene), argv[2], table)) return code;
  }
  return bench::write_table(argv[3], table);
}
