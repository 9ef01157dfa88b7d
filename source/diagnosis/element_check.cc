#include <slipstep/diagnosis/element_check.h>
#include <slipstep/diagnosis/improved_case.h>
#include <slipstep/experiment/measured_test.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/write_file.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  namespace fs = std::filesystem;

  namespace
  {
    const char *const tests_key = "Diagnosis/Element tests";

    // Whether a test goes by this name.
    bool is_called(const DiagnosedTest &test, const std::string &name)
    {
      const fs::path file = test.file;
      return test.name == name || file.filename() == name ||
             file.stem() == name;
    }
  } // namespace



  std::vector<std::size_t> element_tests(const Parameters &parameters,
                                         const Diagnosis  &diagnosis)
  {
    const std::string text = parameters.text(tests_key);
    if (text == "none")
      return {};
    if (text == "worst")
      {
        std::size_t worst = 0;
        for (std::size_t i = 0; i < diagnosis.tests.size(); ++i)
          if (!diagnosis.tests[i].is_outlier &&
              diagnosis.tests[i].rms_before > diagnosis.tests[worst].rms_before)
            worst = i;
        return {worst};
      }
    std::vector<std::size_t> result;
    for (const std::string &name : parameters.list(tests_key))
      {
        const auto found =
          std::find_if(diagnosis.tests.begin(),
                       diagnosis.tests.end(),
                       [&](const DiagnosedTest &test) {
                         return is_called(test, name) && !test.is_outlier;
                       });
        if (found == diagnosis.tests.end())
          {
            std::vector<std::string> known;
            for (const DiagnosedTest &test : diagnosis.tests)
              known.push_back(fs::path(test.file).filename().string());
            const std::string near = nearest_name(name, known);
            parameters.reject(tests_key,
                              "there is no test '" + name + "'" +
                                (near.empty() ?
                                   "" :
                                   "; did you mean '" + near + "'?"));
          }
        result.push_back(found - diagnosis.tests.begin());
      }
    return result;
  }



  namespace
  {
    /// The same test simulated before and after.
    struct Jobs
    {
      ElementJob before, after;
    };



    ElementJob write_job(const Parameters            &the_case,
                         const DiagnosedTest         &test,
                         const std::string           &label,
                         const fs::path              &folder,
                         const std::set<std::string> &inactive_sections)
    {
      const std::string name =
        fs::path(test.file).stem().string() + "_" + label;
      ElementJob job{test.name + ", " + label,
                     folder / (name + ".prm"),
                     folder / name};
      Parameters parameters = the_case;
      parameters.set("Loading/Programme",
                     "follow " + fs::proximate(test.file, the_case.resolve("."))
                                   .generic_string(),
                     "diagnosis");
      write_file(job.case_file,
                 case_text(parameters, folder, inactive_sections));
      return job;
    }



    // Friction of a simulation at the times of the test; empty without one.
    std::vector<double> block_friction(const ElementJob    &job,
                                       const DiagnosedTest &test)
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
      std::vector<double> result;
      std::size_t         i = 1;
      for (const double since_begin : test.time)
        {
          const double time = begin + since_begin;
          while (i + 1 < history.time.size() && history.time[i] < time)
            ++i;
          const double share =
            std::clamp((time - history.time[i - 1]) /
                         (history.time[i] - history.time[i - 1]),
                       0.,
                       1.);
          result.push_back((1. - share) * history.friction[i - 1] +
                           share * history.friction[i]);
        }
      return result;
    }



    double distance(const std::vector<double> &a,
                    const std::vector<double> &b,
                    const double               level)
    {
      double sum = 0.;
      for (std::size_t i = 0; i < a.size(); ++i)
        sum += std::pow(a[i] - b[i], 2);
      return std::sqrt(sum / a.size()) / level;
    }



    ElementCheck compare(const Jobs &jobs, const DiagnosedTest &test)
    {
      ElementCheck check;
      check.test         = test.name;
      check.displacement = test.displacement;
      check.measured     = test.measured;
      check.point_before = test.before;
      check.point_after  = test.after;
      try
        {
          check.block_before = block_friction(jobs.before, test);
          check.block_after  = block_friction(jobs.after, test);
        }
      catch (const InputError &error)
        {
          check.remark = error.what();
        }
      if (check.block_before.empty() || check.block_after.empty())
        {
          check.remark = "the block could not be simulated to the end" +
                         (check.remark.empty() ? "" : ": " + check.remark);
          check.block_before.clear();
          check.block_after.clear();
          return check;
        }
      check.block_gap_before =
        distance(check.block_before, test.measured, test.level);
      check.block_gap_after =
        distance(check.block_after, test.measured, test.level);
      check.point_gap_before = distance(test.before, test.measured, test.level);
      check.point_gap_after  = distance(test.after, test.measured, test.level);
      check.difference = distance(check.block_after, test.after, test.level);
      return check;
    }
  } // namespace



  std::vector<ElementCheck>
  check_with_elements(const Parameters               &before,
                      const Parameters               &after,
                      const Diagnosis                &diagnosis,
                      const std::vector<std::size_t> &tests,
                      const fs::path                 &folder,
                      const std::set<std::string>    &inactive_sections,
                      const ElementRunner            &runner)
  {
    std::vector<ElementCheck> checks;
    if (tests.empty())
      return checks;
    const bool has_machine =
      before.text("Loading/Machine stiffness") != "rigid";
    if (has_machine || before.number("Calibration/Lead-in") > 0.)
      {
        ElementCheck check;
        check.test = diagnosis.tests[tests.front()].name;
        check.remark =
          has_machine ?
            "the case has a machine in series; the block is elastic "
            "itself and takes none" :
            "the records begin in the middle of a slide "
            "(Calibration/Lead-in), which the block is not led to";
        return {check};
      }
    std::error_code error;
    fs::create_directories(folder, error);
    std::vector<Jobs>       jobs;
    std::vector<ElementJob> all;
    for (const std::size_t i : tests)
      {
        const DiagnosedTest &test = diagnosis.tests[i];
        jobs.push_back(
          {write_job(before, test, "before", folder, inactive_sections),
           write_job(after, test, "after", folder, inactive_sections)});
        all.push_back(jobs.back().before);
        all.push_back(jobs.back().after);
      }
    runner(all);
    for (std::size_t i = 0; i < tests.size(); ++i)
      checks.push_back(compare(jobs[i], diagnosis.tests[tests[i]]));
    return checks;
  }
} // namespace SlipStep
