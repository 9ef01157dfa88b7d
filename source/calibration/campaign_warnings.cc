// SPDX-License-Identifier: LGPL-2.1-or-later

// What is unusual about the tests of a campaign, before anything is fitted.

#include <slipstep/calibration/campaign.h>
#include <slipstep/measured_data/stick_slip.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/text.h>

#include <boost/algorithm/string/erase.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace SlipStep
{
  namespace
  {
    // What is warned of, whatever the test and its numbers.
    std::string kind_of_warning(std::string text, const std::string &file)
    {
      boost::algorithm::erase_all(text, file);
      remove_erase_if(text, [](const char c) {
        return std::string("0123456789.e+-").find(c) != std::string::npos;
      });
      return text;
    }



    bool depends_on_position(const Parameters &parameters)
    {
      return find_effect(FrictionLaw(parameters).effects(),
                         [&](const EffectInfo &info) {
                           return info.heeds_position &&
                                  info.heeds_position(
                                    info.section_of(parameters));
                         }) != nullptr;
    }



    // Tests whose number the effect does not know, or takes for that of one of
    // its ends.
    std::string warning_of_order(const Parameters                &parameters,
                                 const std::vector<CampaignTest> &tests)
    {
      const EffectInfo *const effect =
        effect_of_order(FrictionLaw(parameters).effects());
      if (effect == nullptr)
        return "";
      const auto number = [&](const std::string &key) {
        return parameters.number(effect->section() + key);
      };
      const auto end = [&](const std::string &key) {
        return effect->section() + key + " = " +
               parameters.text(effect->section() + key);
      };
      std::size_t n_unknown = 0, n_beyond = 0;
      for (const CampaignTest &test : tests)
        if (const auto order = test.rows.order(); !order.has_value())
          ++n_unknown;
        else if (*order < number(effect->first_test) ||
                 *order > number(effect->last_test))
          ++n_beyond;
      std::string words;
      if (n_unknown > 0)
        words = std::to_string(n_unknown) +
                " of the tests do not say in which order they were made "
                "('# order: 7'), and are given " +
                end(effect->test_number);
      if (n_beyond > 0)
        words += (words.empty() ? "" : "; ") + std::to_string(n_beyond) +
                 " of the tests were made before " + end(effect->first_test) +
                 " or after " + end(effect->last_test) +
                 ", beyond which effect " + effect->name + " no longer changes";
      return words;
    }



    std::string and_so_in(const std::size_t n_others)
    {
      return n_others == 0 ?
               "" :
               " (and so in " + std::to_string(n_others) + " more)";
    }



    // A lead-in that ends before sliding has begun: of the first such test.
    std::string warning_of_lead_in(const Parameters                &parameters,
                                   const std::vector<CampaignTest> &tests)
    {
      const double lead_in = parameters.number("Calibration/Lead-in");
      if (!(lead_in > 0.))
        return "";
      const FrictionLaw law(parameters);
      const Machine     machine(parameters);
      const auto        give = [&](const CampaignTest &test) {
        return elastic_slip(std::abs(test.rows.friction.front()) *
                              test.rows.pressure.front(),
                            law,
                            machine);
      };
      std::vector<const CampaignTest *> early;
      for (const CampaignTest &test : tests)
        if (give(test) > lead_in)
          early.push_back(&test);
      if (early.empty())
        return "";
      return early.front()->rows.file.string() + ": Calibration/Lead-in = " +
             parameters.text("Calibration/Lead-in") +
             " ends before sliding has begun: contact and machine of the case "
             "deflect by " +
             rounded_text(give(*early.front()), 2) +
             " mm under the friction of the first row; a lead-in of twice "
             "that length would suffice" +
             and_so_in(early.size() - 1);
    }



    // Stick-slip on a spring that the case does not have.
    std::string warning_of_stick_slip(const Parameters &parameters,
                                      const std::vector<CampaignTest> &tests)
    {
      constexpr double alike = 1.5;

      const double of_case =
        1. / elastic_slip(1., FrictionLaw(parameters), Machine(parameters));
      std::string words;
      std::size_t n_others = 0;
      for (const CampaignTest &test : tests)
        {
          const FrictionAxis &axis = test.axes[0];
          const auto          found =
            find_stick_slip(along(axis, test.rows), axis.noise);
          if (!found.has_value() ||
              std::abs(std::log(found->stiffness / of_case)) < std::log(alike))
            continue;
          if (!words.empty())
            ++n_others;
          else
            words = test.rows.file.string() + ": friction drops suddenly " +
                    std::to_string(found->n_falls) +
                    " times, and rises in between as on a spring of " +
                    rounded_text(found->stiffness, 2) +
                    " MPa/mm: stick-slip of a machine other than the one in "
                    "the case, whose contact and machine together have " +
                    rounded_text(of_case, 2) +
                    " MPa/mm (Loading/Machine stiffness)";
        }
      return words + and_so_in(n_others);
    }



    std::string warning_of_rounding(const std::vector<CampaignTest> &tests)
    {
      std::size_t n    = 0;
      double      step = 0.;
      for (const CampaignTest &test : tests)
        {
          n += test.rounding.kept > 0.;
          step = std::max(step, test.rounding.step);
        }
      return n == 0 ?
               "" :
               "The friction of " + std::to_string(n) +
                 " test(s) is rounded to steps of " + short_text(step, 2) +
                 ", coarser than its scatter: means of rows are off by up to "
                 "half a step, and differences that rounding may have made "
                 "are no evidence. Export more digits";
    }



    // Results are told by the names of tests.
    std::string warning_of_names(const std::vector<CampaignTest> &tests)
    {
      std::map<std::string, std::string> files;
      for (const CampaignTest &test : tests)
        {
          const auto [known, is_new] =
            files.emplace(test.rows.name, test.rows.file.string());
          if (!is_new)
            return known->second + " and " + test.rows.file.string() +
                   " have the same name, '" + test.rows.name +
                   "': their results cannot be told apart (change "
                   "'# name: ...' or the name of the file)";
        }
      return "";
    }
  } // namespace



  std::vector<std::string> Campaign::warnings() const
  {
    constexpr std::size_t most_alike = 3;

    std::vector<std::string>                        result;
    std::map<std::string, std::vector<std::string>> alike;
    for (const CampaignTest &test : tests)
      for (const std::string &warning : test.rows.warnings)
        {
          auto &others =
            alike[kind_of_warning(warning, test.rows.file.string())];
          others.push_back(warning);
          if (others.size() <= most_alike)
            result.push_back(warning);
        }
    for (const auto &[kind, warnings] : alike)
      if (warnings.size() > most_alike)
        *std::find(result.begin(), result.end(), warnings[most_alike - 1]) +=
          and_so_in(warnings.size() - most_alike);
    for (const std::string &words :
         {warning_of_order(parameters, tests),
          warning_of_lead_in(parameters, tests),
          warning_of_stick_slip(parameters, tests),
          warning_of_names(tests),
          warning_of_rounding(tests),
          depends_on_position(parameters) ? warning_of_positions(tests) :
                                            std::string()})
      if (!words.empty())
        result.push_back(words);
    return result;
  }



  std::string warning_of_positions(const std::vector<CampaignTest> &tests)
  {
    constexpr double share = 1e-3;

    using Series = std::vector<double> MeasuredTest::*;
    constexpr std::array<Series, 2>    axes = {
         {&MeasuredTest::displacement, &MeasuredTest::displacement_y}};
    std::array<std::array<double, 2>, 2> first{}; // of an axis, least and most
    double                               longest  = 0.;
    bool                                 is_first = true;
    for (const CampaignTest &test : tests)
      {
        for (std::size_t axis = 0; axis < axes.size(); ++axis)
          {
            const std::vector<double> &x     = test.rows.*axes[axis];
            const double               start = x.empty() ? 0. : x.front();
            auto &[least, most]              = first[axis];
            least = is_first ? start : std::min(least, start);
            most  = is_first ? start : std::max(most, start);
            if (x.empty())
              continue;
            const auto [low, high] = std::minmax_element(x.begin(), x.end());
            longest                = std::max(longest, *high - *low);
          }
        is_first = false;
      }
    const bool is_second =
      first[1][1] - first[1][0] > first[0][1] - first[0][0];
    const auto [least, most] = first[is_second ? 1 : 0];
    if (!(most - least > share * longest))
      return "";
    return "Tests begin at different positions, from " +
           rounded_text(least, 4) + " to " + rounded_text(most, 4) +
           " mm; effects that depend on the position count from where each "
           "test begins, so that a wave along one track does not have the "
           "same phase in all of them: let every test begin at the same place";
  }
} // namespace SlipStep
