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

/// Opens `path` for reading: a file, a URL, a /vsi… name. Fails with kInput and one sentence, in which `what` is the
/// wanted data ("points") and `expected` describes all supported files ("vector data that GDAL can read").
Result<Dataset> open_vector(Session& session, const std::string& path, const char* what, const char* expected);

/// The index of the attribute `name` of a layer. If absent, fails with kInput and a list of existing attributes.
Result<int> find_field(OGRLayerH layer, const std::string& path, const std::string& name);

/// A layer as its user sees it. GDAL has one layer for all layers of a drawing (DXF), which open() filters.
struct VectorLayer {
  OGRLayerH of = nullptr;
  std::string name, filter;  ///< filter: empty unless in a drawing

  OGRLayerH open() const;
};
/// All layers; in a drawing, those with entities other than texts, sorted by name. Cost: reads a drawing once.
std::vector<VectorLayer> list_layers(GDALDatasetH dataset);
/// Their names, separated by commas.
std::string layer_names(const std::vector<VectorLayer>& layers);

/// The layer's declared CRS, with a vertical datum; null if none.
Crs declared_layer_crs(OGRLayerH layer);
/// The CRS of a layer; null if the file declares it undefined (GeoPackage's srs_id 0 and -1).
Crs layer_crs(OGRLayerH layer);

/// Calls add(feature) for the features of a layer until add() fails. Fails as add() does, with kCancelled if `progress`
/// requests it, and with kInput if the layer cannot be read completely.
Result<void> each_feature(Session& session, OGRLayerH layer, const std::string& path, const ProgressCallback& progress,
                          const std::function<Result<void>(OGRFeatureH)>& add);

}  // namespace scarp::gdal
