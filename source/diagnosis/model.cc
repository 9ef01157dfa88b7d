// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/model.h>
#include <slipstep/utilities/lists.h>

#include <algorithm>

namespace SlipStep
{
  Model Model::copy() const
  {
    Model result     = *this;
    result.simulator = std::make_shared<Simulator>(*simulator);
    return result;
  }



  Values Model::values() const
  {
    Values result;
    for (std::size_t i = 0; i < scaled.size(); ++i)
      result[campaign->fitted[i].path] =
        campaign->fitted[i].from_scaled(scaled[i]);
    return result;
  }



  ModelKey::ModelKey(const Model &model)
    : scaled(model.scaled)
    , objective(model.objective)
  {
    for (const Part &part : model.parts)
      {
        parts.push_back(part.name + ' ' + part.formula.effect);
        for (const auto &[path, text] : part.formula.texts)
          parts.back() += ' ' + path + '=' + text;
      }
  }



  bool Model::has(const std::string &name) const
  {
    return any_of(parts, [&](const Part &part) { return part.name == name; });
  }



  const Part *Model::owner_of(const std::string &path) const
  {
    for (const Part &part : parts)
      for (const CandidateParameter &parameter : part.formula.parameters)
        if (parameter.path == path)
          return &part;
    return nullptr;
  }



  Model make_coarse_model(const Parameters                &start,
                          const std::vector<Part>         &parts,
                          const Values                    &values,
                          const std::vector<CampaignTest> &tests,
                          const Model                     *like)
  {
    Model           model;
    const CaseToFit assembled = assemble(start, parts, values);
    model.parts               = parts;
    model.campaign =
      std::make_shared<Campaign>(assembled.parameters, assembled.fitted, tests);
    model.simulator = std::make_shared<Simulator>(*model.campaign);
    for (const FitParameter &parameter : model.campaign->fitted)
      model.scaled.push_back(std::clamp(
        parameter.to_scaled(parameter.value_in(assembled.parameters)), 0., 1.));
    model.simulator->plan(model.scaled,
                          like == nullptr ? nullptr : like->simulator.get());
    return model;
  }



  Model make_model(const Parameters                &start,
                   const std::vector<Part>         &parts,
                   const Values                    &values,
                   const std::vector<CampaignTest> &tests,
                   const Model                     &like)
  {
    Model model = make_coarse_model(start, parts, values, tests, &like);
    model.simulator->correct_by(*like.simulator, like.scaled);
    return model;
  }
} // namespace SlipStep
