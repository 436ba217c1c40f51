// Pictures of the mesh's values: Gouraud shading, channels, comparisons, lines.
#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <set>
#include <string>

#include "scarp/measure.h"
#include "scarp/picture.h"
#include "scarp/simplify.h"
#include "unit/measure_meshes.h"
#include "unit/raster_files.h"

namespace scarp::testing {
namespace {

using Rgb = std::array<int, 3>;
Rgb pixel(const Picture& picture, int x, int y) {
  const std::size_t at = 3 * static_cast<std::size_t>(y * picture.width + x);
  return {picture.rgb[at], picture.rgb[at + 1], picture.rgb[at + 2]};
}

OwnedChannels make_channels(int cols, int rows, int bands, bool is_8bit) {
  OwnedChannels channels;
  channels.cols = cols;
  channels.rows = rows;
  channels.is_8bit = is_8bit;
  channels.is_color = bands == 3;
  for (int k = 0; k < bands; ++k) {
    channels.bands.emplace_back();
    for (int i = 0; i < cols * rows; ++i) channels.bands.back().push_back(static_cast<float>((i * (k + 3)) % 256));
  }
  return channels;
}

/// Gives vertices the channels of their samples; vertices as in grid_mesh().
void take_channels(Mesh& mesh, const OwnedChannels& channels, int step) {
  const int across = (channels.cols - 1) / step + 1;
  mesh.channel_count = static_cast<int>(channels.bands.size());
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const int col = static_cast<int>(v) % across * step, row = static_cast<int>(v) / across * step;
    for (const auto& band : channels.bands)
      mesh.channels.push_back(band[static_cast<std::size_t>(row * channels.cols + col)]);
  }
}

TEST(DrawGouraud, OfTheFullGridIsTheImage) {
  const OwnedChannels image = make_channels(41, 31, 3, true);
  Terrain terrain = wavy_terrain(41, 31);
  for (const bool dressed : {false, true}) {
    Mesh mesh = grid_mesh(wavy_terrain(41, 31), 1);
    take_channels(mesh, image, 1);
    color_by_channels(mesh, image);
    if (dressed) terrain.frame = dress_up(terrain.frame);
    const Picture drawn = draw_gouraud(terrain.view(), mesh);
    EXPECT_EQ(drawn.rgb, draw_channels(image).rgb);
    EXPECT_EQ(find_psnr(drawn, draw_channels(image)), std::numeric_limits<double>::infinity());
  }
}

TEST(DrawGouraud, InterpolatesAsTheJudgeDoesWithinHalfAByte) {
  const OwnedChannels image = make_channels(61, 41, 3, true);
  const Terrain terrain = wavy_terrain(61, 41);
  Mesh mesh = grid_mesh(terrain, 10);
  take_channels(mesh, image, 10);
  color_by_channels(mesh, image);
  const Picture drawn = draw_gouraud(terrain.view(), mesh);
  for (std::size_t k = 0; k < 3; ++k) {
    Mesh channel = mesh;
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) channel.positions[3 * v + 2] = mesh.colors[3 * v + k];
    const auto wanted = resample(terrain.view(), channel);
    ASSERT_TRUE(wanted);
    // Samples on an edge are equal from both sides, so the judge's choice of a side is irrelevant.
    for (std::size_t i = 0; i < wanted->size(); ++i) {
      ASSERT_NEAR(drawn.rgb[3 * i + k], (*wanted)[i], 0.5001) << i % 61 << " " << i / 61;
    }
  }
}

TEST(DrawGouraud, IsWhiteWhereTheMeshIsNot) {
  Terrain terrain = wavy_terrain(21, 21);
  Mesh mesh = grid_mesh(terrain, 20);  // two triangles, only the first of which remains
  mesh.triangles.resize(3);
  mesh.colors.assign(3 * mesh.vertex_count(), 10);
  const Picture drawn = draw_gouraud(terrain.view(), mesh);
  const auto heights = resample(terrain.view(), mesh);
  int dark = 0;
  for (int row = 0; row < 21; ++row) {
    for (int col = 0; col < 21; ++col) {
      const bool covered = !std::isnan((*heights)[static_cast<std::size_t>(row * 21 + col)]);
      ASSERT_EQ(pixel(drawn, col, row), (covered ? Rgb{10, 10, 10} : Rgb{255, 255, 255})) << col << " " << row;
      dark += covered;
    }
  }
  EXPECT_EQ(dark, 21 * 22 / 2);
}

TEST(DrawGouraud, WithoutColoursIsAHillshade) {
  Terrain terrain = wavy_terrain(41, 41);
  for (int r = 0; r < 41; ++r) {
    for (int c = 0; c < 41; ++c) terrain.at(c, r) = static_cast<float>(-std::abs(c - 20));
  }
  const Picture full = draw_gouraud(terrain.view(), grid_mesh(terrain, 1));
  const Picture coarse = draw_gouraud(terrain.view(), grid_mesh(terrain, 20));
  EXPECT_EQ(full.width, 41);
  EXPECT_EQ(full.rgb, coarse.rgb);  // the ridge lies on the coarse mesh's edges
  const Rgb lit = pixel(full, 10, 20), dark = pixel(full, 30, 20);
  EXPECT_GT(lit[0] + lit[1] + lit[2], dark[0] + dark[1] + dark[2] + 60);
}

TEST(DrawGouraud, SurvivesMeshesThatAreBroken) {
  const Terrain terrain = wavy_terrain(21, 21);
  Mesh mesh = grid_mesh(terrain, 10);
  mesh.positions[0] = NAN;
  mesh.positions[3] = 1e300;
  mesh.positions[6] = -1e300;
  draw_gouraud(terrain.view(), mesh);
  encode_svg(mesh);
  mesh.triangles[4] = 77;
  draw_gouraud(terrain.view(), mesh);
  encode_eps(mesh);
}

TEST(DrawChannels, StretchesWhatIsNotBytesAndGreysSingles) {
  OwnedChannels one = make_channels(4, 1, 1, false);
  one.bands[0] = {-1000, 0, 1000, NAN};
  const Picture grey = draw_channels(one);
  EXPECT_EQ(pixel(grey, 0, 0), (Rgb{0, 0, 0}));
  EXPECT_EQ(pixel(grey, 1, 0), (Rgb{128, 128, 128}));
  EXPECT_EQ(pixel(grey, 2, 0), (Rgb{255, 255, 255}));
  EXPECT_EQ(pixel(grey, 3, 0), (Rgb{255, 255, 255}));
  OwnedChannels five = make_channels(4, 1, 5, true);
  EXPECT_EQ(pixel(draw_channels(five), 2, 0), (Rgb{6, 6, 6}));
  one.bands[0] = {7, 7, 7, 7};
  EXPECT_EQ(pixel(draw_channels(one), 2, 0), (Rgb{0, 0, 0}));
  Mesh mesh;
  mesh.positions.assign(6, 0);
  mesh.channel_count = 1;
  mesh.channels = {500, NAN};
  one.bands[0] = {-1000, 0, 1000, NAN};
  color_by_channels(mesh, one);
  EXPECT_EQ(mesh.colors, (std::vector<std::uint8_t>{191, 191, 191, 255, 255, 255}));
}

TEST(Pictures, AreComparedAndPlacedSideBySide) {
  Picture a{2, 1, {10, 10, 10, 20, 20, 20}}, b = a;
  EXPECT_EQ(find_psnr(a, b), std::numeric_limits<double>::infinity());
  b.rgb[0] = 16;  // the mean square is 6
  EXPECT_NEAR(find_psnr(a, b), 20 * std::log10(255 / std::sqrt(6.0)), 1e-9);
  const Picture tall{1, 3, {1, 1, 1, 2, 2, 2, 3, 3, 3}};
  const Picture both = place_side_by_side(std::array{a, tall, b}, 2);
  EXPECT_EQ(both.width, 2 + 2 + 1 + 2 + 2);
  EXPECT_EQ(both.height, 3);
  EXPECT_EQ(pixel(both, 1, 0), (Rgb{20, 20, 20}));
  EXPECT_EQ(pixel(both, 2, 0), (Rgb{255, 255, 255}));
  EXPECT_EQ(pixel(both, 4, 2), (Rgb{3, 3, 3}));
  EXPECT_EQ(pixel(both, 0, 1), (Rgb{255, 255, 255}));
  EXPECT_EQ(pixel(both, 7, 0), (Rgb{16, 10, 10}));
}

/// All lines of a drawing as "x1 y1 x2 y2", in either direction.
std::multiset<std::string> lines_of(const std::vector<std::uint8_t>& bytes, const std::regex& line) {
  const std::string text(bytes.begin(), bytes.end());
  std::multiset<std::string> lines;
  for (auto it = std::sregex_iterator(text.begin(), text.end(), line); it != std::sregex_iterator(); ++it) {
    const std::string a = (*it)[1], b = (*it)[2];
    lines.insert(std::min(a, b) + " " + std::max(a, b));
  }
  return lines;
}

TEST(Lines, ShowEveryEdgeOnceToScaleAndNorthUp) {
  Terrain terrain = wavy_terrain(31, 21);
  terrain.frame.affine = {500000, 10, 0, 4000000, 0, -10};
  Mesh mesh = grid_mesh(terrain, 10);
  for (const bool solid : {false, true}) {
    ASSERT_TRUE(!solid || add_base(mesh, -100));
    const auto svg = lines_of(encode_svg(mesh), std::regex("M([0-9.]+ [0-9.]+)L([0-9.]+ [0-9.]+)"));
    const auto eps = lines_of(encode_eps(mesh), std::regex("\n([0-9.]+ [0-9.]+) ([0-9.]+ [0-9.]+) e(?=\n)"));
    // 3 x 2 cells: 3·3 + 4·2 sides and 6 diagonals.
    EXPECT_EQ(svg.size(), 23u);
    EXPECT_EQ(eps.size(), 23u);
    EXPECT_EQ(std::set<std::string>(svg.begin(), svg.end()).size(), 23u);
    EXPECT_EQ(std::set<std::string>(eps.begin(), eps.end()).size(), 23u);
    // The first row's first edge: at the top of both pages.
    EXPECT_TRUE(svg.contains("337.333 4.000 4.000 4.000"));
    EXPECT_TRUE(eps.contains("184.000 364.000 4.000 364.000"));
  }
  const std::string eps_text = [&] {
    const auto b = encode_eps(mesh);
    return std::string(b.begin(), b.end());
  }();
  EXPECT_TRUE(contains(eps_text, "%%BoundingBox: 0 0 548 368\n")) << eps_text.substr(0, 200);
  EXPECT_EQ(encode_svg(mesh), encode_svg(mesh));
  EXPECT_TRUE(lines_of(encode_svg(Mesh{}), std::regex("M([0-9.]+ [0-9.]+)L([0-9.]+ [0-9.]+)")).empty());
}

TEST(Lines, GhostscriptReadsTheEps) {
  if (!has_program("gs")) GTEST_SKIP() << "needs gs (ghostscript)";
  const ScratchFolder scratch;
  const Terrain terrain = wavy_terrain(31, 21);
  ASSERT_TRUE(write_file(scratch.file("mesh.eps"), encode_eps(grid_mesh(terrain, 10))));
  ASSERT_TRUE(run("gs -q -dBATCH -dNOPAUSE -dSAFER -dEPSCrop -r72 -sDEVICE=pgmraw -sOutputFile=" +
                  scratch.file("mesh.pgm") + " " + scratch.file("mesh.eps") + " > " + scratch.file("log") + " 2>&1"));
  const auto drawn = read_height_field(scratch.file("mesh.pgm"));
  ASSERT_TRUE(drawn) << drawn.error().message;
  EXPECT_EQ(drawn->cols, 548);
  EXPECT_EQ(drawn->rows, 368);
  EXPECT_LT(drawn->info.min, 128);
}

TEST(DrawGouraud, APhotoByItsMesh) {
  const std::string folder = reference_folder();
  if (folder.empty()) GTEST_SKIP() << "the reference rasters are not here";
  const auto photo = read_channels(folder + "kodim23.png");
  ASSERT_TRUE(photo) << photo.error().message;
  const HeightField green{photo->bands[1].data(), photo->cols, photo->rows, std::nullopt, photo->frame, 0, {}, 1};
  SimplifyOptions options;
  options.goals.max_error = 20;
  const auto made = simplify(green, options);
  ASSERT_TRUE(made) << made.error().message;
  Mesh mesh = made->mesh;
  mesh.channel_count = 3;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const auto p = mesh.vertex(v);
    const auto i = static_cast<std::size_t>((photo->rows - 1 - p[1]) * photo->cols + p[0]);
    for (const auto& band : photo->bands) mesh.channels.push_back(band[i]);
  }
  color_by_channels(mesh, *photo);
  const Picture drawn = draw_gouraud(green, mesh), given = draw_channels(*photo);
  for (std::size_t i = 0; i < given.rgb.size(); i += 3) {
    ASSERT_LE(std::abs(drawn.rgb[i + 1] - given.rgb[i + 1]), 20);  // the bound was about green
  }
  EXPECT_GT(find_psnr(drawn, given), 25);
}

}  // namespace
}  // namespace scarp::testing
