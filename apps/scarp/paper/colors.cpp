#include "paper/colors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace scarp::paper {

HeightField with_colors(HeightField heights, const OwnedChannels& image, double height_scale, double color_scale) {
  heights.height_scale = height_scale;
  for (const std::vector<float>& band : image.bands) heights.channels.push_back({band.data(), color_scale});
  return heights;
}

namespace {

Result<Painted> paint_mesh(Result<Simplified> run, const HeightField& field, const OwnedChannels& image) {
  SCARP_RETURN_IF_ERROR(run);
  Painted painted{std::move(*run), {}, 0};
  color_by_channels(painted.run.mesh, image);
  painted.picture = draw_gouraud(field, painted.run.mesh);
  painted.psnr = find_psnr(draw_channels(image), painted.picture);
  return painted;
}

}  // namespace

Result<Painted> paint(const Study& study, const HeightField& field, const std::string& name, const OwnedChannels& image,
                      PaperOptions options) {
  return paint_mesh(study.run(field, name, std::move(options)), field, image);
}

Result<Painted> paint_by_squares(const Study& study, const HeightField& field, const std::string& name,
                                 const OwnedChannels& image, std::uint64_t vertices, Effort effort) {
  SimplifyOptions options;
  options.goals = {.max_vertices = vertices, .objective = Objective::kRms};
  options.quality.effort = effort;
  return paint_mesh(study.run_by_effort(field, name, options), field, image);
}

namespace {

/// One line of `count` values, `stride` apart, at another length.
void resize_line(const double* from, int count, double* to, int new_count, std::size_t from_stride,
                 std::size_t to_stride) {
  for (int k = 0; k < new_count; ++k) {
    const double begin = static_cast<double>(k) * count / new_count,
                 end = static_cast<double>(k + 1) * count / new_count;
    double sum = 0;
    for (int j = static_cast<int>(begin); j < count && j < end; ++j) {
      const double covered = std::min(end, j + 1.0) - std::max(begin, static_cast<double>(j));
      sum += covered * from[static_cast<std::size_t>(j) * from_stride];
    }
    to[static_cast<std::size_t>(k) * to_stride] = sum / (end - begin);
  }
}

}  // namespace

OwnedChannels resize(const OwnedChannels& image, int cols, int rows) {
  OwnedChannels result = image;
  result.cols = cols;
  result.rows = rows;
  result.frame = grid_frame(rows);
  const auto w = static_cast<std::size_t>(cols), h = static_cast<std::size_t>(rows);
  const auto old_w = static_cast<std::size_t>(image.cols), old_h = static_cast<std::size_t>(image.rows);
  for (std::vector<float>& band : result.bands) {
    const std::vector<double> given(band.begin(), band.end());
    std::vector<double> narrow(w * old_h), small(w * h);
    for (std::size_t y = 0; y < old_h; ++y) resize_line(&given[y * old_w], image.cols, &narrow[y * w], cols, 1, 1);
    for (std::size_t x = 0; x < w; ++x) resize_line(&narrow[x], image.rows, &small[x], rows, w, w);
    band.resize(w * h);
    std::transform(small.begin(), small.end(), band.begin(),
                   [](double v) { return static_cast<float>(std::floor(v + 0.5)); });
  }
  return result;
}

Picture crop(const Picture& picture, int width, int height) {
  Picture part{std::min(width, picture.width), std::min(height, picture.height), {}};
  const int left = (picture.width - part.width) / 2, top = (picture.height - part.height) / 2;
  for (int y = 0; y < part.height; ++y) {
    const auto begin = picture.rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(top + y) * picture.width + left);
    part.rgb.insert(part.rgb.end(), begin, begin + 3 * part.width);
  }
  return part;
}

Result<std::vector<std::uint8_t>> encode_beside(std::vector<Picture> pictures) {
  for (Picture& picture : pictures) {
    for (std::uint8_t& value : picture.rgb) value = static_cast<std::uint8_t>((value >> 3) * 255 / 31);
  }
  return encode_png(place_side_by_side(pictures));
}

std::string format_psnr(double psnr) { return fmt::format("{:.2f} dB", psnr); }

}  // namespace scarp::paper
