// Commands of other programs that sentences print: each runs as it stands. Words in capitals are for the user to
// choose.
#pragma once

#include <cstdint>
#include <string>

#pragma GCC visibility push(default)

namespace scarp {

/// The file as a shell needs it; "FILE" for what has no name, such as standard input.
std::string file_word(const std::string& file);
/// A name that is not there yet: NEW.tif, else NEW2.tif, …, so that one way out does not undo another.
std::string new_file(const std::string& extension);
/// "gdal_translate OPTIONS FILE NEW.tif". Unlike gdal_edit it names a CRS or a place for formats that keep none, too.
std::string translate_command(const std::string& options, const std::string& file);
/// "gdalwarp OPTIONS … FILE NEW.tif". Points that the raster does not cover are nodata: gdalwarp writes heights of 0
/// else.
std::string warp_command(const std::string& options, const std::string& file);

/// "sed '1,COUNTs/^/#/' FILE > NEW.csv": the first lines become comments.
std::string comment_out_command(const std::string& file, std::uint64_t lines);
/// A text without its comments and blank lines, for programs that would read them as text: "sed … FILE > MADE".
std::string uncomment_command(const std::string& file, const std::string& made);
/// "iconv -f ENCODING -t UTF-8 FILE > NEW.csv".
std::string utf8_command(const std::string& encoding, const std::string& file);

}  // namespace scarp

#pragma GCC visibility pop
