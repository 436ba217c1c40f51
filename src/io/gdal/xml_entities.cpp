// Detection of XML that would expand while it is read.
#include <cpl_vsi.h>

#include <array>
#include <cctype>
#include <memory>
#include <string_view>

#include "io/gdal/open.h"

namespace scarp::gdal {
namespace {

/// No GIS writes this many bytes before the root element.
constexpr std::size_t kLongestProlog = std::size_t{1} << 20;

struct CloseFile {
  void operator()(VSILFILE* file) const { VSIFCloseL(file); }
};

/// The first characters, without the zeros of UTF-16 and UTF-32, and without non-ASCII bytes at the start.
std::string read_start(const std::string& vsi, std::size_t most) {
  VSIStatBufL status{};
  if (VSIStatL(vsi.c_str(), &status) != 0 || !VSI_ISREG(status.st_mode)) return "";
  const std::unique_ptr<VSILFILE, CloseFile> file(VSIFOpenL(vsi.c_str(), "rb"));
  if (!file) return "";
  std::string text;
  std::array<char, 4096> chunk{};
  while (text.size() < most) {
    const std::size_t got = VSIFReadL(chunk.data(), 1, chunk.size(), file.get());
    if (got == 0) break;
    for (const char c : std::string_view(chunk.data(), got)) {
      const bool is_mark = text.empty() && (static_cast<unsigned char>(c) >= 0x80 || std::isspace(c) != 0);
      if (c != '\0' && !is_mark) text += c;
    }
    if (!text.empty() && text.front() != '<') break;
  }
  return text;
}

}  // namespace

bool declares_entities(const std::string& vsi) {
  const std::string text = read_start(vsi, kLongestProlog);
  std::string_view rest = text;
  const auto skip_to = [&](std::string_view end) {
    const std::size_t at = rest.find(end);
    rest.remove_prefix(at == std::string_view::npos ? rest.size() : at + end.size());
  };
  if (!rest.starts_with('<')) return false;
  while (!rest.empty()) {
    if (rest.starts_with("<?")) {
      skip_to("?>");
    } else if (rest.starts_with("<!--")) {
      skip_to("-->");
    } else if (rest.starts_with("<!DOCTYPE")) {
      return rest.find("<!ENTITY") != std::string_view::npos;
    } else if (rest.starts_with('<')) {
      return false;
    } else {
      rest.remove_prefix(std::min(rest.size(), rest.find('<')));
    }
  }
  return text.size() >= kLongestProlog;
}

}  // namespace scarp::gdal
