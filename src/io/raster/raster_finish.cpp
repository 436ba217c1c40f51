#include "io/raster/raster_finish.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>

#include "base/large_vector.h"
#include "grid/height_range.h"
#include "grid/local_frame.h"
#include "io/commands.h"

namespace scarp::io {

std::string format_memory(double bytes) {
  constexpr const char* kUnits[] = {"KiB", "MiB", "GiB", "TiB", "PiB", "EiB"};
  double value = bytes / 1024;
  std::size_t unit = 0;
  while (value >= 1024 && unit + 1 < std::size(kUnits)) {
    value /= 1024;
    ++unit;
  }
  return fmt::format("{:.1f} {}", value, kUnits[unit]);
}

Result<void> check_raster_sides(const std::string& name, std::uint64_t cols, std::uint64_t rows) {
  constexpr std::uint64_t kLargestSide = 0x7fffffff;
  if (cols < 2 || rows < 2) {
    return fail(
        ErrorKind::kInput,
        fmt::format("{}: {} x {} samples are no surface: a height field needs at least 2 x 2", name, cols, rows));
  }
  if (cols > kLargestSide || rows > kLargestSide) {
    return fail(ErrorKind::kInput,
                fmt::format("{}: {} x {} samples: a side may have at most {}", name, cols, rows, kLargestSide));
  }
  return {};
}

Result<void> check_raster_size(const std::string& name, std::uint64_t cols, std::uint64_t rows,
                               const ReadOptions& options, std::uint64_t bands) {
  SCARP_RETURN_IF_ERROR(check_raster_sides(name, cols, rows));
  const std::uint64_t limit = max_samples(options.run.memory.limit);
  if (cols * rows > limit / bands) {
    return fail(
        ErrorKind::kInput,
        fmt::format("{}: {} x {} samples{} need {} of memory, but only {} {}; read a part of it ({}) or a coarser copy "
                    "({})",
                    name, cols, rows, bands > 1 ? fmt::format(" of {} bands", bands) : "",
                    format_memory(5.0 * static_cast<double>(cols * rows) * static_cast<double>(bands)),
                    format_memory(5.0 * static_cast<double>(limit)),
                    options.run.memory.limit != 0 ? "are allowed" : "are available",
                    translate_command("-srcwin COLUMN ROW COLUMNS ROWS", name),
                    translate_command("-r average -outsize COLUMNS 0", name)));
  }
  return {};
}

Result<void> allocate_samples(const std::string& name, OwnedHeightField& field, int threads) {
  const auto count = static_cast<std::size_t>(field.cols) * static_cast<std::size_t>(field.rows);
  try {
    field.samples.clear();
    resize_large(field.samples, count, threads);
  } catch (const std::exception&) {
    return fail(ErrorKind::kInput,
                fmt::format("{}: the machine refuses the {} of memory that {} x {} samples need", name,
                            format_memory(4.0 * static_cast<double>(count)), field.cols, field.rows));
  }
  return {};
}

Result<void> finish_raster(OwnedHeightField& field, std::uint64_t infinities, const ReadOptions& options) {
  grid::set_range(height_range(field, options.run.threads), field.info);
  return finish_info(field, infinities, options);
}

namespace {

std::string count_beyond(std::uint64_t infinities) {
  return infinities == 1 ? "1 is infinite or" : fmt::format("{} are infinite or", infinities);
}

}  // namespace

Result<void> finish_info(OwnedHeightField& field, std::uint64_t infinities, const ReadOptions& options) {
  if (options.as_values) {
    if (infinities > 0) {
      field.info.warnings.push_back(
          fmt::format("{}: {} infinite or too large for a float32 and taken as no value", field.info.path,
                      infinities == 1 ? "1 value is" : fmt::format("{} values are", infinities)));
    }
    return {};
  }
  if (infinities > 0) {
    field.info.warnings.push_back(fmt::format("{} {} infinite or too large for a height and taken as nodata",
                                              infinities, infinities == 1 ? "sample is" : "samples are"));
  }
  if (field.info.valid == 0 && infinities > 0) {
    return fail(ErrorKind::kInput,
                fmt::format("{}: none of its {} x {} samples is a height: {} beyond what a float32 holds (3.4e38), so "
                            "give them in a larger unit first{}",
                            field.info.path, field.cols, field.rows, count_beyond(infinities),
                            field.info.format == "memory"
                                ? ""
                                : " (" + translate_command("-ot Float64 -scale 0 1e10 0 1", field.info.path) + ")"));
  }
  if (field.info.valid == 0) {
    return fail(ErrorKind::kInput, fmt::format("{}: none of its {} x {} samples is a height: all are nodata",
                                               field.info.path, field.cols, field.rows));
  }
  return {};
}

bool scales_heights(const ReadOptions& options) { return options.z_scale != 1 || options.z_offset != 0; }

void scale_values(const ReadOptions& options, OwnedHeightField& field) {
  if (!scales_heights(options)) return;
  for (float& z : field.samples) {
    const double scaled = options.z_scale * static_cast<double>(z) + options.z_offset;
    z = static_cast<float>(scaled);
    if (std::isfinite(z)) field.sample_rounding = std::max(field.sample_rounding, std::abs(scaled - double{z}));
  }
}

bool looks_like_degrees(const std::array<double, 6>& gt, int cols, int rows) {
  if (std::hypot(gt[1], gt[4]) > 0.1) return false;
  const double x = gt[0] + gt[1] * cols, y = gt[3] + gt[5] * rows;
  return std::abs(gt[0]) <= 360 && std::abs(x) <= 360 && std::abs(gt[3]) <= 90.1 && std::abs(y) <= 90.1 && gt[0] != 0 &&
         gt[3] != 0;
}

Result<Frame> grid_or_cells(const std::string& name, int cols, int rows, const ReadOptions& options) {
  if (!options.cell_size && options.crs != "local") return grid_frame(rows);
  auto frame = grid::cell_frame(options.cell_size.value_or(1), cols, rows);
  if (!frame) return fail(frame.error().kind, name + ": " + frame.error().message);
  return frame;
}

Result<Frame> ungeoreferenced_frame(const std::string& name, int cols, int rows, const ReadOptions& options) {
  const std::string& crs = options.crs;
  if (crs.empty() || crs == "grid" || crs == "local") return grid_or_cells(name, cols, rows, options);
  return fail(
      ErrorKind::kUsage,
      fmt::format("{} has no georeference, so its coordinates cannot be given in '{}': ask for 'grid' or 'local', or "
                  "give the raster a CRS and a position first ({})",
                  name, crs, translate_command("-a_srs EPSG:CODE -a_ullr WEST NORTH EAST SOUTH", name)));
}

Result<Frame> bare_grid_frame(const std::string& name, const char* kind, int cols, int rows,
                              const ReadOptions& options) {
  SCARP_TRY(auto&& frame, ungeoreferenced_frame(name, cols, rows, options));
  if (options.band != 1)
    return fail(ErrorKind::kInput, fmt::format("{} has 1 band; there is no band {}", name, options.band));
  if (options.decode != Decode::kNone) {
    return fail(ErrorKind::kInput,
                fmt::format("{}: heights packed into colours need 3 or 4 bands of bytes; {} has one band", name, kind));
  }
  return frame;
}

}  // namespace scarp::io
