// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_experiment_machine_h
#define slipstep_experiment_machine_h

#include <slipstep/friction/contact_point.h>

#include <optional>
#include <string>
#include <vector>

namespace SlipStep
{
  struct ContactStage;

  /// The moving part of a machine, at one instant.
  struct Slider
  {
    dealii::Tensor<1, 2> slip;     ///< displacement of the contact [mm]
    dealii::Tensor<1, 2> velocity; ///< of the contact [mm/s]
    /// What the load point carries, per area [MPa].
    dealii::Tensor<1, 2> load;
  };

  /// One step of contact and machine.
  struct MachineStep
  {
    ContactResponse      contact;   ///< of the second stage
    Slider               start;     ///< of the step
    Slider               first;     ///< at the end of the first stage
    Slider               second;    ///< where the second starts
    Slider               slider;    ///< at the end of the step
    dealii::Tensor<1, 2> motion;    ///< of the load point [mm]
    double               time_step; ///< [s]
    /// of spring and inertia in a stage [mm/MPa], 0 under a given load
    double softness = 0.;
    double work     = 0.;    ///< of the load point, per area [MPa mm]
    bool   holds    = true;  ///< false if friction cannot hold a push
    bool   jumps    = false; ///< see Machine::step()

    /// Half of what a method of first order, which has the rates of the second
    /// stage only, would add to displacement and velocity times the time of a
    /// stage [mm].
    dealii::Tensor<1, 2> difference_of_orders() const;
  };

  /// The machine that moves a contact point or a block: a spring in series, the
  /// same in all directions of the contact plane, and a mass between the two.
  ///
  /// The programme moves the load point at the far end of the spring by u_d;
  /// the mass m (per area of contact) and with it the contact slips by g,
  /// resisted by the traction of the friction law:
  /// \f[ m \ddot g = k (u_d - g) - f_t. \f]
  /// That belongs to the experiment: the friction law knows nothing of it.
  ///
  /// Contact, spring and mass make the two stages of a step (TwoStages)
  /// together, so that of their motion, too, the error is of second order. A
  /// stage is backward Euler's; for the law one with mass is one with a spring
  /// of stiffness \f$k + m/(\gamma h)^2\f$ and another motion of its end.
  /// Oscillations that the steps resolve keep their energy but for a share of
  /// some \f$0.007\,(\omega h)^4\f$ per step; quicker ones fade.
  ///
  /// Without mass, slip and spring are found together, at the end of a stage,
  /// so a soft spring on a weakening contact jumps instead of oscillating.
  class Machine
  {
  public:
    static void declare_parameters(Parameters &parameters);

    /// A rigid machine, of which u_d = g.
    Machine() = default;

    /// @throws InputError, also for a mass that nothing springy moves
    explicit Machine(const Parameters &parameters);

    bool is_rigid() const
    {
      return compliance == 0.;
    }

    /// k [MPa/mm], infinity for a rigid machine.
    double stiffness() const
    {
      return 1. / compliance;
    }

    double mass() const ///< m, per area [MPa s^2/mm]
    {
      return areal_mass;
    }

    /// One step of a contact point and the machine. On a soft spring without
    /// mass the contact may jump; if friction does not rise with speed that
    /// takes no time, and no step is small enough for it. Such a step has one
    /// stage, and no error is asked of it.
    /// @param start of the step; default for a machine at rest without load
    /// @param load_point_increment motion of the load point [mm]
    /// @param normal_traction at the end of the step [MPa], to which it changes
    ///   evenly
    /// @param time_step [s]
    /// @param shortest_step that can be made [s]: what lets go in it jumps
    MachineStep step(const FrictionLaw          &law,
                     ContactPoint               &point,
                     const Slider               &start,
                     const dealii::Tensor<1, 2> &load_point_increment,
                     const double                normal_traction,
                     const double                time_step,
                     const double                shortest_step = 0.) const;

    /// One step under a given load of the load point, which moves as contact
    /// and spring let it. Without mass the slip is the one at which the law has
    /// that traction; if there is none, the step does not hold.
    /// @param load at the end of the step [MPa], to which it changes evenly
    MachineStep push(const FrictionLaw          &law,
                     ContactPoint               &point,
                     const Slider               &start,
                     const dealii::Tensor<1, 2> &load,
                     const double                normal_traction,
                     const double                time_step) const;

    /// Estimated error of the step that @p point made last, 0 for a jump.
    StepError error(const FrictionLaw  &law,
                    const ContactPoint &point,
                    const MachineStep  &step) const;

    /// Estimated error of the load that the motion of the mass makes [MPa].
    double error_of_motion(const MachineStep &step) const;

    /// Load of the swing that begins where a statement changes the speed, as
    /// far as the step, its first, is too long to follow it [MPa].
    double lost_swing(const MachineStep &step) const;

    /// What the probes of a history are, in the order of probes().
    static std::vector<std::string> probe_names();

    /// Displacement [mm] and velocity [mm/s] of the contact, and the load of
    /// the spring over the normal load, along the first axis.
    static std::vector<double> probes(const Slider &slider,
                                      const double  pressure);

    /// Energy stored per area in spring and motion [MPa mm].
    double stored_energy(const Slider &slider) const
    {
      return compliance / 2. * slider.load.norm_square() +
             kinetic_energy(slider);
    }

    /// Of it the part in motion [MPa mm].
    double kinetic_energy(const Slider &slider) const
    {
      return areal_mass / 2. * slider.velocity.norm_square();
    }

  private:
    /// Make a stage in which the load point moves.
    /// @param[out] slider at its end
    ContactResponse move(const ContactStage         &stage,
                         const Slider               &start,
                         const dealii::Tensor<1, 2> &load_point_increment,
                         Slider                     &slider) const;

    /// Make a stage under a load.
    /// @return nothing if friction cannot hold it
    std::optional<ContactResponse> pull(const ContactStage         &stage,
                                        const Slider               &start,
                                        const dealii::Tensor<1, 2> &load,
                                        Slider &slider) const;

    /// Of the spring, and of the inertia in a stage of that time [mm/MPa].
    double softness_in(const double stage_time) const;

    double compliance = 0.; ///< c = 1 / k [mm/MPa]
    double areal_mass = 0.; ///< m [MPa s^2/mm]
  };

  /// By which the load point moves before the contact slides [mm].
  /// @param traction that it carries then [MPa]
  double elastic_slip(const double       traction,
                      const FrictionLaw &law,
                      const Machine     &machine);
} // namespace SlipStep

#endif
