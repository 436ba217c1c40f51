// Opening vector files.
#pragma once

#include <ogr_api.h>

#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

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
/// ("points"); `expected` describes all supported files ("vector data that GDAL can read").
Result<Dataset> open_vector(Session& session, const std::string& path, const char* what, const char* expected);

/// The index of the attribute `name` of a layer. kInput if it does not exist, with a list of those that do.
Result<int> find_field(OGRLayerH layer, const std::string& path, const std::string& name);

/// A layer as its user sees it. GDAL keeps all layers of a drawing (DXF) in one, of which open() shows a part.
struct VectorLayer {
  OGRLayerH of = nullptr;
  std::string name, filter;  ///< filter: empty unless of a drawing

  OGRLayerH open() const;
};
/// All layers; of a drawing those with other entities than texts, by name. Cost: a drawing is read once.
std::vector<VectorLayer> list_layers(GDALDatasetH dataset);
/// Their names, separated by commas.
std::string layer_names(const std::vector<VectorLayer>& layers);

/// The layer's declared CRS, with a vertical datum; null if none.
Crs declared_layer_crs(OGRLayerH layer);
/// The CRS of a layer; null if the file declares it undefined (GeoPackage's srs_id 0 and -1).
Crs layer_crs(OGRLayerH layer);

/// Calls add(feature) for the features of a layer, until it fails. Fails with kCancelled if `progress` requests it, and
/// with kInput if the layer cannot be read completely.
Result<void> each_feature(Session& session, OGRLayerH layer, const std::string& path, const ProgressCallback& progress,
                          const std::function<Result<void>(OGRFeatureH)>& add);

}  // namespace scarp::gdal
