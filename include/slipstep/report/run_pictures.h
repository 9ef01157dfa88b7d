// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_run_pictures_h
#define slipstep_report_run_pictures_h

#include <slipstep/report/run_figures.h>

namespace SlipStep
{
  /// Names that "Report/Pictures" knows, separated by commas.
  std::string picture_quantity_names();

  /// Check "Report/Pictures".
  /// @throws InputError for what is not "QUANTITY over QUANTITY"
  void check_pictures(const Parameters &parameters);

  /// Draw what "Report/Pictures" names, all runs in one; what the runs have no
  /// values of is left out with a warning.
  void add_requested_pictures(const std::filesystem::path   &folder,
                              const Parameters              &parameters,
                              const std::vector<RunResults> &runs,
                              const Reference               &reference,
                              std::vector<Picture>          &pictures,
                              std::vector<std::string>      &warnings);
} // namespace SlipStep

#endif
