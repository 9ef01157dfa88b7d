// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/calibration/calibrate.h>
#include <slipstep/report/calibration_report.h>
#include <slipstep/commands/commands.h>
#include <slipstep/commands/new_case.h>
#include <slipstep/commands/results_folder.h>
#include <slipstep/commands/case.h>
#include <slipstep/utilities/process.h>
#include <slipstep/utilities/progress.h>

#include <iostream>

namespace SlipStep
{
  namespace
  {
    void write_results(const Parameters  &parameters,
                       const RunOptions  &options,
                       const Calibration &calibration)
    {
      remove_earlier_results(options.output);
      const std::filesystem::path file = options.output / "fitted.prm";
      write_new_case(file,
                     fitted_case(parameters, calibration),
                     options.inactive_sections);
      write_calibration_json(options.output / "calibration.json",
                             parameters,
                             calibration);
      print_warnings(
        write_calibration_report(options.output, parameters, calibration));
      print_warnings(calibration.warnings);
      if (!options.quiet)
        std::cout << calibration_table(calibration)
                  << "\nParameters: " << file.string()
                  << "\nReport: " << (options.output / "report.html").string()
                  << std::endl;
    }
  } // namespace



  int calibrate_case(const CommandLine &line)
  {
    const Case          the_case = read_single_case(line);
    const RunOptions    options  = options_of(the_case, line);
    const SignalGuard   guard;
    const ResultsFolder results(options.output,
                                line.command,
                                the_case.parameters.case_file());
    Progress            progress(options.quiet,
                      the_case.parameters.case_file().stem().string());
    const Calibration   calibration =
      calibrate(the_case.parameters,
                [&](const std::string &text, const double share) {
                  progress.update(share, text);
                });
    progress.finish();
    write_results(the_case.parameters, options, calibration);
    return 0;
  }
} // namespace SlipStep
