// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_synthetic_tests_answer_h
#define slipstep_synthetic_tests_answer_h

#include <slipstep/synthetic_tests/planted_campaign.h>

#include <filesystem>
#include <string>

namespace SlipStep
{
  namespace Planting
  {
    /// What was planted, as JSON: class and seed, hidden effects with formula
    /// and parameters, the base, the noise, the tests in the order of their
    /// run.
    std::string answer_json(const PlantedCampaign &campaign);

    /// Not to be read by accident: base64 under a line that tells how to open
    /// it.
    std::string sealed(const std::string &text);

    /// The text that was sealed.
    /// @throws InputError if the file is missing or not of this kind
    std::string open_sealed(const std::filesystem::path &file);
  } // namespace Planting
} // namespace SlipStep

#endif
