// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_drive_h
#define slipstep_solid_drive_h

#include <slipstep/experiment/machine.h>
#include <slipstep/experiment/programme.h>

#include <limits>

namespace SlipStep
{
  /// What moves the driven faces of a block: a load point, which the programme
  /// moves or pushes, and between the two the spring and the mass of the
  /// Machine. Spring, mass and loads are per nominal area of contact.
  ///
  /// Where the load is given, or the machine is not rigid, the displacement d
  /// of the driven faces is an unknown. A stage of a step (TwoStages) is
  /// backward Euler's, so that their reactions F have to be \f[ F = A\,\bigl[f
  /// - K\,(d - d_0)\bigr], \qquad
  ///     K = k + m/(\gamma h)^2 , \f]
  /// where the stage begins at \f$d_0\f$; k only where the load point is moved.
  class Drive
  {
  public:
    /// @param area nominal, of contact [mm^2]
    Drive(const Machine &machine, const Programme &programme, const double area)
      : machine(machine)
      , programme(programme)
      , area(area)
    {}

    void begin_step(const double time, const bool is_first_of_segment);

    /// Let the stage begin where the first one leads.
    void begin_second_stage();

    /// @param end_time of the stage [s]
    /// @param time_step of the stage [s]
    void begin_stage(const double end_time, const double time_step);

    /// @param displacement of the driven faces [mm]
    /// @param reaction of the driven faces [N]
    void end_stage(const dealii::Tensor<1, 2> &displacement,
                   const dealii::Tensor<1, 2> &reaction);

    void accept(const double pressure);

    /// Let the driven faces rest where they are, until the next stage.
    void rest()
    {
      unknown = false;
    }

    /// Whether the displacement of the driven faces is unknown.
    bool is_unknown() const
    {
      return unknown;
    }

    /// Where the driven faces are when the stage ends [mm]; a first guess if
    /// that is unknown.
    /// @param growth how much of the last step's motion, for that guess
    dealii::Tensor<1, 2> displacement(const double growth) const;

    /// What the reactions of the driven faces have to be [N].
    dealii::Tensor<1, 2> force(const dealii::Tensor<1, 2> &displacement) const
    {
      return area *
             (force_at_start - resistance * (displacement - stage_start.slip));
    }

    /// Of the drive without the block [MPa s^2/mm].
    double mass() const
    {
      return machine.mass();
    }

    /// How fast that falls with their displacement [N/mm].
    double stiffness() const
    {
      return area * resistance;
    }

    /// Force that is nothing but round-off of a displacement such as that at
    /// the beginning of the stage [N].
    double round_off() const
    {
      return stiffness() * stage_start.slip.norm() *
             std::numeric_limits<double>::epsilon();
    }

    /// Work of the load point in the stage that ended, beyond that of the
    /// reactions on the driven faces [N mm].
    double work_beyond(const dealii::Tensor<1, 2> &reaction) const;

    /// Estimated error of the motion of the mass in the step that ended, as
    /// StepError::measure(), with a block that has none.
    /// @param springs of block and contact against a motion of the driven
    ///   faces [N/mm]
    /// @param strength of the contact [N]
    double error(const dealii::Tensor<2, 2> &springs,
                 const double                strength) const;

    /// As Machine::lost_swing(), as a share of the strength, with a block that
    /// has no mass.
    double lost_swing(const dealii::Tensor<2, 2> &springs,
                      const double                strength) const;

    /// Of the motion of the driven faces (MachineStep::difference_of_orders())
    /// [mm].
    dealii::Tensor<1, 2> difference_of_orders() const
    {
      return step_against({}).difference_of_orders();
    }

    /// m / (gamma h)^2 in the stage that ended [N/mm].
    double inertia() const
    {
      return area * machine.mass() / (stage_time * stage_time);
    }

    /// At the end of the last step; `slip` is the displacement of the driven
    /// faces.
    const Slider &state() const
    {
      return at_start;
    }

    /// Displacement of the load point then [mm].
    dealii::Tensor<1, 2> load_point() const
    {
      return load_point_at_start;
    }

    /// Its path where it was pushed [mm].
    double pushed_path() const
    {
      return path;
    }

    /// Energy in spring and mass then [N mm].
    double stored_energy() const
    {
      return area * machine.stored_energy(at_start);
    }

    /// Of it the part in motion [N mm].
    double kinetic_energy() const
    {
      return area * machine.kinetic_energy(at_start);
    }

    /// Whether a push without a mass has moved the driven faces, in the stage
    /// that ended, faster than a contact can slip that holds it.
    bool is_faster_than_waves() const;

    /// Why there is no equilibrium.
    std::string reason_of_failure() const;

    /// For boost::serialization.
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &at_start.slip &at_start.velocity &at_start.load
        &load_point_at_start &last_motion &pushed &load_before &path &pressure;
    }

  private:
    /// The step that ended.
    /// @param springs of block and contact against a motion of the driven
    ///   faces [N/mm]
    MachineStep step_against(const dealii::Tensor<2, 2> &springs) const;

    /// Of the spring, where it is moved.
    dealii::Tensor<1, 2>
    spring_load(const dealii::Tensor<1, 2> &displacement) const
    {
      return at_start.load +
             machine.stiffness() * (motion - (displacement - at_start.slip));
    }

    const Machine   machine;
    const Programme programme;
    const double    area; ///< [mm^2]

    // At the end of the last step.
    Slider               at_start;
    dealii::Tensor<1, 2> load_point_at_start; ///< [mm]
    dealii::Tensor<1, 2> last_motion;         ///< of the driven faces [mm]
    dealii::Tensor<1, 2> pushed;              ///< on top of the programme [mm]
    dealii::Tensor<1, 2> load_before;         ///< when the segment began [MPa]
    double               path     = 0.;
    double               pressure = 0.; ///< of the contact [MPa]

    // The present step: begin, ends of stages, and where the stage begins.
    double               begin_time = 0.; ///< [s]
    Slider               first, stage_start, stage_end;
    dealii::Tensor<1, 2> load_point_at_stage_start, load_point_at_stage_end;

    // The present stage.
    double               end_time = 0., stage_time = 0.; ///< [s]
    bool                 unknown = false, pushes = false;
    dealii::Tensor<1, 2> motion; ///< of the load point since begin_time [mm]
    dealii::Tensor<1, 2> push;   ///< [MPa]
    dealii::Tensor<1, 2> force_at_start;  ///< f [MPa]
    double               resistance = 0.; ///< K [MPa/mm]
  };
} // namespace SlipStep

#endif
