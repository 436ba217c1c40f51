// Opening rasters.
#pragma once

#include <gdal.h>

#include <memory>
#include <string>

#include "io/gdal/session.h"
#include "scarp/result.h"

namespace scarp::gdal {

struct CloseDataset {
  void operator()(void* dataset) const { GDALClose(dataset); }
};
using Dataset = std::unique_ptr<void, CloseDataset>;

/// Options for GDALOpenEx(): without them GML's driver would write a file next to its input.
inline constexpr const char* kOpenOptions[] = {"@WRITE_GFS=NO", nullptr};

/// True for URLs and /vsi… names of files on other machines.
bool is_remote(const std::string& path);

/// The name of `path` in GDAL's virtual file systems: http://…, https:// and ftp:// become /vsicurl/…; s3://, gs:// and
/// az:// have their own file systems. Other paths are unchanged.
std::string vsi_path(const std::string& path);

/// Opens `path` for reading: a file, a URL, a /vsi… name, a zip with one raster, a driver's own syntax
/// ("NETCDF:file.nc:z"). Fails with kInput and one sentence for a missing file, a directory, vector data, several
/// rasters, and other files.
Result<Dataset> open_raster(Session& session, const std::string& path);

/// Opens the virtual raster described by `xml`. `path` is for error messages.
Result<Dataset> open_xml(Session& session, const std::string& xml, const std::string& path);

/// Copies metadata from `from` to a virtual raster `to`: the CRS with its vertical datum, the area-or-point flag, and
/// each band's unit, scale, offset, description, colour meaning and palette. Nodata and position are not copied.
/// REQUIRES: `from` has at least as many bands.
void repeat_said(GDALDatasetH from, GDALDatasetH to);
/// The error if a file on another machine cannot be opened: the server's answer, or else `reason`.
tl::unexpected<Error> refuse_remote(const std::string& path, const std::string& vsi, const std::string& reason);

/// Up to `bytes` bytes from the start of a file.
std::string read_head(const std::string& vsi, std::size_t bytes = 4096);

/// Reopens a virtual raster from its XML, so that neither its file nor its source rasters need to stay open. `path` is
/// for error messages.
Result<Dataset> open_virtual(Session& session, GDALDatasetH made, const std::string& path);

/// The driver that recognises a raster or vector file (GDAL_OF_RASTER, GDAL_OF_VECTOR) by its first bytes. Null without
/// such a driver, and for XML that declares entities.
GDALDriverH identify_driver(const std::string& vsi, unsigned kind);

/// True for XML that declares entities before its root element. Vector drivers would expand entities, so they never
/// receive such files.
bool declares_entities(const std::string& vsi);

}  // namespace scarp::gdal
