#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "base/parallel.h"
#include "base/reporter.h"
#include "check/availability.h"
#include "check/borders.h"
#include "check/client_tile.h"
#include "check/nodes_check.h"
#include "check/tile_faults.h"
#include "check/tileset_check.h"
#include "io/gzip.h"
#include "scarp/tile_set.h"

namespace scarp::check {
namespace {

/// Number of tiles whose findings are in memory at once.
constexpr std::size_t kTilesTogether = 65536;

/// The facts about a tile before comparison with its neighbours.
struct TileFindings {
  std::vector<TileFault> faults;
  std::optional<TileEdges> edges;
  std::uint64_t triangles = 0;
  double sag = 0;
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  std::optional<bool> is_gzip;
};

class TilesCheck {
 public:
  TilesCheck(const TileSetReader& set, const TileCheckOptions& options)
      : set_(set),
        options_(options),
        claims_(io::read_set_claims(set)),
        grid_(options.grid.value_or(claims_.grid)),
        world_(grid_, options.ellipsoid.value_or(claims_.ellipsoid.value_or(Geodetic{}))),
        reporter_(options.run.progress) {}

  Result<TileCheck> run() {
    check_.format = set_.format();
    check_.units = claims_.units;
    check_.levels.resize(set_.tiles().size());
    for (std::size_t z = 0; z < check_.levels.size(); ++z) {
      if (z < claims_.node_errors.size()) check_.levels[z].promised_node_error = claims_.node_errors[z];
      if (z < claims_.bounds.size()) check_.levels[z].promised_bound = claims_.bounds[z];
      if (z < claims_.source_errors.size()) check_.levels[z].promised_source_error = claims_.source_errors[z];
      tiles_ += set_.tiles()[z].size();
    }
    check_container();
    std::vector<TileFault> faults;
    check_availability(set_, claims_, grid_, faults);
    add(faults);
    for (std::size_t z = 0; z < check_.levels.size(); ++z) {
      SCARP_RETURN_IF_ERROR(check_level(z));
    }
    if (set_.format() == TileFormat::kGlb) {
      faults.clear();
      check_tileset(claims_, grid_, set_.tiles().size(), low_, high_, options_.nodes, faults);
      add(faults);
    }
    if (options_.nodes.source != nullptr) {
      faults.clear();
      SCARP_RETURN_IF_ERROR(check_nodes(set_, claims_, options_, grid_, world_, check_, faults));
      add(faults);
    }
    std::stable_sort(check_.described.begin(), check_.described.end(),
                     [](const TileFault& a, const TileFault& b) { return a.kind < b.kind; });
    return std::move(check_);
  }

 private:
  void add(std::vector<TileFault>& faults) {
    for (TileFault& fault : faults) {
      const std::uint64_t before = check_.faults[static_cast<std::size_t>(fault.kind)]++;
      if (before < options_.most_faults) check_.described.push_back(std::move(fault));
    }
  }

  void check_container() {
    std::vector<TileFault> faults;
    for (std::string& sentence : set_.find_faults()) faults.push_back({TileFaultKind::kContainer, std::move(sentence)});
    for (const std::string& name : set_.files()) {
      if (const auto bytes = set_.read_file(name); !bytes)
        faults.push_back({TileFaultKind::kContainer, bytes.error().message});
    }
    add(faults);
  }

  Result<void> check_level(std::size_t z) {
    const std::vector<std::uint64_t>& tiles = set_.tiles()[z];
    CheckedLevel& level = check_.levels[z];
    std::vector<TileFault> border_faults;
    BorderWatch borders(set_.format(), grid_, static_cast<int>(z), level, border_faults);
    for (std::size_t first = 0; first < tiles.size(); first += kTilesTogether) {
      const auto some = std::span(tiles).subspan(first, std::min(kTilesTogether, tiles.size() - first));
      SCARP_RETURN_IF_ERROR(check_some(z, some, borders, border_faults));
    }
    borders.finish();
    add(border_faults);
    return {};
  }

  Result<void> check_some(std::size_t z, std::span<const std::uint64_t> tiles, BorderWatch& borders,
                          std::vector<TileFault>& border_faults) {
    CheckedLevel& level = check_.levels[z];
    std::vector<TileFindings> found(tiles.size());
    Result<void> result;
    parallel_in_order(
        tiles.size(), options_.run.threads,
        [&](std::size_t k, std::size_t) {
          found[k] = check_tile(
              {static_cast<int>(z), static_cast<std::uint32_t>(tiles[k]), static_cast<std::uint32_t>(tiles[k] >> 32)});
        },
        [&](std::size_t k) {
          TileFindings one = std::move(found[k]);
          ++level.tiles;
          level.triangles += one.triangles;
          level.sag = std::max(level.sag, one.sag);
          low_ = std::min(low_, one.low);
          high_ = std::max(high_, one.high);
          compare_gzip(tiles[k], z, one);
          if (one.edges) borders.add(std::move(*one.edges));
          add(one.faults);
          add(border_faults);
          border_faults.clear();
          ++done_;
          const double share = static_cast<double>(done_) / static_cast<double>(tiles_);
          if (reporter_.due() && !reporter_.report("check", share, 0, 0))
            result = fail(ErrorKind::kCancelled, "cancelled");
          return result.has_value();
        });
    return result;
  }

  /// A server declares gzip for all tiles at once.
  void compare_gzip(std::uint64_t key, std::size_t z, TileFindings& tile) {
    if (!tile.is_gzip) return;
    const std::optional<bool> said = set_.says_gzip();
    if (!is_gzip_) is_gzip_ = said.value_or(*tile.is_gzip);
    if (*is_gzip_ == *tile.is_gzip) return;
    const TileId id{static_cast<int>(z), static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32)};
    tile.faults.push_back(
        {TileFaultKind::kContainer,
         fmt::format("{} is {}in gzip, {}", tile_name(set_.format(), id), *tile.is_gzip ? "" : "not ",
                     said ? "and the container's header says otherwise" : "unlike the tiles before it")});
  }

  TileFindings check_tile(TileId id) const {
    TileFindings findings;
    const auto bytes = set_.read_tile(id);
    const auto refuse = [&](const std::string& sentence) {
      findings.faults.push_back({TileFaultKind::kFile, sentence});
      return std::move(findings);
    };
    if (!bytes)
      return refuse(fmt::format("{} cannot be read: {}", tile_name(set_.format(), id), bytes.error().message));
    findings.is_gzip = io::is_gzip(*bytes);
    const auto facts = claims_.facts.find({id.z, id.y, id.x});
    const auto tile = decode_client_tile(set_.format(), *bytes, id, grid_, world_,
                                         facts == claims_.facts.end() ? nullptr : &facts->second);
    if (!tile) return refuse(tile.error().message);
    findings.triangles = tile->triangles.size() / 3;
    check_water_mask(*tile, claims_.has_water_mask, findings.faults);
    check_header(*tile, findings.faults);
    // If the header's heights are finite, all heights are numbers.
    if (!std::isfinite(tile->low) || !std::isfinite(tile->high)) return findings;
    const auto [lowest, highest] = std::minmax_element(tile->heights.begin(), tile->heights.end());
    findings.low = *lowest;
    findings.high = *highest;
    check_coverage(*tile, findings.faults);
    check_edge_lists(*tile, findings.faults);
    check_skirt(*tile, world_, findings.faults);
    if (tile->is_flat)
      check_land(*tile, grid_, findings.faults);
    else
      check_horizon(*tile, world_, findings.faults);
    findings.sag = measure_sag(*tile, world_);
    const std::optional<double>& bound = check_.levels[static_cast<std::size_t>(id.z)].promised_bound;
    if (bound && findings.sag > *bound * (1 + 1e-9) + 1e-6)
      findings.faults.push_back({TileFaultKind::kBound,
                                 fmt::format("{} has flat triangles {:.6g} m below the earth's curve, and {:.6g} m are "
                                             "promised",
                                             tile_name(set_.format(), id), findings.sag, *bound)});
    findings.edges = take_edges(*tile);
    return findings;
  }

  const TileSetReader& set_;
  const TileCheckOptions& options_;
  io::SetClaims claims_;
  TileGrid grid_;
  World world_;
  Reporter reporter_;
  TileCheck check_;
  std::uint64_t tiles_ = 0, done_ = 0;
  double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;  ///< range of all vertices
  std::optional<bool> is_gzip_;
};

}  // namespace

}  // namespace scarp::check

namespace scarp {

const char* name_of(TileFaultKind kind) {
  constexpr const char* kNames[] = {"container", "availability", "file",    "coverage", "edge list",
                                    "border",    "header",       "horizon", "bound",    "tileset"};
  static_assert(std::size(kNames) == kTileFaultKinds);
  return kNames[static_cast<std::size_t>(kind)];
}

std::uint64_t TileCheck::count() const {
  std::uint64_t sum = 0;
  for (const std::uint64_t of_kind : faults) sum += of_kind;
  return sum;
}

Result<TileCheck> check_tiles(const TileSetReader& set, const TileCheckOptions& options) {
  return check::TilesCheck(set, options).run();
}

}  // namespace scarp
