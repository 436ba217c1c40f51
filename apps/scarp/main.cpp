// scarp COMMAND [OPTIONS] …: runs the command; prints a failure as one sentence and returns its exit code.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <vector>

#include "commands/commands.h"
#include "scarp/version.h"
#include "session/table/help.h"
#include "session/table/missing_value.h"
#include "session/table/option_table.h"
#include "session/table/unknown_words.h"
#include "session/text/text.h"
#include "terminal/signals.h"

namespace {

using namespace scarp::cli;
using scarp::Error;
using scarp::ErrorKind;
using scarp::Result;

std::string join_command_line(int argc, char** argv) {
  std::string line = "scarp";
  for (int k = 1; k < argc; ++k) line += " " + shell_word(argv[k]);
  return line;
}

/// The help of the chosen command, or that of the program.
std::string help_text(const CLI::App& program, bool all) {
  check_table(program);
  const CommandRow* chosen = nullptr;
  for (const CLI::App* command : program.get_subcommands()) chosen = find_command(command->get_name());
  return chosen != nullptr ? command_help(*chosen, all) : program_help();
}

/// CLI11's error about the number of values, in words.
std::string describe_mismatch(const std::string& message) {
  const std::string option = message.substr(0, message.find(':'));
  const bool is_missing = message.find("missing") != std::string::npos || message.find("At least") != std::string::npos;
  if (!is_missing) return option + " is given more than once";
  const std::size_t end = message.find(" required"), begin = message.rfind(' ', end - 1) + 1;
  const std::string count = message.substr(begin, end - begin);
  return option + (count == "1" ? " needs a value" : fmt::format(" needs {} values", count));
}

Error end_usage(const std::string& sentence, const std::string& command) {
  return {ErrorKind::kUsage, fmt::format("{}; see scarp{} --help", sentence, command)};
}

/// CLI11's error as one sentence that ends with a reference to the help.
Error describe(const CLI::ParseError& error, const CLI::App& program) {
  if (error.get_name() == "ValidationError") return {ErrorKind::kUsage, error.what()};  // from the table's rules
  std::string command, sentence;
  const CLI::App* chosen = nullptr;
  for (const CLI::App* candidate : program.get_subcommands()) chosen = candidate;
  if (chosen != nullptr) command = " " + chosen->get_name();
  const std::vector<std::string> unknown = program.remaining(true);
  if (command.empty() && !unknown.empty() && unknown.front().rfind('-', 0) != 0) {
    return unknown_command(unknown.front());
  } else if (command.empty() && unknown.empty()) {
    sentence = "no command given: " + choose_command();
  } else if (!unknown.empty()) {
    const bool is_option = unknown.front().rfind('-', 0) == 0;
    sentence = is_option ? describe_unknown_option(chosen, unknown.front())
                         : fmt::format("argument {} is unknown", shell_word(unknown.front()));
  } else if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ArgumentMismatch)) {
    sentence = describe_mismatch(error.what());
  } else {
    sentence = error.what();
  }
  return end_usage(sentence, command);
}

/// Prints the error, if any, and returns the exit code.
int report_end(const scarp::Result<void>& result) {
  keep_interrupts_quiet();
  if (result) return 0;
  const bool cancelled = result.error().kind == ErrorKind::kCancelled;
  print_error(cancelled ? Error{ErrorKind::kCancelled, "interrupted; nothing was written"} : result.error());
  return exit_code(result.error().kind);
}

/// Joins "tile plan" to tile-plan.
std::vector<std::string> join_command(int argc, char** argv) {
  std::vector<std::string> words(argv, argv + argc);
  if (argc < 3 || words[1] != "tile" || find_command("tile-" + words[2]) == nullptr) return words;
  words[1] = "tile-" + words[2];
  words.erase(words.begin() + 2);
  return words;
}

struct RunnableCommand {
  Commands command;
  Result<void> (*run)(const GivenOptions& given, const std::string& command_line);
};

constexpr RunnableCommand kRunners[] = {{kSimplify, run_simplify},
                                        {kClassic, run_simplify},
                                        {kMeasure, run_measure},
                                        {kView, run_view},
                                        {kTile, run_tile},
                                        {kTilePlan, run_tile_plan},
                                        {kTileRun, run_tile_run},
                                        {kTileFinish, run_tile_finish},
                                        {kTileCheck, run_tile_check},
                                        {kServe, run_serve},
                                        {kInfo, run_info},
                                        {kGenerate, run_generate},
                                        {kHelpCommand, run_help},
                                        {kVersionCommand, run_version}};

int run_program(int count, char** words) {
  std::vector<std::string> joined = join_command(count, words);
  std::vector<char*> arguments;
  for (std::string& word : joined) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  char** const argv = arguments.data();
  const int argc = static_cast<int>(joined.size());
  CLI::App program("", "scarp");
  program.set_version_flag("--version", fmt::format("scarp {}", scarp::version()));
  program.set_help_flag("-h,--help");
  program.set_help_all_flag("--help-all");
  program.require_subcommand(1);
  std::vector<std::unique_ptr<GivenOptions>> options;
  std::vector<const CLI::App*> commands;
  for (const RunnableCommand& runner : kRunners) {
    options.push_back(std::make_unique<GivenOptions>(runner.command));
    commands.push_back(options.back()->add_to(program));
  }

  if (const auto complaint = find_foreign_option(program, argc, argv))
    return report_end(tl::unexpected(end_usage(*complaint, std::string(" ") + argv[1])));
  if (const auto complaint = find_missing_value(program, argc, argv))
    return report_end(tl::unexpected(end_usage(*complaint, std::string(" ") + argv[1])));
  try {
    program.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return report_end(print_to_stdout(help_text(program, false)));
  } catch (const CLI::CallForAllHelp&) {
    return report_end(print_to_stdout(help_text(program, true)));
  } catch (const CLI::CallForVersion& version) {
    return report_end(print_to_stdout(std::string(version.what()) + "\n"));
  } catch (const CLI::ParseError& error) {
    return report_end(tl::unexpected(describe(error, program)));
  }

  const std::string command_line = join_command_line(count, words);
  const std::size_t chosen = static_cast<std::size_t>(
      std::find_if(commands.begin(), commands.end(), [](const CLI::App* command) { return command->parsed(); }) -
      commands.begin());
  return report_end(kRunners[chosen].run(*options[chosen], command_line));
}

/// Opens /dev/null read-only for each standard stream that the caller has closed. Otherwise the next opened file would
/// have the stream's number and receive messages. Writing to /dev/null then fails, as it should.
void occupy_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) == -1 && open("/dev/null", O_RDONLY) != stream) return;
  }
}

}  // namespace

int main(int argc, char** argv) {
  occupy_closed_streams();
  install_signal_handlers();
  try {
    return run_program(argc, argv);
  } catch (const std::bad_alloc&) {
    print_to_stderr("scarp: not enough memory for this run\n");  // must not allocate
    return exit_code(ErrorKind::kInput);
  } catch (const std::exception& error) {
    print_error({ErrorKind::kInternal, fmt::format("internal error: {}; please report it", error.what())});
  } catch (...) {
    print_error({ErrorKind::kInternal, "internal error: an unknown exception; please report it"});
  }
  return exit_code(ErrorKind::kInternal);
}
