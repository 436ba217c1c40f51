// The pull of a triangle's samples on one of its corners, where several fields count together.
#include "fit/norm_scan.h"

namespace scarp::fit {

namespace {

struct FieldSums {
  Floats stiffness, push;
};

struct FieldErrors {
  Floats low, high;
};

double exact_total(Floats s) { return (double{s[0]} + s[2]) + (double{s[1]} + s[3]); }

Floats sixth_power(Floats values) {
  const Floats squares = values * values;
  return squares * squares * squares;
}

/// The weight of errors at four samples. It is equal for all fields, but with Norm::kMax each has its own.
template <Norm kNorm, ErrorRule::Power kPower>
Floats weight_of(Floats norm, Floats error) {
  if constexpr (kPower == ErrorRule::Power::kTwo) return all(1);
  if constexpr (kNorm == Norm::kMax) return sixth_power(error);
  if constexpr (kNorm == Norm::kSum) return sixth_power(norm);
  return norm * norm * norm;
}

template <Norm kNorm, ErrorRule::Power kPower>
void sum_up(const NormScan& scan, const NormPlanes& planes, std::array<FieldSums, kMostFitFields>& sums) {
  const auto& [a, b, c] = planes.task.corners;
  constexpr double kStep = 1.0 / grid::kLatticeSteps;
  const geom::ScanPlane weight = geom::ScanPlane::spanned(
      1, {(b.x - a.x) * kStep, (b.y - a.y) * kStep, (c.x - a.x) * kStep, (c.y - a.y) * kStep, -1, -1}, 0);
  const std::size_t count = scan.norm.fields.size();
  const Floats least = all(least_bound(planes));
  std::array<FieldErrors, kMostFitFields> errors;
  each_row(planes.task, [&](std::int32_t y, std::int32_t first, std::int32_t last) {
    const float down = static_cast<float>(y) - planes.task.base_y;
    const Floats row = all(1 + weight.slope_y * down), slope = all(weight.slope_x);
    for (std::int32_t x = first; x <= last; x += kLanes) {
      const EightPlaces places(scan, planes.task, x, y, last);
      const auto in_bounds = [&](Floats low, Floats high) {
        return FieldErrors{per_bound(kept(low, places.low_meant), places.low_bound, least),
                           per_bound(kept(high, places.high_meant), places.high_bound, least)};
      };
      NormEight<kNorm> norms;
      for (std::size_t k = 0; k < count; ++k) {
        const EightErrors of(scan, planes, k, places, scan.index_of(x, y), down);
        errors[k] = in_bounds(of.low, of.high);
        norms.add(magnitude(errors[k].low), magnitude(errors[k].high));
      }
      const FieldErrors share = in_bounds(row + slope * places.left, row + slope * places.right);
      for (std::size_t k = 0; k < count; ++k) {
        const Floats low = weight_of<kNorm, kPower>(norms.low, errors[k].low) * share.low;
        const Floats high = weight_of<kNorm, kPower>(norms.high, errors[k].high) * share.high;
        sums[k].stiffness += low * share.low + high * share.high;
        sums[k].push += low * errors[k].low + high * errors[k].high;
      }
    }
    return true;
  });
}

template <ErrorRule::Power kPower>
void sum_up(const NormScan& scan, const NormPlanes& planes, Norm norm, std::array<FieldSums, kMostFitFields>& sums) {
  if (norm == Norm::kMax) {
    sum_up<Norm::kMax, kPower>(scan, planes, sums);
  } else if (norm == Norm::kSum) {
    sum_up<Norm::kSum, kPower>(scan, planes, sums);
  } else {
    sum_up<Norm::kSquares, kPower>(scan, planes, sums);
  }
}

}  // namespace

void NormError::pull(const Corners& corners, ErrorRule::Power power, std::vector<Pull>& pulls) const {
  pulls.assign(field_count(), {});
  const NormScan scan = this->scan();
  const NormPlanes planes(scan, corners);
  if (!planes.are_finite) return;
  std::array<FieldSums, kMostFitFields> sums;
  std::fill_n(sums.begin(), field_count(), FieldSums{});
  if (power == ErrorRule::Power::kTwo) {
    sum_up<ErrorRule::Power::kTwo>(scan, planes, norm(), sums);
  } else {
    sum_up<ErrorRule::Power::kEight>(scan, planes, norm(), sums);
  }
  for (std::size_t k = 0; k < field_count(); ++k) {
    const FieldPlane& plane = planes.fields[k];
    pulls[k] = {exact_total(sums[k].stiffness), exact_total(sums[k].push), double{plane.slope_x} * plane.scale,
                double{plane.slope_y} * plane.scale};
  }
}

}  // namespace scarp::fit
