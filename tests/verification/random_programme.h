// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tests_verification_random_programme_h
#define tests_verification_random_programme_h

#include "../experiment/point_run.h"


#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace SlipStep::Testing
{
  /// The same numbers everywhere, as those of the standard library's
  /// distributions are not.
  class Dice
  {
  public:
    explicit Dice(const std::uint64_t seed)
      : generator(seed)
    {}

    /// From 0 to below 1.
    double share()
    {
      return (generator() >> 11) * 0x1p-53;
    }

    double uniform(const double from, const double to)
    {
      return from + share() * (to - from);
    }

    double logarithmic(const double from, const double to)
    {
      return from * std::pow(to / from, share());
    }

    /// From 0 to below @p n.
    unsigned int below(const unsigned int n)
    {
      return static_cast<unsigned int>(share() * n);
    }

    bool happens(const double probability)
    {
      return share() < probability;
    }

  private:
    std::mt19937_64 generator;
  };



  /// A case on one contact point, of a law and a programme drawn at random.
  class RandomProgramme
  {
  public:
    explicit RandomProgramme(const std::uint64_t seed)
      : dice(seed)
    {
      draw_law();
      draw_machine();
      set("Loading/Programme", draw_programme());
    }

    const Settings &settings() const
    {
      return list;
    }

    /// The case as a file.
    std::string prm() const;

  private:
    void set(const std::string &key, const std::string &value)
    {
      list.emplace_back(key, value);
    }

    /// Three digits are enough, and read better.
    static std::string text(const double value)
    {
      char buffer[32];
      std::snprintf(buffer, sizeof(buffer), "%.3g", value);
      return buffer;
    }

    void number(const std::string &key, const double value)
    {
      set("Friction/" + key, text(value));
    }

    void               draw_law();
    void               draw_effect(const std::string &name);
    void               draw_evolution(const std::string &name);
    void               draw_strength(const std::string &name);
    void               draw_expression();
    void               draw_machine();
    std::string        draw_programme();
    std::string        draw_statement();
    const std::string &pick(const std::vector<std::string> &texts)
    {
      return texts[dice.below(texts.size())];
    }

    Dice     dice;
    Settings list;
    double   static_coefficient = 0.;
    double   largest_length     = 20.; ///< of a slide [mm]
    bool     has_heating        = false;
  };



  inline void RandomProgramme::draw_law()
  {
    static const std::vector<std::string> others = {"softening",
                                                    "healing",
                                                    "ageing",
                                                    "pressure",
                                                    "shear_cap",
                                                    "adhesion",
                                                    "stribeck",
                                                    "viscous",
                                                    "run_in",
                                                    "heating",
                                                    "direction",
                                                    "anisotropy",
                                                    "expression"};

    std::set<std::string> effects;
    const unsigned int    n_effects = 1 + dice.below(6);
    if (dice.happens(0.8))
      effects.insert("subloading");
    if (dice.happens(0.75))
      effects.insert(dice.happens(0.8) ? "overstress" : "perzyna");
    while (effects.size() < n_effects)
      effects.insert(pick(others));
    has_heating = effects.count("heating") > 0;

    std::string names;
    for (const std::string &effect : effects)
      names += (names.empty() ? "" : ", ") + effect;
    set("Friction/Effects", names);
    static_coefficient = dice.logarithmic(0.02, 1.5);
    number("Static coefficient", static_coefficient);
    number("Tangential stiffness", dice.logarithmic(1e2, 1e6));
    for (const std::string &effect : effects)
      draw_effect(effect);
  }



  inline void RandomProgramme::draw_effect(const std::string &name)
  {
    if (name == "subloading")
      {
        set("Friction/subloading/Form", dice.happens(0.7) ? "cot" : "log");
        number("subloading/Rate", dice.logarithmic(1., 1e5));
      }
    else if (name == "overstress")
      {
        number("overstress/Viscosity", dice.logarithmic(1., 1e7));
        number("overstress/Exponent", dice.logarithmic(2., 200.));
        number("overstress/Maximum ratio", 1. + dice.logarithmic(0.05, 4.));
      }
    else if (name == "perzyna")
      {
        number("perzyna/Viscosity", dice.logarithmic(1e-2, 1e4));
        number("perzyna/Exponent", dice.logarithmic(1., 20.));
      }
    else if (name == "expression")
      draw_expression();
    else
      {
        draw_evolution(name);
        draw_strength(name);
      }
  }



  inline void RandomProgramme::draw_evolution(const std::string &name)
  {
    if (name == "softening")
      {
        number("softening/Kinetic coefficient",
               static_coefficient * dice.uniform(0.3, 0.99));
        number("softening/Rate", dice.logarithmic(1e-3, 10.));
        number("softening/Steepness", dice.logarithmic(0.1, 30.));
      }
    else if (name == "healing")
      {
        number("healing/Rate", dice.logarithmic(1e-8, 1.));
        number("healing/Steepness", dice.logarithmic(0.1, 500.));
        if (dice.happens(0.5))
          number("Initial coefficient",
                 static_coefficient * dice.uniform(0.5, 1.1));
      }
    else if (name == "ageing")
      {
        number("ageing/Growth", dice.logarithmic(1e-3, 0.1));
        number("ageing/Time", dice.logarithmic(1e-3, 1e2));
        number("ageing/Renewal length", dice.logarithmic(1e-3, 1.));
      }
    else if (name == "run_in")
      {
        number("run_in/Change", dice.uniform(-0.5, 2.));
        number("run_in/Length", dice.logarithmic(1e-2, 1e2));
      }
    else if (name == "heating")
      {
        number("heating/Weakening", dice.logarithmic(1e-5, 1e-2));
        number("heating/Heating", dice.logarithmic(0.1, 1e3));
        number("heating/Cooling time", dice.logarithmic(1e-2, 1e3));
      }
  }



  inline void RandomProgramme::draw_strength(const std::string &name)
  {
    if (name == "pressure")
      {
        number("pressure/Exponent", dice.uniform(-0.5, 0.5));
        number("pressure/Reference pressure", dice.logarithmic(0.5, 50.));
      }
    else if (name == "shear_cap")
      number("shear_cap/Shear limit", dice.logarithmic(0.1, 100.));
    else if (name == "adhesion")
      number("adhesion/Strength", dice.logarithmic(1e-3, 1.));
    else if (name == "stribeck")
      {
        number("stribeck/Rise", dice.logarithmic(1e-3, 0.3));
        set("Friction/stribeck/Speed",
            text(dice.logarithmic(1e-3, 1e2)) + " mm/s");
        number("stribeck/Exponent", dice.uniform(1., 3.));
      }
    else if (name == "viscous")
      number("viscous/Drag", dice.logarithmic(1e-4, 1.));
    else if (name == "direction")
      {
        number("direction/Change", dice.uniform(-0.5, 1.));
        number("direction/Forward angle", dice.uniform(-180., 180.));
      }
    else if (name == "anisotropy")
      {
        number("anisotropy/Ratio", dice.logarithmic(0.2, 5.));
        number("anisotropy/Angle", dice.uniform(-90., 90.));
      }
  }



  inline void RandomProgramme::draw_expression()
  {
    struct Formula
    {
      std::string covariate, from, to, formula;
    };
    static const std::vector<Formula> formulas = {
      {"log10 speed", "-4", "3", "1 + 0.05 * tanh(x)"},
      {"pressure", "0", "100", "1 / (1 + x / 50)"},
      {"path", "0", "20", "1 - 0.3 * x / (x + 3)"},
      {"hold time", "0", "1000", "1 + 0.02 * log(1 + x)"},
      {"angle", "-180", "180", "1 + 0.1 * cos(x * pi / 90)"},
      {"temperature", "0", "200", "1 / (1 + 0.003 * x)"}};
    const Formula &formula =
      formulas[dice.below(formulas.size() - (has_heating ? 0 : 1))];
    set("Friction/expression/Covariate", formula.covariate);
    set("Friction/expression/From", formula.from);
    set("Friction/expression/To", formula.to);
    set("Friction/expression/Formula", formula.formula);
    if (formula.covariate == "hold time")
      number("expression/Renewal length", dice.logarithmic(1e-3, 1.));
  }



  inline void RandomProgramme::draw_machine()
  {
    if (dice.happens(0.2))
      {
        set("Loading/Machine stiffness",
            text(dice.logarithmic(2., 2e3)) + " MPa/mm");
        // A soft one takes many steps if it sticks and slips.
        largest_length = 2.;
      }
  }



  inline std::string RandomProgramme::draw_statement()
  {
    const double kind = dice.share();
    if (kind < 0.15)
      return "press " + text(dice.logarithmic(0.1, 100.)) + " MPa in " +
             text(dice.logarithmic(0.01, 100.)) + " s";
    if (kind < 0.3)
      return "hold " + text(dice.logarithmic(0.01, 1e4)) + " s";
    const std::string sign = dice.happens(0.35) ? "-" : "";
    std::string       statement =
      "slide " + sign + text(dice.logarithmic(1e-4, 1e2)) + " mm/s for " +
      text(dice.logarithmic(1e-3, largest_length)) + " mm";
    if (dice.happens(0.3))
      statement += " at " + text(dice.uniform(-180., 180.)) + " deg";
    return statement;
  }



  inline std::string RandomProgramme::draw_programme()
  {
    std::string programme =
      "press " + text(dice.logarithmic(0.1, 100.)) + " MPa in 1 s";
    const unsigned int n_statements = 1 + dice.below(6);
    for (unsigned int i = 0; i < n_statements; ++i)
      if (dice.happens(0.15))
        {
          const unsigned int n_times = 2 + dice.below(4);
          const std::string  first   = draw_statement();
          programme += "; repeat " + std::to_string(n_times) + " times { " +
                       first + "; " + draw_statement() + " }";
        }
      else
        programme += "; " + draw_statement();
    if (dice.happens(0.05))
      programme += "; press 0 MPa in 1 s; hold 1 s; press 1 MPa in 1 s";
    return programme;
  }



  inline std::string RandomProgramme::prm() const
  {
    // By section; an empty one is that of "Friction" itself.
    std::map<std::string, std::map<std::string, std::string>> sections;
    for (const auto &setting : list)
      {
        const std::size_t end   = setting.first.rfind('/');
        const std::size_t begin = setting.first.find('/');
        sections[setting.first.substr(0, begin)];
        std::string &line =
          sections[setting.first.substr(0, begin)]
                  [begin == end ?
                     "" :
                     setting.first.substr(begin + 1, end - begin - 1)];
        line += (begin == end ? "  set " : "    set ") +
                setting.first.substr(end + 1) + " = " + setting.second + "\n";
      }
    std::string text;
    for (const auto &section : sections)
      {
        text += "subsection " + section.first + "\n";
        for (const auto &part : section.second)
          text += part.first.empty() ? part.second :
                                       "  subsection " + part.first + "\n" +
                                         part.second + "  end\n";
        text += "end\n";
      }
    return text;
  }
} // namespace SlipStep::Testing

#endif
