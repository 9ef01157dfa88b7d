// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/calibration/fit_coordinates.h>
#include <slipstep/diagnosis/comparison.h>
#include <slipstep/diagnosis/least_squares.h>
#include <slipstep/measured_data/test_rows.h>
#include <slipstep/utilities/exceptions.h>

#include <boost/math/constants/constants.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <map>

namespace SlipStep
{
  namespace
  {
    std::vector<std::size_t> equal_parts(const std::size_t n_rows,
                                         const std::size_t most)
    {
      const std::size_t        n = std::min(n_rows, most);
      std::vector<std::size_t> borders;
      for (std::size_t i = 0; i <= n; ++i)
        borders.push_back(i * n_rows / n);
      return borders;
    }



    // Means of what stands at the rows between the borders.
    template <class RowValue>
    void average(const std::vector<std::size_t> &borders,
                 const RowValue                 &value,
                 double                         *result)
    {
      for (std::size_t i = 0; i + 1 < borders.size(); ++i)
        {
          double sum = 0.;
          for (std::size_t row = borders[i]; row < borders[i + 1]; ++row)
            sum += value(row);
          result[i] = sum / (borders[i + 1] - borders[i]);
        }
    }



    Series series_of(const ComparedTest &compared,
                     const CampaignTest &test,
                     const FrictionAxis &axis)
    {
      const std::vector<double> &time   = test.rows.time;
      const std::size_t          n_bins = compared.n_bins();
      Series                     series;
      series.time.resize(n_bins);
      average(
        compared.borders,
        [&](const std::size_t row) {
          return (time[row] - time.front()) / (time.back() - time.front());
        },
        series.time.data());
      for (std::size_t i = 0; i < n_bins; ++i)
        series.row_noise.push_back(
          axis.noise / std::sqrt(static_cast<double>(compared.borders[i + 1] -
                                                     compared.borders[i])));
      series.friction.resize(n_bins);
      // Estimates of sensors that are alike differ, too.
      constexpr double alike   = 0.7;
      double           largest = 0.;
      for (const FrictionAxis &other : test.axes)
        largest = std::max(largest, other.noise);
      if (axis.noise < alike * largest)
        series.noise_share = axis.noise / largest;
      return series;
    }



    // What was taken off is known to the noise only, and where a hum is as slow
    // as friction nothing was.
    void add_hum(const Hum                      &hum,
                 const std::vector<double>      &time,
                 const std::vector<std::size_t> &borders,
                 Series                         &series)
    {
      for (const double quarter : {0., 0.25})
        {
          // Of a phase that may be any the cosine and the sine have half of the
          // variance each.
          Hum wave = hum;
          wave.amplitude *= std::sqrt(0.5);
          wave.phase = boost::math::constants::two_pi<double>() * quarter;
          std::vector<double> means(series.time.size());
          average(
            borders,
            [&](const std::size_t row) {
              return wave.at(time[row] - time.front());
            },
            means.data());
          series.hum.push_back(means);
        }
    }
  } // namespace



  Comparison::Comparison(const std::vector<CampaignTest> &campaign_tests,
                         const std::size_t                most_rows)
  {
    std::map<std::pair<std::string, std::size_t>, std::size_t> number;
    Eigen::Index                                               n = 0;
    for (const CampaignTest &test : campaign_tests)
      {
        ComparedTest compared;
        compared.borders  = equal_parts(test.rows.time.size(), most_rows);
        compared.level    = typical_friction(test.rows);
        compared.begin    = n;
        compared.rounding = test.rounding;
        for (const FrictionAxis &axis : test.axes)
          compared.series.push_back(series_of(compared, test, axis));
        for (std::size_t s = 0; s < test.hum.size(); ++s)
          add_hum(test.hum[s],
                  test.rows.time,
                  compared.borders,
                  compared.series[s]);
        compared.size = compared.series.size() * compared.n_bins();
        n += compared.size;
        // A test that names no condition is one by itself.
        const std::string condition = test.rows.condition.empty() ?
                                        "test " + test.rows.name :
                                        test.rows.condition;
        const auto        found =
          number.emplace(std::make_pair(condition, test.axes.size()),
                         number.size());
        if (found.second)
          conditions.push_back(condition);
        compared.condition = found.first->second;
        tests.push_back(compared);
      }
    find_durations(campaign_tests);
    counts.setOnes(n);
    measured = means_of(campaign_tests);
  }



  Eigen::VectorXd
  Comparison::means_of(const std::vector<CampaignTest> &campaign_tests) const
  {
    Eigen::VectorXd result(counts.size());
    for (std::size_t i = 0; i < tests.size(); ++i)
      {
        double *out = result.data() + tests[i].begin;
        for (const FrictionAxis &axis : campaign_tests[i].axes)
          {
            const std::vector<double> friction =
              campaign_tests[i].friction(axis);
            average(
              tests[i].borders,
              [&](const std::size_t row) { return friction[row]; },
              out);
            out += tests[i].n_bins();
          }
      }
    return result;
  }



  // Against the geometric mean.
  void
  Comparison::find_durations(const std::vector<CampaignTest> &campaign_tests)
  {
    const auto duration = [&](const std::size_t i) {
      const std::vector<double> &time = campaign_tests[i].rows.time;
      return time.back() - time.front();
    };
    double sum = 0.;
    for (std::size_t i = 0; i < tests.size(); ++i)
      sum += std::log(duration(i));
    usual_duration = tests.empty() ? 1. : std::exp(sum / tests.size());
    for (std::size_t i = 0; i < tests.size(); ++i)
      for (Series &series : tests[i].series)
        series.duration = duration(i) / usual_duration;
  }



  void Comparison::set_row_noise(const std::size_t test,
                                 const std::size_t axis,
                                 const RowNoise   &noise)
  {
    const std::vector<std::size_t> &borders = tests[test].borders;
    const double                    usual =
      static_cast<double>(borders.back()) / tests[test].n_bins();
    // Means of rows that hang together do so less, and more like an
    // autoregression the longer they are.
    const double variance   = noise.variance_of_mean(usual);
    const double covariance = noise.covariance_of_means(usual);
    const double power      = std::pow(noise.decay, usual);
    const bool   has_white  = covariance < power * variance;
    Series      &series     = tests[test].series[axis];
    series.row_decay        = has_white ? power : covariance / variance;
    series.row_share        = noise.share == 0. ? 0. :
                              has_white ? covariance / (power * variance) :
                                          1.;
    for (std::size_t i = 0; i < series.row_noise.size(); ++i)
      series.row_noise[i] =
        std::sqrt(noise.variance_of_mean(borders[i + 1] - borders[i]));
  }



  void Comparison::weaken_row(const Eigen::Index row, const double factor)
  {
    counts(row) = 0.;
    for (ComparedTest &test : tests)
      if (test.has_row(row))
        {
          const Eigen::Index n_bins = test.n_bins();
          test.series[(row - test.begin) / n_bins]
            .row_noise[(row - test.begin) % n_bins] *= factor;
        }
  }



  void Comparison::set_noise(const Noise           &noise,
                             const Eigen::VectorXd &friction)
  {
    present_noise = noise;
    whiteners.clear();
    for (ComparedTest &test : tests)
      {
        const double *value = friction.data() + test.begin;
        for (Series &series : test.series)
          for (double &entry : series.friction)
            entry = *value++;
        whiteners.emplace_back(test.series, test.level, noise);
      }
  }



  Eigen::VectorXd
  Comparison::difference(Simulator                 &simulator,
                         const std::vector<double> &scaled) const
  {
    const Campaign &campaign = simulator.campaign;
    const auto      rows     = if_possible([&]() {
      std::vector<double> residuals(campaign.n_residuals());
      simulator.residuals(scaled, residuals.data());
      return residuals;
    });
    if (rows.empty())
      return {};
    Eigen::VectorXd result(n_rows());
    const double   *begin = rows.data();
    for (std::size_t i = 0; i < tests.size(); ++i)
      {
        double             *out  = result.data() + tests[i].begin;
        const CampaignTest &test = campaign.tests[i];
        for (const FrictionAxis &axis : test.axes)
          {
            average(
              tests[i].borders,
              [&](const std::size_t row) { return axis.noise * begin[row]; },
              out);
            out += tests[i].n_bins();
            begin += test.rows.time.size();
          }
      }
    return result;
  }



  void Comparison::whiten(RowMatrix &columns) const
  {
    for (std::size_t i = 0; i < tests.size(); ++i)
      whiteners[i].apply(columns.middleRows(tests[i].begin, tests[i].size));
  }



  double natural_slope(const FitParameter &parameter, const double scaled)
  {
    if (parameter.is_logarithmic)
      return std::log(parameter.upper / parameter.lower);
    const double range = parameter.upper - parameter.lower;
    const double value = parameter.from_scaled(scaled);
    return parameter.lower >= 0. ? range / std::max(value, 0.01 * range) : 2.;
  }



  namespace
  {
    /// Differences of one model, whitened; below them how far each parameter
    /// is from its start, in case the tests say nothing of it.
    class WhitenedProblem
    {
    public:
      WhitenedProblem(const Comparison        &comparison,
                      Model                   &model,
                      const std::vector<bool> &left_out)
        : comparison(comparison)
        , model(model)
        , left_out(left_out)
      {
        for (std::size_t i = 0; i < model.scaled.size(); ++i)
          {
            const FitParameter &parameter = model.campaign->fitted[i];
            start.push_back(parameter.to_scaled(parameter.start));
            belief.push_back(model.owner_of(parameter.path) != nullptr ?
                               1. / believed_share :
                               natural_slope(parameter, start.back()) /
                                 believed_deviation);
          }
      }

      bool residuals(const std::vector<double> &scaled, Eigen::VectorXd &result)
      {
        simulate(scaled);
        if (last_difference.size() == 0)
          return false;
        RowMatrix whitened = last_difference;
        comparison.whiten(whitened);
        leave_out(whitened);
        result.resize(whitened.rows() + scaled.size());
        result.head(whitened.rows()) = whitened;
        for (std::size_t i = 0; i < scaled.size(); ++i)
          result(whitened.rows() + i) = belief[i] * (scaled[i] - start[i]);
        return true;
      }

      bool derivatives(const std::vector<double> &scaled,
                       Eigen::MatrixXd           &result)
      {
        constexpr double step = 1e-4;
        simulate(scaled);
        const Eigen::VectorXd &here  = last_difference;
        std::vector<double>    other = scaled;
        if (here.size() == 0)
          return false;
        RowMatrix columns(here.size(), scaled.size());
        for (std::size_t i = 0; i < scaled.size(); ++i)
          {
            double          moved = scaled[i] + step > 1. ? -step : step;
            Eigen::VectorXd there;
            for (unsigned int side = 0; side < 2 && there.size() == 0; ++side)
              {
                if (side == 1)
                  moved = -moved;
                other[i] = scaled[i] + moved;
                there    = comparison.difference(*model.simulator, other);
              }
            other[i] = scaled[i];
            if (there.size() == 0)
              return false;
            columns.col(i) = (there - here) / moved;
          }
        comparison.whiten(columns);
        leave_out(columns);
        result =
          Eigen::MatrixXd::Zero(columns.rows() + scaled.size(), scaled.size());
        result.topRows(columns.rows()) = columns;
        for (std::size_t i = 0; i < scaled.size(); ++i)
          result(columns.rows() + i, i) = belief[i];
        return true;
      }

    private:
      // At one point it is done once.
      void simulate(const std::vector<double> &scaled)
      {
        if (scaled == last_scaled && last_difference.size() > 0)
          return;
        last_scaled     = scaled;
        last_difference = comparison.difference(*model.simulator, scaled);
      }

      // Standard deviation of the logarithm of a parameter of the starting
      // model around its start.
      static constexpr double believed_deviation = 2.;

      // Of a parameter of what was added, as a share of its bounds: it starts
      // at a first guess, of which nothing is believed.
      static constexpr double believed_share = 0.5;

      void leave_out(RowMatrix &columns) const
      {
        for (std::size_t i = 0; i < left_out.size(); ++i)
          if (left_out[i])
            columns
              .middleRows(comparison.tests[i].begin, comparison.tests[i].size)
              .setZero();
      }

      const Comparison        &comparison;
      Model                   &model;
      const std::vector<bool> &left_out;
      std::vector<double>      start, belief;
      std::vector<double>      last_scaled;
      Eigen::VectorXd          last_difference;
    };
  } // namespace



  bool Comparison::fit(Model                   &model,
                       const FitEnd            &end,
                       const std::vector<bool> &left_out,
                       const std::vector<bool> &held) const
  {
    std::vector<unsigned int> free;
    for (std::size_t i = 0; i < model.scaled.size(); ++i)
      if (held.empty() || !held[i])
        free.push_back(i);
    const FitCoordinates  coordinates(*model.campaign, model.scaled, free);
    const Eigen::VectorXd start = coordinates.of(model.scaled);
    model.scaled                = coordinates.scaled(start);
    WhitenedProblem problem(*this, model, left_out);
    SquaresProblem  squares;
    squares.residuals = [&](const Eigen::VectorXd &x,
                            Eigen::VectorXd       &residuals) {
      return problem.residuals(coordinates.scaled(x), residuals);
    };
    squares.derivatives = [&](const Eigen::VectorXd &x,
                              Eigen::MatrixXd       &derivatives) {
      if (!problem.derivatives(coordinates.scaled(x), derivatives))
        return false;
      derivatives *= coordinates.jacobian(x);
      return true;
    };
    squares.deadline = deadline;
    squares.goal     = end.goal;
    const SquaresMinimum minimum =
      least_squares(squares, start, end.precision, held);
    model.objective =
      minimum.found ? minimum.sum : std::numeric_limits<double>::infinity();
    if (!minimum.found)
      return false;
    model.scaled   = coordinates.scaled(minimum.x);
    model.residual = -minimum.residuals;
    model.derivatives =
      minimum.derivatives * coordinates.jacobian(minimum.x).inverse();
    return true;
  }



  std::vector<double>
  Comparison::squares_by_test(const Eigen::VectorXd &residual) const
  {
    std::vector<double> result;
    for (const ComparedTest &test : tests)
      result.push_back(residual.segment(test.begin, test.size).squaredNorm());
    return result;
  }



  std::vector<std::size_t> partners(const std::vector<double> &time,
                                    const std::vector<double> &other)
  {
    std::vector<std::size_t> result;
    std::size_t              j = 0;
    for (const double t : time)
      {
        while (j + 1 < other.size() &&
               std::abs(other[j + 1] - t) <= std::abs(other[j] - t))
          ++j;
        result.push_back(j);
      }
    return result;
  }



  namespace
  {
    // The n-th of the contrasts by Helmert: one test against the mean of those
    // before it, of length one.
    Contrast helmert(const std::vector<ComparedTest> &tests,
                     const std::vector<std::size_t>  &members,
                     const std::size_t                n,
                     const Eigen::VectorXd           &difference)
    {
      const ComparedTest &first = tests[members[0]];
      Contrast            result;
      result.series = first.series;
      result.level  = first.level;
      result.values = Eigen::VectorXd::Zero(first.size);
      result.tests.assign(members.begin(), members.begin() + n + 1);
      const double length = std::sqrt(n * (n + 1.));
      for (Series &series : result.series)
        std::fill(series.row_noise.begin(), series.row_noise.end(), 0.);
      for (std::size_t m = 0; m <= n; ++m)
        {
          const ComparedTest &test   = tests[members[m]];
          const double        weight = (m < n ? 1. : -1. * n) / length;
          const std::vector<std::size_t> rows =
            partners(first.series[0].time, test.series[0].time);
          for (std::size_t s = 0;
               s < std::min(first.series.size(), test.series.size());
               ++s)
            for (std::size_t i = 0; i < rows.size(); ++i)
              {
                result.values(s * rows.size() + i) -=
                  weight * difference(test.begin + s * test.n_bins() + rows[i]);
                result.series[s].row_noise[i] +=
                  std::pow(weight * test.series[s].row_noise[rows[i]], 2);
              }
        }
      for (Series &series : result.series)
        for (double &noise : series.row_noise)
          noise = std::sqrt(noise);
      return result;
    }



    // Of all numbers those along one axis of a test.
    std::vector<double> along(const ComparedTest    &test,
                              const std::size_t      axis,
                              const Eigen::VectorXd &values)
    {
      const double *const first =
        values.data() + test.begin + axis * test.n_bins();
      return std::vector<double>(first, first + test.n_bins());
    }
  } // namespace



  std::vector<Eigen::Index> Comparison::spikes_of_records() const
  {
    std::vector<Eigen::Index> result;
    for (const ComparedTest &test : tests)
      for (std::size_t s = 0; s < test.series.size(); ++s)
        {
          const std::vector<bool> is_spike = spikes(along(test, s, measured));
          for (std::size_t bin = 0; bin < is_spike.size(); ++bin)
            if (is_spike[bin])
              result.push_back(test.begin + s * test.n_bins() + bin);
        }
    return result;
  }



  std::vector<Contrast>
  Comparison::contrasts(const Eigen::VectorXd &difference) const
  {
    // Where one of the tests has a spike they do not differ by noise.
    Eigen::VectorXd left_over = difference, recorded = -measured;
    for (const ComparedTest &test : tests)
      for (std::size_t s = 0; s < test.series.size(); ++s)
        {
          const std::vector<bool> is_spike = spikes(along(test, s, measured));
          for (Eigen::VectorXd *const values : {&left_over, &recorded})
            {
              std::vector<double> without = along(test, s, *values);
              bridge(is_spike, without);
              std::copy(without.begin(),
                        without.end(),
                        values->data() + test.begin + s * test.n_bins());
            }
        }
    std::vector<Contrast> result;
    for (std::size_t c = 0; c < conditions.size(); ++c)
      {
        std::vector<std::size_t> members;
        for (std::size_t i = 0; i < tests.size(); ++i)
          if (tests[i].condition == c)
            members.push_back(i);
        for (std::size_t n = 1; n < members.size(); ++n)
          {
            const Contrast left = helmert(tests, members, n, left_over);
            const Contrast raw  = helmert(tests, members, n, recorded);
            result.push_back(left.values.norm() < raw.values.norm() ? left :
                                                                      raw);
          }
      }
    return result;
  }



  double relative_rms(const Comparison      &comparison,
                      const Eigen::VectorXd &difference)
  {
    double sum = 0., n = 0.;
    for (const ComparedTest &test : comparison.tests)
      {
        const auto counts = comparison.counts.segment(test.begin, test.size);
        sum += difference.segment(test.begin, test.size)
                 .cwiseProduct(counts)
                 .squaredNorm() /
               (test.level * test.level);
        n += counts.sum() / test.series.size();
      }
    return std::sqrt(sum / n);
  }



  double relative_rms(const Comparison &comparison, const Model &model)
  {
    return relative_rms(comparison, comparison.difference(model));
  }
} // namespace SlipStep
