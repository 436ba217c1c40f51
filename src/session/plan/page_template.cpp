#include "session/plan/page_template.h"

#include <fmt/format.h>

#include <filesystem>
#include <system_error>

#include "scarp/io.h"

namespace scarp::cli {

Result<std::string> read_page_template() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::string path = (program.parent_path().parent_path() / "share" / "scarp" / "viewer.html").string();
  const auto bytes = read_file(path);
  if (!bytes) {
    return fail(ErrorKind::kInput,
                fmt::format("the viewer's page {} is not there: 'make viewer' in Scarp's sources builds it", path));
  }
  std::string page(bytes->begin(), bytes->end());
  if (page.find(kPlaceOfData) == std::string::npos)
    return fail(ErrorKind::kInput, fmt::format("{} has no place for a mesh: 'make viewer' builds it anew", path));
  return page;
}

}  // namespace scarp::cli
