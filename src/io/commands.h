// Commands for error messages, ready to run except for words in capitals, which the user replaces.
#pragma once

#include <cstdint>
#include <string>

#pragma GCC visibility push(default)

namespace scarp::io {

/// The file's name quoted for a shell; "FILE" for input without a name, such as standard input.
std::string file_word(const std::string& file);
/// An unused name: NEW.tif, else NEW2.tif, …, so that one suggested command does not overwrite another's result.
std::string new_file(const std::string& extension);
/// "gdal_translate OPTIONS FILE NEW.tif". Unlike gdal_edit, it can set a CRS or a position if the file's format stores
/// none.
std::string translate_command(const std::string& options, const std::string& file);
/// "gdalwarp OPTIONS … FILE NEW.tif". Points outside the raster become nodata; by default, gdalwarp sets them to 0.
std::string warp_command(const std::string& options, const std::string& file);

/// "sed '1,COUNTs/^/#/' FILE > NEW.csv": the first lines become comments.
std::string comment_out_command(const std::string& file, std::uint64_t lines);
/// "scarp simplify FILE NEW.tif -e ERROR", for a file of points.
std::string rasterize_command(const std::string& file);
/// "tail -c +COUNT FILE > NEW.csv": omits the first bytes.
std::string skip_command(std::size_t bytes, const std::string& file);
/// "iconv -f ENCODING -t UTF-8 FILE > NEW.csv".
std::string utf8_command(const std::string& encoding, const std::string& file);

}  // namespace scarp::io

#pragma GCC visibility pop
