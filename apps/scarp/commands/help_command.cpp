#include <fmt/format.h>

#include "commands/commands.h"
#include "scarp/version.h"
#include "session/table/help.h"
#include "session/table/option_table.h"
#include "session/table/unknown_words.h"
#include "session/text/text.h"

namespace scarp::cli {
namespace {
using enum OptionId;
}

Result<void> run_help(const GivenOptions& given, const std::string&) {
  const CommandRow* const about = given[kCommand] ? find_command(*given[kCommand]) : nullptr;
  if (given[kCommand] && about == nullptr) return tl::unexpected(unknown_command(*given[kCommand]));
  if (given.has(kJson)) return print_to_stdout(help_json(about));
  return print_to_stdout(about != nullptr ? command_help(*about, given.has(kAll)) : program_help());
}

Result<void> run_version(const GivenOptions&, const std::string&) {
  return print_to_stdout(fmt::format("scarp {}\n", version()));
}

}  // namespace scarp::cli
