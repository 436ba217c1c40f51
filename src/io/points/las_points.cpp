// LAS and LAZ files as points: src/las reads them; their frame and unit are set here.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bitset>
#include <cerrno>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "io/commands.h"
#include "io/file_reason.h"
#include "io/lent.h"
#include "io/missing_file.h"
#include "io/points/point_heights.h"
#include "io/points/point_source.h"
#include "io/raster/crs_description.h"
#include "io/spool.h"
#include "las/header.h"
#include "las/read_las.h"
#include "scarp/height_field.h"
#include "scarp/io.h"

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
  bool read(std::uint64_t offset, std::span<std::uint8_t> into) const {
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

Result<PointSet> read_selected(const las::Source& source, const las::Header& header, const ReadPointsOptions& options) {
  PointSet points;
  points.path = source.name;
  points.format = header.laz ? "LAZ" : "LAS";
  if (header.points == 0) return fail(ErrorKind::kInput, source.name + ": holds no points");
  las::Selection selection = selection_of(options.choice);
  selection.extent = options.extent;
  SCARP_TRY(auto&& read,
            las::read_points(source, header, selection, {.threads = options.threads, .progress = options.progress}));
  points.x = std::move(read.x);
  points.y = std::move(read.y);
  points.z = std::move(read.z);
  points.las = facts_of(header, read.tally);
  points.outside = read.tally.outside;
  if (points.size() == 0 && points.outside == header.points) return refuse_empty_extent(points);
  if (points.size() == 0)
    return fail(ErrorKind::kInput, fmt::format("{}: none of its {} points is left: {}", source.name, header.points,
                                               describe_rest(*points.las)));
  if (options.nodata) {
    SCARP_RETURN_IF_ERROR(leave_out_nodata(*options.nodata, points));
  }
  return points;
}

}  // namespace

Result<PointSet> read_las_points(const std::string& path, const ReadPointsOptions& options) {
  SCARP_RETURN_IF_ERROR(refuse_options(path, options));
  SCARP_TRY(const auto& file, OpenFile::open(path));
  const auto read = [&](std::uint64_t offset, std::span<std::uint8_t> into) { return file.read(offset, into); };
  const las::Source source{path, file.size(), read};
  SCARP_TRY(const auto& header, las::read_header(source));
  SCARP_TRY(auto&& points, read_selected(source, header, options));
  SCARP_RETURN_IF_ERROR(place(header.crs, options, points));
  return std::move(points);
}

}  // namespace scarp::io
