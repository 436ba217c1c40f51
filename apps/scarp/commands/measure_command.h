// scarp measure: judge a mesh file against its raster.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "scarp/io.h"
#include "scarp/picture.h"
#include "session/inputs/channels.h"
#include "session/inputs/companions.h"
#include "session/inputs/memory.h"
#include "session/options/cutline_options.h"
#include "session/options/values.h"
#include "session/reports/measure_report.h"
#include "session/work/points_work.h"

namespace scarp::cli {

class MeasureCommand {
 public:
  /// Adds the command to the program. This object must stay alive and in place until run() is done.
  explicit MeasureCommand(CLI::App& program);
  MeasureCommand(const MeasureCommand&) = delete;
  MeasureCommand& operator=(const MeasureCommand&) = delete;

  bool is_chosen() const { return command_->parsed(); }
  /// `command_line` is what the user typed, for the report.
  Result<void> run(const std::string& command_line) const;

  /// What becomes of the errors of streamed samples, row by row.
  struct StreamedErrors {
    std::optional<ErrorMap> map = std::nullopt;
    std::optional<RasterFile> raster = std::nullopt;
  };
  /// run() on a raster, as far as it needs no terminal: reads both and judges.
  Result<void> judge_inputs(const Runner& runner, Judged& judged, StreamedErrors& errors) const;
  /// Whether the input is points; then this is the same.
  bool are_points() const { return points_.are_meant(raster_.path()); }
  Result<void> judge_points_inputs(const Runner& runner, JudgedPoints& judged) const;

 private:
  ErrorMapOptions map_options(const Judged& judged, int max_side) const;
  MeasurePointsArguments points_arguments() const;
  Result<void> check_order() const;
  Result<void> check_outputs_of_run() const;
  Result<void> read_inputs(const ProgressCallback& progress, Judged& judged) const;
  Result<void> read_field(const ReadOptions& options, Judged& judged) const;
  /// The first option that was given and needs all samples in memory; nothing if there is none.
  std::optional<std::string> find_need_of_samples() const;
  Result<StreamedErrors> begin_errors(const Judged& judged) const;
  Result<Judgement> judge(const ProgressCallback& progress, const Judged& judged, StreamedErrors& errors) const;
  Result<void> write_files(const Judged& judged, StreamedErrors& errors) const;

  CLI::App* command_;
  RasterArguments raster_;
  PointsArguments points_;
  std::string mesh_;
  CompanionArguments companions_;
  CutlineArguments cut_;
  ChannelArguments channels_;
  MemoryArguments memory_;
  Given up_, map_, error_raster_, fail_above_, threads_;
  bool json_ = false, overwrite_ = false, quiet_ = false, json_progress_ = false;
};

}  // namespace scarp::cli
