// Judging in any frame.
//
// A frame with a transform (a map projection) cannot be inverted here, so samples are converted to the mesh's frame,
// row by row. A bucket grid over the field's image, with as many buckets as triangles, yields the candidate triangles
// at a position. Tolerances are in samples: near a sample, the frame is treated as affine, and its inverse converts
// triangles to grid coordinates around the sample.
#include <cmath>
#include <limits>
#include <vector>

#include "measure/bucket_grid.h"
#include "measure/facet_error.h"
#include "measure/scanner.h"

namespace scarp::judge {
namespace {

/// Points of the mesh's frame, relative to the mesh's origin.
struct Points {
  std::vector<double> x, y;
};

/// The frame around one point: steps of one column and one row.
struct LocalFrame {
  double x = 0, y = 0;
  double col_x = 0, col_y = 0, row_x = 0, row_y = 0;

  double determinant() const { return col_x * row_y - col_y * row_x; }
  /// Converts the facet to columns and rows relative to the point.
  bool to_grid(const Facet& facet, Facet& local) const {
    const double det = determinant();
    for (std::size_t k = 0; k < 3; ++k) {
      const double dx = facet.plan.x[k] - x, dy = facet.plan.y[k] - y;
      local.plan.x[k] = (row_y * dx - row_x * dy) / det;
      local.plan.y[k] = (col_x * dy - col_y * dx) / det;
      local.z[k] = facet.z[k];
    }
    return make_counter_clockwise(local);
  }
};

class FrameScanner : public Scanner {
 public:
  FrameScanner(const HeightField& field, const Mesh& mesh, std::span<const std::uint32_t> ids, double tolerance)
      : frame_(field.frame),
        mesh_(mesh),
        tolerance_(tolerance),
        grid_(bounds(field), std::max<std::size_t>(1, ids.size())) {
    facets_.mesh = &mesh;
    Array<FacetCorner> corners;
    corners.resize(mesh.vertex_count());
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v)
      corners[v] = {mesh.positions[3 * v], mesh.positions[3 * v + 1], mesh.origin[2] + mesh.positions[3 * v + 2]};
    facets_.corners = FacetCorners(std::move(corners));
    grid_.fill([&](const auto& visit) {
      for (const std::uint32_t id : ids) {
        Facet facet;
        if (facets_.get(id, facet)) visit(id, facet.plan);
      }
    });
  }

  void scan(Band& band) const override {
    for (int row = band.first(); row < band.end(); ++row) judge_inside(band, row);
    if (band.find_missing()) {
      for (int row = band.first(); row < band.end(); ++row) judge_beside(band, row);
    }
    if (band.has_nodata_cells()) {
      for (int row = band.first(); row < band.end(); ++row) find_covered_nodata(band, row);
    }
  }

 private:
  /// The bounds of the field, from its border and some lines across it, with a margin. Triangles outside the bounds
  /// cost nothing. Triangles over samples outside the bounds are still found, but slowly.
  Box bounds(const HeightField& field) const {
    std::vector<double> cols, rows;
    const double last_col = field.cols - 1, last_row = field.rows - 1;
    constexpr int kLines = 16, kPoints = 256;
    for (int line = 0; line <= kLines; ++line) {
      for (int point = 0; point <= kPoints; ++point) {
        const double across = double(line) / kLines, along = double(point) / kPoints;
        cols.insert(cols.end(), {along * last_col, across * last_col});
        rows.insert(rows.end(), {across * last_row, along * last_row});
      }
    }
    Points points;
    locate(cols, rows, 0, 0, points);
    Box box;
    for (std::size_t i = 0; i < cols.size(); ++i) {
      if (std::isfinite(points.x[i]) && std::isfinite(points.y[i])) box.include(points.x[i], points.y[i]);
    }
    if (!(box.x0 <= box.x1)) return {0, 0, 0, 0};
    const double margin_x = 0.02 * (box.x1 - box.x0), margin_y = 0.02 * (box.y1 - box.y0);
    return {box.x0 - margin_x, box.y0 - margin_y, box.x1 + margin_x, box.y1 + margin_y};
  }

  /// Positions of grid points; NaN if the frame cannot map a point.
  void locate(const std::vector<double>& cols, const std::vector<double>& rows, double col_shift, double row_shift,
              Points& points) const {
    points.x.resize(cols.size());
    points.y.resize(cols.size());
    for (std::size_t i = 0; i < cols.size(); ++i) {
      const auto [x, y] = frame_.apply_affine(cols[i] + col_shift, rows[i] + row_shift);
      points.x[i] = x;
      points.y[i] = y;
    }
    if (frame_.transform) frame_.transform->apply(points.x, points.y);
    for (std::size_t i = 0; i < cols.size(); ++i) {
      points.x[i] -= mesh_.origin[0];
      points.y[i] -= mesh_.origin[1];
    }
  }

  void judge_inside(Band& band, int row) const {
    std::vector<double> cols, rows;
    const float* heights = band.heights(row);
    for (int c = 0; c < band.cols(); ++c) {
      if (!std::isnan(heights[c])) cols.push_back(c);
    }
    rows.assign(cols.size(), row);
    Points points;
    locate(cols, rows, 0, 0, points);
    double* errors = band.errors(row);
    for (std::size_t i = 0; i < cols.size(); ++i) {
      const double x = points.x[i], y = points.y[i];
      if (!std::isfinite(x) || !std::isfinite(y)) continue;
      const int col = static_cast<int>(cols[i]);
      const double sample = heights[col];
      for (const std::uint32_t id : grid_.bucket(grid_.col_of(x), grid_.row_of(y))) {
        Facet facet;
        facets_.get(id, facet);
        if (!facet.plan.contains(x, y)) continue;
        std::array<double, 3> w{};
        double sum = 0, area = 0;
        for (int k = 0; k < 3; ++k) {
          w[k] = std::max(0.0, facet.plan.weight(k, x, y));
          sum += w[k] * (facet.z[k] - sample);
          area += w[k];
        }
        if (area <= 0) continue;
        double error = sum / area;
        if (error != 0 && band.is_critical(col, row, error)) error = settle_error(w, facet.z, sample);
        band.offer(errors[col], error);
        if (band.is_offender(col, row, error)) band.add_offender(id, {col, row, error});
      }
    }
  }

  /// The local frames of grid points; NaN if a point cannot be mapped or its frame is singular.
  std::vector<LocalFrame> local_frames(const std::vector<double>& cols, const std::vector<double>& rows) const {
    Points here, right, down;
    locate(cols, rows, 0, 0, here);
    locate(cols, rows, 0.5, 0, right);
    locate(cols, rows, 0, 0.5, down);
    std::vector<LocalFrame> frames(cols.size());
    for (std::size_t i = 0; i < cols.size(); ++i) {
      frames[i] = {here.x[i],
                   here.y[i],
                   2 * (right.x[i] - here.x[i]),
                   2 * (right.y[i] - here.y[i]),
                   2 * (down.x[i] - here.x[i]),
                   2 * (down.y[i] - here.y[i])};
      const double det = frames[i].determinant();
      if (!std::isfinite(det) || det == 0) frames[i].x = std::numeric_limits<double>::quiet_NaN();
    }
    return frames;
  }

  /// Calls visit(id, facet in grid coordinates around the point) for all triangles in the buckets within `reach`
  /// samples, perhaps repeatedly.
  template <class Visit>
  void visit_near(const LocalFrame& at, double reach, const Visit& visit) const {
    const double dx = reach * (std::abs(at.col_x) + std::abs(at.row_x)),
                 dy = reach * (std::abs(at.col_y) + std::abs(at.row_y));
    for (int r = grid_.row_of(at.y - dy); r <= grid_.row_of(at.y + dy); ++r) {
      for (int c = grid_.col_of(at.x - dx); c <= grid_.col_of(at.x + dx); ++c) {
        for (const std::uint32_t id : grid_.bucket(c, r)) {
          Facet facet, local;
          facets_.get(id, facet);
          if (at.to_grid(facet, local)) visit(id, local);
        }
      }
    }
  }

  void judge_beside(Band& band, int row) const {
    if (!band.row_has_missing(row)) return;
    std::vector<double> cols, rows;
    for (int c = 0; c < band.cols(); ++c) {
      if (band.is_missing(c, row)) cols.push_back(c);
    }
    rows.assign(cols.size(), row);
    const std::vector<LocalFrame> frames = local_frames(cols, rows);
    for (std::size_t i = 0; i < cols.size(); ++i) {
      if (std::isnan(frames[i].x)) continue;
      const int col = static_cast<int>(cols[i]);
      const double sample = band.heights(row)[col];
      visit_near(frames[i], tolerance_, [&](std::uint32_t id, const Facet& local) {
        const double distance = local.plan.distance(0, 0);
        if (distance > tolerance_) return;
        band.offer_nearest(col, row, distance, id, error_beside(local, 0, 0, sample, tolerance_));
      });
    }
  }

  void find_covered_nodata(Band& band, int row) const {
    if (!band.row_has_nodata_cells(row)) return;
    std::vector<double> cols, rows;
    std::vector<int> cells;
    for (int c = 0; c + 1 < band.cols(); ++c) {
      const auto point = band.nodata_point(c, row);
      if (!point) continue;
      cells.push_back(c);
      cols.push_back((*point)[0]);
      rows.push_back((*point)[1]);
    }
    const std::vector<LocalFrame> frames = local_frames(cols, rows);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (std::isnan(frames[i].x)) continue;
      bool is_covered = false;
      visit_near(frames[i], 0, [&](std::uint32_t, const Facet& local) {
        is_covered = is_covered || local.plan.depth(0, 0) > tolerance_;
      });
      if (is_covered) band.count_nodata_cell(cells[i], row);
    }
  }

  const Frame& frame_;
  const Mesh& mesh_;
  double tolerance_;
  Facets facets_;
  BucketGrid grid_;
};

}  // namespace

std::unique_ptr<Scanner> make_frame_scanner(const HeightField& field, const Mesh& mesh,
                                            std::span<const std::uint32_t> ids, double tolerance) {
  return std::make_unique<FrameScanner>(field, mesh, ids, tolerance);
}

}  // namespace scarp::judge
