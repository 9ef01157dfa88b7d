// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/commands/commands.h>
#include <slipstep/measured_data/import_record.h>
#include <slipstep/commands/case.h>
#include <slipstep/report/page.h>
#include <slipstep/utilities/pattern_words.h>

#include <boost/algorithm/string/predicate.hpp>

#include <iostream>

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



    // A table of keys, defaults, what is allowed and meanings, and a field to
    // search in them.
    std::string parameters_page(const Parameters               &parameters,
                                const std::vector<std::string> &only)
    {
      std::vector<TableLine> lines = {
        table_head("key | default | allowed | meaning")};
      for (const std::string &path : only.empty() ? parameters.paths() : only)
        {
          const Parameters::Entry &entry = parameters.entry(path);
          lines.push_back({path,
                           entry.default_value,
                           allowed_in_words(*entry.pattern),
                           entry.documentation});
        }
      return html_page(
        "Parameters of slipstep",
        "Every key of a case, as Section/Key: --set "
        "\"Section/Key = value\", or in sections of a .prm file.",
        search + html_table(lines, "parameters") + search_script);
    }



    Parameters::Format format_of(const std::string &name)
    {
      return name == "json"   ? Parameters::Format::json :
             name == "schema" ? Parameters::Format::schema :
             name == "keys"   ? Parameters::Format::keys :
             name == "md"     ? Parameters::Format::markdown :
                                Parameters::Format::prm;
    }



    Parameters declared(const bool of_a_map)
    {
      Parameters parameters;
      if (of_a_map)
        declare_import_parameters(parameters);
      else
        declare_all_parameters(parameters);
      return parameters;
    }



    // Sections that hold no parameters, but change those of others.
    void reject_sections_of_many_runs(const std::string &name)
    {
      const std::string section = name.substr(0, name.find('/'));
      for (const char *known : {"Sweep", "Variants"})
        if (boost::iequals(section, known))
          throw InputError("slipstep parameters: section " +
                           std::string(known) +
                           " has no parameters of its own, it makes many runs "
                           "of a case by changing other keys; see "
                           "doc/guide/running_a_case.md");
    }



    // That a key is one of maps, or of cases.
    std::string where_else(const std::string &name, const bool of_a_map)
    {
      try
        {
          declared(!of_a_map).find(name, "");
        }
      catch (const InputError &)
        {
          return "";
        }
      return of_a_map ?
               "; it is one of cases: slipstep parameters " + name :
               "; it is one of maps: slipstep parameters import " + name;
    }
  } // namespace



  int print_parameters(const CommandLine &line)
  {
    const bool of_a_map = !line.files.empty() && line.files.front() == "import";
    Parameters parameters = declared(of_a_map);
    apply_settings(line, parameters);
    std::vector<std::string> only;
    for (std::size_t i = of_a_map ? 1 : 0; i < line.files.size(); ++i)
      try
        {
          reject_sections_of_many_runs(line.files[i].string());
          for (const std::string &path :
               parameters.find(line.files[i].string(), "slipstep parameters"))
            only.push_back(path);
        }
      catch (const InputError &error)
        {
          throw InputError(error.what() +
                           where_else(line.files[i].string(), of_a_map));
        }
    if (line.format == "html")
      std::cout << parameters_page(parameters, only);
    else
      parameters.print(std::cout,
                       format_of(line.format),
                       {},
                       // What is asked for is not put behind "#".
                       of_a_map || !only.empty() ?
                         std::set<std::string>() :
                         inactive_sections(parameters),
                       only);
    return done;
  }
} // namespace SlipStep
