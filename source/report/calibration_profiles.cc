// SPDX-License-Identifier: LGPL-2.1-or-later

// Pictures of the profile likelihood.

#include <slipstep/report/calibration_figures.h>
#include <slipstep/report/calibration_text.h>
#include <slipstep/report/panel_grid.h>

#include <slipstep/report/drawing.h>

#include <boost/math/distributions/normal.hpp>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  namespace
  {
    const char *const profile_style  = "lc rgb '#0072B2' lw 2";
    const char *const parabola_style = "lc rgb '#666666' dt (6,4) lw 1.5";
    const char *const end_style      = "lc rgb '#D55E00' dt (3,2) lw 1.8";
    const char *const bound_style    = "lc rgb '#999999' lw 4";

    /// What is seen of a profile; values in the unit of the parameter.
    struct ProfileFrame
    {
      Range  x;
      double highest        = 0.;
      bool   is_logarithmic = false;
    };

    ProfileFrame frame_of(const FittedParameter &fitted)
    {
      const FitParameter &parameter = fitted.parameter;
      ProfileFrame        frame;
      Range               y;
      for (const auto &[value, ratio] : fitted.profile)
        y.add(ratio);
      frame.highest = std::clamp(1.05 * y.upper, 1.4, 3.);
      for (const auto &[value, ratio] : fitted.profile)
        if (ratio <= frame.highest)
          frame.x.add(parameter.in_unit(value));
      for (const double value : {fitted.value, fitted.lower, fitted.upper})
        frame.x.add(parameter.in_unit(value));

      // Over a short stretch a logarithmic axis looks the same, but finds no
      // round numbers.
      frame.is_logarithmic = parameter.is_logarithmic && frame.x.lower > 0. &&
                             frame.x.upper > 3. * frame.x.lower;
      const double share = 0.06;
      if (frame.is_logarithmic)
        {
          const double factor = std::pow(frame.x.upper / frame.x.lower, share);
          frame.x = {frame.x.lower / factor, frame.x.upper * factor};
        }
      else
        {
          double margin = share * frame.x.width();
          if (!(margin > 0.))
            margin = std::max(share * std::abs(frame.x.upper), 1e-9);
          frame.x = {frame.x.lower - margin, frame.x.upper + margin};
        }
      return frame;
    }

    /// What the curvature at the optimum alone would say.
    Rows parabola(const FittedParameter &fitted,
                  const ProfileFrame    &frame,
                  const double           confidence)
    {
      if (!std::isfinite(fitted.deviation) || !(fitted.deviation > 0.))
        return {};
      const double at_threshold =
        fitted.deviation *
        boost::math::quantile(boost::math::normal(), 0.5 * (1. + confidence));
      const FitParameter &parameter = fitted.parameter;
      const bool          is_log    = parameter.is_logarithmic;
      Rows                rows;
      const int           n = 120;
      for (int i = 0; i <= n; ++i)
        {
          const double share = static_cast<double>(i) / n;
          const double value =
            frame.is_logarithmic ?
              frame.x.lower * std::pow(frame.x.upper / frame.x.lower, share) :
              frame.x.lower + share * frame.x.width();
          const double centre = parameter.in_unit(fitted.value);
          const double away =
            is_log ? std::log(value / centre) / at_threshold :
                     (value - centre) / parameter.in_unit(at_threshold);
          if (std::isfinite(away) && away * away <= 2. * frame.highest)
            rows.push_back({value, away * away});
        }
      return rows;
    }

    /// A profile between the points that were computed and the ends of the
    /// interval. Its square root, with a sign, is nearly a straight line.
    Rows interpolated(const FittedParameter &fitted)
    {
      constexpr int n_between = 12;
      auto          points    = fitted.profile;
      if (!fitted.is_lower_open)
        points.emplace_back(fitted.lower, 1.);
      if (!fitted.is_upper_open)
        points.emplace_back(fitted.upper, 1.);
      std::sort(points.begin(), points.end());
      const auto root = [&](const std::size_t i) {
        return std::copysign(std::sqrt(std::max(points[i].second, 0.)),
                             points[i].first - fitted.value);
      };
      Rows rows;
      for (std::size_t i = 1; i < points.size(); ++i)
        for (int k = i == 1 ? 0 : 1; k <= n_between; ++k)
          {
            const double share = static_cast<double>(k) / n_between;
            const double begin = points[i - 1].first;
            const double end   = points[i].first;
            const double value = fitted.parameter.is_logarithmic ?
                                   begin * std::pow(end / begin, share) :
                                   begin + share * (end - begin);
            const double at    = root(i - 1) + share * (root(i) - root(i - 1));
            rows.push_back({fitted.parameter.in_unit(value), at * at});
          }
      return rows;
    }

    void write_upright(std::ostream       &script,
                       const ProfileFrame &frame,
                       const double        value,
                       const char *const   style)
    {
      if (value >= frame.x.lower && value <= frame.x.upper)
        script << "set arrow nohead from first " << value
               << ", graph 0 to first " << value << ", graph 1 " << style
               << '\n';
    }

    void write_frame(std::ostream          &script,
                     const FittedParameter &fitted,
                     const ProfileFrame    &frame)
    {
      const FitParameter &parameter = fitted.parameter;
      const std::string   unit      = parameter.unit();
      // The full precision keeps short intervals far from zero apart.
      const auto precision = script.precision(12);
      script
        << "set xlabel "
        << gnuplot_text(label_of(parameter) +
                        (unit.empty() ? "  [–]" : "  [" + unit + "]"))
        << "\nset xrange [" << frame.x.lower << ':' << frame.x.upper
        << "]\nset yrange [0:" << frame.highest << "]\n"
        << (frame.is_logarithmic ? "set logscale x\n" : "unset logscale x\n")
        << few_tics('x', frame.x.lower, frame.x.upper, frame.is_logarithmic);
      write_upright(script,
                    frame,
                    parameter.in_unit(parameter.lower),
                    bound_style);
      write_upright(script,
                    frame,
                    parameter.in_unit(parameter.upper),
                    bound_style);
      if (!fitted.is_lower_open)
        write_upright(script,
                      frame,
                      parameter.in_unit(fitted.lower),
                      end_style);
      if (!fitted.is_upper_open)
        write_upright(script,
                      frame,
                      parameter.in_unit(fitted.upper),
                      end_style);
      script.precision(precision);
    }

    void plot_profile(Figure                &figure,
                      const FittedParameter &fitted,
                      const double           confidence)
    {
      const ProfileFrame             frame   = frame_of(fitted);
      const std::vector<std::string> columns = {"value", "over_threshold"};
      Rows                           rows;
      for (const auto &[value, ratio] : fitted.profile)
        rows.push_back({fitted.parameter.in_unit(value), ratio});
      const std::string name  = label_of(fitted.parameter);
      const std::string data  = figure.add_data(name, columns, rows);
      const Rows        curve = parabola(fitted, frame, confidence);
      write_frame(figure.script(), fitted, frame);
      figure.script() << "plot 1 with lines lc rgb '#222222' lw 1";
      if (!curve.empty())
        figure.script() << ", "
                        << figure.add_data(name + ", from the curvature",
                                           columns,
                                           curve)
                        << " with lines " << parabola_style;
      figure.script()
        << ", "
        << figure.add_data(name + ", between the points",
                           columns,
                           interpolated(fitted))
        << " with lines " << profile_style << ", " << data
        << " with points pt 7 ps 0.35 lc rgb '#0072B2', "
        << figure.add_data(name + ", fitted",
                           columns,
                           {{fitted.parameter.in_unit(fitted.value), 0.}})
        << " with points pt 7 ps 0.9 lc rgb '#D55E00'\n"
        << PanelGrid::after_first;
    }
  } // namespace



  std::vector<Picture> draw_profiles(const std::filesystem::path &folder,
                                     const Calibration           &calibration,
                                     std::vector<std::string>    &warnings)
  {
    std::vector<const FittedParameter *> shown;
    for (const FittedParameter &fitted : calibration.parameters)
      if (fitted.profile.size() > 1)
        shown.push_back(&fitted);
    if (shown.empty())
      return {};
    const std::string title = "How sharply each parameter is determined";
    const PanelGrid   grid(shown.size(), 3, 250);
    Figure figure(folder, "profiles", title, picture_width, grid.height());
    grid.begin(figure.script(),
               {{"profile", profile_style},
                {"curvature alone", parabola_style},
                {"end of the interval", end_style},
                {"bound", bound_style}});
    figure.script() << "set ylabel 'Misfit / threshold  [–]' font ',11'\n"
                       "set ytics 1\nset xtics font ',11'\n";
    for (const FittedParameter *const fitted : shown)
      plot_profile(figure, *fitted, calibration.confidence);
    figure.script() << "unset multiplot\n";
    return {finish(
      figure,
      title,
      "Increase of the misfit when one parameter is held and the others are "
      "fitted again, over the threshold of the " +
        interval_name(calibration) +
        ": where it exceeds 1, the tests contradict the value. A flat curve "
        "says that they do not care. The dot is the fitted value.",
      warnings)};
  }
} // namespace SlipStep
