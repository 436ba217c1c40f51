// GDALBuildVRT() supports one nodata value and no unit, rejects rasters whose first row is the southern one, and reads
// signed bytes as unsigned. So the virtual raster is written here. Its bands have the tiles' type, nodata value, scale
// and offset where these agree. Otherwise they are floats with nodata NaN, which no tile uses as a height. A mask marks
// invalid cells that a nodata value cannot mark.
#include "io/gdal/join.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string_view>

namespace scarp::gdal {
namespace {

struct JoinedBand {
  GDALDataType type = GDT_Unknown;
  std::optional<double> nodata;
  bool is_decoded = false;  ///< it holds heights, not raw values with scale and offset
};

constexpr double kHuge = 3.4e38;  // larger nodata is compared by magnitude: see read_samples.cpp

GDALDataType type_of(const BandFacts& band) { return band.is_signed_byte ? GDT_Int16 : band.type; }

bool same_value(const std::optional<double>& a, const std::optional<double>& b) {
  return a == b || (a && b && std::isnan(*a) && std::isnan(*b));
}

bool holds(GDALDataType type, double value) {
  if (GDALDataTypeIsFloating(type)) return true;
  const int bits = GDALGetDataTypeSizeBits(type), magnitude = GDALDataTypeIsSigned(type) ? bits - 1 : bits;
  const double least = GDALDataTypeIsSigned(type) ? -std::ldexp(1.0, magnitude) : 0;
  return std::floor(value) == value && value >= least && value < std::ldexp(1.0, magnitude);
}

GDALDataType floats_for(GDALDataType type) {
  return type == GDT_Byte || type == GDT_Int16 || type == GDT_UInt16 || type == GDT_Float32 ? GDT_Float32 : GDT_Float64;
}

std::optional<double> nodata_of(const BandFacts& band, std::optional<double> asked) {
  if (band.is_alpha) return {};
  return asked ? asked : band.nodata;
}

JoinedBand describe_joined(std::span<const Tile> tiles, std::size_t k, std::optional<double> asked, bool with_nan) {
  const BandFacts& first = tiles.front().bands[k];
  JoinedBand joined{type_of(first), nodata_of(first, asked), false};
  bool is_one_nodata = true;
  std::optional<double> huge;
  for (const Tile& tile : tiles) {
    const BandFacts& band = tile.bands[k];
    const auto nodata = nodata_of(band, asked);
    joined.type = GDALDataTypeUnion(joined.type, type_of(band));
    joined.is_decoded |= band.scale != first.scale || band.offset != first.offset;
    is_one_nodata &= same_value(nodata, joined.nodata);
    if (nodata && std::abs(*nodata) >= kHuge && !huge) huge = nodata;
  }
  if (first.is_alpha) return joined;
  if (joined.is_decoded) joined.type = GDT_Float64;
  const bool is_one = is_one_nodata && !joined.is_decoded && !with_nan;
  if (is_one && (!joined.nodata || holds(joined.type, *joined.nodata))) return joined;
  joined.type = floats_for(joined.type);
  if (is_one) return joined;  // NaN, which is in no tile
  joined.nodata = huge && !joined.is_decoded && !with_nan ? *huge : std::numeric_limits<double>::quiet_NaN();
  return joined;
}

/// True if every cell of the bounding rectangle lies in a tile.
bool leave_no_gap(std::span<const Tile> tiles) {
  std::set<std::int64_t> xs, ys;
  for (const Tile& tile : tiles) {
    xs.insert({tile.col, tile.col + tile.cols});
    ys.insert({tile.row, tile.row + tile.rows});
  }
  const std::vector<std::int64_t> x(xs.begin(), xs.end()), y(ys.begin(), ys.end());
  const auto at = [](const std::vector<std::int64_t>& of, std::int64_t value) {
    return static_cast<std::size_t>(std::lower_bound(of.begin(), of.end(), value) - of.begin());
  };
  std::vector<bool> is_covered((x.size() - 1) * (y.size() - 1));
  for (const Tile& tile : tiles) {
    for (std::size_t j = at(y, tile.row); j < at(y, tile.row + tile.rows); ++j) {
      for (std::size_t i = at(x, tile.col); i < at(x, tile.col + tile.cols); ++i)
        is_covered[j * (x.size() - 1) + i] = true;
    }
  }
  return std::find(is_covered.begin(), is_covered.end(), false) == is_covered.end();
}

std::string escape(const std::string& text) {
  char* escaped = CPLEscapeString(text.c_str(), static_cast<int>(text.size()), CPLES_XML);
  std::string words = escaped;
  CPLFree(escaped);
  return words;
}

BandFacts facts_of(GDALRasterBandH band) {
  BandFacts facts;
  int is_given = 0;
  const char* pixel_type = GDALGetMetadataItem(band, "PIXELTYPE", "IMAGE_STRUCTURE");
  facts.type = GDALGetRasterDataType(band);
  facts.is_signed_byte = facts.type == GDT_Byte && pixel_type != nullptr && EQUAL(pixel_type, "SIGNEDBYTE");
  facts.is_alpha = GDALGetRasterColorInterpretation(band) == GCI_AlphaBand;
  if (const double value = GDALGetRasterNoDataValue(band, &is_given); is_given != 0) facts.nodata = value;
  if (const double value = GDALGetRasterScale(band, &is_given); is_given != 0) facts.scale = value;
  if (const double value = GDALGetRasterOffset(band, &is_given); is_given != 0) facts.offset = value;
  facts.unit = GDALGetRasterUnitType(band);
  return facts;
}

class Writer {
 public:
  Writer(std::span<const Tile> tiles, std::optional<double> asked, bool with_nan) : tiles_(tiles), asked_(asked) {
    const Tile& first = tiles.front();
    left_ = first.col, top_ = first.row, right_ = left_ + first.cols, bottom_ = top_ + first.rows;
    for (const Tile& tile : tiles) {
      left_ = std::min(left_, tile.col);
      top_ = std::min(top_, tile.row);
      right_ = std::max(right_, tile.col + tile.cols);
      bottom_ = std::max(bottom_, tile.row + tile.rows);
    }
    for (std::size_t k = 0; k < first.bands.size(); ++k) bands_.push_back(describe_joined(tiles, k, asked, with_nan));
  }

  bool is_within(std::int64_t most) const { return right_ - left_ <= most && bottom_ - top_ <= most; }
  const std::vector<JoinedBand>& bands() const { return bands_; }

  std::string write() const {
    const std::array<double, 6>& gt = tiles_.front().gt;
    std::string xml = fmt::format(
        "<VRTDataset rasterXSize=\"{}\" rasterYSize=\"{}\"><GeoTransform>{:.17g},{:.17g},0,{:.17g},0,{:.17g}"
        "</GeoTransform>",
        right_ - left_, bottom_ - top_, gt[0] + static_cast<double>(left_) * gt[1], gt[1],
        gt[3] + static_cast<double>(top_) * gt[5], gt[5]);
    for (std::size_t k = 0; k < bands_.size(); ++k) xml += write_band(k);
    if (needs_mask()) xml += write_mask();
    return xml + "</VRTDataset>";
  }

 private:
  bool has_mask(const Tile& tile) const { return tile.has_mask(asked_.has_value()); }

  bool needs_mask() const {
    if (std::any_of(tiles_.begin(), tiles_.end(), [&](const Tile& tile) { return has_mask(tile); })) return true;
    const bool tells = tiles_.front().has_alpha() || std::all_of(bands_.begin(), bands_.end(), [](const JoinedBand& b) {
                         return b.nodata.has_value();
                       });
    return !tells && !leave_no_gap(tiles_);
  }

  /// `is_inner`: the source is write_with_nan() of the tile.
  std::string write_source(const Tile& tile, const std::string& band, GDALDataType type, const std::string& more,
                           bool is_inner = false) const {
    const char* kind = more.empty() ? "SimpleSource" : "ComplexSource";
    return fmt::format(
        "<{0}><SourceFilename relativeToVRT=\"0\">{1}</SourceFilename><SourceBand>{2}</SourceBand>"
        "<SourceProperties RasterXSize=\"{11}\" RasterYSize=\"{13}\" DataType=\"{5}\" BlockXSize=\"{6}\" "
        "BlockYSize=\"{7}\"/><SrcRect xOff=\"{12}\" yOff=\"{14}\" xSize=\"{3}\" ySize=\"{4}\"/><DstRect xOff=\"{8}\" "
        "yOff=\"{9}\" xSize=\"{3}\" ySize=\"{4}\"/>{10}</{0}>",
        kind, escape(is_inner ? write_with_nan(tile, asked_) : tile.name), band, tile.cols, tile.rows,
        GDALGetDataTypeName(type), tile.block_cols, tile.block_rows, tile.col - left_, tile.row - top_, more,
        is_inner ? tile.cols : tile.all_cols, is_inner ? 0 : tile.from_col, is_inner ? tile.rows : tile.all_rows,
        is_inner ? 0 : tile.from_row);
  }

  std::string write_band(std::size_t k) const {
    const JoinedBand& joined = bands_[k];
    std::string xml =
        fmt::format("<VRTRasterBand dataType=\"{}\" band=\"{}\">", GDALGetDataTypeName(joined.type), k + 1);
    if (joined.nodata) xml += fmt::format("<NoDataValue>{:.17g}</NoDataValue>", *joined.nodata);
    for (const Tile& tile : tiles_) {
      const BandFacts& band = tile.bands[k];
      std::string more;
      const auto nodata = nodata_of(band, asked_);
      const double raw = nodata && band.is_signed_byte && *nodata < 0 ? *nodata + 256 : nodata.value_or(0);
      // A source has one nodata value, so the requested value is first converted to NaN, like the declared one.
      const bool is_inner =
          asked_ && !std::isnan(*asked_) && band.nodata && std::isnan(*band.nodata) && tiles_.size() > 1;
      if (is_inner || (!nodata && joined.nodata && GDALDataTypeIsFloating(band.type))) more += "<NODATA>nan</NODATA>";
      if (!is_inner && nodata && holds(band.type, raw)) more += fmt::format("<NODATA>{:.17g}</NODATA>", raw);
      if (band.is_alpha) more += "<NODATA>0</NODATA>";  // an empty tile hides nothing
      if (!band.is_alpha && (has_mask(tile) || (tile.has_alpha() && !nodata)))
        more += "<UseMaskBand>true</UseMaskBand>";
      more += write_values(band, joined);
      xml += write_source(tile, fmt::format("{}", k + 1), band.type, more, is_inner);
    }
    return xml + "</VRTRasterBand>";
  }

  /// Converts the tile's values to those of the virtual raster.
  static std::string write_values(const BandFacts& band, const JoinedBand& joined) {
    const double scale = joined.is_decoded ? band.scale : 1, offset = joined.is_decoded ? band.offset : 0;
    if (band.is_signed_byte) {
      const auto at = [&](double value) { return value * scale + offset; };
      return fmt::format("<LUT>0:{:.17g},127:{:.17g},128:{:.17g},255:{:.17g}</LUT>", at(0), at(127), at(-128), at(-1));
    }
    if (scale == 1 && offset == 0) return "";
    return fmt::format("<ScaleOffset>{:.17g}</ScaleOffset><ScaleRatio>{:.17g}</ScaleRatio>", offset, scale);
  }

  std::string write_mask() const {
    std::string xml = "<MaskBand><VRTRasterBand dataType=\"Byte\">";
    for (const Tile& tile : tiles_) {
      // All cells of a tile without a mask are shown; nodata values are handled separately.
      xml += has_mask(tile) ? write_source(tile, "mask,1", GDT_Byte, "<NODATA>0</NODATA>")
                            : write_source(tile, "1", tile.bands.front().type,
                                           "<ScaleOffset>255</ScaleOffset><ScaleRatio>0</ScaleRatio>");
    }
    return xml + "</VRTRasterBand></MaskBand>";
  }

  std::span<const Tile> tiles_;
  std::optional<double> asked_;
  std::int64_t left_ = 0, top_ = 0, right_ = 0, bottom_ = 0;
  std::vector<JoinedBand> bands_;
};

}  // namespace

bool Tile::has_mask(bool asked) const {
  if ((mask_flags & (GMF_ALL_VALID | GMF_ALPHA)) != 0) return false;
  return (mask_flags & GMF_NODATA) == 0 || ((mask_flags & GMF_PER_DATASET) != 0 && !asked);
}

bool Tile::has_alpha() const {
  return std::any_of(bands.begin(), bands.end(), [](const BandFacts& band) { return band.is_alpha; });
}

Tile describe_raster(GDALDatasetH raster, const std::string& path) {
  Tile tile;
  tile.path = path;
  tile.name = GDALGetDescription(raster);
  tile.crs = crs_of(raster);
  tile.space = space_crs_of(declared_crs(raster));
  GDALGetGeoTransform(raster, tile.gt.data());
  tile.cols = tile.all_cols = GDALGetRasterXSize(raster);
  tile.rows = tile.all_rows = GDALGetRasterYSize(raster);
  for (int k = 1; k <= GDALGetRasterCount(raster); ++k) tile.bands.push_back(facts_of(GDALGetRasterBand(raster, k)));
  tile.mask_flags = GDALGetMaskFlags(GDALGetRasterBand(raster, 1));
  GDALGetBlockSize(GDALGetRasterBand(raster, 1), &tile.block_cols, &tile.block_rows);
  return tile;
}

bool can_join(GDALDataType type) {
  return type == GDT_Byte || type == GDT_Int16 || type == GDT_UInt16 || type == GDT_Int32 || type == GDT_UInt32 ||
         type == GDT_Float32 || type == GDT_Float64;
}

std::string write_with_nan(const Tile& tile, std::optional<double> nodata) {
  return Writer({&tile, 1}, nodata, true).write();
}

Result<Dataset> join_tiles(Session& session, std::span<const Tile> tiles, std::optional<double> nodata) {
  const std::string& path = tiles.front().path;
  const Writer writer(tiles, nodata, false);
  if (!writer.is_within(std::numeric_limits<int>::max())) {
    return fail(ErrorKind::kInput, fmt::format("{} and {} more lie too far apart for one mosaic: name fewer of them",
                                               path, tiles.size() - 1));
  }
  SCARP_TRY(const auto& first, open_raster(session, path));
  SCARP_TRY(auto&& joined, open_xml(session, writer.write(), path));
  repeat_said(first.get(), joined.get());
  for (std::size_t k = 0; k < writer.bands().size(); ++k) {
    GDALRasterBandH band = GDALGetRasterBand(joined.get(), static_cast<int>(k) + 1);
    GDALSetMetadataItem(band, "PIXELTYPE", nullptr, "IMAGE_STRUCTURE");
    if (writer.bands()[k].is_decoded) {
      GDALSetRasterScale(band, 1);
      GDALSetRasterOffset(band, 0);
    }
    const auto says = std::find_if(tiles.begin(), tiles.end(), [&](const Tile& t) { return !t.bands[k].unit.empty(); });
    if (says != tiles.end()) GDALSetRasterUnitType(band, says->bands[k].unit.c_str());
  }
  return open_virtual(session, joined.get(), path);
}

}  // namespace scarp::gdal
