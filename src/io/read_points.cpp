// One door for all points: the name's end, else the first bytes, say whose reader a file goes to.
#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

#include "base/caught.h"
#include "io/point_source.h"
#include "scarp/io.h"

namespace scarp {
namespace {

namespace fs = std::filesystem;

bool is_text_of_columns(const std::string& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (!fs::exists(status) || fs::is_directory(status)) return false;
  if (!fs::is_regular_file(status)) return true;  // a pipe cannot be looked into and then read by another
  std::string extension = fs::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr std::array<std::string_view, 5> kExtensions{".csv", ".tsv", ".txt", ".xyz", ".dat"};
  if (std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end()) return true;
  std::ifstream file(path, std::ios::binary);
  std::array<char, 4096> bytes{};
  file.read(bytes.data(), bytes.size());
  return looks_like_columns(
      {reinterpret_cast<const std::uint8_t*>(bytes.data()), static_cast<std::size_t>(file.gcount())});
}

}  // namespace

Result<PointSet> read_points(const std::string& path, const ReadPointsOptions& options) try {
  if (!is_text_of_columns(path)) return read_gdal_points(path, options);
  const auto bytes = read_file(path);
  if (!bytes) return tl::unexpected(bytes.error());
  return decode_columns(*bytes, path, options);
} catch (...) {
  return caught(ErrorKind::kInput, "read " + path);
}

}  // namespace scarp
