#include "io/gdal/view.h"

#include <cpl_string.h>
#include <fmt/format.h>
#include <gdal_utils.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "io/gdal/join.h"
#include "io/gdal/mosaic.h"
#include "io/gdal/text_grid.h"

namespace scarp::gdal {
namespace {

struct FreeOptions {
  void operator()(GDALTranslateOptions* options) const { GDALTranslateOptionsFree(options); }
  void operator()(GDALWarpAppOptions* options) const { GDALWarpAppOptionsFree(options); }
};

/// A window of cells, aggregated by k × k.
struct Part {
  int col = 0, row = 0, cols = 0, rows = 0;
  int across = 1, down = 1;
};

constexpr double kSameCell = 1e-6;  // tolerance for coordinates given as the border of a cell

Result<void> cut(const std::array<double, 4>& extent, const std::array<double, 6>& gt, const std::string& path,
                 Part& part) {
  const auto [xmin, ymin, xmax, ymax] = extent;
  if (!(xmin < xmax) || !(ymin < ymax)) {
    return fail(ErrorKind::kUsage,
                fmt::format("the extent {:.10g} {:.10g} {:.10g} {:.10g} is empty: give xmin ymin xmax ymax", xmin, ymin,
                            xmax, ymax));
  }
  const auto range = [](double low, double high, double origin, double step, int count) {
    const auto [from, to] = std::minmax({(low - origin) / step, (high - origin) / step});
    const double first = std::clamp(std::floor(from + kSameCell), 0.0, static_cast<double>(count));
    const double last = std::clamp(std::ceil(to - kSameCell), 0.0, static_cast<double>(count));
    return std::pair{static_cast<int>(first), static_cast<int>(last)};
  };
  const auto [left, right] = range(xmin, xmax, gt[0], gt[1], part.cols);
  const auto [top, bottom] = range(ymin, ymax, gt[3], gt[5], part.rows);
  if (left >= right || top >= bottom) {
    const auto [x0, x1] = std::minmax({gt[0], gt[0] + gt[1] * part.cols});
    const auto [y0, y1] = std::minmax({gt[3], gt[3] + gt[5] * part.rows});
    return fail(ErrorKind::kInput,
                fmt::format("{}: lies beside the extent {:.10g} {:.10g} {:.10g} {:.10g}: it covers {:.10g} {:.10g} "
                            "{:.10g} {:.10g}",
                            path, xmin, ymin, xmax, ymax, x0, y0, x1, y1));
  }
  part = {left, top, right - left, bottom - top, 1, 1};
  return {};
}

Result<void> coarsen(double resolution, const std::array<double, 6>& gt, const std::string& path, Part& part) {
  if (!(resolution > 0))
    return fail(ErrorKind::kUsage, fmt::format("a resolution of {:.10g} is not above 0", resolution));
  const auto count = [&](double step) {
    return static_cast<int>(std::clamp(std::floor(resolution / std::abs(step) + kSameCell), 1.0, 1e9));
  };
  part.across = count(gt[1]);
  part.down = count(gt[5]);
  if (part.cols / part.across >= 2 && part.rows / part.down >= 2) return {};
  return fail(
      ErrorKind::kInput,
      fmt::format("{}: {} x {} samples with cells of {:.10g} x {:.10g} leave less than 2 x 2 at a resolution of "
                  "{:.10g}: ask for a finer one",
                  path, part.cols, part.rows, std::abs(gt[1]), std::abs(gt[5]), resolution));
}

/// The type of means: fractional for all integers, except for bytes if `keeps_type`.
const char* mean_type(GDALDataType type, bool keeps_type) {
  if (keeps_type && type == GDT_Byte) return "Byte";
  const bool is_wide = type == GDT_Float64 || type == GDT_Int32 || type == GDT_UInt32;
  return is_wide ? "Float64" : "Float32";
}

/// Copies the metadata of `whole` to its virtual raster `made`.
Result<Dataset> finish_view(Session& session, GDALDatasetH whole, GDALDatasetH made, const std::string& path) {
  if (made == nullptr)
    return fail(ErrorKind::kInput, fmt::format("{}: no part of it can be read: {}", path, session.reason()));
  repeat_said(whole, made);
  return open_virtual(session, made, path);
}

/// A window of cells; with a non-empty `type`, means of that type.
Result<Dataset> open_window(Session& session, GDALDatasetH whole, const std::string& path, const Part& part,
                            const std::string& type) {
  const int cols = part.cols / part.across, rows = part.rows / part.down;
  CPLStringList words;
  const auto add = [&](std::initializer_list<std::string> more) {
    for (const std::string& word : more) words.AddString(word.c_str());
  };
  add({"-of", "VRT", "-srcwin", fmt::format("{}", part.col), fmt::format("{}", part.row),
       fmt::format("{}", cols * part.across), fmt::format("{}", rows * part.down)});
  if (!type.empty()) {
    add({"-outsize", fmt::format("{}", cols), fmt::format("{}", rows), "-r", "average", "-ovr", "NONE", "-ot", type});
  }
  const std::unique_ptr<GDALTranslateOptions, FreeOptions> options(GDALTranslateOptionsNew(words.List(), nullptr));
  session.clear();
  int failed = 0;
  const Dataset made(GDALTranslate("", whole, options.get(), &failed));
  for (int k = 1; made && type.empty() && k <= GDALGetRasterCount(whole); ++k) {
    GDALRasterBandH said = GDALGetRasterBand(whole, k), band = GDALGetRasterBand(made.get(), k);
    int has_nodata = 0;
    const double nodata = GDALGetRasterNoDataValue(said, &has_nodata);
    // GDAL replaced a nodata value that the type cannot represent
    if (has_nodata != 0 && can_join(GDALGetRasterDataType(said))) GDALSetRasterNoDataValue(band, nodata);
  }
  return finish_view(session, whole, failed == 0 ? made.get() : nullptr, path);
}

/// Means of the valid cells, by warping: resampling of a virtual raster would average nodata, too. The mean of no cell
/// is NaN, since any other value may be a mean. The coordinates for warping are columns and rows, which are exact and
/// begin at the top.
Result<Dataset> open_means(Session& session, GDALDatasetH whole, const std::string& path, const Part& part,
                           std::optional<double> nodata, const std::string& type) {
  const int cols = part.cols / part.across, rows = part.rows / part.down;
  Tile tile = describe_raster(whole, path);
  std::array<double, 6> gt = tile.gt;
  tile.gt = {0, 1, 0, 0, 0, -1};
  tile.from_col = part.col;
  tile.from_row = part.row;
  tile.cols = cols * part.across;
  tile.rows = rows * part.down;
  SCARP_TRY(const auto& cells, open_xml(session, write_with_nan(tile, nodata), path));
  CPLStringList words;
  for (const std::string& word : {std::string("-of"),
                                  std::string("VRT"),
                                  std::string("-r"),
                                  std::string("average"),
                                  std::string("-ovr"),
                                  std::string("NONE"),
                                  std::string("-et"),
                                  std::string("0"),
                                  std::string("-te"),
                                  std::string("0"),
                                  fmt::format("{}", -rows * part.down),
                                  fmt::format("{}", cols * part.across),
                                  std::string("0"),
                                  std::string("-ts"),
                                  fmt::format("{}", cols),
                                  fmt::format("{}", rows),
                                  std::string("-dstnodata"),
                                  std::string("nan"),
                                  std::string("-ot"),
                                  type})
    words.AddString(word.c_str());
  const std::unique_ptr<GDALWarpAppOptions, FreeOptions> options(GDALWarpAppOptionsNew(words.List(), nullptr));
  session.clear();
  int failed = 0;
  GDALDatasetH source = cells.get();
  const Dataset made(GDALWarp("", nullptr, 1, &source, options.get(), &failed));
  if (!made || failed != 0) return finish_view(session, whole, nullptr, path);
  gt[0] += part.col * gt[1];
  gt[3] += part.row * gt[5];
  gt[1] *= part.across;
  gt[5] *= part.down;
  GDALSetGeoTransform(made.get(), gt.data());
  return finish_view(session, whole, made.get(), path);
}

/// The value of cells excluded from means: the requested or declared nodata.
std::optional<double> find_nodata(GDALRasterBandH band, std::optional<double> asked) {
  int has_nodata = 0;
  const double declared = GDALGetRasterNoDataValue(band, &has_nodata);
  return asked || has_nodata == 0 ? asked : declared;
}

std::string describe_part(const Part& part, int cols, int rows, const std::array<double, 6>& gt) {
  std::string words;
  if (part.cols != cols || part.rows != rows) {
    words = fmt::format("columns {} to {} of {} and rows {} to {} of {}", part.col, part.col + part.cols - 1, cols,
                        part.row, part.row + part.rows - 1, rows);
  }
  if (part.across == 1 && part.down == 1) return words;
  words += fmt::format("{}means of {} x {} cells, {:.10g} x {:.10g} each", words.empty() ? "" : ", ", part.across,
                       part.down, std::abs(gt[1]) * part.across, std::abs(gt[5]) * part.down);
  const int right = part.cols % part.across, bottom = part.rows % part.down;
  if (right > 0 || bottom > 0) words += fmt::format(" (without the last {} columns and {} rows)", right, bottom);
  return words;
}

}  // namespace

Result<Dataset> open_view(Session& session, const std::string& path, const RasterView& view, bool keeps_type,
                          std::string& words, Means* means, std::optional<double> nodata) {
  std::vector<std::string> given{path};
  given.insert(given.end(), view.more.begin(), view.more.end());
  std::vector<std::string> left_out;
  SCARP_TRY(const auto& paths, expand_folders(session, given, left_out));
  const bool is_mosaic = paths.size() > 1;
  auto whole = is_mosaic ? open_mosaic(session, paths, nodata, words) : open_raster(session, paths.front());
  SCARP_RETURN_IF_ERROR(whole);
  if (!is_mosaic && find_wide_gap(whole->get())) {
    whole = open_mosaic(session, paths, nodata, words);
    SCARP_RETURN_IF_ERROR(whole);
  } else if (const char* nodes = GDALGetMetadataItem(whole->get(), kTextGridKey, nullptr); !is_mosaic && nodes != nullptr) {
    words = fmt::format("raster of {} (--points: as scattered points)", nodes);
  }
  if (!left_out.empty())
    words += fmt::format("{}, without what Scarp made: {}", is_mosaic ? "" : paths.front(), fmt::join(left_out, ", "));
  if (!view.extent && !view.resolution) return whole;

  std::array<double, 6> gt{};
  if (GDALGetGeoTransform(whole->get(), gt.data()) != CE_None || gt[2] != 0 || gt[4] != 0) {
    return fail(ErrorKind::kUsage,
                fmt::format("{}: an extent and a resolution need a georeference without rotation", path));
  }
  const int cols = GDALGetRasterXSize(whole->get()), rows = GDALGetRasterYSize(whole->get());
  Part part{0, 0, cols, rows, 1, 1};
  if (view.extent) {
    SCARP_RETURN_IF_ERROR(cut(*view.extent, gt, path, part));
  }
  if (view.resolution) {
    SCARP_RETURN_IF_ERROR(coarsen(*view.resolution, gt, path, part));
  }
  const std::string of_part = describe_part(part, cols, rows, gt);
  if (of_part.empty()) return whole;
  words += (words.empty() ? "" : ", ") + of_part;
  if (part.across == 1 && part.down == 1) return open_window(session, whole->get(), path, part, "");
  GDALRasterBandH band = GDALGetRasterBand(whole->get(), 1);
  const GDALDataType type = GDALGetRasterDataType(band);
  if (means == nullptr) return open_window(session, whole->get(), path, part, mean_type(type, keeps_type));
  means->cells = static_cast<int>(std::min<std::int64_t>(std::int64_t{part.across} * part.down, 1 << 30));
  means->are_whole = type == GDT_Byte || type == GDT_Int16 || type == GDT_UInt16;
  means->nodata = find_nodata(band, nodata);
  means->have_holes = means->nodata || GDALDataTypeIsFloating(type) != 0 || GDALGetMaskFlags(band) != GMF_ALL_VALID ||
                      describe_raster(whole->get(), path).bands.front().is_signed_byte;
  return means->have_holes ? open_means(session, whole->get(), path, part, means->nodata, mean_type(type, false))
                           : open_window(session, whole->get(), path, part, mean_type(type, false));
}

}  // namespace scarp::gdal
