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
.block-view canvas { width: 100%; touch-action: pan-y; display: none;
  background: #fff; }
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
.law td:nth-child(2) { font-family: "DejaVu Sans Mono", monospace;
  font-size: .9em; }
h1, .headline, figcaption { overflow-wrap: anywhere; }
.stack { border-left: 1px solid #ccc; }
.hover { position: fixed; pointer-events: none; background: #222; color: #fff;
  font-size: .8em; padding: .15em .5em; border-radius: 3px; z-index: 2;
  white-space: pre; }
th.sorts { cursor: pointer; } th.sorts:focus-visible { outline: 2px solid; }
.copy { font: inherit; font-size: .75em; display: block;
  margin: 0 0 0 auto; color: inherit;
  background: none; border: 1px solid #999; border-radius: 3px;
  cursor: pointer; }
[data-curve] { cursor: pointer; }
summary { cursor: pointer; color: #0072B2; margin: 1em 0; }
pre { background: #f4f4f4; padding: .7em 1em; overflow-x: auto;
  font-size: .85em; }
@media screen and (max-width: 600px) { body { margin: 1em auto; }
  figure { overflow-x: auto; } figure > svg { min-width: 600px; }
  .gallery figure > svg { min-width: 0; } }
@media screen and (prefers-color-scheme: dark) {
  :root { color-scheme: dark; } body { color: #ddd; background: #161616; }
  .origin, figcaption, .gallery figcaption { color: #aaa; }
  .problem { background: #3a2313; } pre { background: #262626; }
  h2, td, .matrix tbody th { border-color: #444; }
  summary { color: #6cb8ea; }
  svg, .legend i { filter: invert(.91) hue-rotate(180deg); }
  .map svg, .block-view svg { filter: none; background: #fff; } }
@media print { .copy, .hover { display: none; }
  body { margin: 0; max-width: none; font-size: 11pt; }
  .gallery { grid-template-columns: 1fr 1fr; }
  .legend { break-after: avoid; print-color-adjust: exact; }
  .scroll { overflow: visible; } h2 { break-after: avoid; }
  .block-view.alive svg { display: block; }
  .block-view.alive canvas, .block-view.alive .controls { display: none; }
  tr { break-inside: avoid; } pre { white-space: pre-wrap; } }
)";

    // Values under the pointer, zoom by dragging, curves hidden by a click into
    // the legend, tables that sort and copy. The page is complete without it.
    const char *const script = R"(
(() => {
const all = (root, what) => [...root.querySelectorAll(what)];
const hover = document.createElement('div');
hover.className = 'hover'; hover.hidden = true; document.body.append(hover);
const number = v => String(Number(v.toPrecision(4)));
function read(svg) {
  const [l, r, b, t, x0, x1, y0, y1] = svg.dataset.axes.trim().split(/\s+/)
    .map(Number), height = svg.viewBox.baseVal.height;
  const scale = (p, p0, p1, v0, v1, log) => { const s = (p - p0) / (p1 - p0);
    return log ? v0 * Math.pow(v1 / v0, s) : v0 + s * (v1 - v0); };
  const log = svg.dataset.log || '';
  const plot = { svg, l, r, top: height - t, bottom: height - b, curves: [],
    x: p => scale(p, l, r, x0, x1, log.includes('x')),
    y: p => scale(p, height - b, height - t, y0, y1, log.includes('y')) };
  for (const g of all(svg, 'g[id*="gnuplot_plot_"]')) {
    const text = g.querySelector('text');
    const curve = { g, label: text ? text.textContent.trim() : '', points: [] };
    let key = !!text;
    for (const path of all(g, 'path'))
      for (const part of (path.getAttribute('d') || '').split('M')) {
        const p = [...part.matchAll(/(-?[\d.]+),(-?[\d.]+)/g)];
        if (!p.length) continue;
        if (key) { key = false; continue; }
        for (const m of p) curve.points.push([+m[1], +m[2]]);
      }
    for (const use of all(g, 'use')) {
      const m = /translate\(([\d.]+),([\d.]+)/.exec(
        use.getAttribute('transform') || '');
      if (!m) continue;
      if (key) { key = false; continue; }
      curve.points.push([+m[1], +m[2]]);
    }
    curve.points = curve.points.filter(p => p[0] > l - 1 && p[0] < r + 1 &&
      p[1] > plot.top - 1 && p[1] < plot.bottom + 1);
    plot.curves.push(curve);
    if (text) legend(curve, text);
  }
  return plot;
}
function legend(curve, text) {
  text.dataset.curve = ''; text.setAttribute('tabindex', 0);
  text.setAttribute('role', 'button');
  const toggle = () => { curve.off = !curve.off;
    text.style.opacity = curve.off ? .4 : 1;
    text.setAttribute('aria-pressed', !curve.off);
    for (const e of all(curve.g, 'path, use, circle, rect, polygon'))
      e.style.display = curve.off ? 'none' : ''; };
  text.addEventListener('click', toggle);
  text.addEventListener('keydown', e => { if (e.key === 'Enter') toggle(); });
}
const at = (svg, e) => new DOMPoint(e.clientX, e.clientY)
  .matrixTransform(svg.getScreenCTM().inverse());
function nearest(plot, distance) {
  let best = null;
  for (const curve of plot.curves) if (!curve.off)
    for (const p of curve.points) {
      const d = distance(p);
      if (!best || d < best.d) best = { d, p, curve };
    }
  return best;
}
function mark(plot, p, is_line) {
  if (!plot.mark) { plot.mark = document.createElementNS(
    plot.svg.namespaceURI, 'path');
    plot.mark.setAttribute('fill', 'none');
    plot.mark.setAttribute('stroke', '#444');
    plot.mark.style.pointerEvents = 'none'; plot.svg.append(plot.mark); }
  plot.mark.setAttribute('d', !p ? '' : (is_line ?
    `M${p[0]},${plot.top}V${plot.bottom}` : '') +
    `M${p[0] - 4},${p[1]}a4,4 0 1,0 8,0a4,4 0 1,0 -8,0`);
}
function tell(e, text) {
  hover.hidden = !text; hover.textContent = text;
  hover.style.left = Math.max(0, Math.min(e.clientX + 14,
    innerWidth - hover.offsetWidth - 4)) + 'px';
  hover.style.top = Math.min(e.clientY + 14,
    innerHeight - hover.offsetHeight - 4) + 'px';
}
function zoom(plot) {
  let from = null; const svg = plot.svg, whole = svg.getAttribute('viewBox');
  svg.addEventListener('pointerdown', e => {
    if (e.pointerType === 'mouse' && !e.target.closest('text'))
      { from = at(svg, e); e.preventDefault(); } });
  svg.addEventListener('pointerup', e => {
    if (!from) return;
    const to = at(svg, e), w = Math.abs(to.x - from.x),
      h = Math.abs(to.y - from.y);
    if (w > 8 && h > 8) { svg.setAttribute('viewBox', [Math.min(to.x, from.x),
      Math.min(to.y, from.y), w, h].join(' ')); svg.dataset.zoomed = ''; }
    from = null; });
  svg.addEventListener('dblclick', () => { svg.setAttribute('viewBox', whole);
    delete svg.dataset.zoomed; });
}
const inside = (plot, p) => p.x >= plot.l && p.x <= plot.r &&
  p.y >= plot.top && p.y <= plot.bottom;
for (const figure of all(document, 'figure:not(.map)')) {
  const plots = all(figure, 'svg[data-axes]').map(read);
  const is_stack = figure.classList.contains('stack');
  for (const plot of plots) {
    const svg = plot.svg;
    for (const title of all(svg, 'title')) title.remove();
    if (!is_stack) zoom(plot);
    const clear = () => { for (const other of plots) mark(other);
      hover.hidden = true; };
    svg.addEventListener('pointermove', e => {
      const p = at(svg, e); clear();
      if (!inside(plot, p)) return;
      const lines = [];
      for (const other of is_stack ? plots : [plot]) {
        const found = nearest(other, q => is_stack ? Math.abs(q[0] - p.x) +
          (other === plot ? 1e-3 * Math.abs(q[1] - p.y) : 0) :
          Math.hypot(q[0] - p.x, q[1] - p.y));
        if (!found || (!is_stack && found.d > 40)) continue;
        mark(other, found.p, is_stack);
        const label = is_stack ? svg_name(other.svg) : found.curve.label;
        if (is_stack && !lines.length)
          lines.push('path ' + number(other.x(found.p[0])) + ' mm');
        lines.push((label ? label + ': ' : '') + (is_stack ? '' :
          number(other.x(found.p[0])) + ', ') + number(other.y(found.p[1])));
      }
      tell(e, lines.join('\n'));
    });
    svg.addEventListener('pointerleave', clear);
  }
}
function svg_name(svg) {
  return svg.getAttribute('aria-label').split(' over ')[0];
}
for (const table of all(document, 'table')) {
  const body = table.tBodies[0]; if (!body || !table.tHead) continue;
  const copy = document.createElement('button');
  copy.className = 'copy'; copy.textContent = 'copy'; copy.type = 'button';
  copy.addEventListener('click', () => {
    const text = [...table.rows].map(row => [...row.cells]
      .map(cell => cell.textContent).join('\t')).join('\n');
    const area = document.createElement('textarea');
    area.value = text; document.body.append(area); area.select();
    document.execCommand('copy'); area.remove(); copy.textContent = 'copied'; });
  table.parentNode.before(copy);
  // Where a cell stands for the rows below it, their order is a meaning.
  if (!table.classList.contains('numbers') || [...body.rows].some(row =>
    !row.cells[0].textContent)) continue;
  [...table.tHead.rows[0].cells].forEach((head, i) => {
    head.classList.add('sorts'); head.setAttribute('tabindex', 0);
    const sort = () => {
      const down = head.getAttribute('aria-sort') === 'ascending';
      for (const other of table.tHead.rows[0].cells)
        other.removeAttribute('aria-sort');
      head.setAttribute('aria-sort', down ? 'descending' : 'ascending');
      const key = row => { const text = row.cells[i].textContent;
        const v = parseFloat(text); return isNaN(v) ? text : v; };
      [...body.rows].sort((a, b) => { const p = key(a), q = key(b);
        const order = typeof p === typeof q ? (p < q ? -1 : p > q ? 1 : 0) :
          typeof p === 'number' ? -1 : 1;
        return down ? -order : order; }).forEach(row => body.append(row)); };
    head.addEventListener('click', sort);
    head.addEventListener('keydown', e => { if (e.key === 'Enter') sort(); });
  });
}
})();
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
           " (" + html_text(git_hash()) + ")." +
           (content.find("<svg") == std::string::npos ?
              "" :
              " Data and gnuplot scripts of the pictures: folder report/ "
              "beside this file.") +
           "</p>\n<script>" + script + "</script>\n</body>\n</html>\n";
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
