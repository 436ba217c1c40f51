#include "io/gdal/open.h"

#include <cpl_string.h>
#include <cpl_vsi.h>
#include <cpl_vsi_error.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>
#include <utility>
#include <vector>

#include "io/commands.h"
#include "io/gdal/cf_axes.h"
#include "io/gdal/crs.h"
#include "io/gdal/text_grid.h"
#include "io/kinds.h"
#include "io/missing_file.h"
#include "io/points/point_source.h"
#include "io/spool.h"

namespace scarp::gdal {
namespace {

struct Scheme {
  std::string_view url, vsi;
  bool keeps_url;  // /vsicurl/ expects the whole URL, the object stores only the part after "s3://"
};
constexpr std::array<Scheme, 6> kSchemes{{{"http://", "/vsicurl/", true},
                                          {"https://", "/vsicurl/", true},
                                          {"ftp://", "/vsicurl/", true},
                                          {"s3://", "/vsis3/", false},
                                          {"gs://", "/vsigs/", false},
                                          {"az://", "/vsiaz/", false}}};

bool ends_with(const std::string& path, std::string_view end) {
  return path.size() > end.size() && EQUAL(path.c_str() + path.size() - end.size(), end.data());
}

std::vector<std::string> list_of(CSLConstList strings) {
  std::vector<std::string> list;
  for (; strings != nullptr && *strings != nullptr; ++strings) list.emplace_back(*strings);
  return list;
}

Dataset open_quietly(const std::string& name, unsigned kind) {
  return Dataset(GDALOpenEx(name.c_str(), kind | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR, nullptr, nullptr, nullptr));
}

/// The files in a zip, as names for GDAL; empty if it cannot be read.
std::vector<std::string> list_zip(const std::string& vsi) {
  const std::string root = "/vsizip/{" + vsi + "}/";
  char** entries = VSIReadDirRecursive(root.c_str());
  std::vector<std::string> names;
  for (const std::string& entry : list_of(entries)) {
    if (!entry.empty() && entry.back() != '/') names.push_back(root + entry);
  }
  CSLDestroy(entries);
  return names;
}

/// The names of the subdatasets in a container (netCDF, HDF, GeoPackage, …).
std::vector<std::string> find_subdatasets(GDALDatasetH dataset) {
  std::vector<std::string> names;
  for (const std::string& entry : list_of(GDALGetMetadata(dataset, "SUBDATASETS"))) {
    const auto equals = entry.find("_NAME=");
    if (equals != std::string::npos) names.push_back(entry.substr(equals + 6));
  }
  return names;
}

std::string join(const std::vector<std::string>& names, std::size_t most) {
  std::string text;
  for (std::size_t k = 0; k < names.size() && k < most; ++k) text += (k == 0 ? "" : ", ") + io::file_word(names[k]);
  if (names.size() > most) text += ", …";
  return text;
}

Result<Dataset> open_in_zip(Session& session, const std::string& path, const std::string& vsi) {
  const auto files = list_zip(vsi);
  if (files.empty()) return fail(ErrorKind::kInput, path + ": the zip is damaged, truncated or empty");
  std::vector<std::string> rasters;
  for (const std::string& name : files) {
    if (identify_driver(name, GDAL_OF_RASTER) != nullptr) rasters.push_back(name);
  }
  session.clear();
  if (rasters.empty()) return fail(ErrorKind::kInput, path + ": the zip holds no raster that GDAL can read");
  if (rasters.size() > 1) {
    return fail(ErrorKind::kInput, fmt::format("{}: the zip holds {} rasters; name one of them: {}", path,
                                               rasters.size(), join(rasters, 4)));
  }
  Dataset dataset = open_quietly(rasters.front(), GDAL_OF_RASTER);
  if (!dataset) {
    return fail(ErrorKind::kInput,
                fmt::format("{}: {} in the zip cannot be read: {}", path, rasters.front(), session.reason()));
  }
  return dataset;
}

/// An HDF4 file, or one of its rasters by name.
bool is_hdf4(const std::string& vsi) {
  return vsi.starts_with("HDF4_SDS:") || vsi.starts_with("HDF4_EOS:") || read_head(vsi, 4) == "\x0e\x03\x13\x01";
}

/// Before 3.10.1 GDAL silently swaps the two bytes of each sample in an interlaced 16-bit PNG.
bool is_misread_png(GDALDatasetH dataset) {
  constexpr int kMended = 3100100;
  constexpr std::size_t kDepth = 24, kInterlace = 28;
  if (std::atoi(GDALVersionInfo("VERSION_NUM")) >= kMended) return false;
  if (!EQUAL(GDALGetDriverShortName(GDALGetDatasetDriver(dataset)), "PNG")) return false;
  const std::string head = read_head(GDALGetDescription(dataset), kInterlace + 1);
  return head.size() > kInterlace && head[kDepth] == 16 && head[kInterlace] == 1;
}

/// The error for a name that no raster driver opens.
tl::unexpected<Error> explain(Session& session, const std::string& given, const std::string& vsi) {
  const std::string path = given == "-" ? "standard input" : given;
  if (path.empty()) return fail(ErrorKind::kInput, "the name of the raster is empty");
  const std::string reason = session.reason();
  const bool gave_reason = session.failed();
  if (is_hdf4(vsi)) {
    return fail(ErrorKind::kInput,
                fmt::format("{0}: HDF4 is not read, since its library crashes on damaged files: convert it first "
                            "(gdal_translate {1} {2}; where it holds several rasters gdal_translate -sds {1} {2})",
                            path, io::file_word(path), io::new_file(".tif")));
  }
  VSIStatBufL status{};
  const bool exists = VSIStatL(vsi.c_str(), &status) == 0;
  if (is_remote(path)) return refuse_remote(path, vsi, reason);
  if (!exists) return fail(ErrorKind::kInput, path + ": " + io::describe_missing(path));
  if (VSI_ISDIR(status.st_mode)) return fail(ErrorKind::kInput, path + ": a directory, not a raster");
  if (status.st_size == 0 && VSI_ISREG(status.st_mode)) return fail(ErrorKind::kInput, path + ": the file is empty");
  VSILFILE* file = VSIFOpenL(vsi.c_str(), "rb");
  if (file == nullptr) return fail(ErrorKind::kInput, path + ": the file cannot be opened for reading (permissions?)");
  VSIFCloseL(file);
  const std::string kind = io::describe_kind(path, read_head(vsi), status.st_size);
  for (const std::string& what : {kind, io::describe_marked_text(path, read_head(vsi))}) {
    if (!what.empty()) return fail(ErrorKind::kInput, fmt::format("{}: {}", path, what));
  }
  // A driver that recognises the file but fails (a truncated TIFF) has a better message.
  if (GDALDriverH driver = identify_driver(vsi, GDAL_OF_RASTER); driver && gave_reason) {
    if (EQUAL(GDALGetDriverShortName(driver), "XYZ")) {
      return fail(ErrorKind::kInput,
                  fmt::format("{}: holds points that lie on no grid ({}), and a raster is asked for: make one of them "
                              "first ({})",
                              path, reason, io::rasterize_command(path)));
    }
    return fail(ErrorKind::kInput,
                fmt::format("{}: a damaged or truncated {} raster: {}", path, GDALGetDriverShortName(driver), reason));
  }
  if (GDALDriverH driver = identify_driver(vsi, GDAL_OF_VECTOR); driver != nullptr) {
    return fail(ErrorKind::kInput,
                fmt::format("{}: holds vector data ({}), not a raster", path, GDALGetDriverShortName(driver)));
  }
  if (ends_with(vsi, ".hgt")) {
    return fail(ErrorKind::kInput,
                fmt::format("{}: no .hgt tile has {} bytes, or none has such a name: the file is truncated or was "
                            "renamed (N41E001.hgt is the pattern)",
                            path, static_cast<std::uint64_t>(status.st_size)));
  }
  return fail(ErrorKind::kInput, path + ": not a raster that GDAL can read, nor PGM or STM");
}

}  // namespace

std::string read_head(const std::string& vsi, std::size_t bytes) {
  std::string head(bytes, '\0');
  VSIStatBufL status{};
  if (VSIStatL(vsi.c_str(), &status) != 0 || !VSI_ISREG(status.st_mode)) return {};
  VSILFILE* file = VSIFOpenL(vsi.c_str(), "rb");
  if (file == nullptr) return {};
  head.resize(VSIFReadL(head.data(), 1, bytes, file));
  VSIFCloseL(file);
  return head;
}

tl::unexpected<Error> refuse_remote(const std::string& path, const std::string& vsi, const std::string& reason) {
  VSIStatBufL status{};
  VSICurlPartialClearCache(vsi.c_str());  // GDAL caches the failure, but not its reason
  VSIErrorReset();
  const bool is_there = VSIStatExL(vsi.c_str(), &status, VSI_STAT_EXISTS_FLAG | VSI_STAT_SET_ERROR_FLAG) == 0;
  const std::string why = is_there ? "" : VSIGetLastErrorMsg();
  return fail(ErrorKind::kInput, fmt::format("{}: cannot be read: {}", path, why.empty() ? reason : why));
}

std::string vsi_path(const std::string& path) {
  for (const Scheme& scheme : kSchemes) {
    if (path.size() > scheme.url.size() && EQUALN(path.c_str(), scheme.url.data(), scheme.url.size())) {
      return std::string(scheme.vsi) + (scheme.keeps_url ? path : path.substr(scheme.url.size()));
    }
  }
  return path;
}

bool is_remote(const std::string& path) {
  const std::string vsi = vsi_path(path);
  for (const char* part :
       {"/vsicurl", "/vsis3", "/vsigs", "/vsiaz", "/vsiadls", "/vsioss", "/vsiswift", "/vsiwebhdfs"}) {
    if (vsi.find(part) != std::string::npos) return true;
  }
  return false;
}

void repeat_said(GDALDatasetH from, GDALDatasetH to) {
  constexpr const char *kPoint = "AREA_OR_POINT", *kSigned = "PIXELTYPE", *kStructure = "IMAGE_STRUCTURE";
  for (const char* item : {"COMPRESSION", "COMPRESSION_REVERSIBILITY"})
    GDALSetMetadataItem(to, item, GDALGetMetadataItem(from, item, kStructure), kStructure);
  GDALSetSpatialRef(to, declared_crs(from).get());
  GDALSetMetadataItem(to, kPoint, GDALGetMetadataItem(from, kPoint, nullptr), nullptr);
  for (int k = 1; k <= std::min(GDALGetRasterCount(from), GDALGetRasterCount(to)); ++k) {
    GDALRasterBandH said = GDALGetRasterBand(from, k), band = GDALGetRasterBand(to, k);
    GDALSetDescription(band, GDALGetDescription(said));
    GDALSetRasterUnitType(band, GDALGetRasterUnitType(said));
    for (const char* item : {"positive", "standard_name"})
      GDALSetMetadataItem(band, item, GDALGetMetadataItem(said, item, nullptr), nullptr);
    int is_given = 0;
    if (const double scale = GDALGetRasterScale(said, &is_given); is_given != 0) GDALSetRasterScale(band, scale);
    if (const double offset = GDALGetRasterOffset(said, &is_given); is_given != 0) GDALSetRasterOffset(band, offset);
    GDALSetRasterColorInterpretation(band, GDALGetRasterColorInterpretation(said));
    if (GDALColorTableH colours = GDALGetRasterColorTable(said)) GDALSetRasterColorTable(band, colours);
    if (GDALGetRasterDataType(band) == GDALGetRasterDataType(said))
      GDALSetMetadataItem(band, kSigned, GDALGetMetadataItem(said, kSigned, kStructure), kStructure);
  }
}

Result<Dataset> open_virtual(Session& session, GDALDatasetH made, const std::string& path) {
  CSLConstList xml = GDALGetMetadata(made, "xml:VRT");
  return open_xml(session, xml != nullptr && *xml != nullptr ? *xml : "", path);
}

Result<Dataset> open_xml(Session& session, const std::string& xml, const std::string& path) {
  session.clear();
  if (Dataset dataset = xml.empty() ? nullptr : open_quietly(xml, GDAL_OF_RASTER)) return dataset;
  return fail(ErrorKind::kInput, fmt::format("{}: cannot be read as one raster: {}", path, session.reason()));
}

GDALDriverH identify_driver(const std::string& vsi, unsigned kind) {
  if (declares_entities(vsi)) return nullptr;  // some drivers identify by opening
  return GDALIdentifyDriverEx(vsi.c_str(), kind, nullptr, nullptr);
}

Result<Dataset> open_raster(Session& session, const std::string& path) {
  SCARP_TRY(const auto& name, io::readable_name(path));
  SCARP_TRY(const auto& grid, find_text_grid(path));
  const std::string vsi = grid.empty() ? vsi_path(name) : grid;
  session.clear();
  Dataset dataset = open_quietly(vsi, GDAL_OF_RASTER);
  if (!dataset && ends_with(vsi, ".zip")) {
    VSIStatBufL status{};
    if (VSIStatL(vsi.c_str(), &status) == 0) {
      SCARP_TRY(dataset, open_in_zip(session, path, vsi));
    }
  }
  if (!dataset) return explain(session, path, vsi);
  if (GDALGetRasterCount(dataset.get()) == 0) {
    const auto parts = find_subdatasets(dataset.get());
    if (parts.empty()) return fail(ErrorKind::kInput, path + ": holds no raster band");
    return fail(ErrorKind::kInput,
                fmt::format("{}: holds {} rasters; name one of them: {}", path, parts.size(), join(parts, 4)));
  }
  SCARP_RETURN_IF_ERROR(verify_axes(dataset.get(), path));
  if (is_misread_png(dataset.get())) {
    return fail(
        ErrorKind::kInput,
        fmt::format("{}: an interlaced PNG of 16 bits, whose bytes GDAL {} takes in the wrong order (3.10.1 does "
                    "not): save it without interlacing",
                    path, GDALVersionInfo("RELEASE_NAME")));
  }
  return dataset;
}

}  // namespace scarp::gdal
