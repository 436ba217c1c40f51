// Tiles at the start of a refinement order.
#pragma once

#include <rapidcheck/gtest.h>

#include <cstdint>

#include "laws/tile_meshes.h"
#include "refine/tile.h"
#include "refine/tile_domain.h"

namespace scarp::testing {

struct StartedTile {
  refine::Tile tile;
  tin::TileMesh mesh;
};

/// Returns false without surface cells.
inline bool start(const Field& field, StartedTile& started) {
  return started.tile.load(field.view(), {0, 0, field.cols, field.rows}) &&
         refine::start_tile(started.tile, {}, started.mesh) &&
         outside_area2(started.mesh) < 2 * std::int64_t{field.cols - 1} * (field.rows - 1);
}

inline Field any_tile_field(std::int32_t largest) {
  const auto cols = *rc::gen::inRange(2, largest), rows = *rc::gen::inRange(2, largest);
  const auto seed = *rc::gen::arbitrary<std::uint32_t>();
  const int relief = *rc::gen::inRange(0, 6);
  return relief == 5 ? sloping_field(seed, cols, rows)
                     : random_field(seed, cols, rows, kReliefs[relief], *rc::gen::element(0.0, 0.0, 0.03, 0.2, 0.5));
}

inline double any_tile_threshold() {
  return *rc::gen::element(0.0, 1e-9, 1e-7, 1e-6, 0.01, 0.5, 1.0, 2.0, 7.3, 30.0, 1e5);
}

}  // namespace scarp::testing
