// Judging in an affine frame.
//
// The vertices are mapped back to grid coordinates, where sample (col, row) is the point (col, row). The inverse map
// leaves noise of some 1e-16 of the coordinates; what is that near to a lattice line is put onto it (see GridMap), so
// that a vertex on a sample is judged there and the sums below are exact for it. Each triangle is cut into rows; for a
// row the samples between its left and right side are visited. Samples on a side belong to both triangles. A sample's
// error is the barycentric mean of (corner height − sample): all weights are positive, so nothing cancels that was not
// equal before. Of a mesh in space this finds the samples near each triangle, and what is left uncovered;
// space_judge.h says the errors.
#include <cmath>
#include <optional>

#include "measure/facet_error.h"
#include "measure/grid_map.h"
#include "measure/scanner.h"
#include "measure/space_judge.h"

namespace scarp::judge {
namespace {

class GridScanner : public Scanner {
 public:
  GridScanner(const HeightField& field, const Mesh& mesh, std::vector<std::uint32_t> ids, double tolerance,
              const SpaceJudge* space)
      : rows_per_band_(Band::rows_per_band(field.cols)), rows_(field.rows), tolerance_(tolerance), space_(space) {
    facets_.mesh = &mesh;
    facets_.ids = std::move(ids);
    map_to_grid(field, mesh);
    sort_into_bands();
  }

  void scan(Band& band) const override {
    const auto index = static_cast<std::size_t>(band.first() / rows_per_band_);
    const auto each_facet = [&](auto&& visit) {
      for (std::size_t i = starts_[index]; i < starts_[index + 1]; ++i) {
        Facet facet;
        if (facets_.get(entries_[i], facet)) visit(facet, entries_[i]);
      }
    };
    std::optional<Verticals> verticals;
    if (space_ != nullptr) verticals.emplace(space_->verticals(band));
    each_facet([&](const Facet& facet, std::uint32_t id) {
      if (space_ == nullptr) return judge_inside(facet, id, band);
      space_->judge_met(facet, id, *verticals, band);
    });
    if (band.find_missing()) {
      each_facet([&](const Facet& facet, std::uint32_t id) {
        judge_beside(facet, id, band, [&](int col, int row) {
          return space_ == nullptr ? error_beside(facet, col, row, band.heights(row)[col], tolerance_)
                                   : space_->error_beside(id, col, row, *verticals);
        });
      });
    }
    if (band.has_nodata_cells()) {
      each_facet([&](const Facet& facet, std::uint32_t) { find_covered_nodata(facet, band); });
    }
  }

 private:
  void map_to_grid(const HeightField& field, const Mesh& mesh) {
    const GridMap to_grid(field, mesh.origin);
    facets_.x.resize(mesh.vertex_count());
    facets_.y.resize(mesh.vertex_count());
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
      const auto [col, row] = to_grid(mesh.positions[3 * v], mesh.positions[3 * v + 1]);
      facets_.x[v] = col;
      facets_.y[v] = row;
    }
  }

  /// Rows [first, second] of the field that the facet, grown by the tolerance, touches; first > second if none.
  std::pair<int, int> touched_rows(const Facet& facet, std::uint32_t id) const {
    const Interval along = facet.plan.y_extent();
    const double reach = tolerance_ + (space_ != nullptr ? space_->bend(id) : 0);
    return {static_cast<int>(std::clamp(std::floor(along.lo - reach), 0.0, double(rows_))),
            static_cast<int>(std::clamp(std::floor(along.hi + reach), -1.0, double(rows_ - 1)))};
  }

  void sort_into_bands() {
    const auto bands = static_cast<std::size_t>((rows_ - 1) / rows_per_band_ + 1);
    const auto each_entry = [&](auto&& visit) {
      for (const std::uint32_t id : facets_.ids) {
        Facet facet;
        if (!facets_.get(id, facet)) continue;
        const auto [first, last] = touched_rows(facet, id);
        for (int b = first / rows_per_band_; first <= last && b <= last / rows_per_band_; ++b)
          visit(id, std::size_t(b));
      }
    };
    starts_.assign(bands + 1, 0);
    each_entry([&](std::uint32_t, std::size_t b) { ++starts_[b + 1]; });
    for (std::size_t b = 0; b < bands; ++b) starts_[b + 1] += starts_[b];
    entries_.resize(starts_[bands]);
    std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
    each_entry([&](std::uint32_t id, std::size_t b) { entries_[next[b]++] = id; });
  }

  /// Whole numbers in [lo, hi] that are in [least, most].
  static std::pair<int, int> whole_between(double lo, double hi, int least, int most) {
    return {static_cast<int>(std::clamp(std::ceil(lo), double(least), most + 1.0)),
            static_cast<int>(std::clamp(std::floor(hi), least - 1.0, double(most)))};
  }

  void judge_inside(const Facet& facet, std::uint32_t id, Band& band) const {
    const PlanTriangle& plan = facet.plan;
    const Interval along = plan.y_extent(), across = plan.x_extent();
    const double margin = 1e-9 + 1e-12 * (across.hi - across.lo);
    const double slack = plan.slack();
    const double per_area = 1 / plan.double_area();
    // weight(k, col, row) = dx[k]·(row − y) − dy[k]·(col − x) with the side's first corner (x, y).
    std::array<double, 3> x{}, y{}, dx{}, dy{}, per_dy{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
      x[k] = plan.x[a];
      y[k] = plan.y[a];
      dx[k] = plan.x[b] - plan.x[a];
      dy[k] = plan.y[b] - plan.y[a];
      per_dy[k] = 1 / dy[k];
    }
    Offender worst;
    const auto [first, last] = whole_between(along.lo - margin, along.hi + margin, band.first(), band.end() - 1);
    for (int row = first; row <= last; ++row) {
      std::array<double, 3> common{};
      double lo = across.lo - margin, hi = across.hi + margin;
      for (std::size_t k = 0; k < 3; ++k) {
        common[k] = dx[k] * (row - y[k]);
        if (dy[k] > 0) hi = std::min(hi, x[k] + common[k] * per_dy[k] + margin);
        if (dy[k] < 0) lo = std::max(lo, x[k] + common[k] * per_dy[k] - margin);
      }
      auto [col, end] = whole_between(lo, hi, 0, band.cols() - 1);
      const auto weight = [&](std::size_t k, int c) { return common[k] - dy[k] * (c - x[k]); };
      const auto is_outside = [&](int c) {
        return weight(0, c) < -slack || weight(1, c) < -slack || weight(2, c) < -slack;
      };
      while (col <= end && is_outside(col)) ++col;
      while (col <= end && is_outside(end)) --end;
      const float* heights = band.heights(row);
      double* errors = band.errors(row);
      for (; col <= end; ++col) {
        const double sample = heights[col];
        if (std::isnan(sample)) continue;
        const double w0 = std::max(0.0, weight(0, col)), w1 = std::max(0.0, weight(1, col)),
                     w2 = std::max(0.0, weight(2, col));
        const double t0 = w0 * (facet.z[0] - sample), t1 = w1 * (facet.z[1] - sample), t2 = w2 * (facet.z[2] - sample);
        double error = (t0 + t1 + t2) * per_area;
        if (band.is_critical(col, row, error) && (t0 != 0 || t1 != 0 || t2 != 0)) {
          error = settle_error({w0, w1, w2}, facet.z, sample);
        }
        band.offer(errors[col], error);
        if (band.is_offender(col, row, error) && std::abs(error) > std::abs(worst.error)) worst = {col, row, error};
      }
    }
    if (worst.error != 0) band.add_offender(id, worst);
  }

  /// `error_of`: of a sample, on the facet.
  template <class ErrorOf>
  void judge_beside(const Facet& facet, std::uint32_t id, Band& band, const ErrorOf& error_of) const {
    const Interval along = facet.plan.y_extent();
    const auto [first, last] =
        whole_between(along.lo - tolerance_, along.hi + tolerance_, band.first(), band.end() - 1);
    for (int row = first; row <= last; ++row) {
      if (!band.row_has_missing(row)) continue;
      const Interval range = facet.plan.x_range(row - tolerance_, row + tolerance_);
      const auto [begin, end] = whole_between(range.lo - tolerance_, range.hi + tolerance_, 0, band.cols() - 1);
      for (int col = begin; col <= end; ++col) {
        if (!band.is_missing(col, row)) continue;
        const double distance = facet.plan.distance(col, row);
        if (distance > tolerance_) continue;
        band.offer_nearest(col, row, distance, id, error_of(col, row));
      }
    }
  }

  void find_covered_nodata(const Facet& facet, Band& band) const {
    const Interval along = facet.plan.y_extent();
    const int last_row = std::min(band.end(), rows_ - 1) - 1;
    const auto [first, last] = whole_between(std::floor(along.lo), along.hi, band.first(), last_row);
    for (int row = first; row <= last; ++row) {
      if (!band.row_has_nodata_cells(row)) continue;
      const Interval range = facet.plan.x_range(row, row + 1);
      const auto [begin, end] = whole_between(std::floor(range.lo), range.hi, 0, band.cols() - 2);
      for (int col = begin; col <= end; ++col) {
        const auto point = band.nodata_point(col, row);
        if (point && facet.plan.depth((*point)[0], (*point)[1]) > tolerance_) band.count_nodata_cell(col, row);
      }
    }
  }

  int rows_per_band_, rows_;
  double tolerance_;
  const SpaceJudge* space_;  // null on the map
  Facets facets_;
  std::vector<std::size_t> starts_;     // by band
  std::vector<std::uint32_t> entries_;  // triangles of each band, ascending
};

}  // namespace

std::unique_ptr<Scanner> make_grid_scanner(const HeightField& field, const Mesh& mesh, std::vector<std::uint32_t> ids,
                                           double tolerance, const SpaceJudge* space) {
  return std::make_unique<GridScanner>(field, mesh, std::move(ids), tolerance, space);
}

}  // namespace scarp::judge
