// The readers that read_points() calls.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "scarp/height_field.h"
#include "scarp/io.h"

namespace scarp::io {

/// True if the bytes may be text in columns that begins with numbers.
bool looks_like_columns(std::span<const std::uint8_t> head);

/// True for a plain text file that may hold columns of numbers, judged by its extension, else by its first line.
bool is_text_of_columns(const std::string& path);

/// True if the file begins with text that is neither JSON nor XML.
bool holds_plain_text(const std::string& path);

/// True for an ESRI or a Surfer ASCII grid.
bool begins_as_grid(const std::string& path);

/// Reads text in columns; see read_points(). `crs`: that of x and y; empty: unknown.
Result<PointSet> decode_columns(std::span<const std::uint8_t> bytes, const std::string& name,
                                const ReadPointsOptions& options, const std::string& crs = "");

/// Reads LandXML; see read_points(). `crs`: that of x and y if the file names none; empty: unknown.
Result<PointSet> read_landxml_points(std::span<const std::uint8_t> bytes, const std::string& path,
                                     const ReadPointsOptions& options, const std::string& crs);

/// The file that declares the CRS of `path` as WKT or a code such as EPSG:32633: survey.prj for survey.csv.
std::string projection_path(const std::string& path);
/// The CRS declared by that file; empty without the file.
Result<std::string> read_declared_crs(const std::string& path);
/// The command that creates the file.
std::string declare_crs_command(const std::string& path, const std::string& crs);

/// Reads a LAS or LAZ file; see read_points().
Result<PointSet> read_las_points(const std::string& path, const ReadPointsOptions& options);

/// spool_points() for LAS and LAZ files.
Result<SpooledPoints> spool_las_points(std::span<const std::string> paths, const ReadPointsOptions& options,
                                       DuplicatePolicy duplicates, std::uint64_t most_in_block);

/// read_points() for all formats without a reader here; may throw std::bad_alloc. In a build without GDAL it fails with
/// kInput and the reason.
Result<PointSet> read_gdal_points(const std::string& path, const ReadPointsOptions& options);

/// True if the path is a raster: GDAL's raster drivers open it, or its points are a raster's nodes. False in a build
/// without GDAL.
bool opens_as_raster(const std::string& path);

/// True if the path is text in columns whose points are a raster's nodes. False in a build without GDAL.
bool is_text_grid(const std::string& path);

}  // namespace scarp::io
