// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_gap_and_strength_h
#define slipstep_solid_gap_and_strength_h

#include <slipstep/utilities/formula.h>
#include <slipstep/utilities/parameters.h>

#include <array>
#include <string>
#include <vector>

namespace SlipStep
{
  /// What the contact face is made like before it is loaded, by formulas of the
  /// place on it: how far it is from the plane, and how strong it is.
  class GapAndStrength
  {
  public:
    /// Coordinates along the axes of the contact plane [mm]; in 2-D one.
    using Place = std::vector<double>;

    static void declare_parameters(Parameters &parameters);

    /// Flat and alike everywhere.
    GapAndStrength() = default;

    /// @param axes those of the contact plane, of 0, 1, 2
    /// @param size of the block [mm]
    /// @param falls whether nothing holds the block along the normal, so that
    ///   it stands on the plane before it is loaded
    /// @throws InputError if a formula cannot be read, or is not finite, or a
    ///   gap is negative, or a strength is not positive
    GapAndStrength(const Parameters                &parameters,
                   const std::vector<unsigned int> &axes,
                   const std::array<double, 3>     &size,
                   const bool                       falls);

    /// Distance from the plane before loading [mm], in a block that falls from
    /// where the face first touches.
    double gap(const Place &place) const
    {
      return has_gap ? gap_formula(place) - datum : 0.;
    }

    /// Factor of the strength of friction.
    double strength(const Place &place) const
    {
      return is_graded ? strength_formula(place) : 1.;
    }

    bool is_curved() const
    {
      return has_gap;
    }

    bool has_map_of_strength() const
    {
      return is_graded;
    }

    /// Of the factor of the strength, over the face.
    double mean_strength() const
    {
      return mean_factor;
    }

    /// How well that is known.
    double error_of_mean_strength() const
    {
      return mean_error;
    }

    /// Of the places that were tried, in a block that does not fall [mm].
    double least_gap() const
    {
      return smallest_gap - datum;
    }

  private:
    ParsedFormula gap_formula{"0"}, strength_formula{"1"};
    bool          has_gap = false, is_graded = false;
    double        smallest_gap = 0., datum = 0.; // [mm]
    double        mean_factor = 1., mean_error = 0.;
  };
} // namespace SlipStep

#endif
