// A share of the blocks into a part, and all parts into a set.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "base/reporter.h"
#include "io/tiles/part_writer.h"
#include "scarp/tile_job.h"

namespace scarp {
namespace {

/// Keeps the tiles of a block.
class BlockSink final : public TileSink {
 public:
  explicit BlockSink(TileEncoder encoder) : encoder_(std::move(encoder)) {}

  Result<std::vector<std::uint8_t>> encode(const TerrainTile& tile) const override { return encoder_(tile); }
  Result<void> put(TileId id, std::span<const std::uint8_t> bytes) override {
    tiles.push_back({id, {bytes.begin(), bytes.end()}});
    return {};
  }

  std::vector<PackedTile> tiles;

 private:
  TileEncoder encoder_;
};

/// What a block takes, about: by how much of it the source may cover.
std::uint64_t cost_of(const PyramidPlan& plan, TileId block) {
  const DegreeBox box = plan.grid.bounds_of(block), &covered = plan.covered;
  const double width = box.east - box.west, height = box.north - box.south;
  const double down = std::min(box.north, covered.north) - std::max(box.south, covered.south);
  double across = 0;
  for (const double turn : plan.grid.turns())
    across += std::max(0.0, std::min(box.east + turn, covered.east) - std::max(box.west + turn, covered.west));
  return 1 + static_cast<std::uint64_t>(1000 * std::max(0.0, down) * std::min(across, width) / (width * height));
}

/// The blocks of a share: consecutive ones, of about the same cost in all shares.
std::span<const TileId> share_of(const PyramidPlan& plan, const std::vector<TileId>& blocks, Shard shard) {
  std::vector<std::uint64_t> before{0};  // of each block, and of all
  for (const TileId block : blocks) before.push_back(before.back() + cost_of(plan, block));
  const auto start_of = [&](std::uint64_t number) {
    const std::uint64_t cost = before.back() / shard.of * number + before.back() % shard.of * number / shard.of;
    return static_cast<std::size_t>(std::lower_bound(before.begin(), before.end(), cost) - before.begin());
  };
  const std::size_t first = start_of(shard.number - 1), end = start_of(shard.number);
  return std::span(blocks).subspan(first, end - first);
}

}  // namespace

Result<PartsReport> make_parts(const TileJob& job, const NodeSource& nodes, const std::string& folder, Shard shard,
                               const Run& run) {
  if (shard.of < 1 || shard.number < 1 || shard.number > shard.of)
    return fail(ErrorKind::kUsage, fmt::format("there is no share {} of {}", shard.number, shard.of));
  const std::uint64_t key = key_of(job);
  const auto parts = TileParts::open(folder, key);
  if (!parts) return tl::unexpected(parts.error());
  const std::vector<TileId> all = find_blocks(job.plan);
  const std::span<const TileId> blocks = share_of(job.plan, all, shard);
  PartsReport report;
  report.there = static_cast<std::uint64_t>(
      std::count_if(blocks.begin(), blocks.end(), [&](TileId id) { return (*parts)->has(id); }));
  if (report.there == blocks.size()) return report;
  auto writer = PartWriter::create(folder, shard, key);
  if (!writer) return tl::unexpected(writer.error());
  Run part = run;
  const double share = 1 / static_cast<double>(blocks.size() - report.there);
  for (const TileId block : blocks) {
    if ((*parts)->has(block)) continue;
    BlockSink sink(make_tile_encoder(job.format, job.plan));
    part.progress = part_of(run.progress, static_cast<double>(report.blocks) * share, share);
    auto made = make_block(job.plan, block, nodes, sink, part);
    if (!made) return tl::unexpected(made.error());
    // A block of a raster that changed meanwhile is not kept; those before it are.
    if (auto same = check_rasters(job); !same) return tl::unexpected(same.error());
    if (auto kept = (*writer)->add(*made, sink.tiles); !kept) return tl::unexpected(kept.error());
    ++report.blocks;
    report.tiles += sink.tiles.size();
    for (const PackedTile& tile : sink.tiles) report.bytes += tile.bytes.size();
  }
  return report;
}

Result<PyramidReport> finish_parts(const TileJob& job, const std::string& folder, TileSetWriter& set, const Run& run) {
  const auto parts = TileParts::open(folder, key_of(job));
  if (!parts) return tl::unexpected(parts.error());
  const std::vector<TileId> blocks = find_blocks(job.plan);
  const auto missing = std::count_if(blocks.begin(), blocks.end(), [&](TileId id) { return !(*parts)->has(id); });
  if (missing > 0)
    return fail(ErrorKind::kInput, fmt::format("{} of {} blocks are not in {}: run their shares with scarp tile run, "
                                               "which makes only what is missing",
                                               missing, blocks.size(), folder));
  const std::unique_ptr<TileSetSink> sink = make_tile_sink(job.format, set, job.plan);
  std::vector<BlockReport> made;
  for (const TileId block : blocks) {
    auto one =
        (*parts)->read(block, [&](TileId id, std::span<const std::uint8_t> bytes) { return sink->put(id, bytes); });
    if (!one) return tl::unexpected(one.error());
    made.push_back(std::move(*one));
  }
  auto report = finish_pyramid(job.plan, std::move(made), *sink, run);
  if (!report) return report;
  if (auto put = sink->put_files(*report, job.facts); !put) return tl::unexpected(put.error());
  if (auto finished = set.finish(); !finished) return tl::unexpected(finished.error());
  return report;
}

}  // namespace scarp
