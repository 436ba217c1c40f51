#include "pieces/conflicts.h"

#include <algorithm>
#include <array>

#include "pieces/recipe.h"
#include "scarp/options.h"
#include "scarp/tile.h"

namespace scarp::pieces {
namespace {

constexpr Fields kBudgets(Field::kMaxTriangles, Field::kMaxVertices);
constexpr Fields kTolerances(Field::kTolerance, Field::kToleranceSource);
constexpr Fields kWeights(Field::kMask, Field::kMaskSource);
constexpr Fields kLines(Field::kBreaklines, Field::kCutline);
constexpr Fields kInsertedFirst(Field::kWalls, Field::kRidges);
constexpr Fields kShapes(Field::kShape);
constexpr Fields kEfforts(Field::kEffortNormal, Field::kEffortHigh, Field::kEffortMax);
/// Settings that require an effort above fast.
constexpr Fields kAsksForEffort(Field::kMinShape, Field::kTimeLimit, Field::kObjectiveRms, Field::kVerticesFree);

constexpr ConflictRule kRules[] = {
    {Fields(Field::kStrategy),
     kLines | kShapes | kEfforts | kAsksForEffort | Fields(Field::kOrderDominant),
     {},
     Where::kAlways,
     "a strategy of the 1995 paper only inserts vertices, in the greedy order"},
    {kWeights,
     kTolerances,
     {},
     Where::kAlways,
     "divide the max error by the weights, and give one tolerance for each sample"},

    {Fields(Field::kOrderDominant),
     Fields(Field::kPoints),
     {},
     Where::kAlways,
     "the dominant order starts from the outline alone"},
    {Fields(Field::kOrderDominant),
     Fields(Field::kOutlineTolerance),
     {},
     Where::kAlways,
     "the dominant order keeps the exact outline"},
    {Fields(Field::kOrderDominant),
     Fields(Field::kChannels),
     {},
     Where::kAlways,
     "the dominant order works on heights alone, without channels"},
    {Fields(Field::kOrderDominant),
     kInsertedFirst,
     {},
     Where::kInMemory,
     "in memory walls and ridges are inserted before refinement, which then takes the greedy order"},

    {Fields(Field::kBorder),
     Fields(Field::kStrategy),
     {},
     Where::kAlways,
     "a strategy of the 1995 paper inserts samples of the edge, too"},
    {Fields(Field::kBorder),
     kInsertedFirst | kShapes | Fields(Field::kCutline),
     {},
     Where::kAlways,
     "cutlines, walls, ridges, angles and edge lengths need vertices of their own on the border"},
    {Fields(Field::kLevels), kLines, {}, Where::kAlways, "lines need vertices on the border, which all levels share"},
    {Fields(Field::kBorder),
     Fields(Field::kOutlineTolerance),
     {},
     Where::kAlways,
     "a simplified outline leaves the samples of the border"},
    {Fields(Field::kBorder),
     Fields(Field::kCurvedFrame),
     {},
     Where::kAlways,
     "a curved border needs vertices of its own; project the raster instead (gdalwarp -t_srs EPSG:CODE -r bilinear -ot "
     "Float32 -dstnodata -9999 FILE NEW.tif)"},
    {Fields(Field::kLevels),
     kBudgets | kTolerances | Fields(Field::kObjectiveRms),
     {},
     Where::kAlways,
     "levels are meshes of one max error each, from the finest on"},
    {Fields(Field::kLevels),
     Fields(Field::kTimeLimit),
     {},
     Where::kAlways,
     "the finest level would take the time of all"},
    {Fields(Field::kBorder), kBudgets, kTolerances, Where::kAlways,
     "a budget enlarges all tolerances, and the border's with them"},

    {kLines, Fields(Field::kOutlineTolerance), {}, Where::kAlways, "a mesh with lines keeps the exact outline"},
    {kShapes,
     Fields(Field::kOutlineTolerance),
     {},
     Where::kAlways,
     "a mesh with goals for angles and edges keeps the exact outline"},
    {kLines | kShapes,
     Fields(Field::kChannels),
     {},
     Where::kAlways,
     "vertices come to lie between samples, where channels have no value"},
    {kLines | kShapes,
     Fields(Field::kCurvedFrame),
     {},
     Where::kAlways,
     "vertices come to lie between samples, which needs a frame in which the grid is regular"},
    {Fields(Field::kWalls), kShapes, {}, Where::kAlways, "the two lines of a wall lie too close together for angles"},

    {Fields(Field::kEffortFast), kAsksForEffort, {}, Where::kAlways, "fast effort only refines"},
    {Fields(Field::kVerticesFree),
     Fields(Field::kChannels),
     {},
     Where::kAlways,
     "channels have no value between samples"},
    {Fields(Field::kVerticesFree),
     Fields(Field::kCurvedFrame),
     {},
     Where::kAlways,
     "free vertices need a frame in which the grid is regular"},
    {Fields(Field::kSpaceFrame), Fields(Field::kChannels), {}, Where::kAlways, "an error in space is of heights alone"},
    {Fields(Field::kTimeLimit), kBudgets, Fields(Field::kEffortMax), Where::kAlways,
     "max effort takes all of the time for one mesh, and a budget is met by several"},
    {Fields(Field::kSource),
     Fields(Field::kOrderGreedy),
     {},
     Where::kStreamed,
     "streamed samples are refined tile by tile, in the dominant order"},
    {Fields(Field::kSource),
     Fields(Field::kMask, Field::kTolerance),
     {},
     Where::kStreamed,
     "streamed samples take their weights and tolerances from a source"},
    {Fields(Field::kSource),
     Fields(Field::kPoints),
     {},
     Where::kStreamed,
     "streamed samples are refined strip by strip, from the outline alone"},
    {Fields(Field::kSource),
     Fields(Field::kStrategy),
     {},
     Where::kStreamed,
     "streamed samples are refined tile by tile, in the dominant order, with Delaunay edges"},
    {Fields(Field::kSource),
     Fields(Field::kOutlineTolerance),
     {},
     Where::kStreamed,
     "an outline is simplified as a whole"},
    {Fields(Field::kSource),
     Fields(Field::kSpaceFrame),
     {},
     Where::kStreamed,
     "a mesh in space is proven and mended with all samples in memory"},
    {Fields(Field::kSource), Fields(Field::kBorder), {}, Where::kStreamed, "strips would put vertices on the border"},
    {Fields(Field::kSource), Fields(Field::kChannels), {}, Where::kStreamed, "channels are held in memory"},

    {Fields(Field::kTileLakes, Field::kTileRivers),
     Fields(Field::kTileLocal),
     {},
     Where::kAlways,
     "lakes and rivers are laid in degrees; flatten them first (scarp simplify RASTER NEW.tif -e 0 --water LAKES)"},
    {Fields(Field::kTileLines), Fields(Field::kTileLocal), {}, Where::kAlways, "lines are laid in degrees"},
    {Fields(Field::kTileDrape),
     Fields(Field::kTileLocal),
     {},
     Where::kAlways,
     "images are laid in degrees; load them in the client"},
    {Fields(Field::kTileOnly),
     Fields(Field::kTileLocal),
     {},
     Where::kAlways,
     "it is a box in degrees; read a part of the raster instead (--te)"},
    {Fields(Field::kTileQuantizedMesh),
     Fields(Field::kTileLocal),
     {},
     Where::kAlways,
     "quantized-mesh lies on the ellipsoid; --of 3dtiles holds a plane"},
    {Fields(Field::kTileGlb),
     Fields(Field::kTileMercator),
     {},
     Where::kAlways,
     "clients of 3D Tiles halve tiles in degrees of latitude"},
    {Fields(Field::kTileLines),
     Fields(Field::kTileMercator),
     {},
     Where::kAlways,
     "lines cross its tiles at places that nodes do not divide evenly; take the geographic grid"},
    {Fields(Field::kTileGlb),
     Fields(Field::kTileWaterMask),
     {},
     Where::kAlways,
     "masks are an extension of quantized-mesh; lakes of --water are flat without"},
    {Fields(Field::kTileDrape),
     Fields(Field::kTileQuantizedMesh),
     {},
     Where::kAlways,
     "clients of quantized-mesh lay images over the terrain themselves; tiles of --of 3dtiles hold theirs"},
    {Fields(Field::kTileGeoid),
     Fields(Field::kTileVertical),
     {},
     Where::kAlways,
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
static_assert(std::size(kNames) == kFieldCount);

bool holds(Where where, bool is_streamed) {
  return where == Where::kAlways || (where == Where::kStreamed) == is_streamed;
}

std::vector<Field> list(Fields all) {
  std::vector<Field> list;
  for (int k = 0; k < kFieldCount; ++k) {
    if (all.has(static_cast<Field>(k))) list.push_back(static_cast<Field>(k));
  }
  return list;
}

std::vector<std::string> sentences(const std::vector<Conflict>& conflicts) {
  std::vector<std::string> all;
  for (const Conflict& conflict : conflicts) all.push_back(describe(conflict));
  return all;
}

}  // namespace

std::string_view name_of(Field field) { return kNames[static_cast<int>(field)]; }

std::span<const ConflictRule> conflict_rules() { return kRules; }

Fields fields_of(const HeightField& field, const SimplifyOptions& options) {
  const Features& features = options.features;
  const auto& lines = features.breaklines.lines;
  const std::pair<Field, bool> all[] = {
      {Field::kMaxError, options.goals.max_error.has_value()},
      {Field::kMaxTriangles, options.goals.max_triangles.has_value()},
      {Field::kMaxVertices, options.goals.max_vertices.has_value()},
      {Field::kOutlineTolerance, options.domain.outline_tolerance > 0},
      {Field::kBorder, options.domain.border.is_locked},
      {Field::kDoublePositions, !options.output.float32_positions},
      {Field::kMask, !options.tolerances.weights.empty()},
      {Field::kMaskSource, options.tolerances.weights_source != nullptr},
      {Field::kTolerance, !options.tolerances.values.empty()},
      {Field::kToleranceSource, options.tolerances.source != nullptr},
      {Field::kBreaklines, features.have_lines()},
      {Field::kWalls, features.walls || std::any_of(lines.begin(), lines.end(), is_wall)},
      {Field::kRidges, features.ridges || std::any_of(lines.begin(), lines.end(), is_ridge_line)},
      {Field::kCutline, !options.features.cutline.rings.empty()},
      {Field::kIgnored, !options.tolerances.ignored.empty()},
      {Field::kPoints, !features.points.empty()},
      {Field::kOrderGreedy, options.quality.order == Order::kGreedy},
      {Field::kOrderDominant, options.quality.order == Order::kDominant},
      {Field::kEffortFast, options.quality.effort == Effort::kFast},
      {Field::kEffortNormal, options.quality.effort == Effort::kNormal},
      {Field::kEffortHigh, options.quality.effort == Effort::kHigh},
      {Field::kEffortMax, options.quality.effort == Effort::kMax},
      {Field::kVerticesSamples, options.quality.vertices == Vertices::kSamples},
      {Field::kVerticesFree, options.quality.vertices == Vertices::kFree},
      {Field::kMinShape, options.quality.min_shape.has_value()},
      {Field::kShape, options.quality.shape.any()},
      {Field::kTimeLimit, static_cast<bool>(options.run.is_time_up)},
      {Field::kEnough, static_cast<bool>(options.run.is_enough)},
      {Field::kObjectiveRms, options.goals.objective == Objective::kRms},
      {Field::kStrategy, false},
      {Field::kLevels, false},
      {Field::kNorm, options.goals.norm != Norm::kSum},
      {Field::kLattice, options.output.lattice},
      {Field::kUvs, options.output.uvs},
      {Field::kNormals, options.output.normals},
      {Field::kThreads, options.run.threads != 0},
      {Field::kMemoryLimit, options.run.memory.limit > 0},
      {Field::kChannels, has_norm(field)},
      {Field::kCurvedFrame, !field.frame.is_affine()},
      {Field::kSpaceFrame, field.frame.space != nullptr},
      {Field::kSource, field.samples == nullptr && field.source != nullptr},
  };
  static_assert(std::size(all) == kSimplifyFieldCount);
  Fields fields;
  for (const auto& [of, is_set] : all) {
    if (is_set) fields.add(of);
  }
  return fields;
}

std::vector<Conflict> find_conflicts(Fields set) {
  std::vector<Conflict> conflicts;
  for (const ConflictRule& rule : kRules) {
    if (!holds(rule.where, set.has(Field::kSource)) || !set.has_any(rule.one) || !set.has_any(rule.other)) continue;
    if (!rule.beside.empty() && !set.has_any(rule.beside)) continue;
    const std::vector<Field> beside = list(set & rule.beside);
    for (const Field one : list(set & rule.one)) {
      for (const Field other : list(set & rule.other)) {
        conflicts.push_back({one, other, beside.empty() ? std::nullopt : std::optional(beside.front()), rule.reason});
      }
    }
  }
  return conflicts;
}

std::vector<Conflict> find_conflicts(const HeightField& field, const SimplifyOptions& options) {
  return find_conflicts(fields_of(field, options));
}

std::string describe(const Conflict& conflict) { return describe(conflict, name_of); }

}  // namespace scarp::pieces

namespace scarp {

std::vector<std::string> list_conflicts(const HeightField& field, const SimplifyOptions& options) {
  return pieces::sentences(pieces::find_conflicts(field, options));
}

std::vector<std::string> list_conflicts(const PyramidSettings& settings) {
  pieces::Fields fields;
  if (settings.grid.kind == GridKind::kMercator) fields.add(pieces::Field::kTileMercator);
  if (settings.grid.is_flat()) fields.add(pieces::Field::kTileLocal);
  if (!settings.lines.empty()) fields.add(pieces::Field::kTileLines);
  if (settings.only) fields.add(pieces::Field::kTileOnly);
  return pieces::sentences(pieces::find_conflicts(fields));
}

}  // namespace scarp
