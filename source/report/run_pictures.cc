// SPDX-License-Identifier: LGPL-2.1-or-later

// The pictures that a case asks for: "Report/Pictures".

#include <slipstep/report/drawing.h>
#include <slipstep/utilities/text.h>
#include <slipstep/utilities/units.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  namespace
  {
    using Values = std::vector<double>;

    /// What one value is of.
    enum class ValueOf
    {
      slide,
      step,
      speed
    };

    /// What can be drawn over another one that has values of the same.
    struct PictureQuantity
    {
      std::string name;
      std::string label;
      ValueOf     of;
      double (*of_slide)(const ResultRow &)        = nullptr;
      double (*of_step)(const HistoryRow &)        = nullptr;
      double (*of_speed)(const StabilitySummary &) = nullptr;
    };

    PictureQuantity slide_quantity(const std::string &name,
                                   const std::string &label,
                                   double (*value)(const ResultRow &))
    {
      return {name, label, ValueOf::slide, value};
    }

    PictureQuantity step_quantity(const std::string &name,
                                  const std::string &label,
                                  double (*value)(const HistoryRow &))
    {
      return {name, label, ValueOf::step, nullptr, value};
    }

    PictureQuantity speed_quantity(const std::string &name,
                                   const std::string &label,
                                   double (*value)(const StabilitySummary &))
    {
      return {name, label, ValueOf::speed, nullptr, nullptr, value};
    }

    constexpr double absent = std::numeric_limits<double>::quiet_NaN();

    std::vector<PictureQuantity> quantities_of_slides()
    {
      using Row = const ResultRow &;
      return {
        slide_quantity("peak",
                       "Peak friction",
                       [](Row row) {
                         return row.has_peak ? row.slide.peak : absent;
                       }),
        slide_quantity("dip",
                       "Least friction after the step",
                       [](Row row) {
                         return row.has_dip ? row.slide.dip : absent;
                       }),
        slide_quantity("kinetic",
                       "Kinetic friction",
                       [](Row row) { return row.slide.kinetic; }),
        slide_quantity("dynamic ratio",
                       "Dynamic loading ratio  r",
                       [](Row row) { return row.slide.dynamic_ratio; }),
        slide_quantity("drop",
                       "Drop from peak to kinetic  [%]",
                       [](Row row) { return row.drop; }),
        slide_quantity("rest",
                       "Time at rest before  [s]",
                       [](Row row) {
                         return row.slide.rest > 0. ? row.slide.rest : absent;
                       }),
        slide_quantity("pressure",
                       "Pressure  [MPa]",
                       [](Row row) { return row.slide.pressure; }),
        slide_quantity("speed",
                       "Sliding speed  [mm/min]",
                       [](Row row) { return row.slide.speed * mm_min; }),
        slide_quantity("direction",
                       "Direction of sliding  [deg]",
                       [](Row row) {
                         return row.slide.angle * 180. / dealii::numbers::PI;
                       }),
        slide_quantity("statement", "Statement of the programme", [](Row row) {
          return static_cast<double>(row.slide.statement);
        })};
    }

    std::vector<PictureQuantity> quantities_of_steps()
    {
      using Row                  = const HistoryRow &;
      const std::string friction = "Friction  (tangential / normal load)";
      return {step_quantity("friction",
                            friction,
                            [](Row row) { return row.friction; }),
              step_quantity("friction y",
                            "Friction along the second axis",
                            [](Row row) { return row.friction_y; }),
              step_quantity("force",
                            "Tangential load  [N]",
                            [](Row row) { return row.tangential_load; }),
              step_quantity("r",
                            "Loading ratio  r",
                            [](Row row) { return row.loading_ratio.mean; }),
              step_quantity("r_s",
                            "Normal ratio  r_s",
                            [](Row row) { return row.normal_ratio.mean; }),
              step_quantity("mu",
                            "Coefficient  μ",
                            [](Row row) { return row.coefficient.mean; }),
              step_quantity("slip",
                            "Slip path  [mm]",
                            [](Row row) { return row.slip; }),
              step_quantity("slipping share",
                            "Share of the contact that slips  [%]",
                            [](Row row) { return 100. * row.slip_fraction; }),
              step_quantity("spring load",
                            "Load of the spring / normal load",
                            [](Row row) {
                              return row.probes.size() > 2 ? row.probes[2] :
                                                             absent;
                            }),
              step_quantity("dissipation",
                            "Dissipated energy  [N mm]",
                            [](Row row) { return row.dissipated_energy; }),
              step_quantity("displacement",
                            "Displacement of the drive  [mm]",
                            [](Row row) { return row.displacement; }),
              step_quantity("pressure",
                            "Pressure  [MPa]",
                            [](Row row) { return row.pressure; }),
              step_quantity("time", "Time  [s]", [](Row row) {
                return row.time;
              })};
    }

    std::vector<PictureQuantity> quantities_of_speeds()
    {
      using Row = const StabilitySummary &;
      return {speed_quantity("critical stiffness",
                             "Critical stiffness  [MPa/mm]",
                             [](Row row) { return row.critical_stiffness; }),
              speed_quantity("stiffness",
                             "Stiffness of the machine  [MPa/mm]",
                             [](Row row) { return row.stiffness; }),
              speed_quantity("speed", "Sliding speed  [mm/min]", [](Row row) {
                return row.speed * mm_min;
              })};
    }

    std::vector<PictureQuantity> picture_quantities()
    {
      std::vector<PictureQuantity> all = quantities_of_slides();
      for (const auto &more : {quantities_of_steps(), quantities_of_speeds()})
        all.insert(all.end(), more.begin(), more.end());
      return all;
    }

    struct RequestedPicture
    {
      std::string     text;
      PictureQuantity y, x;

      /// Axes of one scale, as direction has a meaning there.
      bool is_polar() const
      {
        return x.name == "direction" ||
               (y.name == "friction y" && x.name == "friction");
      }
    };

    /// @throws InputError
    RequestedPicture read_picture(const std::string &text)
    {
      const std::string over  = " over ";
      const auto        place = text.find(over);
      if (place == std::string::npos)
        throw InputError("\"" + text +
                         "\": expected is what over what, e.g. \"peak over "
                         "rest\"");
      const std::string y = dealii::Utilities::trim(text.substr(0, place));
      const std::string x =
        dealii::Utilities::trim(text.substr(place + over.size()));
      const auto all      = picture_quantities();
      const auto is_known = [&all](const std::string &name) {
        return std::any_of(all.begin(), all.end(), [&](const auto &quantity) {
          return quantity.name == name;
        });
      };
      for (const std::string &name : {y, x})
        if (!is_known(name))
          throw InputError("\"" + name + "\" is not known; allowed are: " +
                           picture_quantity_names());
      if (y == x)
        throw InputError("\"" + text + "\": that is a straight line");
      for (const PictureQuantity &one : all)
        for (const PictureQuantity &other : all)
          if (one.name == y && other.name == x && one.of == other.of)
            return {text, one, other};
      throw InputError("\"" + text +
                       "\": one is of whole slides, the other of "
                       "single instants or of speeds");
    }

    std::vector<RequestedPicture>
    requested_pictures(const Parameters &parameters)
    {
      const std::string             key = "Report/Pictures";
      std::vector<RequestedPicture> pictures;
      for (const std::string &text : parameters.list(key))
        try
          {
            pictures.push_back(read_picture(text));
            for (std::size_t i = 0; i + 1 < pictures.size(); ++i)
              if (pictures[i].y.name == pictures.back().y.name &&
                  pictures[i].x.name == pictures.back().x.name)
                throw InputError("\"" + text + "\" is there twice");
          }
        catch (const InputError &error)
          {
            parameters.reject(key, error.what());
          }
      return pictures;
    }

    Rows points_of(const RequestedPicture &picture,
                   const RunResults       &run,
                   const Reference        &reference)
    {
      Rows       rows;
      const auto add = [&](const double x, const double y) {
        if (!std::isfinite(x) || !std::isfinite(y))
          return;
        const double angle = x * dealii::numbers::PI / 180.;
        if (picture.x.name == "direction")
          rows.push_back({y * std::cos(angle), y * std::sin(angle)});
        else
          rows.push_back({x, y});
      };
      switch (picture.y.of)
        {
          case ValueOf::slide:
            for (const ResultRow &row : result_rows({run}, reference))
              add(picture.x.of_slide(row), picture.y.of_slide(row));
            break;
          case ValueOf::step:
            for (const HistoryRow &row : run.history)
              add(picture.x.of_step(row), picture.y.of_step(row));
            rows = thinned(rows);
            break;
          case ValueOf::speed:
            for (const StabilitySummary &row : run.summary.stability)
              add(picture.x.of_speed(row), picture.y.of_speed(row));
        }
      return rows;
    }

    /// Values that span more than a decade are shown by their logarithms.
    bool is_logarithmic(const PictureQuantity &quantity, const Range &range)
    {
      return quantity.of != ValueOf::step && range.lower > 0. &&
             range.upper > 15. * range.lower;
    }

    std::string
    axes_of(const RequestedPicture &picture, const Range &x, const Range &y)
    {
      if (picture.is_polar())
        return "set size ratio -1\nset xzeroaxis lc rgb '#444444' dt solid\n"
               "set yzeroaxis lc rgb '#444444' dt solid\n"
               "set offsets graph 0.05, graph 0.05, graph 0.05, graph 0.05\n"
               "set xlabel 'Along the first axis'\nset ylabel " +
               gnuplot_text(picture.x.name == "direction" ?
                              picture.y.label + ", along the second axis" :
                              picture.y.label) +
               "\n";
      std::string script = "set xlabel " + gnuplot_text(picture.x.label) +
                           "\nset ylabel " + gnuplot_text(picture.y.label) +
                           "\nset offsets graph 0.03, graph 0.03, graph 0.06, "
                           "graph 0.06\n";
      if (is_logarithmic(picture.x, x))
        script += "set logscale x\nset format x '%g'\nset xrange [" +
                  exact_text(x.lower / 2.) + ":" + exact_text(x.upper * 2.) +
                  "]\n";
      if (is_logarithmic(picture.y, y))
        script += "set logscale y\nset format y '%g'\n";
      else if (y.lower >= 0. && y.lower < 0.5 * y.upper)
        script += "set yrange [0:*]\n";
      return script;
    }

    void add_requested_picture(RunFigures             &figures,
                               const std::string      &name,
                               const RequestedPicture &requested)
    {
      const auto &runs  = figures.runs;
      std::string title = requested.text;
      title[0]          = std::toupper(title[0]);
      Range      x, y;
      const bool is_curve = requested.y.of == ValueOf::step;
      // The speeds of a sweep make one curve of all runs.
      Rows       all;
      const bool is_joined =
        !is_curve &&
        std::all_of(runs.begin(), runs.end(), [&](const auto &run) {
          return points_of(requested, run, figures.reference).size() <= 1;
        });
      const unsigned int height = requested.is_polar() ? 560 : 400;
      LegendPlace        legend_place;
      if (runs.size() > 1 && !is_joined)
        legend_place = place_legend(runs, {}, height);
      if (legend_place.is_beside)
        legend_place.commands = "set key outside right top Left reverse\n";
      Figure     figure(figures.folder,
                    name,
                    title,
                    picture_width,
                    height + legend_place.more_height);
      bool       is_zigzag = false;
      const auto plot      = [&](const Rows        &points,
                            const std::size_t  i,
                            const std::string &of) {
        if (points.empty())
          return;
        for (const auto &point : points)
          {
            x.add(point[0]);
            y.add(point[1]);
          }
        figure.plot(of,
                    {requested.x.name, requested.y.name},
                    points,
                    (is_curve  ? "with lines lw 1.8 " :
                          is_zigzag ? "with points pt 7 ps 0.8 " :
                                      "with linespoints pt 7 ps 0.8 lw 1.2 ") +
                      run_style(i) +
                      (of.empty() ? " notitle" : " title " + gnuplot_text(of)));
      };
      for (std::size_t i = 0; i < runs.size(); ++i)
        {
          const Rows points = points_of(requested, runs[i], figures.reference);
          if (is_joined)
            all.insert(all.end(), points.begin(), points.end());
          else
            plot(points, i, runs.size() > 1 ? legend(runs[i]) : "");
        }
      std::sort(all.begin(), all.end());
      // Where something else varies, too, a line would be a zigzag.
      is_zigzag = std::adjacent_find(all.begin(),
                                     all.end(),
                                     [](const auto &one, const auto &other) {
                                       return other[0] - one[0] <=
                                              1e-6 * std::abs(one[0]);
                                     }) != all.end();
      plot(all, 0, "");
      // Nothing was plotted.
      if (!std::isfinite(x.width()))
        {
          figures.warnings.push_back("no picture '" + requested.text +
                                     "': no slide or step has both of them");
          return;
        }
      figure.script() << axes_style << legend_place.commands
                      << axes_of(requested, x, y);
      figures.add(figure,
                  title,
                  is_curve ? "" :
                  requested.y.of == ValueOf::speed ?
                             "A point is a speed of the programme." :
                             "A point is a slide.");
    }
  } // namespace



  std::string picture_quantity_names()
  {
    std::vector<std::string> names;
    for (const PictureQuantity &quantity : picture_quantities())
      if (std::find(names.begin(), names.end(), quantity.name) == names.end())
        names.push_back(quantity.name);
    std::string text;
    for (const std::string &name : names)
      text += (text.empty() ? "" : ", ") + name;
    return text;
  }



  void check_pictures(const Parameters &parameters)
  {
    requested_pictures(parameters);
  }



  void add_requested_pictures(RunFigures &figures)
  {
    const auto requested = requested_pictures(figures.parameters);
    for (std::size_t i = 0; i < requested.size(); ++i)
      add_requested_picture(figures,
                            "picture_" + std::to_string(i + 1),
                            requested[i]);
  }
} // namespace SlipStep
