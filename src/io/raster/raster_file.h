// Implementation of a raster file written row by row.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "io/raster/raster_source.h"
#include "io/staged_file.h"
#include "scarp/io.h"

namespace scarp {

struct RasterFile::Impl {
  io::StagedFile staged;
  std::unique_ptr<io::GeoTiff> tiff;  // destroyed before its file
  int cols = 0, rows = 0;
  std::vector<float> held = {};  // buffered whole rows
  int written = 0;
  std::uint64_t size = 0;  // size of the finished part
};

}  // namespace scarp
