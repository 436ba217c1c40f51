#include "session/options/companion_options.h"

#include <fmt/format.h>

#include <utility>

#include "session/table/option_table.h"
#include "session/text/text.h"

namespace scarp::cli {

void CompanionArguments::add_to(CLI::App& command) {
  add_option(command, OptionId::kMask, mask);
  add_option(command, OptionId::kTolerance, tolerance);
  add_option(command, OptionId::kRoi, roi);
  add_option(command, OptionId::kFalloff, falloff);
  add_option(command, OptionId::kScript, script);
}

const char* CompanionArguments::find_tolerance() const {
  if (tolerance) return "--tolerance";
  return roi.empty() ? nullptr : "--roi";
}

Result<RegionFile> parse_region(const std::string& text) {
  const std::size_t at = text.rfind('=');
  if (at == std::string::npos || at == 0)
    return fail(ErrorKind::kUsage,
                fmt::format("--roi {}: behind the file an error is missing, such as {}=0.2", shell_word(text), text));
  SCARP_TRY(const double tolerance,
            parse_non_negative(fmt::format("--roi {}: the error", shell_word(text)), text.substr(at + 1)));
  return RegionFile{text.substr(0, at), tolerance};
}

Result<void> CompanionArguments::check(const char* bound_option, bool has_bound) const {
  for (const std::string& text : roi) {
    SCARP_RETURN_IF_ERROR(parse_region(text));
  }
  if (mask && !roi.empty())
    return fail(ErrorKind::kUsage, "--mask cannot be combined with --roi: regions have errors, not weights");
  if (falloff) {
    SCARP_RETURN_IF_ERROR(parse_non_negative("--falloff", *falloff));
    if (roi.empty())
      return fail(ErrorKind::kUsage, "--falloff needs --roi: there is no region that it could be around");
    if (!has_bound)
      return fail(ErrorKind::kUsage,
                  fmt::format("--falloff needs {}: the bound of a region grows to that", bound_option));
  }
  if (mask && tolerance) {
    return fail(ErrorKind::kUsage,
                "--mask cannot be combined with --tolerance: divide the bound by the weights into one tolerance");
  }
  return {};
}

std::string CompanionArguments::canonical() const {
  std::string command;
  const std::pair<const char*, const Given*> options[] = {
      {"--mask", &mask}, {"--tolerance", &tolerance}, {"--script", &script}};
  for (const auto& [name, file] : options) {
    if (*file) command += canonical_option(name, base_name(**file));
  }
  for (const std::string& text : roi) command += " --roi " + shell_word(base_name(text));
  return command + canonical_option("--falloff", falloff);
}

}  // namespace scarp::cli
