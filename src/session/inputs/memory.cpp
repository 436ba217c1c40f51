#include "session/inputs/memory.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "session/text/text.h"

namespace scarp::cli {
namespace {

constexpr std::uint64_t kCodeBytes = 60'000'000;  // the share of the code in kProgramBytes
constexpr std::uint64_t kCacheBytes = 8'400'000;  // bytes of a file's cache besides its samples
constexpr std::uint64_t kBytesPerSample = 4;

/// Returns large blocks to the system immediately. glibc would retain more and more of them, and a budget search with
/// many runs would exceed the limit.
void give_back_early() {
#ifdef M_MMAP_THRESHOLD
  constexpr int kLarge = 1 << 16;
  mallopt(M_MMAP_THRESHOLD, kLarge);
#endif
}

/// The share of the limit for samples, after other needs.
std::uint64_t samples_share(std::uint64_t limit, std::uint64_t others) {
  return limit > kProgramBytes + others ? (limit - kProgramBytes - others) / 2 : 0;
}

/// Rounds up.
std::uint64_t megabytes(std::uint64_t bytes) { return (bytes + 999'999) / 1'000'000; }

/// The minimum memory of a run with all samples in memory.
double megabytes_in_memory(const OwnedHeightField& field, const MemoryNeeds& needs = {}) {
  const double bytes = static_cast<double>(needs.per_sample) * field.cols * field.rows;
  return std::ceil((2 * bytes + static_cast<double>(kProgramBytes + needs.others)) / 1e6) + 1;
}

}  // namespace

Result<OwnedHeightField> read_within(const std::string& path, ReadOptions options,
                                     const std::optional<std::uint64_t>& limit, const MemoryNeeds& needs) {
  if (!limit) return read_height_field(path, options);
  give_back_early();
  const std::uint64_t share = std::max<std::uint64_t>(samples_share(*limit, needs.others), 1);  // 0 would be no limit
  options.run.memory.limit = std::max<std::uint64_t>(share * kBytesPerSample / needs.per_sample, 1);
  Result<OwnedHeightField> field = open_height_field(path, options);
  if (!field || !field->source || options.run.memory.limit == share) return field;
  // A file that must be read in windows anyway may use the whole share for its cache.
  const std::uint64_t samples = static_cast<std::uint64_t>(field->cols) * static_cast<std::uint64_t>(field->rows);
  if (kBytesPerSample * samples <= share) return field;
  options.run.memory.limit = share;
  return open_height_field(path, options);
}

std::uint64_t bytes_taken(const OwnedHeightField& field, std::uint64_t limit) {
  const std::uint64_t samples = static_cast<std::uint64_t>(field.cols) * static_cast<std::uint64_t>(field.rows);
  if (!field.source) return kCodeBytes + kBytesPerSample * samples;
  if (field.source->is_in_memory()) return kCodeBytes + kBytesPerSample / 2 * samples;
  return kCodeBytes + kCacheBytes + samples_share(limit, 0);
}

Result<OwnedHeightField> read_beside(const std::string& path, ReadOptions options, std::uint64_t limit) {
  options.run.memory.limit = std::max<std::uint64_t>(samples_share(limit, 0) / 2, 1);
  return open_height_field(path, options);
}

std::uint64_t bytes_beside(const OwnedHeightField& other, const OwnedHeightField& field, std::uint64_t limit) {
  const std::uint64_t samples = static_cast<std::uint64_t>(other.cols) * static_cast<std::uint64_t>(other.rows);
  if (!other.source) return kBytesPerSample * samples;
  if (other.source->is_in_memory()) return kBytesPerSample / 2 * samples;
  const bool has_cache = field.source && !field.source->is_in_memory();
  return has_cache ? 0 : kCacheBytes + samples_share(limit, 0) / 2;
}

Result<void> check_room(const OwnedHeightField& field, std::uint64_t limit, std::uint64_t bytes,
                        const std::string& options) {
  const std::uint64_t taken = bytes_taken(field, limit);
  if (taken + bytes <= limit) return {};
  const bool has_cache = field.source && !field.source->is_in_memory();  // it may use half of the remaining memory
  const std::uint64_t needed = has_cache ? kProgramBytes + 2 * bytes : taken + bytes;
  return fail(ErrorKind::kUsage, fmt::format("{} is too little: {} takes {}M; allow {}M and what the mesh needs",
                                             OptionId::kMemory, options, megabytes(bytes), megabytes(needed)));
}

int picture_side(const OwnedHeightField& field, const MemoryShare& memory, std::uint64_t vertices) {
  constexpr int kUsualSide = 1400, kLeastSide = 100;
  constexpr std::uint64_t kBytesPerPixel = 80, kBytesPerVertex = 145;
  if (memory.limit == 0 || !field.source) return kUsualSide;
  const std::uint64_t taken = memory.taken + kBytesPerVertex * vertices;
  const std::uint64_t pixels = (std::max(memory.limit, taken) - taken) / kBytesPerPixel;
  return static_cast<int>(std::clamp(std::sqrt(static_cast<double>(pixels)), double{kLeastSide}, double{kUsualSide}));
}

Result<void> check_in_memory(const OwnedHeightField& field, const std::string& option, const MemoryNeeds& needs) {
  if (!field.source) return {};
  return fail(ErrorKind::kUsage,
              fmt::format("{} needs all samples in memory at once, and {} x {} samples are more than --memory leaves "
                          "for them: leave {} out, or allow {}M",
                          option, field.cols, field.rows, option, megabytes_in_memory(field, needs)));
}

Error name_limit(const GivenOptions& given, Error error) {
  constexpr std::string_view kLimit = "the memory limit";
  if (given.has(OptionId::kMemory) && error.message.starts_with(kLimit))
    error.message.replace(0, kLimit.size(),
                          fmt::format("{} {}", OptionId::kMemory, shell_word(*given[OptionId::kMemory])));
  return error;
}

Error name_memory(const GivenOptions& given, const OwnedHeightField& field, Error error) {
  constexpr std::string_view kWhole = "read the raster as a whole";
  if (!given.has(OptionId::kMemory)) return error;
  error = name_limit(given, std::move(error));
  if (const std::size_t at = error.message.find(kWhole); at != std::string::npos)
    error.message.replace(at, kWhole.size(),
                          fmt::format("leave --memory out, or allow {}M", megabytes_in_memory(field)));
  return error;
}

void complete_info(const HeightRange& judged, RasterInfo& info) {
  if (info.has_range) return;
  info.has_range = true;
  info.valid = judged.valid;
  info.min = judged.min;
  info.max = judged.max;
  info.undeclared_nodata =
      find_undeclared_nodata(judged, info.z_scale * info.scale, info.z_scale * info.offset + info.z_offset);
}

void complete_info(const RasterInfo& now, RasterInfo& info) {
  if (info.has_range || !now.has_range) return;
  info.has_range = true;
  info.valid = now.valid;
  info.min = now.min;
  info.max = now.max;
  info.undeclared_nodata = now.undeclared_nodata;
}

}  // namespace scarp::cli
