#include "mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "door.h"
#include "scarp/io.h"
#include "session/tasks/mesh_output.h"

const float* scarp_mesh::rounded() const {
  std::call_once(once_, [&] { rounded_.assign(mesh.positions.begin(), mesh.positions.end()); });
  return rounded_.data();
}

namespace scarp::door {
namespace {

int effort_code(Effort effort) {
  switch (effort) {
    case Effort::kAuto:
    case Effort::kFast:
      return 0;
    case Effort::kNormal:
      return 1;
    case Effort::kHigh:
      return 2;
    case Effort::kMax:
      return 3;
  }
  return -1;
}

int stop_code(StopReason stop) {
  switch (stop) {
    case StopReason::kMaxError:
      return 0;
    case StopReason::kMaxTriangles:
      return 1;
    case StopReason::kMaxVertices:
      return 2;
    case StopReason::kExact:
      return 3;
  }
  return -1;
}

/// The file's bytes as the program would write them.
Result<std::vector<std::uint8_t>> encode(const scarp_mesh& mesh, const cli::OutputFormat& format) {
  if (format.kind == cli::OutputKind::kDem)
    return fail(ErrorKind::kUsage, "a raster is no format of a mesh: choose glb, obj, ply, stl or another mesh format");
  SCARP_TRY(const bool is_y_up, cli::choose_y_up(mesh.up, format, mesh.is_print));
  const bool turns = is_y_up && (mesh.up || mesh.crs == "enu" || !is_in_space(mesh.crs));
  const EncodeOptions options{.double_positions = mesh.doubles};
  if (!turns) return cli::encode_as(format, mesh.mesh, mesh.glb, options);
  Mesh turned = mesh.mesh;
  turn_y_up(turned);
  return cli::encode_as(format, turned, mesh.glb, options);
}

Error refuse_null(const char* what) { return {ErrorKind::kUsage, std::string(what) + " is a null pointer"}; }

Result<Mesh> mesh_of(const double* positions, std::uint64_t vertices, const std::uint32_t* triangles,
                     std::uint64_t count) {
  if (positions == nullptr || triangles == nullptr)
    return tl::unexpected(refuse_null("the array of positions, or of triangles,"));
  for (const auto& [what, number] : {std::pair{"vertices", vertices}, {"triangles", count}}) {
    if (number > kMostVertices)
      return fail(ErrorKind::kUsage,
                  fmt::format("{} {} are given: a mesh has at most {}", number, what, kMostVertices));
  }
  Mesh mesh;
  mesh.positions.assign(positions, positions + 3 * vertices);
  mesh.triangles.assign(triangles, triangles + 3 * count);
  const auto odd =
      std::find_if(mesh.positions.begin(), mesh.positions.end(), [](double x) { return !std::isfinite(x); });
  if (odd != mesh.positions.end()) {
    return fail(ErrorKind::kInput, fmt::format("a coordinate of the vertex {} is {}: all must be finite",
                                               (odd - mesh.positions.begin()) / 3, *odd));
  }
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    if (mesh.triangles[k] >= vertices) {
      return fail(ErrorKind::kInput,
                  fmt::format("triangle {} names the vertex {}, and there are {}", k / 3, mesh.triangles[k], vertices));
    }
  }
  return mesh;
}

}  // namespace

scarp_report describe_measurement(const Measurement& measured) {
  scarp_report report{};
  report.effort = -1;
  report.max_error_col = measured.max_error_at[0];
  report.max_error_row = measured.max_error_at[1];
  report.vertices = measured.vertices;
  report.triangles = measured.triangles;
  report.samples = measured.samples;
  report.uncovered = measured.uncovered;
  report.stray = measured.stray;
  report.over = measured.over_tolerance;
  report.max_error = measured.max_error;
  report.rmse = measured.rmse;
  report.mean_error = measured.mean_error;
  report.mean_abs_error = measured.mean_abs_error;
  report.p50 = measured.p50;
  report.p95 = measured.p95;
  report.p99 = measured.p99;
  return report;
}

scarp_report describe_run(const Simplified& simplified) {
  scarp_report report = describe_measurement(simplified.measurement);
  report.stop = stop_code(simplified.stop);
  report.effort = effort_code(simplified.effort);
  report.is_cut_short = simplified.is_cut_short ? 1 : 0;
  report.vertices = simplified.mesh.vertex_count();
  report.triangles = simplified.mesh.triangle_count();
  report.seconds = simplified.seconds_refine + simplified.seconds_measure;
  return report;
}

std::string join_lines(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += (text.empty() ? "" : "\n") + sentence;
  return text;
}

std::unique_ptr<scarp_mesh> copy_mesh(const scarp_mesh& mesh) {
  auto copy = std::make_unique<scarp_mesh>();
  copy->mesh = mesh.mesh;
  copy->report = mesh.report;
  copy->format = mesh.format;
  copy->up = mesh.up;
  copy->crs = mesh.crs;
  copy->is_print = mesh.is_print;
  copy->doubles = mesh.doubles;
  copy->glb = mesh.glb;
  copy->warnings = mesh.warnings;
  return copy;
}

}  // namespace scarp::door

using namespace scarp::door;
using scarp::ErrorKind;

extern "C" {

scarp_status scarp_mesh_from_arrays(const double* positions, uint64_t vertices, const uint32_t* triangles,
                                    uint64_t triangle_count, scarp_mesh** out) {
  return guarded([&]() -> scarp_status {
    if (out == nullptr) return report(refuse_null("the place for the mesh"));
    *out = nullptr;
    auto made = mesh_of(positions, vertices, triangles, triangle_count);
    if (!made) return report(made.error());
    auto mesh = std::make_unique<scarp_mesh>();
    mesh->mesh = std::move(*made);
    *out = mesh.release();
    return SCARP_OK;
  });
}

scarp_status scarp_mesh_read(const char* path, scarp_mesh** out) {
  return guarded([&]() -> scarp_status {
    if (out == nullptr || path == nullptr) return report(refuse_null("the path, or the place for the mesh,"));
    *out = nullptr;
    if (*path == '\0') return report(ErrorKind::kUsage, "the path is empty");
    auto read = scarp::read_mesh(path);
    if (!read) return report(read.error());
    auto mesh = std::make_unique<scarp_mesh>();
    mesh->mesh = std::move(*read);
    *out = mesh.release();
    return SCARP_OK;
  });
}

uint64_t scarp_mesh_vertex_count(const scarp_mesh* mesh) { return mesh->mesh.vertex_count(); }
uint64_t scarp_mesh_triangle_count(const scarp_mesh* mesh) { return mesh->mesh.triangle_count(); }
const double* scarp_mesh_origin(const scarp_mesh* mesh) { return mesh->mesh.origin.data(); }
const double* scarp_mesh_positions(const scarp_mesh* mesh) { return mesh->mesh.positions.data(); }
const uint32_t* scarp_mesh_triangles(const scarp_mesh* mesh) { return mesh->mesh.triangles.data(); }
const float* scarp_mesh_normals(const scarp_mesh* mesh) {
  return mesh->mesh.normals.empty() ? nullptr : mesh->mesh.normals.data();
}
const float* scarp_mesh_uvs(const scarp_mesh* mesh) { return mesh->mesh.uvs.empty() ? nullptr : mesh->mesh.uvs.data(); }
const float* scarp_mesh_positions_f32(const scarp_mesh* mesh) {
  const float* positions = nullptr;
  guarded([&]() -> scarp_status {
    positions = mesh->rounded();
    return SCARP_OK;
  });
  return positions;
}

const char* scarp_mesh_metadata(const scarp_mesh* mesh, const char* key) {
  if (key == nullptr) return nullptr;
  const char* value = nullptr;
  guarded([&]() -> scarp_status {
    const auto entry = mesh->mesh.metadata.find(key);
    if (entry != mesh->mesh.metadata.end()) value = entry->second.c_str();
    return SCARP_OK;
  });
  return value;
}

const char* scarp_mesh_warnings(const scarp_mesh* mesh) { return mesh->warnings.c_str(); }

scarp_status scarp_mesh_report(const scarp_mesh* mesh, scarp_report* out) {
  return guarded([&]() -> scarp_status {
    if (mesh == nullptr || out == nullptr) return report(refuse_null("the mesh, or the place for its report,"));
    if (!mesh->report)
      return report(ErrorKind::kUsage, "nobody has measured this mesh yet: scarp_measure() does, against the heights");
    hand_out(*mesh->report, out);
    return SCARP_OK;
  });
}

scarp_status scarp_mesh_add_base(const scarp_mesh* mesh, double z, scarp_mesh** out) {
  return guarded([&]() -> scarp_status {
    if (mesh == nullptr || out == nullptr) return report(refuse_null("the mesh, or the place for another,"));
    *out = nullptr;
    auto copy = copy_mesh(*mesh);
    if (copy->mesh.positions.empty()) return report(ErrorKind::kInput, "the mesh has no vertices");
    if (auto closed = scarp::cli::close_with_base(copy->mesh, z); !closed) return report(closed.error());
    *out = copy.release();
    return SCARP_OK;
  });
}

scarp_status scarp_mesh_encode(const scarp_mesh* mesh, const char* format, scarp_bytes** out) {
  return guarded([&]() -> scarp_status {
    if (mesh == nullptr || out == nullptr) return report(refuse_null("the mesh, or the place for its bytes,"));
    *out = nullptr;
    auto chosen = format == nullptr ? scarp::Result<scarp::cli::OutputFormat>(mesh->format)
                                    : scarp::cli::choose_output_format(std::string(format), "-");
    if (!chosen) {
      std::string sentence = chosen.error().message;
      if (sentence.starts_with("--of")) sentence.replace(0, 4, "the format");
      return report(chosen.error().kind, sentence);
    }
    auto bytes = encode(*mesh, *chosen);
    if (!bytes) return report(bytes.error());
    *out = new scarp_bytes{std::move(*bytes)};
    return SCARP_OK;
  });
}

scarp_status scarp_mesh_write(const scarp_mesh* mesh, const char* path, int32_t overwrite) {
  return guarded([&]() -> scarp_status {
    if (mesh == nullptr || path == nullptr) return report(refuse_null("the mesh, or the path,"));
    auto chosen = scarp::cli::choose_output_format({}, path);
    if (!chosen) {
      std::string sentence = chosen.error().message;
      if (const auto other = sentence.find(", or --of FORMAT"); other != std::string::npos)
        sentence.replace(other, 16, ", or take the bytes from scarp_mesh_encode()");
      return report(chosen.error().kind, sentence);
    }
    auto bytes = encode(*mesh, *chosen);
    if (!bytes) return report(bytes.error());
    if (auto written = scarp::write_file(path, *bytes, overwrite != 0); !written) return report(written.error());
    return SCARP_OK;
  });
}

void scarp_mesh_free(scarp_mesh* mesh) { delete mesh; }

const uint8_t* scarp_bytes_data(const scarp_bytes* bytes) { return bytes->bytes.data(); }
uint64_t scarp_bytes_size(const scarp_bytes* bytes) { return bytes->bytes.size(); }
void scarp_bytes_free(scarp_bytes* bytes) { delete bytes; }

}  // extern "C"
