// A print is proven as it is written: float32 positions of its tops are moved back to the raster's samples and judged.
// This gives the error by rounding, and the next run reserves twice as much.
#include "scarp/print.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>
#include <string>
#include <utility>

#include "measure/judge.h"
#include "mesh/print_tiles.h"
#include "scarp/height_field.h"
#include "scarp/measure.h"

namespace scarp {
namespace {

constexpr double kThickness = 0.02;  // share of the longest side
constexpr double kReserve = 0x1p-10;
constexpr int kMostPrints = 4;

Result<void> check_print(const PrintOptions& print) {
  const auto is_above_0 = [](double value) { return value > 0 && std::isfinite(value); };
  const auto refuse = [](const char* name, double value) {
    return fail(ErrorKind::kUsage, fmt::format("{}={:.10g} is not above 0 and finite", name, value));
  };
  if (print.base && !std::isfinite(*print.base))
    return fail(ErrorKind::kUsage, fmt::format("base={} is not finite", *print.base));
  if (print.base.has_value() + print.thickness.has_value() + print.printed_thickness.has_value() > 1)
    return fail(ErrorKind::kUsage, "base cannot be combined with thickness; drop one of them");
  if (print.thickness && !is_above_0(*print.thickness)) return refuse("thickness", *print.thickness);
  if (print.printed_thickness && !is_above_0(*print.printed_thickness))
    return refuse("printed_thickness", *print.printed_thickness);
  if (print.size && !is_above_0(*print.size)) return refuse("size", *print.size);
  if (!is_above_0(print.exaggerate)) return refuse("exaggerate", print.exaggerate);
  if (print.max_error && !is_above_0(*print.max_error)) return refuse("max_error", *print.max_error);
  if (print.columns < 1 || print.rows < 1)
    return fail(ErrorKind::kUsage,
                fmt::format("print tiles: {} x {} are none: there must be at least 1 x 1", print.columns, print.rows));
  if ((print.gap != 0 || print.dovetail) && !print.is_split())
    return fail(ErrorKind::kUsage, "print tiles: a single one has no neighbours, so no gap and no dovetail");
  return {};
}

/// `value` with six significant digits.
double keep_six_digits(double value) {
  std::string text = fmt::format("{:.5e}", value);
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return value;  // not finite
  const long power = std::strtol(text.c_str() + e + 1, nullptr, 10) - 5;
  text.resize(e);
  text.erase(std::remove(text.begin(), text.end(), '.'), text.end());
  const auto digits = static_cast<double>(std::strtol(text.c_str(), nullptr, 10));
  // Powers up to the 22nd are exact, so the result is the nearest number.
  double factor = 1;
  for (long k = 0; k < std::min(std::labs(power), 22L); ++k) factor *= 10;
  if (std::labs(power) > 22) factor *= std::pow(10.0, static_cast<double>(std::labs(power) - 22));
  return power < 0 ? digits / factor : digits * factor;
}

/// Rounds to six significant digits if the result is below the limit.
double shorten_below(double value, double limit) {
  const double shorter = keep_six_digits(value);
  return shorter < limit ? shorter : value;
}

/// Rounds down to six significant digits, so that the number is short and the print no larger than requested.
double round_down(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 5);
  const double below = std::floor(value / unit) * unit;
  return keep_six_digits(below <= value ? below : below - unit);
}

Result<void> place_print(const PrintOptions& options, const Mesh& terrain, Print& print) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::array<double, 3> low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
  for (std::size_t v = 0; v < terrain.vertex_count(); ++v) {
    const auto place = terrain.vertex(v);
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], place[k]);
      high[k] = std::max(high[k], place[k]);
    }
  }
  const double longest = std::max(high[0] - low[0], high[1] - low[1]);
  const double scale = options.size ? round_down(*options.size / longest) : 1;
  const double up = scale * options.exaggerate;
  print.placement.scale = {scale, scale, up};
  if (options.base) {
    print.base = *options.base;
  } else if (options.thickness || options.printed_thickness) {
    print.base = shorten_below(low[2] - options.thickness.value_or(options.printed_thickness.value_or(0) / up), low[2]);
  } else {
    print.base = shorten_below(low[2] - kThickness * longest * scale / up, low[2]);
  }
  if (!(print.base < low[2])) {
    return fail(ErrorKind::kUsage,
                fmt::format("base={:.10g} is not below the lowest vertex, which is at {:.10g}: choose a lower one",
                            print.base, low[2]));
  }
  print.placement.origin = {low[0], low[1], print.base};
  return {};
}

/// The tops of all print tiles, moved to the raster's samples.
Mesh join_tops(const std::vector<PrintTile>& tiles, const std::vector<std::size_t>& top_sizes) {
  Mesh tops;
  for (std::size_t k = 0; k < tiles.size(); ++k) {
    Mesh tile = tiles[k].mesh;
    undo_placement(tile);
    const auto first = static_cast<std::uint32_t>(tops.vertex_count());
    tops.origin = tile.origin;
    tops.positions.insert(tops.positions.end(), tile.positions.begin(), tile.positions.end());
    for (std::size_t i = 0; i < top_sizes[k]; ++i) tops.triangles.push_back(first + tile.triangles[i]);
  }
  return tops;
}

/// Width and height of a cell in the frame.
std::array<double, 2> cell_of(const Frame& frame) {
  return {std::hypot(frame.affine[1], frame.affine[4]), std::hypot(frame.affine[2], frame.affine[5])};
}

/// The longest side, in the frame, of the area with heights. Reads a field that is not in memory once, some rows at a
/// time.
Result<double> longest_side(const HeightField& field) {
  int left = field.cols, right = -1, top = field.rows, bottom = -1;
  constexpr int kSamplesTogether = 1 << 18;
  const int together = std::clamp(kSamplesTogether / field.cols, 1, field.rows);
  const auto cols = static_cast<std::size_t>(field.cols);
  std::vector<float> read;
  for (int first = 0; first < field.rows; first += together) {
    const int count = std::min(together, field.rows - first);
    const float* samples = field.samples + static_cast<std::size_t>(first) * cols;
    if (field.source != nullptr) {
      read.resize(static_cast<std::size_t>(count) * cols);
      SCARP_RETURN_IF_ERROR(field.source->read(0, first, field.cols, count, read.data(), field.cols));
      samples = read.data();
    }
    for (int row = first; row < first + count; ++row) {
      for (int col = 0; col < field.cols; ++col) {
        if (!std::isfinite(samples[static_cast<std::size_t>(row - first) * cols + static_cast<std::size_t>(col)]))
          continue;
        left = std::min(left, col);
        right = std::max(right, col);
        top = std::min(top, row);
        bottom = std::max(bottom, row);
      }
    }
  }
  const auto a = field.frame.apply_affine(left, top), b = field.frame.apply_affine(right, bottom),
             c = field.frame.apply_affine(left, bottom), d = field.frame.apply_affine(right, top);
  const auto span = [&](std::size_t k) {
    return std::max({a[k], b[k], c[k], d[k]}) - std::min({a[k], b[k], c[k], d[k]});
  };
  return std::max(span(0), span(1));
}

/// Plans the print tiles; nothing for a whole print.
Result<std::optional<mesh::PrintTilePlan>> plan_print_tiles(const PrintOptions& print, const HeightField& field) {
  if (!print.is_split()) return std::optional<mesh::PrintTilePlan>();
  if (!field.frame.is_affine())
    return fail(
        ErrorKind::kUsage,
        "print tiles: they are cut along rows and columns of the raster, which the frame bends; choose a frame that "
        "is affine");
  mesh::PrintTileOptions options;
  options.columns = print.columns;
  options.rows = print.rows;
  options.dovetail = print.dovetail;
  options.cell = cell_of(field.frame);
  if (print.gap != 0) {
    SCARP_TRY(const double longest, longest_side(field));
    for (double& side : options.cell) side *= print.size ? *print.size / longest : 1;
    options.gap = print.gap;
  }
  Result<mesh::PrintTilePlan> tiles = mesh::PrintTilePlan::make(field.cols, field.rows, options);
  if (!tiles) return fail(tiles.error().kind, "print tiles: " + tiles.error().message);
  return std::optional(std::move(*tiles));
}

/// The samples of a print: a raster or points.
struct PrintTask {
  /// Simplifies towards a max error, if there is one.
  std::function<Result<Simplified>(std::optional<double> max_error)> make;
  /// Cuts the terrain, whose edges include the cuts, into print tiles.
  std::function<std::vector<Mesh>(const Mesh& terrain)> cut;
  /// Judges the tops against the samples.
  std::function<Result<Measurement>(const Mesh& tops)> judge;
  double rounding = 0;  ///< HeightField::sample_rounding
};

/// Places, cuts and closes the terrain, and judges its tops.
Result<Print> make_print(const PrintOptions& options, const PrintTask& task, const Mesh& terrain) {
  Print print;
  SCARP_RETURN_IF_ERROR(place_print(options, terrain, print));
  std::vector<Mesh> tops = task.cut(terrain);
  std::vector<std::size_t> top_sizes;
  for (std::size_t k = 0; k < tops.size(); ++k) {
    if (tops[k].triangles.empty()) {
      ++print.empty_tiles;
      continue;
    }
    if (options.is_placed()) place_mesh(tops[k], print.placement);
    top_sizes.push_back(tops[k].triangles.size());
    SCARP_TRY(Mesh solid, build_solid(std::move(tops[k]), options.is_placed() ? 0 : print.base));
    const int columns = options.columns, at = static_cast<int>(k);
    SolidFacts facts = measure_solid(solid);
    print.tiles.push_back({at / columns + 1, at % columns + 1, std::move(solid), facts});
  }
  SCARP_TRY(const Measurement& judged, task.judge(join_tops(print.tiles, top_sizes)));
  print.max_error = judged.max_error;
  print.uncovered = judged.uncovered;
  print.heights = judged.heights;
  if (judged.uncovered > 0 && options.gap == 0) {
    return fail(ErrorKind::kPromise,
                fmt::format("the solid leaves out {} sample{}{}: it is too small for float32 to tell samples apart",
                            judged.uncovered, judged.uncovered == 1 ? "" : "s",
                            judged.uncovered_at[0] < 0 ? ""
                                                       : fmt::format(", the first at column {}, row {}",
                                                                     judged.uncovered_at[0], judged.uncovered_at[1])));
  }
  return print;
}

/// Adds the cuts to the lines that simplify() inserts.
void add_cuts(const mesh::PrintTilePlan& tiles, LineConstraints& breaklines) {
  for (Line& line : tiles.lines(breaklines.affine)) breaklines.lines.push_back(std::move(line));
}

/// Remakes the mesh until the bound holds for its print. `asked`: Goals::max_error. Within a cutline, the mesh may be
/// smaller than the samples; then the scale is larger than `scale`, and the run is repeated.
Result<PrintedTerrain> remake(const PrintOptions& print, const PrintTask& task, std::optional<double> asked,
                              double scale) {
  const auto tighten = [&](double by) {
    if (print.max_error) asked = std::min(asked.value_or(HUGE_VAL), *print.max_error / by);
  };
  tighten(scale);
  std::optional<double> towards;
  if (asked) towards = *asked * (1 - kReserve);
  for (int run = 1;; ++run) {
    SCARP_TRY(Simplified simplified, task.make(towards));
    SCARP_TRY(Print made, make_print(print, task, simplified.mesh));
    const std::optional<double> before = asked;
    tighten(made.placement.scale[2]);
    const double excess =
        asked ? made.max_error + task.rounding - *asked - judge::judging_allowance(*asked, made.heights) : 0;
    const bool has_budget_ended =
        simplified.stop == StopReason::kMaxTriangles || simplified.stop == StopReason::kMaxVertices;
    if (!(excess > 0) || has_budget_ended) return PrintedTerrain{std::move(simplified), std::move(made)};
    towards = *asked < *before ? *asked * (1 - kReserve) : *towards - 2 * excess;
    if (run == kMostPrints || *towards < 0) {
      return fail(ErrorKind::kPromise,
                  fmt::format("the solid's max error is {:.6g} and not {:.6g}: its positions are rounded to float32, "
                              "which costs the rest; ask for a larger error or a larger size",
                              made.max_error, *asked));
    }
  }
}

/// The longest side of the points' extent; `low`: its corner.
double longest_side(const PointSet& points, std::array<double, 3>& low) {
  double longest = 0;
  for (std::size_t k = 0; k < 2 && points.size() > 0; ++k) {
    const auto [least, most] =
        std::minmax_element((k == 0 ? points.x : points.y).begin(), (k == 0 ? points.x : points.y).end());
    longest = std::max(longest, *most - *least);
    low[k] = *least;
  }
  return longest;
}

/// The placement that place_print() will choose, as for the extent of the points; z is not known yet.
Result<Placement> foresee_placement(const PointSet& points, const PrintOptions& print) {
  SCARP_RETURN_IF_ERROR(check_print(print));
  Placement placement;
  const double longest = longest_side(points, placement.origin);
  if (!(longest > 0))
    return fail(ErrorKind::kInput, "all points lie at one place; a surface needs at least three places");
  const double scale = print.size ? round_down(*print.size / longest) : 1;
  placement.scale = {scale, scale, scale * print.exaggerate};
  return placement;
}

}  // namespace

std::uint64_t Print::vertices() const {
  std::uint64_t sum = 0;
  for (const PrintTile& tile : tiles) sum += tile.mesh.vertex_count();
  return sum;
}

std::uint64_t Print::triangles() const {
  std::uint64_t sum = 0;
  for (const PrintTile& tile : tiles) sum += tile.facts.triangles;
  return sum;
}

Result<double> estimate_print_scale(const HeightField& field, const PrintOptions& print) {
  SCARP_RETURN_IF_ERROR(check_print(print));
  if (!print.size) return print.exaggerate;
  SCARP_TRY(const double longest, longest_side(field));
  if (!(longest > 0)) return fail(ErrorKind::kInput, "no sample has a height");
  return round_down(*print.size / longest) * print.exaggerate;
}

Result<double> estimate_print_scale(const PointSet& points, const PrintOptions& print) {
  SCARP_TRY(const Placement& placement, foresee_placement(points, print));
  return placement.scale[2];
}

Result<PrintedTerrain> simplify_for_print(OwnedHeightField& field, const PrintOptions& print, SimplifyOptions options) {
  SCARP_RETURN_IF_ERROR(check_print(print));
  if (field.frame.space) return fail(ErrorKind::kUsage, "a print stands on a flat base: choose a frame on the map");
  double scale = 1;
  if (print.max_error) {
    SCARP_TRY(scale, estimate_print_scale(field, print));
  }
  SCARP_TRY(const std::optional<mesh::PrintTilePlan>& tiles, plan_print_tiles(print, field));
  const auto lines = static_cast<std::ptrdiff_t>(options.features.breaklines.lines.size());
  if (tiles) add_cuts(*tiles, options.features.breaklines);
  const auto cuts = static_cast<std::uint64_t>(std::ssize(options.features.breaklines.lines) - lines);
  options.output.float32_positions = false;  // positions are rounded in the print
  std::optional<std::vector<SampleEdit>> edits;
  PrintTask task;
  task.make = [&](std::optional<double> max_error) -> Result<Simplified> {
    options.goals.max_error = max_error;
    SCARP_TRY(Simplified simplified, simplify(field, options));
    apply_edits(simplified.edits, field);
    if (!edits) edits = simplified.edits;
    return simplified;
  };
  task.cut = [&](const Mesh& terrain) {
    return tiles ? mesh::cut_print_tiles(terrain, field.frame, *tiles) : std::vector{terrain};
  };
  task.judge = [&](const Mesh& tops) {
    MeasureOptions measuring;
    measuring.topology = false;
    measuring.cutline = options.features.cutline.rings.empty() ? nullptr : &options.features.cutline;
    measuring.run.threads = options.run.threads;
    return measure(field, tops, measuring);
  };
  task.rounding = field.sample_rounding;
  SCARP_TRY(PrintedTerrain printed, remake(print, task, options.goals.max_error, scale));
  Simplified& simplified = printed.simplified;
  simplified.edits = std::move(*edits);
  simplified.lines_inserted -= std::min(cuts, simplified.lines_inserted);
  auto& fitted = simplified.features.lines.lines;
  if (cuts > 0) fitted.erase(fitted.begin() + lines, fitted.begin() + lines + static_cast<std::ptrdiff_t>(cuts));
  return printed;
}

Result<PrintedPoints> simplify_for_print(const PointSet& points, const PrintOptions& print, PointOptions options) {
  SCARP_TRY(Placement placement, foresee_placement(points, print));
  const double scale = placement.scale[2];
  if (print.is_split())
    return fail(ErrorKind::kUsage,
                "print tiles: they are cut along rows and columns of a raster, and points have none");
  options.float32_positions = false;
  // A solid that is not placed has float32 offsets from the origin of the mesh.
  if (const auto [x, y] = local_origin(points); !print.is_placed()) placement.origin = {x, y, 0};
  options.placement = placement;
  SimplifiedPoints made;
  PrintTask task;
  task.make = [&](std::optional<double> max_error) -> Result<Simplified> {
    options.max_error = max_error;
    SCARP_TRY(made, simplify_points(points, options));
    return std::move(made.simplified);
  };
  task.cut = [](const Mesh& terrain) { return std::vector{terrain}; };
  task.judge = [&](const Mesh& tops) -> Result<Measurement> {
    MeasureOptions measuring;
    measuring.topology = false;
    measuring.inlets = options.boundary_length.has_value();
    measuring.run.threads = options.run.threads;
    SCARP_TRY(Measurement measured, measure_points(points, tops, options.duplicates, measuring));
    const auto [least, most] = std::minmax_element(points.z.begin(), points.z.end());
    measured.heights.min = *least;
    measured.heights.max = *most;
    return measured;
  };
  SCARP_TRY(PrintedTerrain printed, remake(print, task, options.max_error, scale));
  made.simplified = std::move(printed.simplified);
  return PrintedPoints{std::move(made), std::move(printed.print)};
}

}  // namespace scarp
