// GeoPackage, written by GDAL in memory: a layer with one polygon per triangle, with heights.
//
// The standard's extensions have geometries for triangles and TINs. But map programs read polygons, and QGIS also draws
// polygons in three dimensions.
#include <fmt/format.h>
#include <gdal.h>
#include <ogr_api.h>

#include <memory>
#include <type_traits>

#include "io/gdal/crs.h"
#include "io/gdal/memory_file.h"
#include "io/gdal/open.h"
#include "io/gdal/session.h"
#include "io/mesh/mesh_file.h"

namespace scarp::io {
namespace {

struct DestroyFeature {
  void operator()(OGRFeatureH feature) const { OGR_F_Destroy(feature); }
};
using Feature = std::unique_ptr<std::remove_pointer_t<OGRFeatureH>, DestroyFeature>;

tl::unexpected<Error> refuse_geopackage(const std::string& why) {
  return fail(ErrorKind::kOutput, "the mesh cannot be encoded as GeoPackage: " + why);
}

bool add_triangle(OGRLayerH layer, const Mesh& mesh, std::size_t triangle) {
  const Feature feature(OGR_F_Create(OGR_L_GetLayerDefn(layer)));
  OGRGeometryH ring = OGR_G_CreateGeometry(wkbLinearRing);
  for (const std::size_t corner : {0, 1, 2, 0}) {
    const auto p = mesh.vertex(mesh.triangles[3 * triangle + corner]);
    OGR_G_AddPoint(ring, p[0], p[1], p[2]);
  }
  OGRGeometryH polygon = OGR_G_CreateGeometry(wkbPolygon25D);
  OGR_G_AddGeometryDirectly(polygon, ring);
  return OGR_F_SetGeometryDirectly(feature.get(), polygon) == OGRERR_NONE &&
         OGR_L_CreateFeature(layer, feature.get()) == OGRERR_NONE;
}

}  // namespace

Result<std::vector<std::uint8_t>> encode_gpkg(const Mesh& mesh) {
  gdal::Session session;
  session.set_option("OGR_CURRENT_DATE", "1970-01-01T00:00:00.000Z");  // equal meshes give equal bytes
  GDALDriverH driver = GDALGetDriverByName("GPKG");
  if (driver == nullptr) return refuse_geopackage("this GDAL has no GPKG driver");
  gdal::Crs crs;
  if (const auto name = mesh.metadata.find("crs"); name != mesh.metadata.end()) {
    crs = gdal::find_crs(name->second);
    if (!crs) return refuse_geopackage(fmt::format("'{}' is no CRS that GDAL knows", name->second));
  }
  session.clear();
  const gdal::MemoryFile file("gpkg");
  gdal::Dataset dataset(GDALCreate(driver, file.name(), 0, 0, 0, GDT_Unknown, nullptr));
  if (!dataset) return refuse_geopackage(session.reason());
  OGRLayerH layer = GDALDatasetCreateLayer(dataset.get(), "terrain", crs.get(), wkbPolygon25D, nullptr);
  if (layer == nullptr) return refuse_geopackage(session.reason());
  bool good = GDALDatasetStartTransaction(dataset.get(), FALSE) == OGRERR_NONE;
  for (std::size_t t = 0; t < mesh.triangle_count() && good; ++t) good = add_triangle(layer, mesh, t);
  good = good && GDALDatasetCommitTransaction(dataset.get()) == OGRERR_NONE;
  for (const auto& [key, value] : mesh.metadata) {
    good = good &&
           GDALSetMetadataItem(dataset.get(), ascii_text(key).c_str(), ascii_text(value).c_str(), nullptr) == CE_None;
  }
  dataset.reset();
  if (!good || session.failed()) return refuse_geopackage(session.reason());
  std::vector<std::uint8_t> bytes = file.bytes();
  if (bytes.empty()) return refuse_geopackage("GDAL has written nothing");
  return bytes;
}

}  // namespace scarp::io
