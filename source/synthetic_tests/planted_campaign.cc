// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/synthetic_tests/hidden_effects.h>
#include <slipstep/synthetic_tests/planted_campaign.h>
#include <slipstep/synthetic_tests/protocols.h>
#include <slipstep/synthetic_tests/start_model.h>

#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/text.h>
#include <slipstep/utilities/write_file.h>

#include <boost/algorithm/string/join.hpp>
#include <boost/algorithm/string/split.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace SlipStep
{
  namespace Planting
  {
    namespace
    {
      // In the order of CampaignClass.
      const std::vector<std::string> class_names = {"none",
                                                    "one",
                                                    "two",
                                                    "other_formula",
                                                    "outside",
                                                    "ablated",
                                                    "narrow",
                                                    "third_formula",
                                                    "joint"};

      /// What random numbers are for.
      enum class Stream : std::uint32_t
      {
        truth = 1,
        tests,
        noise,
        start_model
      };

      Random random_numbers(const CampaignOptions &options, const Stream stream)
      {
        std::seed_seq sequence{static_cast<std::uint32_t>(options.seed),
                               static_cast<std::uint32_t>(options.seed >> 32),
                               static_cast<std::uint32_t>(
                                 options.campaign_class),
                               static_cast<std::uint32_t>(stream)};
        return Random(sequence);
      }
    } // namespace



    std::string to_string(const CampaignClass campaign_class)
    {
      return class_names[static_cast<std::size_t>(campaign_class)];
    }



    std::vector<std::string> campaign_classes()
    {
      return class_names;
    }



    CampaignClass campaign_class(const std::string &wanted)
    {
      return static_cast<CampaignClass>(
        place_among(class_names, "class", wanted));
    }



    Formula formula_of(const CampaignClass campaign_class)
    {
      switch (campaign_class)
        {
          case CampaignClass::other_formula:
            return Formula::alternative;
          case CampaignClass::third_formula:
            return Formula::third;
          case CampaignClass::joint:
            return Formula::joint;
          case CampaignClass::outside:
            return Formula::outside;
          default:
            return Formula::catalogue;
        }
    }



    std::vector<std::string> drawn_effects(const CampaignClass campaign_class,
                                           const unsigned int  edition)
    {
      if (campaign_class == CampaignClass::none)
        return {};
      if (campaign_class == CampaignClass::ablated)
        return {"overstress", "softening"};
      // What could be seen in such tests.
      if (campaign_class == CampaignClass::narrow)
        return {"pressure", "shear_cap", "adhesion", "run_in", "viscous"};
      std::vector<std::string> names;
      for (const auto &kind : hidden_effects(formula_of(campaign_class)))
        if (kind.edition <= edition)
          names.push_back(kind.name);
      return names;
    }



    unsigned int newest_edition()
    {
      unsigned int newest = 1;
      for (const Formula formula : {Formula::catalogue,
                                    Formula::alternative,
                                    Formula::outside,
                                    Formula::third,
                                    Formula::joint})
        for (const auto &kind : hidden_effects(formula))
          newest = std::max(newest, kind.edition);
      return newest;
    }



    namespace
    {
      unsigned int n_hidden(const CampaignClass campaign_class)
      {
        return campaign_class == CampaignClass::none ? 0 :
               campaign_class == CampaignClass::two  ? 2 :
                                                       1;
      }



      void check_wish(const CampaignOptions &options)
      {
        const std::string name = to_string(options.campaign_class);
        // A wish may be for the newest.
        const auto possible =
          drawn_effects(options.campaign_class, newest_edition());
        if (options.edition < 1 || options.edition > newest_edition())
          throw InputError("edition " + std::to_string(options.edition) +
                           ": there are editions 1 to " +
                           std::to_string(newest_edition()));
        if (options.amplitude > 0. &&
            (options.campaign_class == CampaignClass::none ||
             options.campaign_class == CampaignClass::ablated))
          throw InputError("class " + name +
                           " adds no effect that could have an amplitude");
        if (!options.effects.empty() &&
            options.effects.size() != n_hidden(options.campaign_class))
          throw InputError(
            "class " + name + " hides " +
            std::to_string(n_hidden(options.campaign_class)) +
            (n_hidden(options.campaign_class) == 1 ? " effect, not " :
                                                     " effects, not ") +
            std::to_string(options.effects.size()) +
            (options.campaign_class == CampaignClass::joint ?
               ": one of " + boost::algorithm::join(possible, ", ") :
               ""));
        for (const std::string &effect : options.effects)
          {
            hidden_effect(effect, formula_of(options.campaign_class));
            if (std::count(options.effects.begin(),
                           options.effects.end(),
                           effect) > 1)
              throw InputError("effect \"" + effect + "\" is named twice");
            if (!holds(possible, effect))
              throw InputError("class " + name + " hides one of: " +
                               boost::algorithm::join(possible, ", ") +
                               "; not \"" + effect + "\"");
          }
      }



      // Those that make the base come first: others depend on it.
      std::vector<std::string> choose_effects(const CampaignOptions &options,
                                              Random                &random)
      {
        std::vector<std::string> names =
          drawn_effects(options.campaign_class, options.edition);
        // Drawn in any case, so that the numbers after it are the same.
        std::shuffle(names.begin(), names.end(), random);
        names.resize(n_hidden(options.campaign_class));
        if (!options.effects.empty())
          names = options.effects;
        std::stable_partition(names.begin(),
                              names.end(),
                              [](const std::string &name) {
                                return name == "overstress" ||
                                       name == "softening";
                              });
        return names;
      }



      // That of an effect that can be no larger is the least with its truth.
      double reached(const HiddenEffectKind &kind,
                     const TrueContact      &contact,
                     const double            wished,
                     const Random           &random)
      {
        const auto truth = [&](const double amplitude) {
          TrueContact         changed = contact;
          Random              same    = random;
          std::vector<double> values;
          for (const TruthParameter &parameter :
               kind.add(changed, amplitude, same))
            values.push_back(parameter.value);
          return values;
        };
        const std::vector<double> values = truth(wished);
        if (truth(0.999 * wished) != values || truth(0.) == values)
          return wished;
        double less = 0., enough = wished;
        for (unsigned int n = 0; n < 50; ++n)
          {
            const double middle                       = (less + enough) / 2.;
            (truth(middle) == values ? enough : less) = middle;
          }
        return enough;
      }



      // Without a name, which may be what is to be found.
      void check_reach(const double wished, const double reached)
      {
        if (wished <= reached)
          return;
        const double digits =
          std::pow(10., 2. - std::floor(std::log10(reached)));
        throw InputError(
          "amplitude " + rounded_text(wished, 6) +
          ": what this campaign hides reaches at most " +
          rounded_text(std::floor(digits * reached) / digits, 3));
      }



      PlantedEffect hide(const std::string     &name,
                         const CampaignOptions &options,
                         TrueContact           &contact,
                         Random                &random)
      {
        const HiddenEffectKind &kind =
          hidden_effect(name, formula_of(options.campaign_class));
        // Narrow tests reach little of it.
        const bool is_narrow = options.campaign_class == CampaignClass::narrow;
        const double  drawn  = log_uniform(random,
                                         is_narrow ? 0.04 : least_amplitude,
                                         is_narrow ? 0.3 : largest_amplitude);
        PlantedEffect effect{name,
                             formula_of(options.campaign_class),
                             kind.formula,
                             options.amplitude > 0. ? options.amplitude : drawn,
                             {}};
        if (options.campaign_class != CampaignClass::ablated)
          {
            const double wished = effect.amplitude;
            effect.amplitude    = reached(kind, contact, wished, random);
            check_reach(options.amplitude, effect.amplitude);
            effect.parameters = kind.add(contact, wished, random);
            return effect;
          }
        // The base has it already.
        const CoefficientRule &rule = contact.coefficient;
        effect.amplitude =
          name == "softening" ?
            rule.static_coefficient / rule.kinetic_coefficient - 1. :
            contact.flow.steady_ratio(Reach::largest_speed) /
                contact.flow.steady_ratio(Reach::least_speed) -
              1.;
        for (const TruthParameter &parameter : base_parameters(contact))
          if (parameter.name.find("/" + name + "/") != std::string::npos)
            effect.parameters.push_back(parameter);
        return effect;
      }



      // "overstress+ageing" are two, each with its own parameters.
      std::vector<PlantedEffect> one_by_one(const PlantedEffect &both)
      {
        std::vector<std::string> names;
        boost::algorithm::split(names, both.name, [](const char c) {
          return c == '+';
        });
        if (names.size() < 2)
          return {both};
        std::vector<PlantedEffect> result;
        for (const std::string &name : names)
          {
            PlantedEffect one = both;
            one.name          = name;
            one.parameters.clear();
            for (const TruthParameter &parameter : both.parameters)
              if (parameter.name.find("/" + name + "/") != std::string::npos)
                one.parameters.push_back(parameter);
            result.push_back(one);
          }
        return result;
      }



      void plant_truth(PlantedCampaign &campaign)
      {
        Random random    = random_numbers(campaign.options, Stream::truth);
        campaign.contact = draw_base(random);
        std::vector<std::string> names;
        for (const std::string &name : choose_effects(campaign.options, random))
          for (const PlantedEffect &effect : one_by_one(
                 hide(name, campaign.options, campaign.contact, random)))
            {
              campaign.hidden.push_back(effect);
              names.push_back(effect.name);
            }
        campaign.base_parameters = base_parameters(campaign.contact);
        campaign.base_effects    = {"subloading", "overstress", "softening"};
        for (const std::string &name : names)
          if (campaign.hidden.front().formula != Formula::outside &&
              name != "overstress" && name != "softening" &&
              name != "compliance")
            campaign.base_effects.push_back(name);
        Random errors = random_numbers(campaign.options, Stream::start_model);
        campaign.start_model = start_model(campaign.contact, names, errors);
      }



      /// The protocol of every test, in the order in which they are run.
      std::vector<std::size_t> draw_run_order(const unsigned int n_protocols,
                                              const unsigned int n_tests,
                                              Random            &random)
      {
        std::vector<std::size_t> all(n_protocols);
        std::iota(all.begin(), all.end(), 0);
        std::vector<std::size_t> repeated = all;
        std::shuffle(repeated.begin(), repeated.end(), random);
        all.insert(all.end(),
                   repeated.begin(),
                   repeated.begin() + (n_tests - n_protocols));
        std::shuffle(all.begin(), all.end(), random);
        return all;
      }



      std::string two_digits(const std::size_t number)
      {
        return (number < 10 ? "0" : "") + std::to_string(number);
      }



      double mean_friction(const TrueFriction &friction)
      {
        double sum = 0.;
        for (std::size_t i = 0; i < friction.along_x.size(); ++i)
          sum += std::hypot(friction.along_x[i], friction.along_y[i]);
        return sum / friction.along_x.size();
      }



      void record(const NoiseLevels &levels,
                  const double       static_coefficient,
                  Random            &random,
                  PlantedTest       &test)
      {
        test.noise = draw_record_noise(levels, static_coefficient, random);
        const double  mean     = mean_friction(test.truth);
        MeasuredTest &measured = test.measured;
        measured.friction      = noisy_record(measured.time,
                                         test.truth.along_x,
                                         mean,
                                         test.noise.gain,
                                         test.noise.offset_x,
                                         levels,
                                         random);
        if (!measured.friction_y.empty())
          measured.friction_y = noisy_record(measured.time,
                                             test.truth.along_y,
                                             mean,
                                             test.noise.gain,
                                             test.noise.offset_y,
                                             levels,
                                             random);
      }



      void run_tests(PlantedCampaign &campaign)
      {
        const CampaignOptions &options = campaign.options;
        Random                 random  = random_numbers(options, Stream::tests);
        const unsigned int     n_protocols =
          options.n_tests -
          (options.with_replicates ? std::lround(0.3 * options.n_tests) : 0);
        const std::vector<Protocol> protocols =
          options.campaign_class == CampaignClass::narrow ?
            draw_narrow_protocols(n_protocols, random) :
            draw_protocols(n_protocols, options.edition, random);
        const std::vector<std::size_t> order =
          draw_run_order(n_protocols, options.n_tests, random);

        Random noise = random_numbers(options, Stream::noise);
        campaign.noise =
          draw_levels(options.noise, options.noise_factor, noise);
        for (std::size_t i = 0; i < order.size(); ++i)
          {
            const Protocol &protocol = protocols[order[i]];
            PlantedTest     test;
            test.measured      = motion_of(protocol);
            test.measured.name = "test " + two_digits(i + 1);
            test.measured.file = "test_" + two_digits(i + 1) + ".csv";
            test.measured.condition =
              two_digits(order[i] + 1) + ' ' + protocol.name;
            test.measured.notes["order"] = std::to_string(i + 1);
            campaign.contact.progress =
              order.size() > 1 ? static_cast<double>(i) / (order.size() - 1) :
                                 0.;
            test.truth = simulate(campaign.contact, test.measured);
            record(campaign.noise,
                   campaign.contact.coefficient.static_coefficient,
                   noise,
                   test);
            record_loading(campaign.noise, noise, test.measured);
            campaign.tests.push_back(std::move(test));
          }
        campaign.contact.progress = 0.;
      }
    } // namespace



    PlantedCampaign plant_campaign(const CampaignOptions &options)
    {
      check_wish(options);
      if (options.n_tests < 2 || options.n_tests > n_protocols)
        throw InputError("a campaign has 2 to " + std::to_string(n_protocols) +
                         " tests, not " + std::to_string(options.n_tests));
      PlantedCampaign campaign;
      campaign.options = options;
      plant_truth(campaign);
      try
        {
          run_tests(campaign);
        }
      catch (const RunError &error)
        {
          if (options.amplitude == 0.)
            throw;
          throw InputError("amplitude " + rounded_text(options.amplitude, 6) +
                           ": take a larger one (" + error.what() + ")");
        }
      return campaign;
    }



    void check_is_free(const std::filesystem::path &folder)
    {
      namespace fs = std::filesystem;
      if (fs::exists(folder) &&
          (!fs::is_directory(folder) || !fs::is_empty(folder)))
        throw InputError(folder.string() +
                         ": exists already; name a new or an empty folder");
    }



    void write_campaign(const std::filesystem::path &folder,
                        const PlantedCampaign       &campaign)
    {
      namespace fs                    = std::filesystem;
      constexpr unsigned int n_digits = 7;

      check_is_free(folder);
      std::error_code error;
      fs::create_directories(folder / "measured", error);
      if (error)
        throw InputError(folder.string() + ": this folder cannot be created");
      for (const PlantedTest &test : campaign.tests)
        write_measured_test(folder / "measured" / test.measured.file,
                            test.measured,
                            n_digits);
      write_file(folder / "case.prm", campaign.start_model);
    }
  } // namespace Planting
} // namespace SlipStep
