// SPDX-License-Identifier: LGPL-2.1-or-later

// Pictures of friction: of the tests and of the block.

#include <slipstep/report/diagnosis_figures.h>
#include <slipstep/report/diagnosis_text.h>

#include <algorithm>
#include <limits>

namespace SlipStep
{
  namespace
  {
    using Curve = std::vector<double>;

    constexpr std::size_t most_pictures = 12;

    /// One axis of the tests under a condition.
    struct Frame
    {
      std::string                        title;
      std::vector<const DiagnosedTest *> tests;
      bool                               is_second_axis = false;
      bool                               is_over_time   = false;
      double                             worst          = 0.;

      const Curve &abscissa(const DiagnosedTest &test) const
      {
        return is_over_time ? test.time : test.displacement;
      }

      const Curve &measured(const DiagnosedTest &test) const
      {
        return is_second_axis ? test.measured_y : test.measured;
      }

      const Curve &before(const DiagnosedTest &test) const
      {
        return is_second_axis ? test.before_y : test.before;
      }

      const Curve &after(const DiagnosedTest &test) const
      {
        return is_second_axis ? test.after_y : test.after;
      }
    };

    /// Over displacement, what comes back lies on top of itself. What rests is
    /// a vertical line, whereas over time a rest hides everything else.
    bool comes_back(const DiagnosedTest &test)
    {
      const auto ends =
        std::minmax_element(test.displacement.begin(), test.displacement.end());
      return std::any_of(test.phase.begin(),
                         test.phase.end(),
                         [](const std::string &phase) {
                           return phase == "reversal";
                         }) ||
             !(*ends.second > *ends.first);
    }

    /// Of a test with two axes each has its share.
    double noise_of_axis(const DiagnosedTest &test)
    {
      return test.measured_y.empty() ? test.noise : test.noise / std::sqrt(2.);
    }

    /// As the tests come; of too many those that were met worst before.
    std::vector<Frame> frames_of(const Diagnosis &diagnosis,
                                 std::size_t     &n_left_out)
    {
      std::vector<Frame> frames;
      const auto add = [&](const DiagnosedTest &test, const bool is_second) {
        const std::string title =
          (test.condition.empty() ? test.name : test.condition) +
          (is_second ? ", second axis" : "");
        auto frame =
          std::find_if(frames.begin(), frames.end(), [&](const Frame &other) {
            return other.title == title;
          });
        if (frame == frames.end())
          frame = frames.insert(frame, Frame{title, {}, is_second});
        frame->tests.push_back(&test);
        frame->is_over_time = frame->is_over_time || comes_back(test);
        frame->worst        = std::max(frame->worst, test.rms_before);
      };
      for (const DiagnosedTest &test : diagnosis.tests)
        if (!test.measured.empty())
          {
            add(test, false);
            if (!test.measured_y.empty())
              add(test, true);
          }
      n_left_out = 0;
      while (frames.size() > most_pictures)
        {
          frames.erase(std::min_element(frames.begin(),
                                        frames.end(),
                                        [](const Frame &a, const Frame &b) {
                                          return a.worst < b.worst;
                                        }));
          ++n_left_out;
        }
      return frames;
    }

    /// A band has a lower and an upper border in place of one value.
    Rows rows_of(const Curve &x,
                 const Curve &y,
                 const double band  = 0.,
                 Range *const range = nullptr)
    {
      Rows rows;
      for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i)
        {
          if (band > 0.)
            rows.push_back({x[i], y[i] - band, y[i] + band});
          else
            rows.push_back({x[i], y[i]});
          if (range != nullptr)
            range->add(y[i]);
        }
      return rows;
    }

    /// Far above zero, an axis from zero would hide the difference.
    Range with_zero(Range y)
    {
      if (y.lower > 0. && y.lower < 0.5 * y.upper)
        y.lower = 0.;
      return y;
    }

    /// NaN where there is none.
    double at(const Curve &curve, const std::size_t i)
    {
      return i < curve.size() ? curve[i] :
                                std::numeric_limits<double>::quiet_NaN();
    }

    /// Where friction rises or falls steeply, or rests.
    bool is_flank(const std::string &phase)
    {
      return phase == "presliding" || phase == "hold" || phase == "restart" ||
             phase == "reversal";
    }

    /// What the axis has to show. Flanks from zero would flatten a difference
    /// that is elsewhere, so that only half of its surroundings is shown.
    Range ordinate_of(const Frame &frame, const bool is_after)
    {
      Range  all, sliding;
      double on_flanks = 0., elsewhere = 0.;
      for (const DiagnosedTest *const test : frame.tests)
        for (std::size_t i = 0; i < frame.measured(*test).size(); ++i)
          {
            const double measured = frame.measured(*test)[i];
            const double before   = at(frame.before(*test), i);
            const double simulated =
              is_after ? at(frame.after(*test), i) : before;
            const bool is_steep =
              i >= test->phase.size() || is_flank(test->phase[i]);
            double &largest = is_steep ? on_flanks : elsewhere;
            largest         = std::max(largest, std::abs(measured - before));
            for (Range *const range : {&all, &sliding})
              if (range == &all || !is_steep)
                {
                  range->add(measured);
                  range->add(before);
                  range->add(simulated - 2. * noise_of_axis(*test));
                  range->add(simulated + 2. * noise_of_axis(*test));
                }
          }
      if (!(on_flanks < elsewhere) || !(sliding.width() > 0.))
        return with_zero(all);
      const double margin = 0.5 * sliding.width();
      return {std::max(all.lower, sliding.lower - margin),
              std::min(all.upper, sliding.upper + margin)};
    }

    const LegendLine measured_line  = {"measured", Colour::measured},
                     replicate_line = {"its replicates", "#a0a0a0"},
                     before_line    = {"before",
                                       Colour::before,
                                       LegendLine::dashed},
                     after_line     = {"after", Colour::after},
                     band_line      = {"± twice the noise",
                                       Colour::band,
                                       LegendLine::area};

    void
    draw_frame(SmallPicture &picture, const Frame &frame, const bool is_after)
    {
      const std::string x_name =
        frame.is_over_time ? "time_s" : "displacement_mm";
      Range      x;
      const auto add = [&](const DiagnosedTest &test,
                           const std::string   &what,
                           const Curve         &curve,
                           const std::string   &style) {
        picture.plot(test.name + ", " + what,
                     {x_name, "friction"},
                     rows_of(frame.abscissa(test), curve),
                     "with lines " + style);
      };
      const DiagnosedTest &first = *frame.tests.front();
      if (first.noise > 0.)
        picture.plot("band of the noise",
                     {x_name, "lower", "upper"},
                     rows_of(frame.abscissa(first),
                             is_after ? frame.after(first) :
                                        frame.before(first),
                             2. * noise_of_axis(first)),
                     "using 1:2:3 with filledcurves fillcolor rgb '" +
                       band_line.colour + "'");
      for (std::size_t i = frame.tests.size(); i-- > 0;)
        add(*frame.tests[i],
            "measured",
            frame.measured(*frame.tests[i]),
            (i == 0 ? measured_line : replicate_line).style(1.2));
      for (const DiagnosedTest *const test : frame.tests)
        {
          for (const double position : frame.abscissa(*test))
            x.add(position);
          add(*test,
              is_after ? "before" : "simulated",
              frame.before(*test),
              (is_after ? before_line : after_line).style());
          if (is_after)
            add(*test, "after", frame.after(*test), after_line.style());
        }
      picture.axes(frame.is_over_time ? "Time  [s]" : "Displacement  [mm]",
                   x,
                   "Friction  [–]",
                   ordinate_of(frame, is_after));
    }

    void draw_element_check(SmallPicture &picture, const ElementCheck &check)
    {
      Range y, x;
      for (const double position : check.displacement)
        x.add(position);
      const auto add = [&](const std::string &what,
                           const Curve       &curve,
                           const std::string &style) {
        if (!curve.empty())
          picture.plot(what,
                       {"displacement_mm", "friction"},
                       rows_of(check.displacement, curve, 0., &y),
                       "with lines " + style);
      };
      add("measured", check.measured, measured_line.style(1.2));
      add("contact point before", check.point_before, "lc rgb '#f0b58c' lw 4");
      add("contact point after", check.point_after, "lc rgb '#8fc3e6' lw 4");
      add("block before", check.block_before, before_line.style());
      add("block after", check.block_after, after_line.style());
      picture.axes("Displacement  [mm]", x, "Friction  [–]", with_zero(y));
    }
  } // namespace



  Gallery draw_tests(const std::filesystem::path &folder,
                     const Diagnosis             &diagnosis,
                     std::vector<std::string>    &warnings)
  {
    const bool               is_after   = has_after(diagnosis);
    std::size_t              n_left_out = 0, n_most = 0;
    const std::vector<Frame> frames = frames_of(diagnosis, n_left_out);
    Gallery     gallery{"Measured, before and after", "", {measured_line}, {}};
    std::string warning;
    for (std::size_t i = 0; i < frames.size(); ++i)
      {
        SmallPicture picture(folder,
                             "test_" + std::to_string(i + 1),
                             frames[i].title);
        draw_frame(picture, frames[i], is_after);
        picture.finish(gallery, warning);
        n_most = std::max(n_most, frames[i].tests.size());
      }
    if (n_most > 1)
      gallery.legend.push_back(replicate_line);
    if (is_after)
      gallery.legend.push_back(before_line);
    gallery.legend.push_back(after_line);
    if (!is_after)
      {
        gallery.title              = "Measured and simulated";
        gallery.legend.back().text = "simulated";
      }
    gallery.legend.push_back(band_line);
    gallery.caption = "With a law that lacks nothing, nearly all that was "
                      "measured lies within the band of the noise. Steep "
                      "flanks are cut off where the difference is elsewhere.";
    if (n_left_out > 0)
      gallery.caption += " " + std::to_string(n_left_out) +
                         " pictures are left out: those met best before.";
    if (!warning.empty())
      warnings.push_back(warning);
    return gallery;
  }



  Gallery draw_element_checks(const std::filesystem::path &folder,
                              const Diagnosis             &diagnosis,
                              std::vector<std::string>    &warnings)
  {
    Gallery     gallery{"",
                    "",
                    {measured_line,
                         {"block before", Colour::before, LegendLine::dashed},
                         {"block after", Colour::after},
                         {"contact point before", "#f0b58c"},
                         {"contact point after", "#8fc3e6"}},
                    {}};
    std::string warning;
    for (std::size_t i = 0; i < diagnosis.element_checks.size(); ++i)
      {
        const ElementCheck &check = diagnosis.element_checks[i];
        if (check.displacement.empty())
          continue;
        SmallPicture picture(folder,
                             "block_" + std::to_string(i + 1),
                             check.test);
        draw_element_check(picture, check);
        picture.finish(gallery, warning);
      }
    if (!warning.empty())
      warnings.push_back(warning);
    return gallery;
  }
} // namespace SlipStep
