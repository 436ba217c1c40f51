// LAS and LAZ files as points: src/las reads them; their frame and unit are set here.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bitset>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "grid/keep_points.h"
#include "grid/snapped_points.h"
#include "io/commands.h"
#include "io/file_reason.h"
#include "io/lent.h"
#include "io/missing_file.h"
#include "io/points/point_heights.h"
#include "io/points/point_source.h"
#include "io/points/point_spool.h"
#include "io/raster/crs_description.h"
#include "io/spool.h"
#include "las/header.h"
#include "las/read_las.h"
#include "scarp/height_field.h"
#include "scarp/io.h"
#include "scarp/points.h"

namespace scarp::io {
namespace {

/// An open file that any thread may read at any offset.
class OpenFile {
 public:
  static Result<OpenFile> open(const std::string& path) {
    SCARP_TRY(const auto& name, readable_name(path));
    OpenFile file(::open(name.c_str(), O_RDONLY | O_CLOEXEC));
    const auto cannot = [&](const std::string& why) {
      return fail(ErrorKind::kInput, fmt::format("cannot read {}: {}", path, why));
    };
    if (file.fd_ < 0) return cannot(errno == ENOENT ? "there is " + describe_missing(path) : reason_of(errno));
    struct stat status {};
    if (::fstat(file.fd_, &status) != 0) return cannot(reason_of(errno));
    file.size_ = static_cast<std::uint64_t>(status.st_size);
    return file;
  }
  OpenFile(OpenFile&& other) noexcept : fd_(std::exchange(other.fd_, -1)), size_(other.size_) {}
  OpenFile& operator=(OpenFile&&) = delete;
  ~OpenFile() {
    if (fd_ >= 0) ::close(fd_);
  }

  std::uint64_t size() const { return size_; }
  bool operator()(std::uint64_t offset, std::span<std::uint8_t> into) const {
    while (!into.empty()) {
      const ssize_t got = ::pread(fd_, into.data(), into.size(), static_cast<off_t>(offset));
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) return false;
      offset += static_cast<std::uint64_t>(got);
      into = into.subspan(static_cast<std::size_t>(got));
    }
    return true;
  }

 private:
  explicit OpenFile(int fd) : fd_(fd) {}
  int fd_;
  std::uint64_t size_ = 0;
};

las::Selection selection_of(const PointChoice& choice) {
  las::Selection selection;
  if (!choice.classes.empty()) selection.classes.reset();
  for (const std::uint8_t number : choice.classes) selection.classes.set(number);
  selection.returns = static_cast<las::Returns>(choice.returns);
  selection.has_overlap = choice.overlap;
  selection.has_withheld = choice.withheld;
  return selection;
}

LasFacts facts_of(const las::Header& header, const las::Tally& tally) {
  LasFacts facts;
  facts.version = fmt::format("1.{}", header.minor_version);
  facts.point_format = static_cast<int>(header.point_format);
  facts.points = header.points;
  for (std::size_t k = 0; k < tally.classes.size(); ++k) {
    if (tally.classes[k] > 0) facts.classes.push_back({static_cast<int>(k), tally.classes[k]});
  }
  facts.withheld = tally.withheld;
  facts.of_other_classes = tally.other_classes;
  facts.overlap = tally.overlap;
  facts.of_other_returns = tally.other_returns;
  return facts;
}

/// The reasons why a selection has no points.
std::string describe_rest(const LasFacts& facts) {
  std::string text;
  const auto add = [&](std::uint64_t count, const char* what) {
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, what);
  };
  add(facts.withheld, "withheld");
  add(facts.of_other_classes, "of other classes");
  add(facts.overlap, "in overlaps");
  add(facts.of_other_returns, "of other returns");
  std::string classes;
  for (const PointClass& of : facts.classes)
    classes += fmt::format("{}{} ({})", classes.empty() ? "" : ", ", of.number, of.points);
  return classes.empty() ? text : fmt::format("{}; its classes are {}", text, classes);
}

Result<void> refuse_options(const std::string& path, const ReadPointsOptions& options) {
  for (const auto& [option, value] : {std::pair{"--layer", &options.layer}, std::pair{"--z-field", &options.z_field},
                                      std::pair{"--columns", &options.columns}}) {
    if (!value->empty())
      return fail(ErrorKind::kUsage,
                  fmt::format("{} is for text and vector layers, and {} is a LAS file: leave it out", option, path));
  }
  return {};
}

/// The unit of heights given by GeoTIFF keys, else the unit of the vertical CRS.
HeightUnit unit_of(const las::CrsFacts& crs, const HeightUnit& vertical) {
  switch (crs.vertical_unit) {
    case 9001:
      return {"metre", 1};
    case 9002:
      return {"foot", 0.3048};
    case 9003:
      return {"US survey foot", 1200.0 / 3937};
    default:
      return vertical;
  }
}

/// Sets the CRS declared by the file, as far as this build knows it.
void note_crs(const las::CrsFacts& crs, PointSet& points) {
  points.crs = crs.definition();
  if (points.crs.empty() && crs.is_user_defined)
    points.crs = describe_geo_keys({crs.directory, crs.doubles, crs.texts});
  points.is_geographic = crs.is_degrees();
  if (crs.vertical != 0 && can_describe_crs() && !describe_crs(points.crs)) {
    las::CrsFacts flat = crs;
    flat.vertical = 0;
    points.crs = flat.definition();
  }
  const bool is_unknown = !points.crs.empty() && can_describe_crs() && !describe_crs(points.crs);
  if (!is_unknown && !(points.crs.empty() && crs.is_user_defined)) return;
  points.crs.clear();
  points.is_geographic = false;
  points.warnings.push_back(
      fmt::format("{}: its CRS{} has no code of EPSG or WKT that is known here: x and y count as "
                  "having none",
                  points.path, crs.citation.empty() ? "" : " (" + crs.citation + ")"));
}

/// Sets the frame of x and y, and the unit of the heights.
Result<void> place(const las::CrsFacts& crs, const ReadPointsOptions& options, PointSet& points) {
  note_crs(crs, points);
  const bool needs_crs = !options.crs.empty() && options.crs != "source" && options.crs != "grid";
  if (needs_crs && points.crs.empty() && !points.is_geographic)
    return fail(
        ErrorKind::kUsage,
        fmt::format("{} has no CRS, so its coordinates cannot be given in '{}': ask for 'source', or give it its "
                    "CRS first ({})",
                    points.path, options.crs, crs_command(points, "EPSG:CODE")));
  SCARP_TRY(const auto& vertical, place_lent_points(options, points));
  return settle_point_heights(options, unit_of(crs, vertical), points);
}

/// A file to read points from.
class LasFile {
 public:
  static Result<LasFile> open(const std::string& path, const ReadPointsOptions& options) {
    SCARP_RETURN_IF_ERROR(refuse_options(path, options));
    SCARP_TRY(auto&& file, OpenFile::open(path));
    LasFile las(path, std::move(file), options);
    SCARP_TRY(las.header_, las::read_header(las.source()));
    if (las.header_.points == 0) return fail(ErrorKind::kInput, path + ": holds no points");
    return las;
  }

  /// The selected points, in the coordinates of the file.
  Result<PointSet> read() const {
    SCARP_TRY(auto&& read, las::read_points(source(), header_, selection(), run()));
    SCARP_TRY(auto&& points, describe(read.tally));
    points.x = std::move(read.x);
    points.y = std::move(read.y);
    points.z = std::move(read.z);
    return std::move(points);
  }
  /// Gives them to `take` instead.
  Result<PointSet> read(const las::TakePoints& take) const {
    SCARP_TRY(const auto& tally, las::read_points(source(), header_, selection(), run(), take));
    return describe(tally);
  }
  /// Sets the frame of x and y, and the unit of the heights.
  Result<void> place(PointSet& points) const { return io::place(header_.crs, options_, points); }

 private:
  LasFile(std::string path, OpenFile file, const ReadPointsOptions& options)
      : path_(std::move(path)), file_(std::move(file)), options_(options) {}

  las::Source source() const { return {path_, file_.size(), file_}; }
  las::Selection selection() const {
    las::Selection selection = selection_of(options_.choice);
    selection.extent = options_.extent;
    return selection;
  }
  Run run() const { return {.threads = options_.threads, .progress = options_.progress}; }

  /// A set without points that has the facts about those read.
  Result<PointSet> describe(const las::Tally& tally) const {
    PointSet points;
    points.path = path_;
    points.format = header_.laz ? "LAZ" : "LAS";
    points.las = facts_of(header_, tally);
    points.outside = tally.outside;
    if (tally.used == 0 && tally.outside == header_.points) return refuse_empty_extent(points);
    if (tally.used == 0)
      return fail(ErrorKind::kInput, fmt::format("{}: none of its {} points is left: {}", path_, header_.points,
                                                 describe_rest(*points.las)));
    return points;
  }

  std::string path_;
  OpenFile file_;
  ReadPointsOptions options_;
  las::Header header_;
};

/// The least and the largest of coordinates and heights, as points.
class Extremes {
 public:
  void include(const PointSet& points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::array<double, 3> at{points.x[i], points.y[i], points.z[i]};
      for (std::size_t k = 0; k < 3; ++k) {
        if (!has_any_ || at[k] < least_[k][k]) least_[k] = at;
        if (!has_any_ || at[k] > most_[k][k]) most_[k] = at;
      }
      has_any_ = true;
    }
  }
  void add_to(PointSet& points) const {
    for (const auto& ends : {least_, most_}) {
      for (const auto& [x, y, z] : ends) {
        points.x.push_back(x);
        points.y.push_back(y);
        points.z.push_back(z);
      }
    }
  }
  bool has_any() const { return has_any_; }

 private:
  bool has_any_ = false;
  std::array<std::array<double, 3>, 3> least_{}, most_{};
};

/// The points that count at their places.
PointSet pick_places(const PointSet& points, const grid::SnappedPoints& snapped) {
  PointSet picked;
  const auto add = [&](std::uint32_t source, double z) {
    picked.x.push_back(points.x[source]);
    picked.y.push_back(points.y[source]);
    picked.z.push_back(z);
  };
  for (std::size_t i = 0; i < snapped.size(); ++i) add(snapped.source[i], snapped.z[i]);
  for (const grid::Echo& echo : snapped.echoes) add(echo.source, echo.z);
  return picked;
}

/// Reads all files into one spool, in the coordinates of the files. Returns the facts about them as of one set.
Result<PointSet> fill(std::span<const LasFile> files, PointSpool& spool) {
  PointSet all;
  for (const LasFile& file : files) {
    std::vector<double> first;
    SCARP_TRY(auto&& facts, file.read([&](const las::Points& part) -> Result<void> {
      if (first.empty() && !part.x.empty()) first = {part.x[0], part.y[0], part.z[0]};
      return spool.add(part.x, part.y, part.z);
    }));
    facts.x = {first[0]};
    facts.y = {first[1]};
    facts.z = {first[2]};
    SCARP_RETURN_IF_ERROR(file.place(facts));
    if (facts.is_local)
      return fail(ErrorKind::kUsage,
                  fmt::format("{}: with --memory, x and y cannot become metres around the middle of all points: ask "
                              "for --crs source, or for a CRS such as EPSG:32633",
                              facts.path));
    if (all.size() == 0) {
      all = std::move(facts);
    } else {
      SCARP_RETURN_IF_ERROR(append_points(facts, all));
    }
  }
  return all;
}

}  // namespace

Result<PointSet> read_las_points(const std::string& path, const ReadPointsOptions& options) {
  SCARP_TRY(const auto& file, LasFile::open(path, options));
  SCARP_TRY(auto&& points, file.read());
  if (options.nodata) {
    SCARP_RETURN_IF_ERROR(leave_out_nodata(*options.nodata, points));
  }
  SCARP_RETURN_IF_ERROR(file.place(points));
  return std::move(points);
}

Result<SpooledPoints> spool_las_points(std::span<const std::string> paths, const ReadPointsOptions& options,
                                       DuplicatePolicy duplicates, std::uint64_t most_in_block) {
  std::vector<LasFile> files;
  for (const std::string& path : paths) {
    SCARP_TRY(auto&& file, LasFile::open(path, options));
    files.push_back(std::move(file));
  }
  auto spool = std::make_unique<PointSpool>();
  SpooledPoints result;
  SCARP_TRY(result.facts, fill(files, *spool));
  SCARP_RETURN_IF_ERROR(spool->divide(most_in_block));
  Extremes extremes;
  for (std::size_t i = 0; i < spool->block_count(); ++i) {
    if (options.progress &&
        !options.progress({"sort", static_cast<double>(i) / static_cast<double>(spool->block_count()), 0, 0}))
      return fail(ErrorKind::kCancelled, "cancelled while sorting the points");
    SCARP_TRY(auto&& block, spool->read(i));
    block.path = result.facts.path;
    if (options.nodata) {
      const std::size_t given = block.size();
      grid::keep_points(block,
                        [&](std::size_t k) { return std::isfinite(block.z[k]) && block.z[k] != *options.nodata; });
      result.facts.without_height += given - block.size();
    }
    if (block.size() > 0) {
      SCARP_RETURN_IF_ERROR(files.front().place(block));
      SCARP_TRY(const auto& snapped, grid::snap_points(block, duplicates, grid::PointSteps::kJudge));
      result.duplicates += snapped.duplicates;
      block = pick_places(block, snapped);
      extremes.include(block);
    }
    SCARP_RETURN_IF_ERROR(spool->replace(i, block));
  }
  if (!extremes.has_any()) return refuse_no_heights(result.facts);
  for (auto* const values : {&result.facts.x, &result.facts.y, &result.facts.z}) values->clear();
  extremes.add_to(result.facts);
  result.blocks = std::move(spool);
  return result;
}

}  // namespace scarp::io
