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

  /// Refuse a block that this machine, or @p n_processes of its kind, cannot
  /// hold in memory.
  /// @throws InputError
  void check_memory(const Parameters  &parameters,
                    const unsigned int n_processes);
} // namespace SlipStep

#endif
