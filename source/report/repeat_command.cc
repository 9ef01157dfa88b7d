// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/report/repeat_command.h>
#include <slipstep/utilities/lists.h>

#include <algorithm>
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
  } // namespace



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



  std::string given_settings(const Parameters &parameters)
  {
    std::string text;
    for (const std::string &path : parameters.paths())
      if (parameters.is_set(path) &&
          parameters.origin(path).compare(0, 5, "--set") == 0)
        text += " --set \"" + path + "=" + parameters.text(path) + "\"";
    // Every value once, in the order of the variants.
    std::vector<std::pair<std::string, std::vector<std::string>>> sweeps;
    for (const Variant &variant : parameters.variants())
      for (const Variant::Override &setting : variant.overrides)
        if (setting.origin == "--sweep")
          {
            auto sweep = std::find_if(sweeps.begin(),
                                      sweeps.end(),
                                      [&](const auto &known) {
                                        return known.first == setting.path;
                                      });
            if (sweep == sweeps.end())
              sweep = sweeps.insert(sweep, {setting.path, {}});
            auto &values = sweep->second;
            if (!holds(values, setting.value))
              values.push_back(setting.value);
          }
    for (const auto &[path, values] : sweeps)
      {
        text += " --sweep \"" + path;
        for (std::size_t i = 0; i < values.size(); ++i)
          text += (i == 0 ? "=" : "|") + values[i];
        text += "\"";
      }
    return text;
  }
} // namespace SlipStep
