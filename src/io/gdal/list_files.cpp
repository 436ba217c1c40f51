// The files that make up an input.
#include <cpl_conv.h>
#include <cpl_string.h>

#include <set>

#include "io/gdal/open.h"
#include "scarp/io.h"

namespace scarp::gdal {
namespace {

bool is_there(const std::string& vsi) {
  VSIStatBufL status{};
  return VSIStatL(vsi.c_str(), &status) == 0;
}

/// Adds the file on disk in a name like /vsizip/tiles.zip/a.tif, /vsitar/{a b.tar}/a.tif or /vsisubfile/0_99,a.tif. In
/// every such syntax, the file's path ends where a component of the name ends.
void add_container(const std::string& name, std::set<std::string>& seen) {
  if (name.rfind("/vsi", 0) != 0 || is_remote(name)) return;
  constexpr const char* kBeginnings = "/{,=";
  constexpr const char* kEnds = "/}?&";
  for (std::size_t begin = name.find_first_of(kBeginnings, 1); begin != std::string::npos;
       begin = name.find_first_of(kBeginnings, begin + 1)) {
    for (std::size_t end = begin + 1; end != std::string::npos && end < name.size();) {
      end = name.find_first_of(kEnds, end + 1);
      const std::string file = name.substr(begin + 1, end == std::string::npos ? end : end - begin - 1);
      VSIStatBufL status{};
      const bool is_on_disk = !file.empty() && file.rfind("/vsi", 0) != 0;
      if (is_on_disk && VSIStatL(file.c_str(), &status) == 0 && VSI_ISREG(status.st_mode)) seen.insert(file);
    }
  }
}

void add_files(const std::string& path, std::set<std::string>& seen);

/// Adds the file in names like FILE:LAYER, DRIVER:FILE and DRIVER:FILE:LAYER.
void add_between_colons(const std::string& name, std::set<std::string>& seen) {
  for (std::size_t begin = 0; begin != std::string::npos && begin < name.size();) {
    for (std::size_t end = begin; end != std::string::npos;) {
      end = name.find(':', end + 1);
      const std::string file = name.substr(begin, end == std::string::npos ? end : end - begin);
      if (file.size() < name.size() && !file.empty() && is_there(file)) add_files(file, seen);
    }
    const std::size_t colon = name.find(':', begin);
    begin = colon == std::string::npos ? colon : colon + 1;
  }
}

void add_files(const std::string& path, std::set<std::string>& seen) {
  const std::string vsi = vsi_path(path);
  if (is_remote(path) || path == "-" || declares_entities(vsi)) return;
  add_container(vsi, seen);
  VSIStatBufL status{};
  const bool exists = VSIStatL(vsi.c_str(), &status) == 0;
  if (exists && VSI_ISDIR(status.st_mode)) {
    const CPLStringList entries(VSIReadDir(vsi.c_str()));
    for (int k = 0; k < entries.size(); ++k) seen.insert(CPLFormFilename(vsi.c_str(), entries[k], nullptr));
  } else if (exists && !VSI_ISREG(status.st_mode)) {
    return;
  } else if (!exists) {
    add_between_colons(vsi, seen);
  }
  if (exists) seen.insert(vsi);  // also files that no driver opens, such as a script
  const Dataset dataset(
      GDALOpenEx(vsi.c_str(), GDAL_OF_RASTER | GDAL_OF_VECTOR | GDAL_OF_READONLY, nullptr, kOpenOptions, nullptr));
  if (!dataset) return;
  char** files = GDALGetFileList(dataset.get());
  for (char** file = files; file != nullptr && *file != nullptr; ++file) {
    // GDAL lists the sources of a VRT, but not the sources of those sources.
    add_container(*file, seen);
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
