// Draws scenes at the same max error by greedy insertion and each effort, and at the same budget by each objective. The
// pictures bench/images/effort_*.png show the mesh over the relief, with the same light and scale within a scene.

#include "suite.h"
#include "variants.h"

namespace bench {
namespace {

/// A square window of a raster.
struct Scene {
  const char* name;
  const char* file;
  int first_col, first_row, side;
  double max_error;      ///< in z units
  int pixels;            ///< maximum pixels of the picture's longer side, legend included
  std::uint64_t budget;  ///< triangles for both objectives; 0: neither is drawn
};

constexpr Scene kScenes[] = {
    {"fuji", "fuji.tif", 204, 114, 192, 25, 440, 800},
    {"essen", "nrw_dom1_essen.tif", 300, 300, 128, 2, 440, 0},
};
/// Variants of a budget with their objectives.
constexpr std::pair<const char*, const char*> kObjectives[] = {{"high", "max"}, {"high rms", "rms"}};

std::vector<std::string> names(const std::filesystem::path& /*project*/) {
  std::vector<std::string> files;
  for (const Scene& scene : kScenes) files.emplace_back(scene.file);
  return files;
}

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

/// Draws the mesh of a variant and lists it in the table.
void draw(const Scene& scene, const scarp::OwnedHeightField& window, const scarp::SimplifyOptions& options,
          const std::string& title, const std::string& goal, std::string_view variant, Rows& rows) {
  const auto made = check(scarp::simplify(window, options));
  const auto picture = check(scarp::draw_preview(window, made.mesh, {.max_side = scene.pixels}));
  const std::string name = fmt::format("effort_{}_{}.png", title, variant);
  if (const auto written = scarp::write_file((rows.project / "bench/images" / name).string(), check(scarp::encode_png(picture)));
      !written)
    die(written.error().message);
  rows.add(fmt::format("{},{},{},{},{},{},{},{:.7g},{:.7g}", scene.file, title, scene.side, goal, variant, name,
                       made.mesh.triangle_count(), made.measurement.max_error, made.measurement.rmse));
}

void measure(const std::string& name, const scarp::OwnedHeightField& field, Rows& rows) {
  for (const Scene& scene : kScenes) {
    if (name != scene.file) continue;
    const scarp::OwnedHeightField window = cut(field, scene);
    for (const std::string_view variant : {"greedy", "normal", "high"})
      draw(scene, window, options_of(*find_variant(variant), scene.max_error), scene.name,
           fmt::format("{:g}", scene.max_error), variant, rows);
    for (const auto& [variant, objective] : kObjectives) {
      if (scene.budget == 0) continue;
      draw(scene, window, options_of(*find_budget_variant(variant), scene.budget), fmt::format("{}_budget", scene.name),
           fmt::format("{} triangles", scene.budget), objective, rows);
    }
  }
}

}  // namespace

const Suite kPictures{"pictures", "raster,scene,side,goal,effort,picture,triangles,max_error,rmse", names, measure};

}  // namespace bench
