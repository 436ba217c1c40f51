#include "pieces/effort.h"

namespace scarp::pieces {

const EffortTraits& traits_of(Effort effort) {
  static constexpr EffortTraits kFast{};
  static constexpr EffortTraits kNormal{true, false, false, fit::kNormalDepth, 2};
  static constexpr EffortTraits kHigh{true, true, false, fit::kHighDepth, 6, Effort::kNormal};
  static constexpr EffortTraits kMax{true, true, true, fit::kMaxDepth, 60, Effort::kHigh};
  switch (effort) {
    case Effort::kNormal:
      return kNormal;
    case Effort::kHigh:
      return kHigh;
    case Effort::kMax:
      return kMax;
    case Effort::kAuto:
    case Effort::kFast:
      break;
  }
  return kFast;
}

}  // namespace scarp::pieces
