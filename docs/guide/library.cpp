// The program of docs/guide/library.md: heights of your own in, a proven mesh out.
#include <scarp/scarp.h>

#include <cmath>
#include <cstdio>
#include <vector>

int main() {
  // 1. Heights, row by row, the first row in the north. NaN is nodata.
  constexpr int kCols = 300, kRows = 200;
  std::vector<float> heights;
  for (int row = 0; row < kRows; ++row)
    for (int col = 0; col < kCols; ++col)
      heights.push_back(static_cast<float>(60 * std::sin(col * 0.05) * std::cos(row * 0.04)));

  // 2. Where they lie: 10 m to a cell, the first sample at (0, 0), rows going south.
  scarp::HeightField field;
  field.samples = heights.data();  // borrowed
  field.cols = kCols;
  field.rows = kRows;
  field.frame.kind = scarp::Frame::Kind::kLocal;
  field.frame.affine = {0, 10, 0, 0, 0, -10};

  // 3. A mesh at most 0.5 m off.
  scarp::SimplifyOptions options;
  options.goals.max_error = 0.5;
  options.output.normals = true;
  const auto result = scarp::simplify(field, options);
  if (!result) {
    std::fprintf(stderr, "%s\n", result.error().message.c_str());  // one sentence: what is wrong, and the way out
    return 1;
  }

  // 4. The proof comes with it: errors at every sample.
  const scarp::Measurement& measured = result->measurement;
  std::printf("%zu triangles, max error %.2f m at column %d, row %d\n", result->mesh.triangle_count(),
              measured.max_error, measured.max_error_at[0], measured.max_error_at[1]);

  // 5. Use the arrays as they are, or write a file.
  const std::vector<double>& xyz = result->mesh.positions;             // from result->mesh.origin
  const std::vector<std::uint32_t>& corners = result->mesh.triangles;  // three a triangle, counter-clockwise
  std::printf("%zu vertices, the first triangle is %u %u %u\n", xyz.size() / 3, corners[0], corners[1], corners[2]);
  return scarp::write_mesh(result->mesh, "hills.glb") ? 0 : 1;
}
