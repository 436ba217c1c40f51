// The rasters of a folder: the paper's five fields, or whatever else is there.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/result.h"

namespace scarp::paper {

struct Field {
  std::string key;  ///< "crater", …; of other rasters the file's name without its extension
  std::string file;
  OwnedHeightField heights;

  std::uint64_t samples() const { return heights.samples.size(); }
  /// The share in samples, rounded: the paper's numbers of vertices.
  std::uint64_t share(double percent) const;
  double relief() const { return heights.info.max - heights.info.min; }
};

struct Fields {
  std::vector<Field> all;                  ///< the paper's in its order, others by name
  bool are_of_paper = false;               ///< at least one is the paper's; no others are read then
  std::vector<std::string> left_out = {};  ///< sentences
};

/// Finds scape_crater.stm, crater.stm, crater.pgm, crater.tif, … for each of the paper's fields; a folder without any
/// of them gives all its rasters. Rasters with nodata or of more than four million samples are omitted. kInput where
/// none is left, or one cannot be read.
Result<Fields> read_fields(const std::string& folder);

/// The path of the first of `names` that is in the folder; empty if none is.
std::string find_file(const std::string& folder, const std::vector<std::string>& names);

}  // namespace scarp::paper
