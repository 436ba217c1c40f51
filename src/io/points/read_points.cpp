// The common entry for points. The extension, or else the first bytes, select a file's reader.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <span>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/caught.h"
#include "grid/height_range.h"
#include "io/kinds.h"
#include "io/lent.h"
#include "io/mesh/formats.h"
#include "io/mesh/mesh_file_text.h"
#include "io/points/landxml.h"
#include "io/points/point_heights.h"
#include "io/points/point_source.h"
#include "io/raster/crs_description.h"
#include "io/spool.h"
#include "scarp/height_field.h"
#include "scarp/io.h"
#include "scarp/points.h"

namespace scarp {
namespace {

namespace fs = std::filesystem;

/// The extension with its dot, in lower case.
std::string extension_of(const std::string& path) { return io::lowered(fs::path(path).extension().string()); }

template <std::size_t N>
bool is_one_of(const std::string& extension, const std::array<std::string_view, N>& list) {
  return std::find(list.begin(), list.end(), extension) != list.end();
}

std::vector<std::uint8_t> read_head(const std::string& path) {
  const auto name = io::readable_name(path);
  std::ifstream file(name ? *name : path, std::ios::binary);
  std::array<char, 4096> bytes{};
  file.read(bytes.data(), bytes.size());
  return {bytes.begin(), bytes.begin() + file.gcount()};
}

/// True for text other than JSON and XML.
bool is_plain_text(std::span<const std::uint8_t> head) {
  const auto is_word = [](std::uint8_t c) { return c >= 0x20 || std::isspace(c) != 0; };
  const auto first = std::find_if(head.begin(), head.end(), [](std::uint8_t c) { return std::isspace(c) == 0; });
  return first != head.end() && *first != '{' && *first != '<' && std::all_of(head.begin(), head.end(), is_word);
}

}  // namespace

bool io::is_text_of_columns(const std::string& path) {
  std::error_code ignored;
  const auto name = readable_name(path);
  const fs::file_status status = fs::status(name ? *name : path, ignored);
  if (!fs::exists(status) || fs::is_directory(status)) return false;
  if (!fs::is_regular_file(status)) return true;  // a device cannot be read twice
  constexpr std::array<std::string_view, 5> kText{".csv", ".tsv", ".txt", ".xyz", ".dat"};
  const std::vector<std::uint8_t> head = read_head(path);
  if (is_one_of(extension_of(path), kText) || (is_plain_text(head) && looks_like_columns(head))) return true;
  const bool is_copy = name && *name != path;  // copy of a pipe; the pipe's name shows nothing
  return is_copy && is_plain_text(head);
}

bool io::holds_plain_text(const std::string& path) { return is_plain_text(read_head(path)); }

bool io::begins_as_grid(const std::string& path) {
  std::string word;
  for (const std::uint8_t c : read_head(path)) {
    if (std::isspace(c) != 0 && word.empty()) continue;
    if (std::isalpha(c) == 0) break;
    word += static_cast<char>(std::tolower(c));
  }
  return word == "ncols" || word == "nrows" || word == "dsaa";
}

namespace {

bool begins_landxml(std::span<const std::uint8_t> head) {
  const std::string_view text(reinterpret_cast<const char*>(head.data()), head.size());
  return (text.starts_with('<') || text.starts_with("\xEF\xBB\xBF<")) && text.find("LandXML") != text.npos;
}

/// LandXML or DXF, which hold points, lines or meshes.
std::optional<MeshFormat> find_drawing(const std::string& path) {
  const std::vector<std::uint8_t> head = read_head(path);
  if (begins_landxml(head)) return MeshFormat::kLandXml;
  const auto format = io::recognise_mesh(head, path);
  return format == MeshFormat::kLandXml || format == MeshFormat::kDxf ? format : std::nullopt;
}

/// REQUIRES: a drawing.
bool has_triangles(const std::string& path) {
  const auto bytes = read_file(path);
  if (!bytes) return false;
  const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  return text.find("<Faces") != text.npos || text.find("3DFACE") != text.npos;
}

}  // namespace

bool io::is_landxml(const std::string& path) { return begins_landxml(read_head(path)); }

std::string io::projection_path(const std::string& path) { return fs::path(path).replace_extension(".prj").string(); }

namespace {

/// The LAS and LAZ files of a folder, by name; none for other paths and for folders with rasters.
std::vector<std::string> las_files_in(const std::string& path) {
  std::vector<std::string> files, others;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(path, ignored)) {
    const std::string name = entry.path().string(), extension = extension_of(name);
    (extension == ".las" || extension == ".laz" ? files : others).push_back(name);
  }
  if (!files.empty() && std::any_of(others.begin(), others.end(), io::opens_as_raster)) return {};
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

bool is_point_file(const std::string& path) {
  constexpr std::array<std::string_view, 9> kPoints{".las", ".laz", ".geojson", ".geojsonl", ".shp",
                                                    ".fgb", ".gml", ".kml",     ".parquet"};
  const std::string extension = extension_of(path);
  constexpr std::array<std::string_view, 3> kDrawings{".dxf", ".xml", ".landxml"};
  constexpr std::array<std::string_view, 3> kText{".csv", ".tsv", ".xyz"}, kEither{".txt", ".dat", ".gpkg"};
  if (is_one_of(extension, kText)) return !io::is_text_grid(path);
  if (is_one_of(extension, kEither)) return !io::begins_as_grid(path) && !io::opens_as_raster(path);
  if (!las_files_in(path).empty()) return true;
  if (is_one_of(extension, kDrawings)) return find_drawing(path) && !has_triangles(path);
  return is_one_of(extension, kPoints);
}

namespace {

/// True if the first bytes show LAS, or an existing file is named .las or .laz.
bool is_las(const std::string& path) {
  const std::vector<std::uint8_t> head = read_head(path);
  const std::string_view text(reinterpret_cast<const char*>(head.data()), head.size());
  const std::string extension = extension_of(path);
  return text.starts_with("LASF") || ((extension == ".las" || extension == ".laz") && fs::exists(path));
}

}  // namespace

Result<std::string> io::read_declared_crs(const std::string& path) {
  std::error_code ignored;
  std::string file = projection_path(path);
  if (!fs::exists(file, ignored)) file = fs::path(path).replace_extension(".PRJ").string();
  if (!fs::is_regular_file(path, ignored) || !fs::is_regular_file(file, ignored)) return std::string();
  SCARP_TRY(const auto& bytes, read_file(file));
  std::string text(bytes.begin(), bytes.end());
  text.erase(0, text.find_first_not_of(" \t\r\n"));
  text.erase(text.find_last_not_of(" \t\r\n") + 1);
  if (text.empty() || (can_describe_crs() && !describe_crs(text)))
    return fail(ErrorKind::kInput,
                file + ": declares no CRS that is known here: write WKT into it, or a code such as EPSG:32633");
  return text;
}

namespace {

Result<PointSet> read_by_content(const std::string& path, const ReadPointsOptions& options) {
  if (is_las(path)) return io::read_las_points(path, options);
  if (options.choice != PointChoice())
    return fail(ErrorKind::kUsage,
                path + ": classes and returns of points are those of LAS and LAZ files, and this is none: omit them");
  const auto drawing = find_drawing(path);
  if (drawing == MeshFormat::kDxf || (!drawing && !io::is_text_of_columns(path)))
    return io::read_gdal_points(path, options);
  SCARP_TRY(const std::string& crs, io::read_declared_crs(path));
  SCARP_TRY(const auto& bytes, read_file(path));
  if (drawing) return io::read_landxml_points(bytes, path, options, crs);
  const std::string_view head(reinterpret_cast<const char*>(bytes.data()), std::min<std::size_t>(bytes.size(), 4096));
  if (const std::string kind = io::describe_kind(path, head, bytes.size(), false); !kind.empty())
    return fail(ErrorKind::kInput, fmt::format("{}: {}", path, kind));
  return io::decode_columns(bytes, path, options, crs);
}

Result<PointSet> read_files(const std::string& path, const ReadPointsOptions& options) {
  const std::vector<std::string> files = las_files_in(path);
  if (files.empty()) return read_by_content(path, options);
  SCARP_TRY(PointSet points, read_by_content(files.front(), options));
  for (std::size_t k = 1; k < files.size(); ++k) {
    SCARP_TRY(const PointSet& more, read_by_content(files[k], options));
    SCARP_RETURN_IF_ERROR(append_points(more, points));
  }
  points.path = path;
  return points;
}

/// Warns of heights that most likely represent missing heights. GDAL reads height 0 for a vertex without a third
/// coordinate if other vertices of its geometry have one.
void warn_of_missing_heights(PointSet& points) {
  std::vector<float> heights;
  heights.reserve(points.size());
  std::copy_if(points.z.begin(), points.z.end(), std::back_inserter(heights),
               [](double z) { return std::abs(z) <= std::numeric_limits<float>::max(); });
  for (const UndeclaredNodata& missing :
       find_undeclared_nodata(grid::range_of(heights), points.heights.z_scale, points.heights.z_offset)) {
    const bool is_one = missing.of.samples == 1;
    points.warnings.push_back(fmt::format(
        "{}: {} exactly the height {}, far {} all others ({:.6g} to {:.6g}): if {} none, --nodata {} leaves {} out",
        points.path, is_one ? "1 point has" : fmt::format("{} points have", missing.of.samples),
        static_cast<float>(missing.of.height), missing.is_high ? "above" : "below", missing.min, missing.max,
        is_one ? "it has" : "they have", static_cast<float>(missing.value), is_one ? "it" : "them"));
  }
}

/// Warns of points at the place farthest from all other points, if the extent of the others is tiny compared with the
/// distance. Points without coordinates usually lie at 0, 0.
void warn_of_far_points(PointSet& points) {
  if (points.size() < 4) return;
  const auto middle = [](std::vector<double> values) {
    const auto half = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), half, values.end());
    return *half;
  };
  const double x = middle(points.x), y = middle(points.y);
  const auto way = [&](std::size_t i) { return std::max(std::abs(points.x[i] - x), std::abs(points.y[i] - y)); };
  std::size_t far = 0;
  for (std::size_t i = 1; i < points.size(); ++i) far = way(i) > way(far) ? i : far;
  const auto is_far = [&](std::size_t i) { return points.x[i] == points.x[far] && points.y[i] == points.y[far]; };
  std::size_t count = 0;
  double size = 0;  // half the extent of the others
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (is_far(i))
      ++count;
    else
      size = std::max(size, way(i));
  }
  const bool is_origin = points.x[far] == 0 && points.y[far] == 0;
  const double least = 2 * size * (is_origin ? 5 : 100);
  if (size == 0 || !(way(far) > least) || count * 4 > points.size()) return;
  points.warnings.push_back(
      fmt::format("{}: {} at {:.9g}, {:.9g} (point {}, counted from 0), {:.6g} away from where all others lie, within "
                  "{:.6g}: remove {} "
                  "if that is no place of the survey",
                  points.path, count == 1 ? "1 point lies" : fmt::format("{} points lie", count), points.x[far],
                  points.y[far], far, way(far), 2 * size, count == 1 ? "it" : "them"));
}

}  // namespace

Result<SpooledPoints> spool_points(std::span<const std::string> paths, const ReadPointsOptions& options,
                                   DuplicatePolicy duplicates, std::uint64_t most_in_block) try {
  std::vector<std::string> files;
  for (const std::string& path : paths) {
    std::vector<std::string> of_folder = las_files_in(path);
    if (of_folder.empty()) of_folder = {path};
    for (std::string& file : of_folder) {
      if (!is_las(file))
        return fail(ErrorKind::kUsage,
                    file + ": only points of LAS and LAZ files are read in parts: leave --memory out");
      files.push_back(std::move(file));
    }
  }
  SCARP_TRY(auto&& spooled, io::spool_las_points(files, options, duplicates, most_in_block));
  spooled.facts.path = paths.front();
  return std::move(spooled);
} catch (...) {
  return caught(ErrorKind::kInput, "read " + (paths.empty() ? "no points" : paths.front()));
}

Result<PointSet> read_points(const std::string& path, const ReadPointsOptions& options) try {
  const PointSet* const lent = io::find_lent_points(path);
  auto points = lent != nullptr ? io::read_lent_points(*lent, path, options) : read_files(path, options);
  if (points) warn_of_missing_heights(*points);
  if (points) warn_of_far_points(*points);
  return points;
} catch (...) {
  return caught(ErrorKind::kInput, "read " + path);
}

}  // namespace scarp
