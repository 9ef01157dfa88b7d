// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/point_driver.h>
#include <slipstep/report/run_figures.h>

#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/units.h>

#include <numeric>
#include <set>

namespace SlipStep
{
  namespace
  {
    std::string colour_of_run(const std::size_t i)
    {
      static const std::array<const char *, 7> colours = {"#0072B2",
                                                          "#D55E00",
                                                          "#009E73",
                                                          "#CC79A7",
                                                          "#E69F00",
                                                          "#56B4E9",
                                                          "#000000"};
      return colours[i % colours.size()];
    }

    std::string run_colour(const std::size_t i)
    {
      return "lc rgb '" + colour_of_run(i) + "'";
    }

    /// Displacement and friction along a direction.
    Rows curve_along(const RunResults &run, const double c, const double s)
    {
      Rows points;
      for (const HistoryRow &row : run.history)
        points.push_back({c * row.displacement + s * row.displacement_y,
                          c * row.friction + s * row.friction_y});
      return points;
    }

    /// Along the axis of the first slide, so that a reverse slide shows as the
    /// way back.
    Rows curve(const RunResults &run)
    {
      if (run.summary.slides.empty())
        return curve_along(run, 1., 0.);
      const double angle = run.summary.slides[0].angle;
      const double sign  = std::cos(angle) < -1e-9 ? -1. : 1.;
      return curve_along(run, sign * std::cos(angle), sign * std::sin(angle));
    }

    Rows friction_over_time(const RunResults &run)
    {
      Rows points;
      for (const HistoryRow &row : run.history)
        points.push_back({row.time, row.friction});
      return points;
    }

    /// Whether a slide is neither along the first one nor back.
    bool changes_direction(const RunResults &run)
    {
      const auto &slides = run.summary.slides;
      return any_of(slides, [&](const SlideSummary &slide) {
        return std::abs(std::sin(slide.angle - slides[0].angle)) > 1e-6;
      });
    }

    /// When a statement of the programme begins, counted from 1 [s]; 0 if a
    /// record that it follows is gone.
    double start_of(const unsigned int statement, const Parameters &parameters)
    try
      {
        const Programme programme = parse_programme(parameters);
        for (const Segment &segment : programme.segments())
          if (segment.statement + 1 == statement)
            return segment.start_time;
        return 0.;
      }
    catch (const InputError &)
      {
        return 0.;
      }

    /// The curve of the first slide alone, from where it starts: a record may
    /// be followed before.
    Rows first_slide(const RunFigures &figures, const RunResults &run)
    {
      if (run.summary.slides.empty() || run.history.empty())
        return {};
      const SlideSummary &slide = run.summary.slides[0];
      Rows                points =
        curve_along(run, std::cos(slide.angle), std::sin(slide.angle));
      const double begin =
        start_of(slide.statement, figures.parameters_of(run)) * (1. - 1e-9);
      const auto first =
        std::find_if(run.history.begin(),
                     run.history.end(),
                     [&](const HistoryRow &row) { return row.time >= begin; });
      points.erase(points.begin(),
                   points.begin() + (first - run.history.begin()));
      if (points.empty())
        return {};
      const double start = points[0][0];
      for (auto &point : points)
        point[0] -= start;
      points.erase(std::is_sorted_until(points.begin(),
                                        points.end(),
                                        [](const auto &a, const auto &b) {
                                          return a[0] < b[0];
                                        }),
                   points.end());
      return points;
    }

    /// Order in which a legend beside the curves lists them as they lie.
    std::vector<std::size_t> from_top_to_bottom(const Runs &runs)
    {
      std::vector<std::size_t> order(runs.size());
      std::iota(order.begin(), order.end(), 0);
      stable_sort(order, [&runs](const std::size_t a, const std::size_t b) {
        return runs[a].summary.final_friction > runs[b].summary.final_friction;
      });
      return order;
    }



    /// The legend has the reference, too.
    LegendPlace place_names(const RunFigures  &figures,
                            const unsigned int height)
    {
      std::vector<std::string> others;
      if (figures.reference.exists())
        others = {figures.reference.name};
      return place_legend(figures.runs, others, height);
    }

    /// The only run that slides at this speed; runs.size() if there is none or
    /// several do.
    std::size_t run_of_speed(const Runs &runs, const double speed)
    {
      std::size_t found = runs.size();
      for (std::size_t i = 0; i < runs.size(); ++i)
        if (any_of(runs[i].summary.slides, [&](const SlideSummary &slide) {
              return std::abs(slide.speed - speed) < 1e-6 * speed;
            }))
          {
            if (found < runs.size())
              return runs.size();
            found = i;
          }
      return found;
    }

    /// Speeds at which the reference is marked: the stated ones, or else those
    /// of the runs.
    std::vector<double> marked_speeds(const RunFigures &figures)
    {
      const Reference &reference = figures.reference;
      if (!reference.exists() || !reference.speeds.empty())
        return reference.exists() ? reference.speeds : std::vector<double>();
      std::vector<double> speeds;
      for (const RunResults &run : figures.runs)
        for (const SlideSummary &slide : run.summary.slides)
          speeds.push_back(slide.speed);
      std::sort(speeds.begin(), speeds.end());
      speeds.erase(std::unique(speeds.begin(),
                               speeds.end(),
                               [](const double a, const double b) {
                                 return b - a < 1e-6 * a;
                               }),
                   speeds.end());
      return speeds;
    }

    /// Whether friction of its first slide is shown negative.
    bool is_drawn_below(const RunResults &run)
    {
      return !run.summary.slides.empty() &&
             std::cos(run.summary.slides[0].angle) < -1e-9;
    }

    /// Short strokes right of the curves where the reference expects them.
    void plot_reference(Figure           &figure,
                        const RunFigures &figures,
                        const double      from,
                        const double      to)
    {
      const auto               &runs      = figures.runs;
      const Reference          &reference = figures.reference;
      const std::vector<double> speeds    = marked_speeds(figures);
      // On the side of the curves.
      const double sign = all_of(runs, is_drawn_below) ? -1. : 1.;
      for (const double speed : speeds)
        {
          const double      level = sign * reference.kinetic(speed);
          const std::size_t run   = run_of_speed(runs, speed);
          const std::string style =
            run < runs.size() ? run_colour(run) : "lc rgb '#777777'";
          figure.plot(
            figure.add_data(reference.name + " at " + speed_text(speed),
                            {"displacement_mm", "friction"},
                            {{from, level}, {to, level}}) +
            " with lines lw 4 " + style + " notitle");
        }
      if (!speeds.empty())
        figure.plot("NaN with lines lw 4 lc rgb '#777777' title " +
                    gnuplot_text(reference.name));
    }



    void add_friction_picture(RunFigures &figures)
    {
      const auto       &runs      = figures.runs;
      const auto       &reference = figures.reference;
      const bool        is_moved  = any_of(runs, is_driven);
      const std::string title =
        is_moved ? "Friction against displacement" : "Friction over time";
      const auto legend_place = place_names(figures, 430);
      Figure     figure =
        figures.figure("friction", title, 430 + legend_place.more_height);
      Range x, y;
      for (const std::size_t i : from_top_to_bottom(runs))
        {
          const Rows points =
            is_moved ? curve(runs[i]) : friction_over_time(runs[i]);
          x.add(points, 0);
          y.add(points, 1);
          plot_run(figure,
                   runs[i],
                   i,
                   {is_moved ? "displacement_mm" : "time_s", "friction"},
                   points);
        }
      if (!(x.width() > 0.))
        x = {0., 1.};
      plot_reference(figure,
                     figures,
                     x.upper + 0.015 * x.width(),
                     x.upper + 0.06 * x.width());
      figure.script() << axes_style << legend_place.commands
                      << (is_moved ?
                            "set xlabel 'Displacement of the drive  [mm]'\n" :
                            "set xlabel 'Time  [s]'\n")
                      << "set ylabel 'Friction  (tangential / normal load)'\n"
                      // The first rise shall not hide on the axis.
                      << "set xrange [" << x.lower - 0.01 * x.width() << ":"
                      << x.upper + 0.06 * x.width() << "]\n";
      // Round-off below 0 is nothing that can be seen.
      if (y.lower >= -1e-3)
        figure.script() << (y.upper > 1e-9 ? "set yrange [0:*]\n" :
                                             "set yrange [0:0.01]\n");
      else
        figure.script() << "set xzeroaxis lc rgb '#444444' lw 1 dt solid\n";
      std::string caption;
      if (any_of(runs, changes_direction))
        caption = "Friction and displacement are those along the direction of "
                  "the first slide. ";
      if (!marked_speeds(figures).empty())
        caption += "Short lines at the right end: kinetic level after " +
                   reference.name +
                   ", in the colour of the run at that speed, grey where no "
                   "run or several runs have that speed.";
      figures.add(figure, title, caption);
    }



    /// Displacement that shows the static peak well; 0 if the whole curve does.
    double zoom_length(const Runs &runs)
    {
      double peak = 0., length = 0.;
      for (const RunResults &run : runs)
        if (!run.summary.slides.empty())
          {
            const SlideSummary &slide = run.summary.slides[0];
            length                    = std::max(length, slide.length);
            // A curve that only rises has its peak at the end.
            if (slide.peak_displacement < 0.5 * slide.length)
              peak = std::max(peak, slide.peak_displacement);
          }
      const double zoom = peak > 0. ? round_up(5. * peak) : 0.;
      return zoom < 0.4 * length ? zoom : 0.;
    }

    void add_zoom_picture(RunFigures &figures)
    {
      const auto  &runs = figures.runs;
      const double zoom = zoom_length(runs);
      if (zoom == 0.)
        return;
      const auto               legend_place = place_names(figures, 380);
      Figure                   figure       = figures.figure("friction_start",
                                     "Friction at the start of the slide",
                                     380 + legend_place.more_height);
      const ResultRows         rows = result_rows(runs, figures.reference);
      std::vector<std::string> peaks;
      for (const std::size_t i : from_top_to_bottom(runs))
        {
          Rows points = first_slide(figures, runs[i]);
          // One point beyond the border lets the curve run off the picture.
          const auto beyond =
            std::find_if(points.begin(),
                         points.end(),
                         [zoom](const auto &point) { return point[0] > zoom; });
          if (beyond != points.end())
            points.erase(beyond + 1, points.end());
          plot_run(figure, runs[i], i, {"displacement_mm", "friction"}, points);
          const auto first =
            std::find_if(rows.begin(), rows.end(), [i](const ResultRow &row) {
              return row.run == i;
            });
          if (first == rows.end() || !first->has_peak ||
              first->slide.peak_displacement > zoom)
            continue;
          const SlideSummary &slide = first->slide;
          peaks.push_back(
            figure.add_data("peak of " + legend(runs[i]),
                            {"displacement_mm", "friction"},
                            {{slide.peak_displacement, slide.peak}}) +
            " with points pt 7 ps 0.7 " + run_colour(i) + " notitle");
        }
      for (const std::string &peak : peaks)
        figure.plot(peak);
      figure.script() << axes_style << legend_place.commands
                      << "set xlabel 'Displacement since the start of the "
                         "slide  [mm]'\n"
                         "set ylabel 'Friction  (tangential / normal load)'\n"
                         "set xrange [0:"
                      << zoom << "]\nset yrange [0:*]\n";
      const std::string part =
        "The first " + short_text(zoom) + " mm of the slide";
      if (peaks.empty())
        figures.add(figure, "The start of the slide", part + ".");
      else
        figures.add(figure, "The static peak", part + "; dots mark the peaks.");
    }



    // Of slides with kinetic friction, over their speeds [mm/min], by run.
    std::vector<Rows> steady_ratios(const RunFigures &figures, Range &speeds)
    {
      std::vector<Rows> ratios(figures.runs.size());
      for (const ResultRow &row : result_rows(figures.runs, figures.reference))
        if (row.has_kinetic())
          {
            ratios[row.run].push_back(
              {row.slide.speed * mm_min, row.slide.dynamic_ratio});
            speeds.add(row.slide.speed * mm_min);
          }
      return ratios;
    }



    // Whether runs have slides at the same speed, so that speed does not say
    // which is which.
    bool share_speeds(const std::vector<Rows> &ratios)
    {
      std::set<double> speeds;
      for (const Rows &of_run : ratios)
        {
          std::set<double> own;
          for (const auto &row : of_run)
            own.insert(row[0]);
          for (const double speed : own)
            if (!speeds.insert(speed).second)
              return true;
        }
      return false;
    }



    Rows reference_line(const Reference &reference, const Range &speeds)
    {
      Rows line;
      for (int i = 0; i <= 60; ++i)
        {
          const double speed =
            speeds.lower * std::pow(speeds.upper / speeds.lower, i / 60.);
          line.push_back({speed, reference.dynamic_ratio(speed / mm_min)});
        }
      return line;
    }



    // By colours of runs that share speeds, else as one.
    void plot_simulated(const RunFigures               &figures,
                        const std::vector<Rows>        &simulated,
                        const bool                      is_by_run,
                        const std::vector<std::string> &columns,
                        Figure                         &figure)
    {
      const std::string dots = " with points pt 7 ps 0.8 ";
      Rows              all;
      for (std::size_t i = 0; i < simulated.size(); ++i)
        if (!is_by_run)
          all.insert(all.end(), simulated[i].begin(), simulated[i].end());
        else if (!simulated[i].empty())
          figure.plot(
            figure.add_data(legend(figures.runs[i]), columns, simulated[i]) +
            dots + run_colour(i) + " title " +
            gnuplot_text(legend(figures.runs[i])));
      if (!is_by_run)
        figure.plot(figure.add_data("simulated", columns, all) + dots +
                    "lc rgb '#0072B2' title 'simulated'");
    }



    void add_speed_picture(RunFigures &figures)
    {
      const auto &reference = figures.reference;
      Range       speeds;
      const auto  simulated = steady_ratios(figures, speeds);
      if (!(speeds.upper >= 1.001 * speeds.lower))
        return;

      Rows marks, line;
      if (reference.dynamic_ratio(speeds.lower / mm_min) > 0.)
        {
          for (const double speed : marked_speeds(figures))
            {
              marks.push_back({speed * mm_min, reference.dynamic_ratio(speed)});
              speeds.add(speed * mm_min);
            }
          line = reference_line(reference, speeds);
        }

      const bool is_by_run    = share_speeds(simulated);
      const auto legend_place = place_legend(is_by_run ? figures.runs : Runs(),
                                             {reference.name, "simulated"},
                                             380);
      const Range x      = {speeds.lower / 1.6, speeds.upper * 1.6};
      Figure      figure = figures.figure("ratio_over_speed",
                                     "Dynamic loading ratio against speed",
                                     380 + legend_place.more_height);
      figure.script() << axes_style << legend_place.commands
                      << "set logscale x\nset format x '%g'\n"
                      << few_tics('x', x.lower, x.upper, true)
                      << "set xlabel 'Sliding speed  [mm/min]'\n"
                         "set ylabel 'Dynamic loading ratio  r  [–]'\n"
                         "set offsets 0, 0, graph 0.08, graph 0.08\n"
                      << "set xrange " << x << '\n';
      const std::vector<std::string> columns = {"speed_mm/min", "r"};
      if (!marks.empty())
        {
          figure.plot(figure.add_data(reference.name, columns, line) +
                      " with lines lw 1.2 lc rgb '#D55E00' notitle");
          figure.plot(
            figure.add_data(reference.name + ", marks", columns, marks) +
            " with points pt 6 ps 1.3 lw 1.8 lc rgb '#D55E00' title " +
            gnuplot_text(reference.name));
        }
      plot_simulated(figures, simulated, is_by_run, columns, figure);
      figures.add(figure,
                  "Rate dependence",
                  marks.empty() ? "r at the end of each slide." :
                                  "r at the end of each slide; the reference "
                                  "coefficient is divided by its quasi-static "
                                  "value.");
    }
  } // namespace



  std::string legend(const RunResults &run)
  {
    if (!run.short_label.empty())
      return run.short_label;
    return run.summary.slides.empty() ? run.summary.command :
                                        speed_text(run.summary.slides[0].speed);
  }



  LegendPlace place_legend(const Runs                     &runs,
                           const std::vector<std::string> &others,
                           const unsigned int              height)
  {
    std::vector<std::string> names = others;
    for (const RunResults &run : runs)
      names.push_back(legend(run));
    std::size_t longest = 0;
    for (const std::string &name : names)
      longest = std::max(longest, name.size());

    // What is drawn beside a name, with a margin, and 8 pixels a letter. (Left
    // to itself, gnuplot takes more than browsers need.)
    const double           width      = 80. + 8. * longest;
    constexpr unsigned int row_height = 29, above_and_below = 90;
    LegendPlace            place;
    place.is_beside = width <= 0.4 * picture_width &&
                      row_height * names.size() + above_and_below <= height;
    if (place.is_beside)
      {
        const double edge = 1. - width / picture_width;
        place.commands    = "set rmargin at screen " + short_text(edge) +
                         "\nset key at screen " + short_text(edge + 0.02) +
                         ", graph 1 left top\n";
        return place;
      }
    const unsigned int n_columns =
      std::max(1, static_cast<int>(picture_width / width));
    place.more_height =
      row_height * ((names.size() + n_columns - 1) / n_columns);
    place.commands = "set key outside below left Left reverse maxcols " +
                     std::to_string(n_columns) + "\n";
    return place;
  }



  std::string run_legend(const Runs &runs)
  {
    static const std::array<std::string, 4> kinds = {
      {"line", "dashed", "dotted", "dashed"}};
    std::vector<LegendLine> lines;
    for (std::size_t i = 0; i < runs.size(); ++i)
      lines.push_back(
        {legend(runs[i]), colour_of_run(i), kinds[i % kinds.size()]});
    return legend_line(lines);
  }



  std::string run_style(const std::size_t i)
  {
    static const std::array<const char *, 4> dashes = {"solid",
                                                       "(12,4)",
                                                       "(4,3)",
                                                       "(12,4,3,4)"};
    return run_colour(i) + " dt " + dashes[i % dashes.size()];
  }



  void plot_run(Figure                         &figure,
                const RunResults               &run,
                const std::size_t               i,
                const std::vector<std::string> &columns,
                const Rows                     &points,
                const double                    line_width,
                const bool                      is_named)
  {
    figure.plot(
      figure.add_data(legend(run), columns, thinned(points)) +
      " with lines lw " + exact_text(line_width) + " " + run_style(i) +
      (is_named ? " title " + gnuplot_text(legend(run)) : " notitle"));
  }



  // A run that could not be read is not there, so they are found by name.
  Parameters RunFigures::parameters_of(const RunResults &run) const
  {
    for (const Variant &variant : parameters.variants())
      if (variant.label == run.label)
        return parameters.with_variant(variant);
    return parameters;
  }



  Figure RunFigures::figure(const std::string &name,
                            const std::string &title,
                            const unsigned int height) const
  {
    return Figure(page.pictures, name, title, picture_width, height);
  }



  void RunFigures::add(Figure            &figure,
                       const std::string &title,
                       const std::string &caption,
                       const bool         is_map)
  {
    shown += figure_element(title, page.svg_of(figure), caption, is_map);
  }



  void draw_pictures(RunFigures &figures)
  {
    const auto &runs = figures.runs;
    if (all_of(runs, [](const RunResults &run) { return curve(run).empty(); }))
      return;
    // What the case asks for comes first.
    add_requested_pictures(figures);
    add_grid_pictures(figures);
    add_measured_pictures(figures);
    add_friction_picture(figures);
    add_zoom_picture(figures);
    add_speed_picture(figures);

    // One of several blocks that look alike.
    figures.shown += block_picture(runs.back(), figures.page.warnings);

    // A cell costs some 300 bytes: the page shall stay quick to open.
    const std::size_t most_cells = 10000;
    std::size_t       n_cells    = 0;
    for (std::size_t i = 0; i < runs.size(); ++i)
      {
        const std::size_t size =
          runs[i].contact_face ? runs[i].contact_face->cells.size() : 0;
        if (size == 0 || (n_cells > 0 && n_cells + size > most_cells))
          continue;
        (n_cells > 0 ? figures.folded : figures.shown) += draw_face(figures, i);
        n_cells += size;
      }
  }
} // namespace SlipStep
