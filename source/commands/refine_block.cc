// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/commands/commands.h>

#include <slipstep/experiment/checkpoint.h>
#include <slipstep/experiment/refinement_study.h>
#include <slipstep/report/run_figures.h>
#include <slipstep/report/run_report.h>
#include <slipstep/commands/results_folder.h>
#include <slipstep/experiment/run_recorder.h>
#include <slipstep/report/study_report.h>
#include <slipstep/commands/sweep.h>
#include <slipstep/commands/case.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/process.h>

#include <algorithm>
#include <iostream>

namespace SlipStep
{
  namespace fs = std::filesystem;

  namespace
  {
    // Checks all runs before the first is started.
    void check_study(const RefinementStudy &study, const Parameters &parameters)
    {
      for (const StudyRun &run : study.runs())
        try
          {
            const Parameters complete = parameters_of(run, parameters);
            check_case(complete);
            check_block(complete, 1);
          }
        catch (const InputError &error)
          {
            throw InputError(std::string(error.what()) + " (run \"" +
                             run.label + "\")");
          }
    }



    // With --resume: what there is of every run, in the order of study.runs().
    // A folder of another case is refused before anything is touched.
    std::vector<EarlierRun> find_earlier_runs(const RefinementStudy &study,
                                              const Parameters      &parameters,
                                              const CommandLine     &line,
                                              const fs::path        &output)
    {
      const std::vector<StudyRun> runs = study.runs();
      std::vector<EarlierRun>     earlier(runs.size(), EarlierRun::none);
      if (!line.resume)
        return earlier;
      const Parameters declared = declared_parameters();
      for (unsigned int i = 0; i < runs.size(); ++i)
        earlier[i] = find_earlier_run(output / runs[i].folder,
                                      parameters_of(runs[i], parameters),
                                      declared,
                                      "run");
      return earlier;
    }



    std::vector<SweepJob> study_jobs(const RefinementStudy         &study,
                                     const std::vector<EarlierRun> &earlier,
                                     const CommandLine             &line,
                                     const std::string             &variant,
                                     const fs::path                &output)
    {
      std::vector<SweepJob>       jobs;
      const std::vector<StudyRun> runs = study.runs();
      for (unsigned int i = 0; i < runs.size(); ++i)
        {
          const StudyRun &run = runs[i];
          if (earlier[i] == EarlierRun::finished)
            {
              if (!line.quiet)
                std::cout << run.label
                          << ": Finished earlier: the results are kept."
                          << std::endl;
              continue;
            }
          SweepJob job =
            child_job(line, "run", run.label, output / run.folder, variant);
          // What the study varies comes last, so that settings which mean
          // nothing to a run, as those of adaptive meshes, are not wrong.
          for (const auto &typed : line.settings)
            if (none_of(run.settings, [&](const auto &setting) {
                  return setting.first == typed.first;
                }))
              job.arguments.push_back("--set=" + typed.first + "=" +
                                      typed.second);
          for (const auto &setting : run.settings)
            job.arguments.push_back("--set=" + setting.first + "=" +
                                    setting.second);
          jobs.push_back(job);
          if (earlier[i] == EarlierRun::none)
            remove_earlier_results(output / run.folder);
        }
      // The longest first, so that the cores are busy to the end.
      std::reverse(jobs.begin(), jobs.end());
      return jobs;
    }



    // Runs that differ in their steps only have the mesh of the first.
    std::vector<ReportedRun>
    runs_of_meshes(const RefinementStudy          &study,
                   const std::vector<ReportedRun> &runs)
    {
      std::vector<ReportedRun> result;
      for (const StudySequence &sequence : study.sequences)
        if (sequence.kind != StudySequence::Kind::time_step)
          for (const StudyRun &run : sequence.runs)
            for (const ReportedRun &reported : runs)
              if (reported.label == run.label)
                result.push_back(reported);
      return result;
    }



    void report_study(const RefinementStudy &study,
                      const Parameters      &parameters,
                      const fs::path        &output,
                      const bool             quiet)
    {
      const auto curves = study_curves(study, output);
      write_study_csv(output / "refinement.csv", curves);
      write_study_json(output / "refinement.json", curves);
      std::vector<ReportedRun> runs;
      for (const StudyRun &run : study.runs())
        if (fs::exists(output / run.folder / "history.csv"))
          runs.push_back({run.label, output / run.folder});
      if (runs.empty())
        return;
      Page        page(output);
      std::string section = study_section(page, curves);
      section += mesh_gallery(runs_of_meshes(study, runs), page.warnings);
      print_warnings(page.warnings);
      print_warnings(write_report(output, parameters, runs, section));
      if (!quiet)
        std::cout << study_tables(curves)
                  << "\nReport: " << (output / "report.html").string()
                  << std::endl;
    }
  } // namespace



  int refine_block(const CommandLine &line)
  {
    if (is_under_mpirun())
      throw InputError("slipstep refine starts its runs by itself: call it "
                       "without mpirun");
    const Case the_case = read_case(line.files.front(), line);
    if (the_case.is_sweep())
      throw InputError("slipstep refine studies one run, but " +
                       line.files.front().string() +
                       " is a sweep: choose a member with --variant \"" +
                       the_case.variants.front().label + "\"");
    const RefinementStudy study(the_case.parameters);
    check_study(study, the_case.parameters);
    const fs::path output = chosen_output(the_case, line);
    check_output(the_case, line);
    const auto earlier =
      find_earlier_runs(study, the_case.parameters, line, output);

    const ResultsFolder results(output,
                                line.command,
                                the_case.parameters.case_file());
    remove_earlier_results(output);
    write_used_parameters(the_case.parameters,
                          output,
                          inactive_sections(the_case.parameters));
    const std::vector<int> exit_codes = run_side_by_side(
      study_jobs(study, earlier, line, the_case.selected.folder, output),
      the_case.parameters.case_file().stem().string(),
      line.quiet);
    report_study(study, the_case.parameters, output, line.quiet);
    return exit_codes.empty() ?
             0 :
             *std::max_element(exit_codes.begin(), exit_codes.end());
  }
} // namespace SlipStep
