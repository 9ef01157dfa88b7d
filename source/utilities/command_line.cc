// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/utilities.h>

#include <slipstep/utilities/command_line.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/paths.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/nearest_name.h>
#include <slipstep/utilities/text.h>
#include <slipstep/utilities/version.h>

#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/predicate.hpp>
#include <boost/program_options.hpp>

#include <algorithm>
#include <iostream>
#include <limits>

namespace SlipStep
{
  namespace
  {
    namespace po = boost::program_options;

    struct Command
    {
      std::string              name;
      std::string              arguments;
      std::string              summary;
      std::string              details;
      unsigned int             least_files;
      unsigned int             most_files;
      std::string              options; // but --help and --version
      std::vector<std::string> formats; // the first is the default
    };



    constexpr unsigned int any = std::numeric_limits<int>::max();

    const std::vector<Command> commands = {
      {"run",
       "CASE.prm",
       "simulate the block with finite elements",
       "Runs the case, or all its variants side by side on the cores. On\n"
       "several processes: mpirun -np N slipstep run CASE.prm\n"
       "Checkpoints are written at times (Checkpoint/Every), on SIGUSR1, and\n"
       "when the run is stopped (SIGTERM, Ctrl-C); --resume goes on from\n"
       "there and keeps the variants that are finished.\n",
       1,
       1,
       "set sweep slurm output variant resume quiet",
       {}},
      {"point",
       "CASE.prm",
       "the same law and loading on one contact point",
       "Like run, but without block and mesh: a matter of seconds, and no\n"
       "checkpoints. --resume keeps the variants that are finished.\n",
       1,
       1,
       "set sweep slurm output variant resume quiet",
       {}},
      {"refine",
       "CASE.prm",
       "study the convergence with mesh and time step",
       "Runs the case on the meshes and with the time steps of its section\n"
       "\"Refinement study\", each in a process of its own, and compares the\n"
       "quantities of interest (Output/Quantities): tables on the screen,\n"
       "refinement.csv, refinement.json, and pictures of the error over\n"
       "unknowns and CPU time in report.html. Differences that are not above\n"
       "the reference's own uncertainty are not shown as errors, and an order\n"
       "takes four runs. A run that fails is reported; the others go on. Of a\n"
       "sweep, choose one member with --variant. --resume keeps the runs that\n"
       "are finished and goes on with the others.\n",
       1,
       1,
       "set output variant resume quiet",
       {}},
      {"compare",
       "RESULTS ...",
       "put results of several runs into one page",
       "RESULTS are folders that run or point wrote, of single runs or whole\n"
       "sweeps, and measured tests (.csv) to be drawn beside. The page has\n"
       "their curves and tables together, and the keys in which they differ.\n",
       1,
       any,
       "output quiet",
       {}},
      {"calibrate",
       "CASE.prm",
       "find parameters from measured tests",
       "Section \"Calibration\" of the case names the tests and the parameters\n"
       "with their bounds. Prints and reports (report.html, calibration.json)\n"
       "values with intervals, what the tests cannot tell, and how well each\n"
       "test is met; fitted.prm is the case with the values found. Of a sweep,\n"
       "choose one member with --variant.\n",
       1,
       1,
       "set output variant quiet",
       {}},
      {"diagnose",
       "CASE.prm",
       "find the effect that is missing in a case, and add it",
       "Calibrates the case with its measured tests (section \"Calibration\"),\n"
       "finds where simulation and tests disagree by more than replicates do,\n"
       "names the effect that is missing and adds it - or says that none is,\n"
       "that several would do, that no effect of the catalogue does, or that\n"
       "the tests could not show any - and shows the gap shrink, on the\n"
       "contact point and with finite elements (section \"Diagnosis\").\n"
       "Writes report.html, diagnosis.json and improved.prm.\n",
       1,
       1,
       "set output variant quiet",
       {}},
      {"import",
       "RAW | MAP.prm [RAW]",
       "convert files of instruments into measured tests",
       "RAW alone, as the instrument wrote it, is looked at: a map is written\n"
       "beside it (RAW_map.prm), every line with the reason why, and a page\n"
       "that shows what it makes of the record (output/RAW/import). MAP.prm\n"
       "says which column holds what in which unit, what is not in the file\n"
       "(area, pressure), and what its signs mean; \"slipstep parameters\n"
       "import\" prints all of its keys. RAW behind it is the file, or the\n"
       "folder of the files, that the map names. The tests, one per variant,\n"
       "file and part, go into the folder \"measured\" beside the map.\n",
       1,
       2,
       "set output variant quiet",
       {}},
      {"export",
       "CASE.prm",
       "write the law of a case for other programs",
       "Section Friction of the case alone, law.prm, for C, Fortran or Python\n"
       "with libslipstep_friction. With --format abaqus the user subroutine\n"
       "FRIC (fric.f), the law that it reads (slipstep.prm) and the lines of\n"
       "the input file (interaction.inp).\n",
       1,
       1,
       "set output variant format quiet",
       {"law", "abaqus"}},
      {"plant",
       "FOLDER",
       "make measured tests with a hidden effect, as an exercise",
       "Writes tests as a laboratory would (FOLDER/measured), a case that\n"
       "lacks what is hidden and is badly set (case.prm), and the answer, not\n"
       "to be read by accident (answer.sealed; slipstep plant --open FILE\n"
       "prints it). Classes: none, one (effect of the catalogue), two,\n"
       "joint (two that nearly cancel each other), other_formula and\n"
       "third_formula (of an effect of the catalogue), outside (the\n"
       "catalogue), ablated (the case lacks overstress or softening), narrow\n"
       "(one, but the tests hardly tell effects apart). The same class and\n"
       "seed give the same tests.\n",
       0,
       1,
       "class seed effect tests no-replicates noise noise-factor amplitude "
       "edition list open quiet",
       {}},
      {"check",
       "CASE.prm ...",
       "read and cross-check cases and tests, compute nothing",
       "Prints one line per case; writes no file. Reads measured tests, too:\n"
       "a .csv file, or a folder of them, whose replicates are compared.\n",
       1,
       any,
       "set sweep output variant quiet",
       {}},
      {"effects",
       "[NAME ...]",
       "list the effects of the friction law",
       "With formula, parameters, units and source of each, or of those named.\n",
       0,
       any,
       "format",
       {"text", "md"}},
      {"parameters",
       "[import] [NAME ...]",
       "list all parameters with their defaults",
       "Or those of the keys and sections named: Friction/healing, healing,\n"
       "\"Time stepping/Tolerance\". As a commented .prm file to start from, a\n"
       "page to search in (html), tables (md), one key per line (keys), for\n"
       "programs (json), or as a JSON schema (schema). \"slipstep parameters\n"
       "import\" lists the keys of a map for slipstep import.\n",
       0,
       any,
       "set format",
       {"prm", "html", "md", "keys", "json", "schema"}},
      {"help",
       "[COMMAND]",
       "explain the program or a command",
       "",
       0,
       1,
       "",
       {}}};



    std::vector<std::string> options_of(const Command &command)
    {
      return dealii::Utilities::split_string_list(command.options, ' ');
    }



    std::vector<std::string> command_names()
    {
      std::vector<std::string> names;
      for (const Command &command : commands)
        names.push_back(command.name);
      return names;
    }



    // @param hint what else a message may say
    const Command &find_command(const std::string &name,
                                const std::string &hint = "")
    {
      for (const Command &command : commands)
        if (command.name == name)
          return command;
      const bool is_case =
        name != ".prm" && boost::algorithm::ends_with(name, ".prm");
      throw InputError("unknown command \"" + name + "\"" +
                       (is_case ? "; did you mean slipstep run " + name + "?" :
                                  did_you_mean(name, command_names())) +
                       hint + "\n  known commands: " +
                       boost::algorithm::join(command_names(), ", "));
    }



    po::options_description all_visible_options()
    {
      po::options_description options("options");
      // clang-format off
      options.add_options()
        ("set", po::value<std::vector<std::string>>()->value_name("\"PATH=VALUE\""),
         "override a parameter, e.g. --set \"Friction/softening/Rate=0.05\"; repeatable")
        ("sweep", po::value<std::vector<std::string>>()->value_name("\"PATH=A|B|C\""),
         "run with each of these values; repeatable, for all combinations")
        ("output", po::value<std::string>()->value_name("DIR"),
         "folder of the results, instead of Output/Directory")
        ("variant", po::value<std::string>()->value_name("NAME"),
         "only this member of the case's sweep")
        ("slurm", po::value<std::string>()->value_name("FILE"),
         "write the sweep as a job array for a cluster, run nothing")
        ("format", po::value<std::string>()->value_name("NAME"),
         "prm, html, md, keys, json, schema (parameters); text, md (effects); "
         "law, abaqus (export)")
        ("resume", "go on where an earlier run of the case was stopped")
        ("class", po::value<std::string>()->value_name("NAME"),
         "what is hidden: none, one, two, joint, other_formula, third_formula, "
         "outside, ablated, narrow")
        ("seed", po::value<std::string>()->value_name("N"),
         "seed of the random numbers, 1 unless given")
        ("effect", po::value<std::string>()->value_name("NAME[,NAME]"),
         "hide these effects instead of drawing them at random")
        ("tests", po::value<std::string>()->value_name("N"),
         "number of tests, 20 unless given")
        ("no-replicates", "every test under a condition of its own")
        ("noise", po::value<std::string>()->value_name("NAME"),
         "normal, heavy_tails, two_drifts, correlated_rows, drift_in_seconds, "
         "rounded_motion, noisy_sensors, hum")
        ("noise-factor", po::value<std::string>()->value_name("F"),
         "noise as a multiple of the usual one")
        ("amplitude", po::value<std::string>()->value_name("A"),
         "change of friction by what is hidden, 0.02 for 2 %, more than 0 (of "
         "compliance, a spring of 0.4/A MPa/mm); drawn unless given")
        ("edition", po::value<std::string>()->value_name("N"),
         "draw also from effects that were added in editions up to this one; "
         "from 2 on the tests differ, too; 1 unless given, so that a seed "
         "always hides the same")
        ("list", "list the effects that can be hidden")
        ("open", po::value<std::string>()->value_name("FILE"),
         "print a sealed answer")
        ("quiet", "print errors and warnings only")
        ("help", "this text")
        ("version", "version of the program");
      // clang-format on
      return options;
    }



    // Those of one command, or all if its name is empty.
    po::options_description visible_options(const std::string &command)
    {
      const po::options_description all = all_visible_options();
      if (command.empty())
        return all;
      const auto              own = options_of(find_command(command));
      po::options_description options("options");
      for (const auto &option : all.options())
        if (option->long_name() == "help" || option->long_name() == "version" ||
            holds(own, option->long_name()))
          options.add(option);
      return options;
    }



    std::vector<std::string>
    option_names(const po::options_description &options)
    {
      std::vector<std::string> names;
      for (const auto &option : options.options())
        names.push_back("--" + option->long_name());
      return names;
    }



    po::variables_map parse_options(const int argc, char **argv)
    {
      const po::options_description visible = all_visible_options();
      po::options_description       all;
      all.add(visible);
      all.add_options()("child", "")("member", po::value<std::string>())(
        "words", po::value<std::vector<std::string>>());
      po::positional_options_description words;
      words.add("words", -1);
      try
        {
          po::variables_map values;
          // An option must be written out: a shortened one could change its
          // meaning with the next version.
          po::store(po::command_line_parser(argc, argv)
                      .options(all)
                      .positional(words)
                      .style(po::command_line_style::unix_style &
                             ~po::command_line_style::allow_guessing)
                      .run(),
                    values);
          po::notify(values);
          return values;
        }
      catch (const po::unknown_option &error)
        {
          throw InputError(
            "unknown option " + error.get_option_name() +
            did_you_mean(error.get_option_name(), option_names(visible)));
        }
      catch (const po::error &error)
        {
          throw InputError(error.what());
        }
    }



    // What only a file can say.
    void reject_statement(const std::string &text)
    {
      const std::string word =
        lower_case(text.substr(0, text.find_first_of(" /=")));
      const std::string place = "--set \"" + excerpt(text) + "\": ";
      if (word == "sweep" || word == "variants")
        throw InputError(place +
                         "--set changes one key for all members of a sweep, "
                         "--variant NAME chooses one; --sweep "
                         "\"Section/Key=A|B|C\" sweeps one more");
      if (word == "include" || word == "subsection" || word == "end")
        throw InputError(place + "only a case file has lines with '" + word +
                         "'; write --set \"Section/Key = value\"");
      if (word == "set")
        throw InputError(place + "leave out the word 'set': --set "
                                 "\"Section/Key = value\"");
    }



    // @param option "--set" or "--sweep"
    std::pair<std::string, std::string> parse_setting(const std::string &option,
                                                      const std::string &text)
    {
      if (option == "--set")
        reject_statement(text);
      const std::size_t sign = text.find('=');
      if (sign == std::string::npos || sign == 0)
        throw InputError(option + " \"" + excerpt(text) + "\": write it as " +
                         option + " \"Section/Key = value" +
                         (option == "--set" ? "" : " | value") + "\"");
      return {dealii::Utilities::trim(text.substr(0, sign)),
              dealii::Utilities::trim(text.substr(sign + 1))};
    }



    std::pair<std::string, std::vector<std::string>>
    parse_sweep(const std::string &text)
    {
      const auto setting = parse_setting("--sweep", text);
      auto values = dealii::Utilities::split_string_list(setting.second, '|');
      // A last one that is empty is not in the list.
      const auto n_values =
        1 + std::count(setting.second.begin(), setting.second.end(), '|');
      if (static_cast<std::ptrdiff_t>(values.size()) != n_values ||
          holds(values, ""))
        throw InputError("--sweep \"" + excerpt(text) +
                         "\": a value is missing; write the values with | "
                         "between them, as in --sweep \"Loading/Speed=1 "
                         "mm/min|10 mm/min\"");
      return {setting.first, values};
    }



    std::string text_of(const po::variables_map &values,
                        const std::string       &name)
    {
      return values.count(name) ? values[name].as<std::string>() : "";
    }



    // An option that is given has a value.
    std::string named_by(const po::variables_map &values,
                         const std::string       &name,
                         const std::string       &what)
    {
      const std::string text = text_of(values, name);
      if (values.count(name) && text.empty())
        throw InputError("--" + name + ": the name of " + what + " is needed");
      return text;
    }



    std::vector<std::string> list_of(const po::variables_map &values,
                                     const std::string       &name)
    {
      return values.count(name) ? values[name].as<std::vector<std::string>>() :
                                  std::vector<std::string>();
    }



    std::map<std::string, std::string>
    plant_options(const po::variables_map &values)
    {
      std::map<std::string, std::string> options;
      for (const std::string &name : options_of(find_command("plant")))
        if (values.count(name) && name != "quiet")
          {
            const bool takes_value = name != "list" && name != "no-replicates";
            const std::string text = takes_value ? text_of(values, name) : "";
            if (takes_value && text.empty())
              throw InputError("--" + name + ": a value is needed");
            options[name] = name == "open" ? with_home(text).string() : text;
          }
      return options;
    }



    void read_settings(const po::variables_map &values, CommandLine &line)
    {
      line.settings_as_typed = list_of(values, "set");
      for (const std::string &typed : line.settings_as_typed)
        {
          const auto setting = parse_setting("--set", typed);
          for (const auto &other : line.settings)
            if (other.first == setting.first)
              throw InputError("--set " + setting.first + " is given twice: " +
                               other.second + " and " + setting.second);
          line.settings.push_back(setting);
        }
      line.sweeps_as_typed = list_of(values, "sweep");
      for (const std::string &typed : line.sweeps_as_typed)
        line.sweeps.push_back(parse_sweep(typed));
      for (const auto &sweep : line.sweeps)
        for (const auto &setting : line.settings)
          if (setting.first == sweep.first)
            throw InputError("--sweep " + sweep.first +
                             ": --set gives it, too: leave out one of the two");
    }



    void check_usage(const CommandLine &line, const po::variables_map &values)
    {
      const Command &command = find_command(line.command);
      const auto     usage   = [&]() {
        return "; usage: slipstep " + command.name +
               (command.arguments.empty() ? "" : " " + command.arguments);
      };
      if (line.files.size() < command.least_files)
        throw InputError("slipstep " + command.name +
                         (command.arguments.rfind("CASE.prm", 0) == 0 ?
                            ": the name of a .prm file is missing" :
                            ": an argument is missing") +
                         usage());
      if (line.files.size() > command.most_files)
        throw InputError("slipstep " + command.name + ": \"" +
                         line.files[command.most_files].string() +
                         "\" is one argument too many" + usage());
      const po::options_description all = all_visible_options();
      for (const auto &option : all.options())
        {
          const std::string name = option->long_name();
          if (values.count(name) && name != "help" && name != "version" &&
              !holds(options_of(command), name))
            throw InputError("slipstep " + command.name + " has no option --" +
                             name);
        }
      const std::vector<std::string> &formats = command.formats;
      if (values.count("format") > 0 && !holds(formats, line.format))
        throw InputError("--format " + line.format + ": allowed is one of: " +
                         boost::algorithm::join(formats, ", "));
    }
  } // namespace



  CommandLine parse_command_line(const int argc, char **argv)
  {
    const po::variables_map values = parse_options(argc, argv);
    CommandLine             line;
    line.output   = with_home(named_by(values, "output", "a folder")).string();
    line.slurm    = with_home(named_by(values, "slurm", "a file")).string();
    line.variant  = named_by(values, "variant", "a variant");
    line.member   = text_of(values, "member");
    line.format   = text_of(values, "format");
    line.quiet    = values.count("quiet") > 0;
    line.resume   = values.count("resume") > 0;
    line.is_child = values.count("child") > 0;
    line.version  = values.count("version") > 0;
    line.help     = values.count("help") > 0;
    line.plant_options = plant_options(values);
    read_settings(values, line);

    const std::vector<std::string> words = list_of(values, "words");
    if (!words.empty())
      line.command = words.front();
    if (line.version)
      return line;
    if (line.command == "help")
      {
        line.files.assign(words.begin() + 1, words.end());
        check_usage(line, values);
        line.help    = true;
        line.command = words.size() > 1 ? words[1] : "";
      }
    if (line.command.empty() && !line.help)
      throw InputError("a command is missing; \"slipstep help\" lists them");
    if (!line.command.empty())
      find_command(line.command,
                   line.help ? "; an effect is explained by slipstep effects " +
                                 line.command +
                                 ", a section or key by slipstep parameters " +
                                 line.command :
                               "");
    if (line.help)
      return line;

    for (std::size_t i = 1; i < words.size(); ++i)
      line.files.push_back(with_home(words[i]));
    check_usage(line, values);
    return line;
  }



  void print_help(std::ostream &out, const std::string &name)
  {
    if (name.empty())
      {
        out
          << "slipstep: rate-dependent friction of a sliding elastic block\n\n"
          << "usage: slipstep COMMAND [CASE.prm] [options]\n\ncommands:\n";
        for (const Command &command : commands)
          {
            const std::string left = command.name + " " + command.arguments;
            out << "  " << left
                << std::string(left.size() < 24 ? 24 - left.size() : 1, ' ')
                << command.summary << '\n';
          }
      }
    else
      {
        const Command &command = find_command(name);
        out << "slipstep " << name << ": " << command.summary << "\n\n"
            << "usage: slipstep " << name
            << (command.arguments.empty() ? "" : " ") << command.arguments
            << " [options]\n\n"
            << command.details;
      }
    out << '\n'
        << visible_options(name)
        << "\nExit code: 0 done, 1 the run failed, 2 the input is wrong.\n";
  }



  void print_warnings(const std::vector<std::string> &warnings)
  {
    for (const std::string &warning : warnings)
      std::cerr << "warning: " << warning << std::endl;
  }



  std::string version_text()
  {
    return std::string("slipstep ") + version() + " (" + git_hash() + ")";
  }
} // namespace SlipStep
