// The kind of OUTPUT: a mesh file, a drawing of the mesh's edges, or a raster of the approximation on the grid.
#pragma once

#include <cstdint>
#include <string>

#include "scarp/io.h"
#include "scarp/mesh.h"
#include "session/options/values.h"

namespace scarp::cli {

enum class OutputKind { kMesh, kSvg, kEps, kDem };

struct OutputFormat {
  OutputKind kind = OutputKind::kMesh;
  MeshFormat mesh = MeshFormat::kGlb;            ///< format of a kMesh
  RasterFormat raster = RasterFormat::kGeoTiff;  ///< format of a kDem

  /// "glb", "svg", "dem", …
  const char* name() const;
  /// "GLB", "SVG", …: for messages.
  std::string title() const;
  /// Approximate bytes that encode_as() needs for a vertex and its two triangles, including the bytes in the file.
  std::uint64_t bytes_per_vertex() const;
  bool is_mesh() const { return kind == OutputKind::kMesh; }
  bool is_glb() const { return is_mesh() && mesh == MeshFormat::kGlb; }
  bool is_ply() const { return is_mesh() && mesh == MeshFormat::kPly; }
  /// True if positions are rounded to float32.
  bool is_float32() const { return is_mesh() && traits_of(mesh).is_float32; }
  bool has_lengths_only() const { return is_mesh() && traits_of(mesh).has_lengths_only; }
  bool holds_zones() const { return is_mesh() && traits_of(mesh).holds_zones; }
  bool holds_solids_only() const { return is_mesh() && traits_of(mesh).holds_solids_only; }
  /// True if the format is used for printing: readers assume millimetres.
  bool holds_prints() const { return is_mesh() && traits_of(mesh).holds_prints; }
  /// True if the format can hold normals, uvs and colours.
  bool holds_attributes() const { return is_mesh() && traits_of(mesh).holds_attributes; }
  /// True if the content is valid even if z is not the height.
  bool holds_space() const;
  /// True if a .prj file holds the CRS because the format has no place for it that all readers support.
  bool has_projection_beside() const { return is_mesh() && traits_of(mesh).has_projection_file; }
  /// The frame of x and y without a requested CRS.
  DefaultFrame default_frame() const;
  /// The unit of its heights.
  HeightsIn heights_in() const;
};

/// Parses --up: true for y.
Result<bool> parse_up(const Given& up);

/// True if the mesh must be turned y up before writing, by --up or because readers of the format expect it. False for
/// GLB, whose writer turns it. kUsage if the format supports only the other axis.
Result<bool> choose_y_up(const Given& up, const OutputFormat& format, bool is_print);

/// Uses --of if given, else the output's extension.
Result<OutputFormat> choose_output_format(const Given& of, const std::string& output);

/// The unit of heights in a mesh file, by its name.
HeightsIn heights_in(const std::string& mesh_path);
/// The default frame of a mesh file, by its name.
DefaultFrame default_frame(const std::string& mesh_path);

}  // namespace scarp::cli
