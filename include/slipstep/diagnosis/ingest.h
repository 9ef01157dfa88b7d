// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_diagnosis_ingest_h
#define slipstep_diagnosis_ingest_h

#include <slipstep/diagnosis/diagnosis.h>
#include <slipstep/diagnosis/search.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace SlipStep
{
  /// What is done, for the user who waits.
  using Stage = std::function<void(const std::string &)>;

  /// A case ready to be diagnosed.
  struct Ingested
  {
    std::unique_ptr<Workspace> workspace;
    Model                      base; ///< the calibrated starting model
    /// Of the starting model as the case has it: root mean square of the
    /// differences, as a share of friction, and the objective.
    double start_rms = 0., start_objective = 0.;
    /// Whether the base has the parameters of the least differences, not the
    /// most plausible ones: those would miss whole tests.
    bool is_kept_near = false;
    /// Tests that contradict their own replicates; they are left out.
    std::vector<Outlier>      outliers;
    std::vector<CampaignTest> outlier_tests;
    std::vector<std::string>  warnings;
  };

  /// The stages ingest, calibrate and noise.
  /// @param left_out names of tests that are to be left out
  /// @throws InputError, RunError if the starting model cannot be simulated
  Ingested ingest(const Parameters               &parameters,
                  const Stage                    &stage,
                  const std::vector<std::string> &left_out = {});

  /// Add to the warnings what the records and their noise are not fit for.
  void warn_of_records(Ingested &ingested);

  /// Compute what is told of the start by the weights that rows have now.
  void weigh_start(Ingested &ingested);

  /// The case with everything that is to be calibrated listed: that which
  /// "Calibration/Parameters" names, else all parameters of active effects.
  Parameters with_parameters_listed(const Parameters &parameters);
} // namespace SlipStep

#endif
