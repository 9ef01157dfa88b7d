// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/synthetic_tests/answer.h>
#include <slipstep/commands/commands.h>
#include <slipstep/synthetic_tests/planted_campaign.h>

#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/text.h>
#include <slipstep/utilities/write_file.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>

namespace SlipStep
{
  namespace
  {
    /// The value of an option, or "" if it was not given.
    std::string value_of(const CommandLine &line, const std::string &option)
    {
      const auto found = line.plant_options.find(option);
      return found == line.plant_options.end() ? "" : found->second;
    }



    std::uint64_t whole_number(const CommandLine  &line,
                               const std::string  &option,
                               const std::uint64_t if_missing)
    {
      const std::string text = value_of(line, option);
      if (text.empty())
        return if_missing;
      if (text.find_first_not_of("0123456789") != std::string::npos ||
          text.size() > 18)
        throw InputError("--" + option + " " + text +
                         ": must be a whole number, 0 or more, of at "
                         "most 18 digits");
      return std::stoull(text);
    }



    double number(const CommandLine &line,
                  const std::string &option,
                  const double       if_missing,
                  const double       most,
                  const bool         may_be_zero)
    {
      const std::string text = value_of(line, option);
      if (text.empty())
        return if_missing;
      std::size_t end   = 0;
      double      value = -1.;
      try
        {
          value = std::stod(text, &end);
        }
      catch (const std::logic_error &)
        {}
      if (end != text.size() || !std::isfinite(value) || value < 0. ||
          value > most || (value == 0. && !may_be_zero))
        throw InputError("--" + option + " " + text + ": must be a number, " +
                         (may_be_zero ? "0 or more" : "more than 0") +
                         ", at most " + rounded_text(most, 3));
      return value;
    }



    Planting::CampaignOptions options_of(const CommandLine &line)
    {
      Planting::CampaignOptions options;
      const std::string         class_name = value_of(line, "class");
      if (!class_name.empty())
        options.campaign_class = Planting::campaign_class(class_name);
      const std::string noise = value_of(line, "noise");
      if (!noise.empty())
        options.noise = Planting::noise_kind(noise);
      options.effects =
        dealii::Utilities::split_string_list(value_of(line, "effect"), ',');
      options.seed = whole_number(line, "seed", options.seed);
      options.n_tests =
        std::min<std::uint64_t>(whole_number(line, "tests", options.n_tests),
                                std::numeric_limits<unsigned int>::max());
      options.edition =
        std::min<std::uint64_t>(whole_number(line, "edition", options.edition),
                                1000);
      options.noise_factor    = number(line, "noise-factor", 1., 30., true);
      options.amplitude       = number(line, "amplitude", 0., 0.5, false);
      options.with_replicates = line.plant_options.count("no-replicates") == 0;
      return options;
    }



    std::string list_of(const Planting::CampaignClass campaign_class)
    {
      std::string list;
      for (const std::string &effect :
           Planting::drawn_effects(campaign_class, Planting::newest_edition()))
        {
          const Planting::HiddenEffectKind &kind =
            Planting::hidden_effect(effect,
                                    Planting::formula_of(campaign_class));
          list += "  " + effect + ": " + kind.formula +
                  (kind.edition > 1 ?
                     " (edition " + std::to_string(kind.edition) + ")" :
                     "") +
                  '\n';
        }
      return list.empty() ? "  nothing\n" : list;
    }



    // Class by class; those that draw from the same together.
    void list_hidden_effects(std::ostream &out)
    {
      std::vector<std::pair<std::string, std::string>> lists;
      for (const std::string &name : Planting::campaign_classes())
        {
          const std::string list = list_of(Planting::campaign_class(name));
          if (!lists.empty() && lists.back().second == list)
            lists.back().first += ", " + name;
          else
            lists.emplace_back(name, list);
        }
      for (const auto &[names, list] : lists)
        out << "class " << names << '\n' << list;
    }
  } // namespace



  int plant(const CommandLine &line)
  {
    if (line.plant_options.count("list") > 0)
      {
        if (!line.files.empty())
          throw InputError("slipstep plant --list takes no folder");
        list_hidden_effects(std::cout);
        return 0;
      }
    const std::string answer = value_of(line, "open");
    if (!answer.empty())
      {
        if (!line.files.empty())
          throw InputError("slipstep plant --open prints an answer; it takes "
                           "no folder");
        std::cout << Planting::open_sealed(answer);
        return 0;
      }
    if (line.files.empty())
      throw InputError("slipstep plant: the name of a folder is missing; "
                       "usage: slipstep plant FOLDER");

    const std::filesystem::path     folder  = line.files.front();
    const Planting::CampaignOptions options = options_of(line);
    Planting::check_is_free(folder);
    const Planting::PlantedCampaign campaign =
      Planting::plant_campaign(options);
    Planting::write_campaign(folder, campaign);
    write_file(folder / "answer.sealed",
               Planting::sealed(Planting::answer_json(campaign)));
    if (!line.quiet)
      std::cout << folder.string() << ": " << campaign.tests.size()
                << " tests in measured/, the model to start from is case.prm, "
                   "the answer is sealed in answer.sealed"
                << std::endl;
    return 0;
  }
} // namespace SlipStep
