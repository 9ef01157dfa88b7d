// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/curves.h>

namespace SlipStep
{
  namespace
  {
    constexpr std::size_t most_frames = 12;



    /// Whether a motion comes back, noise aside, or there is none.
    bool comes_back(const std::vector<double> &displacement)
    {
      Range  all;
      double fall = 0., rise = 0.;
      for (const double x : displacement)
        {
          all.add(x);
          fall = std::max(fall, all.upper - x);
          rise = std::max(rise, x - all.lower);
        }
      return std::min(fall, rise) > 0.01 * all.width() || !(all.width() > 0.);
    }

    /// First, last, lowest and highest point of every column of pixels: the
    /// picture stays the same and the page small.
    Rows extremes_per_column(const Rows       &points,
                             const Range      &x,
                             const std::size_t n_columns)
    {
      if (points.size() <= 4 * n_columns)
        return points;
      const bool is_backward = points.back()[0] < points.front()[0];
      const auto column_of   = [&](const std::vector<double> &point) {
        const double share = (point[0] - x.lower) / x.width();
        return static_cast<std::size_t>(
          std::clamp(is_backward ? 1. - share : share, 0., 1.) *
          (n_columns - 1));
      };
      // Noise of the displacement shall not open a column again.
      return extremes_of_columns(points, [&](const auto &a, const auto &b) {
        return column_of(b) <= column_of(a);
      });
    }



    /// What the axis has to show. Flanks from zero would flatten a difference
    /// that is elsewhere, so that only half of its surroundings is shown.
    Range ordinate_of(const ConditionFrame &frame)
    {
      Range  all, sliding;
      double on_flanks = 0., elsewhere = 0.;
      for (const DrawnTest *const test : frame.tests)
        for (std::size_t i = 0; i < test->measured.size(); ++i)
          {
            const double position = frame.abscissa(*test)[i];
            if (position < frame.x.lower || position > frame.x.upper)
              continue;
            const auto at = [i](const std::vector<double> &curve) {
              return i < curve.size() ? curve[i] : std::nan("");
            };
            const double measured  = test->measured[i];
            const double simulated = at(test->simulated);
            const double first =
              test->before.empty() ? simulated : at(test->before);
            const bool is_steep =
              i >= test->is_flank.size() || test->is_flank[i];
            double &largest = is_steep ? on_flanks : elsewhere;
            largest         = std::max(largest, std::abs(measured - first));
            for (Range *const range : {&all, &sliding})
              if (range == &all || !is_steep)
                for (const double value : {measured,
                                           first,
                                           simulated - 2. * test->noise,
                                           simulated + 2. * test->noise})
                  range->add(value);
          }
      if (!(on_flanks < elsewhere) || !(sliding.width() > 0.))
        return with_zero(all);
      const double margin = 0.5 * sliding.width();
      return {std::max(all.lower, sliding.lower - margin),
              std::min(all.upper, sliding.upper + margin)};
    }

    void draw_frame(SmallPicture         &picture,
                    const ConditionFrame &frame,
                    const LegendLine     &simulated_line)
    {
      const std::string x_name =
        frame.is_over_time ? "time_s" : "displacement_mm";
      const DrawnTest &first = *frame.tests.front();
      if (first.noise > 0.)
        {
          Rows band = frame.rows(first, first.simulated);
          for (std::vector<double> &row : band)
            row = {row[0],
                   row[1] - 2. * first.noise,
                   row[1] + 2. * first.noise};
          picture.plot(picture.add_data("band of the noise",
                                        {x_name, "lower", "upper"},
                                        band) +
                       " using 1:2:3 with filledcurves fillcolor rgb '" +
                       noise_band_line.colour + "'");
        }
      const auto add = [&](const DrawnTest           &test,
                           const std::string         &what,
                           const std::vector<double> &values,
                           const std::string         &style) {
        picture.plot(picture.add_data(test.name + ", " + what,
                                      {x_name, "friction"},
                                      frame.rows(test, values)) +
                     " with lines " + style);
      };
      for (std::size_t i = frame.tests.size(); i-- > 0;)
        add(*frame.tests[i],
            "measured",
            frame.tests[i]->measured,
            (i == 0 ? measured_line : replicate_line).style(1.2));
      for (const DrawnTest *const test : frame.tests)
        {
          if (!test->before.empty())
            add(*test, "before", test->before, before_line.style());
          add(*test,
              simulated_line.text,
              test->simulated,
              simulated_line.style());
        }
      frame.axes(picture, "Friction  [–]", ordinate_of(frame));
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
      // What too few rows tell of is left open.
      Rows rows;
      for (std::size_t part = 0; part < n_parts; ++part)
        rows.push_back(
          {frame.x.lower + (part + 0.5) / n_parts * frame.x.width(),
           count[part] < least ? std::nan("") : sum[part] / count[part]});
      return all_of(count, [](const std::size_t n) { return n < least; }) ?
               Rows() :
               rows;
    }

    const LegendLine residual_line = {"measured − fitted", Colour::measured},
                     mean_line     = {"local mean", "#000000"};

    // Returns whether there are local means.
    bool draw_left_over(SmallPicture &picture, const ConditionFrame &frame)
    {
      double band = 0.;
      Range  y;
      for (const DrawnTest *const test : frame.tests)
        band = std::max(band, 2. * test->noise);
      picture.plot(picture.add_data("twice the noise",
                                    {"position", "lower", "upper"},
                                    {{frame.x.lower, -band, band},
                                     {frame.x.upper, -band, band}}) +
                   " using 1:2:3 with filledcurves fillcolor rgb '" +
                   noise_band_line.colour + "'");
      for (std::size_t i = frame.tests.size(); i-- > 0;)
        {
          const DrawnTest &test = *frame.tests[i];
          const Rows       rows = frame.rows(test, residuals(test));
          for (const auto &row : rows)
            y.add(std::abs(row[1]));
          picture.plot(
            picture.add_data(test.name,
                             {frame.is_over_time ? "time_s" : "displacement_mm",
                              "measured_minus_fitted"},
                             rows) +
            " with lines " +
            (i == 0 ? residual_line : replicate_line).style(1.2));
        }
      // Seen through dense curves.
      for (const double level : {-band, band})
        picture.plot_level(level, "lc rgb '#444444' dt (6,4) lw 1.2");
      const Rows means = local_means(frame);
      if (!means.empty())
        picture.plot(picture.add_data(frame.title + ", local means",
                                      {"position", "mean"},
                                      means) +
                     " with linespoints pt 7 ps 0.25 " + mean_line.style(2.2));
      y.add(band);
      frame.axes(picture, "Measured − fitted  [–]", {-y.upper, y.upper});
      return !means.empty();
    }
  } // namespace



  const LegendLine measured_line   = {"measured", Colour::measured};
  const LegendLine replicate_line  = {"its replicates", "#a0a0a0"};
  const LegendLine before_line     = {"before", Colour::before, "dashed"};
  const LegendLine noise_band_line = {"± twice the noise",
                                      Colour::band,
                                      "area"};



  Range with_zero(Range y)
  {
    if (y.lower > 0. && y.lower < 0.5 * y.upper)
      y.lower = 0.;
    return y;
  }



  Rows ConditionFrame::rows(const DrawnTest           &test,
                            const std::vector<double> &values) const
  {
    const std::vector<double> &position  = abscissa(test);
    const auto                 is_inside = [&](const std::size_t i) {
      return position[i] >= x.lower && position[i] <= x.upper;
    };
    Rows points;
    for (std::size_t i = 0; i < std::min(position.size(), values.size()); ++i)
      // One point beyond the border lets the curve run off the picture.
      if ((is_inside(i) || (i > 0 && is_inside(i - 1)) ||
           (i + 1 < position.size() && is_inside(i + 1))) &&
          std::isfinite(position[i]) && std::isfinite(values[i]))
        points.push_back({position[i], values[i]});
    return extremes_per_column(points, x, n_columns);
  }



  void ConditionFrame::axes(SmallPicture      &picture,
                            const std::string &label,
                            const Range       &y) const
  {
    picture.axes(is_over_time ? "Time  [s]" : "Displacement  [mm]",
                 x,
                 label,
                 y);
  }



  std::vector<ConditionFrame>
  condition_frames(const std::vector<DrawnTest> &tests, std::string &caption)
  {
    std::vector<ConditionFrame> frames;
    for (const DrawnTest &test : tests)
      {
        if (test.measured.empty())
          continue;
        const std::string &title =
          test.condition.empty() ? test.name : test.condition;
        auto frame =
          std::find_if(frames.begin(), frames.end(), [&](const auto &other) {
            return other.title == title;
          });
        if (frame == frames.end())
          {
            frame        = frames.emplace(frame);
            frame->title = title;
          }
        frame->tests.push_back(&test);
        frame->is_over_time =
          frame->is_over_time || comes_back(test.displacement);
        frame->gap = std::max(frame->gap, test.gap);
      }
    const std::size_t n_all = frames.size();
    while (frames.size() > most_frames)
      frames.erase(std::min_element(frames.begin(),
                                    frames.end(),
                                    [](const auto &a, const auto &b) {
                                      return a.gap < b.gap;
                                    }));
    std::size_t n_tests = 0;
    for (const ConditionFrame &frame : frames)
      n_tests += frame.tests.size();
    for (ConditionFrame &frame : frames)
      {
        // Many curves share what a page may weigh.
        frame.n_columns = std::clamp<std::size_t>(10000 / n_tests, 60, 500);
        for (const DrawnTest *const test : frame.tests)
          for (const double position : frame.abscissa(*test))
            frame.x.add(position);
      }
    if (any_of(frames, has_replicates))
      caption = "Tests under the same condition share a picture. ";
    if (n_all > frames.size())
      caption += std::to_string(n_all - frames.size()) + " of " +
                 std::to_string(n_all) +
                 " pictures are left out: those met best. ";
    return frames;
  }



  std::string draw_friction(Page                              &page,
                            const std::string                 &name,
                            const std::string                 &title,
                            const std::string                 &caption,
                            const std::vector<ConditionFrame> &frames,
                            const std::string                 &simulated)
  {
    const LegendLine simulated_line{simulated, Colour::after};
    Gallery          gallery{title, caption, {measured_line}};
    for (std::size_t i = 0; i < frames.size(); ++i)
      {
        SmallPicture picture(page,
                             name + "_" + std::to_string(i + 1),
                             frames[i].title);
        draw_frame(picture, frames[i], simulated_line);
        picture.finish(gallery);
      }
    if (any_of(frames, has_replicates))
      gallery.legend.push_back(replicate_line);
    if (any_of(frames, [](const ConditionFrame &frame) {
          return !frame.tests.front()->before.empty();
        }))
      gallery.legend.push_back(before_line);
    gallery.legend.push_back(simulated_line);
    gallery.legend.push_back(noise_band_line);
    return gallery_section(gallery);
  }



  std::string draw_residuals(Page                              &page,
                             const std::vector<ConditionFrame> &frames)
  {
    Gallery gallery{"What is left over",
                    "With a law that fits, nearly all points lie within the "
                    "band, and the local mean stays near zero (it is taken "
                    "over a fortieth of the width, where that has five rows).",
                    {residual_line}};
    bool    has_means = false;
    for (std::size_t i = 0; i < frames.size(); ++i)
      {
        SmallPicture picture(page,
                             "residuals_" + std::to_string(i + 1),
                             frames[i].title);
        has_means = draw_left_over(picture, frames[i]) || has_means;
        picture.finish(gallery);
      }
    if (any_of(frames, has_replicates))
      gallery.legend.push_back(replicate_line);
    if (has_means)
      gallery.legend.push_back(mean_line);
    gallery.legend.push_back(noise_band_line);
    return gallery_section(gallery);
  }
} // namespace SlipStep
