// Materials and node strings of small meshes.
#include "simplify/zones.h"

#include <gtest/gtest.h>

#include <string>

#include "scarp/io.h"

namespace scarp {
namespace {

constexpr std::array<double, 6> kSame{0, 1, 0, 0, 0, 1};

/// cols × rows unit squares of two triangles each.
Mesh grid(std::uint32_t cols, std::uint32_t rows) {
  Mesh mesh;
  for (std::uint32_t y = 0; y <= rows; ++y) {
    for (std::uint32_t x = 0; x <= cols; ++x)
      mesh.positions.insert(mesh.positions.end(), {double(x), double(y), double(x * y)});
  }
  for (std::uint32_t y = 0; y < rows; ++y) {
    for (std::uint32_t x = 0; x < cols; ++x) {
      const std::uint32_t a = y * (cols + 1) + x, b = a + 1, c = a + cols + 1, d = c + 1;
      mesh.triangles.insert(mesh.triangles.end(), {a, b, d, a, d, c});
    }
  }
  return mesh;
}

Line line_of(std::vector<std::array<double, 3>> points, LineRole role = LineRole::kLine) {
  Line line;
  line.points = std::move(points);
  line.role = role;
  line.name = "line";
  return line;
}

Line box(double west, double south, double east, double north) {
  return line_of({{west, south, 0}, {east, south, 0}, {east, north, 0}, {west, north, 0}, {west, south, 0}},
                 LineRole::kOuter);
}

TEST(zones, give_materials_by_centre_the_first_zone_before_others) {
  const Mesh mesh = grid(4, 1);
  run::Zone holed{{box(0, 0, 4, 1), box(1, 0, 2, 1)}, 7};
  const std::vector<run::Zone> zones{holed, {{box(0, 0, 2, 1)}, 5}};
  EXPECT_EQ(run::find_materials(mesh, zones, kSame, 3), (std::vector<std::uint32_t>{7, 7, 5, 5, 7, 7, 7, 7}));
  // In another frame, the mesh is ten times larger and lies elsewhere.
  Mesh far = mesh;
  for (double& value : far.positions) value *= 10;
  far.origin = {1000, 0, 0};
  EXPECT_EQ(run::find_materials(far, zones, {-100, 0.1, 0, 0, 0, 0.1}, 3), run::find_materials(mesh, zones, kSame, 3));
  EXPECT_EQ(run::find_materials(mesh, {}, kSame, 3), std::vector<std::uint32_t>(8, 3));
}

TEST(zones, strings_follow_edges_along_lines) {
  const Mesh mesh = grid(4, 4);
  const std::vector<Line> lines{line_of({{-1, 2, 0}, {2, 2, 0}, {4, 4, 0}}), line_of({{0, 1.5, 0}, {4, 1.5, 0}}),
                                line_of({{1, 1, 0}, {3, 1, 0}, {3, 3, 0}, {1, 3, 0}, {1, 1, 0}})};
  const auto strings = run::find_node_strings(mesh, lines, kSame, 0.01);
  ASSERT_EQ(strings.size(), 2u);
  EXPECT_EQ(strings[0].nodes, (std::vector<std::uint32_t>{10, 11, 12, 18, 24}));
  EXPECT_EQ(strings[1].nodes, (std::vector<std::uint32_t>{6, 7, 8, 13, 18, 17, 16, 11, 6}));
  EXPECT_EQ(strings[0].name, "line");
}

TEST(zones, a_line_that_leaves_the_surface_gives_a_string_for_each_part) {
  Mesh mesh = grid(5, 1);
  // Without the middle square.
  mesh.triangles.erase(mesh.triangles.begin() + 12, mesh.triangles.begin() + 18);
  const auto strings = run::find_node_strings(mesh, {line_of({{0, 1, 0}, {5, 1, 0}})}, kSame, 0.01);
  ASSERT_EQ(strings.size(), 2u);
  EXPECT_EQ(strings[0].nodes, (std::vector<std::uint32_t>{6, 7, 8}));
  EXPECT_EQ(strings[1].nodes, (std::vector<std::uint32_t>{9, 10, 11}));
}

TEST(zones, stand_in_a_2dm_that_is_read_back) {
  const Mesh mesh = grid(11, 1);
  MeshZones zones;
  zones.materials.assign(mesh.triangle_count(), 4);
  zones.materials[1] = 9;
  zones.node_strings.push_back({"crest", {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}});
  zones.node_strings.push_back({"inflow", {0, 12}});
  const auto bytes = encode_mesh(mesh, MeshFormat::k2dm, {.zones = &zones});
  ASSERT_TRUE(bytes) << bytes.error().message;
  const std::string text(bytes->begin(), bytes->end());
  EXPECT_NE(text.find("\nE3T 1 1 2 14 4\nE3T 2 1 14 13 9\n"), std::string::npos);
  EXPECT_NE(text.find("\nNS 1 2 3 4 5 6 7 8 9 10\nNS 11 -12 1\nNS 1 -13 2\n"), std::string::npos);
  const auto back = decode_mesh(*bytes, "x.2dm");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->triangles, mesh.triangles);
  EXPECT_EQ(back->positions, mesh.positions);
  const MeshZones none;
  EXPECT_EQ(*encode_mesh(mesh, MeshFormat::k2dm, {.zones = &none}), *encode_mesh(mesh, MeshFormat::k2dm));
  zones.materials.pop_back();
  EXPECT_EQ(encode_mesh(mesh, MeshFormat::k2dm, {.zones = &zones}).error().kind, ErrorKind::kUsage);
}

}  // namespace
}  // namespace scarp
