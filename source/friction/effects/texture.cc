// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/numbers.h>

#include <slipstep/friction/effect.h>
#include <slipstep/utilities/text.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace SlipStep
{
  namespace
  {
    using dealii::numbers::PI;

    /// Where the contact has got to over the plane, along its two axes.
    constexpr double infinite = std::numeric_limits<double>::infinity();

    const ContactMemory track_1 =
      register_memory({"track_1_mm", 0., -infinite, infinite, 0});
    const ContactMemory track_2 =
      register_memory({"track_2_mm", 0., -infinite, infinite, 1});

    /// A pattern of the surface, of grooves, of a bent slide or of a screw that
    /// is not round, with two harmonics that give its waves a shape: e is the
    /// unit vector across the grooves and x where slip has brought the contact,
    /// or its block while it is off the plane. Forth and back are the same
    /// places, unlike the slip path.
    class Texture : public StrengthEffect
    {
    public:
      static EffectInfo info()
      {
        const Quantity share(Dimension::number, -100., 100.);
        EffectInfo     info;
        info.name  = "texture";
        info.words = "a pattern along the track, the same forth and back";
        info.formula =
          "G = 1 + w (sin(theta) + s_2 sin(2 theta) + c_2 cos(2 theta) + s_3 "
          "sin(3 theta) + c_3 cos(3 theta)), theta = 2 pi e.x / Lambda + phi, x: "
          "where the contact has got to over the plane";
        info.latex =
          R"(G = 1 + w \left(\sin\theta + s_2 \sin 2\theta + c_2 \cos )"
          R"(2\theta + s_3 \sin 3\theta + c_3 \cos 3\theta\right), )"
          R"(\quad \theta = \frac{2\pi\,e \cdot x}{\Lambda} + \varphi)";
        info.source     = "chosen";
        info.parameters = {
          {{"Amplitude", "w", "0.05", Quantity(Dimension::number, 0., 0.99)},
           "share by which the strength goes up and down"},
          {{"Wavelength", "Lambda", "2", positive(Dimension::length)},
           "length of a wave across the grooves"},
          {{"Phase", "phi", "0", Quantity(Dimension::angle, -720., 720.)},
           "phase where the contact was first loaded"},
          {{"Angle", "", "0", Quantity(Dimension::angle, -360., 360.)},
           "angle in the contact plane, from its first axis to the direction e "
           "across the grooves"},
          {{"Second sine", "s_2", "0", share},
           "share of the amplitude that a wave of half the length has"},
          {{"Second cosine", "c_2", "0", share},
           "the same of a wave that is a quarter of its length ahead"},
          {{"Third sine", "s_3", "0", share},
           "share of the amplitude that a wave of a third of the length has"},
          {{"Third cosine", "c_3", "0", share},
           "the same of a wave that is a quarter of its length ahead"}};
        info.neutral_settings   = {{"Amplitude", "0"}};
        info.typical_settings   = {{"Amplitude", "0.3"},
                                   {"Wavelength", "0.1 mm"},
                                   {"Phase", "40 deg"},
                                   {"Angle", "30 deg"},
                                   {"Second sine", "-0.4"},
                                   {"Second cosine", "0.3"},
                                   {"Third sine", "0.2"},
                                   {"Third cosine", "-0.1"}};
        info.search             = {"waves along the track", search};
        info.search.other_forms = {search_oblique};
        for (const bool is_second : {false, true})
          for (const auto even : {search, search_oblique})
            info.search.other_forms.push_back(
              [is_second, even](const Circumstances &now) {
                return uneven(even(now), is_second);
              });
        info.search.along   = "position";
        info.is_sudden      = true;
        info.heeds_position = [](const EffectSection &) { return true; };
        return info;
      }

      Texture(const EffectSection &section, const CoefficientBasis &)
        : StrengthEffect({track_1, track_2})
        , w(section.number("Amplitude"))
        , wave_number(2. * PI / section.number("Wavelength"))
        , phase(section.number("Phase"))
      {
        for (unsigned int i = 0; i < shape_keys.size(); ++i)
          waves[i] = section.number(shape_keys[i]);
        const double largest =
          1. + std::hypot(waves[0], waves[1]) + std::hypot(waves[2], waves[3]);
        if (w * largest >= 1.)
          section.reject("Amplitude",
                         "with its harmonics, which make it up to " +
                           short_text(largest) +
                           " times as large, it must be less than 1, or "
                           "friction could vanish");
        swing              = w * largest;
        shortest           = waves[2] != 0. || waves[3] != 0. ? 3. :
                             waves[0] != 0. || waves[1] != 0. ? 2. :
                                                                1.;
        const double angle = section.number("Angle");
        across[0]          = std::cos(angle);
        across[1]          = std::sin(angle);
      }

      virtual Strength strength_factor(const SlipStepData &step) const override
      {
        const double theta =
          wave_number * (across[0] * step.start[track_1] +
                         across[1] * step.start[track_2] + across * step.way) +
          phase;
        double shape = std::sin(theta), d_shape = std::cos(theta);
        for (const unsigned int i : {0, 1})
          {
            const double n = i + 2, s = waves[2 * i], c = waves[2 * i + 1];
            shape += s * std::sin(n * theta) + c * std::cos(n * theta);
            d_shape += n * (s * std::cos(n * theta) - c * std::sin(n * theta));
          }
        Strength factor;
        factor.value = 1. + w * shape;
        factor.d_way = w * wave_number * d_shape * across;
        return factor;
      }

      // Half of its shortest wave.
      virtual double hidden_change(const ContactState &start,
                                   const ContactState &end) const override
      {
        const double turned =
          wave_number * (across[0] * (end[track_1] - start[track_1]) +
                         across[1] * (end[track_2] - start[track_2]));
        return shortest * std::abs(turned) > PI ? swing : 0.;
      }

      virtual void remember(const SlipStepData &step,
                            ContactState       &end) const override
      {
        end[track_1] = step.start[track_1] + step.way[0];
        end[track_2] = step.start[track_2] + step.way[1];
      }

    private:
      static TrialFormula search(const Circumstances &now)
      {
        TrialFormula formula = search_at(now, {0.});
        if (formula.why_not.empty() && now.range.main_line != 0.)
          formula.settings = {{"Angle", now.range.main_line}};
        return formula;
      }

      // With harmonics; the wave that is seen may be the second of a longer
      // one.
      static TrialFormula uneven(TrialFormula formula, const bool is_second)
      {
        for (const char *const key : shape_keys)
          formula.parameters.push_back({key, -5., 5., false});
        for (CandidateParameter &parameter : formula.parameters)
          if (parameter.path == "Wavelength" && is_second)
            {
              parameter.lower *= 2.;
              parameter.upper *= 2.;
            }
        for (TrialFormula::Shape &shape : formula.shapes)
          shape = [even = shape, is_second](const double strength) {
            Values values = even(strength);
            for (const char *const key : shape_keys)
              values[key] = 0.;
            if (is_second)
              {
                constexpr double times_the_first = 3.;
                values["Amplitude"] /= 1. + times_the_first;
                values[shape_keys[0]] = times_the_first;
                values["Wavelength"] *= 2.;
                values["Phase"] /= 2.;
              }
            return values;
          };
        return formula;
      }

      // Along one line all that is known is the wavelength along it.
      static TrialFormula search_oblique(const Circumstances &now)
      {
        TrialFormula formula = search_at(now, {-PI / 4., PI / 4.});
        if (formula.why_not.empty() && now.range.widest_angle < 0.1)
          return TrialFormula::none("all tests move along one line");
        const double line = now.range.main_line;
        if (formula.why_not.empty())
          formula.parameters.push_back(
            {"Angle", line - 0.45 * PI, line + 0.45 * PI, false});
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
        TrialFormula formula;
        formula.parameters = {{"Amplitude", 0., 0.9, false},
                              {"Wavelength", 0.5 * along, 1.5 * along, true},
                              {"Phase", -2. * PI, 2. * PI, false}};
        const double line  = now.range.main_line;
        for (const double angle : angles)
          for (const double shift : {0., PI / 2.})
            formula.shapes.push_back([=](const double strength) {
              Values values = {
                {"Amplitude",
                 std::clamp(just_noticed * std::abs(strength), 1e-4, 0.8)},
                {"Wavelength", along * std::cos(angle)},
                {"Phase", strength < 0. ? shift - PI : shift}};
              if (angle != 0.)
                values["Angle"] = line + angle;
              return values;
            });
        return formula;
      }

      static constexpr std::array<const char *, 4> shape_keys = {
        {"Second sine", "Second cosine", "Third sine", "Third cosine"}};

      const double          w, wave_number, phase;
      std::array<double, 4> waves;    ///< s_2, c_2, s_3, c_3
      double                swing;    ///< largest departure from 1
      double                shortest; ///< number of the shortest wave
      dealii::Tensor<1, 2>  across;
    };

    const RegisterEffect texture_registration = register_effect<Texture>();
  } // namespace
} // namespace SlipStep
