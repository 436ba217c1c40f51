// Levels of lakes and profiles of rivers on the nodes' lattice. The library's functions for rasters find them: a part
// of the lattice is a raster whose samples are nodes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "base/parallel.h"
#include "globe/node_places.h"
#include "scarp/features.h"
#include "tiles/water/tile_waters.h"
#include "tiles/water/water_shapes.h"

namespace scarp::tiles {
namespace {

/// Nodes a side per read.
constexpr int kChunk = 64;

/// Nodes of a box as samples, read in chunks. Callers proceed row by row, so chunks of the last rows are cached.
class NodeSamples final : public SampleSource {
 public:
  NodeSamples(const NodeSource& nodes, const TileWaters& waters, const NodeBox& box)
      : nodes_(nodes), grid_(waters.grid), per_turn_(waters.per_turn), box_(box) {}

  Result<void> read(int col, int row, int cols, int rows, float* out, std::ptrdiff_t stride) const override {
    return chunks_.with([&](Chunks& chunks) -> Result<void> {
      for (int y = row / kChunk; y <= (row + rows - 1) / kChunk; ++y) {
        if (chunks.band != y) chunks = {y, {}};
        for (int x = col / kChunk; x <= (col + cols - 1) / kChunk; ++x) {
          SCARP_TRY(const auto& chunk, find(chunks, x, y));
          const int first_col = std::max(col, x * kChunk), end_col = std::min(col + cols, (x + 1) * kChunk);
          const int first_row = std::max(row, y * kChunk), end_row = std::min(row + rows, (y + 1) * kChunk);
          for (int j = first_row; j < end_row; ++j) {
            const float* from = chunk->data() + std::ptrdiff_t{j - y * kChunk} * width_of(x);
            std::copy(from + (first_col - x * kChunk), from + (end_col - x * kChunk),
                      out + (j - row) * stride + (first_col - col));
          }
        }
      }
      return {};
    });
  }
  bool is_in_memory() const override { return false; }

 private:
  struct Chunks {
    int band = -1;
    std::map<int, std::vector<float>> by_column;
  };

  int width_of(int x) const { return std::min(kChunk, box_.cols - x * kChunk); }

  Result<const std::vector<float>*> find(Chunks& chunks, int x, int y) const {
    const auto [found, is_new] = chunks.by_column.try_emplace(x);
    std::vector<float>& heights = found->second;
    if (!is_new) return &heights;
    const NodeWindow window{per_turn_,   box_.col + std::int64_t{x} * kChunk,      box_.row + std::int64_t{y} * kChunk,
                            width_of(x), std::min(kChunk, box_.rows - y * kChunk), grid_};
    heights.resize(static_cast<std::size_t>(window.cols) * static_cast<std::size_t>(window.rows));
    if (auto read = nodes_.read(window, heights); !read) {
      chunks.by_column.erase(found);
      return tl::unexpected(read.error());
    }
    return &heights;
  }

  const NodeSource& nodes_;
  TileGrid grid_;
  std::int64_t per_turn_;
  NodeBox box_;
  mutable Shared<Chunks> chunks_;
};

HeightField field_of(const NodeSamples& samples, const NodeBox& box) {
  HeightField field;
  field.cols = box.cols;
  field.rows = box.rows;
  field.source = &samples;
  return field;
}

/// Converts from heights above the ellipsoid.
class Below final : public HeightZero {
 public:
  explicit Below(std::shared_ptr<const HeightZero> zero) : zero_(std::move(zero)) {}
  void find(std::span<const double> longitudes, std::span<const double> latitudes,
            std::span<double> heights) const override {
    zero_->find(longitudes, latitudes, heights);
    for (double& height : heights) height = -height;
  }

 private:
  std::shared_ptr<const HeightZero> zero_;
};

/// Places lines on the lattice, the rings of a polygon together, in the turn that the source covers.
class Placing {
 public:
  explicit Placing(const TileWaters& waters)
      : covered_(waters.covered),
        goes_round_(covered_.east - covered_.west >= 360),
        places_(waters.grid, waters.per_turn) {}

  Result<std::vector<Line>> place(std::span<const Line> given) const {
    std::vector<Line> lines(given.begin(), given.end());
    for (Line& line : lines) {
      SCARP_RETURN_IF_ERROR(go_on(line));
    }
    // Holes are in the turn of the ring around them.
    const double first = lines.front().points.front()[0];
    for (Line& line : lines) move(line, -360 * std::floor((line.points.front()[0] - first + 180) / 360));
    const double turn = find_turn(lines);
    for (Line& line : lines) {
      move(line, turn);
      for (auto& point : line.points) point = {places_.col(point[0]), places_.row(point[1]), NAN};
    }
    return lines;
  }

 private:
  /// Continues longitudes beyond the antimeridian. An edge of exactly one turn is a side of the whole map.
  static Result<void> go_on(Line& line) {
    constexpr double kNothing = 1e-9;
    for (std::size_t k = 1; k < line.points.size(); ++k) {
      double& longitude = line.points[k][0];
      const double way = longitude - line.points[k - 1][0];
      if (std::abs(way) > 180 && std::abs(std::remainder(way, 360)) > kNothing)
        longitude -= 360 * std::round(way / 360);
    }
    if (!line.is_ring() || std::abs(line.points.back()[0] - line.points.front()[0]) < 1) return {};
    return fail(ErrorKind::kUsage,
                fmt::format("{} goes around a pole: cut it along the antimeridian, as RFC 7946 says", line.name));
  }

  static void move(Line& line, double degrees) {
    if (degrees == 0) return;
    for (auto& point : line.points) point[0] += degrees;
  }

  double find_turn(const std::vector<Line>& lines) const {
    double west = INFINITY, east = -INFINITY;
    for (const Line& line : lines) {
      for (const auto& point : line.points) {
        west = std::min(west, point[0]);
        east = std::max(east, point[0]);
      }
    }
    if (goes_round_) return 0;
    for (const double turn : {0, 360, -360, 720, -720}) {
      if (west + turn <= covered_.east && east + turn >= covered_.west) return turn;
    }
    return 0;
  }

  DegreeBox covered_;
  bool goes_round_;
  globe::NodePlaces places_;
};

tl::unexpected<Error> too_wide(const std::string& name, const char* what) {
  return fail(ErrorKind::kUsage, fmt::format("{} {} more than {} nodes of the finest level side by side: cut {} into "
                                             "parts, or choose a coarser level (--zoom)",
                                             name, what, kMostNodes, name));
}

Result<std::vector<TileLake>> find_levels(const TileWaters& waters, const NodeSource& nodes, const WaterLines& given) {
  const Placing placing(waters);
  std::vector<TileLake> lakes;
  const std::span<const Line> lines = given.lakes;
  for (std::size_t first = 0, end = 0; first < lines.size(); first = end) {
    end = first + 1;
    if (!lines[first].is_ring()) continue;
    while (end < lines.size() && lines[end].polygon == lines[first].polygon) ++end;
    SCARP_TRY(const auto& rings, placing.place(lines.subspan(first, end - first)));
    TileLake lake;
    lake.name = rings.front().name;
    lake.level = NAN;
    NodesAround around;
    for (const Line& ring : rings) {
      lake.rings.emplace_back();
      for (const auto& point : ring.points) {
        lake.rings.back().push_back({point[0], point[1]});
        around.add(point[0], point[1]);
      }
    }
    if (const auto box = around.box(waters)) {
      if (std::max(box->cols, box->rows) > kMostNodes) return too_wide(lake.name, "has");
      const NodeSamples samples(nodes, waters, *box);
      WaterOptions options;
      options.affine = affine_of(*box);
      options.percentile = given.percentile;
      SCARP_TRY(const auto& found, find_lakes(field_of(samples, *box), lines_of(lake), options));
      if (!found.empty()) lake.level = found.front().level;
    }
    lakes.push_back(std::move(lake));
  }
  return lakes;
}

Result<std::vector<TileRiver>> find_profiles(const TileWaters& waters, const NodeSource& nodes,
                                             std::span<const Line> given, double tolerance) {
  const Placing placing(waters);
  std::vector<Line> lines;
  NodesAround around;
  for (const Line& line : given) {
    if (line.is_ring()) continue;
    SCARP_TRY(auto&& placed, placing.place({&line, 1}));
    for (const auto& point : placed.front().points) around.add(point[0], point[1]);
    lines.push_back(std::move(placed.front()));
  }
  const auto box = lines.empty() ? std::nullopt : around.box(waters);
  if (!box) return std::vector<TileRiver>();
  if (std::max(box->cols, box->rows) > kMostNodes) return too_wide("the network of rivers", "spans");
  std::vector<Lake> lakes;
  for (const TileLake& lake : waters.lakes) {
    if (std::isnan(lake.level)) continue;
    lakes.emplace_back();
    lakes.back().level = lake.level;
    lakes.back().shore = lines_of(lake);
  }
  const NodeSamples samples(nodes, waters, *box);
  SCARP_TRY(const auto& found, carve_rivers(field_of(samples, *box), lines, lakes, {affine_of(*box), tolerance}));
  std::vector<TileRiver> rivers;
  for (const River& river : found) rivers.push_back({river.name, river.course.points});
  return rivers;
}

}  // namespace

Result<TileWaters> find_tile_waters(const PyramidPlan& plan, const NodeSource& nodes,
                                    const std::shared_ptr<const HeightZero>& zero, const DegreeBox& covered,
                                    const WaterLines& lines) {
  TileWaters waters;
  waters.covered = covered;
  waters.grid = plan.grid;
  waters.per_turn = plan.grid.per_turn(plan.max_zoom(), plan.cells);
  const std::unique_ptr<NodeSource> lowered = zero ? make_raised_source(nodes, std::make_shared<Below>(zero)) : nullptr;
  const NodeSource& above = lowered ? *lowered : nodes;
  SCARP_TRY(waters.lakes, find_levels(waters, above, lines));
  if (lines.rivers.empty()) return waters;
  const auto flat = make_watered_source(above, std::make_shared<TileWaters>(waters), nullptr);
  SCARP_TRY(waters.rivers, find_profiles(waters, *flat, lines.rivers, plan.levels.back().max_error / 2));
  return waters;
}

}  // namespace scarp::tiles
