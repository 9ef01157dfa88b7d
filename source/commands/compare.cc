// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/commands/case.h>
#include <slipstep/commands/commands.h>
#include <slipstep/commands/results_folder.h>
#include <slipstep/experiment/case_identity.h>
#include <slipstep/experiment/programme.h>
#include <slipstep/experiment/summary.h>
#include <slipstep/friction/law.h>
#include <slipstep/measured_data/measured_test.h>
#include <slipstep/report/page.h>
#include <slipstep/report/run_report.h>
#include <slipstep/utilities/exceptions.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <set>

namespace SlipStep
{
  namespace fs = std::filesystem;

  namespace
  {
    const char *const programme_key = "Loading/Programme";



    /// Results that one argument names: a run, or all runs of a sweep.
    struct Source
    {
      std::string              argument;
      std::string              case_name;
      std::vector<ReportedRun> runs;
    };



    bool is_run(const fs::path &folder)
    {
      return fs::exists(folder / "summary.json") &&
             fs::exists(folder / "history.csv");
    }



    // Those of the last sweep in its order, if the folder tells; else all, in
    // the order of their names. Others are of an earlier sweep.
    std::vector<fs::path> folders_of_runs(const fs::path &folder)
    {
      std::vector<fs::path> folders, others;
      bool                  is_sweep = false;
      if (fs::exists(folder / "used_parameters.prm"))
        {
          Parameters parameters = declared_parameters();
          parameters.read(folder / "used_parameters.prm");
          is_sweep = !parameters.variants().empty();
          for (const Variant &variant : parameters.variants())
            if (is_run(folder / variant.folder))
              folders.push_back(folder / variant.folder);
        }
      for (const auto &entry : fs::directory_iterator(folder))
        {
          const fs::path &run = entry.path();
          if (!is_run(run) && fs::exists(run / "summary.json"))
            print_warnings(
              {run.string() + " has no history.csv, and is left out"});
          else if (is_run(run) && !holds(folders, run))
            others.push_back(run);
        }
      std::sort(others.begin(), others.end());
      if (!is_sweep)
        return others;
      for (const fs::path &other : others)
        print_warnings({other.string() +
                        " does not belong to the last sweep in this folder and "
                        "is left out; name it to compare it"});
      return folders;
    }



    Source read_source(const fs::path &path)
    {
      const std::string where = path.string() + ": ";
      std::error_code   error;
      if (path.extension() == ".prm")
        throw InputError(where + "this is a case, not results; run it, and "
                                 "name the folder that it writes");
      if (!fs::exists(path, error))
        throw InputError(where + "there is no such folder or measured test");
      if (!fs::is_directory(path, error))
        throw InputError(where + "neither a folder of results nor a measured "
                                 "test (.csv)");
      Source source{path.string(), "", {}};
      for (const fs::path &folder :
           is_run(path) ? std::vector<fs::path>{path} : folders_of_runs(path))
        {
          const Summary summary = read_summary(folder / "summary.json");
          source.case_name      = summary.case_name;
          source.runs.push_back({summary.label.empty() && folder != path ?
                                   folder.filename().string() :
                                   summary.label,
                                 folder});
        }
      if (source.runs.empty())
        throw InputError(where + "it holds no results of slipstep run or "
                                 "slipstep point");
      return source;
    }



    // By the name of the case, or what was typed where those are alike.
    std::vector<ReportedRun> with_labels(const std::vector<Source> &sources)
    {
      std::map<std::string, unsigned int> number;
      for (const Source &source : sources)
        ++number[source.case_name];
      std::vector<ReportedRun> runs;
      for (const Source &source : sources)
        for (ReportedRun run : source.runs)
          {
            const std::string name =
              number[source.case_name] > 1 ? source.argument : source.case_name;
            if (run.label.empty())
              run.label = name;
            else if (sources.size() > 1)
              run.label = name + ": " + run.label;
            runs.push_back(run);
          }
      return runs;
    }



    fs::path used_parameters(const ReportedRun &run)
    {
      return run.folder / "used_parameters.prm";
    }



    std::vector<std::string>
    unknown_parameters(const std::vector<ReportedRun> &runs)
    {
      std::vector<std::string> warnings;
      for (const ReportedRun &run : runs)
        if (!fs::exists(used_parameters(run)))
          warnings.push_back("run '" + run.label +
                             "': its parameters are unknown, since " +
                             used_parameters(run).string() +
                             " is missing; \"What differs\" leaves it out");
      return warnings;
    }



    std::vector<TableLine> exchanged(const std::vector<TableLine> &table)
    {
      std::vector<TableLine> result(table[0].size());
      for (const TableLine &line : table)
        for (std::size_t i = 0; i < line.size(); ++i)
          result[i].push_back(line[i]);
      return result;
    }



    // With the paths of the tests that it follows as they are from here.
    std::string programme_from_here(const Parameters &parameters)
    {
      return relocated_programme(parameters.text(programme_key),
                                 parameters.resolve("."),
                                 std::filesystem::current_path());
    }



    // Files of one name may hold different tests, and copies the same.
    bool is_same_motion(const Parameters &one, const Parameters &other)
    {
      if (programme_from_here(one) == programme_from_here(other))
        return true;
      try
        {
          return CaseIdentity(one).programme == CaseIdentity(other).programme;
        }
      catch (const InputError &)
        {
          return false; // a file is gone
        }
    }



    // A column for each key in which the cases differ; lines and columns
    // exchanged where that is the narrower table.
    std::vector<TableLine>
    differences_of_keys(const std::vector<ReportedRun> &runs)
    {
      const std::string                  off = "-";
      std::vector<Parameters>            used;
      std::vector<std::set<std::string>> inactive;
      std::vector<TableLine>             keys = {{"run"}};
      for (const ReportedRun &run : runs)
        {
          used.push_back(declared_parameters());
          used.back().read(used_parameters(run));
          inactive.push_back(FrictionLaw(used.back()).inactive_sections());
          keys[0].push_back(run.label);
        }
      for (const std::string &path : used[0].paths())
        {
          const std::string section = path.substr(0, path.find('/'));
          if (section != "Loading" && section != "Friction" &&
              section != "Block" && section != "Time stepping")
            continue;
          TableLine values;
          for (std::size_t i = 0; i < runs.size(); ++i)
            values.push_back(
              inactive[i].count(path.substr(0, path.rfind('/'))) > 0 ? off :
              path == programme_key ? programme_from_here(used[i]) :
                                      used[i].text(path));
          const auto is_first = [&](const std::string &value) {
            return value == values[0] ||
                   (value != off && values[0] != off &&
                    is_same_value(*used[0].entry(path).pattern,
                                  values[0],
                                  value));
          };
          if (path == programme_key ?
                all_of(used,
                       [&](const Parameters &other) {
                         return is_same_motion(used[0], other);
                       }) :
                all_of(values, is_first))
            continue;
          values.insert(values.begin(), path);
          keys.push_back(values);
        }
      if (keys.size() == 1)
        return {};
      if (keys.size() - 1 <= runs.size())
        return exchanged(keys);
      keys[0][0] = "key";
      return keys;
    }



    std::string differences_in_html(const std::vector<ReportedRun> &runs,
                                    const std::vector<std::string> &unknown)
    {
      const std::string title =
        problem_boxes(unknown) + heading("What differs");
      std::vector<ReportedRun> told = runs;
      remove_erase_if(told, [](const ReportedRun &run) {
        return !fs::exists(used_parameters(run));
      });
      if (!unknown.empty() && told.size() < 2)
        return title + paragraph("Unknown: fewer than two of these runs tell "
                                 "their parameters.");
      const auto table = differences_of_keys(told);
      if (!table.empty())
        return title + html_table(table, "unbroken");
      return title + paragraph(unknown.empty() ?
                                 "Nothing: the cases say the same." :
                                 "Nothing among the cases whose parameters "
                                 "are known.");
    }
  } // namespace



  int compare_results(const CommandLine &line)
  {
    std::vector<Source> sources;
    std::string         measured;
    std::set<fs::path>  met;
    for (const fs::path &file : line.files)
      {
        const fs::path path = file.has_filename() ? file : file.parent_path();
        if (!met.insert(fs::weakly_canonical(path)).second)
          throw InputError(file.string() + " is named twice");
        if (path.extension() == ".csv" && !fs::is_directory(path))
          {
            read_measured_test(path);
            if (path.string().find(',') != std::string::npos)
              throw InputError(path.string() +
                               ": a name with a comma cannot be listed");
            measured += (measured.empty() ? "" : ", ") +
                        fs::absolute(path).lexically_normal().string();
          }
        else
          sources.push_back(read_source(path));
      }
    if (sources.empty())
      throw InputError("slipstep compare: no folder of results is named, only "
                       "measured tests");
    const std::vector<ReportedRun> runs = with_labels(sources);

    Parameters parameters = declared_parameters();
    parameters.set("Report/Title", "Comparison", "compare");
    if (!measured.empty())
      parameters.set("Report/Measured", measured, "compare");
    const fs::path output =
      line.output.empty() ? fs::path("output/compare") : fs::path(line.output);
    check_output_folder(output, "--output");
    const ResultsFolder results(output, line.command, "");
    remove_earlier_results(output);
    const std::vector<std::string> unknown = unknown_parameters(runs);
    print_warnings(unknown);
    print_warnings(write_report(
      output, parameters, runs, differences_in_html(runs, unknown), false));
    if (!line.quiet)
      std::cout << result_table(parameters, runs)
                << "\nReport: " << (output / "report.html").string()
                << std::endl;
    return done;
  }
} // namespace SlipStep
