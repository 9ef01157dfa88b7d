// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_utilities_command_line_h
#define slipstep_utilities_command_line_h

#include <filesystem>
#include <map>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

namespace SlipStep
{
  /// What the user typed.
  struct CommandLine
  {
    /// The program that children are started from.
    std::filesystem::path              program;
    std::string                        command;
    std::vector<std::filesystem::path> files;
    /// Pairs (path of a parameter, value) of the options --set.
    std::vector<std::pair<std::string, std::string>> settings;
    /// The options --set as typed, to be handed to a child.
    std::vector<std::string> settings_as_typed;
    /// Keys to be swept with their values, and the same as typed.
    std::vector<std::pair<std::string, std::vector<std::string>>> sweeps;
    std::vector<std::string> sweeps_as_typed;
    /// The file for a job array of the sweep, "" for none.
    std::string slurm;
    std::string output; ///< "" = not given
    std::string format; ///< "" = the command's default
    std::string variant;
    /// The folder of one run of all that the line says, for those that the
    /// program starts itself; "" for all of them.
    std::string member;
    /// Options of slipstep plant, by name; "" for those without a value.
    std::map<std::string, std::string> plant_options;
    bool                               quiet = false;
    /// Go on where an earlier run was stopped.
    bool resume = false;
    /// Started by the sweep of a parent, which does the reporting.
    bool is_child = false;
    /// Print the help of the command ("" = of the program), do nothing else.
    bool help    = false;
    bool version = false;
  };

  /// @throws InputError for an unknown command or option (naming the nearest),
  /// or a wrong number of files
  CommandLine parse_command_line(const int argc, char **argv);

  /// @param command "" for the program's help
  void print_help(std::ostream &out, const std::string &command);

  /// Tell the user on stderr, a line each.
  void print_warnings(const std::vector<std::string> &warnings);

  /// "slipstep 0.1.0 (1a2b3c4)".
  std::string version_text();
} // namespace SlipStep

#endif
