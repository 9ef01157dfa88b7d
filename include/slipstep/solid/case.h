#ifndef slipstep_solid_case_h
#define slipstep_solid_case_h

#include <slipstep/utilities/parameters.h>

namespace SlipStep
{
  /// Declare the parameters of all rooms, in the order in which they are
  /// printed.
  void declare_all_parameters(Parameters &parameters);

  /// Read everything that a case says as run() and point() would, without
  /// computing.
  /// @throws InputError
  void check_case(const Parameters &parameters);
} // namespace SlipStep

#endif
