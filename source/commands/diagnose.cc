// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/commands/commands.h>
#include <slipstep/commands/new_case.h>
#include <slipstep/diagnosis/diagnose.h>
#include <slipstep/report/diagnosis_report.h>
#include <slipstep/diagnosis/element_tests.h>
#include <slipstep/commands/results_folder.h>
#include <slipstep/commands/sweep.h>
#include <slipstep/commands/case.h>
#include <slipstep/friction/law.h>
#include <slipstep/measured_data/friction_axes.h>
#include <slipstep/measured_data/measured_test.h>
#include <slipstep/measured_data/test_rows.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/process.h>
#include <slipstep/utilities/progress.h>
#include <slipstep/utilities/text.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <optional>

namespace SlipStep
{
  namespace fs = std::filesystem;

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
                     diagnosis.parameters,
                     {headline(diagnosis)});
      write_diagnosis_json(options.output / "diagnosis.json",
                           parameters,
                           diagnosis);
      print_warnings(
        write_diagnosis_report(options.output, parameters, diagnosis));
    }



    /// A case to be simulated with finite elements, and where to. A job that
    /// fails leaves no history.csv.
    struct ElementJob
    {
      std::string label;
      fs::path    case_file;
      fs::path    output;
    };



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



    /// The same test simulated before and after.
    struct Jobs
    {
      ElementJob before, after;
    };



    ElementJob write_job(const Parameters    &the_case,
                         const DiagnosedTest &test,
                         const std::size_t    number,
                         const std::string   &label,
                         const fs::path      &folder,
                         const RunOptions    &options)
    {
      // The number tells files of the same name in two folders apart.
      const std::string name = std::to_string(number) + "_" +
                               fs::path(test.file).stem().string() + "_" +
                               label;
      ElementJob job{test.name + ", " + label,
                     folder / (name + ".prm"),
                     folder / name};
      Parameters parameters = the_case;
      parameters.set("Loading/Programme",
                     "follow " + fs::proximate(test.file, the_case.resolve("."))
                                   .generic_string(),
                     "diagnosis");
      const std::optional<double> order = read_measured_test(test.file).order();
      const EffectInfo *const     effect =
        effect_of_order(FrictionLaw(parameters).effects());
      if (order.has_value() && effect != nullptr)
        parameters.set(effect->section() + effect->test_number,
                       rounded_text(*order, 15),
                       "diagnosis");
      write_case(job.case_file, parameters, options.inactive_sections);
      return job;
    }



    /// Friction along both axes; the second one is empty where a test has one.
    struct Curves
    {
      std::vector<double> x, y;

      // Of a test with two axes the resultant.
      std::vector<double> along_motion() const
      {
        std::vector<double> result = x;
        for (std::size_t i = 0; i < y.size(); ++i)
          result[i] = std::hypot(x[i], y[i]);
        return result;
      }

      double squared_distance(const Curves &other) const
      {
        double sum = 0.;
        for (std::size_t i = 0; i < x.size(); ++i)
          sum += std::pow(x[i] - other.x[i], 2);
        for (std::size_t i = 0; i < y.size(); ++i)
          sum += std::pow(y[i] - other.y[i], 2);
        return sum;
      }
    };



    // Of a simulation, at the times of the test; empty without one.
    Curves block_friction(const ElementJob &job, const DiagnosedTest &test)
    {
      const fs::path file = job.output / "history.csv";
      if (!fs::exists(file))
        return {};
      const MeasuredTest history = read_measured_test(file);
      if (history.time.back() < 0.999 * (test.time.back() - test.time.front()))
        return {};
      // The simulation begins with the first row of the file, the comparison
      // perhaps later.
      const double begin =
        test.start_time - read_measured_test(test.file).time.front();
      std::vector<double> times;
      for (const double since_begin : test.time)
        times.push_back(begin + since_begin);
      const std::vector<double> x =
        at_times(history.time, history.friction, times);
      const std::vector<double> y =
        history.friction_y.empty() ?
          std::vector<double>(times.size()) :
          at_times(history.time, history.friction_y, times);
      if (test.measured_y.empty())
        return {FrictionAxis{test.cosine, test.sine}.of(x, y), {}};
      return {x, y};
    }



    ElementCheck compare(const Jobs &jobs, const DiagnosedTest &test)
    {
      ElementCheck check;
      const Curves measured{test.measured, test.measured_y};
      const Curves point_before{test.before, test.before_y};
      const Curves point_after{test.after, test.after_y};
      check.test         = test.name;
      check.displacement = test.displacement;
      check.measured     = measured.along_motion();
      check.point_before = point_before.along_motion();
      check.point_after  = point_after.along_motion();
      Curves block_before, block_after;
      try
        {
          block_before = block_friction(jobs.before, test);
          block_after  = block_friction(jobs.after, test);
        }
      catch (const InputError &error)
        {
          check.remark = error.what();
        }
      if (block_before.x.empty() || block_after.x.empty())
        {
          check.remark = "the block could not be simulated to the end" +
                         (check.remark.empty() ? "" : ": " + check.remark);
          return check;
        }
      check.block_before  = block_before.along_motion();
      check.block_after   = block_after.along_motion();
      const auto distance = [&](const Curves &a, const Curves &b) {
        return std::sqrt(a.squared_distance(b) / a.x.size()) / test.level;
      };
      check.block_gap_before = distance(block_before, measured);
      check.block_gap_after  = distance(block_after, measured);
      check.point_gap_before = distance(point_before, measured);
      check.point_gap_after  = distance(point_after, measured);
      check.difference       = distance(block_after, point_after);
      return check;
    }



    ElementCheck without_block(const std::string &test,
                               const std::string &remark)
    {
      ElementCheck check;
      check.test   = test;
      check.remark = remark;
      return check;
    }



    // Simulates tests with the block, before and after, and compares.
    std::vector<ElementCheck>
    check_with_elements(const DiagnosedCase            &diagnosed,
                        const std::vector<std::size_t> &tests,
                        const Parameters               &parameters,
                        const RunOptions               &options,
                        const CommandLine              &line)
    {
      const Parameters         &before    = diagnosed.before;
      const Diagnosis          &diagnosis = diagnosed.diagnosis;
      const fs::path            folder    = options.output / "elements";
      std::vector<ElementCheck> checks;
      const bool                has_machine =
        before.text("Loading/Machine stiffness") != "rigid";
      if (has_machine || before.number("Calibration/Lead-in") > 0.)
        return {without_block(
          diagnosis.tests[tests.front()].name,
          has_machine ?
            "the case has a machine in series, but the block, elastic itself, "
            "is simulated without one" :
            "the records begin in the middle of a slide (Calibration/Lead-in), "
            "and the simulation of the block has no lead-in")};
      std::error_code error;
      fs::create_directories(folder, error);
      std::map<std::size_t, Jobs> jobs; ///< by test
      std::vector<ElementJob>     all;
      for (const std::size_t i : tests)
        {
          const DiagnosedTest &test = diagnosis.tests[i];
          if (test.is_outlier)
            continue;
          jobs[i] = {
            write_job(before, test, i + 1, "before", folder, options),
            write_job(diagnosed.after, test, i + 1, "after", folder, options)};
          all.push_back(jobs[i].before);
          all.push_back(jobs[i].after);
        }
      simulate_blocks(all, parameters, line);
      for (const std::size_t i : tests)
        {
          const DiagnosedTest &test = diagnosis.tests[i];
          checks.push_back(
            test.is_outlier ?
              without_block(test.name, "the test is left out as an outlier") :
              compare(jobs.at(i), test));
        }
      return checks;
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
    const ResultsFolder results(options.output,
                                line.command,
                                parameters.case_file());
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
    SignalGuard::recall();
    if (SignalGuard::caught() != 0)
      {
        print_results(diagnosis, options);
        throw RunError(SignalGuard::in_words() + "; what was found is kept");
      }
    if (!tests.empty())
      {
        progress.update(0.9, "simulating the block");
        diagnosis.element_checks =
          check_with_elements(diagnosed, tests, parameters, options, line);
        write_results(diagnosed, parameters, options);
      }
    progress.finish();
    print_results(diagnosis, options);
    return 0;
  }
} // namespace SlipStep
