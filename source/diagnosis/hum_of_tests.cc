// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/hum_of_tests.h>

#include <slipstep/measured_data/test_rows.h>

#include <algorithm>
#include <cmath>

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
        for (std::size_t axis = 0; axis < (test.has_two_axes() ? 2 : 1); ++axis)
          {
            HumSeries series;
            series.time  = test.rows.time;
            series.level = typical_friction(test.rows);
            for (std::size_t i = 0; i < test.rows.time.size(); ++i)
              series.left.push_back(-test.noise * *row++);
            result.push_back(series);
          }
      return result;
    }
  } // namespace



  std::vector<CampaignTest> without_hum(const std::vector<CampaignTest> &tests,
                                        const Model                     &model)
  {
    const std::vector<Hum> hums = find_mains_hum(what_is_left(tests, model));
    if (hums.empty())
      return {};
    std::vector<CampaignTest> result = tests;
    auto                      hum    = hums.begin();
    for (CampaignTest &test : result)
      {
        for (auto *friction : {&test.rows.friction, &test.rows.friction_y})
          if (!friction->empty())
            {
              if (hum->is_told)
                for (std::size_t i = 0; i < friction->size(); ++i)
                  (*friction)[i] -=
                    hum->at(test.rows.time[i] - test.rows.time.front());
              test.hum.push_back(*hum++);
            }
        if (!test.noise_is_stated)
          test.noise = noise_of_friction(test.rows);
      }
    return result;
  }



  HumOfTests hum_of(const Comparison                &comparison,
                    const std::vector<CampaignTest> &tests)
  {
    HumOfTests          result;
    std::vector<double> frequencies, shares;
    for (std::size_t t = 0; t < tests.size(); ++t)
      {
        bool is_told = false;
        for (const Hum &hum : tests[t].hum)
          if (hum.is_told)
            {
              is_told = true;
              frequencies.push_back(hum.frequency);
              shares.push_back(hum.amplitude / comparison.tests[t].level);
            }
        result.n_told += is_told;
      }
    if (shares.empty())
      return result;
    result.frequency = median(std::move(frequencies));
    const auto [least, most] =
      std::minmax_element(shares.begin(), shares.end());
    result.least = *least;
    result.most  = *most;
    result.share = median(std::move(shares));
    return result;
  }
} // namespace SlipStep
