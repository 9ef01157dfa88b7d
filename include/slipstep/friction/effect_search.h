// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_friction_effect_search_h
#define slipstep_friction_effect_search_h

#include <slipstep/utilities/parameters.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace SlipStep
{
  /// Numbers of a case by their paths, in base units.
  using Values = std::map<std::string, double>;

  /// The ranges that a campaign of tests covers.
  struct TestedRange
  {
    double slowest          = 0.; ///< [mm/s]
    double fastest          = 0.;
    double lowest           = 0.; ///< pressure of what slides [MPa]
    double highest          = 0.;
    double largest_pressure = 0.; ///< at any time [MPa]
    double longest_path     = 0.; ///< [mm]
    double longest_rest     = 0.; ///< [s]
    double longest_test     = 0.; ///< [s]
    double typical_friction = 0.;
    double widest_angle     = 0.;    ///< between lines of motion, to pi/2 [rad]
    bool   has_two_axes     = false; ///< friction across the motion is measured
    /// Along which tests move mostly, and how they do if most go one way, the
    /// first axis if it is one such: whole degrees [rad].
    double main_line = 0.;
    /// Length of the wave along the track that the model leaves, beyond chance
    /// [mm]; 0 if there is none.
    double track_wave = 0.;
    /// How many different numbers of order tests have, 0 unless all have one,
    /// and the first and the last.
    unsigned int n_orders    = 0;
    double       first_order = 0., last_order = 0.;
  };

  /// Where an effect is looked for: the model so far, and the tests.
  struct Circumstances
  {
    const Parameters  &parameters; ///< with fitted values
    const TestedRange &range;

    /// Whether the model has an effect.
    bool has(const std::string &effect) const;

    double number(const std::string &path) const
    {
      return parameters.number(path);
    }

    /// Typical friction, which is no coefficient of the law.
    double friction() const
    {
      return range.typical_friction;
    }
  };

  /// A number of the case that is to be fitted with an effect. Base units. An
  /// effect may leave its own section out of paths, here and in a TrialFormula.
  struct CandidateParameter
  {
    std::string path;
    double      lower          = 0.;
    double      upper          = 1.;
    bool        is_logarithmic = false;
    /// A fit that ends at a bound is no explanation, unless that bound is a
    /// limit which makes sense: nothing cools, the speeds are all fast.
    bool lower_makes_sense = false;
    bool upper_makes_sense = false;
  };

  /// An effect by one formula, to be tried on measured tests.
  struct TrialFormula
  {
    /// A way in which the effect may act, its strength apart: the values of all
    /// parameters when it is @p strength times as strong as one that is only
    /// just noticed.
    using Shape = std::function<Values(const double strength)>;

    /// What is added to Friction/Effects; "" for what is there already.
    std::string                        effect;
    std::vector<CandidateParameter>    parameters;
    Values                             settings; ///< numbers that stay
    std::map<std::string, std::string> texts;    ///< that stay
    std::vector<Shape>                 shapes;
    bool                               is_one_sided = false;
    /// As EffectSearch::along, of the effect.
    std::string along;
    /// How many parameters were fitted that stand in the texts.
    unsigned int n_in_texts = 0;
    /// As how many more it counts, since it assumes what no record says.
    unsigned int n_assumed = 0;
    /// Why it cannot be tried; "" if it can.
    std::string why_not;

    static TrialFormula none(const std::string &why_not);

    using Form = std::function<TrialFormula(const Circumstances &)>;

    /// The same as @p formula with the effect's Form as given.
    static Form in_form(const std::string &name, const Form &formula);

    /// Strength that grows with the logarithm of an age, which in steady
    /// sliding is a length over the speed: theta = L / V.
    /// @param length key of L, beside Growth and Time
    /// @param first key of the age with which it begins, of what was before the
    ///   tests; "" for contacts that begin young
    static Form state_of_contacts(const std::string &length,
                                  const std::string &first = "");

    /// Add a shape: one parameter is in proportion to the strength, within
    /// bounds, others stay.
    /// @param felt change of friction by 1 of it
    void add_shape(const std::string &path,
                   const double       lower,
                   const double       upper,
                   const Values      &others,
                   const double       felt = 1.);

    /// Let one parameter be in proportion to the strength, @p unit of it
    /// changing friction by its own size.
    void set_proportional(const std::string &path,
                          const double       unit,
                          const double       lower,
                          const double       upper);
  };

  /// How an effect is looked for in measured tests.
  struct EffectSearch
  {
    using Form = TrialFormula::Form;

    /// How it shows, beside other effects.
    std::string signature;

    Form formula = {};

    /// The effect of which this one is but another formula, "" if none.
    std::string candidate = "";

    /// The key with which it does nothing where that is 0, although it is in
    /// the list; "" if it does something whenever it is there.
    std::string amplitude = "";

    /// Why it is never looked for: then there is no formula.
    std::string why_not = "";

    /// The same for other forms of the effect that are looked for, too.
    std::vector<Form> other_forms = {};

    /// What its formula is a function of, as effect expression calls it; "" if
    /// of nothing that it knows. Along it, a formula may be not quite right.
    std::string along = "";

    /// The effect beside which it is a candidate of its own, as contacts that
    /// age are beside a direct effect of speed: each may hide the other, so
    /// that both are tried at once. "" if there is none.
    std::string beside = "";

    /// How it shows, and how it is looked for, where the model has that effect.
    std::string       beside_signature = "";
    std::vector<Form> beside_formulas  = {};

    /// With contacts that remember what was before the tests, of which the last
    /// parameter tells: where the model has the effect without that, it is a
    /// candidate of its own.
    Form first_state = {};

    /// The effect that holds what this one would let jump, as a direct effect
    /// of speed holds friction that falls with it. Where sliding is not stable
    /// with this effect alone, it is tried beside that. "" if there is none.
    std::string held_by = "";

    /// Let all formulas have whole paths: those without a "/" are keys of this
    /// section.
    void complete_paths(const std::string &section);
  };

  /// A change of friction by one per cent, the size of all trial strengths.
  constexpr double just_noticed = 0.01;

  /// Values from a to b, each the same factor from the next.
  std::vector<double>
  ladder(const double a, const double b, const unsigned int n);
} // namespace SlipStep

#endif
