// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_synthetic_tests_influence_h
#define slipstep_synthetic_tests_influence_h

#include <array>
#include <functional>
#include <random>
#include <string>
#include <vector>

namespace SlipStep
{
  /// The workshop in which tests with a hidden effect are made. It has its own
  /// formulas and its own integration in time, so that it can judge the law: it
  /// knows nothing of the room friction.
  namespace Planting
  {
    /// Random numbers of campaigns.
    using Random = std::mt19937_64;

    /// The contact at an instant, as influences see it.
    struct Instant
    {
      double                pressure;      ///< [MPa]
      double                pressure_rate; ///< [MPa/s]
      double                slip_rate;     ///< lambda [mm/s]
      double                traction;      ///< |f_t| [MPa]
      double                coefficient;   ///< mu
      double                path;          ///< slip path since the start [mm]
      std::array<double, 2> position;      ///< of the load point [mm]
      std::array<double, 2> direction;     ///< of slip, unit vector or zero
      double                progress;      ///< of the campaign, 0 to 1
    };

    /// @name Functions.
    ///@{
    using OfNumber  = std::function<double(double)>;
    using OfInstant = std::function<double(const Instant &)>;
    using OfMemory  = std::function<double(const Instant &, double memory)>;
    ///@}

    /// Something that changes the strength, and may remember one number:
    /// \f[ \tau_y = p \mu\,G_1 G_2 \cdots + c_1 + c_2 + \cdots. \f]
    struct Influence
    {
      OfMemory  factor;       ///< G
      OfInstant addition;     ///< c [MPa]
      OfMemory  memory_rate;  ///< of what is remembered [1/s]
      OfNumber  first_memory; ///< under the first pressure [MPa]
      bool      depends_on_slip_rate = false;
    };

    /// Which mathematics an effect is planted with.
    enum class Formula
    {
      catalogue,   ///< that of the law's catalogue
      alternative, ///< the same physics in another form
      outside,     ///< physics that no effect of the catalogue has
      third,       ///< the physics of the catalogue in yet another form
      joint        ///< two of the catalogue's that nearly hide each other
    };

    std::string to_string(const Formula formula);

    /// A number of the truth. Where it has a place in a case file, the name is
    /// its path: "Friction/pressure/Exponent".
    struct TruthParameter
    {
      std::string name;
      double      value;
      std::string unit;
    };

    using Truth = std::vector<TruthParameter>;

    struct TrueContact;

    /// An effect that can be hidden in a contact.
    struct HiddenEffectKind
    {
      std::string name;
      std::string formula; ///< one line of text
      /// Change a contact.
      /// @param amplitude largest relative change of friction within a usual
      ///   campaign, about; 0: none
      std::function<
        Truth(TrueContact &contact, const double amplitude, Random &random)>
        add;
      /// Of the campaigns that draw it: what a seed hides stays the same when
      /// an effect is added, with the next number.
      unsigned int edition = 1;
    };

    /// All effects in one of the mathematics.
    const std::vector<HiddenEffectKind> &hidden_effects(const Formula formula);

    /// One of them.
    /// @throws InputError naming the nearest if there is none
    const HiddenEffectKind &hidden_effect(const std::string &name,
                                          const Formula      formula);
  } // namespace Planting
} // namespace SlipStep

#endif
