// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_field_schedule_h
#define slipstep_solid_field_schedule_h

#include <slipstep/utilities/parameters.h>

namespace SlipStep
{
  /// An accepted step, as far as output depends on it.
  struct FinishedStep
  {
    double             start_time   = 0.; ///< [s]
    double             time         = 0.; ///< at its end [s]
    double             start_path   = 0.; ///< SlidingPath at its beginning [mm]
    double             path         = 0.; ///< at its end [mm]
    unsigned long long number       = 0;  ///< counted from 1
    bool               is_statement = false; ///< a statement ends with it
    bool               is_last      = false;
  };

  /// When volume and contact-face fields are written: "Output/Fields".
  ///
  /// Whether it is time depends on the step alone and not on earlier output, so
  /// a resumed run goes on as if it had not been stopped.
  class FieldSchedule
  {
  public:
    static void declare_parameters(Parameters &parameters);

    /// @throws InputError
    explicit FieldSchedule(const Parameters &parameters);

    /// The last step always is, unless nothing is written at all.
    bool is_due(const FinishedStep &step) const;

  private:
    enum class Kind
    {
      none,
      end,
      statements, ///< at the end of every statement of the programme
      distance,   ///< every so many mm of sliding path
      time,       ///< every so many s
      steps       ///< every so many steps
    };

    Kind   kind     = Kind::statements;
    double interval = 0.; ///< [mm], [s], or steps
  };
} // namespace SlipStep

#endif
