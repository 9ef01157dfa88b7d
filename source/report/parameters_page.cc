// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/page.h>
#include <slipstep/report/parameters_page.h>
#include <slipstep/utilities/pattern_words.h>

namespace SlipStep
{
  namespace
  {
    // Rows that have all the words that are typed.
    const char *const search = R"(<style>
#search { font: inherit; width: 100%; box-sizing: border-box; padding: .4em;
  position: sticky; top: 0; z-index: 1; display: none; }
.parameters td:first-child { white-space: normal; min-width: 11em; }
.parameters td { overflow-wrap: anywhere; }
@media print { #search { display: none !important; } }
</style>
<input id='search' type='search' aria-label='Search in keys and meanings'
  placeholder='Search: healing rate, tolerance, mm/s ...'>
<p class='origin' id='found' role='status'></p>
)";

    const char *const search_script = R"(<script>
(() => {
const field = document.getElementById('search');
const rows = [...document.querySelectorAll('.parameters tbody tr')];
field.style.display = 'block';
const show = () => {
  const words = field.value.toLowerCase().split(/\s+/).filter(w => w);
  let n = 0;
  for (const row of rows) {
    const text = row.textContent.toLowerCase();
    row.hidden = !words.every(w => text.includes(w));
    if (!row.hidden) ++n;
  }
  document.getElementById('found').textContent =
    n + ' of ' + rows.length + ' parameters';
  history.replaceState(null, '', '#' + encodeURIComponent(field.value));
};
field.value = decodeURIComponent(location.hash.slice(1));
field.addEventListener('input', show);
show();
})();
</script>
)";
  } // namespace



  std::string parameters_page(const Parameters               &parameters,
                              const std::vector<std::string> &only)
  {
    std::vector<TableLine> lines = {{"key", "default", "allowed", "meaning"}};
    for (const std::string &path : only.empty() ? parameters.paths() : only)
      {
        const Parameters::Entry &entry = parameters.entry(path);
        lines.push_back({path,
                         entry.default_value,
                         allowed_in_words(*entry.pattern),
                         entry.documentation});
      }
    return html_page("Parameters of slipstep",
                     "Every key of a case, as Section/Key: --set "
                     "\"Section/Key = value\", or in sections of a .prm file.",
                     search + html_table(lines, "parameters") + search_script);
  }
} // namespace SlipStep
