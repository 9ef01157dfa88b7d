#include <slipstep/calibration/fit_parameter.h>
#include <slipstep/diagnosis/candidate_makers.h>

#include <algorithm>

namespace SlipStep
{
  std::vector<std::string> candidate_names()
  {
    std::vector<std::string> names;
    for (const auto &maker : candidate_makers())
      names.push_back(maker.first);
    return names;
  }



  std::vector<Candidate> make_candidates(const Parameters  &parameters,
                                         const TestedRange &range)
  {
    const Circumstances      now{parameters, range};
    std::vector<std::string> wanted = parameters.list("Diagnosis/Candidates");
    if (wanted.size() == 1 && wanted[0] == "all")
      wanted = candidate_names();
    std::vector<Candidate> result;
    for (const auto &maker : candidate_makers())
      if (std::find(wanted.begin(), wanted.end(), maker.first) != wanted.end())
        {
          // Those with keys of their own are in the model or not.
          const bool is_known = now.has(maker.first);
          result.push_back(maker.second(now));
          if (is_known && maker.first != "healing" &&
              maker.first != "overstress")
            leave_to_model(result.back(), "it is in the model already");
        }
    return result;
  }



  std::string quantity_text(const Parameters  &parameters,
                            const std::string &path,
                            const double       value,
                            const int          n_digits)
  {
    FitParameter parameter;
    if (const auto *quantity =
          dynamic_cast<const Quantity *>(parameters.entry(path).pattern.get()))
      parameter.dimension = quantity->dimension;
    else
      parameter.dimension = Dimension::stiffness;
    return parameter.text(value, n_digits);
  }



  namespace
  {
    void add_part(const Part &part, const Values &values, Parameters &result)
    {
      const Formula &formula = part.formula;
      if (!formula.effect.empty())
        {
          const std::string list = result.text("Friction/Effects");
          result.set("Friction/Effects",
                     list + (list.empty() ? "" : ", ") + formula.effect,
                     "diagnosis");
        }
      for (const auto &setting : formula.settings)
        result.set(setting.first, setting.second, "diagnosis");
      std::string list = result.text("Calibration/Parameters");
      for (const CandidateParameter &parameter : formula.parameters)
        if (list.find(parameter.path + " ") == std::string::npos)
          {
            const auto text = [&](const double value) {
              return quantity_text(result, parameter.path, value);
            };
            const double value = std::clamp(values.at(parameter.path),
                                            parameter.lower,
                                            parameter.upper);
            list += "; " + parameter.path + " from " + text(parameter.lower) +
                    " to " + text(parameter.upper) + " start " + text(value) +
                    (parameter.is_logarithmic ? " log" : " linear");
          }
      result.set("Calibration/Parameters", list, "diagnosis");
    }
  } // namespace



  Parameters assemble(const Parameters        &start,
                      const std::vector<Part> &parts,
                      const Values            &values)
  {
    Parameters result = start;
    for (const Part &part : parts)
      add_part(part, values, result);
    for (const FitParameter &parameter : read_fit_parameters(result))
      {
        const auto value = values.find(parameter.path);
        if (value != values.end())
          result.set(parameter.path,
                     parameter.text(std::clamp(value->second,
                                               parameter.lower,
                                               parameter.upper),
                                    17),
                     "diagnosis");
      }
    return result;
  }
} // namespace SlipStep
