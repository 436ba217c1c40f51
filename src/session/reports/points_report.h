// The results of simplify and measure for scattered points, and their report.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scarp/height_field.h"
#include "scarp/point_blocks.h"
#include "scarp/points.h"
#include "session/plan/simplify_plan.h"
#include "session/reports/simplify_run.h"
#include "session/text/json.h"

namespace scarp::cli {

/// " (12 without a height, 340 of other classes left out)", or nothing.
std::string left_out(const PointSet& points);
Json describe_las(const LasFacts& las);
HeightRange height_range(const PointSet& points);

/// find_broken_promise() with a point's place.
std::optional<std::string> find_broken(const PointSet& points, const Measurement& measured, double bound);

/// The result of simplify for points.
struct PointsOutcome : SimplifyRun {
  PointSet points;                      ///< with --memory: some of them
  std::unique_ptr<PointBlocks> blocks;  ///< all points; null: those in `points`
  DuplicatePolicy policy = DuplicatePolicy::kFirst;
  std::uint64_t duplicates = 0, on_hull = 0, flat = 0, loose = 0;
  std::vector<PointLake> lakes;
  std::uint64_t with_tolerance = 0;  ///< points with their own, smaller bound
  double lattice_step = 0;
  std::string boundary = "hull";                ///< value of --boundary
  std::optional<BoundaryCut> cut;               ///< by polygons
  std::string suggested_boundary;               ///< empty: none
  std::optional<std::array<double, 2>> centre;  ///< centre of the local frame, if the mesh has one and the points
                                                ///< have none
  Picture drape;                                ///< empty without a draped image
  std::optional<double> cell_size;              ///< for a raster as OUTPUT

  std::uint64_t count() const { return blocks ? blocks->size() + duplicates : points.size() - points.added; }
  /// The frame of the mesh's x and y.
  std::string frame() const;
};

Json make_report(const SimplifyPlan& plan, const PointsOutcome& outcome, const std::vector<ReadyFile>& files,
                 const std::string& command_line);
/// The lines on standard output.
std::string make_summary(const SimplifyPlan& plan, const PointsOutcome& outcome, const std::vector<ReadyFile>& files);

/// The result of measure.
struct JudgedPoints {
  PointSet points;                        ///< with --memory: some of them
  std::unique_ptr<PointBlocks> blocks;    ///< all points but duplicates; null: those in `points`
  std::uint64_t dropped_from_blocks = 0;  ///< duplicates
  DuplicatePolicy policy = DuplicatePolicy::kFirst;
  Mesh mesh;
  Measurement measured;
  std::optional<double> fail_above;
  std::optional<std::string> broken;  ///< reason why the mesh fails; nothing if it passes or without a bound
  std::optional<ReadyFile> errors;    ///< with --error-raster
  bool has_tolerances = false;        ///< with --tolerance or --roi
  double seconds_read = 0, seconds_measure = 0, seconds_total = 0;

  std::uint64_t count() const { return blocks ? blocks->size() + dropped_from_blocks : points.size(); }
  std::uint64_t duplicates() const { return count() - measured.samples - measured.uncovered; }
};

/// The worst point above its tolerance. REQUIRES: there is one.
std::string describe_over_tolerance(const PointSet& points, const Measurement& measured);

Json make_report(const JudgedPoints& judged, const std::string& mesh_path, const std::string& command_line);
std::string make_table(const JudgedPoints& judged, const std::string& mesh_path);

}  // namespace scarp::cli
