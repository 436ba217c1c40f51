// Conversion of bands to float32 samples.
#pragma once

#include <gdal.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/gdal/open.h"
#include "io/gdal/session.h"
#include "io/gdal/view.h"
#include "io/gdal/windows.h"
#include "scarp/io.h"

namespace scarp::gdal {

/// The band to read and the meaning of its values.
struct BandSense {
  GDALRasterBandH band = nullptr;
  GDALRasterBandH mask = nullptr;  ///< bytes, 0 = nodata; null if none
  GDALDataType type = GDT_Unknown;
  bool signed_byte = false;                  ///< GDT_Byte that holds −128 … 127
  std::optional<double> nodata;              ///< compared with raw values, before scale and offset
  std::optional<std::int64_t> nodata_int64;  ///< exact, for bands of 64-bit integers
  std::optional<std::uint64_t> nodata_uint64;
  double scale = 1, offset = 0;  ///< height = scale·raw + offset
  Means means;
  std::string depths;  ///< the reason to assume depths, measured downwards; empty if none
};

/// Fails with kInput if the band does not exist or is complex.
Result<BandSense> find_band_sense(GDALDatasetH dataset, const std::string& path, const ReadOptions& options,
                                  RasterInfo& info);

/// Warns of bands that are unsuitable as heights or values: colours, or indices of colours.
void warn_of_colours(GDALDatasetH dataset, const BandSense& sense, bool as_values, RasterInfo& info);

/// Statistics collected by reading.
struct Findings {
  std::uint64_t infinities = 0;  ///< infinities and values beyond float32, converted to nodata
  double rounding = 0;           ///< largest |value − float32 sample|
  struct Beyond {
    double value = 0;
    int col = 0, row = 0;
  };
  std::optional<Beyond> beyond;  ///< the first finite value beyond float32
  /// Statistics of colours that are read as heights.
  struct Colours {
    std::uint64_t valid = 0, on_earth = 0, on_earth_otherwise = 0;  ///< excluding black; on_earth_otherwise: in the
                                                                    ///< other encoding
    /// Numbers of samples that differ from both neighbours. `torn`: where the colour with the value 2^8 or 2^16
    /// changes; `whole`: elsewhere.
    std::array<std::uint64_t, 2> torn{}, whole{};
    std::array<std::uint32_t, 2> most{};  ///< largest difference of torn samples
    /// `crossed`: number of pairs of samples on opposite sides of a height at which a colour wraps around. `off`:
    /// number of such pairs with an outlier between them. Indices: lag, colour, shift of this height in quarters of the
    /// colour's value.
    struct Line {
      std::uint64_t crossed = 0, off = 0;
    };
    std::array<std::array<std::array<Line, 4>, 2>, 2> lines{};
    std::array<std::array<std::uint32_t, 2>, 2> farthest{};  ///< largest difference at the unshifted height
    /// Numbers of outliers at the unshifted height. Indices: lag, colour, last three bits of the number of wraps, side
    /// (0: below both neighbours, 1: above both).
    std::array<std::array<std::array<std::array<std::uint64_t, 2>, 8>, 2>, 2> sides{};

    void add(const Colours& further);
  } colours;

  void add(const Findings& further) {
    infinities += further.infinities;
    colours.add(further.colours);
    rounding = std::max(rounding, further.rounding);
    if (!beyond) beyond = further.beyond;
  }
};

/// Reads windows of heights, with nodata as NaN. Not thread-safe.
class WindowReader {
 public:
  virtual ~WindowReader() = default;
  /// Writes the window to `out`, `stride` floats from row to row. False if GDAL fails.
  virtual bool read(const Window& window, float* out, std::ptrdiff_t stride) = 0;
  /// Findings of all windows since the last take_findings().
  const Findings& findings() const { return findings_; }
  Findings take_findings() { return std::exchange(findings_, {}); }

 protected:
  Findings findings_;
};

/// The reader of one band.
std::unique_ptr<WindowReader> make_band_reader(const BandSense& sense);
/// The reader of heights packed into colour bands.
std::unique_ptr<WindowReader> make_packed_reader(GDALDatasetH dataset, const ReadOptions& options);

/// The open file and reader of one thread.
struct ReadHandle {
  Dataset dataset;
  std::unique_ptr<WindowReader> reader;
};
/// Opens the raster again.
using OpenAgain = std::function<std::optional<ReadHandle>()>;

/// Reads the raster of `band` into field.samples (already allocated). Windows have a few MB and are aligned with the
/// file's blocks. Uses several threads if `open_again` is not empty. Sets field.sample_rounding. Fails with kInput as
/// soon as GDAL reports a failure, and with kCancelled if the callback requests it.
Result<Findings> read_windows(Session& session, GDALRasterBandH band, WindowReader& reader, const OpenAgain& open_again,
                              const ReadOptions& options, OwnedHeightField& field);

/// Like read_windows(), but reads several bands of one raster, each into its own field. Each window is read for all
/// bands before the next window, so that interleaved files are decoded once.
Result<void> read_bands(Session& session, std::span<const BandSense> bands, const ReadOptions& options,
                        std::span<OwnedHeightField> fields, std::uint64_t& infinities);

/// True if float32 represents all possible values of the band exactly.
bool is_float32(const BandSense& sense);
/// True if the band's samples can be stored as 16-bit codes.
bool has_codes(const BandSense& sense);
/// Reads a band with has_codes() as codes into field.source. Sets field.sample_rounding and the range of field.info;
/// counts infinities. Fails as read_windows() does, and with kInput if memory cannot be allocated.
Result<void> read_codes(Session& session, const BandSense& sense, const ReadOptions& options, OwnedHeightField& field,
                        std::uint64_t& infinities);

/// Warns of heights probably damaged by processing their colours. `loss`: result of find_loss().
void doubt_colours(const Findings& findings, Decode decode, const std::string& loss, RasterInfo& info);

/// Fails with kInput unless the dataset has 3 or 4 bands of unsigned bytes.
Result<void> verify_packed(GDALDatasetH dataset, const std::string& path);
/// The file's lossy compression, such as "JPEG"; empty if lossless.
std::string find_loss(GDALDatasetH dataset);

}  // namespace scarp::gdal
