// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/diagnosis.h>

namespace SlipStep
{
  std::string name_of(const Verdict verdict)
  {
    switch (verdict)
      {
        case Verdict::named:
          return "named";
        case Verdict::ambiguous:
          return "ambiguous";
        case Verdict::unnamed:
          return "unnamed";
        case Verdict::no_gap:
          return "no_gap";
        case Verdict::not_testable:
          return "not_testable";
      }
    return "";
  }



  std::string name_of(const Standing standing)
  {
    switch (standing)
      {
        case Standing::named:
          return "named";
        case Standing::rival:
          return "rival";
        case Standing::not_needed:
          return "not needed";
        case Standing::not_enough:
          return "not enough";
        case Standing::rejected:
          return "rejected";
        case Standing::not_simulated:
          return "not simulated";
        case Standing::not_testable:
          return "not testable";
        case Standing::in_the_model:
          return "in the model";
      }
    return "";
  }
} // namespace SlipStep
