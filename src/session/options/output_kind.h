// The kind of OUTPUT: a mesh file, a drawing of the mesh's edges, or the approximation resampled on the grid.
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
  /// "GLB", "SVG", …: for sentences.
  std::string title() const;
  /// About the bytes that encode_as() needs for a vertex and its two triangles, the file's bytes included.
  std::uint64_t bytes_per_vertex() const;
  bool is_mesh() const { return kind == OutputKind::kMesh; }
  bool is_glb() const { return is_mesh() && mesh == MeshFormat::kGlb; }
  bool is_ply() const { return is_mesh() && mesh == MeshFormat::kPly; }
  /// Positions are rounded to float32.
  bool is_float32() const { return is_mesh() && traits_of(mesh).is_float32; }
  bool has_lengths_only() const { return is_mesh() && traits_of(mesh).has_lengths_only; }
  bool holds_zones() const { return is_mesh() && traits_of(mesh).holds_zones; }
  bool holds_solids_only() const { return is_mesh() && traits_of(mesh).holds_solids_only; }
  /// Can be a print: its coordinates are millimetres to those who print it.
  bool holds_prints() const { return is_mesh() && traits_of(mesh).holds_prints; }
  /// Has a place for normals, uvs and colours.
  bool holds_attributes() const { return is_mesh() && traits_of(mesh).holds_attributes; }
  /// True if its content does not rely on z being the height.
  bool holds_space() const;
  /// True if it has a CRS, and no place for it that all readers of the format use: a .prj file holds it.
  bool has_projection_beside() const { return is_mesh() && traits_of(mesh).has_projection_file; }
  /// The frame of x and y unless a CRS was asked for.
  DefaultFrame default_frame() const;
  /// In which unit its heights are.
  HeightsIn heights_in() const;
};

/// True if --up is y.
Result<bool> parse_up(const Given& up);

/// True if the mesh is turned y up before it is written, by --up or as readers of the format expect it. Not for GLB,
/// whose writer does that itself. kUsage if the format knows one axis only, and it is the other.
Result<bool> choose_y_up(const Given& up, const OutputFormat& format, bool is_print);

/// By --of if it was given, else by the output's extension.
Result<OutputFormat> choose_output_format(const Given& of, const std::string& output);

/// In which unit heights are in a mesh file, by its name.
HeightsIn heights_in(const std::string& mesh_path);
/// The default frame of a mesh file, by its name.
DefaultFrame default_frame(const std::string& mesh_path);

}  // namespace scarp::cli
