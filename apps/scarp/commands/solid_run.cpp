#include "commands/solid_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "commands/simplify_run.h"
#include "options/line_options.h"
#include "reports/report.h"
#include "reports/verdict.h"
#include "terminal/text.h"

namespace scarp::cli {
namespace {

/// The tops of all sheets where the raster's samples are.
Mesh join_tops(const std::vector<Sheet>& sheets, const std::vector<std::size_t>& top_sizes) {
  Mesh tops;
  for (std::size_t k = 0; k < sheets.size(); ++k) {
    Mesh sheet = sheets[k].mesh;
    undo_placement(sheet);
    const auto first = static_cast<std::uint32_t>(tops.vertex_count());
    tops.origin = sheet.origin;
    tops.positions.insert(tops.positions.end(), sheet.positions.begin(), sheet.positions.end());
    for (std::size_t i = 0; i < top_sizes[k]; ++i) tops.triangles.push_back(first + sheet.triangles[i]);
  }
  return tops;
}

/// Width and height of a cell in the frame.
std::array<double, 2> cell_of(const Frame& frame) {
  return {std::hypot(frame.affine[1], frame.affine[4]), std::hypot(frame.affine[2], frame.affine[5])};
}

/// The longest side of what has heights, in the frame. Reads a field that is not in memory once, some rows at a time.
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
      if (auto has = field.source->read(0, first, field.cols, count, read.data(), field.cols); !has)
        return tl::unexpected(has.error());
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

std::string size_text(const SolidFacts& facts, const SolidPlan& plan) {
  return fmt::format("{} x {} x {}{}", format_number(facts.high[0] - facts.low[0]),
                     format_number(facts.high[1] - facts.low[1]), format_number(facts.high[2] - facts.low[2]),
                     plan.size ? " mm" : "");
}

Json describe_facts(const Mesh& mesh, const SolidFacts& facts) {
  Json size = Json::array();
  for (std::size_t k = 0; k < 3; ++k) size.push_back(facts.high[k] - facts.low[k]);
  return Json{{"vertices", mesh.vertex_count()}, {"triangles", facts.triangles}, {"size", std::move(size)},
              {"volume", facts.volume},          {"parts", facts.parts},         {"closed", facts.is_solid()}};
}

}  // namespace

std::uint64_t Print::vertices() const {
  std::uint64_t sum = 0;
  for (const Sheet& sheet : sheets) sum += sheet.mesh.vertex_count();
  return sum;
}

std::uint64_t Print::triangles() const {
  std::uint64_t sum = 0;
  for (const Sheet& sheet : sheets) sum += sheet.facts.triangles;
  return sum;
}

Result<std::optional<SheetPlan>> plan_sheets(const SolidPlan& plan, const HeightField& field) {
  if (!plan.is_split()) return std::optional<SheetPlan>();
  if (!field.frame.is_affine()) {
    return fail(
        ErrorKind::kUsage,
        "--split cuts along rows and columns of the raster, which --crs bends here: leave it out, or choose local "
        "or source");
  }
  SheetOptions options;
  options.columns = plan.columns;
  options.rows = plan.rows;
  options.dovetail = plan.dovetail;
  options.cell = cell_of(field.frame);
  if (plan.gap) {
    const Result<double> longest = longest_side(field);
    if (!longest) return tl::unexpected(longest.error());
    for (double& side : options.cell) side *= plan.size ? *plan.size / *longest : 1;
    options.gap = plan.gap->value;
  }
  Result<SheetPlan> sheets = SheetPlan::make(field.cols, field.rows, options);
  if (!sheets) return fail(sheets.error().kind, "--split: " + sheets.error().message);
  return std::optional(std::move(*sheets));
}

Result<Print> make_print(const SolidPlan& plan, const HeightField& field, const SheetPlan* sheets, const Mesh& terrain,
                         const Cutline* cutline, int threads) {
  const Result<SolidPlace> place = find_place(plan, terrain);
  if (!place) return tl::unexpected(place.error());
  Print print;
  print.place = *place;
  std::vector<Mesh> tops = sheets != nullptr ? cut_sheets(terrain, field.frame, *sheets) : std::vector{terrain};
  std::vector<std::size_t> top_sizes;
  for (std::size_t k = 0; k < tops.size(); ++k) {
    if (tops[k].triangles.empty()) {
      ++print.empty_sheets;
      continue;
    }
    if (plan.is_placed()) place_mesh(tops[k], place->placement);
    top_sizes.push_back(tops[k].triangles.size());
    Result<Mesh> solid = build_solid(std::move(tops[k]), plan.is_placed() ? 0 : place->base);
    if (!solid) return tl::unexpected(std::move(solid.error()));
    const int columns = plan.columns, at = static_cast<int>(k);
    SolidFacts facts = measure_solid(*solid);
    print.sheets.push_back({at / columns + 1, at % columns + 1, std::move(*solid), facts});
  }
  MeasureOptions options;
  options.topology = false;
  options.cutline = cutline;
  options.threads = threads;
  const Result<Measurement> judged = measure(field, join_tops(print.sheets, top_sizes), options);
  if (!judged) return tl::unexpected(judged.error());
  print.max_error = judged->max_error;
  print.uncovered = judged->uncovered;
  print.heights = judged->heights;
  if (judged->uncovered > 0 && !plan.gap) {
    return fail(ErrorKind::kPromise, fmt::format("the solid leaves out {}, the first at column {}, row {}: it is too "
                                                 "small for float32 to tell samples apart",
                                                 format_plural(judged->uncovered, "sample"), judged->uncovered_at[0],
                                                 judged->uncovered_at[1]));
  }
  return print;
}

Result<PrintedTerrain> simplify_for_print(const SolidPlan& plan, OwnedHeightField& field, SimplifyOptions options) {
  const Result<std::optional<SheetPlan>> sheets = plan_sheets(plan, field);
  if (!sheets) return tl::unexpected(sheets.error());
  std::uint64_t cuts = 0;
  if (*sheets) {
    for (Line& line : (*sheets)->lines(options.breaklines.affine))
      options.breaklines.lines.push_back(std::move(line)), ++cuts;
  }
  options.float32_positions = false;  // they are rounded where the print stands
  constexpr double kReserve = 0x1p-10;
  constexpr int kMostRuns = 4;
  const std::optional<double> asked = options.max_error;
  const Cutline* cutline = options.cutline.rings.empty() ? nullptr : &options.cutline;
  if (asked) options.max_error = *asked * (1 - kReserve);
  std::vector<SampleEdit> edits;
  for (int run = 1;; ++run) {
    Result<Simplified> simplified = simplify(field, options);
    if (!simplified) return tl::unexpected(std::move(simplified.error()));
    apply_edits(simplified->edits, field);
    if (run == 1) edits = simplified->edits;
    Result<Print> print =
        make_print(plan, field, *sheets ? &**sheets : nullptr, simplified->mesh, cutline, options.threads);
    if (!print) return tl::unexpected(std::move(print.error()));
    const double excess =
        asked ? print->max_error + field.sample_rounding - *asked - judging_allowance(*asked, print->heights) : 0;
    const bool has_budget_ended =
        simplified->stop == StopReason::kMaxTriangles || simplified->stop == StopReason::kMaxVertices;
    if (!(excess > 0) || has_budget_ended) {
      simplified->edits = std::move(edits);
      simplified->lines_laid -= std::min(cuts, simplified->lines_laid);
      return PrintedTerrain{std::move(*simplified), std::move(*print)};
    }
    options.max_error = *options.max_error - 2 * excess;
    if (run == kMostRuns || *options.max_error < 0) {
      return fail(ErrorKind::kPromise,
                  fmt::format("the solid's max error is {:.6g} and not {:.6g}: its positions are rounded to float32, "
                              "which costs the rest; ask for a larger error or a larger size",
                              print->max_error, *asked));
    }
  }
}

Json describe_print(const SolidPlan& plan, const Print& print, const std::vector<std::string>& paths) {
  Json solid{{"base", print.place.base},
             {"vertices", print.vertices()},
             {"triangles", print.triangles()},
             {"unit", plan.size ? Json("mm") : Json(nullptr)},
             {"scale", print.place.placement.scale},
             {"max_error", print.max_error},
             {"uncovered", print.uncovered}};
  Json list = Json::array();
  for (std::size_t k = 0; k < print.sheets.size(); ++k) {
    const Sheet& sheet = print.sheets[k];
    Json entry{{"path", paths.size() == 1 ? paths[0] : paths[k]}, {"row", sheet.row}, {"column", sheet.column}};
    entry.update(describe_facts(sheet.mesh, sheet.facts));
    list.push_back(std::move(entry));
  }
  solid["pieces"] = std::move(list);
  return solid;
}

std::string print_lines(const SolidPlan& plan, const Print& print) {
  std::string text =
      summary_line("solid", fmt::format("{}, closed, base at {}, max error {} as written",
                                        format_plural(print.triangles(), "triangle"), format_number(print.place.base),
                                        format_number(print.max_error)));
  if (print.uncovered > 0)
    text += summary_line("", format_plural(print.uncovered, "sample") + " in the gaps between sheets");
  if (print.sheets.size() == 1) return text + summary_line("", size_text(print.sheets.front().facts, plan));
  for (const Sheet& sheet : print.sheets) {
    text += summary_line(
        fmt::format("sheet r{} c{}", sheet.row, sheet.column).c_str(),
        fmt::format("{}, {}", format_plural(sheet.facts.triangles, "triangle"), size_text(sheet.facts, plan)));
  }
  return text;
}

}  // namespace scarp::cli
