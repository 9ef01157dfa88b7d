#include <slipstep/experiment/report_html.h>

#include <slipstep/utilities/figure.h>

namespace SlipStep
{
  std::string html_table(const std::vector<TableLine> &lines,
                         const std::string            &kind)
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



  std::string figure_element(const Picture &picture)
  {
    return "<h2>" + html_text(picture.title) + "</h2>\n<figure" +
           (picture.is_map ? " class='map'" : "") + ">\n" + picture.svg +
           "<figcaption>" + html_text(picture.caption) +
           "</figcaption></figure>\n";
  }
} // namespace SlipStep
