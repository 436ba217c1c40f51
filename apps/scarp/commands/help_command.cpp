#include "commands/help_command.h"

#include "session/table/help.h"
#include "session/table/option_table.h"
#include "session/table/unknown_words.h"
#include "session/text/text.h"

namespace scarp::cli {

HelpCommand::HelpCommand(CLI::App& program) : command_(add_command(program, kHelpCommand)) {
  add_option(*command_, OptionId::kCommand, about_);
  add_flag(*command_, OptionId::kAll, all_);
  add_flag(*command_, OptionId::kJson, json_);
}

Result<void> HelpCommand::run() const {
  const CommandRow* const about = about_ ? find_command(*about_) : nullptr;
  if (about_ && about == nullptr) return tl::unexpected(unknown_command(*about_));
  if (json_) return print_to_stdout(help_json(about));
  return print_to_stdout(about != nullptr ? command_help(*about, all_) : program_help());
}

}  // namespace scarp::cli
