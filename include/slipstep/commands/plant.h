// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_commands_plant_h
#define slipstep_commands_plant_h

#include <slipstep/utilities/command_line.h>

namespace SlipStep
{
  /// The command `slipstep plant FOLDER`: make a campaign of tests with a
  /// hidden effect, FOLDER/case.prm, FOLDER/measured/*.csv and
  /// FOLDER/answer.sealed; or `slipstep plant --open FILE`: print such an
  /// answer.
  ///
  /// Nothing is written before everything is computed, and never into a folder
  /// that has something in it.
  /// @return exit code
  int plant(const CommandLine &line);
} // namespace SlipStep

#endif
