// The same scenes under the same max error by greedy insertion and by each effort, and under the same budget by each
// objective: the mesh over the relief, all of a scene in the same light and scale.
//
//   scarp_pictures PROJECT FOLDER PICTURES.csv     FOLDER/effort_SCENE_VARIANT.png, and what each shows

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
  double max_error;      ///< in z units
  int pixels;            ///< pixels of the picture's longer side, at most, its legend included
  std::uint64_t budget;  ///< triangles that both objectives get; 0: neither is drawn
};

/// The table's row for a picture.
struct Row {
  std::string scene, variant, goal;
};

constexpr Scene kScenes[] = {
    {"fuji", "fuji.tif", 204, 114, 192, 25, 440, 800},
    {"essen", "nrw_dom1_essen.tif", 300, 300, 128, 2, 440, 0},
};
constexpr std::string_view kShown[] = {"greedy", "normal", "high"};
/// Variants of a budget, and the objectives that they are drawn for.
constexpr std::pair<const char*, const char*> kObjectives[] = {{"high", "max"}, {"high rms", "rms"}};

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

/// The mesh of some variant, drawn and listed in the table; the program's exit code.
int draw(const Scene& scene, const scarp::OwnedHeightField& window, const scarp::SimplifyOptions& options,
         const Row& row, const std::string& folder, std::string& table) {
  const auto made = scarp::simplify(window, options);
  if (!made) return bench::fail_with(made.error().message);
  const auto picture = scarp::draw_preview(window, made->mesh, {.max_side = scene.pixels});
  if (!picture) return bench::fail_with(picture.error().message);
  const auto png = scarp::encode_png(*picture);
  if (!png) return bench::fail_with(png.error().message);
  const std::string name = fmt::format("effort_{}_{}.png", row.scene, row.variant);
  if (const auto written = scarp::write_file(folder + "/" + name, *png); !written)
    return bench::fail_with(written.error().message);
  table += fmt::format("{},{},{},{},{},{},{},{:.7g},{:.7g}\n", row.scene, scene.file, scene.side, row.goal, row.variant,
                       name, made->mesh.triangle_count(), made->measurement.max_error, made->measurement.rmse);
  return 0;
}

int draw_all(const Scene& scene, const scarp::OwnedHeightField& window, const std::string& folder, std::string& table) {
  for (const std::string_view variant : kShown) {
    const auto options = bench::options_of(*bench::find_variant(variant), scene.max_error);
    const Row row{scene.name, std::string(variant), fmt::format("{:g}", scene.max_error)};
    if (const int code = draw(scene, window, options, row, folder, table)) return code;
  }
  if (scene.budget == 0) return 0;
  for (const auto& [variant, objective] : kObjectives) {
    const auto options = bench::options_of(*bench::find_budget_variant(variant), scene.budget);
    const Row row{fmt::format("{}_budget", scene.name), objective, fmt::format("{} triangles", scene.budget)};
    if (const int code = draw(scene, window, options, row, folder, table)) return code;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    fmt::print(stderr, "usage: scarp_pictures PROJECT FOLDER PICTURES.csv\n");
    return 1;
  }
  std::string table = "scene,raster,side,goal,effort,picture,triangles,max_error,rmse\n";
  for (const Scene& scene : kScenes) {
    const auto path = bench::find_raster(argv[1], scene.file);
    if (!path) return bench::fail_with(fmt::format("{} is not there", scene.file));
    const auto field = scarp::read_height_field(*path);
    if (!field) return bench::fail_with(field.error().message);
    if (const int code = draw_all(scene, cut(*field, scene), argv[2], table)) return code;
  }
  return bench::write_table(argv[3], table);
}
