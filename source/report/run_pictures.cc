// SPDX-License-Identifier: LGPL-2.1-or-later

// The pictures that a case asks for: "Report/Pictures".

#include <slipstep/report/run_figures.h>
#include <slipstep/utilities/units.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/predicate.hpp>

#include <functional>
#include <set>
#include <variant>

namespace SlipStep
{
  namespace
  {
    /// What a value is of: a whole slide, a step, or a speed of the programme.
    using OfSlide = std::function<double(const ResultRow &)>;
    using OfStep  = std::function<double(const HistoryRow &)>;
    using OfSpeed = std::function<double(const StabilitySummary &)>;

    /// What can be drawn over another one that has values of the same.
    struct PictureQuantity
    {
      std::string                            name;
      std::string                            label;
      std::variant<OfSlide, OfStep, OfSpeed> value;
    };

    constexpr double absent = std::numeric_limits<double>::quiet_NaN();

    std::vector<PictureQuantity> quantities_of_slides()
    {
      using Row = const ResultRow &;
      return {
        {"peak", "Peak friction", &ResultRow::peak},
        {"dip", "Least friction after the step", &ResultRow::dip},
        {"kinetic", "Kinetic friction", of_slide(&SlideSummary::kinetic)},
        {"dynamic ratio",
         "Dynamic loading ratio  r",
         of_slide(&SlideSummary::dynamic_ratio)},
        {"drop", "Drop from peak to kinetic  [%]", &ResultRow::drop},
        {"rest",
         "Time at rest before  [s]",
         [](Row row) { return row.slide.rest > 0. ? row.slide.rest : absent; }},
        {"pressure", "Pressure  [MPa]", of_slide(&SlideSummary::pressure)},
        {"speed",
         "Sliding speed  [mm/min]",
         [](Row row) { return row.slide.speed * mm_min; }},
        {"direction",
         "Direction of sliding  [deg]",
         [](Row row) { return row.slide.angle * 180. / dealii::numbers::PI; }},
        {"statement", "Statement of the programme", [](Row row) {
           return static_cast<double>(row.slide.statement);
         }}};
    }

    std::vector<PictureQuantity> quantities_of_steps()
    {
      using Row = const HistoryRow &;
      return {{"friction",
               "Friction  (tangential / normal load)",
               &HistoryRow::friction},
              {"friction y",
               "Friction along the second axis",
               &HistoryRow::friction_y},
              {"force", "Tangential load  [N]", &HistoryRow::tangential_load},
              {"r",
               "Loading ratio  r",
               [](Row row) { return row.loading_ratio.mean; }},
              {"r_s",
               "Normal ratio  r_s",
               [](Row row) { return row.normal_ratio.mean; }},
              {"mu",
               "Coefficient  μ",
               [](Row row) { return row.coefficient.mean; }},
              {"slip", "Slip path  [mm]", &HistoryRow::slip},
              {"slipping share",
               "Share of the contact that slips  [%]",
               [](Row row) { return 100. * row.slip_fraction; }},
              {"spring load",
               "Load of the spring / normal load",
               [](Row row) {
                 return row.probes.size() > 2 ? row.probes[2] : absent;
               }},
              {"dissipation",
               "Dissipated energy  [N mm]",
               &HistoryRow::dissipated_energy},
              {"displacement",
               "Displacement of the drive  [mm]",
               &HistoryRow::displacement},
              {"pressure", "Pressure  [MPa]", &HistoryRow::pressure},
              {"time", "Time  [s]", &HistoryRow::time}};
    }

    std::vector<PictureQuantity> picture_quantities()
    {
      std::vector<PictureQuantity> all      = quantities_of_slides();
      const auto                   of_steps = quantities_of_steps();
      all.insert(all.end(), of_steps.begin(), of_steps.end());
      all.insert(
        all.end(),
        {{"critical stiffness",
          "Critical stiffness  [MPa/mm]",
          &StabilitySummary::critical_stiffness},
         {"stiffness",
          "Stiffness of the machine  [MPa/mm]",
          &StabilitySummary::stiffness},
         {"speed", "Sliding speed  [mm/min]", [](const StabilitySummary &row) {
            return row.speed * mm_min;
          }}});
      return all;
    }

    struct RequestedPicture
    {
      std::string     text;
      PictureQuantity y, x;

      template <typename Of>
      bool is_of() const
      {
        return std::holds_alternative<Of>(y.value);
      }

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
                         "\": expected is one quantity over another, e.g. "
                         "\"peak over rest\"");
      const std::string y = dealii::Utilities::trim(text.substr(0, place));
      const std::string x =
        dealii::Utilities::trim(text.substr(place + over.size()));
      const auto all = picture_quantities();
      for (const std::string &name : {y, x})
        if (none_of(all, [&](const auto &one) { return one.name == name; }))
          throw InputError("\"" + name + "\" is not known; allowed are: " +
                           picture_quantity_names());
      if (y == x)
        throw InputError("\"" + text +
                         "\": a quantity over itself is a straight line");
      for (const PictureQuantity &one : all)
        for (const PictureQuantity &other : all)
          if (one.name == y && other.name == x &&
              one.value.index() == other.value.index())
            return {text, one, other};
      throw InputError("\"" + text +
                       "\": one quantity belongs to whole slides, the other to "
                       "single instants or to speeds");
    }

    std::vector<RequestedPicture>
    requested_pictures(const Parameters &parameters)
    {
      const std::string             key = "Report/Pictures";
      std::vector<RequestedPicture> pictures;
      for (const std::string &text : parameters.list(key))
        parameters.attempt(key, [&]() {
          const RequestedPicture next = read_picture(text);
          if (any_of(pictures, [&](const RequestedPicture &other) {
                return other.y.name == next.y.name &&
                       other.x.name == next.x.name;
              }))
            throw InputError("\"" + text + "\" is there twice");
          pictures.push_back(next);
        });
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
        const double angle     = x * dealii::numbers::PI / 180.;
        const auto   component = [&](const double share) {
          constexpr double round_off = 1e-12;
          return std::abs(share) < round_off ? 0. : y * share;
        };
        if (picture.x.name == "direction")
          rows.push_back(
            {component(std::cos(angle)), component(std::sin(angle))});
        else
          rows.push_back({x, y});
      };
      const auto add_all = [&](const auto of, const auto &values) {
        using Of = std::decay_t<decltype(of)>;
        for (const auto &value : values)
          add(std::get<Of>(picture.x.value)(value),
              std::get<Of>(picture.y.value)(value));
      };
      if (picture.is_of<OfSlide>())
        add_all(OfSlide(), result_rows({run}, reference));
      else if (picture.is_of<OfSpeed>())
        add_all(OfSpeed(), run.summary.stability);
      else
        {
          add_all(OfStep(), run.history);
          rows = thinned(rows);
        }
      return rows;
    }

    /// The axis' label, loads and energies in the unit of the runs.
    std::string label(const PictureQuantity &quantity, const Runs &runs)
    {
      std::string text = quantity.label;
      for (const std::string unit : {"[N]", "[N mm]"})
        if (boost::algorithm::ends_with(text, unit))
          {
            std::set<std::string> sizes;
            for (const RunResults &run : runs)
              sizes.insert(per_size(run.summary.dimension));
            text.pop_back();
            text +=
              (sizes.size() == 1 ? *sizes.begin() :
                                   ", in 2-D per mm, at a point per mm^2") +
              ']';
          }
      return text;
    }

    /// Values that span more than a decade are shown by their logarithms.
    bool is_logarithmic(const PictureQuantity &quantity, const Range &range)
    {
      return !std::holds_alternative<OfStep>(quantity.value) &&
             range.lower > 0. && range.upper > 15. * range.lower;
    }

    std::string range_command(const char axis, const Range &range)
    {
      return std::string("set ") + axis + "range [" + exact_text(range.lower) +
             ":" + exact_text(range.upper) + "]\n";
    }

    /// What lies on a line would have no height, and a point no size.
    std::string
    flat_side(const char axis, const Range &range, const Range &other)
    {
      constexpr double least = 0.4;
      const double     size =
        other.width() > 0. ?
              other.width() :
              std::max(std::hypot(range.middle(), other.middle()), 1e-6);
      const double half = 0.5 * least * size;
      return range.width() > least * other.width() ?
               "" :
               range_command(axis,
                             {range.middle() - half, range.middle() + half});
    }

    /// Where nothing differs; "" if something does.
    std::string constant_side(const char axis, const Range &range)
    {
      return is_constant(range) ?
               range_command(axis, without_round_off(range)) :
               "";
    }

    std::string axes_of(const RequestedPicture &picture,
                        const Range            &x,
                        const Range            &y,
                        const Runs             &runs)
    {
      const std::string x_label = label(picture.x, runs);
      const std::string y_label = label(picture.y, runs);
      if (picture.is_polar())
        return "set size ratio -1\nset xzeroaxis lc rgb '#444444' dt solid\n"
               "set yzeroaxis lc rgb '#444444' dt solid\n"
               "set offsets graph 0.05, graph 0.05, graph 0.05, graph 0.05\n" +
               flat_side('x', x, y) + flat_side('y', y, x) +
               "set xlabel 'Along the first axis'\nset ylabel " +
               gnuplot_text(picture.x.name == "direction" ?
                              y_label + ", along the second axis" :
                              y_label) +
               "\n";
      std::string script = "set xlabel " + gnuplot_text(x_label) +
                           "\nset ylabel " + gnuplot_text(y_label) +
                           "\nset offsets graph 0.03, graph 0.03, graph 0.06, "
                           "graph 0.06\n";
      if (is_logarithmic(picture.x, x))
        script += "set logscale x\nset format x '%g'\n" +
                  range_command('x', {x.lower / 2., x.upper * 2.});
      if (is_logarithmic(picture.y, y))
        script += "set logscale y\nset format y '%g'\n";
      else if (y.lower >= 0. && y.lower < 0.5 * y.upper)
        script += "set yrange [0:*]\n";
      return script + constant_side('x', x) + constant_side('y', y);
    }

    /// The points of a picture, of each run or of all runs together.
    struct RequestedCurves
    {
      std::vector<Rows>        points;
      std::vector<std::string> names; ///< "" for one that needs none
      /// Where something else varies, too, a line would be a zigzag.
      bool  is_zigzag = false;
      Range x, y;
    };



    RequestedCurves curves_of(const RequestedPicture &requested,
                              const RunFigures       &figures)
    {
      RequestedCurves curves;
      const auto     &runs    = figures.runs;
      std::size_t     longest = 0;
      for (const RunResults &run : runs)
        {
          curves.points.push_back(points_of(requested, run, figures.reference));
          curves.names.push_back(runs.size() > 1 ? legend(run) : "");
          longest = std::max(longest, curves.points.back().size());
          curves.x.add(curves.points.back(), 0);
          curves.y.add(curves.points.back(), 1);
        }
      // The speeds of a sweep make one curve of all runs.
      const bool is_joined = !requested.is_of<OfStep>() && longest <= 1;
      if (!is_joined)
        return curves;
      Rows all;
      for (const Rows &points : curves.points)
        all.insert(all.end(), points.begin(), points.end());
      std::sort(all.begin(), all.end());
      curves.is_zigzag =
        std::adjacent_find(all.begin(),
                           all.end(),
                           [](const auto &one, const auto &other) {
                             return other[0] - one[0] <=
                                    1e-6 * std::abs(one[0]);
                           }) != all.end();
      // Colours tell then what varies.
      if (curves.is_zigzag)
        return curves;
      curves.points = {all};
      curves.names  = {""};
      return curves;
    }



    void add_requested_picture(RunFigures             &figures,
                               const std::string      &name,
                               const RequestedPicture &requested)
    {
      const RequestedCurves curves = curves_of(requested, figures);
      if (!std::isfinite(curves.x.width()))
        {
          figures.page.warnings.push_back(
            "no picture '" + requested.text +
            "': no slide or step has both quantities" +
            (requested.text.find("stiffness") != std::string::npos ?
               " (only slipstep point gives stiffness and critical stiffness)" :
               ""));
          return;
        }
      // Symbols stay as they are.
      std::string title = requested.text;
      if (requested.y.name.size() > 3)
        title[0] = std::toupper(title[0]);
      const bool         is_curve = requested.is_of<OfStep>();
      const unsigned int height   = requested.is_polar() ? 560 : 400;
      LegendPlace        legend_place;
      if (curves.points.size() > 1)
        legend_place = place_legend(figures.runs, {}, height);
      if (legend_place.is_beside)
        legend_place.commands = "set key outside right top Left reverse\n";
      Figure figure =
        figures.figure(name, title, height + legend_place.more_height);
      const std::string marks = is_curve         ? "with lines lw 1.8 " :
                                curves.is_zigzag ? "with points pt 7 ps 0.8 " :
                                                   "with linespoints pt 7 ps "
                                                   "0.8 lw 1.2 ";
      for (std::size_t i = 0; i < curves.points.size(); ++i)
        if (const std::string &of = curves.names[i]; !curves.points[i].empty())
          figure.plot(figure.add_data(of,
                                      {requested.x.name, requested.y.name},
                                      curves.points[i]) +
                      " " + marks + run_style(i) +
                      (of.empty() ? " notitle" : " title " + gnuplot_text(of)));
      figure.script() << axes_style << legend_place.commands
                      << axes_of(requested, curves.x, curves.y, figures.runs);
      figures.add(figure,
                  title,
                  is_curve ? "" :
                  requested.is_of<OfSpeed>() ?
                             "A point is a speed of the programme." :
                             "A point is a slide.");
    }
  } // namespace



  std::string picture_quantity_names()
  {
    std::vector<std::string> names;
    for (const PictureQuantity &quantity : picture_quantities())
      if (!holds(names, quantity.name))
        names.push_back(quantity.name);
    return boost::algorithm::join(names, ", ");
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
