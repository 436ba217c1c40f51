#include "pieces/conflicts.h"

#include <algorithm>
#include <array>

#include "pieces/recipe.h"
#include "scarp/options.h"
#include "scarp/tile.h"

namespace scarp {

namespace {

constexpr pieces::Fields kBudgets(pieces::Field::kMaxTriangles, pieces::Field::kMaxVertices);
constexpr pieces::Fields kTolerances(pieces::Field::kTolerance, pieces::Field::kToleranceSource);
constexpr pieces::Fields kWeights(pieces::Field::kMask, pieces::Field::kMaskSource);
constexpr pieces::Fields kLines(pieces::Field::kBreaklines, pieces::Field::kCutline);
constexpr pieces::Fields kInsertedFirst(pieces::Field::kWalls, pieces::Field::kRidges);
constexpr pieces::Fields kShapes(pieces::Field::kShape);
constexpr pieces::Fields kEfforts(pieces::Field::kEffortNormal, pieces::Field::kEffortHigh, pieces::Field::kEffortMax);
/// Settings that require an effort above fast.
constexpr pieces::Fields kAsksForEffort(pieces::Field::kMinShape, pieces::Field::kTimeLimit,
                                        pieces::Field::kObjectiveRms, pieces::Field::kVerticesFree);

constexpr pieces::ConflictRule kRules[] = {
    {pieces::Fields(pieces::Field::kStrategy),
     kLines | kShapes | kEfforts | kAsksForEffort | pieces::Fields(pieces::Field::kOrderDominant),
     {},
     pieces::Where::kAlways,
     "a strategy of the 1995 paper only inserts vertices, in the greedy order"},
    {kWeights,
     kTolerances,
     {},
     pieces::Where::kAlways,
     "divide the max error by the weights, and give one tolerance for each sample"},

    {pieces::Fields(pieces::Field::kOrderDominant),
     pieces::Fields(pieces::Field::kPoints),
     {},
     pieces::Where::kAlways,
     "the dominant order starts from the outline alone"},
    {pieces::Fields(pieces::Field::kOrderDominant),
     pieces::Fields(pieces::Field::kOutlineTolerance),
     {},
     pieces::Where::kAlways,
     "the dominant order keeps the exact outline"},
    {pieces::Fields(pieces::Field::kOrderDominant),
     pieces::Fields(pieces::Field::kChannels),
     {},
     pieces::Where::kAlways,
     "the dominant order works on heights alone, without channels"},
    {pieces::Fields(pieces::Field::kOrderDominant),
     kInsertedFirst,
     {},
     pieces::Where::kInMemory,
     "in memory walls and ridges are inserted before refinement, which then takes the greedy order"},

    {pieces::Fields(pieces::Field::kBorder),
     pieces::Fields(pieces::Field::kStrategy),
     {},
     pieces::Where::kAlways,
     "a strategy of the 1995 paper inserts samples of the edge, too"},
    {pieces::Fields(pieces::Field::kBorder),
     kInsertedFirst | kShapes | pieces::Fields(pieces::Field::kCutline),
     {},
     pieces::Where::kAlways,
     "cutlines, walls, ridges, angles and edge lengths need vertices of their own on the border"},
    {pieces::Fields(pieces::Field::kLevels),
     kLines,
     {},
     pieces::Where::kAlways,
     "lines need vertices on the border, which all levels share"},
    {pieces::Fields(pieces::Field::kBorder),
     pieces::Fields(pieces::Field::kOutlineTolerance),
     {},
     pieces::Where::kAlways,
     "a simplified outline leaves the samples of the border"},
    {pieces::Fields(pieces::Field::kBorder),
     pieces::Fields(pieces::Field::kCurvedFrame),
     {},
     pieces::Where::kAlways,
     "a curved border needs vertices of its own; project the raster instead (gdalwarp -t_srs EPSG:CODE -r bilinear -ot "
     "Float32 -dstnodata -9999 FILE NEW.tif)"},
    {pieces::Fields(pieces::Field::kLevels),
     kBudgets | kTolerances | pieces::Fields(pieces::Field::kObjectiveRms),
     {},
     pieces::Where::kAlways,
     "levels are meshes of one max error each, from the finest on"},
    {pieces::Fields(pieces::Field::kLevels),
     pieces::Fields(pieces::Field::kTimeLimit),
     {},
     pieces::Where::kAlways,
     "the finest level would take the time of all"},
    {pieces::Fields(pieces::Field::kBorder), kBudgets, kTolerances, pieces::Where::kAlways,
     "a budget enlarges all tolerances, and the border's with them"},

    {kLines,
     pieces::Fields(pieces::Field::kOutlineTolerance),
     {},
     pieces::Where::kAlways,
     "a mesh with lines keeps the exact outline"},
    {kShapes,
     pieces::Fields(pieces::Field::kOutlineTolerance),
     {},
     pieces::Where::kAlways,
     "a mesh with goals for angles and edges keeps the exact outline"},
    {kLines | kShapes,
     pieces::Fields(pieces::Field::kChannels),
     {},
     pieces::Where::kAlways,
     "vertices come to lie between samples, where channels have no value"},
    {kLines | kShapes,
     pieces::Fields(pieces::Field::kCurvedFrame),
     {},
     pieces::Where::kAlways,
     "vertices come to lie between samples, which needs a frame in which the grid is regular"},
    {pieces::Fields(pieces::Field::kWalls),
     kShapes,
     {},
     pieces::Where::kAlways,
     "the two lines of a wall lie too close together for angles"},

    {pieces::Fields(pieces::Field::kEffortFast),
     kAsksForEffort,
     {},
     pieces::Where::kAlways,
     "fast effort only refines"},
    {pieces::Fields(pieces::Field::kEffortNormal),
     pieces::Fields(pieces::Field::kVerticesFree),
     {},
     pieces::Where::kAlways,
     "only high and max effort move vertices"},
    {pieces::Fields(pieces::Field::kVerticesFree),
     pieces::Fields(pieces::Field::kChannels),
     {},
     pieces::Where::kAlways,
     "channels have no value between samples"},
    {pieces::Fields(pieces::Field::kVerticesFree),
     pieces::Fields(pieces::Field::kCurvedFrame),
     {},
     pieces::Where::kAlways,
     "free vertices need a frame in which the grid is regular"},
    {pieces::Fields(pieces::Field::kSpaceFrame),
     pieces::Fields(pieces::Field::kChannels),
     {},
     pieces::Where::kAlways,
     "an error in space is of heights alone"},
    {pieces::Fields(pieces::Field::kTimeLimit), kBudgets, pieces::Fields(pieces::Field::kEffortMax),
     pieces::Where::kAlways, "max effort takes all of the time for one mesh, and a budget is met by several"},
    {pieces::Fields(pieces::Field::kSource),
     pieces::Fields(pieces::Field::kOrderGreedy),
     {},
     pieces::Where::kStreamed,
     "streamed samples are refined tile by tile, in the dominant order"},
    {pieces::Fields(pieces::Field::kSource),
     pieces::Fields(pieces::Field::kMask, pieces::Field::kTolerance),
     {},
     pieces::Where::kStreamed,
     "streamed samples take their weights and tolerances from a source"},
    {pieces::Fields(pieces::Field::kSource),
     pieces::Fields(pieces::Field::kPoints),
     {},
     pieces::Where::kStreamed,
     "streamed samples are refined strip by strip, from the outline alone"},
    {pieces::Fields(pieces::Field::kSource),
     pieces::Fields(pieces::Field::kStrategy),
     {},
     pieces::Where::kStreamed,
     "streamed samples are refined tile by tile, in the dominant order, with Delaunay edges"},
    {pieces::Fields(pieces::Field::kSource),
     pieces::Fields(pieces::Field::kOutlineTolerance),
     {},
     pieces::Where::kStreamed,
     "an outline is simplified as a whole"},
    {pieces::Fields(pieces::Field::kSource),
     pieces::Fields(pieces::Field::kSpaceFrame),
     {},
     pieces::Where::kStreamed,
     "a mesh in space is proven and mended with all samples in memory"},
    {pieces::Fields(pieces::Field::kSource),
     pieces::Fields(pieces::Field::kBorder),
     {},
     pieces::Where::kStreamed,
     "strips would put vertices on the border"},
    {pieces::Fields(pieces::Field::kSource),
     pieces::Fields(pieces::Field::kChannels),
     {},
     pieces::Where::kStreamed,
     "channels are held in memory"},

    {pieces::Fields(pieces::Field::kTileLakes, pieces::Field::kTileRivers),
     pieces::Fields(pieces::Field::kTileLocal),
     {},
     pieces::Where::kAlways,
     "lakes and rivers are laid in degrees; flatten them first (scarp simplify RASTER NEW.tif -e 0 --water LAKES)"},
    {pieces::Fields(pieces::Field::kTileLines),
     pieces::Fields(pieces::Field::kTileLocal),
     {},
     pieces::Where::kAlways,
     "lines are laid in degrees"},
    {pieces::Fields(pieces::Field::kTileDrape),
     pieces::Fields(pieces::Field::kTileLocal),
     {},
     pieces::Where::kAlways,
     "images are laid in degrees; load them in the client"},
    {pieces::Fields(pieces::Field::kTileOnly),
     pieces::Fields(pieces::Field::kTileLocal),
     {},
     pieces::Where::kAlways,
     "it is a box in degrees; read a part of the raster instead (--te)"},
    {pieces::Fields(pieces::Field::kTileQuantizedMesh),
     pieces::Fields(pieces::Field::kTileLocal),
     {},
     pieces::Where::kAlways,
     "quantized-mesh lies on the ellipsoid; --of 3dtiles holds a plane"},
    {pieces::Fields(pieces::Field::kTileGlb),
     pieces::Fields(pieces::Field::kTileMercator),
     {},
     pieces::Where::kAlways,
     "clients of 3D Tiles halve tiles in degrees of latitude"},
    {pieces::Fields(pieces::Field::kTileLines),
     pieces::Fields(pieces::Field::kTileMercator),
     {},
     pieces::Where::kAlways,
     "lines cross its tiles at places that nodes do not divide evenly; take the geographic grid"},
    {pieces::Fields(pieces::Field::kTileGlb),
     pieces::Fields(pieces::Field::kTileWaterMask),
     {},
     pieces::Where::kAlways,
     "masks are an extension of quantized-mesh; lakes of --water are flat without"},
    {pieces::Fields(pieces::Field::kTileDrape),
     pieces::Fields(pieces::Field::kTileQuantizedMesh),
     {},
     pieces::Where::kAlways,
     "clients of quantized-mesh lay images over the terrain themselves; tiles of --of 3dtiles hold theirs"},
    {pieces::Fields(pieces::Field::kTileGeoid),
     pieces::Fields(pieces::Field::kTileVertical),
     {},
     pieces::Where::kAlways,
     "it says what the heights are above; give it without --vertical"},
};

constexpr std::string_view kNames[] = {
    "max_error",
    "max_triangles",
    "max_vertices",
    "outline_tolerance",
    "domain.border",
    "float32_positions = false",
    "mask",
    "mask_source",
    "tolerance",
    "tolerance_source",
    "breaklines",
    "features.walls",
    "features.ridges",
    "cutline",
    "tolerances.ignored",
    "features.points",
    "order = greedy",
    "order = dominant",
    "effort = fast",
    "effort = normal",
    "effort = high",
    "effort = max",
    "vertices = samples",
    "vertices = free",
    "min_shape",
    "shape",
    "is_time_up",
    "is_enough",
    "objective = rms",
    "a strategy",
    "levels",
    "norm",
    "lattice",
    "uvs",
    "normals",
    "threads",
    "memory_limit",
    "channels of the field",
    "a curved frame of the field",
    "a frame of the field in space",
    "a field with a source",
    "the mercator grid",
    "a local grid",
    "format = quantized-mesh",
    "format = glb",
    "lakes",
    "rivers",
    "has_water_mask",
    "lines",
    "drape",
    "only",
    "a geoid",
    "a vertical datum",
};
static_assert(std::size(kNames) == pieces::kFieldCount);

bool holds(pieces::Where where, bool is_streamed) {
  return where == pieces::Where::kAlways || (where == pieces::Where::kStreamed) == is_streamed;
}

std::vector<pieces::Field> list(pieces::Fields all) {
  std::vector<pieces::Field> list;
  for (int k = 0; k < pieces::kFieldCount; ++k) {
    if (all.has(static_cast<pieces::Field>(k))) list.push_back(static_cast<pieces::Field>(k));
  }
  return list;
}

std::vector<std::string> sentences(const std::vector<pieces::Conflict>& conflicts) {
  std::vector<std::string> all;
  for (const pieces::Conflict& conflict : conflicts) all.push_back(pieces::describe(conflict));
  return all;
}

}  // namespace

std::string_view pieces::name_of(pieces::Field field) { return kNames[static_cast<int>(field)]; }

std::span<const pieces::ConflictRule> pieces::conflict_rules() { return kRules; }

pieces::Fields pieces::fields_of(const HeightField& field, const SimplifyOptions& options) {
  const Features& features = options.features;
  const auto& lines = features.breaklines.lines;
  const std::pair<pieces::Field, bool> all[] = {
      {pieces::Field::kMaxError, options.goals.max_error.has_value()},
      {pieces::Field::kMaxTriangles, options.goals.max_triangles.has_value()},
      {pieces::Field::kMaxVertices, options.goals.max_vertices.has_value()},
      {pieces::Field::kOutlineTolerance, options.domain.outline_tolerance > 0},
      {pieces::Field::kBorder, options.domain.border.is_locked},
      {pieces::Field::kDoublePositions, !options.output.float32_positions},
      {pieces::Field::kMask, !options.tolerances.weights.empty()},
      {pieces::Field::kMaskSource, options.tolerances.weights_source != nullptr},
      {pieces::Field::kTolerance, !options.tolerances.values.empty()},
      {pieces::Field::kToleranceSource, options.tolerances.source != nullptr},
      {pieces::Field::kBreaklines, features.have_lines()},
      {pieces::Field::kWalls, features.walls || std::any_of(lines.begin(), lines.end(), is_wall)},
      {pieces::Field::kRidges, features.ridges || std::any_of(lines.begin(), lines.end(), is_ridge_line)},
      {pieces::Field::kCutline, !options.features.cutline.rings.empty()},
      {pieces::Field::kIgnored, !options.tolerances.ignored.empty()},
      {pieces::Field::kPoints, !features.points.empty()},
      {pieces::Field::kOrderGreedy, options.quality.order == Order::kGreedy},
      {pieces::Field::kOrderDominant, options.quality.order == Order::kDominant},
      {pieces::Field::kEffortFast, options.quality.effort == Effort::kFast},
      {pieces::Field::kEffortNormal, options.quality.effort == Effort::kNormal},
      {pieces::Field::kEffortHigh, options.quality.effort == Effort::kHigh},
      {pieces::Field::kEffortMax, options.quality.effort == Effort::kMax},
      {pieces::Field::kVerticesSamples, options.quality.vertices == Vertices::kSamples},
      {pieces::Field::kVerticesFree, options.quality.vertices == Vertices::kFree},
      {pieces::Field::kMinShape, options.quality.min_shape.has_value()},
      {pieces::Field::kShape, options.quality.shape.any()},
      {pieces::Field::kTimeLimit, static_cast<bool>(options.run.is_time_up)},
      {pieces::Field::kEnough, static_cast<bool>(options.run.is_enough)},
      {pieces::Field::kObjectiveRms, options.goals.objective == Objective::kRms},
      {pieces::Field::kStrategy, false},
      {pieces::Field::kLevels, false},
      {pieces::Field::kNorm, options.goals.norm != Norm::kSum},
      {pieces::Field::kLattice, options.output.lattice},
      {pieces::Field::kUvs, options.output.uvs},
      {pieces::Field::kNormals, options.output.normals},
      {pieces::Field::kThreads, options.run.threads != 0},
      {pieces::Field::kMemoryLimit, options.run.memory.limit > 0},
      {pieces::Field::kChannels, pieces::has_norm(field)},
      {pieces::Field::kCurvedFrame, !field.frame.is_affine()},
      {pieces::Field::kSpaceFrame, field.frame.space != nullptr},
      {pieces::Field::kSource, field.samples == nullptr && field.source != nullptr},
  };
  static_assert(std::size(all) == pieces::kSimplifyFieldCount);
  pieces::Fields fields;
  for (const auto& [of, is_set] : all) {
    if (is_set) fields.add(of);
  }
  return fields;
}

std::vector<pieces::Conflict> pieces::find_conflicts(pieces::Fields set) {
  std::vector<pieces::Conflict> conflicts;
  for (const pieces::ConflictRule& rule : kRules) {
    if (!holds(rule.where, set.has(pieces::Field::kSource)) || !set.has_any(rule.one) || !set.has_any(rule.other))
      continue;
    if (!rule.beside.empty() && !set.has_any(rule.beside)) continue;
    const std::vector<pieces::Field> beside = list(set & rule.beside);
    for (const pieces::Field one : list(set & rule.one)) {
      for (const pieces::Field other : list(set & rule.other)) {
        conflicts.push_back({one, other, beside.empty() ? std::nullopt : std::optional(beside.front()), rule.reason});
      }
    }
  }
  return conflicts;
}

std::vector<pieces::Conflict> pieces::find_conflicts(const HeightField& field, const SimplifyOptions& options) {
  return pieces::find_conflicts(pieces::fields_of(field, options));
}

std::string pieces::describe(const pieces::Conflict& conflict) { return pieces::describe(conflict, pieces::name_of); }

std::vector<std::string> list_conflicts(const HeightField& field, const SimplifyOptions& options) {
  return sentences(pieces::find_conflicts(field, options));
}

std::vector<std::string> list_conflicts(const PyramidSettings& settings) {
  pieces::Fields fields;
  if (settings.grid.kind == GridKind::kMercator) fields.add(pieces::Field::kTileMercator);
  if (settings.grid.is_flat()) fields.add(pieces::Field::kTileLocal);
  if (!settings.lines.empty()) fields.add(pieces::Field::kTileLines);
  if (settings.only) fields.add(pieces::Field::kTileOnly);
  return sentences(pieces::find_conflicts(fields));
}

}  // namespace scarp
