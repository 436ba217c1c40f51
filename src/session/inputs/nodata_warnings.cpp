#include "session/inputs/nodata_warnings.h"

#include <fmt/format.h>

#include <cmath>

#include "io/commands.h"
#include "session/options/given_options.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

/// The remedy. --nodata replaces the nodata value in use, if any (NaN is always nodata).
std::string remedy_of(const std::string& value, const std::string& kept, const RasterInfo& info) {
  if (kept.empty()) return fmt::format("give {} {}", OptionId::kNodata, value);
  const char* placeless = info.has_georeference ? "" : "-to SRC_METHOD=NO_GEOTRANSFORM -to DST_METHOD=NO_GEOTRANSFORM ";
  return fmt::format("{} accepts one value, and gdalwarp -srcnodata {} -dstnodata {} {}{} {} makes one value of both",
                     OptionId::kNodata, value, kept, placeless, io::file_word(info.path), io::new_file(".tif"));
}

}  // namespace

std::vector<std::string> warn_of_undeclared_nodata(const RasterInfo& info, const HeightField& field) {
  const auto samples = static_cast<std::uint64_t>(field.cols) * static_cast<std::uint64_t>(field.rows);
  std::vector<std::string> sentences;
  const bool has_kept = info.valid < samples && info.nodata && std::isfinite(*info.nodata);
  std::string kept = has_kept ? fmt::format("{}", *info.nodata) : "";
  for (const UndeclaredNodata& nodata : info.undeclared_nodata) {
    // The shortest text for this float32.
    const std::string height = fmt::format("{}", static_cast<float>(nodata.of.height));
    const std::string value = fmt::format("{}", static_cast<float>(nodata.value));
    const std::string remedy = remedy_of(value, kept, info);
    if (kept.empty()) kept = value;
    sentences.push_back(
        fmt::format("{} exactly {}, far {} all others ({} to {}): if {} nodata, {}",
                    nodata.of.samples == 1 ? "1 sample is" : format_count(nodata.of.samples) + " samples are", height,
                    nodata.is_high ? "above" : "below", format_number(nodata.min), format_number(nodata.max),
                    nodata.of.samples == 1 ? "it means" : "they mean", remedy));
  }
  return sentences;
}

}  // namespace scarp::cli
