// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/look_alike.h>
#include <slipstep/diagnosis/refits.h>
#include <slipstep/diagnosis/rules.h>
#include <slipstep/diagnosis/workspace.h>

#include <Eigen/QR>

#include <algorithm>
#include <iterator>
#include <set>

namespace SlipStep
{
  namespace
  {
    using Kind = LookAlike::Kind;

    // How many tests were run between the middle of the campaign and each of
    // them; nothing if the order of any is unknown, or there are few moments.
    std::vector<double> places_in_campaign(const Workspace &workspace)
    {
      constexpr std::size_t least = 3;

      std::vector<double> orders;
      for (const CampaignTest &test : workspace.tests)
        {
          const std::optional<double> order = order_of(test.rows);
          if (!order.has_value())
            return {};
          orders.push_back(*order);
        }
      const std::set<double> moments(orders.begin(), orders.end());
      if (moments.size() < least)
        return {};
      std::vector<double> places;
      double              mean = 0.;
      for (const double order : orders)
        {
          places.push_back(std::distance(moments.begin(), moments.find(order)));
          mean += places.back() / orders.size();
        }
      for (double &place : places)
        place -= mean;
      return places;
    }



    // Of the friction along the first axis, or, by a drift, along both.
    std::vector<CampaignTest> without(std::vector<CampaignTest>  tests,
                                      const LookAlike           &look_alike,
                                      const std::vector<double> &places)
    {
      for (std::size_t t = 0; t < tests.size(); ++t)
        {
          MeasuredTest &rows = tests[t].rows;
          if (look_alike.kind == Kind::drift)
            {
              const double factor = 1. + look_alike.value * places[t];
              for (double &friction : rows.friction)
                friction /= factor;
              for (double &friction : rows.friction_y)
                friction /= factor;
              continue;
            }
          for (std::size_t i = 0; i < rows.friction.size(); ++i)
            if (rows.pressure[i] > 0.)
              rows.friction[i] -= look_alike.kind == Kind::load_zero ?
                                    look_alike.value / rows.pressure[i] :
                                    look_alike.value;
        }
      return tests;
    }



    // What a unit of it adds to the numbers compared.
    Eigen::VectorXd unit_of(const Workspace           &workspace,
                            const Kind                 kind,
                            const std::vector<double> &places)
    {
      const Covariates &at       = workspace.covariates;
      const auto       &measured = workspace.comparison.measured;
      Eigen::VectorXd   result   = Eigen::VectorXd::Zero(at.axis.size());
      if (kind == Kind::drift)
        {
          for (std::size_t t = 0; t < places.size(); ++t)
            {
              const ComparedTest &test = workspace.comparison.tests[t];
              result.segment(test.begin, test.size) =
                places[t] * measured.segment(test.begin, test.size);
            }
          return result;
        }
      for (Eigen::Index i = 0; i < result.size(); ++i)
        if (at.axis(i) < 0.5 && at.pressure(i) > 0.)
          result(i) = kind == Kind::load_zero ? 1. / at.pressure(i) : 1.;
      return result;
    }



    // The best one next to what a model can fit, to first order.
    double best_value(const Model &model, const RowMatrix &unit)
    {
      Eigen::MatrixXd columns(unit.rows(), model.scaled.size() + 1);
      columns << model.derivatives.topRows(unit.rows()), unit;
      return columns.completeOrthogonalDecomposition().solve(
        model.residual.head(unit.rows()))(columns.cols() - 1);
    }



    // The starting model, fitted to tests without a zero or a drift of this
    // kind, and how much of that there is.
    std::optional<Model> fit_without(const Workspace           &workspace,
                                     const Model               &base,
                                     const std::vector<double> &places,
                                     LookAlike                 &look_alike)
    {
      constexpr unsigned int n_steps = 3; // it is nearly linear
      constexpr double       most    = 0.9;

      double farthest = 0.;
      for (const double place : places)
        farthest = std::max(farthest, std::abs(place));
      RowMatrix unit = unit_of(workspace, look_alike.kind, places);
      workspace.comparison.whiten(unit);
      std::optional<Model> model = base;
      for (unsigned int step = 0; step < n_steps && model.has_value(); ++step)
        {
          look_alike.value += best_value(*model, unit);
          if (look_alike.kind == Kind::drift &&
              std::abs(look_alike.value) * farthest > most)
            return std::nullopt;
          model = if_possible([&]() -> std::optional<Model> {
            Model other =
              make_model(workspace.start,
                         {},
                         model->values(),
                         without(workspace.tests, look_alike, places),
                         base);
            if (!workspace.comparison.fit(other, 0.01))
              return std::nullopt;
            return other;
          });
        }
      return model;
    }



    /// Keeps what explains the tests best.
    class Best
    {
    public:
      Best(const Model &base, const Model &found, const double excess)
        : base(base)
        , found(found)
        , excess(excess)
        , least(base.objective)
      {}

      // What makes the gap has to go, too; of a drift, much is taken for
      // differences between replicates.
      void consider(const LookAlike            &look_alike,
                    const std::optional<Model> &model)
      {
        constexpr double as_well = 4., sure = 10., most = 0.8,
                         most_of_drift = 0.4;
        if (!model.has_value())
          return;
        const double gain       = base.objective - model->objective;
        const double bound      = look_alike.kind == Kind::drift ?
                                    std::max(most_of_drift * excess, sure) :
                                    std::max(most * excess, as_well);
        const bool   is_as_good = found.parts.empty() ||
                                penalised(*model) <= penalised(found) + as_well;
        if (gain >= bound && is_as_good && model->objective < least)
          {
            least  = model->objective;
            result = look_alike;
          }
      }

      std::optional<LookAlike> result;

    private:
      const Model &base, &found;
      const double excess;
      double       least;
    };



    // Numbers of the starting model's effects that nobody fits.
    std::vector<std::string> held_parameters(const Parameters &start,
                                             const Campaign   &campaign)
    {
      std::vector<std::string> paths = {"Friction/Static coefficient"};
      for (const std::string &effect : start.list("Friction/Effects"))
        for (const std::string &path : start.paths("Friction/" + effect + "/"))
          paths.push_back(path);
      const auto is_not_held = [&](const std::string &path) {
        const auto has_it = [&](const auto &list, const auto name_of) {
          return std::any_of(list.begin(), list.end(), [&](const auto &one) {
            return name_of(one) == path;
          });
        };
        return dynamic_cast<const Quantity *>(
                 start.entry(path).pattern.get()) == nullptr ||
               has_it(campaign.fitted,
                      [](const FitParameter &one) { return one.path; }) ||
               has_it(campaign.derived,
                      [](const Derived &one) { return one.name; });
      };
      paths.erase(std::remove_if(paths.begin(), paths.end(), is_not_held),
                  paths.end());
      return paths;
    }



    // A few times smaller or larger, as far as is allowed.
    CandidateParameter range_of_parameter(const Parameters  &start,
                                          const std::string &path)
    {
      constexpr double few = 5.;

      const auto &allowed =
        dynamic_cast<const Quantity &>(*start.entry(path).pattern);
      const double held = start.number(path);
      const double far  = held == 0. ? 1. : few * std::abs(held);
      const double near = held == 0. ? -1. : std::abs(held) / few;
      const double low  = held < 0. ? -far : near;
      const double high = held < 0. ? -near : far;
      return {path,
              std::max(low, allowed.minimum),
              std::min(high, allowed.maximum),
              held > 0.};
    }



    // The starting model with one more parameter fitted, if that ends between
    // its bounds.
    std::optional<Model> fit_with(const Workspace   &workspace,
                                  const Model       &base,
                                  const std::string &path,
                                  LookAlike         &look_alike)
    {
      constexpr double at_bound = 0.01;

      const CandidateParameter parameter =
        range_of_parameter(workspace.start, path);
      Part part{"held", {}};
      part.formula.parameters = {parameter};
      Values values           = base.values();
      values[path]            = workspace.start.number(path);
      return if_possible([&]() -> std::optional<Model> {
        Model model =
          make_model(workspace.start, {part}, values, workspace.tests, base);
        if (!workspace.comparison.fit(model, 0.01) ||
            model.scaled.back() < at_bound ||
            model.scaled.back() > 1. - at_bound)
          return std::nullopt;
        look_alike.value = model.values().at(path);
        look_alike.path  = path;
        look_alike.text =
          quantity_text(workspace.start, path, look_alike.value, 3);
        look_alike.held_text = workspace.start.text(path);
        return model;
      });
    }
  } // namespace



  std::optional<LookAlike> find_look_alike(Workspace   &workspace,
                                           const Model &base,
                                           const Model &found,
                                           const double excess)
  {
    Best                      best(base, found, excess);
    const std::vector<double> places = places_in_campaign(workspace);
    for (const Kind kind : {Kind::friction_zero, Kind::load_zero, Kind::drift})
      {
        if (workspace.is_late() || (kind == Kind::drift && places.empty()))
          continue;
        LookAlike  look_alike{kind};
        const auto model = fit_without(workspace, base, places, look_alike);
        best.consider(look_alike, model);
      }
    for (const std::string &path :
         held_parameters(workspace.start, *base.campaign))
      {
        if (workspace.is_late())
          break;
        LookAlike  look_alike{Kind::held_parameter};
        const auto model = fit_with(workspace, base, path, look_alike);
        best.consider(look_alike, model);
      }
    return best.result;
  }
} // namespace SlipStep
