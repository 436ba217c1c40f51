// The appearance of the meshes: the paper's illustration, and TINs with both kinds of edges.
#include <fmt/format.h>

#include <utility>

#include "paper/colors.h"
#include "paper/view.h"
#include "scarp/generate.h"

namespace scarp::paper {
namespace {

/// The paper shows 65 × 65 samples in its figure 1, and 512 of them in its figure 2. The field is not known.
constexpr int kFigureSide = 65;
constexpr std::uint64_t kFigureVertices = 512, kFigureSeed = 9;
constexpr double kShownShare = 0.5;  ///< percent of the samples

/// The field's meshes side by side. The field itself has thinner lines: it has many more of them.
Result<void> add_views(Study& study, const std::string& name, const std::string& caption, const Field& field,
                       const std::vector<Mesh>& meshes, const View& view) {
  std::vector<Picture> pictures;
  for (const Mesh& mesh : meshes) {
    View fitting = view;
    if (mesh.vertex_count() == field.samples()) fitting.line_width /= 2;
    pictures.push_back(draw_view(field.heights, mesh, fitting));
  }
  SCARP_TRY(std::vector<std::uint8_t> png, encode_beside(std::move(pictures)));
  return study.add_picture(name, caption, std::move(png));
}

}  // namespace

Result<void> add_illustration(Study& study) {
  study.note("illustration");
  SCARP_TRY(OwnedHeightField heights, generate_field(FieldStyle::kFractal, kFigureSide, kFigureSide, kFigureSeed));
  const Field field{"fractal", "fractal", std::move(heights)};
  SCARP_TRY(const Simplified& run, study.run(field.heights, field.file, exactly(kFigureVertices)));
  study.page.heading(2, "A field and its TIN (figures 1 and 2)");
  study.page.paragraph(fmt::format(
      "The paper's are {0} × {0} samples, and a TIN of {1} of them. Here: `scarp generate fractal {0} {0} "
      "--seed {2}`, with {3} triangles between its samples, and {1} of them, with {4}.",
      kFigureSide, kFigureVertices, kFigureSeed, 2 * (kFigureSide - 1) * (kFigureSide - 1), run.mesh.triangle_count()));
  View view;
  view.up = {0.6, 0.8};
  view.line_width = 0.7;
  view.relief = 0.3;
  SCARP_RETURN_IF_ERROR(add_views(study, "illustration", "The field, and the TIN", field,
                                  {make_full_mesh(field.heights), run.mesh}, view));
  study.page.paragraph(fmt::format("Max error {}, RMS {}, of a relief of {}.", number(run.measurement.max_error),
                                   number(run.measurement.rmse), number(field.relief())));
  return {};
}

Result<void> add_surfaces(Study& study) {
  const Field& field = study.fields.all.front();
  study.note(fmt::format("surfaces: {}", field.key));
  const std::uint64_t vertices = std::max<std::uint64_t>(field.share(kShownShare), 4);
  std::vector<Mesh> meshes;
  for (const EdgeRule& edges : {EdgeRule{}, scape_edges(EdgeScore::kSum, 0.5)}) {
    SCARP_TRY(Simplified run, study.run(field.heights, field.file, exactly(vertices, with_edges(edges))));
    meshes.push_back(std::move(run.mesh));
  }
  study.page.heading(3, "Meshes and surfaces");
  View map;
  map.turn = {1, 0};
  map.up = {0, 1};
  map.line_width = 0.9;
  map.relief = 0.1;
  SCARP_RETURN_IF_ERROR(add_views(
      study, "edges",
      fmt::format("{} with {} vertices: Delaunay edges, and data-dependent ones (sum, q 0.5)", field.key, vertices),
      field, meshes, map));
  study.page.paragraph(
      "Data-dependent triangles lie along what is steep, long and narrow; Delaunay triangles are as round as they can "
      "be.");
  meshes.insert(meshes.begin(), make_full_mesh(field.heights));
  View view;
  view.width = 300;
  view.turn = {0.6, -0.8};
  view.up = {0.6, 0.8};
  view.relief = 0.25;
  return add_views(study, "surfaces",
                   fmt::format("{}: all {} samples, {} of them with Delaunay edges, and with data-dependent ones",
                               field.key, field.samples(), vertices),
                   field, meshes, view);
}

}  // namespace scarp::paper
