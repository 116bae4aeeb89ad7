// Declares the subcommands of `ogc`. Each has a file commands/NAME.cpp, which declares its options and stores its exit
// status in the context.
#pragma once

#include <CLI/CLI.hpp>

namespace ogc::experiments {

/// Exit statuses of `ogc`.
enum ExitStatus : int { exit_success = 0, exit_check_failed = 1, exit_bad_input = 2, exit_out_of_resource = 3 };

/// Holds the state that all subcommands share.
struct CommandContext {
  bool json = false;          ///< machine-readable result on standard output
  int status = exit_success;  ///< exit status of the program; a command sets it, main maps exceptions to it
  std::string command_line;   ///< as typed, for run.json
};

/// Each of these functions adds one subcommand of `ogc` (experiments/program/commands/).
void add_scenes_command(CLI::App& app, CommandContext& context);
void add_run_command(CLI::App& app, CommandContext& context);
void add_ablate_command(CLI::App& app, CommandContext& context);
void add_contacts_command(CLI::App& app, CommandContext& context);
void add_suggest_command(CLI::App& app, CommandContext& context);
void add_audit_command(CLI::App& app, CommandContext& context);
void add_laws_command(CLI::App& app, CommandContext& context);
void add_compare_command(CLI::App& app, CommandContext& context);
void add_bench_command(CLI::App& app, CommandContext& context);
void add_export_command(CLI::App& app, CommandContext& context);
void add_view_command(CLI::App& app, CommandContext& context);
void add_illustrate_command(CLI::App& app, CommandContext& context);

}  // namespace ogc::experiments
