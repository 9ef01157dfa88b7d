// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_error_indicator_h
#define slipstep_solid_error_indicator_h

#include <slipstep/solid/contact_face.h>

#include <vector>

namespace SlipStep
{
  /// Tells how much of the error is in which cell.
  ///
  /// The squared error of a cell K in the energy norm is estimated from what
  /// the computed stress leaves unbalanced, as residual estimators do:
  /// \f[ \eta_K^2 = c \left( \frac{h_K^2}{E} \int_K |\mathrm{div}\,\sigma|^2
  ///   + \sum_{F \subset \partial K} \frac{h_F}{4E} \int_F |[\sigma n]|^2
  ///   + \sum_{F \subset \Gamma} \frac{h_F}{E} \int_F |\sigma n - t|^2
  ///   + \sum_{F \subset \Gamma_c} \frac{h_F}{E} \int_F
  ///     \tau_y^2 (r - \bar r)^2 \right)
  ///   + \sum_{F \subset \Gamma_c} \left( \frac{c\,h_F}{E}
  ///     + \frac{1}{2\alpha_t} \right) \int_F s (1 - s) |f_t|^2 \f]
  /// with the jumps of traction between cells, the misfit between stress and
  /// the given traction t on the boundary (in the directions that are free) or
  /// the traction of the contact, and the border between stick and slip: the
  /// loading ratio r varies about its mean, and a share s of the face slips,
  /// neither none nor all; where within the face is not known, which leaves
  /// that much traction in doubt to block and contact stiffness. All terms are
  /// energies, so they add. c = 1/6 is a choice; h are diameters.
  template <int dim>
  class ErrorIndicator
  {
  public:
    explicit ErrorIndicator(const BlockParameters &parameters)
      : parameters(parameters)
    {}

    /// Squared error of every active cell of this rank's part of the mesh by
    /// active cell index [N mm]; 0 for cells of other ranks.
    /// @param displacement ghosted [mm]
    /// @param contact updated with this displacement
    /// @param loads that act
    std::vector<double>
    squared_errors(const dealii::DoFHandler<dim> &dof_handler,
                   const Vector                  &displacement,
                   const ContactFace<dim>        &contact,
                   const LoadFactors             &loads) const;

  private:
    class Evaluation;

    const BlockParameters parameters;
  };
} // namespace SlipStep

#endif
