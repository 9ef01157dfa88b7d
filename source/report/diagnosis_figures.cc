// SPDX-License-Identifier: LGPL-2.1-or-later

// Pictures of tests and of what speaks for a name: differences along the
// covariates, and profiles of the parameters.

#include <slipstep/report/diagnosis_sections.h>
#include <slipstep/report/diagnosis_text.h>
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
    DrawnTest drawn_axis(const DiagnosedTest &test,
                         const bool           is_second_axis,
                         const bool           is_after)
    {
      DrawnTest   drawn;
      const auto &before = is_second_axis ? test.before_y : test.before;
      drawn.name         = test.name;
      drawn.condition = (test.condition.empty() ? test.name : test.condition) +
                        (is_second_axis ? ", second axis" : "");
      drawn.time         = test.time;
      drawn.displacement = test.displacement;
      drawn.measured     = is_second_axis ? test.measured_y : test.measured;
      drawn.simulated =
        is_after ? is_second_axis ? test.after_y : test.after : before;
      if (is_after)
        drawn.before = before;
      // Of a test with two axes each has its share.
      drawn.noise =
        test.measured_y.empty() ? test.noise : test.noise / std::sqrt(2.);
      drawn.gap = test.rms_before;
      for (const Phase phase : test.phase)
        drawn.is_flank.push_back(is_flank(phase) || phase == Phase::hold);
      return drawn;
    }

    std::vector<DrawnTest> drawn_tests(const Diagnosis &diagnosis)
    {
      const bool             is_after = has_after(diagnosis);
      std::vector<DrawnTest> tests;
      for (const DiagnosedTest &test : diagnosis.tests)
        {
          tests.push_back(drawn_axis(test, false, is_after));
          if (!test.measured_y.empty())
            tests.push_back(drawn_axis(test, true, is_after));
        }
      return tests;
    }



    constexpr std::size_t most_signatures = 4;

    /// The same effect has the same line in all pictures.
    std::vector<LegendLine>
    signature_lines(const Diagnosis                   &diagnosis,
                    const std::vector<CovariatePanel> &panels)
    {
      static const std::array<const char *, most_signatures> colours = {
        {Colour::after, "#E69F00", "#009E73", "#CC79A7"}};
      std::vector<LegendLine> lines;
      for (const CovariatePanel &panel : panels)
        for (const auto &[name, values] : panel.signatures)
          {
            const bool is_known =
              any_of(lines, [&, n = name](const auto &line) {
                return line.text == n;
              });
            if (!is_known && lines.size() < most_signatures)
              lines.push_back({name,
                               colours[lines.size()],
                               holds(diagnosis.effects, name) ?
                                 LegendLine::line :
                                 LegendLine::dashed});
          }
      return lines;
    }

    void draw_panel(SmallPicture                  &picture,
                    const CovariatePanel          &panel,
                    const std::vector<LegendLine> &lines)
    {
      Range x, y;
      Rows  points;
      for (std::size_t i = 0; i < panel.x.size(); ++i)
        {
          const double error =
            i < panel.error.size() ? 200. * panel.error[i] : 0.;
          points.push_back({panel.x[i], 100. * panel.residual[i], error});
          x.add(panel.x[i]);
          y.add(100. * panel.residual[i] + error);
          y.add(100. * panel.residual[i] - error);
        }
      y.add(0.);
      picture.plot_level(0., "lc rgb '#222222' lw 1");
      for (const auto &[name, values] : panel.signatures)
        for (const LegendLine &line : lines)
          if (line.text == name)
            {
              Rows curve;
              for (std::size_t i = 0;
                   i < std::min(values.size(), panel.x.size());
                   ++i)
                {
                  curve.push_back({panel.x[i], 100. * values[i]});
                  y.add(100. * values[i]);
                }
              picture.plot(name,
                           {panel.covariate, "change_percent"},
                           curve,
                           "with lines " + line.style());
            }
      picture.plot("left over",
                   {panel.covariate, "residual_percent", "two_deviations"},
                   points,
                   "with yerrorbars pt 7 ps 0.6 lw 1.2 lc rgb '#222222'");
      // Points shall not stand on the border.
      const bool is_logarithmic =
        panel.is_logarithmic && x.lower > 0. && x.upper > x.lower;
      x = with_margin(x, 0.04, is_logarithmic);
      picture.axes(axis_label(panel.covariate, panel.unit),
                   x,
                   "Left over  [% of friction]",
                   y,
                   is_logarithmic);
    }



    // @param gallery has a title and a caption
    std::string draw_panels(Page                              &page,
                            const std::string                 &name,
                            const std::vector<CovariatePanel> &panels,
                            const std::vector<LegendLine>     &lines,
                            Gallery                            gallery)
    {
      gallery.legend.insert(gallery.legend.end(), lines.begin(), lines.end());
      for (std::size_t i = 0; i < panels.size(); ++i)
        {
          const CovariatePanel &panel = panels[i];
          if (panel.x.empty() || panel.residual.size() != panel.x.size())
            continue;
          SmallPicture picture(page,
                               name + "_" + std::to_string(i + 1),
                               "Against " + panel.covariate);
          draw_panel(picture, panel, lines);
          picture.finish(gallery);
        }
      return gallery_section(gallery);
    }
  } // namespace



  std::string draw_tests(Page &page, const Diagnosis &diagnosis)
  {
    const bool                        is_after = has_after(diagnosis);
    const std::vector<DrawnTest>      tests    = drawn_tests(diagnosis);
    std::string                       caption;
    const std::vector<ConditionFrame> frames = condition_frames(tests, caption);
    return draw_friction(
      page,
      "test",
      is_after ? "Measured, before and after" : "Measured and simulated",
      caption +
        "With a law that lacks nothing, nearly all that was measured lies "
        "within the band of the noise. Steep flanks are cut off where the "
        "difference is elsewhere.",
      frames,
      is_after ? "after" : "simulated");
  }



  std::string draw_covariates(Page &page, const Diagnosis &diagnosis)
  {
    const std::vector<LegendLine> lines =
      signature_lines(diagnosis, diagnosis.panels);
    Gallery gallery{
      "What is left over, and what would explain it",
      "Measured minus simulated friction before anything was added, as means "
      "of bins with two standard deviations; lines: what each effect would "
      "change there. An effect explains a difference if its line goes through "
      "the points everywhere.",
      {{"left over before", "#222222", LegendLine::points}},
      {}};
    if (lines.empty())
      {
        gallery.title   = "What is left over";
        gallery.caption = "Measured minus simulated friction, as means of bins "
                          "with two standard deviations.";
        gallery.legend[0].text = "left over";
      }
    return draw_panels(page, "covariate", diagnosis.panels, lines, gallery);
  }



  std::string draw_completed_formulas(Page &page, const Diagnosis &diagnosis)
  {
    std::vector<CovariatePanel> panels;
    std::string                 effects;
    for (const CompletedFormula &one : diagnosis.completed)
      {
        panels.push_back(one.panel);
        effects += (effects.empty() ? "" : ", ") + one.effect;
      }
    Gallery gallery{
      "The formula of " + effects + " is not quite right",
      "Measured minus simulated friction with the formula of the effect alone, "
      "as means of bins with two standard deviations; line: a free factor along "
      "what the formula is a function of, which stands beside it in the improved "
      "case. Its shape tells what the formula lacks.",
      {{"left over by the formula", "#222222", LegendLine::points}},
      {}};
    return draw_panels(
      page, "formula", panels, signature_lines(diagnosis, panels), gallery);
  }



  std::string draw_named_profiles(Page &page, const Diagnosis &diagnosis)
  {
    const double quantile =
      boost::math::quantile(boost::math::normal(),
                            0.5 * (1. + diagnosis.confidence));
    std::vector<DrawnProfile> profiles;
    for (const DiagnosedParameter &parameter : named_parameters(diagnosis))
      {
        DrawnProfile drawn{parameter, label_text(parameter), parameter.unit};
        remove_erase_if(drawn.profile, [](const auto &point) {
          return !std::isfinite(point.first) || !std::isfinite(point.second);
        });
        for (auto &point : drawn.profile)
          point.second /= quantile * quantile;
        std::sort(drawn.profile.begin(), drawn.profile.end());
        profiles.push_back(drawn);
      }
    return draw_profiles(page,
                         "How sharply the new parameters are determined",
                         profiles,
                         diagnosis.confidence);
  }
} // namespace SlipStep
