// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_synthetic_tests_true_contact_h
#define slipstep_synthetic_tests_true_contact_h

#include <slipstep/measured_data/measured_test.h>
#include <slipstep/synthetic_tests/influence.h>

#include <limits>
#include <vector>

namespace SlipStep
{
  namespace Planting
  {
    /// Slip rate of an overstress.
    struct FlowRule
    {
      /// Catalogue: \f$\lambda = (e^{n(r-r_s)} - 1) / (\eta (r_m - r))\f$, eq.
      /// 3 of the source paper. Alternative: \f$\lambda = V_0
      /// \sinh((r-r_s)/A)\f$, thermally activated slip; Eyring (1936), J. Chem.
      /// Phys. 4, 283. Third: \f$\lambda = V_0 (e^{(r-r_s)/A} - 1)\f$.
      Formula formula       = Formula::catalogue;
      double  viscosity     = 500.;  ///< eta [s/mm]
      double  exponent      = 16.52; ///< n; 1/A in the alternative
      double  maximum_ratio = 1.8;   ///< r_m
      double  base_speed    = 0.01;  ///< V_0 [mm/s]

      /// lambda [mm/s]
      double slip_rate(const double ratio, const double normal_ratio) const;

      /// r of steady sliding [speed in mm/s].
      double steady_ratio(const double speed) const;
    };

    /// Evolution of mu in slip and at rest.
    struct CoefficientRule
    {
      double static_coefficient  = 0.13; ///< mu_s
      double kinetic_coefficient = 0.10; ///< mu_k

      /// Catalogue: \f$d\mu/d\lambda = -\kappa (e^{a(\mu-\mu_k)} - 1)\f$, eq. 2
      /// of the source paper. Alternative: \f$d\mu/d\lambda = -(\mu-\mu_k)^2 /
      /// (L (\mu_s-\mu_k))\f$, a fall with 1/(1 + slip/L).
      Formula softening = Formula::catalogue;
      double  rate      = 0.3; ///< kappa [1/mm]
      double  steepness = 1.;  ///< a
      double  length    = 3.;  ///< L [mm]

      double healing_rate      = 0.; ///< xi [1/s], eq. 2, second term
      double healing_steepness = 1.; ///< b

      /// d mu / d lambda [1/mm]
      double per_slip(const double coefficient) const;

      /// d mu / dt [1/s]
      double per_time(const double coefficient) const;
    };

    /// The truth of a campaign: a contact point with all that acts on it.
    ///
    /// \f$\dot f_t = \alpha_t (V - \lambda f_t/|f_t|)\f$, \f$r =
    /// |f_t|/\tau_y\f$, \f$\dot r_s = u \cot(\pi r_s/2) \lambda\f$ while it
    /// slips, and r_s = r whenever r falls below r_s.
    struct TrueContact
    {
      double          stiffness       = 1000.; ///< alpha_t [MPa/mm]
      double          subloading_rate = 200.;  ///< u [1/mm]
      FlowRule        flow;
      CoefficientRule coefficient;

      std::vector<Influence> influences;

      /// @name Give the strength a factor G or an addition c [MPa].
      ///@{
      void multiply(const OfInstant &factor);
      void add(const OfInstant &addition);
      /// Of the slip rate [mm/s], which follows from the strength in turn.
      void multiply_at_speed(const OfNumber &factor);
      void add_at_speed(const OfNumber &addition);
      /// A factor that gets a number which the contact remembers.
      /// @param rate of that number [1/s]
      /// @param first its value under the first pressure [MPa]; 0 if empty
      void remember(const OfMemory &rate,
                    const OfMemory &factor,
                    const OfNumber &first = {});
      ///@}

      /// @name Elliptic cone: ratio of the axes, angle of the first [rad].
      ///@{
      double anisotropy_ratio = 1.;
      double anisotropy_angle = 0.;
      ///@}

      /// @name Spring in series: displacement per traction [mm/MPa], which
      /// falls with the traction if that at which it is half is finite [MPa].
      ///@{
      double compliance          = 0.;
      double stiffening_traction = std::numeric_limits<double>::infinity();
      ///@}

      /// All the same to the contact but for influences of the run order.
      double progress = 0.;
    };

    /// Friction at the rows of a test, along both axes.
    struct TrueFriction
    {
      std::vector<double> along_x;
      std::vector<double> along_y;
    };

    /// Lead a virgin contact through the motion and the pressure of a test,
    /// both straight lines between its rows.
    /// @param tolerance of a step, relative
    /// @throws RunError if no step is small enough
    TrueFriction simulate(const TrueContact  &contact,
                          const MeasuredTest &motion,
                          const double        tolerance = 1e-6);
  } // namespace Planting
} // namespace SlipStep

#endif
