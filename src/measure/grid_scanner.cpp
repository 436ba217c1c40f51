// Judging in an affine frame.
//
// The vertices are mapped back to grid coordinates, where sample (col, row) is the point (col, row). The inverse map
// causes noise of some 1e-16 of the coordinates. Coordinates that close to a lattice line are snapped to it (see
// GridMap), so that a vertex on a sample is judged there with exact sums. Each triangle is scanned by rows: the samples
// between its left and right sides are judged in vectors (judge_kernels.h). Samples on a side belong to both triangles.
// A sample's error is the barycentric mean of (corner height − sample): all weights are positive, so there is no
// further cancellation. An error that may be the band's largest or exceed a bound is computed exactly. For a mesh in
// space, the scanner finds the samples near each triangle, and the uncovered samples; space_judge.h computes the
// errors.
#include <bit>
#include <cmath>
#include <optional>
#include <utility>

#include "base/branchless.h"
#include "base/parallel.h"
#include "measure/facet_error.h"
#include "measure/facet_task.h"
#include "measure/judge_kernels.h"
#include "measure/scanner.h"
#include "measure/space_judge.h"

namespace scarp::judge {
namespace {

class GridScanner : public Scanner {
 public:
  GridScanner(const HeightField& field, const Mesh& mesh, GridPlaces places,
              std::optional<std::span<const std::uint32_t>> ids, double tolerance, int threads, const SpaceJudge* space)
      : rows_per_band_(Band::rows_per_band(field.cols)),
        rows_(field.rows),
        tolerance_(tolerance),
        are_on_lattice_(places.are_on_lattice),
        space_(space),
        facets_{std::move(places.corners), &mesh} {
    sort_into_bands(ids, threads);
  }

  void scan(Band& band) const override {
    const auto index = static_cast<std::size_t>(band.first() / rows_per_band_);
    const auto each_facet = [&](auto&& visit) {
      constexpr std::size_t kAhead = 8;
      for (std::size_t i = starts_[index]; i < starts_[index + 1]; ++i) {
        if (i + kAhead < starts_[index + 1]) facets_.expect(entries_[i + kAhead]);
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
  /// Bands first … last; none if first > last.
  struct BandSpan {
    std::int32_t first, last;
  };

  /// Bands that the triangle, enlarged by the tolerance, touches.
  BandSpan touched_bands(std::uint32_t id) const {
    const std::uint32_t* vertices = &facets_.mesh->triangles[3 * std::size_t{id}];
    const double a = facets_.corners.row(vertices[0]), b = facets_.corners.row(vertices[1]),
                 c = facets_.corners.row(vertices[2]);
    const double reach = tolerance_ + (space_ != nullptr ? space_->bend(id) : 0);
    const double lo = greater(lesser(a, b, c) - reach, 0), hi = lesser(greater(a, b, c) + reach, rows_ - 1.0);
    if (!(lo < rows_ && hi >= 0)) return {0, -1};
    return {static_cast<std::int32_t>(lo) / rows_per_band_, static_cast<std::int32_t>(hi) / rows_per_band_};
  }

  /// Counting sort, part by part, so that triangles of a band remain ascending.
  void sort_into_bands(std::optional<std::span<const std::uint32_t>> ids, int threads) {
    constexpr std::size_t kTogether = 1 << 16;
    const auto bands = static_cast<std::size_t>((rows_ - 1) / rows_per_band_ + 1);
    const std::size_t count = ids ? ids->size() : facets_.mesh->triangle_count();
    const std::size_t parts = (count + kTogether - 1) / kTogether;
    std::vector<std::size_t> next(parts * bands, 0);  // by part, then band: first the count, then the next position
    const auto each_touch = [&](const auto& visit) {
      parallel_for_parts(count, kTogether, threads, [&](std::size_t first, std::size_t end) {
        std::size_t* const at = &next[first / kTogether * bands];
        for (std::size_t i = first; i < end; ++i) {
          const std::uint32_t id = ids ? (*ids)[i] : static_cast<std::uint32_t>(i);
          const BandSpan touched = touched_bands(id);
          for (std::int32_t band = touched.first; band <= touched.last; ++band) visit(at[band], id);
        }
      });
    };
    each_touch([](std::size_t& number, std::uint32_t) { ++number; });
    starts_.assign(bands + 1, 0);
    std::size_t sum = 0;
    for (std::size_t band = 0; band < bands; ++band) {
      starts_[band] = sum;
      for (std::size_t part = 0; part < parts; ++part) sum += std::exchange(next[part * bands + band], sum);
    }
    starts_[bands] = sum;
    entries_.resize(sum);
    each_touch([this](std::size_t& at, std::uint32_t id) { entries_[at++] = id; });
  }

  void judge_inside(const Facet& facet, std::uint32_t id, Band& band) const {
    FacetTask task;
    if (!make_task(facet, {band.first(), band.end() - 1, band.cols()}, are_on_lattice_, task)) return;
    Inside inside{facet, task, band, {}};
    Caution caution{band.watch(), &inside, &Inside::look};
    judge_kernels().judge_facet(task, band.rows(), caution);
    if (inside.worst.error != 0) band.add_offender(id, inside.worst);
  }

  /// One facet in one band, for samples that need more than plain arithmetic.
  struct Inside {
    const Facet& facet;
    const FacetTask& task;
    Band& band;
    Offender worst;

    /// The function for Caution::look.
    static double look(void* self, std::int32_t row, std::int32_t column, std::uint32_t lanes) {
      auto& inside = *static_cast<Inside*>(self);
      for (; lanes != 0; lanes &= lanes - 1) inside.look_at(column + std::countr_zero(lanes), row);
      return inside.band.watch();
    }
    void look_at(int col, int row) {
      const double sample = band.heights(row)[col];
      std::array<double, 3> w{};
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        w[k] = std::max(0.0, task.dx[k] * (row - task.y[k]) - task.dy[k] * (col - task.x[k]));
        sum += w[k] * (facet.z[k] - sample);
      }
      double error = sum * task.per_area;
      if (band.is_critical(col, row, error)) error = settle_error(w, facet.z, sample);
      band.offer(band.errors(row)[col], error);
      if (band.is_offender(col, row, error) && std::abs(error) > std::abs(worst.error)) worst = {col, row, error};
    }
  };

  /// `error_of`: returns the error of a sample on the facet.
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
  bool are_on_lattice_;
  const SpaceJudge* space_;  // null on the map
  Facets facets_;
  std::vector<std::size_t> starts_;  // by band
  Array<std::uint32_t> entries_;     // triangles of each band, ascending
};

}  // namespace

std::unique_ptr<Scanner> make_grid_scanner(const HeightField& field, const Mesh& mesh, GridPlaces places,
                                           std::optional<std::span<const std::uint32_t>> ids, double tolerance,
                                           int threads, const SpaceJudge* space) {
  return std::make_unique<GridScanner>(field, mesh, std::move(places), ids, tolerance, threads, space);
}

}  // namespace scarp::judge
