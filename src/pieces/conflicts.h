// The settings that conflict, and why: one table for the library, the program, the docs and the tests.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/options.h"

#pragma GCC visibility push(default)

namespace scarp::pieces {

/// A setting: a field of SimplifyOptions that differs from its default (one setting per value if values conflict
/// differently), a property of a HeightField, or a setting of tiles.
enum class Field : std::uint8_t {
  kMaxError,
  kMaxTriangles,
  kMaxVertices,
  kOutlineTolerance,
  kBorder,           ///< locked
  kDoublePositions,  ///< float32_positions is false
  kMask,
  kMaskSource,
  kTolerance,
  kToleranceSource,
  kBreaklines,  ///< lines of any kind
  kWalls,       ///< declared, or lines of detect_cliffs() among the breaklines
  kRidges,      ///< declared, or lines of detect_ridges() among the breaklines
  kCutline,
  kIgnored,  ///< samples without a bound
  kPoints,   ///< samples that become vertices
  kOrderGreedy,
  kOrderDominant,
  kEffortFast,
  kEffortNormal,
  kEffortHigh,
  kEffortMax,
  kVerticesSamples,
  kVerticesFree,
  kMinShape,
  kShape,
  kTimeLimit,  ///< is_time_up
  kEnough,     ///< is_enough
  kObjectiveRms,
  kStrategy,  ///< a setting of simplify_by_paper() that differs from its default; never set in options of simplify()
  kLevels,    ///< a setting of simplify_levels(); never set in options of simplify()
  kNorm,
  kLattice,  ///< positions for compression
  kUvs,
  kNormals,
  kThreads,
  kMemoryLimit,
  kChannels,     ///< the field has channels, or a height_scale other than 1
  kCurvedFrame,  ///< the field's frame is not affine
  kSpaceFrame,   ///< the field's frame is in space, where z is not the height; it may also be curved
  kSource,       ///< the samples are not entirely in memory

  // Settings of tiles; never set in options of simplify().
  kTileMercator,  ///< the grid
  kTileLocal,     ///< the grid
  kTileQuantizedMesh,
  kTileGlb,
  kTileLakes,
  kTileRivers,
  kTileWaterMask,
  kTileLines,
  kTileDrape,
  kTileOnly,
  kTileGeoid,     ///< the zero level of heights
  kTileVertical,  ///< likewise, not given as a file
};
inline constexpr int kSimplifyFieldCount = static_cast<int>(Field::kSource) + 1;
inline constexpr int kFieldCount = static_cast<int>(Field::kTileVertical) + 1;

/// The library's name of the setting, such as "max_error" or "order = dominant".
std::string_view name_of(Field field);

class Fields {
 public:
  constexpr Fields() = default;
  template <class... More>
  constexpr explicit Fields(Field first, More... more) : bits_((bit(first) | ... | bit(more))) {}

  constexpr void add(Field field) { bits_ |= bit(field); }
  constexpr bool has(Field field) const { return (bits_ & bit(field)) != 0; }
  constexpr bool has_any(Fields others) const { return (bits_ & others.bits_) != 0; }
  constexpr bool empty() const { return bits_ == 0; }
  constexpr Fields without(Field field) const {
    Fields others = *this;
    others.bits_ &= ~bit(field);
    return others;
  }
  friend constexpr Fields operator|(Fields a, Fields b) {
    a.bits_ |= b.bits_;
    return a;
  }
  friend constexpr Fields operator&(Fields a, Fields b) {
    a.bits_ &= b.bits_;
    return a;
  }

 private:
  static constexpr std::uint64_t bit(Field field) { return std::uint64_t{1} << static_cast<int>(field); }
  std::uint64_t bits_ = 0;
};
static_assert(kFieldCount <= 64);

/// The settings of a call.
Fields fields_of(const HeightField& field, const SimplifyOptions& options);

/// The kinds of HeightField for which a conflict holds.
enum class Where { kAlways, kInMemory, kStreamed };

/// Each setting in `one` conflicts with each in `other`; if `beside` is not empty, only if one of `beside` is also set.
struct ConflictRule {
  Fields one, other, beside;
  Where where;
  const char* reason;
};

std::span<const ConflictRule> conflict_rules();

/// Two settings that conflict, or three if `beside` is given.
struct Conflict {
  Field one{}, other{};
  std::optional<Field> beside = std::nullopt;
  std::string reason;
};

/// All conflicts in the set, in the order of the table. Field::kSource in the set means that the samples are streamed.
std::vector<Conflict> find_conflicts(Fields set);
/// All conflicts of a call of simplify(). It fails with kUsage and describe() of the first conflict.
std::vector<Conflict> find_conflicts(const HeightField& field, const SimplifyOptions& options);

/// "X cannot be combined with Y: reason", or "X cannot be combined with Y beside Z: reason". `word` names a setting.
template <class Word>
std::string describe(const Conflict& conflict, Word&& word) {
  std::string text = std::string(word(conflict.one)) + " cannot be combined with " + std::string(word(conflict.other));
  if (conflict.beside) text += " beside " + std::string(word(*conflict.beside));
  return text + ": " + conflict.reason;
}
std::string describe(const Conflict& conflict);

}  // namespace scarp::pieces

#pragma GCC visibility pop
