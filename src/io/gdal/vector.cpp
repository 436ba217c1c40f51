#include "io/gdal/vector.h"

#include <cpl_vsi.h>
#include <fmt/format.h>

namespace scarp::gdal {

Result<Dataset> open_vector(Session& session, const std::string& path, const char* what, const char* expected) {
  const std::string vsi = vsi_path(path);
  session.clear();
  Dataset dataset(
      GDALOpenEx(vsi.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR, nullptr, nullptr, nullptr));
  if (dataset) return dataset;
  if (path.empty()) return fail(ErrorKind::kInput, fmt::format("the name of the {} is empty", what));
  if (is_remote(path)) return fail(ErrorKind::kInput, fmt::format("{}: cannot be read: {}", path, session.reason()));
  VSIStatBufL status{};
  if (VSIStatL(vsi.c_str(), &status) != 0) return fail(ErrorKind::kInput, path + ": no such file");
  if (status.st_size == 0 && VSI_ISREG(status.st_mode)) return fail(ErrorKind::kInput, path + ": the file is empty");
  if (GDALDriverH driver = GDALIdentifyDriverEx(vsi.c_str(), GDAL_OF_VECTOR, nullptr, nullptr); driver)
    return fail(ErrorKind::kInput, fmt::format("{}: a damaged or truncated {} file: {}", path,
                                               GDALGetDriverShortName(driver), session.reason()));
  return fail(ErrorKind::kInput, fmt::format("{}: {}", path, expected));
}

Result<int> find_field(OGRLayerH layer, const std::string& path, const std::string& name) {
  OGRFeatureDefnH definition = OGR_L_GetLayerDefn(layer);
  const int index = OGR_FD_GetFieldIndex(definition, name.c_str());
  if (index >= 0) return index;
  std::string names;
  for (int i = 0; i < OGR_FD_GetFieldCount(definition); ++i)
    names += (i == 0 ? "" : ", ") + std::string(OGR_Fld_GetNameRef(OGR_FD_GetFieldDefn(definition, i)));
  return fail(ErrorKind::kInput, fmt::format("{}: the layer {} has no attribute '{}'{}", path, OGR_L_GetName(layer),
                                             name, names.empty() ? "" : ", only " + names));
}

}  // namespace scarp::gdal
