// SPDX-License-Identifier: LGPL-2.1-or-later
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
function nearest(plot, at) {
  let best = null;
  for (const curve of plot.curves) if (!curve.off)
    for (const p of curve.points) {
      const d = Math.hypot(p[0] - at.x, p[1] - at.y);
      if (!best || d < best.d) best = { d, p, curve };
    }
  return best;
}
// Where a curve over a growing abscissa is.
function level(curve, x) {
  for (let i = 1; i < curve.points.length; ++i) {
    const a = curve.points[i - 1], b = curve.points[i];
    if (a[0] <= x && x <= b[0]) return a[1] + (b[1] - a[1]) *
      (b[0] > a[0] ? (x - a[0]) / (b[0] - a[0]) : 1);
  }
  return null;
}
// Of the run whose curve is nearest, all panels: they draw the same runs.
function stacked(plots, plot, p, runs) {
  const distance = curve => { const y = level(curve, p.x);
    return y === null ? Infinity : Math.abs(y - p.y); };
  const run = plot.curves.reduce((best, curve, i) =>
    distance(curve) < distance(plot.curves[best]) ? i : best, 0);
  if (!plot.curves.length || distance(plot.curves[run]) === Infinity) return [];
  const lines = runs.length > 1 ? [runs[run]] : [];
  lines.push('path ' + number(plot.x(p.x)) + ' mm');
  for (const other of plots) {
    const y = other.curves[run] ? level(other.curves[run], p.x) : null;
    if (y === null) continue;
    mark(other, [p.x, y], true);
    lines.push(svg_name(other.svg) + ': ' + number(other.y(y)));
  }
  return lines;
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
      if (is_stack) {
        const runs = (figure.dataset.runs || '').split('\n');
        tell(e, stacked(plots, plot, p, runs).join('\n'));
        return;
      }
      const found = nearest(plot, p);
      if (!found || found.d > 40) { tell(e, ''); return; }
      mark(plot, found.p);
      const label = found.curve.label;
      tell(e, (label ? label + ': ' : '') + number(plot.x(found.p[0])) + ', ' +
        number(plot.y(found.p[1])));
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
