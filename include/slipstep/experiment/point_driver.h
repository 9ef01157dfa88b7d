// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_experiment_point_driver_h
#define slipstep_experiment_point_driver_h

#include <slipstep/experiment/history.h>
#include <slipstep/experiment/machine.h>
#include <slipstep/experiment/step_control.h>
#include <slipstep/friction/law.h>

#include <functional>
#include <vector>

namespace SlipStep
{
  /// Declares section "Loading" and "Time stepping".
  void declare_loading_parameters(Parameters &parameters);

  /// The programme of a case.
  /// @throws InputError, also when no step of it ever presses
  Programme parse_programme(const Parameters &parameters);

  /// The same case for a file in @p folder: names of measured tests are
  /// relative to it.
  Parameters relocated_case(const Parameters            &parameters,
                            const std::filesystem::path &folder);

  /// Drive one contact point of 1 mm^2 through a programme: normal traction and
  /// the displacement of the load point are those of the programme, and with a
  /// rigid machine the load point is the contact.
  /// @param observe called with the row of every step made
  /// @return the control, which has counted the steps
  StepControl
  drive_point(const FrictionLaw                             &law,
              const Programme                               &programme,
              StepControl                                    control,
              const std::function<void(const HistoryRow &)> &observe,
              const Machine                                 &machine = {});
} // namespace SlipStep

#endif
