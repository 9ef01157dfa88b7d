// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/page.h>

#include <slipstep/report/figure.h>
#include <slipstep/report/repeat_command.h>
#include <slipstep/utilities/version.h>

namespace SlipStep
{
  namespace
  {
    const char *const style = R"(
:root { color-scheme: light; }
body { font: 16px/1.5 "DejaVu Sans", Verdana, sans-serif; color: #222;
  background: #fff; max-width: 900px; margin: 2em auto; padding: 0 1em; }
h1 { font-size: 1.6em; margin: 0 0 .2em; }
h2 { font-size: 1.2em; margin: 2em 0 .5em; border-bottom: 1px solid #ccc;
  padding-bottom: .15em; }
.headline { font-size: 1.1em; margin: .4em 0 1.2em; }
.origin { color: #666; font-size: .85em; }
.problem { border-left: 4px solid #D55E00; background: #fdf3ec;
  padding: .5em .8em; margin: .8em 0; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-size: .85em; margin: .5em 0 1em;
  font-variant-numeric: tabular-nums; }
th { text-align: left; vertical-align: bottom; border-bottom: 2px solid #888;
  font-weight: 600; }
th, td { padding: .25em .8em .25em 0; }
td { border-bottom: 1px solid #e4e4e4; vertical-align: top; }
.numbers th, .numbers td { text-align: right; }
.numbers th:first-child, .numbers td:first-child { text-align: left;
  white-space: nowrap; }
.unbroken td { white-space: nowrap; }
.matrix tbody th { border-bottom: 1px solid #e4e4e4; }
.matrix tbody td { padding-left: .8em; }
.values td:last-child { font-family: "DejaVu Sans Mono", monospace; }
figure { margin: 0 0 1.5em; break-inside: avoid; }
figcaption { color: #555; font-size: .85em; }
svg { width: 100%; height: auto; display: block; }
.map svg path, .map svg polygon { shape-rendering: crispEdges; }
.block-view canvas { width: 100%; touch-action: pan-y; display: none; }
.block-view .controls { display: none; font-size: .85em; margin: .3em 0; }
.block-view .controls > * { margin-right: 1.2em; white-space: nowrap; }
.block-view input[type=range] { width: 8em; vertical-align: middle; }
.block-view.alive svg { display: none; }
.block-view.alive canvas, .block-view.alive .controls { display: block; }
.gallery { display: grid; gap: .6em 1em;
  grid-template-columns: repeat(auto-fill, minmax(min(100%, 320px), 1fr)); }
.gallery figure { margin: 0; max-width: 470px; min-width: 0; }
.gallery figcaption { color: #222; font-weight: 600; text-align: center;
  overflow-wrap: anywhere; }
.legend { font-size: .85em; margin: .4em 0; }
.legend span { display: inline-block; margin-right: 1.2em; }
.legend i { display: inline-block; vertical-align: middle; width: 2em;
  margin-right: .5em; border-top: 3px solid; }
.legend i.dashed { border-top-style: dashed; }
.legend i.area { border-top-width: .9em; }
.legend i.dot { width: .6em; height: .6em; border: 0; border-radius: 50%;
  background: currentColor; }
summary { cursor: pointer; color: #0072B2; margin: 1em 0; }
pre { background: #f4f4f4; padding: .7em 1em; overflow-x: auto;
  font-size: .85em; }
@media print { body { margin: 0; max-width: none; font-size: 11pt; }
  .gallery { grid-template-columns: 1fr 1fr; }
  .legend { break-after: avoid; print-color-adjust: exact; }
  .scroll { overflow: visible; } h2 { break-after: avoid; }
  .block-view.alive svg { display: block; }
  .block-view.alive canvas, .block-view.alive .controls { display: none; }
  tr { break-inside: avoid; } pre { white-space: pre-wrap; } }
)";
  } // namespace



  std::string html_page(const std::string &title,
                        const std::string &headline,
                        const std::string &content)
  {
    return "<!DOCTYPE html>\n<html lang='en'>\n<head>\n"
           "<meta charset='utf-8'>\n<meta name='viewport' "
           "content='width=device-width, initial-scale=1'>\n<title>" +
           html_text(title) + "</title>\n<style>" + style +
           "</style>\n</head>\n<body>\n<h1>" + html_text(title) +
           "</h1>\n<p class='headline'>" + html_text(headline) + "</p>\n" +
           content + "<p class='origin'>slipstep " + html_text(version()) +
           " (" + html_text(git_hash()) +
           "). Data and gnuplot scripts of the pictures: folder report/ "
           "beside this file.</p>\n</body>\n</html>\n";
  }



  std::string title_of(const Parameters &parameters)
  {
    const std::string title = parameters.text("Report/Title");
    return title.empty() ? parameters.case_file().stem().string() : title;
  }



  std::string heading(const std::string &text)
  {
    return "<h2>" + html_text(text) + "</h2>\n";
  }



  std::string note(const std::string &text)
  {
    return text.empty() ? "" :
                          "<p class='origin'>" + html_text(text) + "</p>\n";
  }



  std::string repeat_section(const std::string &command,
                             const Parameters  &parameters)
  {
    return heading("Repeat it") + "<pre>" +
           html_text(program_call(command, parameters.case_file().string()) +
                     given_settings(parameters)) +
           "\n</pre>\n";
  }



  std::string problem_box(const std::string &text)
  {
    return "<p class='problem'>" + html_text(text) + "</p>\n";
  }



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
    return heading(picture.title) + "<figure" +
           (picture.is_map ? " class='map'" : "") + ">\n" + picture.svg +
           "<figcaption>" + html_text(picture.caption) +
           "</figcaption></figure>\n";
  }
} // namespace SlipStep
