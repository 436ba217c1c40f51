#include "las/read_las.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "base/parallel.h"
#include "base/reporter.h"
#include "las/chunk_decoder.h"
#include "las/decimal_axis.h"
#include "las/laz_record.h"
#include "las/point.h"

namespace scarp::las {
namespace {

/// Size of a chunk of a LAS file: about a megabyte.
constexpr std::uint64_t kChunkRecords = 32768;

class Chooser {
 public:
  Chooser(const Header& header, const Selection& selection)
      : selection_(selection),
        axes_{DecimalAxis(header.scale[0], header.offset[0]), DecimalAxis(header.scale[1], header.offset[1]),
              DecimalAxis(header.scale[2], header.offset[2])} {}

  void add(std::span<const LasPoint> points, Points& into) const {
    for (const LasPoint& point : points) {
      const double x = axes_[0](point.x), y = axes_[1](point.y);
      std::uint64_t& count = is_outside(x, y) ? into.tally.outside : reason(point, into.tally);
      ++count;
      if (&count != &into.tally.used) continue;
      into.x.push_back(x);
      into.y.push_back(y);
      into.z.push_back(axes_[2](point.z));
    }
  }

 private:
  bool is_outside(double x, double y) const {
    if (!selection_.extent) return false;
    const auto& [west, south, east, north] = *selection_.extent;
    return !(x >= west && x <= east && y >= south && y <= north);
  }
  /// The count for a point inside the extent.
  std::uint64_t& reason(const LasPoint& point, Tally& tally) const {
    if (point.is_withheld && !selection_.has_withheld) return tally.withheld;
    ++tally.classes[point.number];
    if (!selection_.classes[point.number]) return tally.other_classes;
    if (point.is_overlap && !selection_.has_overlap) return tally.overlap;
    if (!is_wanted_return(point)) return tally.other_returns;
    return tally.used;
  }
  /// Files without numbers of returns have return 0 of 0, which counts as an only return.
  bool is_wanted_return(const LasPoint& point) const {
    switch (selection_.returns) {
      case Returns::kAll:
        return true;
      case Returns::kFirst:
        return point.return_number <= 1;
      case Returns::kLast:
        return point.return_number >= point.return_count;
      case Returns::kOnly:
        return point.return_count <= 1;
    }
    return true;
  }

  const Selection& selection_;
  std::array<DecimalAxis, 3> axes_;
};

/// Divides a file with uncompressed points into chunks.
std::vector<LazChunk> cut_records(const Header& header) {
  std::vector<LazChunk> chunks;
  for (std::uint64_t first = 0; first < header.points; first += kChunkRecords) {
    const std::uint64_t count = std::min(kChunkRecords, header.points - first);
    chunks.push_back({header.points_offset + first * header.record_bytes, count * header.record_bytes, count});
  }
  return chunks;
}

class RecordDecoder final : public ChunkDecoder {
 public:
  explicit RecordDecoder(const Header& header)
      : record_bytes_(header.record_bytes), is_extended_(is_extended(header.point_format)) {}

  bool decode(std::span<const std::uint8_t> bytes, std::uint64_t count, EmitPoints emit) override {
    std::array<LasPoint, 1024> points;
    const std::uint8_t* record = bytes.data();
    for (std::uint64_t first = 0; first < count; first += points.size()) {
      const std::size_t size = std::min<std::uint64_t>(points.size(), count - first);
      for (std::size_t k = 0; k < size; ++k, record += record_bytes_) points[k] = decode_record(record, is_extended_);
      emit(std::span(points).first(size));
    }
    return true;
  }

 private:
  std::size_t record_bytes_;
  bool is_extended_;
};

std::unique_ptr<ChunkDecoder> make_decoder(const Header& header) {
  if (!header.laz) return std::make_unique<RecordDecoder>(header);
  return header.laz->is_layered ? make_layered_decoder(*header.laz) : make_pointwise_decoder(*header.laz);
}

/// Memory that a thread reuses from chunk to chunk.
struct Worker {
  std::unique_ptr<ChunkDecoder> decoder;
  std::vector<std::uint8_t> bytes;
};

class PointReader {
 public:
  PointReader(const Source& source, const Header& header, const Selection& selection, const Run& run,
              const TakePoints& take)
      : source_(source),
        header_(header),
        selection_(selection),
        chooser_(header, selection),
        run_(run),
        take_(take),
        reporter_(run.progress) {}

  Result<Points> read() {
    if (header_.laz) {
      SCARP_TRY(chunks_, read_chunk_table(source_, *header_.laz, header_.points_offset, header_.points));
    } else {
      chunks_ = cut_records(header_);
    }
    if (selection_.extent) leave_out_chunks(find_chunks_outside(source_, header_, *selection_.extent));
    std::uint64_t bytes = 0;
    for (const LazChunk& chunk : chunks_) bytes += chunk.bytes;
    if (!take_) reserve(header_.points, bytes, points_);
    workers_.resize(static_cast<std::size_t>(thread_count(run_.threads)));
    parts_.resize(chunks_.size());
    parallel_in_order(
        chunks_.size(), run_.threads, [&](std::size_t i, std::size_t worker) { decode(i, workers_[worker]); },
        [&](std::size_t i) { return append(i); });
    if (!fault_.empty()) return fail(ErrorKind::kInput, fmt::format("{}: {}", source_.name, fault_));
    SCARP_RETURN_IF_ERROR(taken_);
    if (is_cancelled_) return fail(ErrorKind::kCancelled, "cancelled while reading " + source_.name);
    return std::move(points_);
  }

 private:
  struct Part {
    Points points;
    std::string fault;
  };

  void leave_out_chunks(const std::unordered_set<std::uint64_t>& offsets) {
    std::erase_if(chunks_, [&](const LazChunk& chunk) {
      if (!offsets.contains(chunk.offset)) return false;
      points_.tally.outside += chunk.points;
      return true;
    });
  }

  /// Reserves at most one point per byte: fewer bytes per point are rare, and the header's number of points may be
  /// false.
  static void reserve(std::uint64_t count, std::uint64_t bytes, Points& points) {
    for (auto* values : {&points.x, &points.y, &points.z}) values->reserve(std::min(count, bytes));
  }

  void decode(std::size_t i, Worker& worker) {
    if (!worker.decoder) worker.decoder = make_decoder(header_);
    const LazChunk& chunk = chunks_[i];
    Part part;
    reserve(chunk.points, chunk.bytes, part.points);
    worker.bytes.resize(chunk.bytes);
    if (!source_.read(chunk.offset, worker.bytes)) {
      part.fault = fmt::format("{} bytes from byte {} on cannot be read", chunk.bytes, chunk.offset);
    } else if (!worker.decoder->decode(worker.bytes, chunk.points,
                                       [&](std::span<const LasPoint> points) { chooser_.add(points, part.points); })) {
      part.fault = fmt::format("chunk {}, at byte {}, ends before its {} points do: the file is damaged", i,
                               chunk.offset, chunk.points);
    }
    parts_[i] = std::make_unique<Part>(std::move(part));
  }

  bool append(std::size_t i) {
    const std::unique_ptr<Part> part = std::move(parts_[i]);
    if (!part->fault.empty()) {
      fault_ = part->fault;
      return false;
    }
    points_.tally.add(part->points.tally);
    if (take_) {
      taken_ = take_(part->points);
      return taken_ && report(i);
    }
    const auto add = [](std::vector<double>& all, std::vector<double>& more) {
      if (all.capacity() == 0) {
        all = std::move(more);
      } else {
        all.insert(all.end(), more.begin(), more.end());
      }
    };
    add(points_.x, part->points.x);
    add(points_.y, part->points.y);
    add(points_.z, part->points.z);
    return report(i);
  }

  /// False if the caller wants to stop.
  bool report(std::size_t i) {
    if (!reporter_.due()) return true;
    is_cancelled_ = !reporter_.report("read", static_cast<double>(i + 1) / static_cast<double>(chunks_.size()), 0, 0);
    return !is_cancelled_;
  }

  const Source& source_;
  const Header& header_;
  const Selection& selection_;
  Chooser chooser_;
  const Run& run_;
  const TakePoints& take_;
  Result<void> taken_;
  Reporter reporter_;
  std::vector<LazChunk> chunks_;
  std::vector<Worker> workers_;
  std::vector<std::unique_ptr<Part>> parts_;  ///< by chunk, until they are appended
  Points points_;
  std::string fault_;
  bool is_cancelled_ = false;
};

}  // namespace

void Tally::add(const Tally& other) {
  for (std::size_t k = 0; k < classes.size(); ++k) classes[k] += other.classes[k];
  outside += other.outside;
  withheld += other.withheld;
  other_classes += other.other_classes;
  overlap += other.overlap;
  other_returns += other.other_returns;
  used += other.used;
}

Result<Points> read_points(const Source& source, const Header& header, const Selection& selection, const Run& run) {
  const TakePoints none;
  return PointReader(source, header, selection, run, none).read();
}

Result<Tally> read_points(const Source& source, const Header& header, const Selection& selection, const Run& run,
                          const TakePoints& take) {
  SCARP_TRY(const auto& read, PointReader(source, header, selection, run, take).read());
  return read.tally;
}

}  // namespace scarp::las
