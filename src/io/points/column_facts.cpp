#include "io/points/column_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/points/text_lines.h"

namespace scarp::io {
namespace {

/// A northing of middle latitudes, in metres from the equator.
bool is_mid_northing(const ColumnFacts& facts) { return facts.lies_in(4.0e6, 7.9e6); }

/// The zone number in front of an easting of about half a million: Gauss-Krueger, Poland 2000. 0 if there is none. Zone
/// 1 is excluded, since its eastings resemble northings in feet.
int zone_of(const ColumnFacts& facts) {
  const double zone = std::floor(facts.low / 1e6), base = zone * 1e6;
  return zone >= 2 && zone <= 60 && facts.lies_in(base + 2e5, base + 8e5) ? static_cast<int>(zone) : 0;
}

/// True for metres from a meridian, as in Austria.
bool is_about_meridian(const ColumnFacts& facts) { return facts.lies_in(-4e5, 4e5) && facts.extent() < 4e5; }

bool may_be_pair(const ColumnFacts& north, const ColumnFacts& east) {
  if (is_northing(north) && is_easting(east)) return true;
  if (north.lies_in(1.07e6, 1.3e6) && east.lies_in(2.48e6, 2.84e6)) return true;  // Switzerland
  if (!is_mid_northing(north)) return false;
  const int zone = zone_of(east);
  return zone == 2 ? north.high < 6.15e6 : zone > 2 || (north.high < 6.6e6 && is_about_meridian(east));
}

/// True for pairs in Germany and Poland. Eastings with a zone number resemble northings, but up to zone 5 they are
/// smaller than any northing there.
bool is_sure_pair(const ColumnFacts& north, const ColumnFacts& east) {
  const int zone = zone_of(east);
  return north.lies_in(5.2e6, 6.15e6) && zone > 0 && zone <= 8 && (zone >= 6 || east.high < north.low);
}

bool counts(const ColumnFacts& facts) {
  return facts.numbers >= 3 && facts.are_whole && facts.has_even_steps && facts.step != 0;
}

bool are_colours(const ColumnFacts& facts) { return facts.are_whole && facts.lies_in(0, 65536); }

}  // namespace

void ColumnFacts::add(std::string_view field, bool has_decimal_comma) {
  filled += field.empty() ? 0 : 1;
  const auto value = parse_field(field, has_decimal_comma);
  if (!value || !std::isfinite(*value)) return;
  if (numbers == 0) first = *value;
  if (numbers == 1) step = *value - first;
  if (numbers >= 1) has_even_steps = has_even_steps && std::abs(*value - last - step) <= 1e-6 * std::abs(step);
  are_whole = are_whole && field.find_first_of(".,eE") == std::string_view::npos;
  leads_with_zero = leads_with_zero || (field.size() > 1 && field[0] == '0' && field.find('.') == field.npos);
  narrow = std::min(narrow, field.size());
  wide = std::max(wide, field.size());
  low = std::min(low, *value);
  high = std::max(high, *value);
  last = *value;
  ++numbers;
}

bool is_northing(const ColumnFacts& facts) { return facts.lies_in(1e6, 1.1e7); }
bool is_easting(const ColumnFacts& facts) { return facts.lies_in(1e5, 1e6); }

PairFit fit_pair(const ColumnFacts& one, const ColumnFacts& other) {
  PairFit fit{may_be_pair(other, one), may_be_pair(one, other)};
  if (fit.is_east_first && fit.is_north_first) {
    if (is_sure_pair(other, one))
      fit.is_north_first = false;
    else if (is_sure_pair(one, other))
      fit.is_east_first = false;
  }
  return fit;
}

namespace {

/// True if the first column numbers the points. Its values are whole, while x and y have decimals; or they have even
/// steps, unlike x and y; or they are whole and unique before map coordinates.
bool first_counts(const Rows& rows, const std::vector<std::size_t>& list) {
  const ColumnFacts &number = rows.columns[0], &a = rows.columns[list[1]], &b = rows.columns[list[2]];
  if (number.are_whole && !a.are_whole && !b.are_whole) return true;
  const bool is_even = rows.count >= 3 && number.has_even_steps && number.step != 0;
  const bool is_transect = a.has_even_steps || b.has_even_steps;
  const bool is_map_pair = (is_northing(a) && is_easting(b)) || (is_easting(a) && is_northing(b));
  return !is_transect && (is_even || (number.are_whole && rows.are_labels_unique && is_map_pair));
}

}  // namespace

std::vector<std::size_t> Rows::coordinates() const {
  std::vector<std::size_t> list;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (holds_numbers(k)) list.push_back(k);
  }
  if (list.size() >= 4 && list[0] == 0 && first_counts(*this, list)) list.erase(list.begin());
  return list;
}

std::optional<HeightDoubt> doubt_height(const Rows& rows, const std::vector<std::size_t>& list) {
  const ColumnFacts &x = rows.columns[list[0]], &y = rows.columns[list[1]], &height = rows.columns[list[2]];
  const bool is_even = height.extent() == 0 && rows.count >= 2, have_decimals = !x.are_whole && !y.are_whole;
  const bool is_small = height.lies_in(0, 1) && x.low > 1000 && y.low > 1000;
  std::string why;
  if (is_even)
    why = fmt::format("is {:.9g} everywhere", height.low);
  else if (have_decimals && counts(height))
    why = "counts";
  else if (have_decimals && height.are_whole)
    why = fmt::format("holds whole numbers from {:.9g}", height.low);
  else if (is_small && !height.are_whole)
    why = "holds numbers below 1, as deviations are";
  if (why.empty()) return std::nullopt;
  std::optional<std::size_t> whole;
  for (std::size_t k = 3; k < list.size(); ++k) {
    const ColumnFacts& later = rows.columns[list[k]];
    if (later.extent() == 0 || std::max(std::abs(later.low), std::abs(later.high)) > 1e5) continue;
    if (!later.are_whole && !later.lies_in(-1.001, 1.001)) return HeightDoubt{why, list[k], true};
    if (!whole && !counts(later)) whole = list[k];
  }
  if (!is_even || !whole) return std::nullopt;
  return HeightDoubt{why, *whole, false};
}

std::optional<std::size_t> find_later_pair(const Rows& rows, const std::vector<std::size_t>& list) {
  const auto is_pair = [&](std::size_t k) {
    const PairFit fit = fit_pair(rows.columns[list[k]], rows.columns[list[k + 1]]);
    return fit.is_east_first || fit.is_north_first;
  };
  if (is_pair(0)) return std::nullopt;
  for (std::size_t k = 1; k + 2 < list.size(); ++k) {
    if (is_pair(k)) return k;
  }
  // Colours may precede local coordinates.
  if (list.size() < 6) return std::nullopt;
  for (std::size_t k = 0; k < 6; ++k) {
    const ColumnFacts& facts = rows.columns[list[k]];
    if (k < 3 ? !are_colours(facts) : facts.are_whole || facts.lies_in(-1.001, 1.001)) return std::nullopt;
  }
  return 3;
}

bool are_split_at_commas(const Rows& rows) {
  const std::size_t count = rows.columns.size(), first = count % 2;
  if (count - first < 6) return false;
  bool lead_with_zero = false;
  for (std::size_t k = first; k < count; ++k) {
    const ColumnFacts& facts = rows.columns[k];
    if (!facts.are_whole || facts.numbers < rows.count) return false;
    if ((k - first) % 2 == 0) continue;
    if (facts.low < 0 || facts.narrow != facts.wide || facts.wide > 4) return false;
    lead_with_zero = lead_with_zero || facts.leads_with_zero;
  }
  const PairFit fit = fit_pair(rows.columns[first], rows.columns[first + 2]);
  return lead_with_zero || fit.is_east_first || fit.is_north_first;
}

}  // namespace scarp::io
