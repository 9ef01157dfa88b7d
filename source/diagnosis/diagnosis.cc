// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/diagnosis.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  std::string name_of(const Verdict verdict)
  {
    static const char *const names[] = {
      "named", "ambiguous", "unnamed", "no_gap", "not_testable"};
    static_assert(sizeof(names) / sizeof(*names) ==
                  static_cast<unsigned int>(Verdict::not_testable) + 1);
    return names[static_cast<unsigned int>(verdict)];
  }



  std::string name_of(const Standing standing)
  {
    static const char *const names[] = {"named",
                                        "rival",
                                        "not needed",
                                        "not enough",
                                        "undecided",
                                        "rejected",
                                        "not tried",
                                        "not simulated",
                                        "not testable",
                                        "in the model"};
    static_assert(sizeof(names) / sizeof(*names) ==
                  static_cast<unsigned int>(Standing::in_the_model) + 1);
    return names[static_cast<unsigned int>(standing)];
  }



  bool Shrink::hardly_predicts() const
  {
    const auto beyond_noise = [this](const double gap) {
      return std::sqrt(std::max(0., gap * gap - noise_floor * noise_floor));
    };
    return systematic_before > 0. &&
           systematic_after <= hardly_less * systematic_before &&
           beyond_noise(left_out_after) >
             hardly_less * beyond_noise(left_out_before);
  }



  bool was_left_out(const Standing standing)
  {
    return standing == Standing::not_tried ||
           standing == Standing::not_simulated ||
           standing == Standing::not_testable;
  }
} // namespace SlipStep
