// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/commands/commands.h>

#include <slipstep/commands/case.h>
#include <slipstep/commands/results_folder.h>
#include <slipstep/friction/law.h>
#include <slipstep/friction/state_numbers.h>
#include <slipstep/report/run_report.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/write_file.h>

#include <slipstep_fric_source.h>

#include <boost/algorithm/string/predicate.hpp>

#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <sstream>

namespace SlipStep
{
  namespace
  {
    /// Section Friction of a case, without the effects that are off.
    std::string law_text(const Parameters &parameters, const FrictionLaw &law)
    {
      std::set<std::string> omitted = law.inactive_sections();
      for (const std::string &path : parameters.paths())
        if (!boost::algorithm::starts_with(path, "Friction/"))
          omitted.insert(path.substr(0, path.find('/')));
      std::ostringstream text;
      text << "# The law of " << parameters.case_file().filename().string()
           << ", written by \"slipstep export\" for programs that use\n"
              "# libslipstep_friction.\n";
      parameters.print(text, Parameters::Format::prm, omitted);
      return text.str();
    }



    /// What belongs into the input file of ABAQUS.
    std::string interaction_text(const std::string &name,
                                 const FrictionLaw &law)
    {
      std::ostringstream text;
      const std::size_t  n = StateNumbers(law).size();
      text << "** Into the input file; units are mm, s, N, MPa.\n"
              "** The tangent is unsymmetric: *STEP, UNSYMM=YES.\n"
           << "*SURFACE INTERACTION, NAME=" << name
           << "\n*FRICTION, USER, DEPVAR=" << n + 1
           << "\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n "
           << law.normal_stiffness() << ",\n** Numbers of the state:\n";
      for (std::size_t i = 0; i < n; ++i)
        text << "**   " << i + 1 << "  " << StateNumbers(law).name(i) << '\n';
      text << "**   " << n + 1
           << "  turn_rad: of the surface in the slip directions since the "
              "point first touched;\n**      angles of the law and vectors "
              "above refer to the directions at that time\n";
      return text.str();
    }



    /// Write a file, unless something else is lost by it.
    /// @param mark what files of its kind begin with
    void write_over_own(const std::filesystem::path &file,
                        const std::string           &text,
                        const std::string           &mark)
    {
      std::ifstream      in(file);
      std::ostringstream there;
      there << in.rdbuf();
      if (std::filesystem::exists(file) &&
          there.str().compare(0, mark.size(), mark) != 0)
        throw InputError(file.string() +
                         " is there and was not written by slipstep export; "
                         "move it away or give another folder with --output");
      write_file(file, text);
    }
  } // namespace



  int export_law(const CommandLine &line)
  {
    const Case the_case = read_case(line.files.front(), line);
    // Members of a sweep that differ in something else have the same law.
    if (!has_one_law(the_case.parameters))
      throw InputError(line.files.front().string() +
                       ": its variants have different laws; choose one with "
                       "--variant");
    const Parameters           &parameters = the_case.complete.front();
    const FrictionLaw           law(parameters);
    const bool                  is_abaqus = line.format == "abaqus";
    const std::string           name      = is_abaqus ? "slipstep" : "law";
    const std::filesystem::path folder    = chosen_output(the_case, line);
    // The case's own is told from other files by the mark.
    std::unique_ptr<ResultsFolder> results;
    if (line.output.empty())
      results = std::make_unique<ResultsFolder>(folder,
                                                line.command,
                                                line.files.front());
    else
      std::filesystem::create_directories(folder);
    write_over_own(folder / (name + ".prm"),
                   law_text(parameters, law),
                   "# The law of ");
    print_warnings(warnings_of_face(the_case));
    std::string written = name + ".prm";
    if (is_abaqus)
      {
        // Who has changed it keeps it.
        write_over_own(folder / "fric.f", fric_source, fric_source);
        write_over_own(folder / "interaction.inp",
                       interaction_text(name, law),
                       "** Into the input file");
        written += ", fric.f and interaction.inp";
      }
    if (!line.quiet)
      std::cout << "law of " << line.files.front().string() << ": " << written
                << " in " << folder.string() << std::endl;
    return done;
  }
} // namespace SlipStep
