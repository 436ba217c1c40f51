// GLB files: compression and images.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "scarp/mesh.h"
#include "scarp/result.h"

#pragma GCC visibility push(default)

namespace scarp {

/// An encoded image: PNG, JPEG or WebP.
struct GlbImage {
  std::vector<std::uint8_t> bytes;  ///< EMPTY: no image
  std::string mime_type = "image/png";
};

struct GlbOptions {
  /// Quantised (KHR_mesh_quantization) and compressed (EXT_meshopt_compression, version 0 of the codec). Positions keep
  /// their values: x and y are 16-bit multiples of 1/256 of `cell` or more, z of a power of two. A mesh or an axis that
  /// does not fit stays float32, which is compressed, too. simplify() makes meshes that fit with Output::lattice.
  /// Texture coordinates (16 bits), normals (12 significant bits a component) and colours (16 bits, linear) are
  /// rounded. Triangles and vertices are put in the order that needs the fewest bytes.
  bool compress = false;
  /// Sides of a cell of the raster along x and y, of either sign: Frame::affine[1] and [5]. DEFAULT: none.
  std::array<double, 2> cell{0, 0};
  GlbImage base_color = {};  ///< draped over the mesh by its uvs; without it a mesh with uvs gets one white pixel
  /// Tangent-space normals by the mesh's uvs. Every vertex then gets the normal (0, 0, 1) and the tangent (1, 0, 0), in
  /// place of Mesh::normals: red is x, green y, blue z of the surface's normal, whatever the triangles.
  GlbImage normal_map = {};
  int threads = 1;  ///< 0: all cores. Never changes the bytes. DEFAULT: 1.
};

/// True if this build can `compress`: it has libmeshoptimizer.
bool can_compress_glb();

/// The bytes of a GLB file. encode_mesh() is this without options. Fails with kOutput as it does, for images without
/// uvs, and for `compress` where positions are neither on the lattice nor float32, or without libmeshoptimizer; with
/// kInput where memory runs out.
Result<std::vector<std::uint8_t>> encode_glb(const Mesh& mesh, const GlbOptions& options);

}  // namespace scarp

#pragma GCC visibility pop
