// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_experiment_work_estimate_h
#define slipstep_experiment_work_estimate_h

#include <slipstep/experiment/programme.h>
#include <slipstep/utilities/time_left.h>

#include <array>
#include <limits>
#include <vector>

namespace SlipStep
{
  /// How much of the work of a programme is done at a time, and how long the
  /// rest takes.
  ///
  /// The share of the work is a guess. Time itself would be a bad one: a slide
  /// begins with tiny steps, which then grow about in proportion to the time
  /// since it began; so equal factors of that time are taken as equal work. A
  /// statement that slides counts ten times as much as one that does not.
  ///
  /// The time left does not come from this guess. It is measured: from the rate
  /// at which the present statement goes on, and from what statements like
  /// those to come have taken. As long as that does not tell (while steps still
  /// grow, or before a slide that has no like), there is none.
  class WorkEstimate
  {
  public:
    explicit WorkEstimate(const Programme &programme);

    /// Share of the work that is done when the step that ends at @p time [s] is
    /// made, from 0 to 1. Times come in increasing order.
    double share_done(const double time);

    /// What has been done so far was done before the clock started.
    void resume();

    /// The time left [s] after this step, or NaN if it cannot be told within a
    /// factor of 1.5. To be called after share_done().
    /// @param time of the programme [s]
    /// @param now since the work began, on the clock [s]
    double time_left(const double time, const double now);

  private:
    struct Statement
    {
      double start_time = 0.;
      double end_time   = 0.;
      double work       = 1.;
      /// Replayed tests have no beginning of a slide.
      bool        is_slide = false;
      std::size_t kind     = 0;
      /// Where its segments end; the rows of a replayed test are its work.
      std::vector<double> ends;
    };

    /// Statements that do the same, as in cycles.
    struct Kind
    {
      /// Duration, distance, pressures, number of segments.
      std::array<double, 5> what;
      unsigned int          n_to_come = 0;
      double                cost = 0.; ///< of the last one [s]; 0: none yet

      // A replayed test may come back to where it began.
      bool is_rest() const
      {
        return what[1] == 0. && what[4] == 1.;
      }
    };

    std::size_t find_kind(const Segment &first, const Segment &last);
    void        start_statement(const double now);
    double      position(const double time) const;
    TimeRange   left_of_present(const double now) const;
    TimeRange   cost_of(const Kind &kind) const;

    std::vector<Statement> statements;
    std::vector<Kind>      kinds;
    std::size_t            present     = 0;
    double                 first_step  = 0.;
    double                 work_before = 0., total_work = 0.;

    std::size_t  timed = 0; ///< statement to which the watch belongs
    double       began = 0.;
    bool         is_timed_from_start = true;
    RateWatch    watch;
    CautiousTime forecast;
    double       forecast_at = 0.;
    double       told        = std::numeric_limits<double>::quiet_NaN();
  };
} // namespace SlipStep

#endif
