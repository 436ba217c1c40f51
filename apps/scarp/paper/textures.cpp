// Terrain with its aerial photograph: one run that serves shape and colour.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "paper/colors.h"

namespace scarp::paper {
namespace {

constexpr const char *kHeights = "santa_barbara_elev.tif", *kPhotograph = "santa_barbara_aerial.tif";
constexpr int kPictureSide = 224;

struct Emphasis {
  const char* name;
  double colors;  ///< the paper's emphasis: 0 heights alone, 1 colours alone
};
constexpr std::array<Emphasis, 5> kEmphases{{{"heights alone", 0},
                                             {"both, emphasis 0.02", 0.02},
                                             {"both, emphasis 0.1", 0.1},
                                             {"both, emphasis 0.5", 0.5},
                                             {"colours alone", 1}}};
/// The other table: the emphasis, and what is added to all heights, in reliefs.
constexpr double kMovedEmphasis = 0.1, kMovedReliefs = 10;

/// The effect of the two definitions of the colours' weight on the same land with heights from another zero.
Result<void> add_moved_heights(Study& study, const OwnedHeightField& heights, const OwnedChannels& photo,
                               std::uint64_t vertices) {
  const double relief = heights.info.max - heights.info.min;
  OwnedHeightField moved = heights;
  for (float& sample : moved.samples) sample += static_cast<float>(kMovedReliefs * relief);
  const auto highest = [](const OwnedHeightField& of) {
    return double{*std::max_element(of.samples.begin(), of.samples.end())};
  };
  std::vector<std::vector<std::string>> rows;
  const auto add = [&](const std::string& name, const OwnedHeightField& field, double size) -> Result<void> {
    study.note(fmt::format("textured terrain: {}", name));
    SCARP_TRY(const Painted& result,
              paint(study, with_colors(field.view(), photo, 1 - kMovedEmphasis, kMovedEmphasis * size / 3 / 255),
                    kHeights, photo, exactly(vertices)));
    const Measurement& m = result.run.measurement;
    rows.push_back({name, number(size), number(m.rmse), number(m.max_error), format_psnr(result.psnr)});
    return {};
  };
  const std::string up = fmt::format(", all heights {} higher", number(kMovedReliefs * relief));
  Result<void> added = add("Scape's: the highest height", heights, highest(heights));
  if (added) added = add("Scape's" + up, moved, highest(moved));
  if (added) added = add("Scarp's: highest minus lowest", heights, relief);
  if (added) added = add("Scarp's" + up, moved, relief);
  SCARP_RETURN_IF_ERROR(added);
  study.page.paragraph(
      fmt::format("Both definitions of the relief: emphasis {:g}, the heights as they are and counted from elsewhere.",
                  kMovedEmphasis));
  study.page.table({"size of the heights", "is", "RMS of heights", "max", "PSNR of colours"}, rows);
  study.page.list(
      {"By Scape's definition land that lies higher gets other vertices, as if the emphasis were greater; by Scarp's "
       "only the last bits of 32-bit heights change."});
  return {};
}

/// Rows of the table, after the uniform grid.
constexpr std::size_t kHeightsAlone = 1, kBoth = 2;

}  // namespace

Result<void> add_textured_terrain(Study& study) {
  const std::string heights_path = find_file(study.folder, {kHeights}),
                    photo_path = find_file(study.folder, {kPhotograph});
  if (heights_path.empty() || photo_path.empty()) return {};
  ReadOptions read;
  read.crs = "grid";
  SCARP_TRY(const OwnedHeightField& heights, read_height_field(heights_path, read));
  SCARP_TRY(const OwnedChannels& photo, read_channels(photo_path, read));
  if (const auto differs =
          find_grid_difference(heights.info, heights.cols, heights.rows, photo.info, photo.cols, photo.rows))
    return fail(ErrorKind::kInput,
                fmt::format("{} {}: it must lie on the grid of {}", kPhotograph, *differs, kHeights));

  const double relief = heights.info.max - heights.info.min;
  const std::uint64_t vertices = heights.samples.size() / 20;
  std::vector<std::vector<std::string>> rows;
  std::vector<Painted> painted;
  const auto add = [&](const std::string& name, const HeightField& field, PaperOptions options,
                       std::uint64_t count) -> Result<void> {
    study.note(fmt::format("textured terrain: {}", name));
    SCARP_TRY(Painted result, paint(study, field, kHeights, photo, exactly(count, std::move(options))));
    const Measurement& m = result.run.measurement;
    rows.push_back({name, fmt::format("{}", result.run.mesh.vertex_count()), number(m.rmse), number(m.max_error),
                    format_psnr(result.psnr)});
    painted.push_back(std::move(result));
    return {};
  };
  UniformGrid grid = uniform_grid(heights.cols, heights.rows, vertices);
  PaperOptions uniform;
  uniform.points = std::move(grid.steps);
  const std::uint64_t uniform_vertices = uniform.points.size();
  Result<void> added = add(fmt::format("uniform grid, {} × {}", grid.cols, grid.rows),
                           with_colors(heights.view(), photo, 1, 0), std::move(uniform), uniform_vertices);
  for (const Emphasis& emphasis : kEmphases) {
    SCARP_RETURN_IF_ERROR(added);
    const double color_scale = emphasis.colors * relief / 3 / 255;
    added = add(emphasis.name, with_colors(heights.view(), photo, 1 - emphasis.colors, color_scale), {}, vertices);
  }
  SCARP_RETURN_IF_ERROR(added);

  study.page.heading(2, "Textured terrain");
  study.page.paragraph(
      "Santa Barbara, 512 × 512 heights and an aerial photograph on the same grid; 5 % of the samples. The error is (1 "
      "− w) |dz| + w · relief / 3 · (|dr| + |dg| + |db|), colours from 0 to 1. For the relief Scape uses the highest "
      "height, Scarp highest minus lowest. The paper gives no figures.");
  study.page.table({"vertices by", "vertices", "RMS of heights", "max", "PSNR of colours"}, rows);
  std::vector<Picture> beside{crop(draw_channels(photo), kPictureSide, kPictureSide)};
  for (const std::size_t k : {kHeightsAlone, kBoth})
    beside.push_back(crop(painted[k].picture, kPictureSide, kPictureSide));
  SCARP_TRY(std::vector<std::uint8_t> png, encode_beside(std::move(beside)));
  added = study.add_picture("textured",
                            "The middle of the photograph, of the mesh for heights alone, and of the mesh for both "
                            "(NASA WorldWind sample data, USGS)",
                            std::move(png));
  SCARP_RETURN_IF_ERROR(added);
  const Painted &alone = painted[kHeightsAlone], &both = painted[kBoth];
  study.page.list({fmt::format(
      "Heights and colours in one run ({}) against heights alone: PSNR {} dB, RMS of heights {}.{}",
      rows[kBoth].front(), with_sign(both.psnr - alone.psnr, 2),
      percent_of_change(both.run.measurement.rmse, alone.run.measurement.rmse),
      both.psnr > alone.psnr ? " Its vertices lie on edges of colour that heights alone would not find." : "")});
  return add_moved_heights(study, heights, photo, vertices);
}

}  // namespace scarp::paper
