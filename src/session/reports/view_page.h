// The viewer's page: one HTML file that holds a mesh and the raster that judges it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scarp/height_field.h"

namespace scarp::cli {

/// A mesh, as GLB, and the file that it is of.
struct PageMesh {
  std::string path;
  std::uint64_t file_bytes = 0;
  std::vector<std::uint8_t> glb;
};

struct ViewPage {
  std::vector<std::uint8_t> html;
  /// Why the page does not hold the raster; nothing if it does, or if there is none.
  std::optional<std::string> left_out;
};

/// `path` is what the meshes are of, which the page is named after. `field` may be null. Fails with kInput for samples
/// that cannot be read.
Result<ViewPage> make_view_page(const std::string& page_template, const std::string& path,
                                const std::vector<PageMesh>& meshes, const OwnedHeightField* field);

}  // namespace scarp::cli
