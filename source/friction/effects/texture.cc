// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/numbers.h>

#include <slipstep/friction/effect.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace SlipStep
{
  namespace
  {
    using dealii::numbers::PI;

    /// Where slip has brought the contact, along the two axes of its plane.
    const ContactMemory track_1 = register_memory(
      {"track_1_mm", 0., -std::numeric_limits<double>::infinity()});
    const ContactMemory track_2 = register_memory(
      {"track_2_mm", 0., -std::numeric_limits<double>::infinity()});

    /// A pattern of the surface, of grooves, of a bent slide or of a screw that
    /// is not round:
    /// \f[ G = 1 + w \sin\left(\frac{2\pi\,e \cdot x}{\Lambda} +
    ///     \varphi\right), \f]
    /// where e is the unit vector across the grooves and x where slip has
    /// brought the contact since it was first loaded: forth and back are the
    /// same places, unlike the slip path. Chosen.
    class Texture : public StrengthEffect
    {
    public:
      Texture(const Parameters &parameters, const CoefficientBasis &)
        : w(parameters.number("Friction/texture/Amplitude"))
        , wave_number(2. * PI /
                      parameters.number("Friction/texture/Wavelength"))
        , phase(parameters.number("Friction/texture/Phase"))
      {
        const double angle = parameters.number("Friction/texture/Angle");
        across[0]          = std::cos(angle);
        across[1]          = std::sin(angle);
      }

      virtual Strength strength_factor(const SlipStepData &step) const override
      {
        const double along = across * step.direction;
        const double argument =
          wave_number * (across[0] * step.start[track_1] +
                         across[1] * step.start[track_2] + along * step.path) +
          phase;
        Strength factor;
        factor.value         = 1. + w * std::sin(argument);
        const double d_place = w * wave_number * std::cos(argument);
        factor.d_path        = d_place * along;
        factor.d_direction   = d_place * step.path * across;
        return factor;
      }

      virtual void remember(const SlipStepData &step,
                            ContactState       &end) const override
      {
        end[track_1] = step.start[track_1] + step.path * step.direction[0];
        end[track_2] = step.start[track_2] + step.path * step.direction[1];
      }

      virtual std::vector<ContactMemory> memories() const override
      {
        return {track_1, track_2};
      }

      static EffectInfo info()
      {
        EffectInfo info;
        info.name    = "texture";
        info.words   = "a pattern along the track, the same forth and back";
        info.formula = "G = 1 + w sin(2 pi e.x / Lambda + phi), x: place that "
                       "slip has brought the contact to";
        info.latex   = "G = 1 + w \\sin\\left(\\frac{2\\pi\\,e \\cdot "
                       "x}{\\Lambda} + \\varphi\\right)";
        info.source  = "chosen";
        info.neutral = "Amplitude = 0";
        info.parameters = {
          {"Amplitude",
           "w",
           "0.05",
           Quantity(Dimension::number, 0., 0.99),
           "share by which the strength goes up and down"},
          {"Wavelength",
           "Lambda",
           "2",
           Quantity(Dimension::length, 0., 1e30, true),
           "length of a wave across the grooves"},
          {"Phase",
           "phi",
           "0",
           Quantity(Dimension::angle, -720., 720.),
           "phase where the contact was first loaded"},
          {"Angle",
           "",
           "0",
           Quantity(Dimension::angle, -360., 360.),
           "angle in the contact plane, from its first axis to the direction e "
           "across the grooves"}};
        info.neutral_settings  = {{"Amplitude", "0"}};
        info.typical_settings  = {{"Amplitude", "0.3"},
                                  {"Wavelength", "0.1 mm"},
                                  {"Phase", "40 deg"},
                                  {"Angle", "30 deg"}};
        info.search            = {"waves along the track", search};
        info.search.other_form = search_oblique;
        return info;
      }

    private:
      static TrialFormula search(const Circumstances &now)
      {
        return search_at(now, {0.});
      }

      // Along one line all that is known is the wavelength along it.
      static TrialFormula search_oblique(const Circumstances &now)
      {
        TrialFormula formula = search_at(now, {-PI / 4., PI / 4.});
        if (formula.why_not.empty() && now.range.widest_angle < 0.1)
          return TrialFormula::none("all tests move along one line");
        if (formula.why_not.empty())
          formula.parameters.push_back(
            {"Friction/texture/Angle", -0.45 * PI, 0.45 * PI, false});
        return formula;
      }

      // Where the gap has a clear wave, of its length; four phases of it are
      // two with both signs.
      static TrialFormula search_at(const Circumstances       &now,
                                    const std::vector<double> &angles)
      {
        const double along = now.range.track_wave;
        if (!(along > 0.))
          return TrialFormula::none("there is no clear wave along the track");
        const std::string amplitude  = "Friction/texture/Amplitude";
        const std::string wavelength = "Friction/texture/Wavelength";
        const std::string phase      = "Friction/texture/Phase";
        TrialFormula      formula;
        formula.parameters = {{amplitude, 0., 0.9, false},
                              {wavelength, 0.5 * along, 1.5 * along, true},
                              {phase, -2. * PI, 2. * PI, false}};
        for (const double angle : angles)
          for (const double shift : {0., PI / 2.})
            formula.shapes.push_back([=](const double strength) {
              Values values = {
                {amplitude,
                 std::clamp(just_noticed * std::abs(strength), 1e-4, 0.8)},
                {wavelength, along * std::cos(angle)},
                {phase, strength < 0. ? shift - PI : shift}};
              if (angle != 0.)
                values["Friction/texture/Angle"] = angle;
              return values;
            });
        return formula;
      }

      const double         w;
      const double         wave_number;
      const double         phase;
      dealii::Tensor<1, 2> across;
    };

    const RegisterEffect texture_registration = register_effect<Texture>();
  } // namespace
} // namespace SlipStep
