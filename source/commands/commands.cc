// SPDX-License-Identifier: LGPL-2.1-or-later

// The table of all commands.

#include <deal.II/base/exceptions.h>

#include <slipstep/commands/commands.h>
#include <slipstep/friction/law.h>
#include <slipstep/utilities/process.h>
#include <slipstep/utilities/progress.h>
#include <slipstep/utilities/text.h>
#include <slipstep/utilities/write_file.h>

#include <sys/prctl.h>

#include <cerrno>
#include <csignal>
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
        names.push_back(lower_case(name.string()));
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



    Outcome
    start(const int argc, char **argv, const std::filesystem::path &file)
    {
      CommandLine   line;
      const Outcome parsed = guarded([&]() {
        line = parse_command_line(argc, argv);
        return done;
      });
      if (parsed.exit_code != done)
        return parsed;
      line.program = file;

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
  } // namespace



  int program(const int argc, char **argv, const std::filesystem::path &file)
  {
    open_closed_descriptors();
    // A file that grows too large is a failed write, reported as such.
    std::signal(SIGXFSZ, SIG_IGN);
    // A wish for a checkpoint does no harm where there is none; children
    // inherit this until they can listen.
    std::signal(SIGUSR1, SIG_IGN);
    dealii::deal_II_exceptions::disable_abort_on_exception();
    dealii::deal_II_exceptions::suppress_stacktrace_in_exceptions();
    Outcome outcome = start(argc, argv, file);
    errno           = 0;
    if (!std::cout.flush() && outcome.exit_code == done)
      {
        // Why an earlier write failed a new one tells.
        if (errno == 0)
          {
            std::cout.clear();
            std::cout << std::endl;
          }
        outcome = {run_failed, write_failure("the output").what()};
      }
    // Under mpirun every rank finds the same errors in the input.
    if (!outcome.message.empty() && launched_rank() == 0)
      std::cerr << outcome.message << std::endl;
    SignalGuard::obey();
    return outcome.exit_code;
  }
} // namespace SlipStep
