// 4: a colour image as a height field of three channels, against a uniform grid of as many vertices.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "colors.h"

namespace scarp::paper {
namespace {

/// The report used the mandrill; these are free.
struct Image {
  const char* file;
  const char* source;
};
constexpr std::array<Image, 3> kImages{{{"astronaut.png", "astronaut: NASA, public domain"},
                                        {"kodim05.png", "Kodak 05, released for unrestricted use"},
                                        {"kodim23.png", "Kodak 23, released for unrestricted use"}}};
constexpr int kShorterSide = 200;
constexpr std::uint64_t kVertices = 400;

struct Treatment {
  const char* name;
  EdgeRule edges;
};
const std::array<Treatment, 2> kGreedy{
    {{"greedy, Delaunay", {}}, {"greedy, data-dependent (sum, q 0.5)", scape_edges(EdgeScore::kSum, 0.5)}}};

Picture middle(const Picture& picture) { return crop(picture, kShorterSide, kShorterSide); }

Result<OwnedChannels> read_small(const std::string& path) {
  Result<OwnedChannels> image = read_channels(path);
  if (!image) return image;
  const double scale = static_cast<double>(kShorterSide) / std::min(image->cols, image->rows);
  return resize(*image, static_cast<int>(std::lround(scale * image->cols)),
                static_cast<int>(std::lround(scale * image->rows)));
}

/// Rows for the table; the better mesh wins a place in the picture.
Result<bool> add_image(Study& study, const Image& known, const std::string& path,
                       std::vector<std::vector<std::string>>& rows, std::vector<Study::File>& pictures) {
  study.note(fmt::format("images: {}", known.file));
  const Result<OwnedChannels> image = read_small(path);
  if (!image) return tl::unexpected(image.error());
  const std::vector<float> flat(image->bands.front().size(), 0.0f);
  HeightField heights{flat.data(), image->cols, image->rows};
  heights.frame = grid_frame(image->rows);
  const HeightField field = with_colors(heights, *image, 0, 1);

  SimplifyOptions options;
  UniformGrid grid = uniform_grid(image->cols, image->rows, kVertices);
  const std::uint64_t vertices = grid.vertices();
  options.script = std::move(grid.steps);
  const Result<Painted> uniform = paint(study, field, known.file, *image, exactly(vertices, options));
  if (!uniform) return tl::unexpected(uniform.error());
  rows.push_back({known.file, fmt::format("uniform grid, {} × {}", grid.cols, grid.rows), fmt::format("{}", vertices),
                  format_psnr(uniform->psnr), ""});
  std::vector<Picture> beside{middle(draw_channels(*image)), middle(uniform->picture)};
  bool better = true;
  for (const Treatment& treatment : kGreedy) {
    const Result<Painted> painted =
        paint(study, field, known.file, *image, exactly(vertices, with_edges(treatment.edges)));
    if (!painted) return tl::unexpected(painted.error());
    rows.push_back({"", treatment.name, fmt::format("{}", painted->run.mesh.vertex_count()), format_psnr(painted->psnr),
                    with_sign(painted->psnr - uniform->psnr, 2) + " dB"});
    better = better && painted->psnr > uniform->psnr;
    beside.push_back(middle(painted->picture));
  }
  Result<std::vector<std::uint8_t>> png = encode_beside(std::move(beside));
  if (!png) return tl::unexpected(std::move(png.error()));
  pictures.push_back({known.file, std::move(*png)});
  return better;
}

}  // namespace

Result<void> add_images(Study& study) {
  std::vector<std::vector<std::string>> rows;
  std::vector<Study::File> pictures;
  bool better = true;
  for (const Image& image : kImages) {
    const std::string path = find_file(study.folder, {image.file});
    if (path.empty()) continue;
    const Result<bool> added = add_image(study, image, path, rows, pictures);
    if (!added) return tl::unexpected(added.error());
    better = better && *added;
  }
  if (rows.empty()) return {};
  study.page.heading(2, "Colour images (4)");
  study.page.paragraph(
      fmt::format("The report shows the mandrill, which is not free, at 200 × 200 pixels with 400 vertices against a "
                  "uniform grid of 20 × "
                  "20. Here: other images whose shorter side is reduced to {} pixels, red, green and blue as channels "
                  "over a flat field, "
                  "the error their sum, Gouraud shading. PSNR over all pixels and colours.",
                  kShorterSide));
  study.page.table({"image", "mesh", "vertices", "PSNR", "against uniform"}, rows);
  for (Study::File& picture : pictures) {
    const auto* known =
        std::find_if(kImages.begin(), kImages.end(), [&](const Image& i) { return picture.path == i.file; });
    const Result<void> added = study.add_picture(
        "image_" + picture.path.substr(0, picture.path.find('.')),
        fmt::format("The middle of the image, the uniform grid, greedy insertion with Delaunay and with data-dependent edges ({})",
                    known->source),
        std::move(picture.bytes));
    if (!added) return added;
  }
  study.page.list(
      {better ? "Greedy insertion is better than the uniform grid on every image: its vertices go to the edges "
                "of things."
              : "Greedy insertion is not better than the uniform grid on every image: it follows the largest "
                "error, and in busy detail that is noise, which so few vertices cannot show."});
  return {};
}

}  // namespace scarp::paper
