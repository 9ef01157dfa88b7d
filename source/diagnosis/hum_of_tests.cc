// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/hum_of_tests.h>

#include <slipstep/measured_data/test_rows.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace SlipStep
{
  namespace
  {
    double mean_speed(const MeasuredTest &rows)
    {
      double way = 0.;
      for (std::size_t i = 1; i < rows.time.size(); ++i)
        way +=
          std::hypot(rows.displacement[i] - rows.displacement[i - 1],
                     rows.displacement_y.empty() ?
                       0. :
                       rows.displacement_y[i] - rows.displacement_y[i - 1]);
      return way / (rows.time.back() - rows.time.front());
    }



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
            series.speed = mean_speed(test.rows);
            for (std::size_t i = 0; i < test.rows.time.size(); ++i)
              series.left.push_back(-test.noise * *row++);
            result.push_back(series);
          }
      return result;
    }
  } // namespace



  namespace
  {
    // Of tests of the same condition and duration, two and two.
    std::vector<HumSeries>
    differences_of_replicates(const std::vector<CampaignTest> &tests,
                              const std::vector<HumSeries>    &left)
    {
      constexpr double alike = 0.02;

      std::map<std::pair<std::string, std::size_t>, const HumSeries *> waiting;
      std::vector<HumSeries>                                           result;
      auto own = left.begin();
      for (const CampaignTest &test : tests)
        for (std::size_t axis = 0; axis < (test.has_two_axes() ? 2 : 1);
             ++axis, ++own)
          {
            if (test.rows.condition.empty())
              continue;
            const HumSeries *&other = waiting[{test.rows.condition, axis}];
            if (other == nullptr)
              {
                other = &*own;
                continue;
              }
            HumSeries    difference = *other;
            const double length =
              difference.time.back() - difference.time.front();
            if (std::abs(own->time.back() - own->time.front() - length) >
                alike * length)
              continue;
            const std::vector<std::size_t> rows =
              partners(difference.time, own->time);
            for (std::size_t i = 0; i < rows.size(); ++i)
              difference.left[i] -= own->left[rows[i]];
            result.push_back(difference);
            other = nullptr;
          }
      return result;
    }
  } // namespace



  std::vector<CampaignTest> without_hum(const std::vector<CampaignTest> &tests,
                                        const Model                     &model)
  {
    const std::vector<HumSeries> left = what_is_left(tests, model);
    std::vector<Hum>             hums = find_mains_hum(left);
    if (hums.empty())
      hums =
        find_hum_of_replicates(differences_of_replicates(tests, left), left);
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
