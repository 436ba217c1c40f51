// Judges a mesh written by one of the timed programs with measure(), so that each peer's true error is known.
//
//   speed_judge RASTER COLS ROWS MESH     one JSON line

#include "lift.h"
#include "scarp/measure.h"

int main(int argc, char** argv) {
  if (argc != 5) bench::die("usage: speed_judge RASTER COLS ROWS MESH");
  const bench::RawRaster raster = bench::read_raw(argv[1], argv[2], argv[3]);
  scarp::HeightField field;
  field.samples = raster.samples.data();
  field.cols = raster.cols;
  field.rows = raster.rows;
  field.frame = scarp::grid_frame(raster.rows);
  scarp::MeasureOptions options;
  options.topology = false;
  const auto measured = scarp::measure(field, bench::lift(bench::read_raw_mesh(argv[4]), raster), options);
  if (!measured) bench::die(measured.error().message);
  std::printf("{\"max_error\": %.9g, \"rmse\": %.9g, \"uncovered\": %llu}\n", measured->max_error, measured->rmse,
              static_cast<unsigned long long>(measured->uncovered));
}
