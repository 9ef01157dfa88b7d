#ifndef slipstep_experiment_import_tests_h
#define slipstep_experiment_import_tests_h

#include <slipstep/utilities/command_line.h>

namespace SlipStep
{
  /// The command `slipstep import MAP.prm [RAW]`: convert files of instruments
  /// into measured tests, one per variant of the map. RAW is the file, or the
  /// folder of the files, instead of the folder of the map.
  ///
  /// The tests go into the folder `measured` beside the map, or that of
  /// --output. Nothing is written before all of them are converted and fit
  /// together, see check_conditions().
  /// @return exit code
  int import_tests(const CommandLine &line);
} // namespace SlipStep

#endif
