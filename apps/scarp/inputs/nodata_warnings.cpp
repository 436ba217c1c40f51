#include "inputs/nodata_warnings.h"

#include <fmt/format.h>

#include "terminal/text.h"

namespace scarp::cli {

std::vector<std::string> warn_of_undeclared_nodata(const RasterInfo& info) {
  std::vector<std::string> sentences;
  const std::vector<UndeclaredNodata>& found = info.undeclared_nodata;
  for (const UndeclaredNodata& nodata : found) {
    // As short as it can be without becoming another float32.
    const std::string value = fmt::format("{}", static_cast<float>(nodata.of.height));
    // --nodata names one value.
    const std::string remedy = &nodata == &found.front()
                                   ? "give --nodata " + value
                                   : fmt::format("gdalwarp -srcnodata {} -dstnodata {} makes one value of both", value,
                                                 static_cast<float>(found.front().of.height));
    sentences.push_back(
        fmt::format("{} exactly {}, far {} all others ({} to {}): if {} nodata, {}",
                    nodata.of.samples == 1 ? "1 sample is" : format_count(nodata.of.samples) + " samples are", value,
                    nodata.is_high ? "above" : "below", format_number(nodata.min), format_number(nodata.max),
                    nodata.of.samples == 1 ? "it means" : "they mean", remedy));
  }
  return sentences;
}

}  // namespace scarp::cli
