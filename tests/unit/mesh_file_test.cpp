// Guarantees of all mesh formats: damage is detected or harmless, and never causes a crash; an error is one message
// with the file's name.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

#include "mesh_samples.h"
#include "scarp/io.h"
#include "simplify/zones.h"

namespace scarp {
namespace {

/// Every readable format of the table that can hold an open mesh.
std::vector<MeshFormat> open_formats() {
  std::vector<MeshFormat> formats;
  for (const MeshFormatTraits* traits : mesh_formats()) {
    if (traits->is_read && !traits->holds_solids_only) formats.push_back(traits->format);
  }
  return formats;
}

/// An error with a message, or a consistent mesh.
void expect_sound(const Result<Mesh>& mesh, const char* name, std::size_t place) {
  if (!mesh) {
    EXPECT_EQ(mesh.error().kind, ErrorKind::kInput);
    EXPECT_NE(mesh.error().message.find(name), std::string::npos) << mesh.error().message;
    return;
  }
  ASSERT_FALSE(mesh->triangles.empty()) << name << " at " << place;
  for (const std::uint32_t vertex : mesh->triangles) ASSERT_LT(vertex, mesh->vertex_count());
  for (const double coordinate : mesh->positions) ASSERT_TRUE(std::isfinite(coordinate));
  const std::size_t count = mesh->vertex_count();
  ASSERT_TRUE(mesh->normals.empty() || mesh->normals.size() == 3 * count);
  ASSERT_TRUE(mesh->uvs.empty() || mesh->uvs.size() == 2 * count);
  ASSERT_TRUE(mesh->colors.empty() || mesh->colors.size() == 3 * count);
  ASSERT_EQ(mesh->channels.size(), static_cast<std::size_t>(mesh->channel_count) * count);
}

class MeshFile : public ::testing::TestWithParam<MeshFormat> {
 protected:
  const char* name() const { return name_.c_str(); }
  std::vector<std::uint8_t> good(bool normals) const {
    Mesh mesh = test::sample_mesh(normals);
    if (normals) test::add_attributes(mesh, 2);
    return *encode_mesh(mesh, GetParam());
  }

 private:
  std::string name_ = std::string("x.") + traits_of(GetParam()).name;
};

TEST_P(MeshFile, EveryCutFails) {
  const auto bytes = good(true);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    // An exact copy of the cut, so that a sanitizer detects reads beyond it.
    const std::vector<std::uint8_t> cut(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    const auto mesh = decode_mesh(cut, name());
    expect_sound(mesh, name(), size);
    // A TIN has no end mark: cut between lines, or in the last number of a line, it is another TIN.
    const auto line = std::find(cut.rbegin(), cut.rend(), '\n').base();
    const bool cuts_lines_only = line == cut.end() || std::count(line, cut.end(), ' ') == 9;
    if (GetParam() == MeshFormat::kTin && size > 0 && cuts_lines_only) continue;
    const bool only_line_end_missing =
        GetParam() != MeshFormat::kGlb && bytes.back() == '\n' && size + 1 == bytes.size();
    EXPECT_EQ(mesh.has_value(), only_line_end_missing) << name() << " cut to " << size << " bytes";
  }
}

TEST_P(MeshFile, NoMutationCrashes) {
  std::mt19937 random(20260721);  // the standard fixes its sequence
  const auto bytes = good(true);
  for (int round = 0; round < 6000; ++round) {
    auto changed = bytes;
    const unsigned faults = 1 + random() % 4;
    for (unsigned f = 0; f < faults; ++f) {
      const std::size_t at = random() % changed.size();
      switch (random() % 4) {
        case 0:
          changed[at] = static_cast<std::uint8_t>(random());
          break;
        case 1:
          changed[at] = static_cast<std::uint8_t>(changed[at] ^ (1u << random() % 8));
          break;
        case 2:
          changed.erase(changed.begin() + static_cast<std::ptrdiff_t>(at));
          break;
        default:
          changed.insert(changed.begin() + static_cast<std::ptrdiff_t>(at), changed[random() % changed.size()]);
      }
    }
    expect_sound(decode_mesh(changed, name()), name(), static_cast<std::size_t>(round));
  }
}

TEST_P(MeshFile, IsDeterministic) { EXPECT_EQ(good(true), good(true)); }

TEST_P(MeshFile, IsRecognisedWithoutItsName) {
  const auto mesh = decode_mesh(good(false), "nameless");
  ASSERT_TRUE(mesh) << mesh.error().message;
  EXPECT_EQ(mesh->triangle_count(), 24u);
}

TEST_P(MeshFile, BrokenMeshesAreRefused) {
  const MeshFormat format = GetParam();
  const auto refused = [&](const Mesh& mesh) {
    const auto bytes = encode_mesh(mesh, format);
    return !bytes && bytes.error().kind == ErrorKind::kOutput && !bytes.error().message.empty();
  };
  EXPECT_TRUE(refused(Mesh{}));
  Mesh mesh = test::sample_mesh(true);
  mesh.triangles[5] = 20;
  EXPECT_TRUE(refused(mesh));
  mesh = test::sample_mesh(true);
  mesh.positions[7] = NAN;
  EXPECT_TRUE(refused(mesh));
  mesh = test::sample_mesh(true);
  mesh.normals.pop_back();
  EXPECT_TRUE(refused(mesh));
  test::add_attributes(mesh = test::sample_mesh(), 2);
  EXPECT_FALSE(refused(mesh));
  for (const auto& spoil : std::initializer_list<void (*)(Mesh&)>{
           [](Mesh& m) { m.uvs.pop_back(); }, [](Mesh& m) { m.colors.pop_back(); },
           [](Mesh& m) { m.channels.pop_back(); }, [](Mesh& m) { m.channel_count = 3; },
           [](Mesh& m) { m.channel_count = -2; }, [](Mesh& m) { m.uvs[3] = NAN; }}) {
    Mesh spoilt = mesh;
    spoil(spoilt);
    EXPECT_TRUE(refused(spoilt));
  }
}

INSTANTIATE_TEST_SUITE_P(All, MeshFile, ::testing::ValuesIn(open_formats()),
                         [](const auto& format) { return std::string(traits_of(format.param).name); });

TEST(MeshFiles, TurnedYUpAreReadAsTheyWere) {
  Mesh mesh = test::sample_mesh(true);
  mesh.positions[1] = 0;
  Mesh turned = mesh;
  turn_y_up(turned);
  EXPECT_TRUE(is_y_up(turned));
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const auto p = mesh.vertex(v), q = turned.vertex(v);
    EXPECT_EQ(q, (std::array{p[0], p[2], -p[1]}));
  }
  EXPECT_FALSE(std::signbit(turned.positions[2]));
  for (const MeshFormat format : {MeshFormat::kObj, MeshFormat::kPly, MeshFormat::kStl}) {
    const auto written = encode_mesh(turned, format);
    ASSERT_TRUE(written);
    EXPECT_NE(*written, *encode_mesh(mesh, format));
    MeshFileAxes axes, plain_axes;
    const auto back = decode_mesh(*written, "x", &axes),
               plain = decode_mesh(*encode_mesh(mesh, format), "x", &plain_axes);
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(axes.up, 'y');
    EXPECT_EQ(plain_axes.up, 'z');
    EXPECT_EQ(axes.has_offsets, format == MeshFormat::kStl);
    EXPECT_FALSE(is_y_up(*back));
    EXPECT_EQ(back->metadata.at("up"), "z");
    EXPECT_TRUE(test::same_geometry(*plain, *back));
    EXPECT_EQ(plain->metadata.count("up"), 0u);
  }
  for (const MeshFormat format : {MeshFormat::kGlb, MeshFormat::k2dm, MeshFormat::kVtu}) {
    EXPECT_FALSE(encode_mesh(turned, format));
    mesh.metadata["up"] = "z";
    EXPECT_TRUE(encode_mesh(mesh, format));
  }
  Mesh placed = mesh;  // a full STL header
  placed.origin = {512345.123456789, -4023456.987654321, 1234.56789012345};
  turn_y_up(placed);
  EXPECT_EQ(decode_mesh(*encode_mesh(placed, MeshFormat::kStl), "x.stl")->origin,
            (std::array{512345.123456789, -4023456.987654321, 1234.56789012345}));
}

TEST_P(MeshFile, KeepsEveryVertexInItsPrecision) {
  const Mesh mesh = test::sample_mesh();
  const auto back = decode_mesh(good(false), name());
  ASSERT_TRUE(back) << back.error().message;
  ASSERT_EQ(back->triangles.size(), mesh.triangles.size());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto written = mesh.vertex(mesh.triangles[i]), read = back->vertex(back->triangles[i]);
    for (std::size_t k = 0; k < 3; ++k) {
      const double most = traits_of(GetParam()).is_float32 ? 1e-6 * std::fabs(written[k] - mesh.origin[k]) : 0;
      EXPECT_LE(std::fabs(read[k] - written[k]), most) << name();
    }
  }
}

TEST_P(MeshFile, ZonesAreForFormatsThatHoldThem) {
  const Mesh mesh = test::sample_mesh();
  MeshZones zones;
  zones.materials.assign(mesh.triangle_count(), 7);
  zones.node_strings.push_back({"inflow", {mesh.triangles[0], mesh.triangles[1]}});
  EXPECT_EQ(encode_mesh(mesh, GetParam(), {.zones = &zones}).has_value(), traits_of(GetParam()).holds_zones);
  zones.node_strings[0].nodes[1] = static_cast<std::uint32_t>(mesh.vertex_count());
  EXPECT_FALSE(encode_mesh(mesh, GetParam(), {.zones = &zones}));
  zones = {{1, 2}, {}};
  EXPECT_FALSE(encode_mesh(mesh, GetParam(), {.zones = &zones}));
}

TEST(MeshFormats, HaveNamesAndEndingsOfTheirOwn) {
  for (const MeshFormatTraits* traits : mesh_formats()) {
    EXPECT_EQ(find_mesh_format(traits->name), traits->format);
    std::istringstream endings(traits->endings);
    for (std::string ending; endings >> ending;) EXPECT_EQ(find_mesh_format("x." + ending), traits->format) << ending;
  }
}

TEST(MeshFormats, AreFoundByNameAndExtension) {
  EXPECT_EQ(find_mesh_format("GLB"), MeshFormat::kGlb);
  EXPECT_EQ(find_mesh_format("/a.b/hills.Obj"), MeshFormat::kObj);
  EXPECT_EQ(find_mesh_format("hills.tar.ply"), MeshFormat::kPly);
  EXPECT_EQ(find_mesh_format("stl"), MeshFormat::kStl);
  EXPECT_EQ(find_mesh_format("crater.TIN"), MeshFormat::kTin);
  EXPECT_EQ(find_mesh_format("river.2dm"), MeshFormat::k2dm);
  EXPECT_EQ(find_mesh_format("river.vtu"), MeshFormat::kVtu);
  EXPECT_EQ(find_mesh_format("river.VTP"), MeshFormat::kVtp);
  EXPECT_EQ(find_mesh_format("site.xml"), MeshFormat::kLandXml);
  EXPECT_EQ(find_mesh_format("site.landxml"), MeshFormat::kLandXml);
  EXPECT_EQ(find_mesh_format("site.dxf"), MeshFormat::kDxf);
  EXPECT_EQ(find_mesh_format("site.gpkg"), MeshFormat::kGpkg);
  EXPECT_FALSE(find_mesh_format("hills"));
  EXPECT_FALSE(find_mesh_format("/x.glb/hills"));
  EXPECT_FALSE(find_mesh_format("/folder/glb"));
  EXPECT_FALSE(find_mesh_format(""));
}

TEST(MeshFormats, OtherFilesAreRefused) {
  for (const char* text : {"", "\x89PNG\r\n", "hello\n", "II*", "<svg/>", "<LandXML", "SQLite format 3"}) {
    const auto mesh = decode_mesh(test::to_bytes(text), "x.tif");
    ASSERT_FALSE(mesh);
    EXPECT_EQ(mesh.error().kind, ErrorKind::kInput);
  }
}

}  // namespace
}  // namespace scarp
