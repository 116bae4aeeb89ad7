// What the programs `ogc` and `ogc-judge` share. Every failure becomes one message with a remedy, and one of four exit
// statuses.
#pragma once

#include <string>

#include "experiments/program/commands.hpp"

namespace ogc::experiments {

/// Describes a program to its users.
struct Program {
  std::string name, description, footer;                   ///< of the help; the footer follows the commands
  void (*add_commands)(CLI::App&, CommandContext&) = {};  ///< adds the subcommands
};

/// Runs the command that the words name and returns the exit status. Throws nothing: a failure is a line on standard
/// error.
int run_program(int count, char** words, const Program& program);

}  // namespace ogc::experiments
