// Which files a file is made of.
#include <cpl_conv.h>
#include <cpl_string.h>

#include <set>

#include "io/gdal/open.h"
#include "scarp/io.h"

namespace scarp::gdal {
namespace {

void add_files(const std::string& path, std::set<std::string>& seen) {
  const std::string vsi = vsi_path(path);
  if (is_remote(path) || path == "-" || declares_entities(vsi)) return;
  VSIStatBufL status{};
  const bool exists = VSIStatL(vsi.c_str(), &status) == 0;
  if (exists && VSI_ISDIR(status.st_mode)) {
    const CPLStringList entries(VSIReadDir(vsi.c_str()));
    for (int k = 0; k < entries.size(); ++k) seen.insert(CPLFormFilename(vsi.c_str(), entries[k], nullptr));
  } else if (exists && !VSI_ISREG(status.st_mode)) {
    return;
  }
  const Dataset dataset(
      GDALOpenEx(vsi.c_str(), GDAL_OF_RASTER | GDAL_OF_VECTOR | GDAL_OF_READONLY, nullptr, kOpenOptions, nullptr));
  if (!dataset) return;
  char** files = GDALGetFileList(dataset.get());
  for (char** file = files; file != nullptr && *file != nullptr; ++file) {
    // GDAL names the sources of a VRT, but not the sources of these.
    if (seen.insert(*file).second && EQUAL(CPLGetExtension(*file), "vrt")) add_files(*file, seen);
  }
  CSLDestroy(files);
}

}  // namespace
}  // namespace scarp::gdal

namespace scarp {

std::vector<std::string> list_files(const std::string& path) {
  gdal::Session session;
  std::set<std::string> seen;
  gdal::add_files(path, seen);
  return {seen.begin(), seen.end()};
}

}  // namespace scarp
