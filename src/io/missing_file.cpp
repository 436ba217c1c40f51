#include "io/missing_file.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <system_error>
#include <vector>

#include "base/alike.h"

namespace scarp::io {
namespace {

namespace fs = std::filesystem;

std::string stem_of(const std::string& name) { return fs::path(name).stem().string(); }

}  // namespace

std::string describe_missing(const std::string& path) {
  const std::string sentence = "no such file";
  const fs::path folder = fs::path(path).parent_path();
  const std::string name = fs::path(path).filename().string();
  constexpr int kMost = 10000;  // names examined
  std::vector<std::string> names, alike;
  std::error_code error;
  int count = 0;
  for (fs::directory_iterator entry(folder.empty() ? "." : folder, error), end; !error && entry != end && count < kMost;
       entry.increment(error), ++count)
    names.push_back(entry->path().filename().string());
  std::sort(names.begin(), names.end());
  std::copy_if(names.begin(), names.end(), std::back_inserter(alike),
               [&](const std::string& other) { return stem_of(other) == stem_of(name); });
  if (alike.empty()) alike = find_alike(name, names);
  if (alike.empty()) return sentence;
  return sentence + ": " + ask_for(alike, folder.empty() ? "" : (folder / "").string());
}

}  // namespace scarp::io
