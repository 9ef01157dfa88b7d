#include <slipstep/calibration/calibrate.h>
#include <slipstep/diagnosis/diagnose.h>
#include <slipstep/experiment/results_folder.h>
#include <slipstep/experiment/sweep.h>
#include <slipstep/fit_commands.h>
#include <slipstep/solid/case.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/process.h>

namespace SlipStep
{
  namespace
  {
    // One case with its tests, and where its results go.
    Case read_fitted_case(const CommandLine &line)
    {
      const Case the_case = read_case(line.files.front(), line);
      if (the_case.is_sweep())
        throw InputError("slipstep " + line.command + " fits one case, but " +
                         line.files.front().string() +
                         " is a sweep: choose a member with --variant \"" +
                         the_case.variants.front().label + "\"");
      check_all(the_case);
      check_output(the_case, line);
      return the_case;
    }



    RunOptions fit_options(const Case &the_case, const CommandLine &line)
    {
      RunOptions options;
      options.quiet             = line.quiet;
      options.output            = chosen_output(the_case, line);
      options.inactive_sections = inactive_sections(the_case.parameters);
      return options;
    }
  } // namespace



  void calibrate_case(const CommandLine &line)
  {
    const Case          the_case = read_fitted_case(line);
    const RunOptions    options  = fit_options(the_case, line);
    const SignalGuard   guard;
    const ResultsFolder results(options.output, line.command);
    run_calibration(the_case.parameters, options);
  }



  // The block is simulated by processes of their own, one per core.
  void diagnose_case(const CommandLine &line)
  {
    const Case          the_case = read_fitted_case(line);
    const RunOptions    options  = fit_options(the_case, line);
    const SignalGuard   guard;
    const ResultsFolder results(options.output, line.command);
    const ElementRunner runner =
      [&](const std::vector<ElementJob> &element_jobs) {
        std::vector<SweepJob> jobs;
        for (const ElementJob &job : element_jobs)
          {
            CommandLine child = line;
            child.files       = {job.case_file};
            jobs.push_back(child_job(child, "run", job.label, job.output, ""));
          }
        run_side_by_side(jobs,
                         the_case.parameters.case_file().stem().string(),
                         line.quiet,
                         0,
                         false);
        if (SignalGuard::caught() != 0)
          throw RunError(SignalGuard::in_words() +
                         "; what was found on the contact point is kept, "
                         "without the simulation of the block");
      };
    run_diagnosis(the_case.parameters, options, runner);
  }
} // namespace SlipStep
