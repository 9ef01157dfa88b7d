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

    Figure face_figure(const RunFigures  &figures,
                       const std::size_t  run,
                       const unsigned int height)
    {
      return figures.figure("contact_face_" + std::to_string(run + 1),
                            "Contact face, " + legend(figures.runs[run]),
                            height);
    }

    /// The rows with the values of the fields behind.
    Rows with_fields(Rows                        rows,
                     const CsvTable             &face,
                     const std::array<Field, 2> &fields)
    {
      for (const Field &field : fields)
        for (std::size_t i = 0; i < face.size(); ++i)
          rows[i].push_back(field.factor *
                            (face[field.column][i] - field.offset));
      return rows;
    }

    /// Two maps side by side, in the proportions of the face.
    Figure face_map(const RunFigures           &figures,
                    const std::size_t           run,
                    const std::array<Field, 2> &fields)
    {
      const CsvTable &face = *figures.runs[run].contact_face;
      Rows            rows;
      Range           x, y;
      for (std::size_t i = 0; i < face.size(); ++i)
        {
          const double px = face["x_mm"][i], py = face["y_mm"][i];
          const double hx = 0.5 * face["cell_size_x_mm"][i];
          const double hy = 0.5 * face["cell_size_y_mm"][i];
          rows.push_back({px, py, hx, hy});
          for (const double sign : {-1., 1.})
            {
              x.add(px + sign * hx);
              y.add(py + sign * hy);
            }
        }

      const double map_width = 280.;
      const double map_height =
        std::max(60., std::min(400., map_width * y.width() / x.width()));
      const double height = map_height + 130.;
      Figure       figure =
        face_figure(figures, run, static_cast<unsigned int>(height));
      const std::string data =
        figure.add_data("contact face of " + legend(figures.runs[run]),
                        {"x_mm",
                         "y_mm",
                         "half_size_x_mm",
                         "half_size_y_mm",
                         fields[0].label,
                         fields[1].label},
                        with_fields(rows, face, fields));
      figure.script()
        << "set palette defined (0 '#440154', 1 '#414487', 2 '#2a788e', "
           "3 '#22a884', 4 '#7ad151', 5 '#fde725')\n"
           "set border 15 lw 1 lc rgb '#444444'\nunset key\n"
           "set tics out nomirror scale 0.6\nset size ratio -1\n"
           "set xlabel 'x  [mm]'\nset ylabel 'y  [mm]' offset 1.5\n"
           "set multiplot\n"
        << "set xrange [" << x.lower << ":" << x.upper << "]\nset yrange ["
        << y.lower << ":" << y.upper << "]\n";
      for (unsigned int k = 0; k < 2; ++k)
        figure.script() << "set lmargin at screen " << 0.085 + 0.5 * k
                        << "\nset rmargin at screen " << 0.41 + 0.5 * k
                        << "\nset tmargin at screen " << 1. - 40. / height
                        << "\nset bmargin at screen " << 75. / height
                        << "\nset cbrange [" << fields[k].range.lower << ":"
                        << fields[k].range.upper << "]\nset title "
                        << gnuplot_text(fields[k].label) << "\nplot " << data
                        << " using 1:2:3:4:" << 5 + k
                        << " with boxxyerror lc palette fs solid 1 noborder\n";
      return figure;
    }

    /// In two dimensions the face is a line.
    Figure face_lines(const RunFigures           &figures,
                      const std::size_t           run,
                      const std::array<Field, 2> &fields)
    {
      const CsvTable &face = *figures.runs[run].contact_face;
      Rows            rows;
      for (const double x : face["x_mm"])
        rows.push_back({x});
      rows = with_fields(rows, face, fields);
      std::sort(rows.begin(), rows.end());
      Figure            figure = face_figure(figures, run, 320);
      const std::string data =
        figure.add_data("contact face of " + legend(figures.runs[run]),
                        {"x_mm", fields[0].label, fields[1].label},
                        rows);
      figure.script() << axes_style
                      << "unset key\nset multiplot layout 1,2\n"
                         "set xlabel 'x  [mm]'\n";
      for (unsigned int k = 0; k < 2; ++k)
        figure.script() << "set ylabel " << gnuplot_text(fields[k].label)
                        << "\nset yrange ["
                        << fields[k].range.lower -
                             0.05 * fields[k].range.width()
                        << ":"
                        << fields[k].range.upper +
                             0.05 * fields[k].range.width()
                        << "]\nplot " << data << " using 1:" << 2 + k
                        << " with linespoints lw 2 pt 7 ps 0.4 lc rgb "
                        << "'#0072B2'\n";
      return figure;
    }
  } // namespace



  void add_face_picture(RunFigures &figures, const std::size_t run)
  {
    const CsvTable            &face   = *figures.runs[run].contact_face;
    const std::array<Field, 2> fields = {
      field_of(face, "pressure_MPa", "Pressure", "MPa"),
      field_of(face, "slip_mm", "Slip", "mm")};
    const auto &sizes   = face["cell_size_y_mm"];
    const bool  is_line = *std::max_element(sizes.begin(), sizes.end()) <= 0.;
    Figure      figure  = is_line ? face_lines(figures, run, fields) :
                                    face_map(figures, run, fields);
    figure.script() << "unset multiplot\n";
    figures
      .add(figure,
           "Contact face, " + legend(figures.runs[run]),
           "State at the end of the run.")
      .is_map = !is_line;
  }
} // namespace SlipStep
