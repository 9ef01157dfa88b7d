// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/friction/effect.h>

#include <cmath>
#include <limits>

namespace SlipStep
{
  namespace
  {
    /// The centre c, and the energy in it.
    const ContactMemory core_1      = register_memory({"core_1", 0., -1., 1.});
    const ContactMemory core_2      = register_memory({"core_2", 0., -1., 1.});
    const ContactMemory core_energy = register_memory(
      {"core_energy_MPa_mm", 0., -std::numeric_limits<double>::infinity()});

    /// The point from which the subloading surface grows follows the slip, so
    /// that small load cycles close instead of ratcheting for ever: the
    /// extended subloading surface of metals and soils. The rate of the centre
    /// in this form, with its limit \f$\chi < 1\f$, is in Hashiguchi,
    /// Elastoplasticity Theory (2014). That friction has it is chosen, and what
    /// follows is derived here.
    ///
    /// Slip is along n, which is normal to the surface through the traction. It
    /// may go back while the traction is still forward, else a loop between two
    /// forward loads could not close. Slip of a constant direction moves c
    /// exactly by \f$c = c_0 e^{-C\lambda} + \chi (1 - e^{-C\lambda})\,n\f$.
    ///
    /// Then slip does not only dissipate. With the energy \f$\psi = \tau_y
    /// |c|^2/(2 C \chi)\f$ in the core
    /// \f[ f_t \cdot n = \frac{d\psi}{d\lambda} + \tau_y \left[r - r_s\,c
    /// \cdot n + \frac{|c|^2}{\chi}\right], \f]
    /// of which the bracket is positive since \f$r \ge r_s\f$ and \f$|c| <
    /// 1\f$: it is the heat. A core is as strong as its contact: under more
    /// pressure it gives back more than it took, which the pressure pays, so
    /// the energy counted in it may be negative.
    ///
    /// Cycles between the loads r_1 < r_2 in one direction leave the same r on
    /// both sides when \f$c = (r_1 + r_2)/(2 + r_1 - r_2)\f$, \f$r = (r_2 -
    /// r_1)/2\f$. With an elastic range (effect subloading) of at least that
    /// much slip ends: the core moves until one of r is in the range.
    class ElasticCoreEffect : public Effect
    {
    public:
      static EffectInfo info()
      {
        EffectInfo info;
        info.name  = "elastic_core";
        info.slot  = ExclusiveSlot::elastic_core;
        info.words = "load cycles that close instead of creeping on for ever";
        info.formula =
          "f_t/tau_y = (1 - r_s) c + r n, dc/d lambda = C (chi n - "
          "c), slip along n";
        info.latex  = R"(\frac{f_t}{\tau_y} = (1 - r_s)\,c + r\,n, \quad )"
                      R"(\frac{dc}{d\lambda} = C\,(\chi\,n - c), \quad |n| = 1)";
        info.source = "Hashiguchi (1989), Int. J. Solids Struct. 25, 917-945, "
                      "for metals and soils; derived here for friction";
        info.parameters = {
          {{"Rate", "C", "1000", Quantity(Dimension::per_length, 0., 1e30)},
           "rate at which the core follows the slip: it is there after a few "
           "1/C. The larger it is, compared with the Rate of subloading, the "
           "sooner cycles close"},
          {{"Limit", "chi", "0.9", Quantity(Dimension::number, 0., 0.99, true)},
           "distance of the core from zero after long slip, as a share of the "
           "strength; cycles below a load of about this can close"}};
        info.neutral_settings = {{"Rate", "0"}};
        info.typical_settings = {{"Rate", "300"}, {"Limit", "0.7"}};
        info.search.why_not   = "it shows in many small load cycles, which "
                                "measured tests seldom have";
        return info;
      }

      ElasticCoreEffect(const EffectSection &section, const CoefficientBasis &)
        : Effect({core_1, core_2, core_energy})
        , C(section.number("Rate"))
        , chi(section.number("Limit"))
      {}

      virtual CoreEvolution core_after_slip(const double slip) const override
      {
        const double kept = std::exp(-C * slip);
        return {kept, -chi * std::expm1(-C * slip), -C * kept, chi * C * kept};
      }

      virtual double core_limit() const override
      {
        return C > 0. ? chi : 0.;
      }

      virtual double core_length() const override
      {
        return C > 0. ? 1. / (C * chi) : 0.;
      }

      virtual ElasticCore core(const ContactState &state) const override
      {
        ElasticCore result;
        result.centre[0] = state[core_1];
        result.centre[1] = state[core_2];
        result.energy    = state[core_energy];
        return result;
      }

      virtual void remember_core(const ElasticCore &core,
                                 ContactState      &state) const override
      {
        // Averages of cores and round-off may leave the limit.
        const double norm  = core.centre.norm();
        const double scale = norm > chi ? chi / norm : 1.;
        state[core_1]      = scale * core.centre[0];
        state[core_2]      = scale * core.centre[1];
        state[core_energy] = core.energy;
      }

    private:
      const double C, chi;
    };

    const RegisterEffect elastic_core_registration =
      register_effect<ElasticCoreEffect>();
  } // namespace
} // namespace SlipStep
