// A colour image as a height field of three channels, against a uniform grid of as many vertices.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "paper/colors.h"

namespace scarp::paper {
namespace {

/// The paper used the mandrill; these are free.
struct Image {
  const char* file;
  const char* source;
};
constexpr std::array<Image, 3> kImages{{{"astronaut.png", "astronaut: NASA, public domain"},
                                        {"kodim05.png", "Kodak 05, released for unrestricted use"},
                                        {"kodim23.png", "Kodak 23, released for unrestricted use"}}};
constexpr int kShorterSide = 200;
constexpr std::uint64_t kImageVertices = 400;

struct Treatment {
  const char* name;
  EdgeRule edges;
};
const std::array<Treatment, 4> kGreedy{{{"greedy, Delaunay", {}},
                                        {"greedy, data-dependent (sum, q 0.5)", scape_edges(EdgeScore::kSum, 0.5)},
                                        {"greedy, data-dependent, settled", {true, EdgeScore::kSum, 0.5, 0, true}},
                                        {"greedy, angles of normals (q 0.5)", scape_edges(EdgeScore::kNormals, 0.5)}}};
/// The effort for least squares; the treatments that are drawn, the one that is traced, and the one with Scape's angle
/// between normals.
constexpr Effort kSquaresEffort = Effort::kHigh;
constexpr const char* kSquares = "high effort, least squared error";
constexpr std::size_t kDrawnTreatments = 2, kTracedTreatment = 2, kNormalsTreatment = 3;

/// A small image over a flat field.
struct Subject {
  const Image* known = nullptr;
  OwnedChannels image;
  std::vector<float> flat;

  HeightField field() const {
    HeightField heights{flat.data(), image.cols, image.rows};
    heights.frame = grid_frame(image.rows);
    return with_colors(heights, image, 0, 1);
  }
};

Picture middle(const Picture& picture) { return crop(picture, kShorterSide, kShorterSide); }

Result<Subject> read_subject(const Image& known, const std::string& path) {
  SCARP_TRY(OwnedChannels image, read_channels(path));
  const double scale = static_cast<double>(kShorterSide) / std::min(image.cols, image.rows);
  Subject subject{&known,
                  resize(image, static_cast<int>(std::lround(scale * image.cols)),
                         static_cast<int>(std::lround(scale * image.rows))),
                  {}};
  subject.flat.assign(subject.image.bands.front().size(), 0.0f);
  return subject;
}

Result<Painted> paint_uniform(const Study& study, const Subject& subject, const UniformGrid& grid) {
  PaperOptions options;
  options.points = grid.steps;
  return paint(study, subject.field(), subject.known->file, subject.image, exactly(grid.vertices(), options));
}

Result<Painted> paint_greedy(const Study& study, const Subject& subject, std::uint64_t vertices,
                             const EdgeRule& edges) {
  return paint(study, subject.field(), subject.known->file, subject.image, exactly(vertices, with_edges(edges)));
}

struct Outcome {
  std::vector<std::vector<std::string>> rows;
  std::vector<std::uint8_t> png;
  bool better = true;  ///< greedy insertion with any edges than the uniform grid
};

/// About 400 vertices.
Result<Outcome> compare(const Study& study, const Subject& subject) {
  study.note(fmt::format("images: {}", subject.known->file));
  const UniformGrid grid = uniform_grid(subject.image.cols, subject.image.rows, kImageVertices);
  SCARP_TRY(const Painted& uniform, paint_uniform(study, subject, grid));
  Outcome outcome;
  outcome.rows.push_back({subject.known->file, fmt::format("uniform grid, {} × {}", grid.cols, grid.rows),
                          fmt::format("{}", grid.vertices()), format_psnr(uniform.psnr), ""});
  std::vector<Picture> beside{middle(draw_channels(subject.image)), middle(uniform.picture)};
  for (std::size_t k = 0; k < kGreedy.size(); ++k) {
    const Treatment& treatment = kGreedy[k];
    SCARP_TRY(const Painted& painted, paint_greedy(study, subject, grid.vertices(), treatment.edges));
    outcome.rows.push_back({"", treatment.name, fmt::format("{}", painted.run.mesh.vertex_count()),
                            format_psnr(painted.psnr), with_sign(painted.psnr - uniform.psnr, 2) + " dB"});
    if (k != kNormalsTreatment) outcome.better = outcome.better && painted.psnr > uniform.psnr;
    if (k < kDrawnTreatments) beside.push_back(middle(painted.picture));
  }
  SCARP_TRY(const Painted& squares, paint_by_squares(study, subject.field(), subject.known->file, subject.image,
                                                     grid.vertices(), kSquaresEffort));
  outcome.rows.push_back({"", kSquares, fmt::format("{}", squares.run.mesh.vertex_count()), format_psnr(squares.psnr),
                          with_sign(squares.psnr - uniform.psnr, 2) + " dB"});
  beside.push_back(middle(squares.picture));
  SCARP_TRY(outcome.png, encode_beside(std::move(beside)));
  return outcome;
}

/// PSNR against vertices, greedy with data-dependent edges and uniform. Returns where greedy overtakes for good, if it
/// does.
Result<std::optional<std::uint64_t>> trace(const Study& study, const Subject& subject, int color, Plot& plot) {
  Curve greedy{subject.known->file, Curve::Style::kLineAndPoints, {}, color};
  Curve squares{std::string(subject.known->file) + ", squares", Curve::Style::kLine, {}, color};
  Curve uniform{std::string(subject.known->file) + ", uniform", Curve::Style::kDashes, {}, color};
  std::optional<std::uint64_t> overtakes;
  for (std::uint64_t m = 100; m <= subject.flat.size() / 3; m *= 2) {
    study.note(fmt::format("images: {}, {} vertices", subject.known->file, m));
    const UniformGrid grid = uniform_grid(subject.image.cols, subject.image.rows, m);
    SCARP_TRY(const Painted& even, paint_uniform(study, subject, grid));
    SCARP_TRY(const Painted& chosen, paint_greedy(study, subject, grid.vertices(), kGreedy[kTracedTreatment].edges));
    SCARP_TRY(const Painted& best, paint_by_squares(study, subject.field(), subject.known->file, subject.image,
                                                    grid.vertices(), kSquaresEffort));
    const auto x = static_cast<double>(grid.vertices());
    squares.points.push_back({x, best.psnr});
    uniform.points.push_back({x, even.psnr});
    greedy.points.push_back({x, chosen.psnr});
    if (!(chosen.psnr > even.psnr)) overtakes.reset();
    if (chosen.psnr > even.psnr && !overtakes) overtakes = grid.vertices();
  }
  plot.curves.push_back(std::move(squares));
  plot.curves.push_back(std::move(greedy));
  plot.curves.push_back(std::move(uniform));
  return overtakes;
}

}  // namespace

Result<void> add_images(Study& study) {
  std::vector<std::vector<std::string>> rows;
  std::vector<std::pair<const Image*, std::vector<std::uint8_t>>> pictures;
  std::vector<std::string> remarks;
  Plot plot{"Colour images: PSNR against vertices, least squares, greedy (settled), uniform",
            "vertices",
            "PSNR, dB",
            true,
            false,
            "top left",
            {}};
  bool better = true;
  int color = 0;
  for (const Image& image : kImages) {
    const std::string path = find_file(study.folder, {image.file});
    if (path.empty()) continue;
    SCARP_TRY(const Subject& subject, read_subject(image, path));
    SCARP_TRY(Outcome outcome, compare(study, subject));
    rows.insert(rows.end(), outcome.rows.begin(), outcome.rows.end());
    pictures.emplace_back(&image, std::move(outcome.png));
    better = better && outcome.better;
    SCARP_TRY(const auto& overtakes, trace(study, subject, ++color, plot));
    remarks.push_back(overtakes
                          ? fmt::format("{}: greedy insertion is better from {} vertices on.", image.file, *overtakes)
                          : fmt::format("{}: the uniform grid has the better PSNR throughout.", image.file));
  }
  if (rows.empty()) return {};
  study.page.heading(2, "Colour images");
  study.page.paragraph(fmt::format(
      "The paper shows the mandrill, which is not free, at 200 × 200 pixels with 400 vertices against a uniform grid "
      "(20 × 20). Here: other images whose shorter side is reduced to {} pixels, red, green and blue as channels over "
      "a flat field, the error their sum, Gouraud shading. PSNR over all pixels and colours.",
      kShorterSide));
  study.page.table({"image", "mesh", "vertices", "PSNR", "against uniform"}, rows);
  for (auto& [image, png] : pictures) {
    const std::string name = image->file;
    SCARP_RETURN_IF_ERROR(
        study.add_picture("image_" + name.substr(0, name.find('.')),
                          fmt::format("The image's middle, uniform grid, greedy insertion with Delaunay and "
                                      "data-dependent edges, least squared error ({})",
                                      image->source),
                          std::move(png)));
  }
  SCARP_RETURN_IF_ERROR(study.add_plot("image_psnr", plot));
  remarks.insert(
      remarks.begin(),
      better
          ? "Greedy insertion is better than the uniform grid on every image: its vertices go to the edges of things."
          : "Greedy insertion is not better than the uniform grid in every row. It follows the largest error, not the "
            "mean one of PSNR: vertices go to edges and highlights, whose colours then spread over large triangles.");
  remarks.push_back(
      "The last row of each image is not the paper's: `--objective rms --effort high` lowers the squared error itself. "
      "Vertices stay on pixels, with their colours.");
  remarks.push_back(
      "Angles of normals: Scape's ABN for colours, the sum of the angles of red, green and blue. It measures how "
      "smooth the picture is across an edge, not its error.");
  study.page.list(remarks);
  return {};
}

}  // namespace scarp::paper
