#include "experiments/program/entry.hpp"

#include <csignal>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <new>

#include "compare/contestant.hpp"
#include "compare/files/bytes.hpp"
#include "compare/problem/error.hpp"
#include "compare/problem/text.hpp"
#include "experiments/program/output.hpp"
#include "experiments/program/version.hpp"

namespace ogc::experiments {

namespace {

std::string command_line(int count, char** words) {
  std::string text;
  for (int i = 0; i < count; ++i) text += (i == 0 ? "" : " ") + std::string(words[i]);
  return text;
}

void add_json_flags(CLI::App& app, CommandContext& context) {
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; }))
    if (command->get_option_no_throw("--json") == nullptr)
      command->add_flag("--json", context.json, "Print the result as JSON on standard output");
}

/// Makes the program parse its command line and run nothing, as the environment variable OGC_PARSE_ONLY requests. Tests
/// use it to check the commands in documents. The program ends before the callbacks of commands run. It ends inside the
/// parser, because these callbacks own the variables for the options.
void run_nothing(CLI::App& app) {
  log_line(app.get_name() + ": OGC_PARSE_ONLY is set: the command line is parsed, and nothing is run");
  app.parse_complete_callback([] { throw CLI::Success(); });
}

int usage_error(const CLI::App& app, const CLI::ParseError& error) {
  std::string command;
  for (const CLI::App* used : app.get_subcommands()) command = " " + used->get_name();
  constexpr std::size_t most_shown = 400;  // the message may repeat a word of any length
  log_line(app.get_name() + ": " + compare::shown(error.what(), most_shown) + "; see " + app.get_name() + command +
           " --help");
  return exit_bad_input;
}

int parse_and_run(int count, char** words, const Program& program) {
  CommandContext context;
  context.command_line = command_line(count, words);
  CLI::App app(program.description, program.name);
  app.footer(program.footer);
  app.set_version_flag(
      "--version", [] { return version_text(); }, "Version, commit, compiler, CUDA and backends");
  app.require_subcommand(1);
  program.add_commands(app, context);
  add_json_flags(app, context);
  if (std::getenv("OGC_PARSE_ONLY") != nullptr) run_nothing(app);
  try {
    app.parse(count, words);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    return usage_error(app, error);
  }
  return context.status;
}

int failure(const std::string& program, const std::string& what, int status) {
  log_line(program + ": " + what);
  return status;
}

/// Reports a path that the system refuses.
int path_failure(const std::string& program, const std::filesystem::filesystem_error& error) {
  try {
    compare::refuse_path(error.path1(), "use the path", error.code());
  } catch (const compare::InputError& refused) {
    return failure(program, refused.what(), exit_bad_input);
  } catch (const compare::ResourceError& refused) {
    return failure(program, refused.what(), exit_out_of_resource);
  }
}

}  // namespace

int run_program(int count, char** words, const Program& program) {
  // A limit on file sizes is reported like a full disk instead of killing the program.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return parse_and_run(count, words, program);
  } catch (const compare::InputError& error) {
    return failure(program.name, error.what(), exit_bad_input);
  } catch (const compare::ResourceError& error) {
    return failure(program.name, error.what(), exit_out_of_resource);
  } catch (const compare::ContestantFailure& failed) {
    return failure(program.name, "the plug-in can't be judged: " + std::string(failed.what()), exit_check_failed);
  } catch (const std::filesystem::filesystem_error& error) {
    return path_failure(program.name, error);
  } catch (const std::bad_alloc&) {
    return failure(program.name, "out of memory; take a smaller scale or mesh", exit_out_of_resource);
  } catch (const std::exception& error) {
    return failure(program.name, "internal error, please report it: " + std::string(error.what()), exit_check_failed);
  }
}

}  // namespace ogc::experiments
