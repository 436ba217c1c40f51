#include "paper/fields.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <utility>

#include "paper/figures.h"
#include "scarp/io.h"

namespace scarp::paper {
namespace {

namespace fs = std::filesystem;

constexpr std::array kExtensions{"stm", "pgm", "tif", "tiff", "asc", "dem", "hgt", "img"};
constexpr std::uint64_t kMostSamples = 4'000'000;

Result<Field> read_field(const std::string& path, const std::string& key) {
  Field field{key, fs::path(path).filename().string(), {}};
  ReadOptions options;
  options.crs = "grid";
  SCARP_TRY(field.heights, read_height_field(path, options));
  return field;
}

/// All files with the extension of a raster, by name.
Result<std::vector<fs::path>> list_rasters(const std::string& folder) {
  std::error_code error;
  std::vector<fs::path> paths;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    std::string extension = entry->path().extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const auto is_extension = [&](const char* known) { return extension == std::string(".") + known; };
    if (std::any_of(kExtensions.begin(), kExtensions.end(), is_extension)) paths.push_back(entry->path());
  }
  if (error) {
    return fail(ErrorKind::kInput, fmt::format("the folder {} cannot be read: {}", folder, error.message()));
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

}  // namespace

std::uint64_t Field::share(double percent) const {
  return static_cast<std::uint64_t>(std::llround(percent / 100 * static_cast<double>(samples())));
}

std::string find_file(const std::string& folder, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    std::error_code error;
    const fs::path path = fs::path(folder) / name;
    if (fs::is_regular_file(path, error)) return path.string();
  }
  return {};
}

Result<Fields> read_fields(const std::string& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    return fail(ErrorKind::kInput, fmt::format("--data {} is not a folder", folder));
  }
  Fields fields;
  for (const std::string key : kReportFields) {
    std::vector<std::string> names;
    for (const char* extension : kExtensions) {
      for (const char* prefix : {"scape_", ""}) names.push_back(fmt::format("{}{}.{}", prefix, key, extension));
    }
    const std::string path = find_file(folder, names);
    if (path.empty()) continue;
    SCARP_TRY(Field field, read_field(path, key));
    fields.all.push_back(std::move(field));
  }
  fields.are_of_paper = !fields.all.empty();
  if (fields.are_of_paper) return fields;

  SCARP_TRY(const std::vector<fs::path>& paths, list_rasters(folder));
  for (const fs::path& path : paths) {
    SCARP_TRY(Field field, read_field(path.string(), path.stem().string()));
    if (field.heights.info.valid < field.samples()) {
      fields.left_out.push_back(field.file + " has missing samples");
    } else if (field.samples() > kMostSamples) {
      fields.left_out.push_back(fmt::format("{} has more than {} samples", field.file, kMostSamples));
    } else {
      fields.all.push_back(std::move(field));
    }
  }
  if (fields.all.empty()) {
    return fail(ErrorKind::kInput,
                fmt::format("--data {} holds no raster without missing samples and of at most {} samples", folder,
                            kMostSamples));
  }
  return fields;
}

}  // namespace scarp::paper
