// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/commands/commands.h>
#include <slipstep/commands/element_check.h>
#include <slipstep/commands/new_case.h>
#include <slipstep/diagnosis/diagnose.h>
#include <slipstep/report/diagnosis_report.h>
#include <slipstep/report/diagnosis_text.h>
#include <slipstep/diagnosis/element_tests.h>
#include <slipstep/commands/results_folder.h>
#include <slipstep/commands/sweep.h>
#include <slipstep/commands/case.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/process.h>
#include <slipstep/utilities/progress.h>

#include <iostream>

namespace SlipStep
{
  namespace
  {
    void write_results(const DiagnosedCase &diagnosed,
                       const Parameters    &parameters,
                       const RunOptions    &options)
    {
      const Diagnosis &diagnosis = diagnosed.diagnosis;
      write_new_case(options.output / diagnosis.improved_case,
                     diagnosed.after,
                     options.inactive_sections,
                     diagnosed.parameters,
                     {headline(diagnosis)});
      write_diagnosis_json(options.output / "diagnosis.json",
                           parameters,
                           diagnosis);
      print_warnings(
        write_diagnosis_report(options.output, parameters, diagnosis));
    }



    // The block is simulated by processes of their own, one per core.
    void simulate_blocks(const std::vector<ElementJob> &element_jobs,
                         const Parameters              &parameters,
                         const CommandLine             &line)
    {
      std::vector<SweepJob> jobs;
      for (const ElementJob &job : element_jobs)
        {
          CommandLine child = line;
          child.files       = {job.case_file};
          jobs.push_back(child_job(child, "run", job.label, job.output, ""));
        }
      run_side_by_side(
        jobs, parameters.case_file().stem().string(), line.quiet, 0, false);
      if (SignalGuard::caught() != 0)
        throw RunError(SignalGuard::in_words() +
                       "; what was found on the contact point is kept, without "
                       "the simulation of the block");
    }



    void print_results(const Diagnosis &diagnosis, const RunOptions &options)
    {
      if (!options.quiet)
        std::cout << diagnosis_table(diagnosis)
                  << (has_after(diagnosis) ? "\nImproved case: " :
                                             "\nCalibrated case: ")
                  << (options.output / diagnosis.improved_case).string()
                  << "\nReport: " << (options.output / "report.html").string()
                  << std::endl;
    }
  } // namespace



  int diagnose_case(const CommandLine &line)
  {
    const Case          the_case   = read_single_case(line);
    const Parameters   &parameters = the_case.parameters;
    const RunOptions    options    = options_of(the_case, line);
    const SignalGuard   guard;
    const ResultsFolder results(options.output, line.command);
    Progress progress(options.quiet, parameters.case_file().stem().string());
    double   share = 0.;
    DiagnosedCase diagnosed =
      diagnose(parameters, [&](const std::string &text) {
        share += 0.3 * (1. - share);
        progress.update(share, text);
      });
    Diagnosis                     &diagnosis = diagnosed.diagnosis;
    const std::vector<std::size_t> tests = element_tests(parameters, diagnosis);

    remove_earlier_results(options.output);
    diagnosis.improved_case = "improved.prm";
    write_results(diagnosed, parameters, options);
    print_warnings(diagnosis.warnings);
    if (SignalGuard::caught() != 0)
      throw RunError(SignalGuard::in_words() + "; what was found is kept");
    if (!tests.empty())
      {
        progress.update(0.9, "simulating the block");
        diagnosis.element_checks =
          check_with_elements(diagnosed.before,
                              diagnosed.after,
                              diagnosis,
                              tests,
                              options.output / "elements",
                              options.inactive_sections,
                              [&](const std::vector<ElementJob> &jobs) {
                                simulate_blocks(jobs, parameters, line);
                              });
        write_results(diagnosed, parameters, options);
      }
    progress.finish();
    print_results(diagnosis, options);
    return 0;
  }
} // namespace SlipStep
