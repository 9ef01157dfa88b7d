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
} // namespace SlipStep
