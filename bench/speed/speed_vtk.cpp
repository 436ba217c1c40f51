// Times vtkGreedyTerrainDecimation (absolute error, else defaults) on a raw raster, without reading and writing.
//
//   speed_vtk RASTER COLS ROWS ERROR [MESH]

#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkGreedyTerrainDecimation.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <cmath>

#include "raw.h"

namespace {

/// The samples for VTK; row 0 lies at y = 0, as for other programs.
void fill_image(bench::RawRaster& raster, vtkImageData* image) {
  image->SetDimensions(raster.cols, raster.rows, 1);
  vtkNew<vtkFloatArray> heights;
  heights->SetArray(raster.samples.data(), static_cast<vtkIdType>(raster.samples.size()), 1);  // 1: borrowed
  image->GetPointData()->SetScalars(heights);
}

void decimate(vtkImageData* image, double error, vtkGreedyTerrainDecimation* decimation) {
  decimation->SetInputData(image);
  decimation->SetErrorMeasureToAbsoluteError();
  decimation->SetAbsoluteError(error);
  decimation->Update();
}

bench::RawMesh mesh_of(vtkPolyData* surface) {
  bench::RawMesh mesh;
  for (vtkIdType v = 0; v < surface->GetNumberOfPoints(); ++v) {
    double point[3];
    surface->GetPoint(v, point);
    mesh.points.push_back(static_cast<std::uint32_t>(std::lround(point[0])));
    mesh.points.push_back(static_cast<std::uint32_t>(std::lround(point[1])));
  }
  vtkNew<vtkIdList> corners;
  for (vtkIdType t = 0; t < surface->GetNumberOfCells(); ++t) {
    surface->GetCellPoints(t, corners);
    for (vtkIdType k = 0; k < 3; ++k) mesh.triangles.push_back(static_cast<std::uint32_t>(corners->GetId(k)));
  }
  return mesh;
}

}  // namespace

int main(int argc, char** argv) {
  const bench::Arguments arguments(argc, argv, "speed_vtk RASTER COLS ROWS ERROR [MESH]");
  bench::RawRaster raster = bench::read_raw(arguments);
  const double error = arguments.number(3);
  {
    bench::RawRaster part = bench::warm_up_part(raster);
    vtkNew<vtkImageData> image;
    fill_image(part, image);
    vtkNew<vtkGreedyTerrainDecimation> decimation;
    decimate(image, error, decimation);
  }
  vtkNew<vtkImageData> image;
  fill_image(raster, image);
  vtkNew<vtkGreedyTerrainDecimation> decimation;
  const bench::Stopwatch watch;
  decimate(image, error, decimation);
  const bench::Times times = watch.read();
  vtkPolyData* surface = decimation->GetOutput();
  bench::print_result(SCARP_VTK_VERSION, times, static_cast<std::size_t>(surface->GetNumberOfPoints()),
                      static_cast<std::size_t>(surface->GetNumberOfCells()));
  if (arguments.count() > 4) bench::write_mesh(arguments[4], mesh_of(surface));
}
