// Nodes of rasters, plans, and files of quantized-mesh.
#include "scarp/tile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "io/gzip.h"

namespace scarp::tile_test {
namespace {

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

/// Samples on nodes with 2880 per turn (1/8°), the first at 10° E, 50° N.
struct Raster {
  int cols = 40, rows = 30;
  std::vector<float> samples;
  RasterPlace place{{10, 0.125, 0, 50, 0, -0.125}, nullptr};

  Raster() {
    for (int row = 0; row < rows; ++row) {
      for (int col = 0; col < cols; ++col) samples.push_back(static_cast<float>((col * 37 + row * 91) % 101));
    }
  }
  HeightField field() const {
    HeightField field;
    field.samples = samples.data();
    field.cols = cols;
    field.rows = rows;
    return field;
  }
  std::vector<float> read(const NodeWindow& window) const {
    std::vector<float> nodes(static_cast<std::size_t>(window.cols) * static_cast<std::size_t>(window.rows));
    const auto source = make_node_source(field(), place);
    EXPECT_TRUE(source && (*source)->read(window, nodes));
    return nodes;
  }
};

/// Column and row of the node at 10° E, 50° N.
constexpr std::int64_t kCol = 190 * 8, kRow = 40 * 8;

TEST(raster_nodes, a_node_on_a_sample_has_its_height) {
  const Raster raster;
  EXPECT_EQ(raster.read({2880, kCol, kRow, raster.cols, raster.rows}), raster.samples);
}

TEST(raster_nodes, a_void_beside_a_sample_does_not_touch_it) {
  Raster raster;
  raster.samples[5 * 40 + 7] = kNone;
  const std::vector<float> nodes = raster.read({2880, kCol, kRow, raster.cols, raster.rows});
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (k == 5 * 40 + 7) {
      EXPECT_TRUE(std::isnan(nodes[k]));
    } else {
      EXPECT_EQ(nodes[k], raster.samples[k]) << k;
    }
  }
}

TEST(raster_nodes, a_cubic_of_each_axis_is_met_between_samples) {
  Raster raster;
  for (int row = 0; row < raster.rows; ++row) {
    for (int col = 0; col < raster.cols; ++col)
      raster.samples[static_cast<std::size_t>(row * raster.cols + col)] = static_cast<float>(col * col + 3 * row * col);
  }
  // A node at each half cell: Catmull-Rom reproduces a quadratic.
  const std::vector<float> nodes = raster.read({5760, 2 * kCol + 4, 2 * kRow + 4, 40, 30});
  for (int j = 0; j < 30; ++j) {
    for (int i = 0; i < 40; ++i) {
      const double col = 2 + i / 2.0, row = 2 + j / 2.0;
      EXPECT_NEAR(nodes[static_cast<std::size_t>(j * 40 + i)], col * col + 3 * row * col, 1e-3);
    }
  }
}

TEST(raster_nodes, half_a_cell_around_the_outer_samples_belongs_to_the_raster) {
  const Raster raster;
  const std::vector<float> nodes = raster.read({5760, 2 * kCol - 2, 2 * kRow, 3, 1});
  EXPECT_TRUE(std::isnan(nodes[0]));
  EXPECT_FALSE(std::isnan(nodes[1]));
  EXPECT_EQ(nodes[2], raster.samples[0]);
}

TEST(raster_nodes, a_turn_more_or_less_is_the_same_place) {
  Raster raster;
  const NodeWindow window{2880, kCol - 3, kRow - 2, 30, 20};
  const std::vector<float> nodes = raster.read(window);
  for (const double turn : {-360.0, 360.0}) {
    raster.place.affine[0] = 10 + turn;
    const std::vector<float> moved = raster.read(window);
    for (std::size_t k = 0; k < nodes.size(); ++k)
      EXPECT_TRUE(nodes[k] == moved[k] || (std::isnan(nodes[k]) && std::isnan(moved[k])));
  }
}

TEST(raster_nodes, a_raster_all_round_the_globe_has_no_seam) {
  Raster raster;
  raster.cols = 360;
  raster.rows = 10;
  raster.samples.clear();
  for (int row = 0; row < raster.rows; ++row) {
    for (int col = 0; col < raster.cols; ++col) raster.samples.push_back(static_cast<float>((col * 7919) % 97));
  }
  raster.place.affine = {-179.5, 1, 0, 5, 0, -1};
  const NodeWindow around{1440, -6, 90 * 4 - 8, 12, 8};
  const std::vector<float> nodes = raster.read(around);
  NodeWindow west = around, east = around;
  west.cols = east.cols = 6;
  west.col = 1440 - 6;
  east.col = 0;
  const std::vector<float> left = raster.read(west), right = raster.read(east);
  for (int j = 0; j < 8; ++j) {
    for (int i = 0; i < 6; ++i) {
      EXPECT_EQ(nodes[static_cast<std::size_t>(12 * j + i)], left[static_cast<std::size_t>(6 * j + i)]);
      EXPECT_EQ(nodes[static_cast<std::size_t>(12 * j + 6 + i)], right[static_cast<std::size_t>(6 * j + i)]);
      EXPECT_FALSE(std::isnan(left[static_cast<std::size_t>(6 * j + i)]));
    }
  }
}

/// The same degrees, via a transform.
class Same final : public PointTransform {
 public:
  bool apply(std::span<double>, std::span<double>) const override { return true; }
};

TEST(raster_nodes, a_transform_that_changes_nothing_changes_next_to_nothing) {
  Raster raster;
  raster.samples[12 * 40 + 20] = kNone;
  const NodeWindow window{4608, 2435, 511, 60, 50};
  const std::vector<float> direct = raster.read(window);
  raster.place.from_degrees = std::make_shared<Same>();
  const std::vector<float> placed = raster.read(window);
  int heights = 0;
  for (std::size_t k = 0; k < direct.size(); ++k) {
    ASSERT_EQ(std::isnan(direct[k]), std::isnan(placed[k]));
    if (std::isnan(direct[k])) continue;
    EXPECT_NEAR(direct[k], placed[k], 1e-2);
    ++heights;
  }
  EXPECT_GT(heights, 1000);
}

TEST(degrees_covered, are_half_a_cell_more_than_the_samples) {
  const Raster raster;
  const auto box = degrees_covered(raster.field(), raster.place.affine, nullptr);
  ASSERT_TRUE(box);
  EXPECT_EQ(box->west, 10 - 0.0625);
  EXPECT_EQ(box->north, 50 + 0.0625);
  EXPECT_EQ(box->east, 10 - 0.0625 + 40 * 0.125);
  EXPECT_EQ(box->south, 50 + 0.0625 - 30 * 0.125);
}

TEST(plan_pyramid, chooses_levels_as_known_rasters_are_tiled) {
  // 3" at the equator is level 11, 1" level 13, half a metre at 47° N level 18.
  EXPECT_EQ(plan_pyramid({{0, -1, 1, 1}, 92.5, 0, 100})->max_zoom(), 11);
  EXPECT_EQ(plan_pyramid({{0, -1, 1, 1}, 30.8, 0, 100})->max_zoom(), 13);
  EXPECT_EQ(plan_pyramid({{7, 46.9, 8, 47.1}, 0.5, 0, 100})->max_zoom(), 18);
}

TEST(plan_pyramid, refuses_what_no_pyramid_can_be) {
  const SourceFacts source{{0, -1, 1, 1}, 30, 0, 1000};
  const auto refused = [&](auto change) {
    PyramidSettings settings;
    change(settings);
    const auto plan = plan_pyramid(source, settings);
    return !plan && plan.error().kind == ErrorKind::kUsage;
  };
  EXPECT_TRUE(refused([](auto& s) { s.cells = 100; }));
  EXPECT_TRUE(refused([](auto& s) { s.max_zoom = 24; }));
  EXPECT_TRUE(refused([](auto& s) { s.quality = 0; }));
  EXPECT_TRUE(refused([](auto& s) { s.max_error = NAN; }));
  EXPECT_TRUE(refused([](auto& s) { s.max_error = 0.01; }));
  EXPECT_TRUE(refused([](auto& s) { s.background = 1e6f; }));
  EXPECT_FALSE(plan_pyramid({{0, -1, 1, 1}, 30, -32768, 1000}));
}

std::vector<std::uint8_t> some_file(std::span<const std::uint8_t> water_mask = {}) {
  const PyramidPlan plan = *plan_pyramid({{-180, -90, 180, 90}, 1000, 0, 100}, {.cells = 16, .max_zoom = 5});
  const Raster raster;
  const auto source = make_node_source(raster.field(), raster.place);
  const auto tile = make_tile(plan, {5, 33, 24}, **source);
  EXPECT_TRUE(tile);
  return encode_quantized_mesh(*tile, {}, {}, water_mask);
}

TEST(quantized_mesh, is_read_back) {
  const std::vector<std::uint8_t> bytes = some_file();
  const auto mesh = decode_quantized_mesh(bytes, "tile");
  ASSERT_TRUE(mesh);
  EXPECT_GT(mesh->triangles.size(), 30u);
  EXPECT_EQ(mesh->normals.size(), mesh->u.size());
  EXPECT_GE(mesh->west.size(), 2u);
  EXPECT_TRUE(mesh->water_mask.empty());
}

TEST(quantized_mesh, a_water_mask_is_read_back_beside_the_rest) {
  std::vector<std::uint8_t> mask(65536);
  for (std::size_t k = 0; k < mask.size(); ++k) mask[k] = static_cast<std::uint8_t>(k * 7);
  const auto plain = decode_quantized_mesh(some_file(), "tile"),
             masked = decode_quantized_mesh(some_file(mask), "tile");
  ASSERT_TRUE(plain && masked);
  EXPECT_EQ(masked->water_mask, mask);
  EXPECT_EQ(masked->normals, plain->normals);
  EXPECT_EQ(masked->triangles, plain->triangles);
}

TEST(quantized_mesh, damaged_files_are_refused_or_read_without_harm) {
  const std::vector<std::uint8_t> bytes = some_file();
  for (std::size_t size = 0; size < bytes.size(); size += 7) {
    const auto mesh = decode_quantized_mesh(std::span(bytes).first(size), "tile");
    if (mesh) {
      EXPECT_TRUE(mesh->normals.empty());
    }
  }
  std::mt19937 random(7);
  for (int trial = 0; trial < 3000; ++trial) {
    std::vector<std::uint8_t> damaged = bytes;
    for (int k = 0; k < 3; ++k) damaged[random() % damaged.size()] = static_cast<std::uint8_t>(random());
    const auto mesh = decode_quantized_mesh(damaged, "tile");
    if (!mesh) continue;
    for (const std::uint32_t v : mesh->triangles) ASSERT_LT(v, mesh->u.size());
    for (const auto* edge : {&mesh->west, &mesh->south, &mesh->east, &mesh->north}) {
      for (const std::uint32_t v : *edge) ASSERT_LT(v, mesh->u.size());
    }
  }
}

TEST(gzip, is_read_back_and_damage_is_noticed) {
  const std::vector<std::uint8_t> bytes = some_file();
  auto packed = io::compress_gzip(bytes);
  ASSERT_TRUE(packed);
  EXPECT_EQ(*io::decompress_gzip(*packed, 1 << 20), bytes);
  EXPECT_FALSE(io::decompress_gzip(*packed, bytes.size() - 1));
  EXPECT_FALSE(io::decompress_gzip(std::span(*packed).first(packed->size() - 9), 1 << 20));
  EXPECT_FALSE(io::decompress_gzip({}, 1 << 20));
  (*packed)[packed->size() / 2] ^= 0x55;
  EXPECT_FALSE(io::decompress_gzip(*packed, 1 << 20));
}

/// Bytes with few values in random order, like differences of a mesh's numbers; or periodic bytes.
std::vector<std::uint8_t> mesh_like(std::size_t count, std::size_t period) {
  std::mt19937 random(3);
  std::vector<std::uint8_t> bytes;
  for (std::size_t i = 0; i < count; ++i)
    bytes.push_back(i < period ? static_cast<std::uint8_t>(std::min(random() % 40, random() % 40)) : bytes[i - period]);
  return bytes;
}

TEST(gzip, of_a_mesh_is_no_larger_whether_it_repeats_itself_or_not) {
  for (const std::size_t period : {40'000u, 7u}) {
    for (const std::size_t count : {0u, 100u, 5000u, 40'000u}) {
      const std::vector<std::uint8_t> bytes = mesh_like(count, period);
      const auto packed = io::compress_gzip_of_mesh(bytes), thorough = io::compress_gzip(bytes);
      ASSERT_TRUE(packed && thorough);
      EXPECT_EQ(*io::decompress_gzip(*packed, 1 << 20), bytes);
      EXPECT_LE(packed->size(), thorough->size() + thorough->size() / 50 + 20) << period << ' ' << count;
    }
  }
}

}  // namespace
}  // namespace scarp::tile_test
