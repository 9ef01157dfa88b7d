#ifndef slipstep_experiment_work_estimate_h
#define slipstep_experiment_work_estimate_h

#include <slipstep/experiment/programme.h>

#include <vector>

namespace SlipStep
{
  /// How much of the work of a programme is done at a time: a guess for the
  /// progress line. Time itself would be a bad one. A slide begins with tiny
  /// steps, which then grow about in proportion to the time since it began; so
  /// equal factors of that time are taken as equal work. A statement that
  /// slides counts ten times as much as one that does not.
  class WorkEstimate
  {
  public:
    explicit WorkEstimate(const Programme &programme);

    /// Share of the work that is done when the step that ends at @p time [s] is
    /// made, from 0 to 1. Times come in increasing order.
    double share_done(const double time);

  private:
    struct Statement
    {
      double start_time = 0.;
      double end_time   = 0.;
      double work       = 1.;
      /// Replayed tests have no beginning of a slide.
      bool is_slide = false;
    };

    std::vector<Statement> statements;
    std::size_t            present    = 0;
    double                 first_step = 0.;
    double                 work_before, total_work;
  };
} // namespace SlipStep

#endif
