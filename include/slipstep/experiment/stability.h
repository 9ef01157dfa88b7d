// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_experiment_stability_h
#define slipstep_experiment_stability_h

#include <slipstep/experiment/machine.h>
#include <slipstep/experiment/programme.h>
#include <slipstep/friction/law.h>

#include <deal.II/lac/full_matrix.h>

#include <complex>
#include <string>
#include <vector>

namespace SlipStep
{
  /// Where a spring becomes too soft to hold steady sliding.
  struct StabilityLimit
  {
    /// Critical stiffness k_c [MPa/mm]: steady sliding is stable on a stiffer
    /// spring. 0: on any, infinity: on none.
    double stiffness = 0.;
    /// Angular frequency with which a disturbance swings at k_c [1/s].
    double frequency = 0.;
  };

  /// Steady sliding of one contact point, disturbed a little along its
  /// direction of motion.
  ///
  /// For a disturbance \f$\delta u\,e^{st}\f$ of the slip, the traction answers
  /// with \f$Z(s)\,\delta u\,e^{st}\f$, and a mass m on a spring k moves freely
  /// if \f$m s^2 + k + Z(s) = 0\f$. The limit of stability is
  /// \f$s = i\omega\f$,
  /// \f[ \mathrm{Im}\,Z(i\omega_c) = 0, \quad
  ///     k_c = m\,\omega_c^2 - \mathrm{Re}\,Z(i\omega_c). \f]
  /// For subloading, overstress, softening and healing,
  /// \f$1/Z = 1/\alpha_t + 1/Z_{vp}\f$,
  /// \f$Z_{vp} = s f_n (\mu r' - r C / (s + B))\f$, with r' = dr/dV, C =
  /// \f$\kappa(e^{a(\mu-\mu_k)}-1)\f$, B = \f$\kappa a e^{a(\mu-\mu_k)} V + \xi
  /// b e^{b(\mu_s-\mu)}\f$ at the steady state, so that
  /// \f[ k_0 = f_n (r C - \mu r' B), \quad
  ///     \omega_c^2 = \frac{k_0 B}{f_n \mu r'}, \quad
  ///     k_c = \frac{k_0}{1 - k_0/\alpha_t} + m \omega_c^2. \f]
  ///
  /// For every law Z is found by differences of its own steps, of which
  /// backward Euler's have \f$1 - s\,\Delta t\f$ in place of the shift by one
  /// step. Derived here.
  class SteadySliding
  {
  public:
    /// @param velocity of the sliding [mm/s], not zero
    /// @param pressure [MPa], more than 0
    SteadySliding(const FrictionLaw          &law,
                  const dealii::Tensor<1, 2> &velocity,
                  const double                pressure);

    /// Whether the law comes to a steady state at all; without it there is
    /// nothing to be stable. One heating without cooling does not.
    bool exists() const
    {
      return is_steady;
    }

    /// The steady state.
    const ContactState &state() const
    {
      return steady;
    }

    /// Friction along the motion.
    double friction() const;

    /// Z(i omega) [MPa/mm] at an angular frequency [1/s].
    std::complex<double> dynamic_stiffness(const double omega) const;

    /// @param mass per area [MPa s^2/mm]
    StabilityLimit limit(const double mass) const;

    /// Whether disturbances grow the more the quicker they are: then no machine
    /// holds it, nor does the elastic contact.
    bool grows_at_once() const;

  private:
    /// Of what is remembered at the end of a step, by what was remembered at
    /// its beginning and, last, by the slip increment.
    dealii::FullMatrix<double> derivatives(const double time_step) const;

    /// Z(i omega) by steps of one length.
    std::complex<double> stiffness_by_steps(const double omega,
                                            const double time_step) const;

    /// Z of the slip alone, without the elastic part of the contact.
    std::complex<double> slip_stiffness(const double omega) const;

    /// Of the contact along the motion [MPa/mm].
    double elastic_stiffness() const;

    /// What is less in Z at the highest frequencies is round-off [MPa/mm].
    double resolution() const;
    double resolution_at(const double omega) const;

    StabilityLimit limit_without_rate_effect(const double mass) const;

    /// So short that the contact hardly moves before it slips [s].
    double shortest_step() const;

    /// An angular frequency that is too quick for what the law remembers [1/s].
    double quickest() const;

    /// Of what is remembered, relative to it.
    double disturbance(const double time_step) const;

    /// Whether the shortest step goes on as before, disturbed or not.
    bool is_kept() const;

    const FrictionLaw         &law;
    const double               speed;
    const dealii::Tensor<1, 2> direction;
    const double               pressure;
    ContactState               steady;
    bool                       is_steady = false;
  };

  /// One of each velocity and pressure to which a programme slides, the first
  /// ones if there are more than @p most.
  std::vector<Loading> steady_slides(const Programme  &programme,
                                     const std::size_t most);

  /// A warning, in words, of the slide of a programme that is held least by the
  /// contact's own stiffness and the machine, since friction falls: at which
  /// speeds sliding has no stable branch, by which effects, and what helps.
  /// Empty if all are held. Sliding that a machine with a mass makes a motion
  /// is.
  std::vector<std::string> instability_warnings(const FrictionLaw &law,
                                                const Programme   &programme,
                                                const Machine     &machine);

  /// The first of some speeds [mm/s] at which friction falls with speed and
  /// nothing lets it rise at once, so that sliding jumps, in words; "" if there
  /// is none.
  std::string why_no_branch(const FrictionLaw         &law,
                            const std::vector<double> &speeds,
                            const double               pressure);
} // namespace SlipStep

#endif
