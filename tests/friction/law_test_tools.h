#ifndef tests_friction_law_test_tools_h
#define tests_friction_law_test_tools_h

#include <slipstep/friction/law.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace SlipStep::Testing
{
  using Settings = std::vector<std::pair<std::string, std::string>>;

  /// A law with defaults except for the settings (paths below "Friction/").
  inline std::unique_ptr<FrictionLaw> make_law(const Settings &settings)
  {
    Parameters parameters;
    FrictionLaw::declare_parameters(parameters);
    for (const auto &setting : settings)
      parameters.set("Friction/" + setting.first, setting.second, "test");
    return std::make_unique<FrictionLaw>(parameters);
  }

  inline dealii::Tensor<1, 2> vector(const double x, const double y = 0.)
  {
    dealii::Tensor<1, 2> result;
    result[0] = x;
    result[1] = y;
    return result;
  }
} // namespace SlipStep::Testing

#endif
