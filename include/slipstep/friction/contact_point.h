// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_friction_contact_point_h
#define slipstep_friction_contact_point_h

#include <slipstep/friction/law.h>

namespace SlipStep
{
  /// One point of the contact face: a committed state and a trial state.
  ///
  /// A step has two stages (TwoStages): update() makes the first,
  /// begin_second_stage() goes on from it, update() makes the second. update()
  /// always starts from the beginning of its stage, so it can be repeated as
  /// often as an iteration needs; commit() accepts the last update, revert()
  /// forgets the step. With one stage only the step is one of backward Euler.
  class ContactPoint
  {
  public:
    ContactPoint() = default;

    /// A point that has not been loaded yet.
    explicit ContactPoint(const FrictionLaw &law);

    /// Continue from a known state.
    explicit ContactPoint(const ContactState &state);

    /// Make a stage.
    /// @param slip_increment slip in the contact plane [mm] since the beginning
    ///   of the stage
    /// @param normal_traction f_n at its end [MPa]; not positive means open
    /// @param time_step of the stage [s], greater than 0
    /// @param carried way in the plane [mm] before, while the point was off it
    ContactResponse update(const FrictionLaw          &law,
                           const dealii::Tensor<1, 2> &slip_increment,
                           const double                normal_traction,
                           const double                time_step,
                           const dealii::Tensor<1, 2> &carried = {});

    /// Let further updates be of the second stage.
    void begin_second_stage(const FrictionLaw &law);

    /// Estimated error of a step of two stages, as FrictionLaw::step_error().
    StepError error(const FrictionLaw &law, const double compliance = 0.) const;

    void commit();

    void revert();

    const ContactState &committed() const
    {
      return committed_state;
    }

    const ContactState &trial() const
    {
      return last.end;
    }

    /// Traction with which the present stage starts [MPa].
    const dealii::Tensor<1, 2> &stage_traction() const
    {
      return start.state.traction;
    }

    /// What the present stage starts from.
    const ContactState &stage_start() const
    {
      return start.state;
    }

    /// Both states, for boost::serialization.
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &committed_state &last.end;
      if (Archive::is_loading::value)
        start = StageStart(committed_state);
    }

  private:
    ContactState committed_state;
    StageStart   start;       ///< of the present stage
    StageRecord  first, last; ///< first stage, stage made last
  };
} // namespace SlipStep

#endif
