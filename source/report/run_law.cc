// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/effect.h>
#include <slipstep/report/run_figures.h>
#include <slipstep/utilities/units.h>

#include <deal.II/base/numbers.h>

#include <functional>
#include <set>

namespace SlipStep
{
  namespace
  {
    /// A variable of the law over the path.
    struct LawPanel
    {
      std::string                               name;
      std::string                               label;
      std::function<double(const HistoryRow &)> value;
    };

    std::vector<LawPanel> law_panels()
    {
      std::vector<LawPanel> panels = {
        {"friction",
         "Friction, its size",
         [](const HistoryRow &row) {
           return std::hypot(row.friction, row.friction_y);
         }},
        {"r",
         "r",
         [](const HistoryRow &row) { return row.loading_ratio.mean; }},
        {"r_s",
         "r_s",
         [](const HistoryRow &row) { return row.normal_ratio.mean; }},
        {"mu", "μ", [](const HistoryRow &row) {
           return row.coefficient.mean;
         }}};
      for (const ContactMemory &memory : contact_memories())
        panels.push_back({memory.name,
                          memory.name,
                          [slot = memory.slot](const HistoryRow &row) {
                            return row.memories[slot];
                          }});
      return panels;
    }

    /// Over the path of the drive, which grows also on the way back.
    Rows over_path(const RunResults &run, const LawPanel &panel)
    {
      Rows   rows;
      double path = 0.;
      for (std::size_t i = 0; i < run.history.size(); ++i)
        {
          const HistoryRow &row = run.history[i];
          if (i > 0)
            path +=
              std::hypot(row.displacement - run.history[i - 1].displacement,
                         row.displacement_y -
                           run.history[i - 1].displacement_y);
          rows.push_back({path, panel.value(row)});
        }
      return rows;
    }

    Range range_of(const std::vector<Rows> &curves, const unsigned int column)
    {
      Range range;
      for (const Rows &curve : curves)
        range.add(curve, column);
      return range;
    }

    /// @param is_last has the axis that all share
    std::string draw_panel(const RunFigures        &figures,
                           const LawPanel          &panel,
                           const std::vector<Rows> &curves,
                           const LegendPlace       &legend_place,
                           const bool               is_last)
    {
      const auto &runs     = figures.runs;
      const bool  is_first = panel.name == "friction";
      Figure      figure =
        figures.figure("law_" + panel.name,
                       panel.label + " over the path of the drive",
                       is_last ? 200 : 155);
      const bool is_named = runs.size() > 1 && legend_place.is_beside;
      for (std::size_t i = 0; i < runs.size(); ++i)
        plot_run(figure,
                 runs[i],
                 i,
                 {"path_mm", panel.name},
                 curves[i],
                 1.8,
                 is_first && is_named);
      const Range x = range_of(curves, 0);
      const Range y = without_round_off(range_of(curves, 1));
      figure.script()
        << axes_style << "set lmargin at screen 0.11\n"
        << (is_named ? legend_place.commands : "set rmargin at screen 0.95\n")
        << "set tmargin at screen 0.91\nset bmargin at screen "
        << (is_last ? 0.3 : 0.09) << "\nset xrange " << x << "\nset yrange "
        << with_margin(y, 0.06)
        << "\nset ytics "
        // Two of them at least.
        << round_up(y.width() / 4.5)
        // These stand below each other, however wide the numbers are.
        << "\nset label 1 " << gnuplot_text(panel.label)
        << " at screen 0.02, graph 0.5 center rotate by 90\n"
        << few_tics('x', x.lower, x.upper, false)
        << (is_last ? "set xlabel 'Path of the drive  [mm]' offset 0,0.5\n" :
                      "set format x ''\n");
      return figures.page.svg_of(figure);
    }



    /// In base units, so that the column of units holds.
    std::string value_text(const EffectParameter &parameter,
                           const std::string     &text)
    {
      const auto *quantity =
        dynamic_cast<const Quantity *>(parameter.pattern.get());
      if (quantity == nullptr || !quantity->match(text))
        return text;
      const double value = quantity->value(text);
      return short_text(quantity->dimension == Dimension::angle ?
                          value * 180. / dealii::numbers::PI :
                          value,
                        6);
    }

    std::string unit_text(const EffectParameter &parameter)
    {
      const auto *quantity =
        dynamic_cast<const Quantity *>(parameter.pattern.get());
      return quantity == nullptr || quantity->dimension == Dimension::number ?
               "" :
               base_unit(quantity->dimension);
    }

    /// "0.1", or "0.1 (thin), 0.2 (thick)"
    std::string values_text(const EffectInfo              &effect,
                            const EffectParameter         &parameter,
                            const Runs                    &runs,
                            const std::vector<Parameters> &laws)
    {
      std::set<std::string> different;
      std::string           all;
      for (std::size_t i = 0; i < runs.size(); ++i)
        {
          if (!holds(runs[i].summary.effects, effect.name))
            continue;
          const std::string text =
            value_text(parameter,
                       laws[i].text(effect.section() + parameter.key));
          different.insert(text);
          all +=
            (all.empty() ? "" : ", ") + text + " (" + legend(runs[i]) + ")";
        }
      return different.size() == 1 ? *different.begin() : all;
    }
  } // namespace



  std::string law_at_work(const RunFigures &figures)
  {
    std::vector<LawPanel>          shown;
    std::vector<std::vector<Rows>> curves;
    std::string                    constants;
    for (const LawPanel &panel : law_panels())
      {
        std::vector<Rows> of_runs;
        for (const RunResults &run : figures.runs)
          of_runs.push_back(over_path(run, panel));
        if (!(range_of(of_runs, 0).width() > 0.))
          return "";
        const Range y = range_of(of_runs, 1);
        if (panel.name == "friction" || !is_constant(y))
          {
            shown.push_back(panel);
            curves.push_back(of_runs);
          }
        else if (panel.name.size() <= 3) // of every law
          constants += (constants.empty() ? "" : ", ") + panel.label + " = " +
                       short_text(y.upper, 5);
      }
    const Runs       &runs         = figures.runs;
    const LegendPlace legend_place = place_legend(runs, {}, 206);
    std::string       svg, names;
    for (std::size_t i = 0; i < shown.size(); ++i)
      svg += draw_panel(
        figures, shown[i], curves[i], legend_place, i + 1 == shown.size());
    if (svg.empty())
      return "";
    for (const RunResults &run : runs)
      names += (names.empty() ? "" : "&#10;") + html_text(legend(run));
    return heading("The law at work") +
           (runs.size() > 1 && !legend_place.is_beside ? run_legend(runs) :
                                                         "") +
           "<figure class='stack' data-runs=\"" + names + "\">\n" + svg +
           "<figcaption>Means over the contact. r: load over strength, above 1 "
           "by overstress; r_s: the limit of r at rest; μ: the coefficient of "
           "friction." +
           (constants.empty() ?
              "" :
              " Constant throughout: " + html_text(constants) + ".") +
           "</figcaption></figure>\n";
  }



  TableLines effect_table(const RunFigures &figures)
  {
    const Runs             &runs = figures.runs;
    std::vector<Parameters> laws;
    for (const RunResults &run : runs)
      laws.push_back(figures.parameters_of(run));
    TableLines lines = {
      table_head("effect | formula | parameter | symbol | value | unit")};
    for (const auto &[name, effect] : effect_registry())
      {
        const bool is_active = any_of(runs, [&](const RunResults &run) {
          return holds(run.summary.effects, effect.name);
        });
        if (!is_active)
          continue;
        std::string shown_name = name, formula = effect.formula;
        for (const EffectParameter &parameter : effect.parameters)
          {
            lines.push_back({shown_name,
                             formula,
                             parameter.key,
                             parameter.symbol,
                             values_text(effect, parameter, runs, laws),
                             unit_text(parameter)});
            shown_name = formula = "";
          }
        if (effect.parameters.empty())
          lines.push_back({name, formula, "", "", "", ""});
      }
    return lines;
  }
} // namespace SlipStep
