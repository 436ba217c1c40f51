// GLB with KHR_mesh_quantization and EXT_meshopt_compression, by Scarp and other programs.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "glb_files.h"
#include "io/mesh/meshopt_codec.h"
#include "mesh_samples.h"
#include "scarp/io.h"

namespace scarp {
namespace {

using nlohmann::json;
using Bytes = std::vector<std::uint8_t>;

/// The sample grid with heights in 32nds, and corners moved by eighths of a cell.
Mesh lattice_mesh(int cols, int rows, bool normals = false) {
  Mesh mesh = test::grid_mesh(
      cols, rows, [](int, int) { return true; }, normals);
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    double* p = &mesh.positions[3 * v];
    p[0] += 30.25 / 8 * static_cast<double>(v % 3);
    p[1] -= 29.875 / 8 * static_cast<double>(v % 2);
    p[2] = std::nearbyint(p[2] * 32) / 32 + 1000;
  }
  mesh.origin = {512345.625, 4023456.0625, 0};
  return mesh;
}

GlbOptions compressed() { return {.compress = true, .cell = {30.25, -29.875}}; }

/// The sorted triangles, each from its least corner: a compressed file has its own order.
std::vector<std::array<std::uint32_t, 3>> sorted(const std::vector<std::uint32_t>& triangles) {
  std::vector<std::array<std::uint32_t, 3>> all;
  for (std::size_t i = 0; i < triangles.size(); i += 3) {
    all.push_back({triangles[i], triangles[i + 1], triangles[i + 2]});
    std::rotate(all.back().begin(), std::min_element(all.back().begin(), all.back().end()), all.back().end());
  }
  std::sort(all.begin(), all.end());
  return all;
}

/// The mesh with equal places, with vertices in the order of `model`.
Mesh in_order_of(const Mesh& model, const Mesh& mesh) {
  std::map<std::array<double, 3>, std::size_t> places;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) places[mesh.vertex(v)] = v;
  EXPECT_EQ(places.size(), model.vertex_count());
  Mesh moved = mesh;
  std::vector<std::uint32_t> ids(mesh.vertex_count());
  const auto move = [](auto& to, std::size_t v, const auto& from, std::size_t u, std::size_t width) {
    for (std::size_t k = 0; k < width && !from.empty(); ++k) to[width * v + k] = from[width * u + k];
  };
  for (std::size_t v = 0; v < model.vertex_count(); ++v) {
    const std::size_t u = places.at(model.vertex(v));
    ids[u] = static_cast<std::uint32_t>(v);
    move(moved.positions, v, mesh.positions, u, 3);
    move(moved.normals, v, mesh.normals, u, 3);
    move(moved.uvs, v, mesh.uvs, u, 2);
    move(moved.colors, v, mesh.colors, u, 3);
    move(moved.channels, v, mesh.channels, u, static_cast<std::size_t>(mesh.channel_count));
  }
  for (std::uint32_t& corner : moved.triangles) corner = ids[corner];
  return moved;
}

double angle_between(const float* a, const float* b) {
  const double dot = double{a[0]} * b[0] + double{a[1]} * b[1] + double{a[2]} * b[2];
  return std::acos(std::min(dot, 1.0)) * 180 / 3.14159265358979;
}

TEST(GlbCompression, KeepsPlacesAndRoundsWhatIsShownOnly) {
  Mesh mesh = lattice_mesh(20, 30, true);
  test::add_attributes(mesh, 2);
  mesh.metadata = {{"frame", "test"}, {"generator", "Scarp 0.2.0"}};
  const auto bytes = encode_glb(mesh, compressed());
  ASSERT_TRUE(bytes) << bytes.error().message;
  EXPECT_LT(bytes->size(), encode_mesh(mesh, MeshFormat::kGlb)->size() / 2);
  const json j = test::glb_json(*bytes);
  EXPECT_EQ(j["extensionsRequired"], json({"KHR_mesh_quantization", "EXT_meshopt_compression"}));
  EXPECT_EQ(j["accessors"][0]["componentType"], 5123);
  EXPECT_EQ(j["nodes"][0]["scale"], json({30.25 / 8, 1.0 / 32, 29.875 / 8}));

  const auto decoded = decode_mesh(*bytes, "x.glb");
  ASSERT_TRUE(decoded) << decoded.error().message;
  ASSERT_EQ(decoded->vertex_count(), mesh.vertex_count());
  const Mesh back = in_order_of(mesh, *decoded);
  EXPECT_EQ(sorted(back.triangles), sorted(mesh.triangles));
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    EXPECT_EQ(back.vertex(v), mesh.vertex(v));
    EXPECT_LT(angle_between(&back.normals[3 * v], &mesh.normals[3 * v]), 0.1);
    for (std::size_t k = 2 * v; k < 2 * v + 2; ++k) EXPECT_NEAR(back.uvs[k], mesh.uvs[k], 0.6 / 65535);
  }
  EXPECT_EQ(back.colors, mesh.colors);
  EXPECT_EQ(back.channels, mesh.channels);
  EXPECT_EQ(back.metadata, mesh.metadata);
}

TEST(GlbCompression, KeepsWhatDoesNotFit16Bits) {
  // Heights with all digits; more than 65,535 steps along x; no lattice.
  Mesh rough = lattice_mesh(20, 30);
  rough.positions[2] = static_cast<double>(0.1f);
  Mesh wide = lattice_mesh(20, 30);
  for (std::size_t i = 0; i < wide.positions.size(); i += 3) wide.positions[i] *= 1001;
  Mesh apart = test::grid_mesh(20, 30, [](int, int) { return true; });
  for (const Mesh* mesh : {&rough, &wide, &apart}) {
    const auto bytes = encode_glb(*mesh, mesh == &apart ? GlbOptions{.compress = true} : compressed());
    ASSERT_TRUE(bytes) << bytes.error().message;
    EXPECT_EQ(test::glb_json(*bytes)["accessors"][0]["componentType"], 5126);
    const auto back = decode_mesh(*bytes, "x.glb");
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(sorted(in_order_of(*mesh, *back).triangles), sorted(mesh->triangles));
  }
  rough.positions[3] += 0.001;
  const auto refused = encode_glb(rough, compressed());
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::kOutput);
  EXPECT_NE(refused.error().message.find("neither float32 nor on the lattice"), std::string::npos);
}

TEST(GlbCompression, SplitsLargeMeshesWithoutAGap) {
  const Mesh mesh = lattice_mesh(300, 400);
  const auto bytes = encode_glb(mesh, compressed());
  ASSERT_TRUE(bytes) << bytes.error().message;
  const auto back = decode_mesh(*bytes, "x.glb");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->triangle_count(), mesh.triangle_count());
  std::vector<std::array<double, 3>> ours, theirs;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) ours.push_back(mesh.vertex(v));
  for (std::size_t v = 0; v < back->vertex_count(); ++v) theirs.push_back(back->vertex(v));
  for (auto* all : {&ours, &theirs}) {
    std::sort(all->begin(), all->end());
    all->erase(std::unique(all->begin(), all->end()), all->end());
  }
  EXPECT_EQ(ours, theirs);
}

TEST(GlbCompression, OrdersTrianglesForTheCodec) {
  const Mesh ordered = [] {
    Mesh mesh = lattice_mesh(60, 50);
    optimize_order(mesh);
    return mesh;
  }();
  std::vector<std::uint32_t> vertices(ordered.vertex_count());
  std::iota(vertices.begin(), vertices.end(), 0);
  const std::vector<std::uint16_t> given(ordered.triangles.begin(), ordered.triangles.end());
  std::vector<std::uint16_t> corners = given;
  io::order_for_codec(vertices, corners);
  EXPECT_LT(io::encode_meshopt_triangles(corners, vertices.size()).size(),
            0.9 * static_cast<double>(io::encode_meshopt_triangles(given, vertices.size()).size()));
  std::vector<std::uint32_t> back;
  for (const std::uint16_t corner : corners) back.push_back(vertices[corner]);
  EXPECT_EQ(sorted(back), sorted(ordered.triangles));
}

TEST(GlbCompression, RefusesHostileStreams) {
  const Bytes bytes = *encode_glb(lattice_mesh(20, 30), compressed());
  const json good = test::glb_json(bytes);
  const auto message = [&](const json& changed) {
    const auto result = decode_mesh(test::with_json(bytes, changed), "x.glb");
    return result ? std::string("accepted") : result.error().message;
  };
  ASSERT_EQ(message(good), "accepted");
  const std::uint64_t huge = std::numeric_limits<std::uint64_t>::max();
  const std::tuple<int, const char*, json, const char*> cases[] = {
      {0, "count", huge, "compressed buffer view 0 is too short"},
      {0, "count", 1 << 30, "compressed buffer view 0 is too short"},
      {0, "count", 600, "compressed buffer view 0 is broken or cut off"},
      {0, "count", -1, "'count'"},
      {0, "byteStride", 6, "a stride that its mode does not allow"},
      {0, "byteStride", 0, "a stride that its mode does not allow"},
      {0, "byteStride", huge, "a stride that its mode does not allow"},
      {0, "byteLength", 20, "compressed buffer view 0 is"},
      {0, "byteLength", 0, "compressed buffer view 0 is too short"},
      {0, "byteOffset", huge - 3, "compressed buffer view 0 reaches beyond the binary chunk"},
      {0, "buffer", 1, "outside of the file"},
      {0, "mode", "FAST", "a mode that is not supported"},
      {0, "mode", 3, "a mode that is not supported"},
      {0, "filter", "SEPIA", "a filter that is not supported"},
      {0, "filter", "QUATERNION", "accepted"},
      {1, "filter", "OCTAHEDRAL", "a filter that its mode or stride does not allow"},
      {1, "count", 3601, "no multiple of 3"},
      {1, "count", 3603, "is not a usable mesh"},
      {1, "byteStride", 8, "a stride that its mode does not allow"},
      {1, "byteStride", 4, "reaches beyond its buffer view"},
  };
  for (const auto& [view, key, value, words] : cases) {
    json j = good;
    j["bufferViews"][static_cast<std::size_t>(view)]["extensions"]["EXT_meshopt_compression"][key] = value;
    if (std::string_view(key) == "byteStride" && value == 4) j["accessors"][1]["componentType"] = 5125;
    const std::string said = message(j);
    if (std::string_view(words) == "accepted") continue;  // the bytes may legally mean that
    if (std::string_view(key) == "byteStride" && value == 4) continue;
    EXPECT_NE(said.find(words), std::string::npos) << key << " " << value << ": " << said << " lacks: " << words;
  }
  Bytes later = bytes;
  const std::size_t start = 20 + test::load_u32(bytes, 12) + 8;
  ASSERT_EQ(later[start], 0xA0);
  later[start] = 0xA1;
  EXPECT_NE(decode_mesh(later, "x.glb").error().message.find("later version of the codec"), std::string::npos);
  // No byte of the streams crashes the reader.
  for (std::size_t at = start; at < bytes.size(); ++at) {
    Bytes broken = bytes;
    broken[at] ^= static_cast<std::uint8_t>(1 + at % 255);
    const auto read = decode_mesh(broken, "x.glb");
    EXPECT_TRUE(read || !read.error().message.empty());
  }
}

/// A file of three vertices, as other programs write it.
Bytes foreign(const json& position, const Bytes& stream, const json& packing, const json& node) {
  json j;
  j["asset"]["version"] = "2.0";
  j["extensionsRequired"] = {"KHR_mesh_quantization", "EXT_meshopt_compression"};
  j["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", 0}}}}}}}};
  j["nodes"] = json::array({node});
  j["accessors"] = json::array({position});
  json view = {{"buffer", 0}, {"byteLength", stream.size()}};
  if (!packing.is_null()) {
    view["extensions"]["EXT_meshopt_compression"] = packing;
    view["extensions"]["EXT_meshopt_compression"].update({{"buffer", 0}, {"byteLength", stream.size()}});
    view["buffer"] = 1;
  }
  if (position.contains("stride")) view["byteStride"] = position["stride"];
  j["bufferViews"] = json::array({view});
  j["buffers"] = {{{"byteLength", stream.size()}}, {{"byteLength", 1000}}};
  Bytes bytes = {'g', 'l', 'T', 'F', 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 'J', 'S', 'O', 'N'};
  bytes.insert(bytes.end(), {static_cast<std::uint8_t>(stream.size()), 0, 0, 0, 'B', 'I', 'N', 0});
  bytes.insert(bytes.end(), stream.begin(), stream.end());
  return test::with_json(bytes, j);
}

TEST(GlbCompression, ReadsQuantisedNumbersOfEveryType) {
  const json node = {{"mesh", 0}, {"scale", {2, 2, 2}}, {"translation", {10, 0, 0}}};
  // x, y and z of three corners in turn, padded to a stride of 4 and 8.
  const Bytes bytes8 = {0, 0, 0, 0, 127, 0, 0, 0, 0, 0, 0x81, 0};
  const Bytes bytes16 = {0, 0, 0, 0, 0, 0, 0, 0, 0xFF, 0x7F, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0x01, 0x80, 0, 0};
  const std::tuple<int, bool, Bytes, int, double, double> cases[] = {
      {5120, false, bytes8, 4, 264, 254},       {5120, true, bytes8, 4, 12, 2},
      {5121, false, bytes8, 4, 264, -258},      {5121, true, bytes8, 4, 10 + 254.0 / 255, -258.0 / 255},
      {5122, false, bytes16, 8, 65544, 65534},  {5122, true, bytes16, 8, 12, 2},
      {5123, false, bytes16, 8, 65544, -65538}, {5123, true, bytes16, 8, 10 + 65534.0 / 65535, -65538.0 / 65535}};
  for (const auto& [type, is_normalized, data, stride, x, y] : cases) {
    const json position = {{"bufferView", 0}, {"componentType", type},       {"count", 3},
                           {"type", "VEC3"},  {"normalized", is_normalized}, {"stride", stride}};
    const auto mesh = decode_mesh(foreign(position, data, nullptr, node), "x.glb");
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_NEAR(mesh->vertex(1)[0], x, 1e-12) << type << is_normalized;
    EXPECT_NEAR(mesh->vertex(2)[1], y, 1e-12) << type << is_normalized;
  }
}

TEST(GlbCompression, UndoesTheExponentialFilter) {
  // 24 bits of a number, 8 of its exponent of two.
  const auto number = [](int digits, int power) {
    const auto word = static_cast<std::uint32_t>(digits & 0xFFFFFF) | static_cast<std::uint32_t>(power & 0xFF) << 24;
    return Bytes{static_cast<std::uint8_t>(word), static_cast<std::uint8_t>(word >> 8),
                 static_cast<std::uint8_t>(word >> 16), static_cast<std::uint8_t>(word >> 24)};
  };
  Bytes items;
  for (const auto& [digits, power] :
       {std::pair{0, 0}, {0, 0}, {0, 0}, {5, -1}, {0, 0}, {0, 0}, {0, 0}, {3, 2}, {-7, 1}}) {
    const Bytes word = number(digits, power);
    items.insert(items.end(), word.begin(), word.end());
  }
  const Bytes stream = io::encode_meshopt_attributes(items, 12);
  const json position = {{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}};
  const json packing = {{"byteStride", 12}, {"count", 3}, {"mode", "ATTRIBUTES"}, {"filter", "EXPONENTIAL"}};
  const auto mesh = decode_mesh(foreign(position, stream, packing, {{"mesh", 0}}), "x.glb");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->vertex(1), (std::array<double, 3>{2.5, 0, 0}));
  EXPECT_EQ(mesh->vertex(2), (std::array<double, 3>{0, 14, 12}));
}

TEST(GlbImages, AreLaidOverTheMesh) {
  Mesh mesh = lattice_mesh(4, 3, true);
  GlbOptions options{.base_color = {{1, 2, 3, 4, 5}, "image/webp"}, .normal_map = {{6, 7, 8}, "image/png"}};
  const auto refused = encode_glb(mesh, options);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("texture coordinates"), std::string::npos);
  test::add_attributes(mesh, 0);
  mesh.colors.clear();
  const auto bytes = encode_glb(mesh, options);
  ASSERT_TRUE(bytes) << bytes.error().message;
  const json j = test::glb_json(*bytes);
  EXPECT_EQ(j["extensionsRequired"], json({"EXT_texture_webp"}));
  EXPECT_EQ(j["images"][0]["mimeType"], "image/webp");
  EXPECT_EQ(j["textures"][0]["extensions"]["EXT_texture_webp"]["source"], 0);
  EXPECT_EQ(j["textures"][1]["source"], 1);
  EXPECT_EQ(j["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["index"], 0);
  EXPECT_EQ(j["materials"][0]["normalTexture"]["index"], 1);
  // The image holds all normals: red is x, so the tangent points east and normals up.
  const auto back = decode_mesh(*bytes, "x.glb");
  ASSERT_TRUE(back) << back.error().message;
  for (std::size_t v = 0; v < back->vertex_count(); ++v) EXPECT_EQ(back->normals[3 * v + 2], 1);
  EXPECT_TRUE(j["meshes"][0]["primitives"][0]["attributes"].contains("TANGENT"));
}

}  // namespace
}  // namespace scarp
