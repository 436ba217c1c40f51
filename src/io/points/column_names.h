// The meaning of the names of columns and attributes.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "scarp/result.h"

namespace scarp::io {

enum class ColumnRole { kX, kY, kHeight, kNumber, kCode, kSkipped };

/// "x", "y", "height", "number", "code"; empty for kSkipped.
const char* role_name(ColumnRole role);

/// The meaning of a name in English, German, French, Italian or Spanish: "Easting (m)", "Rechtswert", "UTM_N", "Höhe",
/// "POINT_X". kSkipped for other words.
ColumnRole role_of(std::string_view name);

/// The position of a name in the list of its role. Among several names for one role, the lowest rank wins.
std::size_t rank_of(std::string_view name);

/// The unit of length in a name: "ft" of "Elevation (ft)" and of "ELEV_FT", "us survey feet" of "H [US survey feet]".
/// Empty without a unit.
std::string unit_named_in(std::string_view name);

/// True for the letters x and y: "X", "y (m)", "XKoordinate". They are ambiguous, since geodesists call the northing x.
bool is_axis_letter(std::string_view name);

/// True for names of columns in degrees.
bool names_degrees(std::string_view name);

/// The columns named by --columns: words with commas between them ("number,northing,easting,height,code"), or letters
/// ("pnezd"): p number, e or x, n or y, z or h height, d or c code, - or "skip" for an unused column. Fails with kUsage
/// for another word, and if x, y or height is missing or repeated.
Result<std::array<std::size_t, 3>> parse_columns(const std::string& given, std::string& words);

}  // namespace scarp::io
