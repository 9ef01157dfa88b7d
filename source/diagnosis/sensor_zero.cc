// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/sensor_zero.h>

#include <algorithm>

namespace SlipStep
{
  namespace
  {
    // Of the friction along the first axis.
    std::vector<CampaignTest> without_zero(std::vector<CampaignTest> tests,
                                           const SensorZero         &zero)
    {
      for (CampaignTest &test : tests)
        for (std::size_t i = 0; i < test.rows.friction.size(); ++i)
          if (test.rows.pressure[i] > 0.)
            test.rows.friction[i] -=
              zero.is_load ? zero.value / test.rows.pressure[i] : zero.value;
      return tests;
    }



    // What a unit of it adds to the numbers compared.
    Eigen::VectorXd unit_of_zero(const Workspace &workspace, const bool is_load)
    {
      const Covariates &at     = workspace.covariates;
      Eigen::VectorXd   result = Eigen::VectorXd::Zero(at.axis.size());
      for (Eigen::Index i = 0; i < result.size(); ++i)
        if (at.axis(i) < 0.5 && at.pressure(i) > 0.)
          result(i) = is_load ? 1. / at.pressure(i) : 1.;
      return result;
    }



    // The best one next to what a model can fit, to first order.
    double best_zero(const Model &model, const RowMatrix &unit)
    {
      Eigen::MatrixXd columns(unit.rows(), model.scaled.size() + 1);
      columns << model.derivatives.topRows(unit.rows()), unit;
      return columns.completeOrthogonalDecomposition().solve(
        model.residual.head(unit.rows()))(columns.cols() - 1);
    }
  } // namespace



  std::optional<SensorZero> find_sensor_zero(const Workspace &workspace,
                                             const Model     &base,
                                             const Model     &found,
                                             const double     excess)
  {
    constexpr unsigned int n_steps = 3; // it is nearly linear
    constexpr double       as_well = 4., most = 0.8;

    // What makes the gap has to go, too.
    double bound = base.objective - std::max(most * excess, as_well);
    if (!found.parts.empty())
      bound = std::min(bound, found.objective + as_well);
    std::optional<SensorZero> result;
    double                    least = bound;
    for (const bool is_load : {false, true})
      {
        RowMatrix unit = unit_of_zero(workspace, is_load);
        workspace.comparison.whiten(unit);
        SensorZero           zero{0., is_load};
        std::optional<Model> model = base;
        for (unsigned int step = 0; step < n_steps && model.has_value(); ++step)
          {
            zero.value += best_zero(*model, unit);
            model = if_possible([&]() -> std::optional<Model> {
              Model other = make_model(workspace.start,
                                       {},
                                       model->values(),
                                       without_zero(workspace.tests, zero),
                                       base);
              if (!workspace.comparison.fit(other, 0.01))
                return std::nullopt;
              return other;
            });
          }
        if (model.has_value() && model->objective < least)
          {
            least  = model->objective;
            result = zero;
          }
      }
    return result;
  }
} // namespace SlipStep
