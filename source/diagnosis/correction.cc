// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/correction.h>
#include <slipstep/diagnosis/free_factor.h>
#include <slipstep/diagnosis/ingest.h>
#include <slipstep/diagnosis/left_out.h>
#include <slipstep/diagnosis/rules.h>

namespace SlipStep
{
  namespace
  {
    std::optional<CorrectedModel> correct_along(const Workspace   &workspace,
                                                const Model       &base,
                                                const Judgement   &judgement,
                                                const std::string &name)
    {
      // What expression knows is the temperature of effect heating.
      if (name == "heat")
        return {};
      const std::optional<FreeFactor> factor =
        add_free_factor(workspace, base, covariate_called(name).in_expression);
      if (!factor.has_value())
        return {};
      CorrectedModel result;
      result.covariate    = factor->covariate;
      result.formula      = factor->formula;
      result.model        = factor->model;
      const GapTest after = test_gap(workspace, result.model, judgement.view);
      result.share        = judgement.gap.excess > 0. ?
                              1. - after.excess / judgement.gap.excess :
                              0.;
      return result;
    }



    // What names have to show, and no worse in per cent of friction either.
    bool is_an_improvement(const Workspace &workspace,
                           const Model     &base,
                           const Model     &corrected)
    {
      if (!evidence_for(workspace, base, corrected).is_enough())
        return false;
      const Comparison &comparison   = workspace.comparison;
      const auto        left_out_rms = [&](const Model &model) {
        Eigen::VectorXd differences;
        left_out(workspace, model, &differences);
        return relative_rms(comparison, differences);
      };
      return relative_rms(comparison, corrected) <
               relative_rms(comparison, base) &&
             (comparison.conditions.size() < 2 ||
              left_out_rms(corrected) < left_out_rms(base));
    }
  } // namespace



  std::optional<CorrectedModel>
  find_correction(const Workspace                 &workspace,
                  const Model                     &base,
                  const Judgement                 &judgement,
                  const std::vector<Localisation> &where)
  {
    constexpr double least_share = 0.5;

    for (const Localisation &place : where)
      {
        const std::optional<CorrectedModel> correction =
          correct_along(workspace, base, judgement, place.covariate);
        if (correction.has_value())
          return correction->share >= least_share &&
                     is_an_improvement(workspace, base, correction->model) ?
                   correction :
                   std::nullopt;
      }
    return {};
  }
} // namespace SlipStep
