#include "session/plan/outputs.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <system_error>

#include "scarp/io.h"
#include "session/text/paths.h"

namespace scarp::cli {
namespace {

namespace fs = std::filesystem;

bool is_device(const fs::file_status& status) {
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

bool names_device(const std::string& path) {
  std::error_code error;
  return is_stdout(path) || is_device(fs::status(path, error));
}

/// Resolves symbolic links, including those to files that do not exist yet.
fs::path follow_links(fs::path path) {
  constexpr int kMostLinks = 40;
  std::error_code error;
  for (int k = 0; k < kMostLinks && fs::is_symlink(path, error); ++k) {
    const fs::path target = fs::read_symlink(path, error);
    if (error) break;
    path = path.parent_path() / target;  // an absolute target replaces the whole path
  }
  return path;
}

/// Equal for two names of one file, existing or not; empty if unknown.
std::string identity_of(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) == 0) return fmt::format("{} {}", status.st_dev, status.st_ino);
  std::error_code error;
  const fs::path full = fs::weakly_canonical(fs::absolute(follow_links(path), error), error);
  return error ? std::string() : full.string();
}

/// The identity of the file that an output replaces, also through standard output; empty for devices and pipes.
std::string identity_of_output(const std::string& path) {
  if (!is_stdout(path)) return names_device(path) ? "" : identity_of(path);
  struct stat status {};
  const bool is_file = fstat(STDOUT_FILENO, &status) == 0 && S_ISREG(status.st_mode);
  return is_file ? fmt::format("{} {}", status.st_dev, status.st_ino) : "";
}

/// The reason why no file can be made in an existing folder; empty if one can. Permissions do not show it for root, or
/// in /proc.
std::string find_obstacle(const fs::path& folder) {
  std::string name = (folder / ".scarp-XXXXXX").string();
  const int file = mkstemp(name.data());
  if (file < 0 && errno == ENOENT) return fmt::format("the folder {} takes no new files", folder.string());
  if (file < 0) return fmt::format("folder {}: {}", folder.string(), std::strerror(errno));
  close(file);
  unlink(name.c_str());
  return "";
}

Result<void> check_output(const PlannedOutput& output, bool overwrite) {
  if (output.path.empty()) return fail(ErrorKind::kUsage, fmt::format("the name of {} is empty", output.option));
  if (is_stdout(output.path)) return {};
  std::error_code error;
  const fs::file_status status = fs::status(output.path, error);
  if (fs::is_directory(status)) {
    return fail(ErrorKind::kOutput, fmt::format("{} {} is a folder: name a file in it", output.option, output.path));
  }
  if (is_device(status)) return {};
  if (fs::exists(status) && !overwrite) {
    return fail(ErrorKind::kOutput,
                fmt::format("{} exists already: {} replaces it", output.path, OptionId::kOverwrite));
  }
  if (fs::exists(status) && access(output.path.c_str(), W_OK) != 0) {
    return fail(ErrorKind::kOutput, fmt::format("{} cannot be replaced: {}", output.path, std::strerror(errno)));
  }
  fs::path target = output.path;
  if (fs::is_symlink(target, error)) target = fs::weakly_canonical(target, error);
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, error)) {
    return fail(ErrorKind::kOutput,
                fmt::format("{} cannot be written: there is no folder {}", output.path, folder.string()));
  }
  if (const std::string why = find_obstacle(folder); !why.empty()) {
    return fail(ErrorKind::kOutput, fmt::format("{} cannot be written: {}", output.path, why));
  }
  return {};
}

}  // namespace

Result<void> check_outputs(const std::vector<PlannedOutput>& outputs, const std::vector<std::string>& inputs,
                           bool overwrite) {
  const bool may_replace = std::any_of(outputs.begin(), outputs.end(), [&](const PlannedOutput& output) {
    std::error_code ignored;
    if (is_stdout(output.path)) return !identity_of_output(output.path).empty();
    return overwrite && !names_device(output.path) && fs::exists(output.path, ignored);
  });
  std::map<std::string, std::string> read;  // identity to input
  for (const std::string& input : inputs) {
    read.emplace(identity_of(input == "-" ? "/dev/stdin" : input), input);
    if (!may_replace) continue;
    for (const std::string& part : list_files(input)) read.emplace(identity_of(part), input);
  }
  std::map<std::string, std::string> written;  // identity to option
  const PlannedOutput* to_stdout = nullptr;
  for (const PlannedOutput& output : outputs) {
    if (is_stdout(output.path)) {
      if (to_stdout != nullptr) {
        return fail(ErrorKind::kUsage, fmt::format("{} and {} both write to standard output: name a file for one",
                                                   to_stdout->option, output.option));
      }
      to_stdout = &output;
    }
    const std::string identity = identity_of_output(output.path);
    if (!identity.empty()) {
      if (const auto found = read.find(identity); found != read.end()) {
        const bool is_whole = identity_of(found->second) == identity;
        return fail(ErrorKind::kUsage,
                    fmt::format("{} {} is {}: choose another name", output.option, output.path,
                                is_whole ? "an input file" : fmt::format("a file that {} is made of", found->second)));
      }
      const auto [earlier, is_first] = written.emplace(identity, output.option);
      if (!is_first) {
        return fail(ErrorKind::kUsage,
                    fmt::format("{} and {} name the same file, {}", earlier->second, output.option, output.path));
      }
    }
    SCARP_RETURN_IF_ERROR(check_output(output, overwrite));
  }
  return {};
}

Result<void> check_ending(const OptionRow& row, const PlannedOutput& output) {
  const std::vector<std::string> endings = row.list_choices();
  const bool is_image = endings.front() == ".png" || endings.front() == ".tif";
  if (!is_image || names_device(output.path) || std::ranges::count(endings, lower_extension(output.path)) > 0)
    return {};
  return fail(ErrorKind::kUsage,
              fmt::format("{} {} does not end in {}: it is written as {}", output.option, output.path, endings.front(),
                          endings.front() == ".png" ? "PNG" : "GeoTIFF"));
}

}  // namespace scarp::cli
