// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/run_faces.h>

#include <slipstep/report/drawing.h>
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

    Picture face_map(const std::filesystem::path &folder,
                     const RunResults            &run,
                     const std::size_t            number,
                     const std::array<Field, 2>  &fields,
                     std::vector<std::string>    &warnings)
    {
      const CsvTable &face = *run.contact_face;
      Rows            rows;
      Range           x, y;
      for (std::size_t i = 0; i < face.size(); ++i)
        {
          const double px = face["x_mm"][i], py = face["y_mm"][i];
          const double hx = 0.5 * face["cell_size_x_mm"][i];
          const double hy = 0.5 * face["cell_size_y_mm"][i];
          rows.push_back({px, py, hx, hy});
          for (const Field &field : fields)
            rows.back().push_back(field.factor *
                                  (face[field.column][i] - field.offset));
          for (const double sign : {-1., 1.})
            {
              x.add(px + sign * hx);
              y.add(py + sign * hy);
            }
        }

      // Two maps side by side, in the proportions of the face.
      const double map_width = 280.;
      const double map_height =
        std::max(60., std::min(400., map_width * y.width() / x.width()));
      Figure            figure(folder,
                    "contact_face_" + std::to_string(number),
                    "Contact face, " + legend(run),
                    picture_width,
                    static_cast<unsigned int>(map_height + 130.));
      const std::string data = figure.add_data("contact face of " + legend(run),
                                               {"x_mm",
                                                "y_mm",
                                                "half_size_x_mm",
                                                "half_size_y_mm",
                                                fields[0].label,
                                                fields[1].label},
                                               rows);
      const double      top  = 1. - 40. / (map_height + 130.);
      const double      bottom = 75. / (map_height + 130.);
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
                        << "\nset tmargin at screen " << top
                        << "\nset bmargin at screen " << bottom
                        << "\nset cbrange [" << fields[k].range.lower << ":"
                        << fields[k].range.upper << "]\nset title "
                        << gnuplot_text(fields[k].label) << "\nplot " << data
                        << " using 1:2:3:4:" << 5 + k
                        << " with boxxyerror lc palette fs solid 1 noborder\n";
      figure.script() << "unset multiplot\n";
      Picture picture = finish(figure,
                               "Contact face, " + legend(run),
                               "State at the end of the run.",
                               warnings);
      picture.is_map  = true;
      return picture;
    }

    /// In two dimensions the face is a line.
    Picture face_lines(const std::filesystem::path &folder,
                       const RunResults            &run,
                       const std::size_t            number,
                       const std::array<Field, 2>  &fields,
                       std::vector<std::string>    &warnings)
    {
      const CsvTable &face = *run.contact_face;
      Rows            rows;
      for (std::size_t i = 0; i < face.size(); ++i)
        {
          rows.push_back({face["x_mm"][i]});
          for (const Field &field : fields)
            rows.back().push_back(field.factor *
                                  (face[field.column][i] - field.offset));
        }
      std::sort(rows.begin(), rows.end());

      Figure            figure(folder,
                    "contact_face_" + std::to_string(number),
                    "Contact face, " + legend(run),
                    picture_width,
                    320);
      const std::string data =
        figure.add_data("contact face of " + legend(run),
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
      figure.script() << "unset multiplot\n";
      return finish(figure,
                    "Contact face, " + legend(run),
                    "State at the end of the run.",
                    warnings);
    }
  } // namespace



  Picture face_picture(const std::filesystem::path &folder,
                       const RunResults            &run,
                       const std::size_t            number,
                       std::vector<std::string>    &warnings)
  {
    const CsvTable            &face   = *run.contact_face;
    const std::array<Field, 2> fields = {
      field_of(face, "pressure_MPa", "Pressure", "MPa"),
      field_of(face, "slip_mm", "Slip", "mm")};
    const auto &sizes   = face["cell_size_y_mm"];
    const bool  is_line = *std::max_element(sizes.begin(), sizes.end()) <= 0.;
    return is_line ? face_lines(folder, run, number, fields, warnings) :
                     face_map(folder, run, number, fields, warnings);
  }
} // namespace SlipStep
