// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_face_probes_h
#define slipstep_solid_face_probes_h

#include <slipstep/experiment/quantities.h>
#include <slipstep/solid/block_parameters.h>
#include <slipstep/solid/contact_face.h>

#include <vector>

namespace SlipStep
{
  /// Check what only the block can: that points lie on its contact face, and
  /// that the case slides if a slip front is asked for.
  /// @throws InputError
  void check_probes(const Parameters                      &parameters,
                    const BlockParameters                 &block,
                    const std::vector<QuantityOfInterest> &quantities);

  /// Reads the quantities of interest off the contact face.
  ///
  /// The pressure at a point is that of the polynomial through the quadrature
  /// points of its cell, which is the pressure of the finite element solution
  /// there; on a border, the mean of the cells. The slip front is sought among
  /// the quadrature points next to the centre line of the face: from the rear
  /// end forward, the first place between two of them where the loading ratio
  /// crosses the value, linearly interpolated.
  template <int dim>
  class FaceProbes
  {
  public:
    FaceProbes(const BlockParameters &parameters, const Programme &programme);

    /// Value of a probe for the committed state of the face; the same on all
    /// ranks, which all take part.
    double value(const QuantityOfInterest &probe,
                 const ContactFace<dim>   &contact,
                 const MPI_Comm           &communicator) const;

  private:
    double pressure(const ContactFace<dim>    &contact,
                    const std::vector<double> &position,
                    const MPI_Comm            &communicator) const;

    /// Extreme pressure of the contact points.
    double extreme_pressure(const ContactFace<dim> &contact,
                            const bool              is_largest,
                            const MPI_Comm         &communicator) const;

    double slip_front(const ContactFace<dim> &contact,
                      const double            loading_ratio,
                      const MPI_Comm         &communicator) const;

    std::vector<std::pair<double, double>>
    ratios_along_centre_line(const ContactFace<dim> &contact) const;

    const BlockParameters parameters;
    /// Of the contact plane, 0 or 1: along which the block slides first.
    unsigned int sliding_axis    = 0;
    bool         slides_backward = false;
  };
} // namespace SlipStep

#endif
