// Polygons that the surface ends at.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scarp/cutline.h"
#include "scarp/simplify.h"
#include "session/options/values.h"
#include "session/text/json.h"

namespace CLI {
class App;
}

namespace scarp::cli {

struct CutlineArguments {
  std::vector<std::string> files;  ///< FILE or FILE:LAYER
  Given inset;
  bool mask_outside = false;

  void add_to(CLI::App& command);
  /// Refuses options that need others, and words that are unknown.
  Result<void> check() const;
  /// The option that asks for a cut along the polygons; null if there is none.
  const char* find_cut() const { return files.empty() || mask_outside ? nullptr : "--cutline"; }
  std::string canonical() const;
};

/// What the files hold.
struct Cut {
  Cutline cutline;             ///< empty where the samples outside are nodata
  std::uint64_t polygons = 0;  ///< of the files, before an inset
  std::uint64_t masked = 0;    ///< samples that were made nodata
  std::uint64_t bytes = 0;     ///< that telling them apart takes where the samples are not in memory

  /// For the judge; null where everything counts.
  const Cutline* judged() const { return cutline.rings.empty() ? nullptr : &cutline; }
};

/// Reads the polygons in the CRS of the raster, `raster` being what its file says, and makes the samples of `field`
/// outside nodata where that was asked for. Sentences for the user in `warnings`.
Result<Cut> read_cut(const CutlineArguments& given, const RasterInfo& raster, const ProgressCallback& progress,
                     OwnedHeightField& field, std::vector<std::string>& warnings);

/// The "cutline" object of a report; null without. `outside`: samples that were cut off, besides those that are nodata
/// now.
Json describe_cut(const CutlineArguments& given, const Cut& cut, std::uint64_t outside);
/// "2 polygons, 1,234 samples outside left out".
std::string cut_words(const Cut& cut, std::uint64_t outside);

}  // namespace scarp::cli
