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
        " test(s) hang together (correlation of neighbours up to " +
        short_text(decay, 2) +
        "): they tell as much as fewer rows would, and are weighed so.");
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
           "unless the records were smoothed, that is too much, and what is "
           "missing may hide in it." :
           "that is too little, and chance may be taken for an effect."));
    }



    void warn_of_hum(Ingested &result)
    {
      const HumOfTests hum =
        hum_of(result.workspace->comparison, result.workspace->tests);
      if (hum.n_told == 0)
        return;
      result.warnings.push_back(
        (hum.is_mains ? "The mains hum" : "A wave in time hums") +
        std::string(" in the friction of ") + std::to_string(hum.n_told) +
        " test(s): " + rounded_text(hum.frequency, 3) + " Hz, " +
        rounded_text(100. * hum.share, 2) +
        " % of friction. It is taken off, and what looks like it counts as "
        "noise. " +
        (hum.is_mains ?
           "Rows that are further apart than " +
             rounded_text(500. / hum.frequency, 2) +
             " ms see it as a slower wave: a low-pass filter before the "
             "recorder helps." :
           "Replicates differ by it, at several speeds: the mains look so "
           "where rows are nearly in step with them, or it is the "
           "recorder's."));
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
        "The measured temperature goes from " + short_text(lowest, 3) + " to " +
        short_text(highest, 3) +
        " degC: no effect reads it, so that what it does to friction has no "
        "name here.");
    }
  } // namespace



  void warn_of_records(Ingested &ingested)
  {
    const Workspace &workspace = *ingested.workspace;
    const double     rms = relative_rms(workspace.comparison, ingested.base);
    if (rms > 1.02 * ingested.start_rms)
      ingested.warnings.push_back(
        "Calibrated, the starting model is farther from the tests than "
        "before: the stated noise lets whole tests be off, or its parameters "
        "have to start elsewhere.");
    warn_of_hum(ingested);
    warn_of_stated_noise(ingested);
    warn_of_rows(ingested);
    warn_of_temperatures(ingested);
    if (ingested.is_kept_near)
      ingested.warnings.push_back(
        "The law is so far from these tests that the most plausible "
        "parameters would miss whole tests for the sake of few rows: those "
        "of the least differences are taken.");
    // Without a gap they are about the same.
    if (difference_of_replicates(ingested) > 1.5 * rms)
      ingested.warnings.push_back(
        "Replicates differ by more than the model does from the tests: they "
        "may not be repetitions, and little can be told.");
  }
} // namespace SlipStep
