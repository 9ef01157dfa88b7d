// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/figure.h>

#include <slipstep/utilities/process.h>
#include <slipstep/utilities/text.h>
#include <slipstep/utilities/write_file.h>

#include <boost/algorithm/string/replace.hpp>

#include <fstream>
#include <regex>
#include <set>

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
    // One after the other.
    void replace(
      std::string                                              &text,
      const std::vector<std::pair<const char *, const char *>> &replacements)
    {
      for (const auto &[old, replacement] : replacements)
        boost::algorithm::replace_all(text, old, replacement);
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
    for (const auto &[old, unique] :
         {std::make_pair("\\bid=(['\"])", "id=$1" + name + "-"),
          std::make_pair("href=(['\"])#", "href=$1#" + name + "-"),
          std::make_pair("url\\(#", "url(#" + name + "-")})
      svg = std::regex_replace(svg, std::regex(old), unique);
    boost::algorithm::replace_first(svg,
                                    "<title>Gnuplot</title>",
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



  std::string gnuplot_text(std::string text)
  {
    // Inside double quotes one backslash is used up by the string, the other
    // by the enhanced text mode. A backquote would run a command.
    replace(text,
            {{"\\", "\\\\\\\\"}, {"\"", "\\\""}, {"`", "'"}, {"\n", " "}});
    return '"' + std::regex_replace(text, std::regex("[_^@&~{}]"), "\\\\$&") +
           '"';
  }



  std::string html_text(std::string text)
  {
    replace(text,
            {{"&", "&amp;"}, {"<", "&lt;"}, {">", "&gt;"}, {"\"", "&quot;"}});
    return text;
  }



  namespace
  {
    /// Where values lie among so many cells of their range.
    std::size_t
    cell_of(const double value, const Range &range, const std::size_t n_cells)
    {
      const double share =
        (value - range.lower) / std::max(range.width(), 1e-300);
      return std::isfinite(share) ? std::lround(share * (n_cells - 1)) : 0;
    }

    /// Leaves out lines that lie on lines before them, as those of many cycles
    /// do, with a gap in their place.
    Rows drawn_once(const Rows &points, const Range &x, const Range &y)
    {
      // A line is two pixels wide.
      constexpr std::size_t n_columns = picture_width / 2, n_rows = 200;

      std::vector<bool> is_drawn(n_columns * n_rows, false);
      // Whether any of it was not drawn yet.
      const auto draw = [&](const std::vector<double> &from,
                            const std::vector<double> &to) {
        const double column = cell_of(from[0], x, n_columns);
        const double row    = cell_of(from[1], y, n_rows);
        const double dx     = cell_of(to[0], x, n_columns) - column;
        const double dy     = cell_of(to[1], y, n_rows) - row;
        const double n      = std::max({std::abs(dx), std::abs(dy), 1.});
        bool         is_new = false;
        for (double i = 0.; i <= n; ++i)
          {
            auto drawn = is_drawn[std::lround(column + i / n * dx) * n_rows +
                                  std::lround(row + i / n * dy)];
            is_new     = is_new || !drawn;
            drawn      = true;
          }
        return is_new;
      };
      Rows kept;
      bool is_broken = true;
      for (std::size_t i = 1; i < points.size(); ++i)
        {
          if (!draw(points[i - 1], points[i]))
            {
              is_broken = true;
              continue;
            }
          if (is_broken && !kept.empty())
            kept.emplace_back(points[i].size(), std::nan(""));
          if (is_broken)
            kept.push_back(points[i - 1]);
          kept.push_back(points[i]);
          is_broken = false;
        }
      return kept;
    }
  } // namespace



  Rows extremes_of_columns(const Rows &points, const InColumn &is_in_column)
  {
    const auto is_below = [](const auto &a, const auto &b) {
      return a[1] < b[1];
    };
    Rows kept;
    for (auto begin = points.begin(), end = begin; begin != points.end();
         begin = end)
      {
        end = std::find_if(begin, points.end(), [&](const auto &point) {
          return !is_in_column(*begin, point);
        });
        const auto [least, most] = std::minmax_element(begin, end, is_below);
        for (const auto &chosen : std::set{begin, least, most, end - 1})
          kept.push_back(*chosen);
      }
    return kept;
  }



  Rows thinned(const Rows &points)
  {
    Range x, y;
    x.add(points, 0);
    y.add(points, 1);
    const double dx = std::max(x.width(), 1e-300);
    const double dy = std::max(y.width(), 1e-300);

    Rows        kept;
    std::size_t last = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
      {
        const double distance =
          std::hypot((points[i][0] - points[last][0]) / dx,
                     (points[i][1] - points[last][1]) / dy);
        if (i > 0 && i + 1 < points.size() && distance < 1e-3)
          continue;
        // Keeps corners: the curve may have rested before it jumped.
        if (i > last + 1 && distance > 3e-3)
          kept.push_back(points[i - 1]);
        kept.push_back(points[i]);
        last = i;
      }
    if (kept.size() > most_points)
      kept = extremes_of_columns(kept, [&x](const auto &a, const auto &b) {
        return cell_of(a[0], x, picture_width) ==
               cell_of(b[0], x, picture_width);
      });
    return kept.size() > most_points ? drawn_once(kept, x, y) : kept;
  }



  bool is_constant(const Range &range)
  {
    return !(range.width() >
             1e-6 * std::max(std::abs(range.lower), std::abs(range.upper)));
  }



  Range without_round_off(const Range &range)
  {
    const double half = std::max(0.05 * std::abs(range.middle()), 1e-12);
    return is_constant(range) ?
             Range{range.middle() - half, range.middle() + half} :
             range;
  }



  Range
  with_margin(const Range &range, const double share, const bool is_logarithmic)
  {
    if (is_logarithmic)
      {
        const double factor = std::pow(range.upper / range.lower, share);
        return {range.lower / factor, range.upper * factor};
      }
    const double margin = share * range.width();
    return {range.lower - margin, range.upper + margin};
  }



  double round_up(const double value)
  {
    const double decade = std::pow(10., std::floor(std::log10(value)));
    for (const double factor : {1., 2., 5.})
      if (factor * decade >= value * (1. - 1e-9))
        return factor * decade;
    return 10. * decade;
  }



  Colour3 mixed_colour(const std::vector<Colour3> &stops, const double share)
  {
    const double      at = (stops.size() - 1) * std::clamp(share, 0., 1.);
    const std::size_t begin =
      std::min(static_cast<std::size_t>(at), stops.size() - 2);
    Colour3 colour;
    for (unsigned int c = 0; c < 3; ++c)
      colour[c] =
        std::round(stops[begin][c] +
                   (at - begin) * (stops[begin + 1][c] - stops[begin][c]));
    return colour;
  }



  std::string background(const std::vector<Colour3> &stops, const double share)
  {
    const auto [red, green, blue] = mixed_colour(stops, share);
    // As eyes see it, whatever colour the page's text has.
    const bool is_dark = 0.3 * red + 0.59 * green + 0.11 * blue < 110.;
    return "background:rgb(" + exact_text(red) + "," + exact_text(green) + "," +
           exact_text(blue) + ");color:" + (is_dark ? "#fff" : "#222");
  }



  std::string few_tics(const char   axis,
                       const double lower,
                       const double upper,
                       const bool   is_logarithmic)
  {
    std::ostringstream text;
    text << "set " << axis << "tics ";
    if (!is_logarithmic)
      {
        text << round_up((upper - lower) / 4.) << '\n';
        return text.str();
      }
    const double n_decades = std::log10(upper / lower);
    const int    stride    = std::max(1, static_cast<int>(n_decades / 4.));
    const char  *separator = "(";
    for (int e = std::floor(std::log10(lower)); e <= std::log10(upper);
         e += stride)
      for (const double factor : {1., 2., 5.})
        {
          const double tic = factor * std::pow(10., e);
          if (tic < lower || tic > upper || (factor > 1. && n_decades > 1.7))
            continue;
          // The text as well: gnuplot would write 0.000010.
          text << separator << '"' << tic << "\" " << tic;
          separator = ", ";
        }
    text << (*separator == '(' ? "autofreq\n" : ")\n");
    return text.str();
  }
} // namespace SlipStep
