// The readers behind read_points().
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "scarp/height_field.h"
#include "scarp/io.h"

namespace scarp {

/// True if the bytes may be text of columns that begins with numbers.
bool looks_like_columns(std::span<const std::uint8_t> head);

/// True for a file of plain text that may hold columns of numbers: by the end of its name, else by its first line.
bool is_text_of_columns(const std::string& path);

/// True if the file begins with text that is neither JSON nor XML.
bool holds_plain_text(const std::string& path);

/// An ESRI or a Surfer ASCII grid.
bool begins_as_grid(const std::string& path);

/// Text of columns; see read_points(). `crs`: that of x and y; empty: unknown.
Result<PointSet> decode_columns(std::span<const std::uint8_t> bytes, const std::string& name,
                                const ReadPointsOptions& options, const std::string& crs = "");

/// LandXML; see read_points(). `crs`: that of x and y if the file names none; empty: unknown.
Result<PointSet> read_landxml_points(std::span<const std::uint8_t> bytes, const std::string& path,
                                     const ReadPointsOptions& options, const std::string& crs);

/// The file that declares the CRS of such files: WKT, or a code such as EPSG:32633. survey.csv: survey.prj.
std::string projection_path(const std::string& path);
/// The CRS that this file declares; empty without such a file.
Result<std::string> read_declared_crs(const std::string& path);
/// The command that makes it.
std::string declare_crs_command(const std::string& path, const std::string& crs);

/// A LAS or LAZ file; see read_points().
Result<PointSet> read_las_points(const std::string& path, const ReadPointsOptions& options);

/// read_points() for everything that has no reader of our own; may throw std::bad_alloc. In a build without GDAL it
/// fails with kInput and the reason.
Result<PointSet> read_gdal_points(const std::string& path, const ReadPointsOptions& options);

/// True if the path is a raster: GDAL's drivers open it, or its points are the nodes of one. False in a build without
/// GDAL.
bool opens_as_raster(const std::string& path);

/// True if the path is text of columns whose points are the nodes of a raster. False in a build without GDAL.
bool is_text_grid(const std::string& path);

}  // namespace scarp
