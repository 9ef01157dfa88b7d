// SPDX-License-Identifier: LGPL-2.1-or-later

// Pictures of friction: of the tests and of the block.

#include <slipstep/report/diagnosis_figures.h>
#include <slipstep/report/diagnosis_text.h>
#include <slipstep/report/friction_curves.h>

#include <algorithm>
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

    void draw_element_check(SmallPicture &picture, const ElementCheck &check)
    {
      Range y, x;
      for (const double position : check.displacement)
        x.add(position);
      const auto add = [&](const std::string         &what,
                           const std::vector<double> &curve,
                           const std::string         &style) {
        Rows rows;
        for (std::size_t i = 0;
             i < std::min(check.displacement.size(), curve.size());
             ++i)
          {
            rows.push_back({check.displacement[i], curve[i]});
            y.add(curve[i]);
          }
        if (!rows.empty())
          picture.plot(what,
                       {"displacement_mm", "friction"},
                       rows,
                       "with lines " + style);
      };
      add("measured", check.measured, measured_line.style(1.2));
      add("contact point before", check.point_before, "lc rgb '#f0b58c' lw 4");
      add("contact point after", check.point_after, "lc rgb '#8fc3e6' lw 4");
      add("block before", check.block_before, before_line.style());
      add("block after",
          check.block_after,
          LegendLine{"", Colour::after}.style());
      picture.axes("Displacement  [mm]", x, "Friction  [–]", with_zero(y));
    }
  } // namespace



  Gallery draw_tests(const std::filesystem::path &folder,
                     const Diagnosis             &diagnosis,
                     std::vector<std::string>    &warnings)
  {
    const bool                        is_after   = has_after(diagnosis);
    const std::vector<DrawnTest>      tests      = drawn_tests(diagnosis);
    std::size_t                       n_left_out = 0;
    const std::vector<ConditionFrame> frames =
      condition_frames(tests, n_left_out);
    Gallery gallery = draw_friction(folder,
                                    "test",
                                    is_after ? "Measured, before and after" :
                                               "Measured and simulated",
                                    frames,
                                    is_after ? "after" : "simulated",
                                    warnings);
    gallery.caption = frames_caption(frames, n_left_out) +
                      "With a law that lacks nothing, nearly all that was "
                      "measured lies within the band of the noise. Steep "
                      "flanks are cut off where the difference is elsewhere.";
    return gallery;
  }



  Gallery draw_element_checks(const std::filesystem::path &folder,
                              const Diagnosis             &diagnosis,
                              std::vector<std::string>    &warnings)
  {
    Gallery gallery{"",
                    "",
                    {measured_line,
                     {"block before", Colour::before, LegendLine::dashed},
                     {"block after", Colour::after},
                     {"contact point before", "#f0b58c"},
                     {"contact point after", "#8fc3e6"}},
                    {}};
    for (std::size_t i = 0; i < diagnosis.element_checks.size(); ++i)
      {
        const ElementCheck &check = diagnosis.element_checks[i];
        if (check.displacement.empty())
          continue;
        SmallPicture picture(folder,
                             "block_" + std::to_string(i + 1),
                             check.test);
        draw_element_check(picture, check);
        picture.finish(gallery, warnings);
      }
    return gallery;
  }
} // namespace SlipStep
