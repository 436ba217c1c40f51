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

/// For GDALOpenEx(): GML's driver would write a file next to its input.
inline constexpr const char* kOpenOptions[] = {"@WRITE_GFS=NO", nullptr};

/// True for URLs and the /vsi… names of files that lie on another machine.
bool is_remote(const std::string& path);

/// The name under which GDAL's virtual file systems know `path`: http://…, https:// and ftp:// become /vsicurl/…,
/// s3://, gs:// and az:// their own file systems. Everything else is left alone.
std::string vsi_path(const std::string& path);

/// Opens `path` for reading: a file, a URL, a /vsi… name, a zip that holds one raster, a driver's own syntax
/// ("NETCDF:file.nc:z"). Fails with kInput in one sentence: no such file; a directory; vector data; several rasters;
/// not a raster.
Result<Dataset> open_raster(Session& session, const std::string& path);

/// Opens a virtual raster that `xml` describes. `path` is for the sentence.
Result<Dataset> open_xml(Session& session, const std::string& xml, const std::string& path);

/// Copies the metadata of `from`, of as many bands or more, to a virtual raster `to`, except samples, nodata and place:
/// the CRS with its vertical datum, whether a value is that of an area or a point, and for each band unit, scale and
/// offset, description, meaning and colours.
void repeat_said(GDALDatasetH from, GDALDatasetH to);
/// The error for a file on another machine that cannot be opened: the server's answer where there is one, else
/// `reason`.
tl::unexpected<Error> refuse_remote(const std::string& path, const std::string& vsi, const std::string& reason);

/// The first bytes of a file; fewer than asked for where it is shorter, or none.
std::string read_head(const std::string& vsi, std::size_t bytes = 4096);

/// Opens a virtual raster anew by its XML, which then needs neither a file nor the rasters that it was made from to be
/// open. `path` is for the sentence.
Result<Dataset> open_virtual(Session& session, GDALDatasetH made, const std::string& path);

/// The driver that knows a raster or vector file (GDAL_OF_RASTER, GDAL_OF_VECTOR) by its first bytes; null if none
/// does, and for XML that declares entities.
GDALDriverH identify_driver(const std::string& vsi, unsigned kind);

/// True for XML that declares entities before its root element: vector drivers, which expand them, are never given it.
bool declares_entities(const std::string& vsi);

}  // namespace scarp::gdal
