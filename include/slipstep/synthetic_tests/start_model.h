// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_synthetic_tests_start_model_h
#define slipstep_synthetic_tests_start_model_h

#include <slipstep/synthetic_tests/true_contact.h>

#include <string>
#include <vector>

namespace SlipStep
{
  namespace Planting
  {
    /// A contact with subloading, overstress and softening like the source
    /// paper's: mu_s about 0.13, mu_k about 0.1, a fall within 1 to 20 mm,
    /// eta_v and n such that the speeds of a campaign tell them.
    TrueContact draw_base(Random &random);

    /// What draw_base() chose, by the paths of a case file, as far as the
    /// contact still has it in the formulas of the catalogue.
    std::vector<TruthParameter> base_parameters(const TrueContact &contact);

    /// A case file that knows nothing of the hidden effects: what is fitted is
    /// set wrong by 10 to 40 %, what is not is right.
    std::string start_model(const TrueContact              &contact,
                            const std::vector<std::string> &hidden,
                            Random                         &random);
  } // namespace Planting
} // namespace SlipStep

#endif
