// Textures and images: sample values whose errors count in addition to errors of heights, or instead of them.
#pragma once

#include <string>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/io.h"
#include "scarp/options.h"
#include "session/options/channel_options.h"

namespace scarp::cli {

/// The channels of a run.
struct Channels {
  OwnedChannels bands;
  std::vector<std::string> names;  ///< "red", "band 4", …
  std::vector<double> scales;      ///< Channel::scale per band
  double height_scale = 1;
  double relief = 0;     ///< reference of percentages with --image: the largest range of a band; 255 if all are bytes
  double magnitude = 0;  ///< upper bound of the norm of scaled values, which scales the judge's rounding

  std::size_t count() const { return bands.bands.size(); }
  bool empty() const { return bands.bands.empty(); }
  /// True if 8-bit colours or grey levels can hold all data.
  bool are_colors() const { return bands.is_8bit && (count() == 1 || (count() == 3 && bands.is_color)); }
  /// Adds these channels to `field`, which is on the same grid. They must outlive the field.
  void attach_to(HeightField& field) const;
};

/// Reads the textures of the plan, which must lie on the grid of `heights` and have values wherever `heights` has. The
/// error of a sample is then the norm of |height error| and of w/(1 − w) · relief · |error| / range of each channel;
/// all channels together count once.
Result<Channels> read_textures(const ChannelPlan& plan, const OwnedHeightField& heights,
                               const ProgressCallback& progress);

/// An image: a height field of zeros with its bands as channels; nodata where a band has no value. A sample's error is
/// the norm of weight · |error| over all bands, in grey levels. Bands other than bytes are scaled to the largest range
/// among them.
struct Image {
  OwnedHeightField field;
  Channels channels;
};
Result<Image> read_image(const ChannelPlan& plan, const std::string& path, const ReadOptions& options, bool one_band);

}  // namespace scarp::cli
