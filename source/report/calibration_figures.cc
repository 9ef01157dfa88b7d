// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/calibration_figures.h>

#include <slipstep/report/calibration_text.h>
#include <slipstep/report/friction_curves.h>
#include <slipstep/report/likelihood_profiles.h>

#include <boost/math/distributions/normal.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace SlipStep
{
  namespace
  {
    std::vector<DrawnTest> drawn_tests(const Calibration &calibration)
    {
      std::vector<DrawnTest> tests;
      for (const TestMisfit &test : calibration.tests)
        {
          DrawnTest drawn;
          drawn.name         = test.name;
          drawn.condition    = test.condition;
          drawn.time         = test.time;
          drawn.displacement = test.displacement;
          drawn.measured     = test.measured;
          drawn.simulated    = test.simulated;
          drawn.noise        = std::isfinite(test.noise) ? test.noise : 0.;
          drawn.gap          = test.noise > 0. ? noise_ratio(test) : test.rms;
          tests.push_back(drawn);
        }
      return tests;
    }

    /// The frames whose friction has its peak early, up to some way after it.
    std::vector<ConditionFrame>
    beginnings(const std::vector<ConditionFrame> &frames)
    {
      std::vector<ConditionFrame> result;
      for (const ConditionFrame &frame : frames)
        {
          if (frame.is_over_time)
            continue;
          double distance = 0.;
          bool   is_back  = false;
          for (const DrawnTest *const test : frame.tests)
            {
              const auto peak =
                std::max_element(test->simulated.begin(),
                                 test->simulated.end(),
                                 [](const double a, const double b) {
                                   return std::abs(a) < std::abs(b);
                                 }) -
                test->simulated.begin();
              const double way =
                test->displacement[peak] - test->displacement.front();
              distance = std::max(distance, std::abs(way));
              is_back  = is_back || way < 0.;
            }
          const double length = distance > 0. ? round_up(5. * distance) : 0.;
          if (length == 0. || length > 0.4 * frame.x.width())
            continue;
          ConditionFrame beginning = frame;
          if (is_back)
            beginning.x.lower = frame.x.upper - length;
          else
            beginning.x.upper = frame.x.lower + length;
          // A handful of rows shows nothing new when enlarged.
          const auto &x = frame.tests.front()->displacement;
          if (count_if(x, [&](const double position) {
                return position >= beginning.x.lower &&
                       position <= beginning.x.upper;
              }) >= 20)
            result.push_back(beginning);
        }
      return result;
    }

    std::vector<double> residuals(const DrawnTest &test)
    {
      std::vector<double> result;
      for (std::size_t i = 0; i < test.measured.size(); ++i)
        result.push_back(test.measured[i] - test.simulated[i]);
      return result;
    }

    /// What the residuals of all tests of a frame have in common, which noise
    /// would hide; none for few rows.
    Rows local_means(const ConditionFrame &frame)
    {
      constexpr std::size_t            n_parts = 40, least = 5;
      std::array<double, n_parts>      sum{};
      std::array<std::size_t, n_parts> count{};
      for (const DrawnTest *const test : frame.tests)
        {
          const std::vector<double> left_over = residuals(*test);
          for (std::size_t i = 0; i < left_over.size(); ++i)
            {
              const double share =
                (frame.abscissa(*test)[i] - frame.x.lower) / frame.x.width();
              if (!std::isfinite(left_over[i]) || !(share >= 0. && share <= 1.))
                continue;
              const auto part =
                std::min(static_cast<std::size_t>(share * n_parts),
                         n_parts - 1);
              sum[part] += left_over[i];
              ++count[part];
            }
        }
      Rows rows;
      for (std::size_t part = 0; part < n_parts; ++part)
        if (count[part] >= least)
          rows.push_back(
            {frame.x.lower + (part + 0.5) / n_parts * frame.x.width(),
             sum[part] / count[part]});
      return rows.size() > 1 ? rows : Rows();
    }

    const LegendLine residual_line = {"measured − fitted", Colour::measured},
                     mean_line     = {"local mean", "#000000"};

    void draw_residuals(SmallPicture &picture, const ConditionFrame &frame)
    {
      double band = 0.;
      Range  y;
      for (const DrawnTest *const test : frame.tests)
        band = std::max(band, 2. * test->noise);
      picture.plot("twice the noise",
                   {"position", "lower", "upper"},
                   {{frame.x.lower, -band, band}, {frame.x.upper, -band, band}},
                   "using 1:2:3 with filledcurves fillcolor rgb '" +
                     noise_band_line.colour + "'");
      for (std::size_t i = frame.tests.size(); i-- > 0;)
        {
          const DrawnTest &test = *frame.tests[i];
          const Rows       rows = frame.rows(test, residuals(test));
          for (const auto &row : rows)
            y.add(std::abs(row[1]));
          picture.plot(test.name,
                       {frame.is_over_time ? "time_s" : "displacement_mm",
                        "measured_minus_fitted"},
                       rows,
                       "with lines " +
                         (i == 0 ? residual_line : replicate_line).style(1.2));
        }
      // Seen through dense curves.
      for (const double level : {-band, band})
        picture.plot_level(level, "lc rgb '#444444' dt (6,4) lw 1.2");
      const Rows means = local_means(frame);
      if (!means.empty())
        picture.plot(frame.title + ", local means",
                     {"position", "mean"},
                     means,
                     "with lines " + mean_line.style(2.2));
      y.add(band);
      frame.axes(picture, "Measured − fitted  [–]", {-y.upper, y.upper});
    }

    Gallery residual_gallery(const std::filesystem::path       &folder,
                             const std::vector<ConditionFrame> &frames,
                             std::vector<std::string>          &warnings)
    {
      Gallery gallery{"What is left over",
                      "With a law that fits, nearly all lies within the band "
                      "and the local mean, over a fortieth of the width, "
                      "stays near zero.",
                      {residual_line},
                      {}};
      bool    has_replicates = false;
      for (std::size_t i = 0; i < frames.size(); ++i)
        {
          SmallPicture picture(folder,
                               "residuals_" + std::to_string(i + 1),
                               frames[i].title);
          draw_residuals(picture, frames[i]);
          picture.finish(gallery, warnings);
          has_replicates = has_replicates || frames[i].tests.size() > 1;
        }
      if (has_replicates)
        gallery.legend.push_back(replicate_line);
      gallery.legend.insert(gallery.legend.end(), {mean_line, noise_band_line});
      return gallery;
    }
  } // namespace



  std::vector<Gallery> draw_curves(const std::filesystem::path &folder,
                                   const Calibration           &calibration,
                                   std::vector<std::string>    &warnings)
  {
    const std::vector<DrawnTest>      tests      = drawn_tests(calibration);
    std::size_t                       n_left_out = 0;
    const std::vector<ConditionFrame> frames =
      condition_frames(tests, n_left_out);
    const std::vector<ConditionFrame> early = beginnings(frames);

    std::vector<Gallery> galleries = {draw_friction(
      folder, "curves", "Measured and fitted", frames, "fitted", warnings)};
    galleries[0].caption           = frames_caption(frames, n_left_out);
    galleries.push_back(draw_friction(folder,
                                      "curves_start",
                                      "The beginning enlarged",
                                      early,
                                      "fitted",
                                      warnings));
    galleries.push_back(residual_gallery(folder, frames, warnings));
    return galleries;
  }



  Gallery draw_fitted_profiles(const std::filesystem::path &folder,
                               const Calibration           &calibration,
                               std::vector<std::string>    &warnings)
  {
    const double quantile =
      boost::math::quantile(boost::math::normal(),
                            0.5 * (1. + calibration.confidence));
    std::vector<DrawnProfile> profiles;
    for (const FittedParameter &fitted : calibration.parameters)
      {
        const FitParameter &parameter = fitted.parameter;
        const auto          in_unit   = [&](const double value) {
          return parameter.in_unit(value);
        };
        DrawnProfile drawn{fitted.converted(in_unit),
                           label_of(parameter),
                           parameter.unit()};
        drawn.is_logarithmic = parameter.is_logarithmic;
        drawn.lower_bound    = parameter.in_unit(parameter.lower);
        drawn.upper_bound    = parameter.in_unit(parameter.upper);
        drawn.distance       = parameter.is_logarithmic ?
                                 quantile * fitted.deviation :
                                 parameter.in_unit(quantile * fitted.deviation);
        profiles.push_back(drawn);
      }
    return draw_profiles(folder,
                         "How sharply each parameter is determined",
                         profiles,
                         interval_name(calibration.confidence),
                         warnings);
  }
} // namespace SlipStep
