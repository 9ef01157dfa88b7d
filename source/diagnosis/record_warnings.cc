// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/hum_of_tests.h>
#include <slipstep/diagnosis/ingest.h>

#include <slipstep/measured_data/test_rows.h>
#include <slipstep/utilities/text.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace SlipStep
{
  namespace
  {
    void warn_of_rows(Ingested &result)
    {
      std::size_t n     = 0;
      double      decay = 0.;
      for (const ComparedTest &test : result.workspace->comparison.tests)
        if (test.series[0].row_share > 0.)
          {
            ++n;
            decay = std::max(decay,
                             test.series[0].row_share *
                               test.series[0].row_kept(
                                 result.workspace->noise.noise));
          }
      if (n == 0)
        return;
      result.warnings.push_back(
        "The rows of " + std::to_string(n) +
        " test(s) are not independent (correlation of neighbours up to " +
        short_text(decay, 2) +
        "): they carry as much information as fewer rows would, and are "
        "weighted accordingly.");
    }



    // Where too much is stated, what is missing hides in it.
    void warn_of_stated_noise(Ingested &result)
    {
      constexpr double too_much = 0.2, too_little = 2.;

      const double scatter = scatter_over_stated(result.workspace->tests);
      if (scatter >= too_much && scatter <= too_little)
        return;
      result.warnings.push_back(
        std::string("Neighbouring rows scatter by ") +
        (scatter < too_much ? "only " : "") + rounded_text(scatter, 2) +
        " times the noise that is stated (Calibration/Noise, or '# noise' in a "
        "test): " +
        (scatter < too_much ?
           "unless the records were smoothed, the stated noise is too large "
           "and may hide a missing effect." :
           "the stated noise is too small, and chance may be taken for an "
           "effect."));
    }



    void warn_of_hum(Ingested &result)
    {
      const HumOfTests hum =
        hum_of(result.workspace->comparison, result.workspace->tests);
      if (hum.n_told == 0)
        return;
      result.warnings.push_back(
        (hum.is_mains ? "Mains hum is present" : "A wave in time is present") +
        std::string(" in the friction of ") + std::to_string(hum.n_told) +
        " test(s): " + rounded_text(hum.frequency, 3) + " Hz, " +
        rounded_text(100. * hum.share, 2) +
        " % of friction. It is removed, and whatever looks like it counts as "
        "noise. " +
        (hum.is_mains ?
           "Rows that are further apart than " +
             rounded_text(500. / hum.frequency, 2) +
             " ms record it as a slower wave (aliasing): a low-pass filter "
             "before the recorder helps." :
           "Replicates differ by it, at several speeds: it is mains hum "
           "sampled nearly in step with it, or hum of the recorder."));
    }



    // Of one replicate, root mean square over friction; 0 without any.
    double difference_of_replicates(const Ingested &result)
    {
      const Comparison &comparison = result.workspace->comparison;
      double            squares    = 0.;
      Eigen::Index      n          = 0;
      for (const Contrast &contrast :
           comparison.contrasts(comparison.difference(result.base)))
        {
          squares +=
            contrast.values.squaredNorm() / std::pow(contrast.level, 2);
          n += contrast.values.size();
        }
      return n > 0 ? std::sqrt(squares / n) : 0.;
    }



    // Heating knows the rise that it makes, nothing reads what was measured.
    void warn_of_temperatures(Ingested &result)
    {
      constexpr double noticed = 5.; // K

      double lowest  = std::numeric_limits<double>::infinity();
      double highest = -lowest;
      for (const CampaignTest &test : result.workspace->tests)
        for (const double temperature : test.rows.temperature)
          {
            lowest  = std::min(lowest, temperature);
            highest = std::max(highest, temperature);
          }
      if (!(highest - lowest > noticed))
        return;
      result.warnings.push_back(
        "The measured temperature ranges from " + short_text(lowest, 3) +
        " to " + short_text(highest, 3) +
        " degC: no effect uses it, so that its influence on friction cannot "
        "be named here.");
    }
  } // namespace



  void warn_of_records(Ingested &ingested)
  {
    const Workspace &workspace = *ingested.workspace;
    const double     rms = relative_rms(workspace.comparison, ingested.base);
    if (rms > 1.02 * ingested.start_rms)
      ingested.warnings.push_back(
        "After calibration the starting model is farther from the tests than "
        "before: the stated noise allows whole tests to be off, or the fit of "
        "its parameters needs other start values.");
    warn_of_hum(ingested);
    warn_of_stated_noise(ingested);
    warn_of_rows(ingested);
    warn_of_temperatures(ingested);
    if (ingested.is_kept_near)
      ingested.warnings.push_back(
        "The law is so far from these tests that the most plausible "
        "parameters would miss whole tests for the sake of a few rows: those "
        "with the least differences are used instead.");
    // Without a gap they are about the same.
    if (difference_of_replicates(ingested) > 1.5 * rms)
      ingested.warnings.push_back(
        "Replicates differ from one another by more than the model does from "
        "the tests: they may not be true repetitions, and little can be "
        "concluded.");
  }
} // namespace SlipStep
