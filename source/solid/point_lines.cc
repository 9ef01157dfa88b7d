// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/point_lines.h>

#include <slipstep/solid/attempt_together.h>
#include <slipstep/solid/block_probes.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/text.h>
#include <slipstep/utilities/units.h>
#include <slipstep/utilities/write_file.h>

#include <deal.II/base/utilities.h>

#include <regex>
#include <sstream>

namespace SlipStep
{
  using namespace dealii;

  namespace
  {
    const std::string lines_key = "Output/Lines";

    Tensor<1, 3> read_point(const Parameters      &parameters,
                            const BlockParameters &block,
                            const std::string     &line,
                            const std::string     &text)
    {
      const auto   coordinates = Utilities::split_string_list(text, ',');
      Tensor<1, 3> point;
      if (coordinates.size() != block.dimension)
        parameters.reject(lines_key,
                          "'" + line + "': a point of a block in " +
                            std::to_string(block.dimension) + "-D has " +
                            std::to_string(block.dimension) + " coordinates");
      for (unsigned int d = 0; d < block.dimension; ++d)
        {
          try
            {
              point[d] = parse_quantity(coordinates[d],
                                        SlipStep::Dimension::length,
                                        true);
            }
          catch (const InputError &error)
            {
              parameters.reject(lines_key, "'" + line + "': " + error.what());
            }
          if (point[d] >= 0. && point[d] <= block.size[d])
            continue;
          parameters.reject(lines_key,
                            "'" + line + "': along " + "xyz"[d] +
                              " the block reaches from 0 to " +
                              short_text(block.size[d], 6) + " mm");
        }
      return point;
    }
  } // namespace



  void declare_lines(Parameters &parameters)
  {
    parameters.declare(
      lines_key,
      "",
      Patterns::Anything(),
      "Lines of points of the block whose displacements at the end of the run "
      "are written to lines.csv, separated by ';': '(<length>, <length>[, "
      "<length>]) to (<length>, <length>[, <length>]) [with <number> points]', "
      "e.g. '(0 mm, 5 mm, 10 mm) to (10 mm, 5 mm, 10 mm) with 51 points'. 2 to "
      "100000 points, 101 if nothing is said. Empty: none.");
  }



  std::vector<PointLine> parse_lines(const Parameters      &parameters,
                                     const BlockParameters &block)
  {
    const std::regex form(
      "\\(([^()]*)\\) to \\(([^()]*)\\)( with ([0-9]{1,6}) points)?");
    std::vector<PointLine> lines;
    for (const std::string &text :
         Utilities::split_string_list(parameters.text(lines_key), ';'))
      {
        if (text.empty())
          continue;
        std::smatch match;
        if (!std::regex_match(text, match, form))
          parameters.reject(lines_key,
                            "'" + text +
                              "' is not understood; write e.g. '(0 mm, 5 mm, "
                              "10 mm) to (10 mm, 5 mm, 10 mm) with 51 points'");
        PointLine line;
        line.name  = text;
        line.begin = read_point(parameters, block, text, match[1]);
        line.end   = read_point(parameters, block, text, match[2]);
        if (match[4].matched)
          line.n_points = std::stoul(match[4]);
        if (line.n_points < 2 || line.n_points > 100000)
          parameters.reject(lines_key, "'" + text + "': 2 to 100000 points");
        if (!((line.end - line.begin).norm() > 0.))
          parameters.reject(lines_key, "'" + text + "' has no length");
        lines.push_back(line);
      }
    return lines;
  }



  template <int dim>
  void write_lines(const std::filesystem::path  &folder,
                   const std::vector<PointLine> &lines,
                   const Block<dim>             &block,
                   const MPI_Comm               &communicator)
  {
    if (lines.empty())
      return;
    const std::string  axes = "xyz";
    std::ostringstream text;
    text << "line,distance_mm";
    for (const std::string kind : {"", "displacement_"})
      for (unsigned int d = 0; d < dim; ++d)
        text << ',' << kind << axes[d] << "_mm";
    text << '\n';
    for (std::size_t i = 0; i < lines.size(); ++i)
      {
        const PointLine        &line = lines[i];
        std::vector<Point<dim>> points(line.n_points);
        for (unsigned int n = 0; n < line.n_points; ++n)
          for (unsigned int d = 0; d < dim; ++d)
            {
              const double share = n / (line.n_points - 1.);
              points[n][d] = (1. - share) * line.begin[d] + share * line.end[d];
            }
        const auto values = displacements_at(block, points, communicator);
        for (unsigned int n = 0; n < line.n_points; ++n)
          {
            text << i + 1 << ',' << exact_text(points[n].distance(points[0]));
            for (unsigned int d = 0; d < dim; ++d)
              text << ',' << exact_text(points[n][d]);
            for (unsigned int d = 0; d < dim; ++d)
              text << ',' << exact_text(values[n][d]);
            text << '\n';
          }
      }

    do_together(communicator, [&]() {
      if (Utilities::MPI::this_mpi_process(communicator) == 0)
        write_file(folder / "lines.csv", text.str());
    });
  }



  template void write_lines(const std::filesystem::path &,
                            const std::vector<PointLine> &,
                            const Block<2> &,
                            const MPI_Comm &);
  template void write_lines(const std::filesystem::path &,
                            const std::vector<PointLine> &,
                            const Block<3> &,
                            const MPI_Comm &);
} // namespace SlipStep
