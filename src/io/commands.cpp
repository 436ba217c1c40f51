#include "io/commands.h"

#include <fmt/format.h>

#include <filesystem>
#include <string_view>
#include <system_error>

namespace scarp::io {

std::string file_word(const std::string& file) {
  if (file.empty() || file == "-" || file == "standard input") return "FILE";
  if (file.front() == '-') return file_word("./" + file);  // no option
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./:%+,=@";
  if (file.find_first_not_of(kPlain) == std::string::npos) return file;
  std::string quoted = "'";
  for (const char c : file) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string new_file(const std::string& extension) {
  std::string name = "NEW" + extension;
  std::error_code error;
  for (int k = 2; std::filesystem::exists(name, error); ++k) name = fmt::format("NEW{}{}", k, extension);
  return name;
}

std::string translate_command(const std::string& options, const std::string& file) {
  return fmt::format("gdal_translate{}{} {} {}", options.empty() ? "" : " ", options, file_word(file),
                     new_file(".tif"));
}

std::string warp_command(const std::string& options, const std::string& file) {
  return fmt::format("gdalwarp{}{} -r bilinear -ot Float32 -dstnodata -9999 {} {}", options.empty() ? "" : " ", options,
                     file_word(file), new_file(".tif"));
}

std::string comment_out_command(const std::string& file, std::uint64_t lines) {
  return fmt::format("sed '1,{}s/^/#/' {} > {}", lines, file_word(file), new_file(".csv"));
}

std::string rasterize_command(const std::string& file) {
  return fmt::format("scarp simplify {} {} -e ERROR", file_word(file), new_file(".tif"));
}

std::string skip_command(std::size_t bytes, const std::string& file) {
  return fmt::format("tail -c +{} {} > {}", bytes + 1, file_word(file),
                     new_file(std::filesystem::path(file).extension().string()));
}

std::string utf8_command(const std::string& encoding, const std::string& file) {
  return fmt::format("iconv -f {} -t UTF-8 {} > {}", encoding, file_word(file),
                     new_file(std::filesystem::path(file).extension().string()));
}

}  // namespace scarp::io
