#include "io/gdal/vector.h"

#include <cpl_vsi.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string_view>

#include "io/commands.h"
#include "io/kinds.h"
#include "io/missing_file.h"
#include "io/spool.h"

namespace scarp::gdal {

namespace {

/// DXF is UTF-8 from AutoCAD 2007 on, whatever code page it declares. GDAL 3.6 uses the code page.
bool is_dxf_of_utf8(std::string_view head) {
  const std::size_t key = head.find("$ACADVER"), version = key == head.npos ? key : head.find("AC", key + 8);
  return version != head.npos && version + 6 <= head.size() && head.substr(version, 6) >= "AC1021";
}

bool is_drawing(GDALDatasetH dataset) {
  return EQUAL(GDALGetDriverShortName(GDALGetDatasetDriver(dataset)), "DXF") &&
         GDALDatasetGetLayerByName(dataset, "entities") != nullptr;
}

}  // namespace

Result<Dataset> open_vector(Session& session, const std::string& path, const char* what, const char* expected) {
  SCARP_TRY(const auto& name, io::readable_name(path));
  const std::string vsi = vsi_path(name);
  session.clear();
  session.set_option("DXF_INLINE_BLOCKS", "FALSE");  // a symbol is the point at which it was inserted
  if (is_dxf_of_utf8(read_head(vsi))) session.set_option("DXF_ENCODING", "UTF-8");
  if (declares_entities(vsi)) {
    return fail(ErrorKind::kInput,
                fmt::format("{}: XML that declares entities is not read, since they may grow without end: write the "
                            "file anew without them (xmllint --noent --dropdtd {} --output {})",
                            path, io::file_word(path), io::new_file(std::filesystem::path(path).extension().string())));
  }
  Dataset dataset(GDALOpenEx(vsi.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR, nullptr,
                             kOpenOptions, nullptr));
  if (dataset && is_drawing(dataset.get())) session.set_option("OGR_GEOMETRY_ACCEPT_UNCLOSED_RING", "YES");
  if (dataset) return dataset;
  if (path.empty()) return fail(ErrorKind::kInput, fmt::format("the name of the {} is empty", what));
  if (is_remote(path)) return refuse_remote(path, vsi, session.reason());
  VSIStatBufL status{};
  if (VSIStatL(vsi.c_str(), &status) != 0) return fail(ErrorKind::kInput, path + ": " + io::describe_missing(path));
  if (status.st_size == 0 && VSI_ISREG(status.st_mode)) return fail(ErrorKind::kInput, path + ": the file is empty");
  const std::string kind = io::describe_kind(path, read_head(vsi), static_cast<std::uint64_t>(status.st_size));
  for (const std::string& what : {kind, io::describe_marked_text(path, read_head(vsi))}) {
    if (!what.empty()) return fail(ErrorKind::kInput, fmt::format("{}: {}", path, what));
  }
  if (GDALDriverH driver = identify_driver(vsi, GDAL_OF_VECTOR); driver)
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

namespace {

/// Selects entities of the model (not of the paper) other than texts.
constexpr const char* kDrawn = "Text IS NULL AND PaperSpace IS NULL";

std::vector<VectorLayer> list_drawn_layers(OGRLayerH entities) {
  OGR_L_SetAttributeFilter(entities, kDrawn);
  OGR_L_ResetReading(entities);
  const int index = OGR_FD_GetFieldIndex(OGR_L_GetLayerDefn(entities), "Layer");
  std::set<std::string> names;
  while (const Feature feature{OGR_L_GetNextFeature(entities)}) {
    if (OGR_F_GetGeometryRef(feature.get()) != nullptr) names.insert(OGR_F_GetFieldAsString(feature.get(), index));
  }
  std::vector<VectorLayer> layers;
  for (const std::string& name : names) {
    std::string quoted;
    for (const char c : name) quoted += c == '\'' ? std::string(2, c) : std::string(1, c);
    layers.push_back({entities, name, fmt::format("Layer = '{}' AND {}", quoted, kDrawn)});
  }
  return layers;
}

}  // namespace

OGRLayerH VectorLayer::open() const {
  if (!filter.empty()) OGR_L_SetAttributeFilter(of, filter.c_str());
  return of;
}

std::vector<VectorLayer> list_layers(GDALDatasetH dataset) {
  if (is_drawing(dataset)) return list_drawn_layers(GDALDatasetGetLayerByName(dataset, "entities"));
  std::vector<VectorLayer> layers;
  for (int i = 0; i < GDALDatasetGetLayerCount(dataset); ++i) {
    OGRLayerH layer = GDALDatasetGetLayer(dataset, i);
    layers.push_back({layer, OGR_L_GetName(layer), {}});
  }
  return layers;
}

std::string layer_names(const std::vector<VectorLayer>& layers) {
  std::string names;
  for (const VectorLayer& layer : layers) names += (names.empty() ? "" : ", ") + layer.name;
  return names;
}

Crs declared_layer_crs(OGRLayerH layer) {
  const OGRSpatialReferenceH borrowed = OGR_L_GetSpatialRef(layer);
  return borrowed == nullptr ? nullptr : Crs(OSRClone(borrowed));
}

Crs layer_crs(OGRLayerH layer) {
  Crs crs = copy_crs(OGR_L_GetSpatialRef(layer));
  if (crs && std::string_view(OSRGetName(crs.get())).starts_with("Undefined ")) return nullptr;
  return crs;
}

Result<void> each_feature(Session& session, OGRLayerH layer, const std::string& path, const ProgressCallback& progress,
                          const std::function<Result<void>(OGRFeatureH)>& add) {
  const auto count = static_cast<double>(std::max<GIntBig>(1, OGR_L_GetFeatureCount(layer, 0)));
  std::uint64_t features = 0;
  OGR_L_ResetReading(layer);
  session.clear();
  while (const Feature feature{OGR_L_GetNextFeature(layer)}) {
    SCARP_RETURN_IF_ERROR(add(feature.get()));
    if (++features % 65536 != 0 || !progress) continue;
    if (!progress({"read", std::min(1.0, static_cast<double>(features) / count), 0, 0}))
      return fail(ErrorKind::kCancelled, "cancelled while reading");
  }
  if (!session.failed()) return {};
  return fail(ErrorKind::kInput, fmt::format("{}: the layer {} cannot be read to its end: {}", path,
                                             OGR_L_GetName(layer), session.reason()));
}

}  // namespace scarp::gdal
