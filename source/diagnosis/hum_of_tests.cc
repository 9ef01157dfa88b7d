// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/hum_of_tests.h>

#include <slipstep/measured_data/test_rows.h>
#include <slipstep/measured_data/test_set.h>
#include <slipstep/utilities/text.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace SlipStep
{
  namespace
  {
    std::vector<HumSeries> what_is_left(const std::vector<CampaignTest> &tests,
                                        const Model                     &model)
    {
      std::vector<double> weighted(model.campaign->n_residuals());
      model.simulator->residuals(model.scaled, weighted.data());
      std::vector<HumSeries> result;
      const double          *row = weighted.data();
      for (const CampaignTest &test : tests)
        for (const FrictionAxis &axis : test.axes)
          {
            HumSeries series;
            series.time  = test.rows.time;
            series.level = typical_friction(test.rows);
            series.speed = mean_speed(test.rows);
            for (const double friction : test.friction(axis))
              {
                series.left.push_back(-axis.noise * *row++);
                series.friction.push_back(friction - series.left.back());
              }
            result.push_back(series);
          }
      return result;
    }



    // One series less another, whose rows may be at other times.
    HumSeries difference_of(const HumSeries &one, const HumSeries &other)
    {
      HumSeries                      result = one;
      const std::vector<std::size_t> rows   = partners(one.time, other.time);
      for (std::size_t i = 0; i < rows.size(); ++i)
        result.left[i] -= other.left[rows[i]];
      return result;
    }



    // Of tests of the same condition and duration, two and two.
    std::vector<HumSeries>
    differences_of_replicates(const std::vector<CampaignTest> &tests,
                              const std::vector<HumSeries>    &left)
    {
      constexpr double alike = 0.02;

      using Key = std::pair<std::string, std::size_t>;
      std::map<Key, std::vector<const HumSeries *>> waiting;
      std::vector<HumSeries>                        result;
      const auto duration = [](const HumSeries &series) {
        return series.time.back() - series.time.front();
      };
      auto own = left.begin();
      for (const CampaignTest &test : tests)
        for (std::size_t axis = 0; axis < test.axes.size(); ++axis, ++own)
          {
            if (test.rows.condition.empty())
              continue;
            auto      &others = waiting[{test.rows.condition, axis}];
            const auto twin   = std::find_if(
              others.begin(), others.end(), [&](const HumSeries *other) {
                return std::abs(duration(*own) - duration(*other)) <=
                       alike * duration(*other);
              });
            if (twin == others.end())
              others.push_back(&*own);
            else
              {
                result.push_back(difference_of(**twin, *own));
                others.erase(twin);
              }
          }
      return result;
    }
  } // namespace



  std::vector<CampaignTest> without_hum(const std::vector<CampaignTest> &tests,
                                        const Model                     &model,
                                        std::string                     &doubt)
  {
    const std::vector<HumSeries> left         = what_is_left(tests, model);
    std::vector<Hum>             hums         = find_mains_hum(left);
    double                       at_one_speed = 0.;
    if (hums.empty())
      hums = find_hum_of_replicates(differences_of_replicates(tests, left),
                                    left,
                                    at_one_speed);
    if (hums.empty() && at_one_speed > 0.)
      doubt = "Replicates differ by a wave of " +
              rounded_text(at_one_speed, 2) +
              " Hz, at one speed only: hum of a recorder, or mains hum "
              "sampled nearly in step with it, or a wave along a track that "
              "each of them begins at another place. It is not removed: the "
              "waves along the track that are reported may be this one, and "
              "tests at another speed would tell.";
    if (hums.empty())
      return {};
    std::vector<CampaignTest> result = tests;
    auto                      hum    = hums.begin();
    for (CampaignTest &test : result)
      {
        for (FrictionAxis &axis : test.axes)
          {
            // What that made of it before counts as well for what is left.
            const auto noise = [&]() {
              return noise_of_friction(test.friction(axis), test.rows);
            };
            const double before = noise();
            if (hum->is_told)
              for (std::size_t i = 0; i < test.rows.time.size(); ++i)
                {
                  const double value =
                    hum->at(test.rows.time[i] - test.rows.time.front());
                  test.rows.friction[i] -= axis.cosine * value;
                  if (!test.rows.friction_y.empty())
                    test.rows.friction_y[i] -= axis.sine * value;
                }
            test.hum.push_back(*hum++);
            const double after = noise();
            if (!test.noise_is_stated && after > 0. && after < before)
              axis.noise *= after / before;
          }
      }
    return result;
  }



  HumOfTests hum_of(const Comparison                &comparison,
                    const std::vector<CampaignTest> &tests)
  {
    HumOfTests          result;
    std::vector<double> frequencies, shares;
    bool                is_mains = false;
    for (std::size_t t = 0; t < tests.size(); ++t)
      {
        bool is_told = false;
        for (const Hum &hum : tests[t].hum)
          if (hum.is_told)
            {
              is_told  = true;
              is_mains = hum.mains > 0.;
              frequencies.push_back(is_mains ? hum.mains : hum.frequency);
              shares.push_back(hum.amplitude / comparison.tests[t].level);
            }
        result.n_told += is_told;
      }
    if (shares.empty())
      return result;
    result.is_mains  = is_mains;
    result.frequency = median(std::move(frequencies));
    result.share     = median(std::move(shares));
    return result;
  }
} // namespace SlipStep
