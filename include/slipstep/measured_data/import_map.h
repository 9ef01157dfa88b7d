// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_measured_data_import_map_h
#define slipstep_measured_data_import_map_h

#include <slipstep/utilities/parameters.h>

namespace SlipStep
{
  /// The keys of a map, a .prm file that says how the file of an instrument is
  /// to be read: its columns with their units, what it does not record, what
  /// its signs mean. Variants or wildcards convert several files by one map.
  void declare_import_parameters(Parameters &parameters);
} // namespace SlipStep

#endif
