// What OUTPUT is: a mesh file, a drawing of the mesh's edges, or the approximation resampled on the grid.
#pragma once

#include <string>

#include "options.h"
#include "scarp/io.h"

namespace scarp::cli {

enum class OutputKind { kMesh, kSvg, kEps, kDem };

struct OutputFormat {
  OutputKind kind = OutputKind::kMesh;
  MeshFormat mesh = MeshFormat::kGlb;            ///< of a kMesh
  RasterFormat raster = RasterFormat::kGeoTiff;  ///< of a kDem

  /// "glb", "svg", "dem", …
  const char* name() const;
  /// "GLB", "SVG", …: for sentences.
  std::string title() const;
  bool is_mesh() const { return kind == OutputKind::kMesh; }
  /// Positions are rounded to float32.
  bool is_float32() const { return is_mesh() && (mesh == MeshFormat::kGlb || mesh == MeshFormat::kStl); }
  /// Has a place for normals, uvs and colours.
  bool holds_attributes() const { return is_mesh() && mesh != MeshFormat::kStl && mesh != MeshFormat::kTin; }
};

/// By --of if it was given, else by the output's extension.
Result<OutputFormat> choose_output_format(const Given& of, const std::string& output);

}  // namespace scarp::cli
