// The words by which columns and attributes name their contents.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "scarp/result.h"

namespace scarp {

enum class ColumnRole { kX, kY, kHeight, kNumber, kCode, kSkipped };

/// "x", "y", "height", "number", "code"; empty for kSkipped.
const char* role_name(ColumnRole role);

/// The meaning of a name in English, German, French, Italian or Spanish: "Easting (m)", "Rechtswert", "UTM_N", "Höhe",
/// "POINT_X". kSkipped where it is none of these words.
ColumnRole role_of(std::string_view name);

/// The place of a name in the list of its role: of several names for one thing the one with the least counts.
std::size_t rank_of(std::string_view name);

/// The unit of length in a name: "ft" of "Elevation (ft)" and of "ELEV_FT", "us survey feet" of "H [US survey feet]".
/// Empty if there is none.
std::string unit_named_in(std::string_view name);

/// True for x and y themselves: "X", "y (m)", "XKoordinate". Geodesists call the northing x.
bool is_axis_letter(std::string_view name);

/// True for the names of degrees.
bool names_degrees(std::string_view name);

/// The columns that --columns names: words with commas between them ("number,northing,easting,height,code"), or
/// letters ("pnezd"): p number, e or x, n or y, z or h height, d or c code, - or skip nothing. Fails with kUsage for
/// another word, and where x, y or height is missing or named twice.
Result<std::array<std::size_t, 3>> parse_columns(const std::string& given, std::string& words);

}  // namespace scarp
