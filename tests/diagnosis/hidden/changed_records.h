// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tests_diagnosis_hidden_changed_records_h
#define tests_diagnosis_hidden_changed_records_h

// Records of tests as other sensors, units and mishaps make them.

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <functional>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace SlipStep::Testing
{
  // Positions that tremble [mm], and a load by a share, which is in the
  // friction, too.
  inline std::string
  with_noise_of_sensors(const double                   position,
                        const double                   load,
                        const std::function<double()> &normal,
                        const std::string             &text)
  {
    std::istringstream       in(text);
    std::ostringstream       out;
    std::string              line;
    std::vector<std::string> names;
    out.precision(10);
    while (std::getline(in, line))
      {
        const std::vector<std::string> cells =
          dealii::Utilities::split_string_list(line, ',');
        if (line[0] == '#' || line.find("time") != std::string::npos)
          {
            names = cells;
            out << line << '\n';
            continue;
          }
        const double share = 1. + load * normal();
        for (std::size_t i = 0; i < cells.size(); ++i)
          {
            double value = std::stod(cells[i]);
            if (names[i].rfind("displacement", 0) == 0)
              value += position * normal();
            if (names[i].rfind("pressure", 0) == 0)
              value *= share;
            if (names[i].rfind("friction", 0) == 0)
              value /= share;
            out << (i > 0 ? "," : "") << value;
          }
        out << '\n';
      }
    return out.str();
  }

  // Of a test with one axis, row by row.
  inline std::string with_friction(const std::function<double(double)> &changed,
                                   const std::string                   &text)
  {
    std::istringstream in(text);
    std::ostringstream out;
    std::string        line;
    out.precision(10);
    while (std::getline(in, line))
      {
        const std::size_t comma = line.rfind(',');
        if (line[0] == '#' || line.find("time") != std::string::npos)
          out << line << '\n';
        else
          out << line.substr(0, comma + 1)
              << changed(std::stod(line.substr(comma + 1))) << '\n';
      }
    return out.str();
  }

  inline std::string with_friction_times(const double       factor,
                                         const std::string &text)
  {
    return with_friction(
      [=](const double friction) { return factor * friction; }, text);
  }

  // Of a sensor that moves by a share to what it sees.
  inline std::string slowed(const double share, const std::string &text)
  {
    double shown = 0.;
    return with_friction(
      [&](const double friction) {
        return shown += share * (friction - shown);
      },
      text);
  }

  // Of a sensor that shows that much without any friction.
  inline std::string with_zero(const double zero, const std::string &text)
  {
    std::istringstream in(text);
    std::ostringstream out;
    std::string        line;
    std::size_t        of_friction = 0;
    out.precision(10);
    while (std::getline(in, line))
      {
        std::vector<std::string> cells =
          dealii::Utilities::split_string_list(line, ',');
        if (line[0] == '#' || line.find("time") != std::string::npos)
          {
            of_friction =
              std::find(cells.begin(), cells.end(), "friction") - cells.begin();
            out << line << '\n';
            continue;
          }
        for (std::size_t i = 0; i < cells.size(); ++i)
          out << (i > 0 ? "," : "")
              << std::stod(cells[i]) + (i == of_friction ? zero : 0.);
        out << '\n';
      }
    return out.str();
  }

  // Half of the friction in three rows of the middle; a test with one axis.
  inline std::string with_bad_rows(const std::string &text)
  {
    std::istringstream       in(text);
    std::ostringstream       out;
    std::vector<std::string> lines;
    std::string              line;
    while (std::getline(in, line))
      lines.push_back(line);
    out.precision(10);
    for (std::size_t i = 0; i < lines.size(); ++i)
      if (i >= lines.size() / 2 && i < lines.size() / 2 + 3)
        {
          const std::size_t comma = lines[i].rfind(',');
          out << lines[i].substr(0, comma + 1)
              << 0.5 * std::stod(lines[i].substr(comma + 1)) << '\n';
        }
      else
        out << lines[i] << '\n';
    return out.str();
  }

  // Five rows each of friction much higher under high pressure and much lower
  // under low pressure; a test with one axis.
  inline std::string with_rows_that_go_with_pressure(const std::string &text)
  {
    std::istringstream in(text);
    std::ostringstream out;
    std::string        line;
    unsigned int       n_rows = 0;
    out.precision(10);
    while (std::getline(in, line))
      {
        const std::size_t last = line.rfind(',');
        if (line[0] == '#' || line[0] == 't')
          {
            out << line << '\n';
            continue;
          }
        const std::size_t before   = line.rfind(',', last - 1);
        const double      pressure = std::stod(line.substr(before + 1));
        ++n_rows;
        const bool is_bad = n_rows >= 60 && n_rows < 65;
        out << line.substr(0, last + 1)
            << (!is_bad       ? 1. :
                pressure > 8. ? 1.6 :
                pressure < 4. ? 0.4 :
                                1.) *
                 std::stod(line.substr(last + 1))
            << '\n';
      }
    return out.str();
  }

  // Displacement in um, time in ms, pressure in kPa.
  inline std::string in_other_units(const std::string &text)
  {
    std::istringstream in(text);
    std::ostringstream out;
    std::string        line;
    bool               is_head = true;
    out.precision(17);
    while (std::getline(in, line))
      {
        if (line[0] == '#')
          {
            out << line << '\n';
            continue;
          }
        if (is_head)
          {
            is_head = false;
            line    = std::regex_replace(line, std::regex("time_s"), "time_ms");
            line    = std::regex_replace(line, std::regex("_mm"), "_um");
            line    = std::regex_replace(line, std::regex("_MPa"), "_kPa");
            out << line << '\n';
            continue;
          }
        std::istringstream row(line);
        std::string        cell;
        for (unsigned int column = 0; std::getline(row, cell, ','); ++column)
          out << (column > 0 ? "," : "")
              << std::stod(cell) * (column == 3 || column == 5 ? 1. : 1000.);
        out << '\n';
      }
    return out.str();
  }
} // namespace SlipStep::Testing

#endif
