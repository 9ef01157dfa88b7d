// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_friction_effect_h
#define slipstep_friction_effect_h

#include <deal.II/base/tensor.h>

#include <slipstep/friction/contact_state.h>
#include <slipstep/friction/effect_search.h>
#include <slipstep/utilities/parameters.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace SlipStep
{
  /// The step for which an effect is asked: where it starts and how it ends.
  struct SlipStepData
  {
    const ContactState &start;
    double              time_step;       ///< [s]
    double              normal_traction; ///< f_n at the end [MPa], 0: open
    double              slip;            ///< viscoplastic slip in the step [mm]
    /// Unit vector of the viscoplastic slip, zero if there is no traction. With
    /// an elastic core that of the slip without one: the strength depends on
    /// where the traction is, not on which side of the core.
    dealii::Tensor<1, 2> direction;
    double               coefficient; ///< mu at the end
    double               work;        ///< |f_t| * slip, all of it heat [MPa mm]
    /// Way that the contact slips over the plane [mm]; where anisotropy
    /// measures slip in a metric of its own, not the same as that.
    double path = slip;
    /// How far the contact gets over the plane [mm]: slip, with an elastic core
    /// where that lets it go, and the way while it is off the plane.
    dealii::Tensor<1, 2> way = path * direction;

    /// lambda, by backward Euler [mm/s].
    double slip_rate() const
    {
      return slip / time_step;
    }

    /// What a memory that begins with a parameter, see StrengthEffect::begin(),
    /// is at the end: @p closed in contact; what opens begins anew with 0, and
    /// what was open stays as it was.
    double remembered(const ContactMemory &memory, const double closed) const
    {
      return normal_traction > 0.       ? closed :
             start.normal_traction > 0. ? 0. :
                                          start[memory];
    }
  };

  /// A rate and its derivative with respect to the evolving variable.
  struct Rate
  {
    double value      = 0.;
    double derivative = 0.;
  };

  /// A contribution to the strength at the end of a step, and its partial
  /// derivatives with respect to what SlipStepData says of that end; those that
  /// an effect does not set are zero.
  struct Strength
  {
    double               value    = 0.;
    double               d_slip   = 0.;
    double               d_normal = 0.;
    dealii::Tensor<1, 2> d_direction;        ///< with slip, path and way kept
    double               d_rate        = 0.; ///< with the slip kept
    double               d_coefficient = 0.;
    double               d_work        = 0.;
    double               d_path        = 0.; ///< with the way kept
    dealii::Tensor<1, 2> d_way         = {};
  };

  /// r_s after some slip, with derivatives.
  struct NormalRatio
  {
    double value   = 1.;
    double d_slip  = 0.; ///< [1/mm]
    double d_start = 0.; ///< with respect to r_s at the beginning
  };

  /// Residual of the flow rule: zero when the slip rate is the one that the
  /// loading ratio drives, increasing with the slip rate, decreasing with r.
  struct FlowResidual
  {
    double value          = 0.;
    double d_ratio        = 0.; ///< d/dr
    double d_normal_ratio = 0.; ///< d/dr_s
    double d_rate         = 0.; ///< d/dlambda [s/mm]
  };

  /// The similarity centre of a contact point.
  struct ElasticCore
  {
    /// c, in shares of the strength and in the metric in which the law is
    /// isotropic.
    dealii::Tensor<1, 2> centre;
    double               energy = 0.; ///< that it holds [MPa mm]
  };

  /// What slip makes of the similarity centre: c = kept c_0 + gained n, with
  /// the unit vector n of the slip.
  struct CoreEvolution
  {
    double kept     = 1.;
    double gained   = 0.;
    double d_kept   = 0.; ///< d/d slip [1/mm]
    double d_gained = 0.; ///< d/d slip [1/mm]
  };

  /// Parts of the law that only one effect can provide.
  enum class ExclusiveSlot
  {
    none,
    normal_ratio,
    overstress,
    anisotropy,
    elastic_core
  };

  /// What the coefficients in a case file mean to the law.
  struct CoefficientBasis
  {
    /// mu_s, converted to the quasi-static coefficient of the law.
    double static_coefficient = 0.;
    /// Factor from a coefficient as written to the quasi-static one:
    /// 1 / r at the speed at which the coefficients were read.
    double scale = 1.;
  };

  /// An effect of the friction law: a set of hooks, each neutral by default.
  ///
  /// One that lets the coefficient evolve is a CoefficientEffect, one that
  /// changes the yield level a StrengthEffect.
  ///
  /// An effect lives in one file of friction/effects, which implements the
  /// hooks that it needs, tells all that is known of it (EffectInfo), and ends
  /// with one line of registration. Hooks are pure functions, so one object
  /// serves all contact points.
  class Effect
  {
  public:
    /// @param memories that the effect writes, so that they are shown
    explicit Effect(const std::vector<ContactMemory> &memories = {})
      : memories_written(memories)
    {}

    virtual ~Effect() = default;

    const std::vector<ContactMemory> &memories() const
    {
      return memories_written;
    }

    /// Exclusive slot `anisotropy`: the symmetric map from the tractions of an
    /// isotropic law to those of this one. Neutral: unity.
    virtual dealii::Tensor<2, 2> cone() const
    {
      dealii::Tensor<2, 2> unity;
      unity[0][0] = unity[1][1] = 1.;
      return unity;
    }

    /// Exclusive slot `normal_ratio`: r_s after the slip [mm], starting from
    /// @p start. Neutral: r_s = 1, Coulomb's sudden transition.
    virtual NormalRatio normal_ratio_after_slip(const double /*start*/,
                                                const double /*slip*/) const
    {
      return {};
    }

    /// r_s of a point that was never loaded, or has come off the plane.
    virtual double virgin_normal_ratio() const
    {
      return 1.;
    }

    /// The ratio below which nothing slips.
    virtual double elastic_range() const
    {
      return 0.;
    }

    /// Exclusive slot `elastic_core`: what slip [mm] makes of the centre from
    /// which the ratios are measured. Neutral: it stays at zero.
    virtual CoreEvolution core_after_slip(const double /*slip*/) const
    {
      return {};
    }

    /// Least upper bound of |c|, less than 1.
    virtual double core_limit() const
    {
      return 0.;
    }

    /// The energy in the core per strength and |c|^2/2 [mm].
    virtual double core_length() const
    {
      return 0.;
    }

    /// The core that a state remembers.
    virtual ElasticCore core(const ContactState & /*state*/) const
    {
      return {};
    }

    /// Write a core into a state, within its limit.
    virtual void remember_core(const ElasticCore & /*core*/,
                               ContactState & /*state*/) const
    {}

    /// Exclusive slot `overstress`: the flow rule. Neutral: r = r_s, whatever
    /// the rate.
    virtual FlowResidual flow_residual(const double ratio,
                                       const double normal_ratio,
                                       const double /*slip_rate*/) const
    {
      return {normal_ratio - ratio, -1., 1., 0.};
    }

    /// Whether the flow rule feels flow_rate() instead of the slip rate.
    virtual bool remembers_rate() const
    {
      return false;
    }

    /// The slip rate [mm/s] that the flow rule feels after some slip [mm] in a
    /// time step [s], and its derivative with respect to that slip [1/s].
    virtual Rate flow_rate(const ContactState & /*start*/,
                           const double slip,
                           const double time_step) const
    {
      return {slip / time_step, 1. / time_step};
    }

    /// Least upper bound of r, infinity if there is none. Neutral: 1, as
    /// r = r_s <= 1.
    virtual double maximum_ratio() const
    {
      return 1.;
    }

    /// r in steady sliding at a speed [mm/s], r_s = 1.
    virtual double steady_ratio(const double /*slip_rate*/) const
    {
      return 1.;
    }

  private:
    const std::vector<ContactMemory> memories_written;
  };

  /// An effect that lets the coefficient evolve.
  class CoefficientEffect : public Effect
  {
  public:
    using Effect::Effect;

    /// Evolution of mu with slip, d mu / d lambda [1/mm].
    virtual Rate coefficient_rate_per_slip(const double /*coefficient*/) const
    {
      return {};
    }

    /// Evolution of mu with time, d mu / dt [1/s].
    virtual Rate coefficient_rate_per_time(const double /*coefficient*/) const
    {
      return {};
    }
  };

  /// An effect that changes the yield level.
  class StrengthEffect : public Effect
  {
  public:
    using Effect::Effect;

    /// Factor G of the strength f_n mu.
    virtual Strength strength_factor(const SlipStepData & /*step*/) const
    {
      return {1., 0., 0., {}};
    }

    /// Strength added to f_n mu G_1 G_2 ... [MPa].
    virtual Strength additive_strength(const SlipStepData & /*step*/) const
    {
      return {};
    }

    /// Whether the strength depends on the slip rate: then the strength at
    /// rest is not the one that the last step ended with.
    virtual bool depends_on_rate() const
    {
      return false;
    }

    /// By how much the strength leaves, within a step, what it is at both ends,
    /// as a share: what is over between two looks makes the step too long.
    virtual double hidden_change(const ContactState & /*start*/,
                                 const ContactState & /*end*/) const
    {
      return 0.;
    }

    /// By how much the strength at the end of a step is off, as a share, beyond
    /// what the slip rates of its stages tell.
    virtual double unseen_error(const ContactState & /*start*/,
                                const ContactState & /*end*/) const
    {
      return 0.;
    }

    /// Write what the effect remembers of a point that was never loaded, if
    /// that is a parameter.
    virtual void begin(ContactState & /*state*/) const
    {}

    /// Write what the effect remembers into the state after the step; called
    /// for an open point, too.
    virtual void remember(const SlipStepData & /*step*/,
                          ContactState & /*end*/) const
    {}

    /// Depth that the block loses per normal traction and slip [1/MPa]. The
    /// effect remembers it as the memory "worn_depth_mm".
    virtual double wear_rate() const
    {
      return 0.;
    }
  };

  /// Keys of an effect's section, with values.
  using EffectSettings = std::vector<std::pair<std::string, std::string>>;

  /// A key of an effect's section.
  struct EffectKey
  {
    /// @param symbol as in the formula; may be ""
    /// @param pattern range and unit
    EffectKey(const std::string                   &key,
              const std::string                   &symbol,
              const std::string                   &default_value,
              const dealii::Patterns::PatternBase &pattern);

    std::string                                          key;
    std::string                                          symbol;
    std::string                                          default_value;
    std::shared_ptr<const dealii::Patterns::PatternBase> pattern;
  };

  /// A parameter of an effect.
  struct EffectParameter : EffectKey
  {
    std::string meaning; ///< without what the key says
    /// Path of a key that it must not exceed, "" for none.
    std::string at_most = "";
  };

  /// Pattern of a parameter that is more than 0.
  Quantity positive(const Dimension dimension, const double maximum = 1e30);

  /// Pattern of a parameter that is one of some words, "cot|log".
  dealii::Patterns::Selection one_of(const std::string &words);

  /// The section of an effect in a case.
  struct EffectSection
  {
    const Parameters &all;
    const std::string path; ///< "Friction/<name>/"

    double number(const std::string &key) const
    {
      return all.number(path + key);
    }

    std::string text(const std::string &key) const
    {
      return all.text(path + key);
    }

    /// @throws InputError
    [[noreturn]] void reject(const std::string &key,
                             const std::string &why) const
    {
      all.reject(path + key, why);
    }
  };

  /// All that is known of an effect.
  struct EffectInfo
  {
    std::string   name;
    ExclusiveSlot slot = ExclusiveSlot::none;
    std::string   words;   ///< what it does, for who knows no formulas
    std::string   formula; ///< one line of text
    std::string   latex;   ///< the same
    std::string   source;  ///< paper and equation
    /// Where it does nothing; that of neutral_settings if it is not set.
    std::string neutral;

    std::vector<EffectParameter> parameters;

    /// Values for which it does nothing, or as good as nothing, and values with
    /// which it does much: the tests try both.
    EffectSettings neutral_settings;
    EffectSettings typical_settings;

    EffectSearch search;

    /// Whether friction may fall within less slip than the contact's own.
    bool is_sudden = false;

    /// Whether the place on the plane matters; may be empty.
    std::function<bool(const EffectSection &)> heeds_position = {};

    /// Keys of its section for the number of the test that is made, and for the
    /// first and the last one that it knows; "" if that does not matter.
    std::string test_number = "", first_test = "", last_test = "";

    /// What is looked at once, before a case is run, and not whenever a law is
    /// made. May be empty.
    /// @throws InputError
    std::function<void(const EffectSection &)> check = {};

    std::function<std::unique_ptr<Effect>(const EffectSection &,
                                          const CoefficientBasis &)>
      create;

    /// "Friction/<name>/"
    std::string section() const;

    EffectSection section_of(const Parameters &parameters) const;

    void declare(Parameters &parameters) const;
  };

  /// All effects linked into the program, by name.
  const std::map<std::string, EffectInfo> &effect_registry();

  /// The first of some effects of which something is true, nullptr if there is
  /// none.
  const EffectInfo *
  find_effect(const std::vector<std::string>                &names,
              const std::function<bool(const EffectInfo &)> &is_it);

  /// The one to which the order of the tests matters.
  const EffectInfo *effect_of_order(const std::vector<std::string> &names);

  /// A global object of this type registers an effect.
  struct RegisterEffect
  {
    explicit RegisterEffect(EffectInfo info);
  };

  /// The same for a class with a static member info().
  template <class EffectType>
  RegisterEffect register_effect()
  {
    EffectInfo info = EffectType::info();
    info.create     = [](const EffectSection    &section,
                     const CoefficientBasis &basis) {
      return std::make_unique<EffectType>(section, basis);
    };
    return RegisterEffect(info);
  }
} // namespace SlipStep

#endif
