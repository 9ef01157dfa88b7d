// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_report_curves_h
#define slipstep_report_curves_h

#include <slipstep/report/page.h>

namespace SlipStep
{
  /// Friction of a test along one axis, as pictures show it.
  struct DrawnTest
  {
    std::string         name;
    std::string         condition;    ///< tests of the same share a picture
    std::vector<double> time;         ///< [s]
    std::vector<double> displacement; ///< [mm]
    std::vector<double> measured;
    /// Simulated: `before` only if there are two simulations.
    std::vector<double> before, simulated;
    double              noise = 0.; ///< standard deviation of a row
    double              gap   = 0.; ///< how badly the test is met, in any unit
    /// Rows where friction rises or falls steeply; may be empty.
    std::vector<bool> is_flank;
  };

  /// The picture of a condition.
  struct ConditionFrame
  {
    std::string                    title;
    std::vector<const DrawnTest *> tests;
    /// What comes back would lie on top of itself over displacement.
    bool   is_over_time = false;
    Range  x;
    double gap = 0.; ///< the largest of the tests
    /// Columns of pixels per curve.
    std::size_t n_columns = 0;

    const std::vector<double> &abscissa(const DrawnTest &test) const
    {
      return is_over_time ? test.time : test.displacement;
    }

    /// Curve of a test, without what is outside of the frame, and of many rows
    /// only those that a reader could see. NaN are left out.
    Rows rows(const DrawnTest &test, const std::vector<double> &values) const;

    /// Axis of the picture.
    void
    axes(SmallPicture &picture, const std::string &label, const Range &y) const;
  };

  /// A frame per condition, as the tests come; of too many those that are met
  /// worst. They point into the tests.
  /// @param caption what has to be said of them
  std::vector<ConditionFrame>
  condition_frames(const std::vector<DrawnTest> &tests, std::string &caption);

  inline bool has_replicates(const ConditionFrame &frame)
  {
    return frame.tests.size() > 1;
  }

  extern const LegendLine measured_line, replicate_line, before_line,
    noise_band_line;

  /// Measured and simulated friction with the noise, a picture per frame, as
  /// HTML.
  /// @param name of the files; "_1" and so on is added
  /// @param simulated what the legend calls the last simulation
  std::string draw_friction(Page                              &page,
                            const std::string                 &name,
                            const std::string                 &title,
                            const std::string                 &caption,
                            const std::vector<ConditionFrame> &frames,
                            const std::string                 &simulated);

  /// What is left over of the measured friction, against the noise.
  std::string draw_residuals(Page                              &page,
                             const std::vector<ConditionFrame> &frames);

  /// An axis from zero, unless that would hide the difference.
  Range with_zero(Range y);
} // namespace SlipStep

#endif
