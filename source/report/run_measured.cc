// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/numbers.h>

#include <slipstep/experiment/point_driver.h>
#include <slipstep/measured_data/friction_axes.h>
#include <slipstep/measured_data/odd_rows.h>
#include <slipstep/measured_data/raw_files.h>
#include <slipstep/measured_data/test_rows.h>
#include <slipstep/report/run_figures.h>
#include <slipstep/utilities/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <regex>
#include <tuple>

namespace SlipStep
{
  namespace
  {
    /// A measured test, along an axis, beside the run that it is compared with.
    struct MeasuredBeside
    {
      MeasuredTest test; ///< along the axis
      std::size_t  run         = 0;
      bool         is_repeated = false; ///< by the programme, row by row
      double       start_time  = 0.;    ///< in the run [s]
      double       start       = 0.;    ///< displacement in the run [mm]
      std::size_t  pass        = 1;     ///< of the same test in the run
      std::size_t  n_passes    = 1;
      FrictionAxis axis        = {};
    };



    using ManyBeside = std::vector<MeasuredBeside>;

    /// Of a test that a run follows again and again, the last among them.
    constexpr std::size_t most_passes = 4;

    bool is_same_file(const MeasuredBeside &a, const MeasuredBeside &b)
    {
      return a.test.file.lexically_normal() == b.test.file.lexically_normal();
    }

    /// Files that have the same name are told apart, and so is what a run
    /// follows more than once.
    std::string name_of(const MeasuredBeside &measured, const ManyBeside &all)
    {
      const bool  is_shared = any_of(all, [&](const MeasuredBeside &other) {
        return other.test.name == measured.test.name &&
               !is_same_file(other, measured);
      });
      std::string text =
        measured.test.name +
        (is_shared ? " (" + measured.test.file.stem().string() + ")" : "");
      if (measured.n_passes > 1)
        text += " from " + rounded_text(measured.start_time, 7) + " s";
      if (measured.n_passes > most_passes && measured.pass == measured.n_passes)
        text += ", the last of " + std::to_string(measured.n_passes);
      return text;
    }



    /// Whether one before it has the same points.
    bool is_drawn(const std::size_t i, const ManyBeside &all)
    {
      return std::any_of(all.begin(),
                         all.begin() + i,
                         [&](const MeasuredBeside &other) {
                           return is_same_file(other, all[i]) &&
                                  other.start_time == all[i].start_time &&
                                  other.start == all[i].start;
                         });
    }



    /// " along y"; nothing for x, unless there are others.
    std::string words_of(const FrictionAxis &axis, const bool has_others)
    {
      if (axis.sine == 0.)
        return has_others ? " along x" : "";
      return axis.cosine == 0. ?
               " along y" :
               " at " +
                 rounded_text(std::atan2(axis.sine, axis.cosine) /
                                dealii::numbers::PI * 180.,
                              3) +
                 " deg to x";
    }



    /// Along the line on which all of its friction lies, or along x and y.
    void add_along_axes(const MeasuredBeside       &measured,
                        const dealii::Tensor<1, 2> &origin,
                        ManyBeside                 &result)
    {
      std::vector<FrictionAxis> axes = friction_axes(measured.test);
      if (axes.size() > 1)
        axes = {{1., 0., 0.}, {0., 1., 0.}};
      const std::vector<std::size_t> unloaded =
        rows_without_load(measured.test);
      for (const FrictionAxis &axis : axes)
        {
          MeasuredBeside beside = measured;
          beside.axis           = axis;
          beside.test           = along(axis, measured.test);
          beside.start          = axis.of(origin[0], origin[1]);
          for (const std::size_t row : unloaded)
            beside.test.friction[row] =
              std::numeric_limits<double>::quiet_NaN();
          result.push_back(beside);
        }
    }



    ManyBeside measured_tests(const RunFigures &figures)
    {
      const Parameters &parameters = figures.parameters;
      ManyBeside        result;
      try
        {
          for (std::size_t i = 0; i < figures.runs.size(); ++i)
            {
              const Programme programme =
                parse_programme(figures.parameters_of(figures.runs[i]));
              std::map<std::filesystem::path, std::size_t> passes, n_passes;
              for (const FollowedTest &followed : programme.followed())
                ++n_passes[followed.test.file];
              for (const FollowedTest &followed : programme.followed())
                {
                  const std::size_t pass = ++passes[followed.test.file];
                  const std::size_t last = n_passes[followed.test.file];
                  if (pass < most_passes || pass == last)
                    add_along_axes({followed.test,
                                    i,
                                    true,
                                    followed.start_time,
                                    0.,
                                    pass,
                                    last},
                                   followed.origin,
                                   result);
                }
            }
          for (const auto &file : named_files(parameters, "Report/Measured"))
            add_along_axes({read_measured_test(file)}, {}, result);
        }
      catch (const InputError &error)
        {
          figures.page.warnings.push_back(
            std::string("no measured tests in the pictures: ") + error.what());
          result.clear();
        }
      return result;
    }



    /// By how much run and test differ, in words; "" if no time is common.
    std::string difference_in_words(const MeasuredBeside &measured,
                                    const RunResults     &run,
                                    const std::string    &name)
    {
      if (run.history.empty())
        return "";
      std::vector<double> run_times, run_friction, times;
      for (const HistoryRow &row : run.history)
        {
          run_times.push_back(row.time);
          run_friction.push_back(
            measured.axis.of(row.friction, row.friction_y));
        }
      for (const double time : measured.test.time)
        times.push_back(measured.start_time + time - measured.test.time[0]);
      const std::vector<double> simulated =
        at_times(run_times, run_friction, times);
      double      squares = 0., friction = 0.;
      std::size_t n = 0;
      for (std::size_t i = 0; i < times.size(); ++i)
        {
          const double difference = simulated[i] - measured.test.friction[i];
          if (times[i] < run_times.front() || times[i] > run_times.back() ||
              !std::isfinite(difference))
            continue;
          squares += difference * difference;
          friction += std::pow(measured.test.friction[i], 2);
          ++n;
        }
      if (n == 0)
        return "";
      const double rms = std::sqrt(squares / n);
      return name + ": " + rounded_text(rms, 2) +
             (friction > 0. ?
                ", " + rounded_text(100. * rms / std::sqrt(friction / n), 2) +
                  " % of friction" :
                "");
    }



    // Their points; in words how far those that a run repeats are off.
    std::string plot_measured(Figure           &figure,
                              const RunFigures &figures,
                              const ManyBeside &measured,
                              const bool        is_over_time,
                              Range            &friction)
    {
      const std::vector<std::string> greys = {"#777777", "#aaaaaa", "#444444"};
      std::string                    differences;
      std::size_t                    n = 0;
      for (std::size_t k = 0; k < measured.size(); ++k)
        {
          const MeasuredBeside &beside = measured[k];
          const MeasuredTest   &test   = beside.test;
          const std::string     name   = name_of(beside, measured);
          if (!is_drawn(k, measured))
            {
              Rows points;
              for (std::size_t i = 0; i < test.time.size(); ++i)
                {
                  if (!std::isfinite(test.friction[i]))
                    continue;
                  points.push_back(
                    {is_over_time ?
                       beside.start_time + test.time[i] - test.time[0] :
                       beside.start + test.displacement[i] -
                         test.displacement[0],
                     test.friction[i]});
                  friction.add(test.friction[i]);
                }
              figure.plot(
                figure.add_data(name,
                                {is_over_time ? "time" : "displacement",
                                 "friction"},
                                thinned(points)) +
                (points.size() > most_points ? " with lines lw 2" :
                                               " with points pt 7 ps 0.4") +
                " lc rgb '" + greys[n++ % greys.size()] + "' title " +
                gnuplot_text(name + ", measured"));
            }
          if (!beside.is_repeated)
            continue;
          const RunResults &run        = figures.runs[beside.run];
          const std::string difference = difference_in_words(
            beside,
            run,
            name + (figures.runs.size() > 1 ? ", " + run.short_label : ""));
          if (!difference.empty())
            differences += (differences.empty() ? "" : "; ") + difference;
        }
      return differences;
    }



    void draw_measured(RunFigures       &figures,
                       const ManyBeside &measured,
                       const bool        is_over_time,
                       const bool        has_others)
    {
      const Runs        &runs  = figures.runs;
      const FrictionAxis axis  = measured.front().axis;
      const std::string  along = words_of(axis, has_others);
      const std::string  over  = is_over_time ? "time" : "displacement";
      const std::string  name =
        std::regex_replace(along, std::regex("[^A-Za-z0-9]"), "_");
      Figure figure =
        figures.figure("measured_over_" + over + name,
                       "Measured and simulated friction" + along + " over " +
                         over,
                       // The legend is below.
                       390 + 12 * (measured.size() + runs.size()));
      Range             friction;
      const std::string differences =
        plot_measured(figure, figures, measured, is_over_time, friction);
      std::vector<bool> is_beside(runs.size(), false);
      for (const MeasuredBeside &beside : measured)
        if (beside.is_repeated)
          is_beside[beside.run] = true;
      const bool draws_all = none_of(is_beside, [](bool is) { return is; });
      for (std::size_t i = 0; i < runs.size(); ++i)
        {
          if (!draws_all && !is_beside[i])
            continue;
          Rows points;
          for (const HistoryRow &row : runs[i].history)
            points.push_back({is_over_time ?
                                row.time :
                                axis.of(row.displacement, row.displacement_y),
                              axis.of(row.friction, row.friction_y)});
          if (!points.empty())
            plot_run(figure, runs[i], i, {over, "friction"}, points, 1.8);
        }
      figure.script() << axes_style
                      << "set key outside below Left reverse\n"
                         "set xrange [] noextend\n"
                      << (friction.lower >= -1e-3 ? "set yrange [0:*]\n" : "")
                      << "set xlabel '"
                      << (is_over_time ?
                            "Time  [s]" :
                            "Displacement of the drive" + along + "  [mm]")
                      << "'\nset ylabel 'Friction" << along
                      << "  (tangential / normal load)'\n";
      figures.add(figure,
                  "Measured and simulated" + along,
                  differences.empty() ?
                    "" :
                    "Root mean square of their difference: " + differences +
                      ".");
    }
  } // namespace



  void add_measured_pictures(RunFigures &figures)
  {
    // One picture for every axis, along x first.
    std::map<std::tuple<double, double, bool>, ManyBeside> pictures;
    for (const MeasuredBeside &measured : measured_tests(figures))
      {
        // Rests and strokes lie on top of each other over displacement.
        const auto  &x    = measured.test.displacement;
        const double band = 0.01 * range_of(x);
        const bool   has_turns =
          measured.is_repeated && !turning_rows(x, band).empty();
        const double sine = measured.axis.sine;
        pictures[{std::abs(sine), sine, has_turns}].push_back(measured);
      }
    for (const auto &[kind, measured] : pictures)
      draw_measured(figures,
                    measured,
                    std::get<2>(kind),
                    std::get<1>(pictures.begin()->first) !=
                      std::get<1>(pictures.rbegin()->first));
  }
} // namespace SlipStep
