// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/numbers.h>

#include <slipstep/diagnosis/covariates.h>
#include <slipstep/measured_data/test_rows.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

namespace SlipStep
{
  namespace
  {
    Covariates zeros(const Eigen::Index n)
    {
      Covariates result;
      result.phase.resize(n);
      result.axis = Eigen::VectorXd::Zero(n);
      for (const Covariate &covariate : all_covariates())
        result.*covariate.values = Eigen::VectorXd::Zero(n);
      return result;
    }



    /// Follows the rows of one test, before they are averaged.
    class RowReader
    {
    public:
      RowReader(const MeasuredTest        &rows,
                const std::vector<double> &friction,
                const double               elastic_slip_per_pressure);

      Covariates read();

    private:
      void find_motion();

      void follow_history();

      void find_phases();

      void name_stroke(const std::size_t begin, const std::size_t end);

      const MeasuredTest        &rows;
      const std::vector<double> &friction;
      const double               elastic_slip_per_pressure;
      const std::size_t          n;
      Covariates                 result;
      /// Row at which the present stroke began, and how.
      std::vector<std::size_t> stroke_begin;
      std::vector<Phase>       stroke_start;
    };



    RowReader::RowReader(const MeasuredTest        &rows,
                         const std::vector<double> &friction,
                         const double               elastic_slip_per_pressure)
      : rows(rows)
      , friction(friction)
      , elastic_slip_per_pressure(elastic_slip_per_pressure)
      , n(rows.time.size())
      , result(zeros(n))
    {
      result.pressure = Eigen::VectorXd::Map(rows.pressure.data(), n);
      result.position = Eigen::VectorXd::Map(rows.displacement.data(), n);
      result.order.setConstant(rows.order().value_or(0.));
    }



    // Whether the direction changes more often than anybody would do it.
    bool trembles(const std::vector<double> &displacement)
    {
      std::size_t n_changes = 0;
      for (std::size_t i = 2; i < displacement.size(); ++i)
        n_changes += (displacement[i] - displacement[i - 1]) *
                       (displacement[i - 1] - displacement[i - 2]) <
                     0.;
      return n_changes > displacement.size() / 20;
    }



    // Velocity over the interval that ends with a row, without tremble: what is
    // less than a hundredth of the usual speed is rest.
    void RowReader::find_motion()
    {
      // A record may tremble by its last digits.
      const auto calm = [](const std::vector<double> &displacement) {
        return trembles(displacement) ?
                 without_jitter(displacement, 4. * noise_level(displacement)) :
                 displacement;
      };
      const std::vector<double> x = calm(rows.displacement),
                                y = calm(rows.displacement_y);
      for (std::size_t i = 1; i < n; ++i)
        {
          const double dx = x[i] - x[i - 1];
          const double dy = y.empty() ? 0. : y[i] - y[i - 1];
          result.speed(i) =
            std::hypot(dx, dy) / (rows.time[i] - rows.time[i - 1]);
          result.angle(i) = std::atan2(dy, dx);
        }
      std::vector<double> moving;
      for (const double speed : result.speed)
        if (speed > 0.)
          moving.push_back(speed);
      const double least = 1e-3 * median(moving);
      for (double &speed : result.speed)
        if (speed < least)
          speed = 0.;
      if (n > 1)
        {
          result.speed(0) = result.speed(1);
          result.angle(0) = result.angle(1);
        }
    }



    void RowReader::follow_history()
    {
      double       path = 0., since = 0., rest = 0., heat = 0.;
      bool         has_moved = false;
      const double forget    = 0.1 * (rows.time.back() - rows.time.front());
      for (std::size_t i = 0; i < n; ++i)
        {
          const double dt     = i == 0 ? 0. : rows.time[i] - rows.time[i - 1];
          const bool   rests  = result.speed(i) == 0.;
          const bool   rested = i == 0 || result.speed(i - 1) == 0.;
          const bool   turns =
            i > 0 && !rests && !rested &&
            std::cos(result.angle(i) - result.angle(i - 1)) < 0.5;
          if (rests && !rested)
            rest = 0.;
          if ((!rests && rested) || turns || i == 0)
            {
              since = 0.;
              stroke_begin.push_back(i);
              stroke_start.push_back(turns     ? Phase::reversal :
                                     has_moved ? Phase::restart :
                                                 Phase::presliding);
            }
          path += result.speed(i) * dt;
          since += result.speed(i) * dt;
          if (rests && has_moved)
            rest += dt;
          has_moved = has_moved || !rests;
          heat      = heat * std::exp(-dt / forget) + std::abs(friction[i]) *
                                                   rows.pressure[i] *
                                                   result.speed(i) * dt;
          result.path(i)        = path;
          result.since_start(i) = since;
          result.rest(i)        = rest;
          result.heat(i)        = heat;
        }
    }



    // From the start of motion to the next start: flank, peak, softening,
    // steady, and the rest before the next one.
    void RowReader::name_stroke(const std::size_t s, const std::size_t end)
    {
      const std::size_t begin = stroke_begin[s];
      std::size_t       top = begin, last = begin;
      for (std::size_t i = begin; i < end; ++i)
        if (result.speed(i) > 0.)
          {
            last = i;
            if (std::abs(friction[i]) > std::abs(friction[top]))
              top = i;
          }
      const double peak = std::abs(friction[top]);
      // What is still to fall until the end, at most.
      const double rest_of_fall =
        0.1 * std::abs(peak - std::abs(friction[last])) + 0.005 * peak;
      bool has_risen = false, is_over = false;
      for (std::size_t i = begin; i < end; ++i)
        {
          const double now = std::abs(friction[i]);
          const double elastic =
            2. * elastic_slip_per_pressure * rows.pressure[i];
          if (result.speed(i) == 0.)
            {
              result.phase[i] = Phase::hold;
              continue;
            }
          has_risen = has_risen || now > 0.9 * peak || i >= top ||
                      result.since_start(i) > 100. * elastic;
          is_over = is_over || (i > top && now < 0.97 * peak);
          if (!has_risen)
            result.phase[i] = stroke_start[s];
          else if (!is_over && now > 0.97 * peak &&
                   i <= top + std::max<std::size_t>(3, (end - begin) / 10))
            result.phase[i] = Phase::peak;
          else if (std::abs(now - std::abs(friction[last])) > rest_of_fall)
            result.phase[i] = Phase::softening;
          else
            result.phase[i] = Phase::steady;
        }
    }



    void RowReader::find_phases()
    {
      for (std::size_t s = 0; s < stroke_begin.size(); ++s)
        name_stroke(s, s + 1 < stroke_begin.size() ? stroke_begin[s + 1] : n);
    }



    Covariates RowReader::read()
    {
      find_motion();
      follow_history();
      find_phases();
      return result;
    }
  } // namespace



  Eigen::VectorXd lagging_change(const Comparison      &comparison,
                                 const Eigen::VectorXd &path,
                                 const Eigen::VectorXd &value,
                                 const double           length)
  {
    Eigen::VectorXd result = Eigen::VectorXd::Zero(value.size());
    for (const ComparedTest &test : comparison.tests)
      {
        // The second axis is the first again.
        double       follower = 0., before = 0.;
        Eigen::Index n_seen = 0;
        for (Eigen::Index i = test.begin; i < test.begin + test.size; ++i)
          {
            if (i == test.begin + Eigen::Index(test.n_bins()))
              n_seen = 0;
            if (!(value(i) > 0.))
              continue;
            const double now = std::log(value(i));
            if (n_seen++ == 0)
              follower = now;
            else
              follower =
                now + (follower - now) * std::exp((before - path(i)) / length);
            before    = path(i);
            result(i) = now - follower;
          }
      }
    return result;
  }



  namespace
  {
    // Pressure over the largest so far, and its rate.
    void follow_pressure(const Comparison                &comparison,
                         const std::vector<CampaignTest> &tests,
                         Covariates                      &covariates)
    {
      const Eigen::VectorXd &p = covariates.pressure;
      for (std::size_t t = 0; t < tests.size(); ++t)
        {
          const ComparedTest        &test    = comparison.tests[t];
          const std::vector<double> &time    = tests[t].rows.time;
          const Eigen::Index         n_bins  = test.n_bins();
          const auto                 time_at = [&](const Eigen::Index bin) {
            return time[test.middle_row(bin)];
          };
          double largest = 0.;
          for (Eigen::Index i = 0; i < test.size; ++i)
            {
              const Eigen::Index bin = i % n_bins, row = test.begin + i;
              if (bin == 0)
                largest = 0.;
              largest = std::max(largest, p(row));
              if (largest > 0.)
                covariates.unloading(row) = 1. - p(row) / largest;
              if (bin > 0)
                covariates.pressure_rate(row) =
                  (p(row) - p(row - 1)) / (time_at(bin) - time_at(bin - 1));
            }
        }
    }



    // Of one test at every row: the simulated friction of the row's bin.
    std::vector<double> friction_at_rows(const ComparedTest    &test,
                                         const Eigen::VectorXd &friction)
    {
      const std::size_t   n_bins = test.n_bins();
      std::vector<double> result;
      for (std::size_t i = 0; i < n_bins; ++i)
        result.resize(test.borders[i + 1] - test.borders[0],
                      test.series.size() == 1 ?
                        friction(test.begin + i) :
                        std::hypot(friction(test.begin + i),
                                   friction(test.begin + n_bins + i)));
      return result;
    }



    bool is_motion(const Covariates &rows, const Eigen::Index row)
    {
      return rows.speed(row) > 0. && rows.phase[row] != Phase::hold;
    }



    // See TestedRange, but for the way along it.
    double main_line(const Covariates &rows)
    {
      constexpr int       half_turn = 180, near = 3; // [deg]
      std::vector<double> lines(half_turn);
      for (Eigen::Index k = 0; k < rows.speed.size(); ++k)
        if (is_motion(rows, k))
          for (int i = -near; i <= near; ++i)
            {
              const long degrees =
                std::lround(rows.angle(k) * half_turn / dealii::numbers::PI) +
                i;
              lines[(degrees % half_turn + half_turn) % half_turn] +=
                1. - 0.01 * i * i;
            }
      const auto commonest = std::max_element(lines.begin(), lines.end());
      if (lines[0] > 0.5 * *commonest)
        return 0.;
      const int degrees = commonest - lines.begin();
      return (degrees > half_turn / 2 ? degrees - half_turn : degrees) *
             dealii::numbers::PI / half_turn;
    }



    // Along a line as most of the motion goes; where much goes either way, as
    // the line does.
    double turned_forward(const double line, const Covariates &rows)
    {
      constexpr double much = 1.5;

      unsigned int n_forward = 0, n_back = 0;
      for (Eigen::Index k = 0; k < rows.speed.size(); ++k)
        if (is_motion(rows, k))
          {
            const double along = std::cos(rows.angle(k) - line);
            n_forward += along > 0.5;
            n_back += along < -0.5;
          }
      if (n_back <= much * n_forward)
        return line;
      return line > 0. ? line - dealii::numbers::PI :
                         line + dealii::numbers::PI;
    }



    void follow_main_line(Covariates &rows, const Eigen::VectorXd &across)
    {
      const double line = rows.main_line =
        turned_forward(main_line(rows), rows);
      rows.track = std::cos(line) * rows.position + std::sin(line) * across;
      for (Eigen::Index k = 0; k < rows.speed.size(); ++k)
        rows.is_reverse(k) =
          rows.speed(k) > 0. && std::cos(rows.angle(k) - line) < -0.5;
    }
  } // namespace



  Covariates find_covariates(const Comparison                &comparison,
                             const std::vector<CampaignTest> &tests,
                             const Eigen::VectorXd           &friction,
                             const double elastic_slip_per_pressure)
  {
    Covariates result      = zeros(comparison.n_rows());
    result.friction        = friction;
    Eigen::VectorXd across = Eigen::VectorXd::Zero(comparison.n_rows());
    for (std::size_t t = 0; t < tests.size(); ++t)
      {
        const ComparedTest &test = comparison.tests[t];
        const Covariates    rows = RowReader(tests[t].rows,
                                          friction_at_rows(test, friction),
                                          elastic_slip_per_pressure)
                                  .read();
        for (std::size_t s = 0; s < test.series.size(); ++s)
          for (std::size_t i = 0; i < test.n_bins(); ++i)
            {
              const Eigen::Index k   = test.begin + s * test.n_bins() + i;
              const std::size_t  row = test.middle_row(i);
              for (const Covariate &covariate : all_covariates())
                (result.*covariate.values)(k) = (rows.*covariate.values)(row);
              result.phase[k] = rows.phase[row];
              if (!tests[t].rows.displacement_y.empty())
                across(k) = tests[t].rows.displacement_y[row];
              result.axis(k) = s;
            }
      }
    follow_main_line(result, across);
    follow_pressure(comparison, tests, result);
    const double length = 0.1 * result.path.maxCoeff();
    if (length > 0.)
      {
        result.pressure_change =
          lagging_change(comparison, result.path, result.pressure, length);
        result.speed_change =
          lagging_change(comparison, result.path, result.speed, length);
      }
    return result;
  }



  namespace
  {
    // The few rows of a start or a stop do not count.
    std::pair<double, double> bulk_of(std::vector<double> values)
    {
      std::sort(values.begin(), values.end());
      const std::size_t n = values.size(), few = n / 50;
      return n == 0 ? std::make_pair(0., 0.) :
                      std::make_pair(values[few], values[n - 1 - few]);
    }



    double widest_of(const std::vector<double> &angles)
    {
      std::vector<double> turns;
      for (const double angle : angles)
        turns.push_back(std::abs(std::sin(angle - angles[angles.size() / 2])));
      return std::asin(bulk_of(turns).second);
    }



    // Of both axes together: one of them may idle.
    double typical_friction(const Comparison &comparison,
                            const Covariates &covariates)
    {
      std::vector<double> frictions;
      for (const ComparedTest &test : comparison.tests)
        for (std::size_t i = 0; i < test.n_bins(); ++i)
          {
            double square = 0.;
            for (std::size_t s = 0; s < test.series.size(); ++s)
              square += std::pow(covariates.friction(test.begin +
                                                     s * test.n_bins() + i),
                                 2);
            frictions.push_back(std::sqrt(square));
          }
      return median(frictions);
    }



    // If all tests tell it.
    void add_orders(const std::vector<CampaignTest> &tests, TestedRange &result)
    {
      std::set<double> orders;
      for (const CampaignTest &test : tests)
        if (const std::optional<double> order = test.rows.order())
          orders.insert(*order);
        else
          return;
      result.n_orders    = orders.size();
      result.first_order = *orders.begin();
      result.last_order  = *orders.rbegin();
    }
  } // namespace



  TestedRange tested_range(const Comparison                &comparison,
                           const std::vector<CampaignTest> &tests,
                           const Covariates                &covariates)
  {
    TestedRange         result;
    std::vector<double> moving, angles, pressures;
    result.main_line = covariates.main_line;
    for (Eigen::Index k = 0; k < comparison.n_rows(); ++k)
      if (is_motion(covariates, k))
        {
          moving.push_back(covariates.speed(k));
          angles.push_back(covariates.angle(k));
          if (covariates.pressure(k) > 0.)
            pressures.push_back(covariates.pressure(k));
        }
    std::tie(result.slowest, result.fastest) = bulk_of(moving);
    std::tie(result.lowest, result.highest)  = bulk_of(pressures);
    result.widest_angle                      = widest_of(angles);
    result.typical_friction = typical_friction(comparison, covariates);
    for (std::size_t t = 0; t < tests.size(); ++t)
      {
        const MeasuredTest &rows = tests[t].rows;
        result.largest_pressure =
          std::max(result.largest_pressure,
                   *std::max_element(rows.pressure.begin(),
                                     rows.pressure.end()));
        result.longest_test =
          std::max(result.longest_test, rows.time.back() - rows.time.front());
        const ComparedTest &test = comparison.tests[t];
        result.has_two_axes = result.has_two_axes || test.series.size() > 1;
        for (Eigen::Index k = test.begin; k < test.begin + test.size; ++k)
          {
            result.longest_path =
              std::max(result.longest_path, covariates.path(k));
            result.longest_rest =
              std::max(result.longest_rest, covariates.rest(k));
          }
      }
    add_orders(tests, result);
    return result;
  }
} // namespace SlipStep
