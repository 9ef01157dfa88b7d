// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/page.h>

#include <slipstep/utilities/version.h>
#include <slipstep/utilities/write_file.h>

#include <slipstep_page_script.h>
#include <slipstep_page_style.h>

#include <boost/algorithm/string/join.hpp>

#include <nlohmann/json.hpp>

#include <cstdlib>

namespace SlipStep
{
  namespace
  {
    std::string quoted(const std::string &text)
    {
      return text.find_first_of(" '\"$&;()<>|*?`\\") == std::string::npos ?
               text :
               "\"" + text + "\"";
    }



    // On a telephone a picture is as wide as this, with letters as large as
    // those of the text.
    constexpr unsigned int small_width = 430, small_height = 290;

    void widen(Range &range)
    {
      if (!std::isfinite(range.width()))
        range = {0., 1.};
      if (!(range.width() > 0.))
        {
          const double margin = std::max(0.05 * std::abs(range.upper), 1e-6);
          range               = {range.lower - margin, range.upper + margin};
        }
    }

    std::string range_text(const Range &range)
    {
      return "[" + exact_text(range.lower) + ":" + exact_text(range.upper) +
             "]\n";
    }
  } // namespace



  Page::Page(const std::filesystem::path &folder)
    : file(folder / "report.html")
    , pictures(folder / "report")
  {
    std::filesystem::create_directories(pictures);
  }



  std::string Page::svg_of(Figure &figure)
  {
    const std::string warning = figure.write();
    if (!warning.empty())
      warnings.push_back(warning);
    return figure.inline_svg();
  }



  void Page::write(const std::string &title,
                   const std::string &headline,
                   const std::string &content) const
  {
    write_file(file, html_page(title, headline, content));
  }



  // The script gives values under the pointer, zoom by dragging, curves hidden
  // by a click into the legend, tables that sort and copy. The page is complete
  // without it.
  std::string html_page(const std::string &title,
                        const std::string &headline,
                        const std::string &content)
  {
    return "<!DOCTYPE html>\n<html lang='en'>\n<head>\n"
           "<meta charset='utf-8'>\n<meta name='viewport' "
           "content='width=device-width, initial-scale=1'>\n<title>" +
           html_text(title) + "</title>\n<style>\n" + page_style +
           "</style>\n</head>\n<body>\n<h1>" + html_text(title) +
           "</h1>\n<p class='headline'>" + html_text(headline) + "</p>\n" +
           content + "<p class='origin'>slipstep " + html_text(version()) +
           " (" + html_text(git_hash()) + ")." +
           (content.find("<svg") == std::string::npos ?
              "" :
              " Data and gnuplot scripts of the pictures: folder report/ "
              "beside this file.") +
           "</p>\n<script>\n" + page_script + "</script>\n</body>\n</html>\n";
  }



  std::string title_of(const Parameters &parameters, const std::string &name)
  {
    const std::string title = parameters.text("Report/Title");
    return !title.empty() ? title :
           !name.empty()  ? name :
                            parameters.case_file().stem().string();
  }



  std::string heading(const std::string &text)
  {
    return "<h2>" + html_text(text) + "</h2>\n";
  }



  std::string paragraph(const std::string &text, const std::string &kind)
  {
    return "<p" + (kind.empty() ? "" : " class='" + kind + "'") + ">" +
           html_text(text) + "</p>\n";
  }



  std::string note(const std::string &text)
  {
    return text.empty() ? "" : paragraph(text, "origin");
  }



  std::string program_call(const std::string &command,
                           const std::string &file,
                           const unsigned int n_ranks)
  {
    // ./run tells how it was called.
    const char *const script = std::getenv("SLIPSTEP_CALLED_AS");
    return (n_ranks > 1 ?
              "mpirun -np " + std::to_string(n_ranks) + " slipstep " :
            script != nullptr ? quoted(script) + " " :
                                "slipstep ") +
           command + " " + quoted(file);
  }



  std::string case_call(const std::string &command,
                        const Parameters  &parameters,
                        const unsigned int n_ranks)
  {
    std::string text =
      program_call(command, parameters.case_file().string(), n_ranks);
    for (const std::string &path : parameters.paths())
      if (parameters.is_set(path) &&
          parameters.origin(path).compare(0, 5, "--set") == 0)
        text += " --set \"" + path + "=" + parameters.text(path) + "\"";
    // Every value once, in the order of the variants.
    nlohmann::ordered_map<std::string, std::vector<std::string>> sweeps;
    for (const Variant &variant : parameters.variants())
      for (const Variant::Override &setting : variant.overrides)
        if (setting.origin == "--sweep" &&
            !holds(sweeps[setting.path], setting.value))
          sweeps[setting.path].push_back(setting.value);
    for (const auto &[path, values] : sweeps)
      text +=
        " --sweep \"" + path + "=" + boost::algorithm::join(values, "|") + "\"";
    return "<pre>" + html_text(text) + "\n</pre>\n";
  }



  std::string problem_boxes(const std::vector<std::string> &texts)
  {
    std::string html;
    for (const std::string &text : texts)
      html += paragraph(text, "problem");
    return html;
  }



  std::string html_table(const TableLines &lines, const std::string &kind)
  {
    std::string html = "<div class='scroll'><table class='" + kind + "'>\n";
    for (std::size_t n = 0; n < lines.size(); ++n)
      {
        const std::string cell = n == 0 ? "th" : "td";
        html += n == 0 ? "<thead><tr>" : "<tr>";
        for (const std::string &text : lines[n])
          html += "<" + cell + ">" + html_text(text) + "</" + cell + ">";
        html += n == 0 ? "</tr></thead>\n<tbody>\n" : "</tr>\n";
      }
    return html + "</tbody></table></div>\n";
  }



  std::string table_section(const std::string &title,
                            const TableLines  &lines,
                            const std::string &meaning,
                            const std::string &kind)
  {
    return lines.size() < 2 ?
             "" :
             heading(title) + html_table(lines, kind) + note(meaning);
  }



  std::string figure_element(const std::string &title,
                             const std::string &svg,
                             const std::string &caption,
                             const bool         is_map,
                             const std::string &legend)
  {
    return svg.empty() ?
             "" :
             heading(title) + legend + "<figure" +
               (is_map ? " class='map'" : "") + ">\n" + svg + "<figcaption>" +
               html_text(caption) + "</figcaption></figure>\n";
  }



  SmallPicture::SmallPicture(Page              &page,
                             const std::string &name,
                             const std::string &title)
    : Figure(page.pictures, name, title, small_width, small_height)
    , page(page)
  {
    script() << axes_style
             << "unset key\nset lmargin at screen 0.19\nset rmargin at "
                "screen 0.945\nset tmargin at screen 0.96\nset bmargin "
                "at screen 0.19\n";
  }



  void SmallPicture::axes(const std::string &x_label,
                          Range              x,
                          const std::string &y_label,
                          Range              y,
                          const bool         is_x_logarithmic)
  {
    widen(x);
    if (x.lower > 0. && x.lower < 0.05 * x.upper && !is_x_logarithmic)
      x.lower = 0.;
    widen(y);
    const double margin = 0.05 * y.width();
    // Whatever begins at zero shall stand on the axis.
    if (y.lower != 0.)
      y.lower -= margin;
    y.upper += margin;
    script() << "set xlabel " << gnuplot_text(cut_text(x_label, 46))
             << " offset 0,0.6\nset label 1 "
             << gnuplot_text(y_label)
             // Wide numbers would push a ylabel out of the picture.
             << " at screen 0.03, graph 0.5 center rotate by 90\nset xrange "
             << range_text(x) << "set yrange " << range_text(y)
             << (is_x_logarithmic ? "set logscale x\n" : "")
             << few_tics('x', x.lower, x.upper, is_x_logarithmic)
             << "set ytics " << round_up(y.width() / 8.) << '\n';
  }



  void SmallPicture::finish(Gallery &gallery)
  {
    const std::string warning = write();
    const std::string svg     = inline_svg();
    if (!svg.empty())
      gallery.pictures += "<figure><figcaption>" + html_text(title) +
                          "</figcaption>\n" + svg + "</figure>\n";
    if (!warning.empty() && !gallery.has_warned)
      page.warnings.push_back(warning);
    gallery.has_warned = gallery.has_warned || !warning.empty();
  }



  std::string legend_line(const std::vector<LegendLine> &lines)
  {
    std::string html = "<p class='legend'>";
    for (const LegendLine &line : lines)
      html += "<span><i class='" + line.kind + "' style='color:" + line.colour +
              "'></i>" + html_text(line.text) + "</span> ";
    return html + "</p>\n";
  }



  std::string gallery_section(const Gallery &gallery)
  {
    if (gallery.pictures.empty())
      return "";
    return (gallery.title.empty() ? "" : heading(gallery.title)) +
           legend_line(gallery.legend) + "<div class='gallery'>\n" +
           gallery.pictures + "</div>\n" + note(gallery.caption);
  }
} // namespace SlipStep
