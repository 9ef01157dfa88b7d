// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_experiment_contact_under_load_h
#define slipstep_experiment_contact_under_load_h

#include <slipstep/friction/contact_point.h>

#include <optional>
#include <string>

namespace SlipStep
{
  /// One stage of a contact point, of which only the slip is left to find.
  struct ContactStage
  {
    const FrictionLaw &law;
    ContactPoint      &point;
    const double       normal_traction; ///< at its end [MPa]
    const double       time_step;       ///< [s]

    ContactResponse update(const dealii::Tensor<1, 2> &slip) const
    {
      return point.update(law, slip, normal_traction, time_step);
    }

    /// Traction with which it starts, none of a contact that is open [MPa].
    dealii::Tensor<1, 2> start() const
    {
      return normal_traction > 0. ? point.stage_traction() :
                                    dealii::Tensor<1, 2>();
    }
  };

  /// The stage under a given traction: the law, which gives the traction of a
  /// slip, is inverted.
  ///
  /// Without a core, the law leaves the traction along its elastic trial, so
  /// that is s times the load with s of at least 1, at which nothing slips. The
  /// first s is taken from there at which the law holds the load.
  /// @param load tangential traction at the end of the stage [MPa]
  /// @param[out] slip in the stage [mm]
  /// @return nothing if the contact holds no such load
  std::optional<ContactResponse> push_contact(const ContactStage         &stage,
                                              const dealii::Tensor<1, 2> &load,
                                              dealii::Tensor<1, 2>       &slip);

  /// The stage at the end of a spring, for any law: the slip s for which f_t(s)
  /// + k s is a given force, by Newton's method in the plane. It needs a law
  /// whose traction grows with slip.
  /// @param stiffness k of the spring [MPa/mm], 0 for none
  /// @param force [MPa]
  /// @param[out] slip in the stage [mm]
  /// @return nothing if there is no such slip in sight
  std::optional<ContactResponse> pull_contact(const ContactStage &stage,
                                              const double        stiffness,
                                              const dealii::Tensor<1, 2> &force,
                                              dealii::Tensor<1, 2>       &slip);

  /// Slip [mm/s] at which a contact under a load, without any mass, has given
  /// way: no wave goes much faster through a solid.
  constexpr double fastest_slip = 1e6;

  /// Why a push ends a run.
  /// @param wanted by the programme [MPa]
  /// @param held last load that was [MPa]
  /// @param pressure at which it was [MPa]
  std::string reason_of_slip(const dealii::Tensor<1, 2> &wanted,
                             const dealii::Tensor<1, 2> &held,
                             const double                pressure);
} // namespace SlipStep

#endif
