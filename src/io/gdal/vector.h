// Opening vector files.
#pragma once

#include <ogr_api.h>

#include <functional>
#include <memory>
#include <string>
#include <type_traits>

#include "io/gdal/crs.h"
#include "io/gdal/open.h"
#include "scarp/run.h"

namespace scarp::gdal {

struct DestroyFeature {
  void operator()(OGRFeatureH feature) const { OGR_F_Destroy(feature); }
};
using Feature = std::unique_ptr<std::remove_pointer_t<OGRFeatureH>, DestroyFeature>;

struct DestroyGeometry {
  void operator()(OGRGeometryH geometry) const { OGR_G_DestroyGeometry(geometry); }
};
using Geometry = std::unique_ptr<std::remove_pointer_t<OGRGeometryH>, DestroyGeometry>;

/// Opens `path` for reading: a file, a URL, a /vsi… name. Fails with kInput in one sentence. `what` is wanted there
/// ("points"), `expected` is what a file may be at all ("vector data that GDAL can read").
Result<Dataset> open_vector(Session& session, const std::string& path, const char* what, const char* expected);

/// The attribute `name` of a layer. kInput if there is none, with a list of those that exist.
Result<int> find_field(OGRLayerH layer, const std::string& path, const std::string& name);

/// The names of all layers, with commas.
std::string layer_names(GDALDatasetH dataset);

/// The CRS that the layer declares, with a vertical datum; null if it has none.
Crs declared_layer_crs(OGRLayerH layer);
/// The CRS of a layer; none where the file declares it undefined (GeoPackage's srs_id 0 and -1).
Crs layer_crs(OGRLayerH layer);

/// Calls add(feature) for the features of a layer, until it fails. Fails with kCancelled where `progress` asks for it,
/// and with kInput where the layer cannot be read to its end.
Result<void> each_feature(Session& session, OGRLayerH layer, const std::string& path, const ProgressCallback& progress,
                          const std::function<Result<void>(OGRFeatureH)>& add);

}  // namespace scarp::gdal
