// scarp VERB [OPTIONS] …: picks the verb, prints its one sentence if it fails, and turns the error into an exit code.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <new>
#include <string>
#include <string_view>

#include "commands/generate_command.h"
#include "commands/info_command.h"
#include "commands/measure_command.h"
#include "commands/paper_command.h"
#include "commands/simplify_command.h"
#include "options/missing_value.h"
#include "scarp/version.h"
#include "terminal/signals.h"
#include "terminal/text.h"

namespace {

using namespace scarp::cli;
using scarp::Error;
using scarp::ErrorKind;

std::string join_command_line(int argc, char** argv) {
  std::string line = "scarp";
  for (int k = 1; k < argc; ++k) line += " " + shell_word(argv[k]);
  return line;
}

/// The verb's help, or the program's, without CLI11's runs of empty lines.
std::string help_text(const CLI::App& program) {
  const CLI::App* chosen = &program;
  for (const CLI::App* verb : program.get_subcommands()) chosen = verb;
  std::string text;
  for (const char c : chosen->help(chosen == &program ? "" : program.get_name())) {
    const bool third = c == '\n' && text.size() >= 2 && text.compare(text.size() - 2, 2, "\n\n") == 0;
    if (!third) text += c;
  }
  return text;
}

/// CLI11's complaint about the number of values, in words.
std::string describe_mismatch(const std::string& message) {
  const std::string option = message.substr(0, message.find(':'));
  const bool is_missing = message.find("missing") != std::string::npos;
  return option + (is_missing ? " needs a value" : " is given more than once");
}

/// "simplify, measure or info": the verbs in their order.
std::string list_verbs(const CLI::App& program) {
  std::string text;
  const auto verbs = program.get_subcommands([](const CLI::App*) { return true; });
  for (std::size_t k = 0; k < verbs.size(); ++k)
    text += (k == 0 ? "" : k + 1 == verbs.size() ? " or " : ", ") + verbs[k]->get_name();
  return text;
}

Error end_usage(const std::string& sentence, const std::string& verb) {
  return {ErrorKind::kUsage, fmt::format("{}; see scarp{} --help", sentence, verb)};
}

/// What CLI11 objects to, as one sentence that ends with where to read more.
Error describe(const CLI::ParseError& error, const CLI::App& program) {
  std::string verb, sentence;
  for (const CLI::App* chosen : program.get_subcommands()) verb = " " + chosen->get_name();
  const std::vector<std::string> unknown = program.remaining(true);
  if (verb.empty() && !unknown.empty() && unknown.front().rfind('-', 0) != 0) {
    sentence = fmt::format("there is no verb {}: choose {}", shell_word(unknown.front()), list_verbs(program));
  } else if (verb.empty() && unknown.empty()) {
    sentence = "no verb is given: choose " + list_verbs(program);
  } else if (!unknown.empty()) {
    const bool is_option = unknown.front().rfind('-', 0) == 0;
    sentence = fmt::format("{} {} is unknown", is_option ? "option" : "argument", shell_word(unknown.front()));
  } else if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::ArgumentMismatch)) {
    sentence = describe_mismatch(error.what());
  } else {
    sentence = error.what();
  }
  return end_usage(sentence, verb);
}

/// Prints the error, if there is one, and returns the exit code.
int report_end(const scarp::Result<void>& result) {
  if (result) return 0;
  const bool cancelled = result.error().kind == ErrorKind::kCancelled;
  print_error(cancelled ? Error{ErrorKind::kCancelled, "interrupted; nothing was written"} : result.error());
  return exit_code(result.error().kind);
}

int run_program(int argc, char** argv) {
  CLI::App program("Height fields to triangle meshes with a proven error bound.", "scarp");
  program.set_version_flag("--version", fmt::format("scarp {}", scarp::version()), "Print the version");
  program.set_help_flag("-h,--help", "Print this help");
  program.get_formatter()->column_width(34);
  program.get_formatter()->label("SUBCOMMAND", "VERB");
  program.get_formatter()->label("REQUIRED", "");
  program.footer(
      "Try:\n"
      "  scarp info dem.tif                                what is in it, and which errors suit it\n"
      "  scarp simplify dem.tif hills.glb -e 1             a mesh within 1 m of every sample\n"
      "  scarp measure dem.tif hills.glb --fail-above 1    check it independently\n"
      "'scarp VERB --help' lists a verb's options.");
  program.require_subcommand(1);
  SimplifyCommand simplify(program);
  MeasureCommand measure(program);
  InfoCommand info(program);
  GenerateCommand generate(program);
  PaperCommand paper(program);
  for (CLI::App* verb : program.get_subcommands(nullptr)) {
    verb->group("Verbs");
    verb->set_version_flag("--version", fmt::format("scarp {}", scarp::version()), "Print the version");
  }

  if (const auto complaint = find_missing_value(program, argc, argv))
    return report_end(tl::unexpected(end_usage(*complaint, std::string(" ") + argv[1])));
  try {
    program.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return report_end(print_to_stdout(help_text(program)));
  } catch (const CLI::CallForVersion& version) {
    return report_end(print_to_stdout(std::string(version.what()) + "\n"));
  } catch (const CLI::ParseError& error) {
    return report_end(tl::unexpected(describe(error, program)));
  }

  const std::string command_line = join_command_line(argc, argv);
  return report_end(simplify.is_chosen()   ? simplify.run(command_line)
                    : measure.is_chosen()  ? measure.run(command_line)
                    : info.is_chosen()     ? info.run(command_line)
                    : generate.is_chosen() ? generate.run()
                                           : paper.run());
}

/// A standard stream that the caller has closed would lend its number to the next file that is opened, which messages
/// would then be written into. /dev/null, opened for reading, takes its place: writing to it fails as it should.
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
    print_to_stderr("scarp: not enough memory for this run\n");  // without asking for more of it
    return exit_code(ErrorKind::kInput);
  } catch (const std::exception& error) {
    print_error({ErrorKind::kInternal, fmt::format("internal error: {}; please report it", error.what())});
  } catch (...) {
    print_error({ErrorKind::kInternal, "internal error: an unknown exception; please report it"});
  }
  return exit_code(ErrorKind::kInternal);
}
