// SPDX-License-Identifier: LGPL-2.1-or-later

// The table of all commands.

#include <slipstep/commands/commands.h>
#include <slipstep/friction/law.h>
#include <slipstep/utilities/process.h>
#include <slipstep/utilities/progress.h>

#include <sys/prctl.h>

#include <functional>
#include <iostream>
#include <map>

namespace SlipStep
{
  namespace
  {
    int list_effects(const CommandLine &line)
    {
      std::vector<std::string> names;
      for (const auto &name : line.files)
        names.push_back(name.string());
      print_effects(std::cout, line.format == "md", names);
      return done;
    }



    using Command = std::function<Outcome(const CommandLine &)>;

    Command guarding(int (*command)(const CommandLine &))
    {
      return [command](const CommandLine &line) {
        return guarded([&]() { return command(line); });
      };
    }

    const std::map<std::string, Command> &commands()
    {
      static const std::map<std::string, Command> table = {
        {"run", run},
        {"point", run},
        {"check", check},
        {"compare", guarding(compare_results)},
        {"refine", guarding(refine_block)},
        {"calibrate", guarding(calibrate_case)},
        {"diagnose", guarding(diagnose_case)},
        {"import", guarding(import_tests)},
        {"export", guarding(export_law)},
        {"plant", guarding(plant)},
        {"effects", guarding(list_effects)},
        {"parameters", guarding(print_parameters)}};
      return table;
    }
  } // namespace



  Outcome start(const int argc, char **argv)
  {
    CommandLine   line;
    const Outcome parsed = guarded([&]() {
      line = parse_command_line(argc, argv);
      return done;
    });
    if (parsed.exit_code != done)
      return parsed;

    if (line.is_child)
      {
        // Children end with their parent, however it ends.
        prctl(PR_SET_PDEATHSIG, SIGTERM);
        Progress::report_often();
      }
    // No work for several processes.
    if (launched_rank() > 0 &&
        (line.version || line.help || line.command != "run"))
      return {};
    if (line.version)
      std::cout << version_text() << std::endl;
    else if (line.help)
      print_help(std::cout, line.command);
    else
      return commands().at(line.command)(line);
    return {};
  }
} // namespace SlipStep
