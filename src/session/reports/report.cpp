#include "session/reports/report.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "scarp/io.h"
#include "session/text/json_text.h"
#include "session/text/paths.h"

namespace scarp::cli {
namespace {

const char* kind_name(Frame::Kind kind) {
  switch (kind) {
    case Frame::Kind::kGrid:
      return "grid";
    case Frame::Kind::kSource:
      return "source";
    case Frame::Kind::kLocal:
      return "local";
    case Frame::Kind::kGeocentric:
      return "geocentric";
    case Frame::Kind::kTangent:
      return "enu";
    case Frame::Kind::kProjected:
      break;
  }
  return "projected";
}

Json describe_topology(const Measurement& measured) {
  Json topology;
  topology["sound"] = measured.is_sound();
  topology["closed"] = measured.closed;
  topology["min_angle"] = measured.min_angle;
  topology["angle_p1"] = measured.angle_percentiles[0];
  topology["angle_p5"] = measured.angle_percentiles[1];
  topology["angle_p50"] = measured.angle_percentiles[2];
  topology["down_facing"] = measured.down_facing;
  topology["degenerate"] = measured.degenerate;
  topology["misoriented_edges"] = measured.misoriented_edges;
  topology["non_manifold_edges"] = measured.non_manifold_edges;
  topology["open_edges"] = measured.open_edges;
  topology["border_loops"] = measured.border_loops;
  topology["t_junctions"] = measured.t_junctions;
  topology["gaps"] = measured.gaps;
  topology["overlaps"] = measured.overlaps;
  return topology;
}

}  // namespace

std::string heights_unit(const RasterInfo& info) {
  const std::string unit = info.unit.empty() ? "" : " " + info.unit;
  return info.file_unit.empty() ? unit : fmt::format("{} ({} in the file)", unit, info.file_unit);
}

Json describe_input(const OwnedHeightField& field, const RasterInfo& as_read, int band) {
  const std::uint64_t samples = static_cast<std::uint64_t>(field.cols) * static_cast<std::uint64_t>(field.rows);
  Json input;
  input["path"] = as_read.path;
  input["view"] = as_read.view;
  input["format"] = as_read.format;
  input["sample_type"] = as_read.sample_type;
  input["band"] = band;
  input["cols"] = field.cols;
  input["rows"] = field.rows;
  input["valid"] = as_read.valid;
  input["void"] = samples - as_read.valid;
  input["min"] = as_read.min;
  input["max"] = as_read.max;
  input["nodata"] = or_null(as_read.nodata);
  input["z_scale"] = as_read.z_scale;
  input["z_offset"] = as_read.z_offset;
  input["unit"] = as_read.unit;
  input["unit_in_metres"] = as_read.unit_in_metres > 0 ? Json(as_read.unit_in_metres) : Json(nullptr);
  input["file_unit"] = as_read.file_unit.empty() ? as_read.unit : as_read.file_unit;
  input["crs"] = as_read.crs;
  input["geographic"] = as_read.is_geographic;
  input["crs_unit"] = as_read.crs_unit;
  input["cell_x"] = as_read.cell_x;
  input["cell_y"] = as_read.cell_y;
  input["cell_x_m"] = as_read.cell_x_m > 0 ? Json(as_read.cell_x_m) : Json(nullptr);
  input["cell_y_m"] = as_read.cell_y_m > 0 ? Json(as_read.cell_y_m) : Json(nullptr);
  input["sample_rounding"] = field.sample_rounding;
  Json& undeclared = input["undeclared_nodata"] = Json::array();
  for (const UndeclaredNodata& nodata : as_read.undeclared_nodata)
    undeclared.push_back(Json{{"value", nodata.value}, {"samples", nodata.of.samples}});
  if (!as_read.depths.empty()) input["depths"] = as_read.depths;
  if (as_read.seems_degrees) input["seems_degrees"] = true;
  if (!as_read.packed.seems.empty() || as_read.packed.torn > 0) {
    input["packed"] = Json{{"torn", as_read.packed.torn}, {"torn_by", as_read.packed.torn_by}};
    input["packed"]["seems"] = as_read.packed.seems.empty() ? Json(nullptr) : Json(as_read.packed.seems);
  }
  return input;
}

Json describe_frame(const Frame& frame, const RasterInfo& info, int rows) {
  Json json{{"kind", kind_name(frame.kind)}, {"crs", frame.crs}, {"description", frame.description}};
  add_place(json, place_in_source(frame, info, rows));
  json["to_earth"] = frame.space ? Json(frame.space->to_earth()) : Json(nullptr);
  return json;
}

void add_place(Json& json, const std::optional<PlaceInSource>& place) {
  json["origin"] = place ? Json(place->origin()) : Json(nullptr);
  json["origin_crs"] = place && !place->crs.empty() ? Json(place->crs) : Json(nullptr);
  json["to_source"] = place ? Json(place->to_source) : Json(nullptr);
}

const char* stop_name(StopReason stop) {
  switch (stop) {
    case StopReason::kMaxError:
      return "max_error";
    case StopReason::kMaxTriangles:
      return "max_triangles";
    case StopReason::kMaxVertices:
      return "max_points";
    case StopReason::kExact:
      break;
  }
  return "exact";
}

std::uint64_t full_grid_triangles(const HeightField& field) {
  return 2 * static_cast<std::uint64_t>(field.cols - 1) * static_cast<std::uint64_t>(field.rows - 1);
}

void add_errors(Json& report, const Measurement& measured, double sample_rounding) {
  const bool is_judged = measured.samples > 0;
  const auto judged = [&](const auto& value) { return is_judged ? Json(value) : Json(nullptr); };
  report["max_error"] = judged(measured.max_error);
  report["max_error_at"] = judged(measured.max_error_at);
  if (sample_rounding > 0) report["sample_rounding"] = sample_rounding;
  report["rmse"] = judged(measured.rmse);
  report["mean_error"] = judged(measured.mean_error);
  report["mean_abs_error"] = judged(measured.mean_abs_error);
  report["p50"] = judged(measured.p50);
  report["p95"] = judged(measured.p95);
  report["p99"] = judged(measured.p99);
  report["p999"] = judged(measured.p999);
}

void add_coverage(Json& report, const Measurement& measured) {
  report["samples"] = measured.samples;
  report["uncovered"] = measured.uncovered;
  report["stray"] = measured.stray;
  report["void_cells_covered"] = measured.nodata_cells_covered;
  report["topology"] = describe_topology(measured);
}

void add_measurement(Json& report, const Measurement& measured, double sample_rounding) {
  add_errors(report, measured, sample_rounding);
  add_coverage(report, measured);
}

void add_bounded(Json& report, const judge::LargestError& bounded) {
  report["bounded_max_error"] = bounded.value;
  report["bounded_max_error_at"] = bounded.at;
}

Json describe_channels(const std::vector<std::string>& names, const std::vector<double>& scales,
                       const std::vector<Measurement>& measured) {
  Json channels = Json::array();
  for (std::size_t k = 0; k < measured.size(); ++k) {
    Json channel{{"name", names[k]}, {"scale", scales[k]}};
    add_errors(channel, measured[k], 0);
    channel["samples"] = measured[k].samples;
    channels.push_back(std::move(channel));
  }
  return channels;
}

Result<void> write_report(const Json& report, const std::string& path, bool overwrite, const std::string& mesh) {
  const std::string text = to_text(report);
  auto written = write_file(path, std::vector<std::uint8_t>(text.begin(), text.end()), overwrite);
  if (!written)
    written.error().message +=
        is_stdout(mesh) ? "; the mesh itself is written" : fmt::format("; {} itself is written", mesh);
  return written;
}

}  // namespace scarp::cli
