// The memory layout of the structs, for bindings that redeclare them.
#include <cstddef>
#include <string>
#include <utility>

#include "scarp_c.h"

namespace {

using Members = std::initializer_list<std::pair<const char*, std::size_t>>;

std::string describe_struct(const char* name, std::size_t size, Members members) {
  std::string line = std::string(name) + " " + std::to_string(size);
  for (const auto& [member, offset] : members) line += std::string(" ") + member + ":" + std::to_string(offset);
  return line + "\n";
}

#define AT(type, member) \
  { #member, offsetof(type, member) }

std::string describe_all() {
  return describe_struct("scarp_progress", sizeof(scarp_progress),
                         {AT(scarp_progress, struct_size), AT(scarp_progress, reserved), AT(scarp_progress, pass),
                          AT(scarp_progress, fraction), AT(scarp_progress, vertices), AT(scarp_progress, max_error),
                          AT(scarp_progress, seconds_left), AT(scarp_progress, tiles), AT(scarp_progress, bytes)}) +
         describe_struct(
             "scarp_field", sizeof(scarp_field),
             {AT(scarp_field, struct_size), AT(scarp_field, cols), AT(scarp_field, rows), AT(scarp_field, frame),
              AT(scarp_field, samples), AT(scarp_field, nodata), AT(scarp_field, geotransform),
              AT(scarp_field, sample_rounding), AT(scarp_field, crs), AT(scarp_field, name), AT(scarp_field, unit)}) +
         describe_struct("scarp_points", sizeof(scarp_points),
                         {AT(scarp_points, struct_size), AT(scarp_points, frame), AT(scarp_points, x),
                          AT(scarp_points, y), AT(scarp_points, z), AT(scarp_points, count), AT(scarp_points, stride),
                          AT(scarp_points, crs), AT(scarp_points, name)}) +
         describe_struct("scarp_options", sizeof(scarp_options),
                         {AT(scarp_options, struct_size), AT(scarp_options, threads), AT(scarp_options, max_error),
                          AT(scarp_options, max_triangles), AT(scarp_options, max_points), AT(scarp_options, mask),
                          AT(scarp_options, tolerance), AT(scarp_options, progress), AT(scarp_options, user),
                          AT(scarp_options, named)}) +
         describe_struct("scarp_report", sizeof(scarp_report),
                         {AT(scarp_report, struct_size),   AT(scarp_report, stop),
                          AT(scarp_report, effort),        AT(scarp_report, is_cut_short),
                          AT(scarp_report, max_error_col), AT(scarp_report, max_error_row),
                          AT(scarp_report, vertices),      AT(scarp_report, triangles),
                          AT(scarp_report, samples),       AT(scarp_report, uncovered),
                          AT(scarp_report, stray),         AT(scarp_report, over),
                          AT(scarp_report, max_error),     AT(scarp_report, rmse),
                          AT(scarp_report, mean_error),    AT(scarp_report, mean_abs_error),
                          AT(scarp_report, p50),           AT(scarp_report, p95),
                          AT(scarp_report, p99),           AT(scarp_report, seconds)}) +
         describe_struct(
             "scarp_live_options", sizeof(scarp_live_options),
             {AT(scarp_live_options, struct_size), AT(scarp_live_options, threads), AT(scarp_live_options, max_error),
              AT(scarp_live_options, effort), AT(scarp_live_options, cell), AT(scarp_live_options, col),
              AT(scarp_live_options, row), AT(scarp_live_options, tolerance),
              AT(scarp_live_options, max_triangles), AT(scarp_live_options, level)}) +
         describe_struct("scarp_live_cell", sizeof(scarp_live_cell),
                         {AT(scarp_live_cell, struct_size), AT(scarp_live_cell, slot), AT(scarp_live_cell, version),
                          AT(scarp_live_cell, col), AT(scarp_live_cell, row), AT(scarp_live_cell, vertices),
                          AT(scarp_live_cell, triangles), AT(scarp_live_cell, positions), AT(scarp_live_cell, indices),
                          AT(scarp_live_cell, max_error)}) +
         describe_struct(
             "scarp_volumes", sizeof(scarp_volumes),
             {AT(scarp_volumes, struct_size), AT(scarp_volumes, reserved), AT(scarp_volumes, cut),
              AT(scarp_volumes, fill), AT(scarp_volumes, net), AT(scarp_volumes, uncertainty),
              AT(scarp_volumes, common_area), AT(scarp_volumes, from_outside), AT(scarp_volumes, to_outside)});
}

#undef AT

}  // namespace

extern "C" const char* scarp_abi_layout(void) {
  try {
    static const std::string text = describe_all();
    return text.c_str();
  } catch (...) {
    return "";  // out of memory
  }
}
