// Reads all bands of an image as channels.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "io/commands.h"
#include "io/gdal/georeference.h"
#include "io/gdal/open.h"
#include "io/gdal/read_samples.h"
#include "io/gdal/view.h"
#include "io/raster/raster_finish.h"
#include "io/raster/raster_source.h"

namespace scarp::gdal {
namespace {

constexpr float kNoChannel = std::numeric_limits<float>::quiet_NaN();

/// Red, green and blue of a palette's entries; NaN for the transparent ones.
using Palette = std::vector<std::array<float, 3>>;

Palette palette_of(GDALRasterBandH band) {
  GDALColorTableH table = GDALGetRasterColorTable(band);
  if (table == nullptr || GDALGetRasterColorInterpretation(band) != GCI_PaletteIndex) return {};
  Palette palette(static_cast<std::size_t>(GDALGetColorEntryCount(table)));
  for (std::size_t i = 0; i < palette.size(); ++i) {
    GDALColorEntry entry{};
    GDALGetColorEntryAsRGB(table, static_cast<int>(i), &entry);
    palette[i] = {static_cast<float>(entry.c1), static_cast<float>(entry.c2), static_cast<float>(entry.c3)};
    if (entry.c4 == 0) palette[i].fill(kNoChannel);
  }
  return palette;
}

struct ChannelBands {
  std::vector<BandSense> bands;
  std::vector<Palette> palettes;  ///< by band; empty if values are colours
  std::size_t channels = 0;
  bool is_8bit = true, is_color = false;
};

Result<ChannelBands> choose_bands(GDALDatasetH dataset, const std::string& path, ReadOptions options, bool all_bands,
                                  RasterInfo& info) {
  const int count = GDALGetRasterCount(dataset);
  const int first = all_bands ? 1 : options.band, last = all_bands ? count : options.band;
  const auto choose = [&](int left_out) {
    std::string words;
    for (int k = 1, taken = 0; k <= count && taken < kMaxChannels; ++k) {
      if (k != left_out) words += fmt::format("{}-b {}", taken++ == 0 ? "" : " ", k);
    }
    return io::translate_command(words, path);
  };
  ChannelBands chosen;
  for (int k = first; k <= last; ++k) {
    options.band = k;
    SCARP_TRY(auto&& band, find_band_sense(dataset, path, options, info));
    if (GDALGetRasterColorInterpretation(band.band) == GCI_AlphaBand) {
      return fail(ErrorKind::kInput,
                  fmt::format("{}: band {} is transparency (alpha), which is no channel; leave it out "
                              "first ({})",
                              path, k, choose(k)));
    }
    chosen.palettes.push_back(palette_of(band.band));
    chosen.channels += chosen.palettes.back().empty() ? 1 : 3;
    chosen.is_8bit &= band.type == GDT_Byte && !band.signed_byte && band.scale == 1 && band.offset == 0;
    chosen.bands.push_back(band);
  }
  if (chosen.channels > kMaxChannels) {
    return fail(ErrorKind::kInput,
                fmt::format("{} has {} bands, and at most {} can be channels; choose some of them ({})", path,
                            chosen.channels, kMaxChannels, choose(0)));
  }
  const auto means = [&](std::size_t k, GDALColorInterp meaning) {
    return GDALGetRasterColorInterpretation(chosen.bands[k].band) == meaning;
  };
  chosen.is_color = chosen.bands.size() == 1 ? chosen.channels == 3
                                             : chosen.bands.size() == 3 && means(0, GCI_RedBand) &&
                                                   means(1, GCI_GreenBand) && means(2, GCI_BlueBand);
  return chosen;
}

Result<void> apply_palette(const Palette& palette, OwnedHeightField& field, std::vector<std::vector<float>>& bands) {
  const std::size_t first = bands.size();
  for (int k = 0; k < 3; ++k) bands.emplace_back(field.samples.size(), kNoChannel);
  for (std::size_t i = 0; i < field.samples.size(); ++i) {
    const float number = field.samples[i];
    if (std::isnan(number)) continue;
    if (!(number >= 0 && number < static_cast<float>(palette.size()))) {
      const auto cols = static_cast<std::size_t>(field.cols);
      return fail(ErrorKind::kInput, fmt::format("{}: sample ({}, {}) has colour {} of a palette of {}: the file is "
                                                 "damaged",
                                                 field.info.path, i % cols, i / cols, number, palette.size()));
    }
    const auto& colour = palette[static_cast<std::size_t>(number)];
    for (std::size_t k = 0; k < 3; ++k) bands[first + k][i] = colour[k];
  }
  field.samples = {};
  return {};
}

/// Like finish_raster().
Result<void> finish_channels(OwnedChannels& channels, std::uint64_t infinities) {
  RasterInfo& info = channels.info;
  double least = HUGE_VAL, most = -HUGE_VAL;
  for (std::size_t i = 0; i < channels.bands.front().size(); ++i) {
    bool all = true;
    for (const auto& band : channels.bands) {
      if (std::isnan(band[i])) {
        all = false;
        continue;
      }
      least = std::min(least, double{band[i]});
      most = std::max(most, double{band[i]});
    }
    info.valid += all ? 1 : 0;
  }
  if (infinities > 0) {
    info.warnings.push_back(fmt::format("{} {} infinite or too large for a float32 and taken as nodata", infinities,
                                        infinities == 1 ? "value is" : "values are"));
  }
  if (least > most) {
    return fail(ErrorKind::kInput, fmt::format("{}: none of its {} x {} samples has a value: all are nodata", info.path,
                                               channels.cols, channels.rows));
  }
  info.min = least;
  info.max = most;
  return {};
}

Result<OwnedChannels> read(const std::string& path, const ReadOptions& options, bool all_bands) {
  if (options.decode != Decode::kNone) {
    return fail(ErrorKind::kInput, path +
                                       ": heights packed into colours are one height field, not channels; read it "
                                       "as heights");
  }
  Session session(is_remote(path));
  OwnedChannels channels;
  SCARP_TRY(auto&& dataset, open_view(session, path, options.view, true, channels.info.view));
  channels.info.path = path;
  channels.info.format = GDALGetDriverShortName(GDALGetDatasetDriver(dataset.get()));
  SCARP_TRY(auto&& chosen, choose_bands(dataset.get(), path, options, all_bands, channels.info));
  SCARP_TRY(auto&& geo, read_georeference(dataset.get(), path));
  describe_georeference(geo, channels.info);
  SCARP_RETURN_IF_ERROR(io::check_raster_size(path, static_cast<std::uint64_t>(geo.cols),
                                              static_cast<std::uint64_t>(geo.rows), options, chosen.channels));
  SCARP_TRY(channels.frame, choose_frame(geo, options, channels.info));
  channels.cols = geo.cols;
  channels.rows = geo.rows;
  channels.is_8bit = chosen.is_8bit;
  channels.is_color = chosen.is_color;

  std::vector<OwnedHeightField> fields(chosen.bands.size());
  for (OwnedHeightField& field : fields) {
    field.cols = geo.cols;
    field.rows = geo.rows;
    field.info.path = path;
    SCARP_RETURN_IF_ERROR(io::allocate_samples(path, field));
  }
  std::uint64_t infinities = 0;
  SCARP_RETURN_IF_ERROR(read_bands(session, chosen.bands, options, fields, infinities));
  for (std::size_t k = 0; k < fields.size(); ++k) {
    if (chosen.palettes[k].empty()) {
      channels.bands.push_back(std::move(fields[k].samples));
    } else {
      SCARP_RETURN_IF_ERROR(apply_palette(chosen.palettes[k], fields[k], channels.bands));
    }
  }
  for (const std::string& warning : session.warnings()) channels.info.warnings.push_back("GDAL: " + warning);
  SCARP_RETURN_IF_ERROR(finish_channels(channels, infinities));
  return channels;
}

}  // namespace
}  // namespace scarp::gdal

namespace scarp::io {

Result<OwnedChannels> read_gdal_channels(const std::string& path, const ReadOptions& options, bool all_bands) {
  return gdal::read(path, options, all_bands);
}

}  // namespace scarp::io
