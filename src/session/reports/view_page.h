// The viewer's page: one HTML file with meshes and their raster.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scarp/height_field.h"

namespace scarp::cli {

/// A mesh as GLB, and its file.
struct PageMesh {
  std::string path;
  std::uint64_t file_bytes = 0;
  std::vector<std::uint8_t> glb;
};

struct ViewPage {
  std::vector<std::uint8_t> html;
  /// Reason why the page lacks the raster; nothing if it has the raster or none was given.
  std::optional<std::string> left_out;
};

/// The page is named after `path`, the file of the meshes. `field` may be null. Fails with kInput for unreadable
/// samples.
Result<ViewPage> make_view_page(const std::string& page_template, const std::string& path,
                                const std::vector<PageMesh>& meshes, const OwnedHeightField* field);

}  // namespace scarp::cli
