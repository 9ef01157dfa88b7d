// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/candidates.h>
#include <slipstep/diagnosis/diagnosis_parameters.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/pattern_words.h>

#include <boost/algorithm/string/join.hpp>

#include <cmath>

namespace SlipStep
{
  namespace
  {
    const std::string section = "Diagnosis/";

    void declare_noise(Parameters        &parameters,
                       const std::string &name,
                       const std::string &value,
                       const std::string &what)
    {
      parameters.declare(section + name,
                         value,
                         Quantity(Dimension::number, 0., 1., true),
                         "Standard deviation of " + what +
                           ", as a share of friction, as assumed before any "
                           "replicates are seen; without replicates the "
                           "verdict rests on this value. Between 0 and 1, no "
                           "unit.");
    }
  } // namespace



  void declare_diagnosis_parameters(Parameters &parameters)
  {
    using namespace dealii::Patterns;
    std::vector<std::string> candidates = candidate_names();
    candidates.push_back("all");
    parameters.declare(
      section + "Candidates",
      "all",
      List(AnythingWithWords(candidates)),
      "Effects that 'slipstep diagnose' considers when something is missing, "
      "separated by commas, or 'all' of the catalogue.");
    parameters.declare(section + "Level",
                       "0.04",
                       Quantity(Dimension::number, 1e-3, 0.3),
                       "Chance of an alarm where nothing is missing; a name "
                       "has a quarter of that chance. Between 0.001 and 0.3, "
                       "no unit.");
    parameters.declare(section + "Most effects",
                       "4",
                       Integer(1, 4),
                       "How many effects may be added, one after the other. 1 "
                       "to 4.");
    parameters.declare(section + "Most time",
                       "1 h",
                       Quantity(Dimension::time, 0., 1e9, true),
                       "Longest time of the search. When it is over, no more "
                       "effects are tried, fits end with their best values so "
                       "far, and the answer is what has been proven by then, "
                       "with a warning that says so; Ctrl-C does the same "
                       "once an effect is proven. The intervals of the "
                       "parameters found may take another half of that time; "
                       "those not followed by then are symmetric. More than "
                       "0, with its unit.");
    parameters.declare(section + "Draws",
                       "999",
                       Integer(99, 100000),
                       "Number of samples of noise from which chances are "
                       "estimated. 99 or more.");
    parameters.declare(section + "Seed",
                       "1",
                       Integer(0, 2147483646),
                       "Seed of these samples: the same seed gives the same "
                       "verdict, to the last digit. 0 to 2147483646.");
    parameters.declare(
      section + "Element tests",
      "worst",
      Anything(),
      "Tests that are simulated with finite elements before and after the "
      "search: 'worst', the test with the largest misfit before it, 'none', "
      "or names of tests or of their files, separated by commas.");
    declare_noise(parameters, "Gain", "0.005", "a test's gain");
    declare_noise(parameters, "Offset", "0.003", "a test's offset");
    declare_noise(parameters, "Slope", "0.002", "a straight drift of a test");
    declare_noise(parameters, "Drift", "0.005", "a random drift within a test");
    parameters.declare(section + "Drift time",
                       "0.1",
                       Quantity(Dimension::number, 0.001, 10.),
                       "Correlation time of the random drift, as a share of a "
                       "test's duration, as assumed before any replicates are "
                       "seen. Between 0.001 and 10, no unit.");
  }



  void check_diagnosis_parameters(const Parameters &parameters)
  {
    // p = 9 p_track, and no chance is below 1/(N + 1).
    const double least_draws =
      std::ceil(9. / parameters.number(section + "Level") - 1. - 1e-9);
    if (parameters.integer(section + "Draws") < least_draws)
      parameters.reject(section + "Draws",
                        "for an alarm at Diagnosis/Level = " +
                          parameters.text(section + "Level") + " at least " +
                          std::to_string(static_cast<long>(least_draws)) +
                          " are needed");
    const std::vector<std::string> known = candidate_names();
    const std::vector<std::string> list =
      parameters.list(section + "Candidates");
    if (list.empty())
      parameters.reject(section + "Candidates", "name effects, or 'all'");
    for (const std::string &name : list)
      if (std::count(list.begin(), list.end(), name) > 1)
        parameters.reject(section + "Candidates",
                          "'" + name + "' is given twice");
      else if (!holds(known, name) && !(name == "all" && list.size() == 1))
        {
          const std::string near = nearest_name(name, known);
          parameters.reject(section + "Candidates",
                            "there is no candidate '" + name + "'; " +
                              (name == "all" ? "'all' stands alone" :
                               near.empty()  ? "known are: " +
                                                boost::algorithm::join(known,
                                                                       ", ") :
                                              "did you mean '" + near + "'?"));
        }
  }



  std::chrono::steady_clock::time_point
  deadline_of(const Parameters &parameters, const double share)
  {
    return deadline_after(share * parameters.number(section + "Most time"));
  }
} // namespace SlipStep
