// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/measured_data/resample.h>

#include <slipstep/measured_data/test_rows.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace SlipStep
{
  namespace
  {
    // The row between two others that is farthest from the line between them,
    // and how many tolerances that is.
    std::pair<std::size_t, double>
    farthest_row(const std::vector<double>         &time,
                 const std::vector<BendingChannel> &series,
                 const std::size_t                  begin,
                 const std::size_t                  end)
    {
      std::pair<std::size_t, double> result{begin, 0.};
      for (const BendingChannel &one : series)
        {
          const std::vector<double> &values = *one.values;
          if (one.tolerance == 0.)
            continue;
          const double slope =
            (values[end] - values[begin]) / (time[end] - time[begin]);
          for (std::size_t i = begin + 1; i < end; ++i)
            {
              const double distance =
                std::abs(values[i] - values[begin] -
                         slope * (time[i] - time[begin])) /
                one.tolerance;
              if (distance > result.second)
                result = {i, distance};
            }
        }
      return result;
    }

    /// A displacement trembles at least by this share of its range without
    /// turning.
    constexpr double least_stroke = 0.005;

    /// Friction follows the direction of motion: a chord that leaves an arc by
    /// 1e-3 of its width is off by up to 4 degrees, by this share of that by a
    /// quarter of one.
    constexpr double share_on_curves = 0.004;

    /// Chooses the rows to keep.
    class Selection
    {
    public:
      Selection(const MeasuredTest &test, const ResampleOptions &options)
        : test(test)
        , options(options)
      {
        const bool is_curved = !test.displacement_y.empty() &&
                               std::min(range_of(test.displacement),
                                        range_of(test.displacement_y)) > 0.;
        for (const Channel *channel : filled_channels(test))
          {
            const std::vector<double> &values = test.*(channel->values);
            if (channel->name == "time")
              continue;
            // What counts of a pressure is its share, however steady it is.
            const double extent =
              channel->name == "pressure" ?
                *std::max_element(values.begin(), values.end()) :
                range_of(values);
            const bool is_on_curve =
              is_curved && channel->name.rfind("displacement", 0) == 0;
            series.push_back(
              {&values,
               std::max(options.noise_multiple * noise_level(values),
                        options.least_share *
                          (is_on_curve ? share_on_curves : 1.) * extent)});
          }
        keep_landmarks();
      }

      /// @param factor on all tolerances
      std::vector<std::size_t> rows(const double factor) const
      {
        return rows_of_bends(test.time,
                             series,
                             {landmarks.begin(), landmarks.end()},
                             factor);
      }

      double tolerance(const std::vector<double> &values) const
      {
        for (const BendingChannel &one : series)
          if (one.values == &values)
            return one.tolerance;
        return 0.;
      }

    private:
      // A stroke ends at the farthest point before the displacement turns.
      void keep_landmarks()
      {
        const std::size_t n = test.time.size();
        landmarks           = {0, n - 1};
        keep_extremes_of_friction(0, n);
        keep_rests();

        for (const auto *position : {&test.displacement, &test.displacement_y})
          if (!position->empty())
            {
              const double band  = std::max(least_stroke * range_of(*position),
                                           tolerance(*position));
              std::size_t  start = 0;
              for (const std::size_t turn : turning_rows(*position, band))
                {
                  landmarks.insert(turn);
                  keep_extremes_of_friction(start, turn + 1);
                  start = turn;
                }
              keep_extremes_of_friction(start, n);
            }
      }

      // Friction answers to motion within micrometres, far less than what a
      // position may be off: where rests begin and end is kept. Of positions
      // that tremble or are rounded that is not known to the row, and only when
      // motion begins is.
      void keep_rests()
      {
        constexpr double      steady = 1e-4; // of the track
        constexpr std::size_t most   = 40;   // more are stairs

        const std::size_t n = test.time.size();
        const double      track =
          std::max(range_of(test.displacement), range_of(test.displacement_y));
        bool is_precise = options.motion_step == 0.;
        for (const auto *position : {&test.displacement, &test.displacement_y})
          is_precise =
            is_precise &&
            (position->empty() ||
             options.noise_multiple * noise_level(*position) <= steady * track);
        std::vector<bool> moves(n, false);
        for (const auto *position : {&test.displacement, &test.displacement_y})
          if (!position->empty() && range_of(*position) > 0.)
            {
              const double band =
                is_precise ? options.noise_multiple * noise_level(*position) :
                             std::max(least_stroke * range_of(*position),
                                      tolerance(*position));
              const std::vector<double> smooth =
                without_jitter(*position, band);
              for (std::size_t i = 1; i < n; ++i)
                moves[i] = moves[i] || smooth[i] != smooth[i - 1];
            }
        std::vector<std::size_t> ends;
        for (std::size_t i = 1; i < n; ++i)
          if (moves[i] != moves[i - 1])
            ends.push_back(i - 1);
        if (ends.empty())
          return;
        landmarks.insert(ends.front());
        if (is_precise && ends.size() <= most)
          landmarks.insert(ends.begin(), ends.end());
      }

      void keep_extremes_of_friction(const std::size_t begin,
                                     const std::size_t end)
      {
        const auto [least, most] =
          std::minmax_element(test.friction.begin() + begin,
                              test.friction.begin() + end);
        landmarks.insert(least - test.friction.begin());
        landmarks.insert(most - test.friction.begin());
      }


      const MeasuredTest         &test;
      const ResampleOptions       options;
      std::vector<BendingChannel> series;
      std::set<std::size_t>       landmarks;
    };
  } // namespace



  std::vector<std::size_t>
  rows_of_bends(const std::vector<double>         &time,
                const std::vector<BendingChannel> &series,
                std::vector<std::size_t>           rows,
                const double                       factor)
  {
    std::vector<std::pair<std::size_t, std::size_t>> open;
    for (std::size_t i = 1; i < rows.size(); ++i)
      open.emplace_back(rows[i - 1], rows[i]);
    while (!open.empty())
      {
        const auto [begin, end] = open.back();
        open.pop_back();
        const auto [row, distance] = farthest_row(time, series, begin, end);
        if (distance <= factor)
          continue;
        rows.push_back(row);
        open.emplace_back(begin, row);
        open.emplace_back(row, end);
      }
    std::sort(rows.begin(), rows.end());
    return rows;
  }



  ResampledTest resample(const MeasuredTest    &test,
                         const ResampleOptions &options)
  {
    const Selection selection(test, options);
    ResampledTest   result;
    double          factor = 1.;
    result.rows            = selection.rows(factor);
    // 1.25^60 tolerances are more than any range.
    for (unsigned int i = 0; i < 60 && result.rows.size() > options.most_rows;
         ++i)
      {
        factor *= 1.25;
        result.rows = selection.rows(factor);
      }

    result.displacement_tolerance =
      factor * selection.tolerance(test.displacement);
    result.pressure_tolerance = factor * selection.tolerance(test.pressure);
    result.friction_tolerance = factor * selection.tolerance(test.friction);
    result.test               = test;
    keep_rows(result.test, result.rows);
    return result;
  }



  double frictional_work(const MeasuredTest &test)
  {
    double     work = 0.;
    const auto add  = [&](const std::vector<double> &displacement,
                         const std::vector<double> &friction) {
      for (std::size_t i = 1; i < displacement.size() && i < friction.size();
           ++i)
        work += 0.5 *
                (friction[i] * test.pressure[i] +
                 friction[i - 1] * test.pressure[i - 1]) *
                (displacement[i] - displacement[i - 1]);
    };
    add(test.displacement, test.friction);
    add(test.displacement_y, test.friction_y);
    return work;
  }
} // namespace SlipStep
