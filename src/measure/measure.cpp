// The judge: the triangles that count, the error of each sample, and the connections of triangles.
//
// The field is judged in bands of rows. Bands are independent and are processed in parallel, a window of them at a
// time. Their reports are summed in order, so the result never depends on threads.
#include "scarp/measure.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <utility>

#include "base/array.h"
#include "base/caught.h"
#include "base/parallel.h"
#include "base/sort.h"
#include "grid/line_positions.h"
#include "measure/band.h"
#include "measure/check_mesh.h"
#include "measure/cut_region.h"
#include "measure/grid_places.h"
#include "measure/progress_gate.h"
#include "measure/scanner.h"
#include "measure/space_judge.h"
#include "measure/topology.h"

namespace scarp::judge {
namespace {

Result<void> check_input(const HeightField& field, const Mesh& mesh, const MeasureOptions& options) {
  if (field.cols < 2 || field.rows < 2 || (field.samples == nullptr && field.source == nullptr)) {
    return fail(ErrorKind::kInput,
                fmt::format("the height field has {}×{} samples; a mesh can be judged against at least 2×2", field.cols,
                            field.rows));
  }
  const auto& a = field.frame.affine;
  if (!std::all_of(a.begin(), a.end(), [](double term) { return std::isfinite(term); }) ||
      field.frame.determinant() == 0 || !std::isfinite(field.frame.determinant())) {
    return fail(ErrorKind::kInput, "the height field's frame puts all samples on one line; give it a cell size");
  }
  SCARP_RETURN_IF_ERROR(check_mesh(mesh));
  for (const Line& ring :
       options.cutline != nullptr ? std::span<const Line>(options.cutline->rings) : std::span<const Line>()) {
    SCARP_RETURN_IF_ERROR(grid::check_line_positions(ring.name, ring.points, options.cutline->affine));
  }
  if (!(options.coverage_tolerance >= 0) || !std::isfinite(options.coverage_tolerance)) {
    return fail(ErrorKind::kUsage, "coverage_tolerance must be zero or a positive number of samples");
  }
  if (!options.tolerance.empty() && options.tolerance_source != nullptr)
    return fail(ErrorKind::kUsage, "tolerances are given as an array and as a source; give one of them");
  const std::size_t samples = static_cast<std::size_t>(field.cols) * static_cast<std::size_t>(field.rows);
  if (!options.tolerance.empty() && options.tolerance.size() != samples) {
    return fail(ErrorKind::kUsage, fmt::format("the tolerance has {} values for {} samples; give one for each",
                                               options.tolerance.size(), samples));
  }
  return {};
}

tl::unexpected<Error> cancelled() { return fail(ErrorKind::kCancelled, "measuring was cancelled"); }

/// 1 for counter-clockwise seen from above, −1 for clockwise, 0 without area.
int facing(const Mesh& mesh, std::size_t t) {
  const double* a = &mesh.positions[3 * std::size_t{mesh.triangles[3 * t]}];
  const double* b = &mesh.positions[3 * std::size_t{mesh.triangles[3 * t + 1]}];
  const double* c = &mesh.positions[3 * std::size_t{mesh.triangles[3 * t + 2]}];
  const double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  return (area > 0) - (area < 0);
}

/// Sums the bands' reports, in order.
class Verdict {
 public:
  Verdict(const MeasureOptions& options, int cols, Measurement& result)
      : options_(options), cols_(cols), result_(result) {}

  void add(int first_row, BandReport& report) {
    result_.heights.add(report.heights);
    if (result_.uncovered == 0) result_.uncovered_at = report.uncovered_at;
    result_.uncovered += report.uncovered;
    result_.over_tolerance += report.over_tolerance;
    result_.stray += report.stray;
    result_.cut_off += report.cut_off;
    result_.nodata_cells_covered += report.nodata_cells_covered;
    for (std::size_t i = 0; i < report.rows.size(); ++i) {
      const RowSums& row = report.rows[i];
      result_.samples += row.samples;
      error_.add(row.error);
      magnitude_.add(row.magnitude);
      square_.add(row.square);
      if (options_.on_row) {
        const auto cols = static_cast<std::size_t>(cols_);
        options_.on_row(first_row + static_cast<int>(i), {report.kept.data() + i * cols, cols});
      }
    }
    if (report.largest > largest_) {
      largest_ = report.largest;
      result_.max_error_at = report.largest_at;
    }
    offenders_.insert(offenders_.end(), report.offenders.begin(), report.offenders.end());
    result_.offenders.insert(result_.offenders.end(), report.uncovered_offenders.begin(),
                             report.uncovered_offenders.end());
  }
  double max_error() const { return std::max(0.0, largest_); }

  void finish(const Histogram& histogram) {
    result_.max_error = max_error();
    if (result_.samples > 0) {
      const auto count = static_cast<double>(result_.samples);
      result_.mean_error = error_.value() / count;
      result_.mean_abs_error = magnitude_.value() / count;
      result_.rmse = std::sqrt(square_.value() / count);
    }
    set_percentiles(histogram, result_);
    merge_offenders();
  }

 private:
  /// Merges the offenders of a triangle in several bands, and of two triangles that share a sample.
  void merge_offenders() {
    sort_rarely(offenders_, is_worse_of_triangle);
    for (std::size_t i = 0; i < offenders_.size(); ++i) {
      if (i == 0 || offenders_[i].triangle != offenders_[i - 1].triangle)
        result_.offenders.push_back(offenders_[i].offender);
    }
    auto& all = result_.offenders;
    sort_rarely(all, [](const Offender& a, const Offender& b) {
      if (a.row != b.row) return a.row < b.row;
      if (a.col != b.col) return a.col < b.col;
      return std::abs(a.error) != std::abs(b.error) ? std::abs(a.error) > std::abs(b.error) : a.error > b.error;
    });
    const auto same = [](const Offender& a, const Offender& b) { return a.row == b.row && a.col == b.col; };
    all.erase(std::unique(all.begin(), all.end(), same), all.end());
  }

  const MeasureOptions& options_;
  int cols_;
  Measurement& result_;
  Sum error_, magnitude_, square_;
  double largest_ = -1;
  std::vector<TriangleOffender> offenders_;
};

/// The mesh's share of the bound on rounding errors of plain double arithmetic, with a margin.
double error_guard(const Mesh& mesh) {
  double size = 0;
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    size = std::max(size, std::abs(mesh.origin[2] + mesh.positions[3 * v + 2]));
  }
  return kRounding * size;
}

/// Sets all results about heights. `keep` selects the values for on_row. Fails with kCancelled if the caller stops, and
/// if the field's source fails.
Result<void> judge_heights(const HeightField& field, const Mesh& mesh, const Scanner& scanner, const CutRegion* region,
                           const MeasureOptions& options, Keep keep, ProgressGate& gate, Measurement& result) {
  const bool by_sample = !options.tolerance.empty() || options.tolerance_source != nullptr;
  const Limits limits{options.collect_above.value_or(HUGE_VAL), options.tolerance, options.tolerance_source,
                      options.collect_above.has_value() || by_sample, region};
  const double guard = error_guard(mesh);
  const int height = Band::rows_per_band(field.cols);
  const int bands = (field.rows - 1) / height + 1;
  const int window = 2 * std::min(thread_count(options.run.threads), 1024);
  // One histogram per slot of the window; the sums do not depend on which band used a slot.
  std::vector<Histogram> histograms(static_cast<std::size_t>(std::min(window, bands)));
  Verdict verdict(options, field.cols, result);
  for (int first = 0; first < bands; first += window) {
    if (!gate.go_on("measure", static_cast<double>(first) / bands, verdict.max_error())) return cancelled();
    std::vector<Result<BandReport>> reports(static_cast<std::size_t>(std::min(window, bands - first)));
    parallel_for(reports.size(), options.run.threads, [&](std::size_t i) {
      const int row = (first + static_cast<int>(i)) * height;
      Result<Band> band = Band::read(field, row, std::min(height, field.rows - row), limits, guard, histograms[i]);
      if (!band) {
        reports[i] = tl::unexpected(std::move(band.error()));
        return;
      }
      scanner.scan(*band);
      reports[i] = band->finish(options.on_row ? keep : Keep::kNothing);
    });
    for (std::size_t i = 0; i < reports.size(); ++i) {
      SCARP_RETURN_IF_ERROR(reports[i]);
      verdict.add((first + static_cast<int>(i)) * height, *reports[i]);
    }
  }
  for (std::size_t i = 1; i < histograms.size(); ++i) histograms[0].merge(histograms[i]);
  verdict.finish(histograms[0]);
  return {};
}

/// The triangles judged for heights: all, or a solid's triangles that face up.
struct Surface {
  std::optional<Array<std::uint32_t>> judged;  ///< ascending; none: all
  Connections connections;                     ///< connections, if requested or needed
  bool closed = false;

  /// The judged triangles of a mesh of `count` triangles, as a list.
  std::span<const std::uint32_t> list(std::size_t count) {
    if (!judged) {
      judged.emplace().resize(count);
      std::iota(judged->begin(), judged->end(), 0);
    }
    return {judged->data(), judged->size()};
  }
};

Surface find_surface(const Mesh& mesh, bool with_edges, int threads) {
  constexpr std::size_t kTogether = 1 << 16;
  Surface surface;
  const std::size_t count = mesh.triangle_count();
  std::vector<std::size_t> upwards(count / kTogether + 1, 0);
  parallel_for_parts(count, kTogether, threads, [&](std::size_t first, std::size_t end) {
    std::size_t here = 0;
    for (std::size_t t = first; t < end; ++t) here += facing(mesh, t) > 0;
    upwards[first / kTogether] = here;
  });
  std::size_t upward = std::accumulate(upwards.begin(), upwards.end(), std::size_t{0});
  // A solid has walls and a bottom. If all triangles face up, edges matter only for the topology.
  if (with_edges || upward < count) {
    surface.connections = connect(mesh, upward == count);
    surface.closed = surface.connections.edges.open.empty();
  }
  if (!surface.closed) return surface;
  Array<std::uint32_t>& judged = surface.judged.emplace();
  judged.resize(upward);
  std::size_t next = 0;
  for (std::size_t t = 0; t < count; ++t) {
    if (facing(mesh, t) > 0) judged[next++] = static_cast<std::uint32_t>(t);
  }
  return surface;
}

/// The mesh to judge on the map. A mesh in space is converted to the map, but its heights are judged in space.
class Judged {
 public:
  /// `field` and `mesh` must outlive this. `with_heights`: make_scanner() will be called. Fails with the errors of
  /// measure().
  static Result<Judged> of(const HeightField& field, const Mesh& mesh, const MeasureOptions& options,
                           bool with_heights = true) {
    Judged judged(field, mesh);
    if (field.frame.space) {
      SCARP_RETURN_IF_ERROR(check_mesh(mesh));
      SCARP_TRY(judged.flat_mesh_, bring_to_map(field, mesh));
      judged.flat_field_ = on_map(field);
    }
    SCARP_RETURN_IF_ERROR(check_input(judged.field(), judged.mesh(), options));
    if (!with_heights || !judged.field().frame.is_affine()) return judged;
    SCARP_TRY(judged.places_, place_on_grid(judged.field(), judged.mesh(), options.run.threads));
    return judged;
  }

  const HeightField& field() const { return flat_field_ ? *flat_field_ : field_; }
  const Mesh& mesh() const { return flat_mesh_ ? *flat_mesh_ : mesh_; }

  /// Makes the scanner of the surface's triangles. Called once.
  std::unique_ptr<Scanner> make_scanner(Surface& surface, double tolerance, int threads) {
    const std::size_t count = mesh_.triangle_count();
    if (field_.frame.transform) return make_frame_scanner(field_, mesh_, surface.list(count), tolerance);
    look_in_space(surface);
    std::optional<std::span<const std::uint32_t>> ids;
    if (surface.judged) ids = surface.list(count);
    return make_grid_scanner(field(), mesh(), std::move(places_), ids, tolerance, threads, space_.get());
  }

  /// Prepares counting of folds.
  void look_in_space(Surface& surface) {
    if (!flat_mesh_ || space_) return;
    space_ = std::make_unique<SpaceJudge>(field_, mesh_, *flat_mesh_, surface.list(mesh_.triangle_count()));
  }

  /// Samples, in addition to the offenders, that may repair faults other than height errors.
  std::vector<Offender> unfolding() const { return space_ ? space_->unfolding() : std::vector<Offender>(); }

  /// REQUIRES: look_in_space() was called.
  void measure_shape(std::span<const std::uint32_t> ids, int threads, Measurement& result) const {
    count_faults(mesh(), threads, result);
    if (space_) result.down_facing += space_->folds();
    if (!flat_mesh_) return measure_angles(mesh_, ids, threads, result);
    measure_angles(seen_from_above(field_, mesh_), ids, threads, result);
  }

 private:
  Judged(const HeightField& field, const Mesh& mesh) : field_(field), mesh_(mesh) {}

  const HeightField& field_;
  const Mesh& mesh_;
  std::optional<HeightField> flat_field_;
  std::optional<Mesh> flat_mesh_;
  GridPlaces places_;  // in affine frames
  std::unique_ptr<SpaceJudge> space_;
};

/// Null without a cutline.
std::unique_ptr<CutRegion> make_region(const MeasureOptions& options, const HeightField& field) {
  if (options.cutline == nullptr) return nullptr;
  return std::make_unique<CutRegion>(*options.cutline, field.cols, field.rows);
}

/// Sets topology and shape.
Result<void> judge_topology(const Judged& judged, Surface& surface, const CutRegion* region,
                            const MeasureOptions& options, ProgressGate& gate, Measurement& result) {
  if (!gate.go_on("topology", 0)) return cancelled();
  const Mesh& mesh = judged.mesh();
  const EdgeReport& edges = surface.connections.edges;
  result.open_edges = edges.open.size();
  result.misoriented_edges = edges.misoriented;
  result.non_manifold_edges = edges.non_manifold;
  result.border_loops = edges.loops;
  const std::span<const std::uint32_t> ids = surface.list(mesh.triangle_count());
  judged.measure_shape(ids, options.run.threads, result);
  result.t_junctions = count_t_junctions(mesh, surface.connections);
  SCARP_TRY(result.gaps, count_gaps(judged.field(), mesh, surface.connections, options.coverage_tolerance, region));
  if (surface.connections.is_single_layer) return {};
  bool is_stopped = false;
  result.overlaps = count_overlaps(mesh, ids, options.run.threads, [&](double fraction) {
    is_stopped = !gate.go_on("topology", fraction);
    return !is_stopped;
  });
  if (is_stopped) return cancelled();
  return {};
}

}  // namespace

}  // namespace scarp::judge

namespace scarp {

Result<Measurement> measure(const HeightField& asked, const Mesh& given, const MeasureOptions& options) try {
  SCARP_TRY(auto&& judged, judge::Judged::of(asked, given, options));
  const HeightField& field = judged.field();
  const Mesh& mesh = judged.mesh();
  judge::ProgressGate gate(options.run.progress);

  Measurement result;
  result.vertices = mesh.vertex_count();
  result.triangles = mesh.triangle_count();
  judge::Surface surface = judge::find_surface(mesh, options.topology, options.run.threads);
  result.closed = surface.closed;

  const auto scanner = judged.make_scanner(surface, options.coverage_tolerance, options.run.threads);
  const auto region = judge::make_region(options, field);
  SCARP_RETURN_IF_ERROR(
      judge::judge_heights(field, mesh, *scanner, region.get(), options, judge::Keep::kErrors, gate, result));

  if (options.collect_above) {
    const std::vector<Offender> more = judged.unfolding();
    result.offenders.insert(result.offenders.end(), more.begin(), more.end());
  }
  if (!options.topology) return result;
  SCARP_RETURN_IF_ERROR(judge::judge_topology(judged, surface, region.get(), options, gate, result));
  return result;
} catch (...) {
  return caught(ErrorKind::kInput, "measure the mesh");
}

Result<void> measure_topology(const HeightField& field, const Mesh& mesh, const MeasureOptions& options,
                              Measurement& result) try {
  SCARP_TRY(auto&& judged, judge::Judged::of(field, mesh, options, false));
  judge::ProgressGate gate(options.run.progress);
  judge::Surface surface = judge::find_surface(judged.mesh(), true, options.run.threads);
  result.closed = surface.closed;
  result.down_facing = result.degenerate = result.overlaps = 0;
  judged.look_in_space(surface);
  return judge::judge_topology(judged, surface, judge::make_region(options, judged.field()).get(), options, gate,
                               result);
} catch (...) {
  return caught(ErrorKind::kInput, "measure the mesh");
}

Result<void> resample_rows(const HeightField& asked, const Mesh& given,
                           const std::function<void(int row, std::span<const float> heights)>& on_row,
                           int threads) try {
  MeasureOptions options;
  options.run.threads = threads;
  options.on_row = on_row;
  SCARP_TRY(auto&& judged, judge::Judged::of(asked, given, options));
  const HeightField& field = judged.field();
  const Mesh& mesh = judged.mesh();
  judge::Surface surface = judge::find_surface(mesh, false, threads);
  const auto scanner = judged.make_scanner(surface, options.coverage_tolerance, threads);
  judge::ProgressGate gate(options.run.progress);
  Measurement ignored;
  return judge::judge_heights(field, mesh, *scanner, nullptr, options, judge::Keep::kHeights, gate, ignored);
} catch (...) {
  return caught(ErrorKind::kInput, "resample the mesh");
}

Result<std::vector<float>> resample(const HeightField& field, const Mesh& mesh, int threads) try {
  std::vector<float> heights;
  const auto keep = [&](int row, std::span<const float> values) {
    heights.resize(static_cast<std::size_t>(field.cols) * static_cast<std::size_t>(field.rows));
    std::copy(values.begin(), values.end(), heights.begin() + std::ptrdiff_t{row} * field.cols);
  };
  SCARP_RETURN_IF_ERROR(resample_rows(field, mesh, keep, threads));
  return heights;
} catch (...) {
  return caught(ErrorKind::kInput, "resample the mesh");
}

}  // namespace scarp
