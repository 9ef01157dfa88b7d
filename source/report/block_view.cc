// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/run_figures.h>

#include <slipstep/utilities/text.h>

#include <slipstep_block_view_script.h>

#include <deal.II/base/tensor.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <regex>

namespace SlipStep
{
  namespace
  {
    namespace fs = std::filesystem;

    // A quadrilateral costs some 100 bytes: the page shall stay quick to open.
    constexpr std::size_t most_quadrilaterals = 20000, most_moments = 12;

    using Corner = std::array<double, 6>; // position, displacement [mm]

    struct Surface
    {
      double                                     time;
      std::vector<Corner>                        corners;
      std::vector<std::array<std::size_t, 4>>    quadrilaterals;
      std::map<std::string, std::vector<double>> values;
    };

    struct SurfaceField
    {
      std::string column, name, unit;
      bool        of_contact;
      double      factor = 1.;
      Range       range;

      std::string label() const
      {
        return name + (unit.empty() ? "" : "  [" + unit + "]");
      }
    };

    const char *const displacement = "displacement_mm";



    // The moments of which fields.pvd tells, or the end alone.
    std::vector<std::pair<double, fs::path>>
    surface_files(const fs::path &folder, const double end_time)
    {
      std::ifstream    in(folder / "fields.pvd");
      const std::regex entry("timestep=\"([^\"]+)\".*fields_([0-9]+)\\.pvtu");
      std::vector<std::pair<double, fs::path>> files;
      for (std::string line; std::getline(in, line);)
        {
          std::smatch match;
          if (!std::regex_search(line, match, entry))
            continue;
          const fs::path file = folder / ("surface_" + match[2].str() + ".csv");
          if (fs::exists(file))
            files.emplace_back(std::stod(match[1]), file);
        }
      if (files.empty() && fs::exists(folder / "surface.csv"))
        files.emplace_back(end_time, folder / "surface.csv");
      return files;
    }



    Surface read_surface(const double time, const fs::path &file)
    {
      std::vector<std::string> names;
      for (const std::string axis : {"x", "y", "z"})
        for (const std::string kind : {"", "u"})
          for (const std::string corner : {"0", "1", "2", "3"})
            names.push_back(kind + axis + corner + "_mm");
      const std::vector<std::string> of_face = {
        "von_mises_MPa", "contact", "pressure_MPa", "slip_mm", "r"};
      names.insert(names.end(), of_face.begin(), of_face.end());
      const CsvTable table(file, names);

      Surface surface;
      surface.time = time;
      for (const std::string &name : of_face)
        surface.values[name] = table[name];
      std::vector<double> &size = surface.values[displacement];
      std::map<std::array<double, 3>, std::size_t> known;
      for (std::size_t i = 0; i < table.size(); ++i)
        {
          std::array<std::size_t, 4> quadrilateral;
          size.push_back(0.);
          for (unsigned int k = 0; k < 4; ++k)
            {
              const std::string end = std::to_string(k) + "_mm";
              Corner            corner;
              for (unsigned int d = 0; d < 3; ++d)
                {
                  const std::string axis(1, "xyz"[d]);
                  corner[d]     = table[axis + end][i];
                  corner[3 + d] = table["u" + axis + end][i];
                }
              const auto place = known.emplace(std::array<double, 3>{corner[0],
                                                                     corner[1],
                                                                     corner[2]},
                                               surface.corners.size());
              if (place.second)
                surface.corners.push_back(corner);
              quadrilateral[k] = place.first->second;
              size.back() += std::hypot(corner[3], corner[4], corner[5]) / 4.;
            }
          surface.quadrilaterals.push_back(quadrilateral);
        }
      return surface;
    }



    // Evenly chosen, the last always.
    std::vector<Surface> read_moments(const fs::path   &folder,
                                      const double      end_time,
                                      const std::size_t most)
    {
      const auto           files = surface_files(folder, end_time);
      std::vector<Surface> moments;
      if (files.empty())
        return moments;
      moments.push_back(read_surface(files.back().first, files.back().second));
      const std::size_t size = moments[0].quadrilaterals.size();
      const std::size_t n =
        std::min({files.size(),
                  most,
                  std::max<std::size_t>(1, most_quadrilaterals / (size + 1))});
      for (std::size_t i = 1; i < n; ++i)
        {
          const auto &file =
            files[files.size() - 1 - i * (files.size() - 1) / (n - 1)];
          moments.push_back(read_surface(file.first, file.second));
        }
      std::reverse(moments.begin(), moments.end());
      return moments;
    }



    // One of 40 colours of viridis: 0 its first, 1 its last.
    std::string shade(const double share)
    {
      static const std::vector<Colour3> viridis = {{{68., 1., 84.}},
                                                   {{65., 68., 135.}},
                                                   {{42., 120., 142.}},
                                                   {{34., 168., 132.}},
                                                   {{122., 209., 81.}},
                                                   {{253., 231., 37.}}};

      const Colour3 colour =
        mixed_colour(viridis,
                     std::round(39. * std::clamp(share, 0., 1.)) / 39.);
      char text[8];
      std::snprintf(text,
                    sizeof(text),
                    "#%02x%02x%02x",
                    static_cast<unsigned char>(colour[0]),
                    static_cast<unsigned char>(colour[1]),
                    static_cast<unsigned char>(colour[2]));
      return text;
    }



    std::string colour_bar(const SurfaceField &field,
                           const double        view_width,
                           const double        view_height)
    {
      constexpr unsigned int n     = 40;
      const double           width = 260., top = view_height - 32.,
                   left = (view_width - width) / 2.;

      const auto text = [&](const double       x,
                            const double       y,
                            const std::string &anchor,
                            const std::string &content) {
        return "<text x='" + fixed_text(x, 1) + "' y='" + fixed_text(y, 1) +
               "' text-anchor='" + anchor + "'>" + html_text(content) +
               "</text>\n";
      };
      std::string svg;
      for (unsigned int i = 0; i < n; ++i)
        svg += "<rect x='" + fixed_text(left + width * i / n, 1) + "' y='" +
               fixed_text(top, 1) + "' width='7' height='10' fill='" +
               shade(i / (n - 1.)) + "'/>";
      return svg + text(left, top - 6., "start", field.label()) +
             text(left, top + 25., "start", short_text(field.range.lower, 3)) +
             text(left + width,
                  top + 25.,
                  "end",
                  short_text(field.range.upper, 3));
    }



    using Point = dealii::Tensor<1, 3>;

    // To the right, upwards and towards the eye, of a block turned about z and
    // then tilted.
    Point turned(const Point &p)
    {
      constexpr double turn = -0.6, tilt = 0.45;

      const double a = std::cos(turn) * p[0] + std::sin(turn) * p[1];
      const double b = -std::sin(turn) * p[0] + std::cos(turn) * p[1];
      return Point({a,
                    std::cos(tilt) * p[2] + std::sin(tilt) * b,
                    std::sin(tilt) * p[2] - std::cos(tilt) * b});
    }



    /// Moments of a block, and how to show them.
    class BlockView
    {
    public:
      BlockView(std::vector<Surface> read)
        : moments(std::move(read))
      {
        for (const Surface &moment : moments)
          for (const Corner &corner : moment.corners)
            for (unsigned int d = 0; d < 3; ++d)
              box[d].add(corner[d]);
        is_flat = box[2].width() <= 0.;
        make_thick();
        choose_scale();
        choose_fields();
      }

      /// The script draws the block of the element which it stands in, from the
      /// JSON before it. Faces are painted from the back to the front; a canvas
      /// is quick enough for so many, and takes no library into the page.
      std::string html() const
      {
        return "<div class='block-view'>\n" + drawing(900., 400., true) +
               "<script type='application/json'>" + json() +
               "</script>\n<script>\n" + block_view_script +
               "</script></div>\n";
      }

      /// The mesh alone, small.
      std::string mesh() const
      {
        return drawing(320., 260., false);
      }

      std::size_t n_faces() const
      {
        return moments.back().quadrilaterals.size();
      }

      std::string caption() const
      {
        return enlargement() +
               (is_flat ? "Drag to move" :
                          "Drag or arrow keys to turn, with shift to move") +
               "; + and − or Ctrl and wheel for the size; double click to start "
               "again.";
      }

      std::string enlargement() const
      {
        std::string text;
        for (unsigned int d = 0; d < 3; ++d)
          if (enlarged[d] > 1.)
            text += "Drawn " + rounded_text(enlarged[d], 3) +
                    " times as thick along " + "xyz"[d] + ". ";
        return text;
      }

    private:
      // Of a thin strip nothing would be seen.
      void make_thick()
      {
        constexpr double thinnest = 1. / 12.;

        const double largest = extent();
        for (unsigned int d = 0; d < (is_flat ? 2 : 3); ++d)
          if (box[d].width() < thinnest * largest / 1.5)
            {
              enlarged[d] = std::round(thinnest * largest / box[d].width());
              for (Surface &moment : moments)
                for (Corner &corner : moment.corners)
                  for (const unsigned int i : {d, d + 3})
                    corner[i] *= enlarged[d];
              box[d].lower *= enlarged[d];
              box[d].upper *= enlarged[d];
            }
      }

      double extent() const
      {
        return std::max({box[0].width(), box[1].width(), box[2].width()});
      }

      // A round number by which deformation is seen and keeps the shape.
      void choose_scale()
      {
        double largest = 0.;
        for (const Surface &moment : moments)
          for (const Corner &corner : moment.corners)
            for (unsigned int d = 3; d < 6; ++d)
              largest = std::max(largest, std::abs(corner[d]));
        if (!(largest > 0.))
          return;
        const double wanted = 0.05 * extent() / largest;
        const double power  = std::pow(10., std::floor(std::log10(wanted)));
        scale               = power * (wanted >= 5. * power ? 5. :
                                       wanted >= 2. * power ? 2. :
                                                              1.);
      }

      void choose_fields()
      {
        fields = {{"von_mises_MPa", "equivalent stress", "MPa", false, 1., {}},
                  {displacement, "displacement", "mm", false, 1., {}}};
        if (!is_flat)
          fields.insert(fields.end(),
                        {{"pressure_MPa", "pressure", "MPa", true, 1., {}},
                         {"slip_mm", "slip", "mm", true, 1., {}},
                         {"r", "r", "", true, 1., {}}});
        for (SurfaceField &field : fields)
          {
            for (const Surface &moment : moments)
              for (std::size_t i = 0; i < moment.quadrilaterals.size(); ++i)
                if (!field.of_contact || moment.values.at("contact")[i] > 0.)
                  field.range.add(moment.values.at(field.column)[i]);
            if (field.unit == "mm" && field.range.upper < 0.01)
              {
                field.unit   = "µm";
                field.factor = 1e3;
              }
            field.range.lower *= field.factor;
            field.range.upper *= field.factor;
            const double least =
              std::max(1e-12, 1e-3 * std::abs(field.range.upper));
            if (field.range.width() < least)
              field.range = {field.range.lower - least,
                             field.range.upper + least};
          }
      }

      std::string json() const
      {
        const auto rounded = [](const double x) {
          return nlohmann::json::parse(rounded_text(x, 4));
        };
        nlohmann::json data;
        data["flat"]   = is_flat;
        data["scale"]  = scale;
        data["centre"] = {box[0].middle(), box[1].middle(), box[2].middle()};
        data["extent"] = {box[0].width(), box[1].width()};
        if (!is_flat)
          data["extent"].push_back(box[2].width());
        for (const SurfaceField &field : fields)
          data["fields"].push_back({{"key", field.column},
                                    {"label", field.label()},
                                    {"of_contact", field.of_contact},
                                    {"from", field.range.lower},
                                    {"to", field.range.upper}});
        for (const Surface &moment : moments)
          {
            nlohmann::json state;
            state["t"] = rounded(moment.time);
            for (const Corner &corner : moment.corners)
              for (const double x : corner)
                state["v"].push_back(rounded(x));
            for (const auto &quadrilateral : moment.quadrilaterals)
              for (const std::size_t corner : quadrilateral)
                state["q"].push_back(corner);
            for (const double x : moment.values.at("contact"))
              state["contact"].push_back(x > 0. ? 1 : 0);
            for (const SurfaceField &field : fields)
              for (const double x : moment.values.at(field.column))
                state[field.column].push_back(rounded(field.factor * x));
            data["states"].push_back(state);
          }
        return data.dump();
      }

      // The last moment, seen from above; all faces of one colour are one path.
      std::string drawing(const double width,
                          const double height,
                          const bool   is_coloured) const
      {
        const SurfaceField &field  = fields[0];
        const double        margin = is_coloured ? 25. : 8.;
        const double        foot   = is_coloured ? 65. : 8.;
        const double        shown  = is_coloured ? scale : 0.;

        const Surface     &moment = moments.back();
        std::vector<Point> places;
        Range              x, y;
        for (const Corner &corner : moment.corners)
          {
            Point p;
            for (unsigned int d = 0; d < 3; ++d)
              p[d] = corner[d] + shown * corner[3 + d] - box[d].middle();
            places.push_back(is_flat ? p : turned(p));
            x.add(places.back()[0]);
            y.add(places.back()[1]);
          }
        const double size = std::min((width - 2. * margin) / x.width(),
                                     (height - margin - foot) / y.width());

        std::map<std::string, std::string> paths;
        for (std::size_t i = 0; i < moment.quadrilaterals.size(); ++i)
          {
            const auto &corners = moment.quadrilaterals[i];
            if (!is_seen(corners))
              continue;
            const double share =
              (field.factor * moment.values.at(field.column)[i] -
               field.range.lower) /
              field.range.width();
            std::string &path = paths[is_coloured ? shade(share) : "#e8eef4"];
            for (unsigned int k = 0; k < 4; ++k)
              path += (k == 0 ? "M" : "L") +
                      fixed_text(width / 2. +
                                   size * (places[corners[k]][0] - x.middle()),
                                 1) +
                      " " +
                      fixed_text((height - foot + margin) / 2. -
                                   size * (places[corners[k]][1] - y.middle()),
                                 1);
            path += "Z";
          }
        std::string svg =
          "<svg viewBox='0 0 " + fixed_text(width, 0) + " " +
          fixed_text(height, 0) +
          "' role='img' font-size='13' fill='currentColor'><title>The block at "
          "the end of the run</title>\n<g stroke='#777' stroke-width='.5' "
          "stroke-linejoin='round'>\n";
        for (const auto &path : paths)
          svg += "<path fill='" + path.first + "' d='" + path.second + "'/>\n";
        return svg + "</g>\n" +
               (is_coloured ? colour_bar(field, width, height) : "") +
               "</svg>\n";
      }

      // Whether a face of the last moment does not look away.
      bool is_seen(const std::array<std::size_t, 4> &corners) const
      {
        if (is_flat)
          return true;
        Point middle; // from that of the block
        for (unsigned int d = 0; d < 3; ++d)
          middle[d] = -box[d].middle();
        std::array<Point, 4> places;
        for (unsigned int k = 0; k < 4; ++k)
          {
            for (unsigned int d = 0; d < 3; ++d)
              places[k][d] = moments.back().corners[corners[k]][d];
            middle += places[k] / 4.;
          }
        const Point normal = dealii::cross_product_3d(places[2] - places[0],
                                                      places[3] - places[1]);
        return normal * middle * turned(normal)[2] > 0.;
      }

      std::vector<Surface>      moments;
      std::array<Range, 3>      box;
      std::array<double, 3>     enlarged{{1., 1., 1.}};
      bool                      is_flat = false;
      double                    scale   = 1.;
      std::vector<SurfaceField> fields;
    };
  } // namespace



  std::string block_picture(const RunResults         &run,
                            std::vector<std::string> &warnings)
  {
    try
      {
        std::vector<Surface> moments =
          read_moments(run.folder,
                       run.history.empty() ? 0. : run.history.back().time,
                       most_moments);
        if (moments.empty() || moments.back().quadrilaterals.empty())
          return "";
        const BlockView view(std::move(moments));
        return figure_element("The block" +
                                (run.label.empty() ? "" : ", " + run.label),
                              view.html(),
                              view.caption());
      }
    catch (const InputError &error)
      {
        warnings.push_back(std::string("the block is not shown: ") +
                           error.what());
        return "";
      }
  }



  std::string mesh_gallery(const std::vector<ReportedRun> &runs,
                           std::vector<std::string>       &warnings)
  {
    // Finer ones are grey, and make the page slow.
    constexpr std::size_t most_faces = 4500;

    std::string figures, enlargement, too_fine;
    for (const ReportedRun &run : runs)
      try
        {
          std::vector<Surface> moments = read_moments(run.folder, 0., 1);
          if (moments.empty())
            continue;
          const BlockView   view(std::move(moments));
          const std::string name =
            run.label + ", " +
            counted(read_summary(run.folder / "summary.json").dofs, "unknown");
          enlargement = view.enlargement();
          if (view.n_faces() > most_faces)
            too_fine += (too_fine.empty() ? "" : "; ") + name;
          else
            figures += "<figure>" + view.mesh() + "<figcaption>" +
                       html_text(name) + "</figcaption></figure>\n";
        }
      catch (const InputError &error)
        {
          warnings.push_back("the mesh of " + run.label +
                             " is not shown: " + error.what());
        }
    if (figures.empty())
      return "";
    if (!too_fine.empty())
      too_fine = "Too fine to be drawn: " + too_fine + ".";
    return heading("Meshes at the end") + "<div class='gallery'>\n" + figures +
           "</div>\n" + note(enlargement + too_fine);
  }
} // namespace SlipStep
