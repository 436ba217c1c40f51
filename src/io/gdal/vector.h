// Opening vector files.
#pragma once

#include <ogr_api.h>

#include <memory>
#include <string>
#include <type_traits>

#include "io/gdal/open.h"

namespace scarp::gdal {

struct DestroyFeature {
  void operator()(OGRFeatureH feature) const { OGR_F_Destroy(feature); }
};
using Feature = std::unique_ptr<std::remove_pointer_t<OGRFeatureH>, DestroyFeature>;

/// Opens `path` for reading: a file, a URL, a /vsi… name. Fails with kInput in one sentence. `what` is looked for
/// there ("points"), `expected` is what a file may be at all ("vector data that GDAL can read").
Result<Dataset> open_vector(Session& session, const std::string& path, const char* what, const char* expected);

/// The attribute `name` of a layer. kInput if there is none; tells which there are.
Result<int> find_field(OGRLayerH layer, const std::string& path, const std::string& name);

}  // namespace scarp::gdal
