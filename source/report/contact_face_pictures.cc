// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/run_figures.h>
#include <slipstep/utilities/text.h>

#include <array>

namespace SlipStep
{
  namespace
  {
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
          field.factor = 1e3;
          field.label  = name + " − " + short_text(mean, 5) + " " + unit +
                        "  [" + (unit == "mm" ? "µm" : "kPa") + "]";
        }
      else if (size < 0.01)
        {
          field.factor = 1e3;
          field.label  = name + "  [" + (unit == "mm" ? "µm" : "kPa") + "]";
        }
      for (const double value : face[column])
        field.range.add(field.factor * (value - field.offset));

      // Round-off shall not look like a pattern.
      const double least = std::max(field.factor * 1e-6 * size, 1e-12);
      if (field.range.width() < least)
        field.range = {field.range.lower - 0.5 * least,
                       field.range.upper + 0.5 * least};
      return field;
    }

    /// A line per cell: its centre, half its size, and the fields.
    Rows cells_of(const CsvTable             &face,
                  const std::array<Field, 2> &fields,
                  const bool                  is_line)
    {
      Rows rows;
      for (std::size_t i = 0; i < face.size(); ++i)
        {
          std::vector<double> row = {face["x_mm"][i]};
          if (!is_line)
            row.insert(row.end(),
                       {face["y_mm"][i],
                        0.5 * face["cell_size_x_mm"][i],
                        0.5 * face["cell_size_y_mm"][i]});
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
    Range extent_of(const Rows &cells, const unsigned int axis)
    {
      Range range;
      for (const auto &cell : cells)
        for (const double sign : {-1., 1.})
          range.add(cell[axis] + sign * cell[axis + 2]);
      return range;
    }

    /// Two maps side by side, in the proportions of the face.
    void draw_maps(std::ostream               &script,
                   const std::string          &data,
                   const Rows                 &cells,
                   const std::array<Field, 2> &fields,
                   const double                height)
    {
      script << "set palette defined (0 '#440154', 1 '#414487', 2 '#2a788e', "
                "3 '#22a884', 4 '#7ad151', 5 '#fde725')\n"
                "set border 15 lw 1 lc rgb '#444444'\nunset key\n"
                "set tics out nomirror scale 0.6\nset size ratio -1\n"
                "set xlabel 'x  [mm]'\nset ylabel 'y  [mm]' offset 1.5\n"
                "set multiplot\n"
             << "set xrange " << extent_of(cells, 0) << "\nset yrange "
             << extent_of(cells, 1) << '\n';
      for (unsigned int k = 0; k < 2; ++k)
        script << "set lmargin at screen " << 0.085 + 0.5 * k
               << "\nset rmargin at screen " << 0.41 + 0.5 * k
               << "\nset tmargin at screen " << 1. - 40. / height
               << "\nset bmargin at screen " << 75. / height << "\nset cbrange "
               << fields[k].range << "\nset title "
               << gnuplot_text(fields[k].label) << "\nplot " << data
               << " using 1:2:3:4:" << 5 + k
               << " with boxxyerror lc palette fs solid 1 noborder\n";
    }

    /// In two dimensions the face is a line.
    void draw_lines(std::ostream               &script,
                    const std::string          &data,
                    const std::array<Field, 2> &fields)
    {
      script << axes_style
             << "unset key\nset multiplot layout 1,2\nset xlabel 'x  [mm]'\n";
      for (unsigned int k = 0; k < 2; ++k)
        script << "set ylabel " << gnuplot_text(fields[k].label)
               << "\nset yrange " << with_margin(fields[k].range, 0.05)
               << "\nplot " << data << " using 1:" << 2 + k
               << " with linespoints lw 2 pt 7 ps 0.4 lc rgb '#0072B2'\n";
    }
  } // namespace



  std::string draw_face(const RunFigures &figures, const std::size_t run)
  {
    const CsvTable            &face   = *figures.runs[run].contact_face;
    const std::array<Field, 2> fields = {
      field_of(face, "pressure_MPa", "Pressure", "MPa"),
      field_of(face, "slip_mm", "Slip", "mm")};
    const auto &sizes   = face["cell_size_y_mm"];
    const bool  is_line = *std::max_element(sizes.begin(), sizes.end()) <= 0.;
    const Rows  cells   = cells_of(face, fields, is_line);
    std::vector<std::string> columns = {"x_mm"};
    double                   height  = 320.;
    if (!is_line)
      {
        columns.insert(columns.end(),
                       {"y_mm", "half_size_x_mm", "half_size_y_mm"});
        height = std::clamp(280. * extent_of(cells, 1).width() /
                              extent_of(cells, 0).width(),
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
      draw_lines(figure.script(), data, fields);
    else
      draw_maps(figure.script(), data, cells, fields, height);
    figure.script() << "unset multiplot\n";
    return figures.page.draw(figure,
                             "Contact face, " + name,
                             "State at the end of the run.",
                             !is_line);
  }
} // namespace SlipStep
