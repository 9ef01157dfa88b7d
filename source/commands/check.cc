// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/calibration/campaign.h>
#include <slipstep/commands/commands.h>
#include <slipstep/experiment/point_driver.h>
#include <slipstep/experiment/rate_and_state.h>
#include <slipstep/experiment/stability.h>
#include <slipstep/measured_data/test_set.h>
#include <slipstep/commands/case.h>

#include <iostream>
#include <set>

namespace SlipStep
{
  namespace fs = std::filesystem;

  namespace
  {
    // Of a sweep each once.
    void print_rate_and_state(const Case &the_case)
    {
      std::set<std::string> printed;
      for (const Parameters &parameters : the_case.complete)
        for (const RateAndState &reading :
             rate_and_state(parameters,
                            FrictionLaw(parameters),
                            parse_programme(parameters)))
          if (printed.insert(reading.in_words()).second)
            std::cout << "  " << reading.in_words() << std::endl;
    }



    // A file in which every key is written names the default folder, whether
    // there are tests or not.
    bool names_tests(const Parameters &parameters)
    {
      const std::string key   = "Calibration/Tests";
      const std::string value = parameters.text(key);
      return parameters.is_set(key) && (fs::path(value).filename() !=
                                          parameters.entry(key).default_value ||
                                        fs::exists(parameters.resolve(value)));
    }



    // What calibrate and diagnose would read.
    // @return a line about the tests, "" if the case names none
    std::string check_campaign(const Parameters &parameters)
    {
      Campaign::stated_noise(parameters);
      const bool fits = !parameters.text("Calibration/Parameters").empty();
      if (!fits && !names_tests(parameters))
        return "";
      const auto tests = Campaign::read_tests(parameters);
      print_warnings(
        (fits ? Campaign(parameters, tests) : Campaign(parameters, {}, tests))
          .warnings());
      std::vector<MeasuredTest> rows;
      for (const CampaignTest &test : tests)
        rows.push_back(test.rows);
      print_warnings(warnings_of_areas(parameters, rows));
      return describe(rows);
    }



    // As `run` and `point` begin.
    std::vector<std::string> warnings_of_stability(const Case &the_case)
    {
      std::vector<std::string> warnings;
      for (std::size_t i = 0; i < the_case.complete.size(); ++i)
        {
          const Parameters &parameters = the_case.complete[i];
          for (const std::string &text :
               instability_warnings(FrictionLaw(parameters),
                                    parse_programme(parameters),
                                    Machine(parameters)))
            warnings.push_back(
              (the_case.is_sweep() ? the_case.variants[i].label + ": " : "") +
              text);
        }
      return warnings;
    }



    void check_case_file(const fs::path &file, const CommandLine &line)
    {
      const Case the_case = read_case(file, line);
      check_all(the_case);
      if (!line.output.empty())
        check_output(the_case, line);
      print_warnings(warnings_of_equal_variants(the_case));
      print_warnings(warnings_of_programmes(the_case));
      print_warnings(warnings_of_followed_areas(the_case));
      print_warnings(warnings_of_stability(the_case));
      std::set<std::string> campaigns;
      for (const Parameters &parameters : the_case.complete)
        campaigns.insert(check_campaign(parameters));
      if (campaigns != std::set<std::string>{""})
        print_warnings(warnings_of_face(the_case));
      if (line.quiet)
        return;
      std::cout << file.string() << ": OK"
                << (the_case.is_sweep() ?
                      ", " + std::to_string(the_case.variants.size()) +
                        " variants" :
                      "")
                << std::endl;
      for (const std::string &campaign : campaigns)
        if (!campaign.empty())
          std::cout << "  " << campaign << std::endl;
      print_rate_and_state(the_case);
    }



    // A measured test, or a folder of them.
    void check_tests(const fs::path &file, const CommandLine &line)
    {
      std::vector<MeasuredTest> tests;
      if (fs::is_directory(file))
        tests = read_test_set(file);
      else
        tests.push_back(read_measured_test(file));
      warn_of_oddities(tests);
      for (const MeasuredTest &test : tests)
        {
          print_warnings(test.warnings);
          Campaign::noted_noise(test);
          if (!line.quiet)
            std::cout << test.file.string() << ": OK, " << describe(test)
                      << std::endl;
        }
      if (!line.quiet && tests.size() > 1)
        std::cout << describe(tests) << std::endl;
    }
  } // namespace



  Outcome check(const CommandLine &line)
  {
    Outcome worst;
    for (const fs::path &file : line.files)
      {
        const Outcome outcome = guarded([&]() {
          if (fs::is_directory(file) || file.extension() == ".csv")
            check_tests(file, line);
          else if (is_import_map(file))
            check_import_map(file, line);
          else
            check_case_file(file, line);
          return done;
        });
        if (!outcome.message.empty())
          std::cerr << outcome.message << std::endl;
        worst.exit_code = std::max(worst.exit_code, outcome.exit_code);
      }
    return worst;
  }
} // namespace SlipStep
