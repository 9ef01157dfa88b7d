// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/law.h>

#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/pattern_words.h>

#include <algorithm>
#include <iomanip>

namespace SlipStep
{
  namespace
  {
    const char *slot_name(const ExclusiveSlot slot)
    {
      return slot == ExclusiveSlot::overstress   ? "overstress" :
             slot == ExclusiveSlot::anisotropy   ? "anisotropy" :
             slot == ExclusiveSlot::elastic_core ? "elastic core" :
                                                   "normal ratio";
    }

    // Names in the list, checked, in the order of the catalogue, so that the
    // order of the list cannot change a result.
    std::vector<std::string> active_effects(const Parameters &parameters)
    {
      std::vector<std::string> known, names;
      for (const auto &entry : effect_registry())
        known.push_back(entry.first);

      for (const std::string &name : parameters.list("Friction/Effects"))
        {
          if (effect_registry().count(name) == 0)
            {
              const std::string near = nearest_name(name, known);
              parameters.reject(
                "Friction/Effects",
                "there is no effect '" + name + "'" +
                  (name.find_first_of("; ") != std::string::npos ?
                     "; effects are separated by commas" :
                   near.empty() ? "; 'slipstep effects' lists them" :
                                  "; did you mean '" + near + "'?"));
            }
          if (std::find(names.begin(), names.end(), name) != names.end())
            parameters.reject("Friction/Effects",
                              "effect '" + name + "' is listed twice");
          names.push_back(name);
        }
      std::sort(names.begin(), names.end());

      std::map<ExclusiveSlot, std::string> owner;
      for (const std::string &name : names)
        {
          const ExclusiveSlot slot = effect_registry().at(name).slot;
          if (slot != ExclusiveSlot::none &&
              owner.emplace(slot, name).second == false)
            parameters.reject("Friction/Effects",
                              "effects '" + owner[slot] + "' and '" + name +
                                "' both define the " + slot_name(slot) +
                                ": keep one");
        }
      if (owner.count(ExclusiveSlot::elastic_core) == 1 &&
          owner.count(ExclusiveSlot::normal_ratio) == 0)
        parameters.reject("Friction/Effects",
                          "effect '" + owner[ExclusiveSlot::elastic_core] +
                            "' moves the centre from which 'subloading' "
                            "measures: add 'subloading'");
      return names;
    }

    // A value given to an effect that is off would silently do nothing. It is
    // fine if the list of effects was changed after it, by a variant or --set.
    void
    reject_values_of_inactive_effects(const Parameters &parameters,
                                      const std::vector<std::string> &active)
    {
      for (const auto &entry : effect_registry())
        if (std::find(active.begin(), active.end(), entry.first) ==
            active.end())
          for (const std::string &path :
               parameters.paths("Friction/" + entry.first + "/"))
            if (parameters.is_set(path) &&
                parameters.layer(path) >= parameters.layer("Friction/Effects"))
              parameters.reject(path,
                                "effect '" + entry.first +
                                  "' is off: add it to Friction/Effects or "
                                  "remove this line");
    }
  } // namespace



  void FrictionLaw::declare_parameters(Parameters &parameters)
  {
    std::vector<std::string> effects;
    for (const auto &entry : effect_registry())
      effects.push_back(entry.first);
    parameters.declare(
      "Friction/Effects",
      "subloading, overstress, softening",
      dealii::Patterns::List(AnythingWithWords(effects)),
      "The effects that make the friction law, separated by commas; their "
      "order does not matter. 'slipstep effects' lists all with their "
      "formulas. An empty list is Coulomb's law with elastic stick.");
    parameters.declare(
      "Friction/Static coefficient",
      "0.115",
      Quantity(Dimension::number, 0., 100., true),
      "Static coefficient of friction mu_s, at the 'Speed of the "
      "coefficients'; the only coefficient when no effect changes it. More "
      "than 0, no unit.");
    parameters.declare(
      "Friction/Initial coefficient",
      "static",
      AnythingWithWords({"static"}),
      "Coefficient of friction at the beginning: 'static', or a number at the "
      "'Speed of the coefficients', more than 0, no unit.");
    parameters.declare(
      "Friction/Speed of the coefficients",
      "0 mm/min",
      Quantity(Dimension::speed, 0., 1e30, false, true),
      "Speed at which the coefficients were measured. The law needs the "
      "quasi-static ones and divides by the dynamic-loading ratio r that the "
      "overstress gives at this speed; 0 means that the coefficients are "
      "quasi-static. 0 or more, with its unit.");
    parameters.declare(
      "Friction/Normal stiffness",
      "1e5",
      Quantity(Dimension::stiffness, 0., 1e30, true),
      "Normal contact stiffness alpha_n: pressure per penetration. More than "
      "0, in MPa/mm.");
    parameters.declare(
      "Friction/Tangential stiffness",
      "1e4",
      Quantity(Dimension::stiffness, 0., 1e30, true),
      "Tangential contact stiffness alpha_t: traction per elastic slip. More "
      "than 0, in MPa/mm.");
    for (const auto &entry : effect_registry())
      entry.second.declare(parameters);
  }



  // The flow rule, or all others.
  void FrictionLaw::create_effects(const Parameters &parameters,
                                   const bool        flow_rule)
  {
    for (std::size_t i = 0; i < names.size(); ++i)
      {
        const EffectInfo &info = effect_registry().at(names[i]);
        if ((info.slot == ExclusiveSlot::overstress) != flow_rule)
          continue;
        active[i]             = info.create(info.section_of(parameters), basis);
        const Effect *created = active[i].get();
        if (info.slot == ExclusiveSlot::overstress)
          flow = created;
        if (info.slot == ExclusiveSlot::normal_ratio)
          normal_ratio = created;
        if (info.slot == ExclusiveSlot::elastic_core)
          core = created;
        if (info.slot == ExclusiveSlot::anisotropy)
          {
            cone           = created->cone();
            inverse_cone   = invert(cone);
            is_anisotropic = cone != neutral.cone();
          }
        if (created->remembers_rate())
          rate_memory = created;
        if (const auto *effect =
              dynamic_cast<const CoefficientEffect *>(created))
          coefficient_effects.push_back(effect);
        if (const auto *effect = dynamic_cast<const StrengthEffect *>(created))
          {
            strength_effects.push_back(effect);
            depends_on_rate = depends_on_rate || effect->depends_on_rate();
          }
      }
  }



  FrictionLaw::FrictionLaw(const Parameters &parameters)
    : alpha_n(parameters.number("Friction/Normal stiffness"))
    , alpha_t(parameters.number("Friction/Tangential stiffness"))
    , names(active_effects(parameters))
    , cone(neutral.cone())
    , inverse_cone(neutral.cone())
  {
    reject_values_of_inactive_effects(parameters, names);

    active.resize(names.size());
    // The flow rule comes first: it tells r at the speed at which the
    // coefficients were read.
    create_effects(parameters, true);
    basis.scale = 1. / flow->steady_ratio(parameters.number(
                         "Friction/Speed of the coefficients"));
    basis.static_coefficient =
      parameters.number("Friction/Static coefficient") * basis.scale;
    create_effects(parameters, false);

    initial_coefficient       = basis.static_coefficient;
    const std::string initial = parameters.text("Friction/Initial coefficient");
    if (initial != "static")
      {
        const Quantity coefficient(Dimension::number, 0., 100., true);
        if (!coefficient.match(initial))
          parameters.reject("Friction/Initial coefficient",
                            "must be 'static' or a number greater than 0");
        initial_coefficient = coefficient.value(initial) * basis.scale;
      }
    range_of_coefficient = find_coefficient_range();
    if (rate_memory != &neutral && flow == &neutral)
      parameters.reject("Friction/memory_length/Form",
                        "'flow' delays the flow rule: add 'overstress' or "
                        "'perzyna' to Friction/Effects");
    if (rate_memory != &neutral && core != &neutral)
      parameters.reject("Friction/memory_length/Form",
                        "'flow' and the effect 'elastic_core' do not go "
                        "together: take the form 'factor', or leave "
                        "'elastic_core' out");
  }



  double FrictionLaw::wear_rate() const
  {
    double sum = 0.;
    for (const StrengthEffect *effect : strength_effects)
      sum += effect->wear_rate();
    return sum;
  }



  std::vector<ContactMemory> FrictionLaw::memories() const
  {
    std::vector<ContactMemory> used;
    for (const ContactMemory &memory : contact_memories())
      if (std::any_of(active.begin(),
                      active.end(),
                      [&memory](const auto &effect) {
                        const auto &written = effect->memories();
                        return std::any_of(written.begin(),
                                           written.end(),
                                           [&](const ContactMemory &other) {
                                             return other.slot == memory.slot;
                                           });
                      }))
        used.push_back(memory);
    return used;
  }



  void FrictionLaw::carry(const dealii::Tensor<1, 2> &way,
                          ContactState               &state) const
  {
    for (const ContactMemory &memory : memories())
      if (memory.axis < 2)
        state[memory] += way[memory.axis];
  }



  std::set<std::string> FrictionLaw::inactive_sections() const
  {
    std::set<std::string> sections;
    for (const auto &entry : effect_registry())
      if (std::find(names.begin(), names.end(), entry.first) == names.end())
        sections.insert("Friction/" + entry.first);
    return sections;
  }
} // namespace SlipStep
