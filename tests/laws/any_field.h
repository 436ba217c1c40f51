// Rasters chosen by RapidCheck.
#pragma once

#include <rapidcheck/gtest.h>

#include <iterator>
#include <vector>

#include "laws/fields.h"

namespace scarp::testing {

/// Up to `largest` samples a side, any relief, with or without nodata.
inline Field any_field(std::int32_t largest) {
  const auto cols = *rc::gen::inRange(2, largest), rows = *rc::gen::inRange(2, largest);
  const auto relief = *rc::gen::elementOf(std::vector<Relief>(std::begin(kReliefs), std::end(kReliefs)));
  return random_field(*rc::gen::arbitrary<std::uint32_t>(), cols, rows, relief, *rc::gen::element(0.0, 0.0, 0.1, 0.5));
}

}  // namespace scarp::testing
