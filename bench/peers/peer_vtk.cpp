// vtkQuadricDecimation on the full grid of a raw raster, timed without reading and writing.
//
//   peer_vtk RASTER COLS ROWS Z_SCALE MODE PREFIX TRIANGLES...
//
// Writes a surface, PREFIX.TRIANGLES, and a line for each number of TRIANGLES. Z_SCALE: as in peer_meshopt. MODE:
// plain; volume (VolumePreservation); attribute (AttributeErrorMetric, with heights also as scalars).

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkQuadricDecimation.h>

#include "surface.h"

namespace {

vtkNew<vtkPolyData> mesh_of(const bench::Surface& surface, double z_scale) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> heights;
  for (std::size_t v = 0; v < surface.points.size(); v += 3) {
    const double z = z_scale * surface.points[v + 2];
    points->InsertNextPoint(surface.points[v], surface.points[v + 1], z);
    heights->InsertNextValue(z);
  }
  vtkNew<vtkCellArray> triangles;
  for (std::size_t t = 0; t < surface.triangles.size(); t += 3) {
    const vtkIdType corners[3] = {surface.triangles[t], surface.triangles[t + 1], surface.triangles[t + 2]};
    triangles->InsertNextCell(3, corners);
  }
  vtkNew<vtkPolyData> mesh;
  mesh->SetPoints(points);
  mesh->SetPolys(triangles);
  mesh->GetPointData()->SetScalars(heights);
  return mesh;
}

bench::Surface surface_of(vtkPolyData* mesh, double z_scale) {
  bench::Surface surface;
  for (vtkIdType v = 0; v < mesh->GetNumberOfPoints(); ++v) {
    double point[3];
    mesh->GetPoint(v, point);
    surface.points.insert(surface.points.end(), {point[0], point[1], point[2] / z_scale});
  }
  vtkNew<vtkIdList> corners;
  for (vtkIdType t = 0; t < mesh->GetNumberOfCells(); ++t) {
    mesh->GetCellPoints(t, corners);
    for (vtkIdType k = 0; k < 3; ++k) surface.triangles.push_back(static_cast<std::uint32_t>(corners->GetId(k)));
  }
  return surface;
}

}  // namespace

int main(int argc, char** argv) {
  const bench::Arguments arguments(argc, argv, "peer_vtk RASTER COLS ROWS Z_SCALE MODE PREFIX TRIANGLES...");
  const bench::RawRaster raster = bench::read_raw(arguments);
  const double z_scale = arguments.number(3);
  const std::string& mode = arguments[4];
  const bench::Surface grid = bench::full_grid(raster);
  vtkObject::GlobalWarningDisplayOff();  // warnings about collapses whose least-squares problem is not unique
  const auto mesh = mesh_of(grid, z_scale);
  for (const std::string& size : arguments.from(6)) {
    const double wanted = std::stod(size), all = static_cast<double>(grid.triangles.size() / 3);
    vtkNew<vtkQuadricDecimation> decimation;
    decimation->SetInputData(mesh);
    decimation->SetTargetReduction(1 - wanted / all);
    decimation->SetVolumePreservation(mode == "volume");
    decimation->SetAttributeErrorMetric(mode == "attribute");
    const bench::Stopwatch watch;
    decimation->Update();
    const double seconds = watch.cpu();
    const bench::Surface surface = surface_of(decimation->GetOutput(), z_scale);
    bench::write_mesh(arguments[5] + "." + size, surface);
    std::printf("{\"version\": \"%s\", \"size\": %s, \"cpu_seconds\": %.6f, \"triangles\": %zu}\n", SCARP_VTK_VERSION,
                size.c_str(), seconds, surface.triangles.size() / 3);
    std::fflush(stdout);
  }
}
