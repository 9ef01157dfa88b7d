// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_run_grid_h
#define slipstep_report_run_grid_h

#include <slipstep/report/run_figures.h>

namespace SlipStep
{
  /// Draw peak and kinetic friction as heat maps if the runs are all
  /// combinations of the values of two keys.
  void add_grid_pictures(const std::filesystem::path   &folder,
                         const Parameters              &parameters,
                         const std::vector<RunResults> &runs,
                         const Reference               &reference,
                         std::vector<Picture>          &pictures,
                         std::vector<std::string>      &warnings);
} // namespace SlipStep

#endif
