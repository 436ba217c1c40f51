// Converts raw rasters and meshes in files to the library's types.
#pragma once

#include <string>

#include "raw.h"
#include "scarp/height_field.h"
#include "scarp/options.h"

namespace bench {

inline scarp::HeightField field_of(const RawRaster& raw) {
  scarp::HeightField field;
  field.samples = raw.samples.data();
  field.cols = raw.cols;
  field.rows = raw.rows;
  field.frame = scarp::grid_frame(raw.rows);
  return field;
}

inline scarp::Effort effort_of(const std::string& name) {
  if (name == "fast") return scarp::Effort::kFast;
  if (name == "normal") return scarp::Effort::kNormal;
  if (name == "high") return scarp::Effort::kHigh;
  die("an effort is fast, normal or high");
}

}  // namespace bench
