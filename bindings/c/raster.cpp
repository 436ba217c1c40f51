#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <utility>

#include "door.h"
#include "scarp/io.h"
#include "session/options/raster_options.h"
#include "session/options/values.h"
#include "session/table/option_table.h"
#include "settings.h"

struct scarp_raster {
  scarp::OwnedHeightField field;
};

using namespace scarp::door;
using scarp::ErrorKind;

extern "C" {

scarp_status scarp_raster_read(const char* path, const scarp_options* options, scarp_raster** out) {
  return guarded([&]() -> scarp_status {
    if (out == nullptr) return report(ErrorKind::kUsage, "the place for the raster is a null pointer");
    *out = nullptr;
    if (path == nullptr || *path == '\0') return report(ErrorKind::kUsage, "the path is empty");
    const scarp_options asked = known(options, scarp_options_init);
    CLI::App program;
    scarp::cli::GivenOptions given(scarp::cli::kSimplify);
    given.add_to(program);
    if (auto parsed = parse_options(program, scarp::cli::kSimplify, {"simplify", path, "-"}, asked); !parsed)
      return report(parsed.error());
    auto read = scarp::cli::parse_reading(given);
    if (!read) return report(read.error());
    read->run.progress = progress_of(asked);
    const auto threads = given.threads();
    if (!threads) return report(threads.error());
    read->run.threads = *threads;
    auto field = scarp::read_height_field(path, *read);
    if (!field) return report(field.error());
    *out = new scarp_raster{std::move(*field)};
    return SCARP_OK;
  });
}

void scarp_raster_field(const scarp_raster* raster, scarp_field* out) {
  if (out == nullptr || !is_struct_size(out->struct_size)) return;
  scarp_field all;
  scarp_field_init(&all, sizeof all);
  const scarp::OwnedHeightField& field = raster->field;
  all.cols = field.cols;
  all.rows = field.rows;
  all.samples = field.samples.data();
  all.sample_rounding = field.sample_rounding;
  const scarp::RasterInfo& info = field.info;
  all.frame = !info.has_georeference ? SCARP_FRAME_GRID : info.is_geographic ? SCARP_FRAME_DEGREES : SCARP_FRAME_SOURCE;
  std::copy(info.geotransform.begin(), info.geotransform.end(), all.geotransform);
  all.crs = info.crs.empty() ? nullptr : info.crs.c_str();
  all.name = info.path.c_str();
  all.unit = info.unit.empty() ? nullptr : info.unit.c_str();
  hand_out(all, out);
}

void scarp_raster_free(scarp_raster* raster) { delete raster; }

}  // extern "C"
