// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_synthetic_tests_protocols_h
#define slipstep_synthetic_tests_protocols_h

#include <slipstep/measured_data/measured_test.h>
#include <slipstep/synthetic_tests/influence.h>

#include <string>
#include <vector>

namespace SlipStep
{
  namespace Planting
  {
    /// A part of a test: straight on, or at rest, while the pressure changes
    /// evenly.
    struct Leg
    {
      double speed;    ///< negative: back; 0: rest [mm/s]
      double duration; ///< [s]
      double pressure; ///< at the end [MPa]
    };

    /// What is done in a test.
    struct Protocol
    {
      std::string      name;     ///< "slide 0.2 mm/s, 5.8 MPa"
      double           pressure; ///< at the beginning [MPa]
      double           angle;    ///< of all motion [deg]
      std::vector<Leg> legs;
    };

    /// Kinds of protocols there are.
    constexpr unsigned int n_protocols = 20;

    /// Different conditions, the most telling first: slides at several speeds,
    /// pressures and angles, steps of speed and of pressure, rests, reversals,
    /// fast slides with pauses. Levels are drawn once for all. From edition 2
    /// on pressures jump within a hundredth of a second, or grow all the way of
    /// a slide, and one slide is at 45 deg.
    std::vector<Protocol> draw_protocols(const unsigned int n,
                                         const unsigned int edition,
                                         Random            &random);

    /// Slides and steps within a narrow range of speeds and pressures only:
    /// many effects look alike there.
    std::vector<Protocol> draw_narrow_protocols(const unsigned int n,
                                                Random            &random);

    /// Motion and pressure of a test, its friction zero: about 170 rows, evenly
    /// spread over the time of every leg, closer where a leg begins.
    MeasuredTest motion_of(const Protocol &protocol);
  } // namespace Planting
} // namespace SlipStep

#endif
