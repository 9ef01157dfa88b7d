# SPDX-License-Identifier: LGPL-2.1-or-later
"""Reports in a real browser, at the width of a desk and of a phone.

  browser_test.py SLIPSTEP PRM_FOLDER    runs cases and looks at their pages
  browser_test.py PAGE.html...           looks at pages that are there

Fails if a page is larger than 3 MB, fetches anything, has an error in its
script, is wider than the screen, or if a figure has no axes, no name, text that
is cut, curves that give no value under the pointer or do not hide by a click.
"""
import html
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

CHECKS = r"""
<script>window.failures = []; addEventListener('error',
  // That of a resized canvas is told in the next frame, and no error.
  e => { if (!/ResizeObserver/.test(e.message))
    failures.push('script: ' + e.message); });</script>
"""

LAST_CHECKS = r"""
<script>
(() => {
const fail = text => failures.push(text);
const all = (root, what) => [...root.querySelectorAll(what)];
const root = document.documentElement;
if (root.scrollWidth > innerWidth + 1)
  fail('wider than the screen: ' + root.scrollWidth);
for (const entry of performance.getEntriesByType('resource'))
  fail('fetches ' + entry.name);
const ids = all(document, '[id]').map(e => e.id);
ids.forEach((id, i) => { if (ids.indexOf(id) !== i) fail('id twice: ' + id); });
all(document, 'details').forEach(e => { e.open = true; });
let n_values = 0, n_hidden = 0;
for (const svg of all(document, 'figure svg')) {
  if (svg.closest('.block-view')) continue;
  const label = svg.getAttribute('aria-label');
  if (!label) fail('a figure without a name');
  const box = svg.getBoundingClientRect();
  const texts = all(svg, 'text').filter(t => t.textContent.trim());
  if (texts.length < 3) fail(label + ': no axes');
  if (!svg.closest('.map') && !texts.some(t =>
      /rotate/.test(t.parentNode.getAttribute('transform') || '')))
    fail(label + ': no label of the ordinate');
  for (const text of texts) {
    const t = text.getBoundingClientRect();
    if (t.left < box.left - 1 || t.right > box.right + 1 ||
        t.top < box.top - 1 || t.bottom > box.bottom + 1)
      fail(label + ': cut is "' + text.textContent.trim() + '"');
  }
  const curve = all(svg, 'g[id*="gnuplot_plot_"]').find(g =>
    g.querySelector('[data-curve]'));
  if (curve) {
    const drawn = curve.querySelector('path, use');
    const key = curve.querySelector('[data-curve]');
    const press = () => key.dispatchEvent(new MouseEvent('click',
      { bubbles: true }));
    press();
    if (drawn && drawn.style.display !== 'none') fail(label + ': no hiding');
    press();
    if (drawn && drawn.style.display === 'none') fail(label + ': no showing');
    ++n_hidden;
  }
  if (!svg.dataset.axes || svg.closest('.map')) continue;
  // Somewhere in the picture is a curve.
  const tip = document.querySelector('.hover');
  let told = '';
  for (let x = .15; x < .95 && !told; x += .02)
    for (let y = .05; y < .9 && !told; y += .04) {
      svg.dispatchEvent(new PointerEvent('pointermove', { bubbles: true,
        clientX: box.left + x * box.width, clientY: box.top + y * box.height }));
      if (tip && !tip.hidden) told = tip.textContent;
    }
  if (!/\d/.test(told)) fail(label + ': no value under the pointer');
  if (/NaN|Infinity/.test(told)) fail(label + ': ' + told);
  const stack = svg.closest('.stack');
  if (stack && stack.dataset.runs.includes('\n') &&
      !stack.dataset.runs.split('\n').includes(told.split('\n')[0]))
    fail(label + ': values of no run');
  ++n_values;
  svg.dispatchEvent(new PointerEvent('pointerleave'));
}
for (const table of all(document, 'table.numbers')) {
  const head = table.querySelector('th.sorts');
  if (!head || table.tBodies[0].rows.length < 3) continue;
  const rows = () => [...table.tBodies[0].rows].map(r => r.innerText).join('|');
  head.click(); const up = rows();
  head.click(); const down = rows();
  if (head.getAttribute('aria-sort') !== 'descending') fail('a table that does not sort');
}
parent.postMessage(innerWidth + ' px: ' + (failures.length ? 'FAILED\n  ' +
  [...new Set(failures)].join('\n  ') : 'good, ' + n_values +
  ' figures with values, ' + n_hidden + ' with curves to hide') , '*');
})();
</script>
"""

WRAPPER = """<!DOCTYPE html><pre id='told'></pre><script>
onmessage = e => document.getElementById('told').textContent += e.data + '\\n';
</script>
<iframe src='page.html' width='390' height='844'></iframe>
<iframe src='page.html' width='1280' height='900'></iframe>
"""

CASES = ["velocity_step", "slide_hold_slide", "pressure_sweep",
         "anisotropic_path", "stick_slip", "ratchet"]


def look_at(browser, page):
    """What is wrong with a page, as text; "" if nothing."""
    text = page.read_text()
    if len(text.encode()) > 3e6:
        return f"{len(text.encode()) / 1e6:.1f} MB\n"
    with tempfile.TemporaryDirectory() as folder:
        checked = text.replace("<head>", "<head>" + CHECKS, 1).replace(
            "</body>", LAST_CHECKS + "</body>")
        pathlib.Path(folder, "page.html").write_text(checked)
        wrapper = pathlib.Path(folder, "wrapper.html")
        wrapper.write_text(WRAPPER)
        done = subprocess.run(
            [browser, "--headless", "--no-sandbox", "--disable-gpu",
             "--user-data-dir=" + folder + "/profile", "--dump-dom",
             "--virtual-time-budget=20000", "--window-size=1700,1800",
             wrapper.as_uri()],
            capture_output=True, text=True, timeout=300)
    found = re.search(r"<pre id=\"told\">(.*?)</pre>", done.stdout, re.S)
    told = html.unescape(found.group(1)) if found else ""
    print(told, end="")
    if "FAILED" in told:
        return told
    return "" if told.count("good") == 2 else "the checks did not come to an end\n" + told


def main():
    browser = next((found for found in map(shutil.which, [
        "chromium", "chromium-browser", "google-chrome"]) if found), None)
    if browser is None or shutil.which("gnuplot") is None:
        print("skipped: chromium or gnuplot is not installed")
        return 77
    failed = False
    with tempfile.TemporaryDirectory() as folder:
        pages = [pathlib.Path(name) for name in sys.argv[1:]]
        if pages[0].suffix != ".html":
            program, cases = pages
            pages = []
            for case in CASES:
                output = pathlib.Path(folder, case)
                subprocess.run([program.resolve(), "point", cases / case / (case + ".prm"),
                                "--quiet", "--output", output],
                               check=True, stdout=subprocess.DEVNULL)
                pages.append(output / "report.html")
        for page in pages:
            print(page)
            failed = look_at(browser, page) != "" or failed
    return 1 if failed else 0


sys.exit(main())
