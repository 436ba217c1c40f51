// Uvs, colours and channels in every format that can store them.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "io/mesh/srgb.h"
#include "mesh_samples.h"
#include "scarp/io.h"

namespace scarp::mesh_attributes_test {
namespace {

using test::to_bytes;

bool same(float a, float b) { return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b)); }

Mesh random_mesh() {
  Mesh mesh = test::grid_mesh(
      *rc::gen::inRange(1, 5), *rc::gen::inRange(1, 5), [](int, int) { return true; }, *rc::gen::arbitrary<bool>());
  mesh.origin = {512345.625, 4023456.0625, 0};
  const std::size_t count = mesh.vertex_count();
  if (*rc::gen::arbitrary<bool>()) {
    for (std::size_t i = 0; i < 2 * count; ++i)
      mesh.uvs.push_back(static_cast<float>(*rc::gen::inRange(0, 65537)) / 65536);
  }
  if (*rc::gen::arbitrary<bool>())
    mesh.colors = *rc::gen::container<std::vector<std::uint8_t>>(3 * count, rc::gen::arbitrary<std::uint8_t>());
  mesh.channel_count = *rc::gen::element(0, 1, 3, 7);
  const bool are_colors = !mesh.colors.empty() && mesh.channel_count == 3 && *rc::gen::arbitrary<bool>();
  for (std::size_t i = 0; i < static_cast<std::size_t>(mesh.channel_count) * count; ++i) {
    if (are_colors) {
      mesh.channels.push_back(mesh.colors[i]);
    } else if (*rc::gen::inRange(0, 9) == 0) {
      mesh.channels.push_back(std::numeric_limits<float>::quiet_NaN());
    } else {
      mesh.channels.push_back(static_cast<float>(*rc::gen::arbitrary<std::int32_t>()) / 128);
    }
  }
  return mesh;
}

RC_GTEST_PROP(MeshAttributes, ComeBackFromEveryFormat, ()) {
  const Mesh mesh = random_mesh();
  for (const MeshFormat format :
       {MeshFormat::kGlb, MeshFormat::kObj, MeshFormat::kPly, MeshFormat::kStl, MeshFormat::kTin}) {
    const auto bytes = encode_mesh(mesh, format);
    RC_ASSERT(bytes.has_value());
    const auto back = decode_mesh(*bytes, "x");
    RC_ASSERT(back.has_value());
    RC_ASSERT(back->triangle_count() == mesh.triangle_count());
    if (format == MeshFormat::kStl || format == MeshFormat::kTin) {
      RC_ASSERT(back->vertex_count() == mesh.vertex_count());
      RC_ASSERT(back->uvs.empty() && back->colors.empty() && back->channels.empty());
      for (std::size_t i = 0; i < mesh.triangles.size() && format == MeshFormat::kTin; ++i) {
        RC_ASSERT(back->vertex(back->triangles[i]) == mesh.vertex(mesh.triangles[i]));
      }
      continue;
    }
    RC_ASSERT(test::same_geometry(mesh, *back));
    RC_ASSERT(back->uvs == mesh.uvs);
    RC_ASSERT(back->colors == mesh.colors);
    if (format == MeshFormat::kObj) continue;  // cannot hold channels
    RC_ASSERT(back->channel_count == mesh.channel_count);
    RC_ASSERT(back->channels.size() == mesh.channels.size());
    for (std::size_t i = 0; i < mesh.channels.size(); ++i) RC_ASSERT(same(back->channels[i], mesh.channels[i]));
  }
}

TEST(Srgb, EveryByteComesBack) {
  for (int b = 0; b < 256; ++b) {
    const auto linear = static_cast<double>(io::kLinearOfSrgb[static_cast<std::size_t>(b)]);
    EXPECT_EQ(io::srgb_of_linear(linear), b);
    const double c = b / 255.0, exact = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    EXPECT_NEAR(linear, exact, 1e-7);
    EXPECT_EQ(static_cast<float>(linear), static_cast<float>(exact)) << b;
  }
  EXPECT_EQ(io::kLinearOfSrgb[0], 0);
  EXPECT_EQ(io::kLinearOfSrgb[255], 1);
  EXPECT_EQ(io::srgb_of_linear(-1), 0);
  EXPECT_EQ(io::srgb_of_linear(7), 255);
  EXPECT_EQ(io::srgb_of_linear(NAN), 0);
}

nlohmann::json json_of(const std::vector<std::uint8_t>& bytes) {
  std::uint32_t size = 0;
  std::memcpy(&size, &bytes[12], 4);
  return nlohmann::json::parse(bytes.begin() + 20, bytes.begin() + 20 + size);
}

TEST(GlbAttributes, WritesChannelsOnlyWhereColoursDoNotSayThem) {
  Mesh mesh = test::sample_mesh();
  test::add_attributes(mesh, 3);
  mesh.channels.assign(mesh.colors.begin(), mesh.colors.end());
  auto attributes = [&] {
    return json_of(*encode_mesh(mesh, MeshFormat::kGlb))["meshes"][0]["primitives"][0]["attributes"];
  };
  EXPECT_TRUE(attributes().contains("COLOR_0"));
  EXPECT_TRUE(attributes().contains("TEXCOORD_0"));
  EXPECT_FALSE(attributes().contains("_CHANNEL_1"));
  mesh.channels[5] += 0.25f;
  EXPECT_TRUE(attributes().contains("_CHANNEL_3"));
  mesh.colors.clear();
  EXPECT_FALSE(attributes().contains("COLOR_0"));
  EXPECT_TRUE(attributes().contains("_CHANNEL_1"));
}

TEST(GlbAttributes, ColoursAreNotTinted) {
  Mesh mesh = test::sample_mesh();
  test::add_attributes(mesh, 0);
  const auto json = json_of(*encode_mesh(mesh, MeshFormat::kGlb));
  EXPECT_EQ(json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"], nlohmann::json({1.0, 1.0, 1.0, 1.0}));
}

TEST(GlbAttributes, AValueThatStandsForNoneIsRefused) {
  Mesh mesh = test::sample_mesh();
  test::add_attributes(mesh, 2);
  mesh.channels[3] = std::numeric_limits<float>::lowest();
  const auto bytes = encode_mesh(mesh, MeshFormat::kGlb);
  ASSERT_TRUE(bytes);
  EXPECT_EQ(decode_mesh(*bytes, "x")->channels, mesh.channels);
  mesh.channels[4] = NAN;
  EXPECT_EQ(encode_mesh(mesh, MeshFormat::kGlb).error().kind, ErrorKind::kOutput);
  EXPECT_TRUE(encode_mesh(mesh, MeshFormat::kPly));
}

/// A GLB of one triangle whose COLOR_0 and TEXCOORD_0 are `colors` and `uvs` of the given glTF types.
std::vector<std::uint8_t> foreign_glb(const std::string& color, const std::vector<std::uint8_t>& colors,
                                      const std::string& uv, const std::vector<std::uint8_t>& uvs) {
  std::vector<std::uint8_t> binary;
  for (const float p : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 0.f, -1.f}) {
    std::uint8_t bytes[4];
    std::memcpy(bytes, &p, 4);
    binary.insert(binary.end(), bytes, bytes + 4);
  }
  binary.insert(binary.end(), colors.begin(), colors.end());
  binary.resize(36 + 24);
  binary.insert(binary.end(), uvs.begin(), uvs.end());
  binary.resize(36 + 24 + 24);
  std::string json = R"({"asset":{"version":"2.0"},"meshes":[{"primitives":[{"attributes":{"POSITION":0,"COLOR_0":1,)"
                     R"("TEXCOORD_0":2,"_SOMETHING":1,"COLOR_1":9},"mode":4}]}],"buffers":[{"byteLength":84}],)"
                     R"("bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":24},)"
                     R"({"buffer":0,"byteOffset":60,"byteLength":24}],"accessors":[)"
                     R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
                     R"({"bufferView":1,"count":3,"normalized":true,)" +
                     color + R"(},{"bufferView":2,"count":3,"normalized":true,)" + uv + "}]}";
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::vector<std::uint8_t> bytes = to_bytes("glTF");
  const auto put = [&](std::size_t value) {
    for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<std::uint8_t>(value >> shift));
  };
  put(2);
  put(12 + 8 + json.size() + 8 + binary.size());
  put(json.size());
  bytes.insert(bytes.end(), {'J', 'S', 'O', 'N'});
  bytes.insert(bytes.end(), json.begin(), json.end());
  put(binary.size());
  bytes.insert(bytes.end(), {'B', 'I', 'N', 0});
  bytes.insert(bytes.end(), binary.begin(), binary.end());
  return bytes;
}

TEST(GlbAttributes, ForeignIntegersAreFractionsOfLinearLight) {
  const std::vector<std::uint8_t> bytes_rgba{255, 0, 55, 9, 0, 255, 0, 9, 1, 2, 3, 9};
  const std::vector<std::uint8_t> shorts_uv{0, 0, 255, 255, 255, 127, 0, 0, 255, 255, 0, 0};
  const auto mesh = decode_mesh(foreign_glb(R"("componentType":5121,"type":"VEC4")", bytes_rgba,
                                            R"("componentType":5123,"type":"VEC2")", shorts_uv),
                                "x.glb");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->colors,
            (std::vector<std::uint8_t>{255, 0, io::srgb_of_linear(55 / 255.0), 0, 255, 0, io::srgb_of_linear(1 / 255.0),
                                       io::srgb_of_linear(2 / 255.0), io::srgb_of_linear(3 / 255.0)}));
  EXPECT_EQ(mesh->uvs, (std::vector<float>{0, 1, 32767 / 65535.f, 0, 1, 0}));
  EXPECT_EQ(mesh->channel_count, 0);

  const std::vector<std::uint8_t> shorts_rgb{255, 255, 0, 0, 255, 255, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 255, 255};
  const auto other = decode_mesh(foreign_glb(R"("componentType":5123,"type":"VEC3")", shorts_rgb,
                                             R"("componentType":5121,"type":"VEC2")", {255, 0, 0, 255, 51, 255}),
                                 "x.glb");
  ASSERT_TRUE(other) << other.error().message;
  EXPECT_EQ(other->colors, (std::vector<std::uint8_t>{255, 0, 255, 0, 0, 0, 0, 0, 255}));
  EXPECT_EQ(other->uvs, (std::vector<float>{1, 0, 0, 1, 0.2f, 1}));

  const auto broken = decode_mesh(
      foreign_glb(R"("componentType":5126,"type":"VEC4")", {}, R"("componentType":5121,"type":"VEC2")", {}), "x.glb");
  ASSERT_FALSE(broken);
  EXPECT_EQ(broken.error().kind, ErrorKind::kInput);
}

TEST(PlyAttributes, ReadsForeignTypesAndNames) {
  const auto mesh =
      decode_mesh(to_bytes("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                           "property float z\nproperty float red\nproperty ushort green\nproperty uchar blue\n"
                           "property uchar alpha\nproperty float texture_u\nproperty float texture_v\n"
                           "property float channel_2\nproperty float channel_1\nproperty float channel_99\n"
                           "element face 1\nproperty list uchar int vertex_index\nend_header\n"
                           "0 0 0 1 65535 7 255 0.25 1 2 1 9\n1 0 0 0.2 257 8 255 0 0.5 4 nan 9\n"
                           "0 1 0 0 0 255 0 1 0 -6 5.5 9\n3 0 1 2\n"),
                  "x.ply");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->colors, (std::vector<std::uint8_t>{255, 255, 7, 51, 1, 8, 0, 0, 255}));
  EXPECT_EQ(mesh->uvs, (std::vector<float>{0.25f, 0, 0, 0.5f, 1, 1}));
  ASSERT_EQ(mesh->channel_count, 2);
  EXPECT_EQ(mesh->channels[1], 2);
  EXPECT_TRUE(std::isnan(mesh->channels[2]));
  EXPECT_EQ(mesh->channels[4], 5.5f);
}

TEST(ObjAttributes, ReadsForeignColoursAndSeams) {
  const std::string faces = "f 1/1 2/2 3/3\n";
  const auto mesh = decode_mesh(to_bytes("v 0 0 0 1 0 0.2\nv 1 0 0 0 0 0\nv 0 1 0 1 1 1\nvt 0.5 0.25\nvt 0 0 0\n"
                                         "vt 1 1\nf -3/-3 -2/-2 -1/-1\n"),
                                "x.obj");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->colors, (std::vector<std::uint8_t>{255, 0, 51, 0, 0, 0, 255, 255, 255}));
  EXPECT_EQ(mesh->uvs, (std::vector<float>{0.5f, 0.75f, 0, 1, 1, 0}));
  const auto in_bytes = decode_mesh(to_bytes("v 0 0 0 255 0 51\nv 1 0 0 0 0 1\nv 0 1 0 1 1 1\nf 1 2 3\n"), "x.obj");
  EXPECT_EQ(in_bytes->colors, (std::vector<std::uint8_t>{255, 0, 51, 0, 0, 1, 1, 1, 1}));
  // A seam, a vertex without colour, a weight: not attributes of each vertex.
  const auto seam =
      decode_mesh(to_bytes("v 0 0 0 1 0 0\nv 1 0 0\nv 0 1 0 1\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/3 3/2\n"), "x.obj");
  ASSERT_TRUE(seam);
  EXPECT_TRUE(seam->colors.empty());
  EXPECT_TRUE(seam->uvs.empty());
  EXPECT_FALSE(decode_mesh(to_bytes("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt x\n" + faces), "x.obj"));
}

TEST(Tin, ReadsWhatScapeAndTerraWrite) {
  const auto mesh = decode_mesh(to_bytes("t 0 0 306.6 335 0 322.4 0 458 352.6\n"
                                         "t 335 0 322.4 335 458 495.6 0 458 352.6\n"),
                                "nameless");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->vertex_count(), 4u);
  EXPECT_EQ(mesh->triangles, (std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2}));
  for (const char* text : {"t 0 0 0 1 0 0 0 1\n", "t 0 0 0 1 0 0 0 1 x\n", "t 0 0 0 1 0 0 0 1 inf\n",
                           "t 0 0 0 1 0 0 0 1 0 7\n", "t 0 0 0 1 0 0 0 1 0\nv 1 2 3\n", "t\n"}) {
    const auto broken = decode_mesh(to_bytes(text), "x.tin");
    ASSERT_FALSE(broken) << text;
    EXPECT_NE(broken.error().message.find("line "), std::string::npos) << broken.error().message;
  }
}

}  // namespace
}  // namespace scarp::mesh_attributes_test
