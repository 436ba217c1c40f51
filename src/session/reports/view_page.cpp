#include "session/reports/view_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

#include "scarp/io.h"
#include "scarp/version.h"
#include "session/plan/page_template.h"
#include "session/reports/pictures.h"
#include "session/text/json_text.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {

/// Maximum number of samples: with more, a page opens too slowly.
constexpr std::uint64_t kMostSamples = 1 << 24;
constexpr std::int16_t kVoid = std::numeric_limits<std::int16_t>::min();

std::string encode_base64(std::span<const std::uint8_t> bytes) {
  constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    const std::size_t there = std::min<std::size_t>(3, bytes.size() - k);
    std::uint32_t group = 0;
    for (std::size_t j = 0; j < 3; ++j) group = group << 8 | (j < there ? bytes[k + j] : 0u);
    for (std::size_t j = 0; j < 4; ++j) text += j <= there ? kLetters[group >> (18 - 6 * j) & 63] : '=';
  }
  return text;
}

template <class T>
std::string encode_values(const std::vector<T>& values) {
  return encode_base64({reinterpret_cast<const std::uint8_t*>(values.data()), values.size() * sizeof(T)});
}

Result<std::vector<float>> copy_samples(const HeightField& field) {
  const std::size_t count = static_cast<std::size_t>(field.cols) * static_cast<std::size_t>(field.rows);
  if (field.source == nullptr) return std::vector<float>(field.samples, field.samples + count);
  std::vector<float> samples(count);
  SCARP_RETURN_IF_ERROR(field.source->read(0, 0, field.cols, field.rows, samples.data(), field.cols));
  return samples;
}

/// Writes 16-bit integers if all samples fit.
void add_samples(const std::vector<float>& samples, Json& json) {
  const bool are_whole = std::ranges::all_of(
      samples, [](float z) { return std::isnan(z) || (std::abs(z) <= 32767 && z == std::trunc(z)); });
  json["type"] = are_whole ? "int16" : "float32";
  if (!are_whole) {
    json["samples"] = encode_values(samples);
    return;
  }
  std::vector<std::int16_t> whole(samples.size());
  std::ranges::transform(samples, whole.begin(),
                         [](float z) { return std::isnan(z) ? kVoid : static_cast<std::int16_t>(z); });
  json["nodata"] = kVoid;
  json["samples"] = encode_values(whole);
}

/// Metres per unit of the mesh's x, y and z; null if unknown.
Json find_metres(const OwnedHeightField& field) {
  const RasterInfo& info = field.info;
  const auto& affine = field.frame.affine;
  if (!(info.cell_x_m > 0 && info.cell_y_m > 0)) return nullptr;
  if (info.unit_in_metres == 0) return nullptr;
  return Json{info.cell_x_m / std::hypot(affine[1], affine[4]), info.cell_y_m / std::hypot(affine[2], affine[5]),
              info.unit_in_metres};
}

std::optional<std::string> find_obstacle(const OwnedHeightField& field) {
  const std::uint64_t samples = static_cast<std::uint64_t>(field.cols) * static_cast<std::uint64_t>(field.rows);
  if (!field.frame.is_affine())
    return "the page holds no raster: the mesh's CRS bends the raster's grid, so that the page cannot judge it";
  if (samples > kMostSamples) {
    return fmt::format(
        "the page holds no raster: {} samples are more than the {} of a page; --resolution or --te "
        "make them fewer",
        format_count(samples), format_count(kMostSamples));
  }
  return std::nullopt;
}

}  // namespace

Result<ViewPage> make_view_page(const std::string& page_template, const std::string& path,
                                const std::vector<PageMesh>& meshes, const OwnedHeightField* field) {
  ViewPage page;
  Json data;
  data["scarp"] = version();
  data["name"] = base_name(path);
  for (const PageMesh& mesh : meshes)
    data["meshes"].push_back(
        Json{{"name", base_name(mesh.path)}, {"bytes", mesh.file_bytes}, {"glb", encode_base64(mesh.glb)}});
  data["field"] = data["metres"] = data["unit"] = nullptr;
  if (field != nullptr) page.left_out = find_obstacle(*field);
  if (field != nullptr && !page.left_out) {
    SCARP_TRY(const auto& samples, copy_samples(field->view()));
    Json& raster = data["field"];
    raster["name"] = base_name(field->info.path);
    raster["cols"] = field->cols;
    raster["rows"] = field->rows;
    raster["affine"] = field->frame.affine;
    add_samples(samples, raster);
    data["metres"] = find_metres(*field);
    data["unit"] = short_unit(field->info.unit);
  }
  // "</script" and "<!--" would end the script or begin a comment.
  std::string text = data.dump(-1, ' ', true, Json::error_handler_t::replace);
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) text.replace(at, 1, "\\u003c");
  const std::string script = "<script type=\"application/json\" id=\"scarp-data\">" + text + "</script>";
  std::string html = page_template;
  html.replace(html.find(kPlaceOfData), kPlaceOfData.size(), script);
  page.html.assign(html.begin(), html.end());
  return page;
}

}  // namespace scarp::cli
