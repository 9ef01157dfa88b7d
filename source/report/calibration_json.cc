// SPDX-License-Identifier: LGPL-2.1-or-later

// calibration.json: a stable format, see tests/calibration.

#include <slipstep/report/calibration_report.h>

#include <slipstep/utilities/json_file.h>
#include <slipstep/utilities/version.h>

namespace SlipStep
{
  namespace
  {
    using json = nlohmann::ordered_json;

    /// Logarithmic scales count in natural logarithms, which have no unit.
    double change_in_unit(const FitParameter &parameter, const double change)
    {
      return parameter.is_logarithmic ? change : parameter.in_unit(change);
    }

    json to_json(const FittedParameter &fitted)
    {
      const FitParameter &parameter = fitted.parameter;
      json                profile   = json::array();
      for (const auto &[value, ratio] : fitted.profile)
        profile.push_back(json::array({parameter.in_unit(value), ratio}));
      return {{"path", parameter.path},
              {"unit", parameter.unit()},
              {"value", parameter.in_unit(fitted.value)},
              {"start", parameter.in_unit(parameter.start)},
              {"lower_bound", parameter.in_unit(parameter.lower)},
              {"upper_bound", parameter.in_unit(parameter.upper)},
              {"scale", parameter.is_logarithmic ? "logarithmic" : "linear"},
              {"deviation", change_in_unit(parameter, fitted.deviation)},
              {"interval",
               {{"lower", parameter.in_unit(fitted.lower)},
                {"upper", parameter.in_unit(fitted.upper)},
                {"lower_open", fitted.is_lower_open},
                {"upper_open", fitted.is_upper_open}}},
              {"at_bound", fitted.is_at_bound},
              {"constraint", fitted.constraint},
              {"profile", profile}};
    }

    json to_json(const DerivedQuantity &quantity)
    {
      return {{"name", quantity.name},
              {"formula", quantity.formula},
              {"value", quantity.value},
              {"deviation", quantity.deviation}};
    }

    json to_json(const TestMisfit &test)
    {
      return {{"name", test.name},
              {"condition", test.condition},
              {"file", test.file},
              {"rows", test.n_rows},
              {"noise", test.noise},
              {"noise_stated", test.noise_is_stated},
              {"rms", test.rms},
              {"start_rms", test.start_rms},
              {"mean", test.mean},
              {"correlation_length", test.correlation_length},
              {"measured_work", test.measured_work},
              {"simulated_work", test.simulated_work}};
    }

    json to_json(const WeakDirection                &direction,
                 const std::vector<FittedParameter> &parameters)
    {
      json paths = json::array(), change = json::array();
      for (const std::size_t i : direction.members)
        {
          const FitParameter &parameter = parameters[i].parameter;
          paths.push_back(parameter.path);
          change.push_back(change_in_unit(parameter, direction.change[i]));
        }
      return {{"parameters", paths},
              {"change", change},
              {"words", direction.words}};
    }

    json to_json(const StartResult                  &start,
                 const std::vector<FittedParameter> &parameters)
    {
      const auto in_units = [&](const std::vector<double> &values) {
        json result = json::array();
        for (std::size_t i = 0; i < values.size(); ++i)
          result.push_back(parameters[i].parameter.in_unit(values[i]));
        return result;
      };
      return {{"start", in_units(start.start)},
              {"end", in_units(start.end)},
              {"misfit", start.misfit},
              {"iterations", start.iterations},
              {"message", start.message}};
    }

    /// @param more what an element needs to be understood
    template <typename Element, typename... More>
    json list(const std::vector<Element> &elements, const More &...more)
    {
      json result = json::array();
      for (const Element &element : elements)
        result.push_back(to_json(element, more...));
      return result;
    }
  } // namespace



  void write_calibration_json(const std::filesystem::path &file,
                              const Parameters            &parameters,
                              const Calibration           &calibration)
  {
    const json object = {
      {"version", version()},
      {"git_hash", git_hash()},
      {"case", parameters.case_file().stem().string()},
      {"confidence", calibration.confidence},
      {"parameters", list(calibration.parameters)},
      {"derived", list(calibration.derived)},
      {"tests", list(calibration.tests)},
      {"correlation", calibration.correlation},
      {"weak_directions", list(calibration.weak, calibration.parameters)},
      {"starts", list(calibration.starts, calibration.parameters)},
      {"misfit", calibration.misfit},
      {"start_misfit", calibration.start_misfit},
      {"rows", calibration.n_rows},
      {"effective_rows", calibration.n_effective},
      {"inflation", calibration.inflation},
      {"simulations", calibration.n_simulations},
      {"steps", calibration.n_steps},
      {"wall_s", calibration.wall_time},
      {"cpu_s", calibration.cpu_time},
      {"warnings", calibration.warnings}};
    write_json(file, object);
  }
} // namespace SlipStep
