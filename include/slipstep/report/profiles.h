// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_profiles_h
#define slipstep_report_profiles_h

#include <slipstep/calibration/calibration.h>
#include <slipstep/report/page.h>

namespace SlipStep
{
  /// The profile likelihood of a parameter, as pictures show it: values in its
  /// unit, the increase over the threshold.
  struct DrawnProfile : ProfileInterval
  {
    std::string name, unit;
    /// Whether the parameter is fitted by its logarithm.
    bool is_logarithmic = false;
    /// Where the search ends.
    double lower_bound = -std::numeric_limits<double>::infinity();
    double upper_bound = std::numeric_limits<double>::infinity();
    /// Distance to the threshold by the curvature alone, of the value or of its
    /// logarithm; infinite if unknown.
    double distance = std::numeric_limits<double>::infinity();
  };

  /// How the misfit grows when one parameter is held at other values and the
  /// others are fitted again, as HTML; profiles of one point are left out.
  std::string draw_profiles(Page                            &page,
                            const std::string               &title,
                            const std::vector<DrawnProfile> &profiles,
                            const double                     confidence);
} // namespace SlipStep

#endif
