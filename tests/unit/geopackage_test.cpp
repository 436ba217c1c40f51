// tests/program/test_gis_formats.sh tests readers other than GDAL.
#include <gtest/gtest.h>

#include "mesh_samples.h"
#include "scarp/io.h"

namespace scarp {
namespace {

TEST(GeoPackage, EqualMeshesGiveEqualBytes) {
  const auto bytes = encode_mesh(test::sample_mesh(), MeshFormat::kGpkg);
  ASSERT_TRUE(bytes) << bytes.error().message;
  EXPECT_EQ(*encode_mesh(test::sample_mesh(), MeshFormat::kGpkg), *bytes);
}

TEST(GeoPackage, RefusesACrsThatNobodyKnows) {
  Mesh mesh = test::sample_mesh();
  mesh.metadata["crs"] = "nonsense";
  const auto bytes = encode_mesh(mesh, MeshFormat::kGpkg);
  ASSERT_FALSE(bytes);
  EXPECT_EQ(bytes.error().kind, ErrorKind::kOutput);
  EXPECT_NE(bytes.error().message.find("'nonsense' is no CRS"), std::string::npos) << bytes.error().message;
}

TEST(GeoPackage, IsWrittenAndNotRead) {
  const auto mesh = decode_mesh(*encode_mesh(test::sample_mesh(), MeshFormat::kGpkg), "x.gpkg");
  ASSERT_FALSE(mesh);
  EXPECT_EQ(mesh.error().kind, ErrorKind::kInput);
  EXPECT_NE(mesh.error().message.find("writes and does not read"), std::string::npos) << mesh.error().message;
}

}  // namespace
}  // namespace scarp
