// Builds a share of the blocks into a part, and joins all parts to a set.
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <utility>

#include "base/reporter.h"
#include "io/commands.h"
#include "jobs/core_seconds.h"
#include "jobs/part_writer.h"
#include "scarp/tile.h"
#include "scarp/tile_job.h"

namespace scarp {
namespace {

class BlockSink final : public TileSink {
 public:
  explicit BlockSink(TileEncoder encoder) : encoder_(std::move(encoder)) {}

  Result<std::vector<std::uint8_t>> encode(const TerrainTile& tile) const override { return encoder_(tile); }
  Result<void> put(TileId id, std::span<const std::uint8_t> bytes) override {
    tiles.push_back({id, {bytes.begin(), bytes.end()}});
    return {};
  }

  std::vector<jobs::PackedTile> tiles;

 private:
  TileEncoder encoder_;
};

std::uint64_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::uint64_t{1024} * static_cast<std::uint64_t>(usage.ru_maxrss);
}

bool touches(const TileGrid& grid, TileId id, const DegreeBox& box) {
  const DegreeBox tile = grid.bounds_of(id);
  if (tile.south > box.north || tile.north < box.south) return false;
  return std::ranges::any_of(grid.turns(),
                             [&](double turn) { return tile.west + turn <= box.east && tile.east + turn >= box.west; });
}

/// The consecutive blocks of a share. All shares have about the same cost.
std::span<const TileId> share_of(const TileJob& job, const std::vector<TileId>& blocks, Shard shard) {
  std::vector<std::uint64_t> before{0};  // cost before each block; total cost last
  const bool is_surveyed = job.costs.size() == blocks.size();
  for (std::size_t k = 0; k < blocks.size(); ++k)
    before.push_back(before.back() + (is_surveyed ? job.costs[k] : block_cost(job.plan, blocks[k])));
  const auto start_of = [&](std::uint64_t number) {
    const std::uint64_t cost = before.back() / shard.of * number + before.back() % shard.of * number / shard.of;
    return static_cast<std::size_t>(std::lower_bound(before.begin(), before.end(), cost) - before.begin());
  };
  const std::size_t first = start_of(shard.number - 1), end = start_of(shard.number);
  return std::span(blocks).subspan(first, end - first);
}

}  // namespace

Result<PartsReport> make_parts(const TileJob& job, const NodeSource& nodes, const std::string& folder, Shard shard,
                               const Run& run, const std::optional<DegreeBox>& only,
                               const std::function<void(const PartsReport&)>& tell) {
  if (shard.of < 1 || shard.number < 1 || shard.number > shard.of)
    return fail(ErrorKind::kUsage, fmt::format("there is no share {} of {}", shard.number, shard.of));
  SCARP_TRY(const auto& parts, TileParts::open(folder, job));
  const std::vector<TileId> all = find_blocks(job.plan);
  PartsReport report;
  std::vector<TileId> blocks;
  for (const TileId block : share_of(job, all, shard)) {
    if (only && !touches(job.plan.grid, block, *only)) continue;
    if (parts->has(block))
      ++report.there;
    else
      blocks.push_back(block);
  }
  if (blocks.empty()) return report;
  SCARP_TRY(const auto& encoder, open_tile_encoder(job));
  SCARP_TRY(auto&& writer, PartWriter::create(folder, shard, job));
  report.has_company = writer->has_company();
  if (report.has_company) std::reverse(blocks.begin(), blocks.end());
  Run part = run;
  std::uint64_t cost = 0, done = 0;
  for (const TileId block : blocks) cost += block_cost(job.plan, block);
  for (const TileId block : blocks) {
    const std::uint64_t one = block_cost(job.plan, block);
    part.progress = part_of(run.progress, static_cast<double>(done) / static_cast<double>(cost),
                            static_cast<double>(one) / static_cast<double>(cost));
    done += one;
    // finds blocks of this share that other processes built meanwhile
    SCARP_RETURN_IF_ERROR(parts->look_again(shard));
    if (parts->has(block)) {
      ++report.there;
      continue;
    }
    if (parts->has_any(block)) {
      SCARP_TRY(const auto& now, hash_block(job.plan, block, nodes, run.threads));
      if (parts->has_nodes(block, now)) {
        SCARP_RETURN_IF_ERROR(check_rasters(job));
        SCARP_RETURN_IF_ERROR(writer->confirm(block, now));
        ++report.unchanged;
        continue;
      }
    }
    BlockSink sink(encoder);
    const double start = jobs::core_seconds();
    SCARP_TRY(auto&& made, make_block(job.plan, block, nodes, sink, part));
    made.core_seconds = jobs::core_seconds() - start;
    made.memory = peak_memory();
    // If a raster changed meanwhile, its block is dropped; earlier blocks are kept.
    SCARP_RETURN_IF_ERROR(check_rasters(job));
    SCARP_RETURN_IF_ERROR(writer->add(made, sink.tiles));
    ++report.blocks;
    report.tiles += sink.tiles.size();
    for (const jobs::PackedTile& tile : sink.tiles) report.bytes += tile.bytes.size();
    if (tell) tell(report);
  }
  return report;
}

Result<PyramidReport> finish_parts(const TileJob& job, const std::string& folder, TileSetWriter& set, const Run& run,
                                   PartsCost* cost) {
  SCARP_TRY(const auto& parts, TileParts::open(folder, job));
  const std::vector<TileId> blocks = find_blocks(job.plan);
  const auto missing = std::count_if(blocks.begin(), blocks.end(), [&](TileId id) { return !parts->has(id); });
  if (missing > 0)
    return fail(ErrorKind::kInput, fmt::format("{} of {} blocks are not in {}: make what is missing first "
                                               "(scarp tile run PLAN --parts {})",
                                               missing, blocks.size(), folder, io::file_word(folder)));
  SCARP_TRY(auto&& encoder, open_tile_encoder(job));
  const std::unique_ptr<TileSetSink> sink = make_tile_sink(job.format, set, job.plan, std::move(encoder));
  std::vector<BlockReport> made;
  PartsCost taken;
  // Fraction of the time for writing the blocks' tiles.
  constexpr double kPutting = 0.9;
  Reporter reporter(run.progress);
  for (const TileId block : blocks) {
    const double share = kPutting * static_cast<double>(made.size()) / static_cast<double>(blocks.size());
    if (reporter.due() && !reporter.report("tiles", share, 0, 0)) return fail(ErrorKind::kCancelled, "cancelled");
    SCARP_TRY(auto&& one,
              parts->read(block, [&](TileId id, std::span<const std::uint8_t> bytes) { return sink->put(id, bytes); }));
    taken.core_seconds += one.core_seconds;
    taken.memory = std::max(taken.memory, one.memory);
    taken.parts += one.reduced.size();
    for (const LevelSummary& level : one.report.levels) taken.parts += level.bytes;
    made.push_back(std::move(one));
  }
  const double start = jobs::core_seconds();
  Run top = run;
  top.progress = part_of(run.progress, kPutting, 1 - kPutting);
  SCARP_TRY(auto&& report, finish_pyramid(job.plan, std::move(made), *sink, top));
  taken.core_seconds += jobs::core_seconds() - start;
  if (cost != nullptr) *cost = taken;
  SCARP_RETURN_IF_ERROR(sink->put_files(report, job.facts));
  SCARP_RETURN_IF_ERROR(set.finish());
  return report;
}

}  // namespace scarp
