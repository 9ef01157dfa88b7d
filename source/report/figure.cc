// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/figure.h>

#include <slipstep/utilities/process.h>
#include <slipstep/utilities/text.h>
#include <slipstep/utilities/write_file.h>

#include <cmath>
#include <fstream>
#include <regex>

namespace SlipStep
{
  namespace
  {
    std::string first_line_with(const std::filesystem::path &file,
                                const std::string           &word)
    {
      std::ifstream in(file);
      for (std::string line; std::getline(in, line);)
        if (line.find(word) != std::string::npos)
          return line;
      return "";
    }
  } // namespace



  Figure::Figure(const std::filesystem::path &folder,
                 const std::string           &name,
                 const std::string           &title,
                 const unsigned int           width,
                 const unsigned int           height)
    : title(title)
    , folder(folder)
    , name(name)
    , width(width)
    , height(height)
  {}



  std::string Figure::add_data(const std::string              &title,
                               const std::vector<std::string> &columns,
                               const Rows                     &rows)
  {
    // Two blank lines separate the blocks that gnuplot calls an index.
    data << (n_blocks > 0 ? "\n\n" : "") << "# " << title << "\n#";
    for (const std::string &column : columns)
      data << ' ' << column;
    data << '\n';
    for (const auto &row : rows)
      {
        for (std::size_t i = 0; i < row.size(); ++i)
          data << (i > 0 ? " " : "")
               << (std::isfinite(row[i]) ? exact_text(row[i]) : "NaN");
        data << '\n';
      }
    if (rows.empty())
      data << "NaN\n";
    return "'" + name + ".dat' index " + std::to_string(n_blocks++);
  }



  void Figure::plot(const std::string              &title,
                    const std::vector<std::string> &columns,
                    const Rows                     &rows,
                    const std::string              &style)
  {
    plot(add_data(title, columns, rows) + ' ' + style);
  }



  void Figure::plot(const std::string &plotted)
  {
    plots += (plots.empty() ? "plot " : ", \\\n  ") + plotted;
  }



  std::ostream &Figure::script()
  {
    return commands;
  }



  std::string Figure::write()
  {
    // Where the axes are, for who reads values off the picture; of several
    // panels gnuplot knows but the last.
    const bool is_single =
      commands.str().find("multiplot") == std::string::npos;
    const std::string axes_file = name + ".axes";
    if (!plots.empty())
      commands << plots << '\n';
    std::error_code ignored;
    std::filesystem::remove(svg_file(), ignored);
    write_file(folder / (name + ".dat"), data.str());
    write_file(folder / (name + ".gp"),
               "# " + title + "\n# draw again: gnuplot " + name +
                 ".gp\nset encoding utf8\nset terminal svg enhanced size " +
                 std::to_string(width) + "," + std::to_string(height) +
                 " font 'DejaVu Sans,Verdana,sans-serif,13' background "
                 "'#ffffff'\nset output '" +
                 name + ".svg'\n" + commands.str() + "set output\n" +
                 (is_single ?
                    "set print '" + axes_file +
                      "'\nprint GPVAL_TERM_XMIN, GPVAL_TERM_XMAX, "
                      "GPVAL_TERM_YMIN, GPVAL_TERM_YMAX, GPVAL_X_MIN, "
                      "GPVAL_X_MAX, GPVAL_Y_MIN, GPVAL_Y_MAX\nset print\n" :
                    ""));

    const std::string reason = draw();
    axes                     = first_line_with(folder / axes_file, " ");
    std::filesystem::remove(folder / axes_file, ignored);
    if (reason.empty() && std::filesystem::exists(svg_file()))
      return "";
    std::filesystem::remove(svg_file(), ignored);
    return "no picture '" + title + "': " + reason +
           "; its data and script are " + (folder / (name + ".gp")).string();
  }



  // In words, what went wrong. Where gnuplot hangs once, it is not tried again.
  std::string Figure::draw() const
  {
    constexpr std::chrono::seconds time_limit(60);
    static bool                    hangs = false;
    const std::string              log   = name + ".log";
    const ProgramEnd               end =
      hangs ? ProgramEnd::too_slow :
                            run_program({"gnuplot", name + ".gp"}, folder, log, time_limit);
    const std::string complaint = first_line_with(folder / log, "line ");
    std::error_code   ignored;
    std::filesystem::remove(folder / log, ignored);
    switch (end)
      {
        case ProgramEnd::success:
          return "";
        case ProgramEnd::not_found:
          return "gnuplot is not installed (Debian package gnuplot-nox)";
        case ProgramEnd::too_slow:
          hangs = true;
          return "gnuplot hangs (stopped after " +
                 std::to_string(time_limit.count()) + " s)";
        case ProgramEnd::stopped:
          return SignalGuard::in_words();
        default:
          return "gnuplot cannot draw it: " + complaint;
      }
  }



  std::string Figure::inline_svg() const
  {
    std::ifstream     in(svg_file());
    std::stringstream buffer;
    buffer << in.rdbuf();
    std::string svg   = buffer.str();
    const auto  begin = svg.find("<svg");
    if (begin == std::string::npos)
      return "";
    svg = svg.substr(begin);

    // Pictures share one page: the same id twice would mix them up.
    svg = std::regex_replace(svg,
                             std::regex("\\bid=(['\"])"),
                             "id=$1" + name + "-");
    svg = std::regex_replace(svg,
                             std::regex("href=(['\"])#"),
                             "href=$1#" + name + "-");
    svg = std::regex_replace(svg, std::regex("url\\(#"), "url(#" + name + "-");
    svg = std::regex_replace(svg,
                             std::regex("<title>Gnuplot</title>"),
                             "<title>" + html_text(title) + "</title>");
    std::smatch       logarithmic;
    const std::string script = commands.str();
    std::regex_search(script, logarithmic, std::regex("set logscale ([xy]+)"));
    return "<svg role='img' aria-label=\"" + html_text(title) + "\"" +
           (axes.empty() ? "" :
                           " data-axes='" + axes + "' data-log='" +
                             logarithmic.str(1) + "'") +
           svg.substr(4);
  }



  std::filesystem::path Figure::svg_file() const
  {
    return folder / (name + ".svg");
  }



  std::string gnuplot_text(const std::string &text)
  {
    // Inside double quotes one backslash is used up by the string, the other
    // by the enhanced text mode.
    std::string result = "\"";
    for (const char c : text)
      switch (c)
        {
          case '"':
            result += "\\\"";
            break;
          case '\\':
          case '_':
          case '^':
          case '@':
          case '&':
          case '~':
          case '{':
          case '}':
            result += std::string(c == '\\' ? "\\\\\\" : "\\\\") + c;
            break;
          case '`': // would run a command
            result += '\'';
            break;
          case '\n':
            result += ' ';
            break;
          default:
            result += c;
        }
    return result + "\"";
  }



  std::string html_text(const std::string &text)
  {
    std::string result;
    for (const char c : text)
      switch (c)
        {
          case '&':
            result += "&amp;";
            break;
          case '<':
            result += "&lt;";
            break;
          case '>':
            result += "&gt;";
            break;
          case '"':
            result += "&quot;";
            break;
          default:
            result += c;
        }
    return result;
  }
} // namespace SlipStep
