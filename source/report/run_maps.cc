// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/run_figures.h>

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



    /// What a variant changes, without what all of them change to the same: a
    /// member of a sweep may be swept further.
    std::vector<Variant::Override> own_changes(const Variant &variant,
                                               const std::vector<Variant> &all)
    {
      std::vector<Variant::Override> own;
      for (const Variant::Override &change : variant.overrides)
        if (!all_of(all, [&](const Variant &other) {
              return any_of(other.overrides, [&](const auto &its) {
                return its.path == change.path && its.value == change.value;
              });
            }))
          own.push_back(change);
      return own;
    }



    /// An empty one if the variants are no grid.
    Grid grid_of(const std::vector<Variant> &variants)
    {
      Grid grid;
      for (const Variant &variant : variants)
        {
          const auto own = own_changes(variant, variants);
          if (own.size() != 2)
            return {};
          const Variant::Override &slow = own[0], &fast = own[1];
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
      if (cells.empty() || is_constant(range))
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
        << tics_of('x', grid.x) << tics_of('y', grid.y) << "plot "
        << data
        // An image would need all of them.
        << " using 1:2:(0.5):(0.5):3 with boxxyerror lc palette fs solid 1 "
           "noborder";
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



    /// How to show a field over the contact face.
    struct Field
    {
      std::string column;
      std::string label;
      double      offset = 0.;
      double      factor = 1.;
      Range       range;
    };

    /// A nearly uniform field is shown as the deviation from its mean: its own
    /// digits would not fit a colour bar.
    Field field_of(const CsvTable    &face,
                   const std::string &column,
                   const std::string &name,
                   const std::string &unit)
    {
      Field field{column, name + "  [" + unit + "]", 0., 1., {}};
      Range range;
      for (const double value : face[column])
        range.add(value);
      const double size =
        std::max(std::abs(range.lower), std::abs(range.upper));
      std::string of;
      if (range.width() < 0.02 * size)
        {
          // Cells differ in size.
          const auto &areas = face["area_mm2"];
          double      mean = 0., area = 0.;
          for (std::size_t i = 0; i < face.size(); ++i)
            {
              mean += areas[i] * face[column][i];
              area += areas[i];
            }
          mean /= area;
          field.offset = mean;
          of           = " − " + short_text(mean, 5) + " " + unit;
        }
      // In a unit by which numbers are short; round-off is no pattern.
      constexpr double round_off = 1e-6, smallest = 1e-9;
      const double     shown =
        of.empty() ? size : std::max(range.width(), round_off * size);
      const bool  is_length  = unit == "mm";
      std::string shown_unit = unit;
      if (shown > smallest && shown < 1e-5)
        {
          field.factor = 1e6;
          shown_unit   = is_length ? "nm" : "Pa";
        }
      else if (shown > smallest && (shown < 0.01 || !of.empty()))
        {
          field.factor = 1e3;
          shown_unit   = is_length ? "µm" : "kPa";
        }
      field.label = name + of + "  [" + shown_unit + "]";
      for (const double value : face[column])
        field.range.add(field.factor * (value - field.offset));
      const double least = field.factor * std::max(round_off * size, smallest);
      if (field.range.width() < least)
        field.range = {field.range.middle() - 0.5 * least,
                       field.range.middle() + 0.5 * least};
      return field;
    }

    /// A line per cell: its centre, half its size, and the fields.
    Rows cells_of(const FaceTable            &table,
                  const std::array<Field, 2> &fields,
                  const bool                  is_line)
    {
      const CsvTable &face = table.cells;
      const auto &[x, y]   = table.axes;
      Rows rows;
      for (std::size_t i = 0; i < face.size(); ++i)
        {
          std::vector<double> row = {face[x + "_mm"][i]};
          if (!is_line)
            row.insert(row.end(),
                       {face[y + "_mm"][i],
                        0.5 * face["cell_size_" + x + "_mm"][i],
                        0.5 * face["cell_size_" + y + "_mm"][i]});
          for (const Field &field : fields)
            row.push_back(field.factor *
                          (face[field.column][i] - field.offset));
          rows.push_back(row);
        }
      if (is_line)
        std::sort(rows.begin(), rows.end());
      return rows;
    }

    /// Along an axis, with the whole of the outer cells.
    Range extent_of(const FaceTable &face, const unsigned int axis)
    {
      const auto &centres = face.cells[face.axes[axis] + "_mm"];
      const auto &sizes   = face.cells["cell_size_" + face.axes[axis] + "_mm"];
      Range       range;
      for (std::size_t i = 0; i < centres.size(); ++i)
        for (const double sign : {-0.5, 0.5})
          range.add(centres[i] + sign * sizes[i]);
      return range;
    }

    /// The x axis of a picture, with texts that keep apart.
    std::string x_axis_of(const FaceTable &face)
    {
      const Range        x = extent_of(face, 0);
      std::ostringstream text;
      text << "set xlabel '" << face.axes[0] << "  [mm]'\nset xrange " << x
           << '\n'
           << few_tics('x', x.lower, x.upper, false);
      return text.str();
    }

    /// Two maps side by side, in the proportions of the face.
    void draw_maps(std::ostream               &script,
                   const std::string          &data,
                   const FaceTable            &face,
                   const std::array<Field, 2> &fields,
                   const double                height)
    {
      const Range y = extent_of(face, 1);
      script << "set palette defined (0 '#440154', 1 '#414487', 2 '#2a788e', "
                "3 '#22a884', 4 '#7ad151', 5 '#fde725')\n"
                "set border 15 lw 1 lc rgb '#444444'\nunset key\n"
                "set tics out nomirror scale 0.6\nset size ratio -1\n"
             << "set ylabel '" << face.axes[1] << "  [mm]' offset 1.5\n"
             << "set multiplot\n"
             << x_axis_of(face) << "set yrange " << y << '\n'
             << few_tics('y', y.lower, y.upper, false);
      for (unsigned int k = 0; k < 2; ++k)
        script << "set lmargin at screen " << 0.085 + 0.5 * k
               << "\nset rmargin at screen " << 0.41 + 0.5 * k
               << "\nset tmargin at screen " << 1. - 40. / height
               << "\nset bmargin at screen " << 75. / height << "\nset cbrange "
               << fields[k].range << "\nset cbtics "
               << round_up(fields[k].range.width() / 4.) << "\nset title "
               << gnuplot_text(fields[k].label) << "\nplot " << data
               << " using 1:2:3:4:" << 5 + k
               << " with boxxyerror lc palette fs solid 1 noborder\n";
    }

    /// In two dimensions the face is a line.
    void draw_lines(std::ostream               &script,
                    const std::string          &data,
                    const FaceTable            &face,
                    const std::array<Field, 2> &fields)
    {
      script << axes_style << "unset key\nset multiplot layout 1,2\n"
             << x_axis_of(face);
      for (unsigned int k = 0; k < 2; ++k)
        script << "set ylabel " << gnuplot_text(fields[k].label)
               << "\nset yrange " << with_margin(fields[k].range, 0.05)
               << "\nplot " << data << " using 1:" << 2 + k
               << " with linespoints lw 2 pt 7 ps 0.4 lc rgb '#0072B2'\n";
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



  std::string draw_face(const RunFigures &figures, const std::size_t run)
  {
    const FaceTable &face             = *figures.runs[run].contact_face;
    const auto &[x, y]                = face.axes;
    const std::array<Field, 2> fields = {
      field_of(face.cells, "pressure_MPa", "Pressure", "MPa"),
      field_of(face.cells, "slip_mm", "Slip", "mm")};
    const auto &sizes   = face.cells["cell_size_" + y + "_mm"];
    const bool  is_line = *std::max_element(sizes.begin(), sizes.end()) <= 0.;
    const Rows  cells   = cells_of(face, fields, is_line);
    std::vector<std::string> columns = {x + "_mm"};
    double                   height  = 320.;
    if (!is_line)
      {
        columns.insert(columns.end(),
                       {y + "_mm",
                        "half_size_" + x + "_mm",
                        "half_size_" + y + "_mm"});
        height = std::clamp(280. * extent_of(face, 1).width() /
                              extent_of(face, 0).width(),
                            60.,
                            400.) +
                 130.;
      }
    for (const Field &field : fields)
      columns.push_back(field.label);
    const std::string name = legend(figures.runs[run]);
    Figure figure = figures.figure("contact_face_" + std::to_string(run + 1),
                                   "Contact face, " + name,
                                   height);
    const std::string data =
      figure.add_data("contact face of " + name, columns, cells);
    if (is_line)
      draw_lines(figure.script(), data, face, fields);
    else
      draw_maps(figure.script(), data, face, fields, height);
    figure.script() << "unset multiplot\n";
    return figure_element("Contact face, " + name,
                          figures.page.svg_of(figure),
                          "State at the end of the run.",
                          !is_line);
  }
} // namespace SlipStep
