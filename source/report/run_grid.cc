// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/run_figures.h>
#include <slipstep/utilities/lists.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace SlipStep
{
  namespace
  {
    /// A swept key with its values in their order.
    struct GridAxis
    {
      std::string              path;
      std::vector<std::string> values;

      std::size_t position(const std::string &value)
      {
        const auto found = std::find(values.begin(), values.end(), value);
        if (found != values.end())
          return found - values.begin();
        values.push_back(value);
        return values.size() - 1;
      }
    };



    /// The runs of a sweep of two keys.
    struct Grid
    {
      GridAxis x, y;
      /// Labels of the variants with the positions of their values.
      std::map<std::string, std::pair<std::size_t, std::size_t>> cells;

      bool is_full() const
      {
        return x.values.size() > 1 && y.values.size() > 1 &&
               cells.size() == x.values.size() * y.values.size();
      }
    };



    /// An empty one if the variants are no grid.
    Grid grid_of(const std::vector<Variant> &variants)
    {
      Grid grid;
      for (const Variant &variant : variants)
        {
          if (variant.overrides.size() != 2)
            return {};
          const Variant::Override &slow = variant.overrides[0],
                                  &fast = variant.overrides[1];
          if (grid.cells.empty())
            {
              grid.y.path = slow.path;
              grid.x.path = fast.path;
            }
          if (slow.path != grid.y.path || fast.path != grid.x.path)
            return {};
          grid.cells[variant.label] = {grid.x.position(fast.value),
                                       grid.y.position(slow.value)};
        }
      return grid.is_full() ? grid : Grid();
    }



    std::string tics_of(const char axis, const GridAxis &of)
    {
      std::string text = std::string("set ") + axis + "tics (";
      for (std::size_t i = 0; i < of.values.size(); ++i)
        text += (i == 0 ? "" : ", ") + gnuplot_text(of.values[i]) + " " +
                std::to_string(i);
      return text + ") scale 0\nset " + axis +
             "range [-0.5:" + std::to_string(of.values.size()) + " - 0.5]\n";
    }



    void add_heat_map(RunFigures        &figures,
                      const Grid        &grid,
                      const std::string &name,
                      const std::string &title,
                      const Rows        &cells)
    {
      Range range;
      range.add(cells, 2);
      // One colour and no number say nothing.
      if (cells.empty() || !(range.width() > 0.))
        return;
      Figure figure =
        figures.figure(name,
                       title,
                       140 +
                         46 * std::min<std::size_t>(grid.y.values.size(), 14));
      const std::string data =
        figure.add_data(title, {grid.x.path, grid.y.path, "value"}, cells);
      figure.script()
        << axes_style << "unset grid\nunset key\nset border 0\n"
        << "set palette defined (0 '#00224e', 0.25 '#434e6c', 0.5 '#7d7c78', "
           "0.75 '#bcae6c', 1 '#fee838')\n"
        << "set xlabel " << gnuplot_text(grid.x.path) << "\nset ylabel "
        << gnuplot_text(grid.y.path) << "\nset cblabel " << gnuplot_text(title)
        << '\n'
        << tics_of('x', grid.x) << tics_of('y', grid.y) << "plot " << data
        << " using 1:2:3 with image pixels";
      // Numbers as long as they have room; dark on bright.
      if (grid.x.values.size() <= 10)
        for (const bool is_bright : {false, true})
          figure.script() << ", \\\n  " << data << " using 1:2:("
                          << (is_bright ? "$3 > " : "$3 <= ") << range.middle()
                          << " ? sprintf('%.4g', $3) : '') with labels "
                          << "textcolor rgb '"
                          << (is_bright ? "#000000" : "#ffffff") << "'";
      figure.script() << '\n';
      figures.add(figure, title, "", true);
    }
  } // namespace



  void add_grid_pictures(RunFigures &figures)
  {
    const Grid grid = grid_of(figures.parameters.variants());
    Rows       peaks, levels;
    for (const ResultRow &row : result_rows(figures.runs, figures.reference))
      {
        const auto cell = grid.cells.find(figures.runs[row.run].label);
        if (cell == grid.cells.end())
          continue;
        const auto add = [&](Rows &cells, const double value) {
          const std::vector<double> place = {
            static_cast<double>(cell->second.first),
            static_cast<double>(cell->second.second)};
          // Of several slides the last.
          remove_erase_if(cells, [&](const std::vector<double> &other) {
            return other[0] == place[0] && other[1] == place[1];
          });
          if (std::isfinite(value))
            cells.push_back({place[0], place[1], value});
        };
        add(peaks, row.peak());
        add(levels, row.slide.kinetic);
      }
    add_heat_map(figures, grid, "grid_peak", "Peak friction", peaks);
    add_heat_map(figures, grid, "grid_kinetic", "Kinetic friction", levels);
  }
} // namespace SlipStep
