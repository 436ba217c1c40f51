// The files of a tile job: their stamps, detection of changes, and update of the job.
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/fnv.h"
#include "io/tiles/byte_source.h"
#include "scarp/io.h"
#include "scarp/tile.h"
#include "scarp/tile_job.h"
#include "tiles/mesh/tile_lines.h"

namespace scarp {
namespace {

bool has_same_drape(const TileJob& earlier, const TileJob& now) {
  return now.drape && std::ranges::equal(earlier.drape->files, now.drape->files, [](const auto& a, const auto& b) {
           return a.path == b.path && a.size == b.size && a.changed == b.changed;
         });
}

}  // namespace

std::vector<std::vector<std::string>> mosaics_of(const TileJob& job) {
  std::vector<std::vector<std::string>> mosaics;
  auto raster = job.rasters.begin();
  for (const std::uint32_t count : job.mosaics) {
    mosaics.emplace_back();
    for (std::uint32_t k = 0; k < count; ++k) mosaics.back().push_back((raster++)->path);
  }
  return mosaics;
}

FileStamp stamp_of(const std::string& path) {
  std::error_code error;
  struct stat facts {};
  if (stat(path.c_str(), &facts) != 0 || !S_ISREG(facts.st_mode)) return {path, 0, 0};
  return {std::filesystem::absolute(path, error).lexically_normal().string(), static_cast<std::uint64_t>(facts.st_size),
          std::int64_t{facts.st_mtim.tv_sec} * 1000000000 + facts.st_mtim.tv_nsec};
}

TileDrape stamp_drape(const std::string& path, ImageFormat format) {
  TileDrape drape{{stamp_of(path)}, format};
  std::set<std::string> others;
  for (const std::string& file : list_files(path)) others.insert(stamp_of(file).path);
  others.erase(drape.path());
  for (const std::string& file : others) {
    const FileStamp stamp = stamp_of(file);
    if (stamp.size > 0) drape.files.push_back(stamp);
  }
  return drape;
}

void stamp_rasters(TileJob& job, const std::vector<std::string>& paths) {
  std::set<std::string> others;
  for (const std::string& path : paths) {
    job.rasters.push_back(stamp_of(path));
    for (const std::string& file : list_files(path)) others.insert(stamp_of(file).path);
  }
  for (const FileStamp& raster : job.rasters) others.erase(raster.path);
  for (const std::string& file : others) {
    const FileStamp stamp = stamp_of(file);
    if (stamp.size > 0) job.files.push_back(stamp);
  }
}

Result<void> add_contents(TileJob& job) {
  const auto add = [](FileStamp& file) -> Result<void> {
    if (file.size == 0) return {};
    SCARP_TRY(const auto& source, io::ByteSource::open(file.path));
    constexpr std::uint64_t kAtOnce = 1 << 22;
    Fnv name;
    for (std::uint64_t at = 0; at < source->size(); at += kAtOnce) {
      SCARP_TRY(const auto& bytes, source->read(at, std::min(kAtOnce, source->size() - at)));
      name.add(bytes);
    }
    file.content = std::max<std::uint64_t>(name.hash(), 1);
    return {};
  };
  std::vector<std::vector<FileStamp>*> lists{&job.rasters, &job.files};
  if (job.drape) lists.push_back(&job.drape->files);
  for (auto* files : lists) {
    for (FileStamp& file : *files) {
      SCARP_RETURN_IF_ERROR(add(file));
    }
  }
  return job.datum.vertical == Vertical::kGeoid ? add(job.geoid) : Result<void>();
}

std::optional<std::string> find_changed(const TileJob& job) {
  std::vector<FileStamp> files = job.rasters;
  files.insert(files.end(), job.files.begin(), job.files.end());
  if (job.datum.vertical == Vertical::kGeoid) files.push_back(job.geoid);
  if (job.drape) files.insert(files.end(), job.drape->files.begin(), job.drape->files.end());
  for (const FileStamp& file : files) {
    const FileStamp now = stamp_of(file.path);
    if (now.size == file.size && now.changed == file.changed) continue;
    const bool is_gone = now.size == 0 && now.changed == 0;
    return fmt::format("{} {}", file.path,
                       is_gone ? "is not there any more" : "has changed since its tiles were planned");
  }
  return std::nullopt;
}

Result<void> check_rasters(const TileJob& job) {
  const std::optional<std::string> changed = find_changed(job);
  if (!changed) return {};
  return fail(ErrorKind::kInput, *changed + ": put it back as it was, or plan again");
}

Result<TileJob> follow_job(const TileJob& earlier, TileJob now) {
  // Coarser levels have steps at least as coarse.
  const double needed = now.plan.least_quantum, has = earlier.plan.levels.back().quantum;
  if (needed > has) {
    const char* const unit = unit_behind(now.facts.units);
    return fail(ErrorKind::kUsage,
                fmt::format("the relief of {} needs steps of {}{} where the earlier plan has {}{}: make the set anew",
                            now.rasters.front().path, needed, unit, has, unit));
  }
  if (earlier.drape && !has_same_drape(earlier, now))
    return fail(ErrorKind::kUsage, fmt::format("{} has changed since the earlier plan, and all tiles show it: make the "
                                               "set anew",
                                               earlier.drape->path()));
  TileJob job = earlier;
  job.rasters = std::move(now.rasters);
  job.files = std::move(now.files);
  job.facts = std::move(now.facts);
  job.geoid = std::move(now.geoid);
  job.costs = {};
  job.estimate = {};
  job.mosaics = std::move(now.mosaics);
  job.plan.covered = now.plan.covered;
  job.plan.waters = std::move(now.plan.waters);
  job.plan.sources = std::move(now.plan.sources);
  if (earlier.plan.lines) set_lines(job.plan, earlier.plan.lines->lines());
  return job;
}

}  // namespace scarp
