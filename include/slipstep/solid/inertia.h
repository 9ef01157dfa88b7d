// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_inertia_h
#define slipstep_solid_inertia_h

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <slipstep/friction/two_stages.h>
#include <slipstep/solid/block_parameters.h>
#include <slipstep/solid/linear_solver/lumped_mass.h>

#include <vector>

namespace SlipStep
{
  /// The mass of a block and its motion in space; empty for a block without
  /// density.
  ///
  /// Position and velocity make the two stages of a step (TwoStages) together
  /// with the contact, so that their error is of second order, too. A stage
  /// that begins at \f$u_0, v_0\f$ and takes \f$\gamma h\f$ is backward
  /// Euler's, \f[ v = \frac{u - u_0}{\gamma h}, \quad a = \frac{v - v_0}{\gamma
  /// h},
  ///   \quad \mathbf M a + \mathbf K (u + t_d v) + f_c(u) = f , \f]
  /// of which \f$(1 + t_d/\gamma h)\,\mathbf K + \mathbf M/(\gamma h)^2\f$ is
  /// the tangent without the contact. An oscillation of frequency
  /// \f$\omega\f$ loses some \f$0.007\,(\omega h)^4\f$ of its energy per step,
  /// much quicker ones all of it: the scheme is L-stable, its spectral radius
  /// at infinity is 0, so that slow loading between quick events takes long
  /// steps. More damping is that of the material, of the time \f$t_d\f$.
  template <int dim>
  class Inertia
  {
  public:
    using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

    explicit Inertia(const BlockParameters &parameters)
      : parameters(parameters)
    {}

    bool exists() const
    {
      return parameters.is_dynamic();
    }

    /// The mass on a mesh; the block is at rest afterwards.
    /// @param like distributed as all vectors will be
    void reinit(const dealii::DoFHandler<dim> &dof_handler, const Vector &like);

    void begin_step()
    {
      stage_velocity = velocity;
    }

    /// Let the stage begin where the first one leads.
    void begin_second_stage()
    {
      stage_velocity.sadd(1. - TwoStages::carry,
                          TwoStages::carry,
                          end_velocity);
    }

    /// What multiplies stiffness and mass in the tangent of a stage.
    /// @param time of the stage [s]
    BodyFactors factors(const double time) const
    {
      BodyFactors result;
      if (exists())
        {
          result.stiffness = 1. + parameters.damping_time / time;
          result.inertia   = 1. / (time * time);
        }
      return result;
    }

    /// Add M a. Constraints are not applied. All ranks take part.
    /// @param displacement, start at the end and the beginning of a stage,
    ///   relative to the frame [mm]
    /// @param frame_motion in the stage [mm]
    /// @param time of the stage [s]
    /// @return the norm of what was added [N]
    double add_forces(const Vector                 &displacement,
                      const Vector                 &start,
                      const dealii::Tensor<1, dim> &frame_motion,
                      const double                  time,
                      Vector                       &forces) const;

    /// Norm of the forces of inertia that are nothing but round-off of
    /// displacements [N]. All ranks take part.
    /// @param frame displacement of the frame [mm]
    double round_off(const Vector &displacement,
                     const double  frame,
                     const double  time) const;

    /// Add by how much they change with displacement and frame.
    void add_force_changes(const Vector                 &displacement,
                           const dealii::Tensor<1, dim> &frame,
                           const double                  time,
                           Vector                       &forces) const;

    /// Make a displacement in the frame one in space.
    void add_frame(const dealii::Tensor<1, dim> &frame,
                   Vector                       &displacement) const;

    /// Take over the motion in the stage that ended; arguments as of
    /// add_forces().
    void end_stage(const Vector                 &displacement,
                   const Vector                 &start,
                   const dealii::Tensor<1, dim> &frame_motion,
                   const double                  time);

    void accept()
    {
      velocity = end_velocity;
    }

    /// At the end of the stage that ended [N mm].
    double kinetic_energy() const;

    /// As MachineStep::difference_of_orders(), in space [mm].
    /// @param time of a stage [s]
    void difference_of_orders(const double time, Vector &difference) const;

    /// In space, at the end of the last step: the state [mm/s].
    Vector &state()
    {
      return velocity;
    }

    const Vector &state() const
    {
      return velocity;
    }

  private:
    // Zero without inertia.
    double sum_of_ranks(const double value) const;

    const BlockParameters     parameters;
    std::vector<unsigned int> component; // of locally owned unknowns
    Vector                    lumped_mass;
    // At the beginning of the step, where the stage begins, and at its end.
    Vector velocity, stage_velocity, end_velocity;
  };
} // namespace SlipStep

#endif
