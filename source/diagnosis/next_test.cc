// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/calibration/advice.h>
#include <slipstep/diagnosis/next_test.h>
#include <slipstep/diagnosis/rules.h>
#include <slipstep/measured_data/test_rows.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <set>

namespace SlipStep
{
  namespace
  {
    // Strength (see Shape) of an effect that a test is to reveal: a change of
    // some three per cent.
    constexpr double worthwhile_strength = 3.;



    /// A test that could be made, with what it takes to compare predictions.
    class ImaginedTest
    {
    public:
      ImaginedTest(const Workspace &workspace, const MeasuredTest &motion)
        : workspace(workspace)
        , motion(motion)
        , replay(motion)
      {}

      // The friction along both axes; empty if it cannot be simulated.
      Eigen::VectorXd predict(const Model               &model,
                              const std::vector<double> &scaled,
                              const bool                 plan)
      {
        return if_possible([&]() {
          Simulator         simulator(*model.simulator);
          const Parameters &parameters = simulator.with(scaled);
          const FrictionLaw law(parameters);
          const Machine     machine(parameters);
          if (plan)
            replay.plan(law,
                        machine,
                        model.campaign->search_tolerance,
                        Replay::most_steps_of_imagined_test);
          Replay::Curve curve;
          replay.simulate(law, machine, curve);
          std::vector<double> both = replay.at(curve.friction, motion.time);
          if (!motion.displacement_y.empty())
            for (const double y : replay.at(curve.friction_y, motion.time))
              both.push_back(y);
          return Eigen::VectorXd(
            Eigen::Map<const Eigen::VectorXd>(both.data(), both.size()));
        });
      }

      // What one standard deviation of each combination of the parameters
      // changes.
      Eigen::MatrixXd uncertainty(const Model &model, const Eigen::VectorXd &at)
      {
        const Eigen::MatrixXd curvature =
          model.derivatives.transpose() * model.derivatives;
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(curvature);
        const double    largest = eigen.eigenvalues().maxCoeff();
        Eigen::MatrixXd columns(at.size(), model.scaled.size());
        for (std::size_t i = 0; i < model.scaled.size(); ++i)
          {
            std::vector<double> scaled = model.scaled;
            const double        step   = scaled[i] > 0.5 ? -1e-4 : 1e-4;
            scaled[i] += step;
            const Eigen::VectorXd there = predict(model, scaled, false);
            if (there.size() == 0)
              columns.col(i).setZero();
            else
              columns.col(i) = (there - at) / step;
          }
        return columns * eigen.eigenvectors() *
               eigen.eigenvalues()
                 .cwiseMax(1e-12 * largest)
                 .cwiseSqrt()
                 .cwiseInverse()
                 .asDiagonal();
      }

      Whitener whitener(const Eigen::VectorXd &friction) const
      {
        const std::size_t   n = motion.time.size();
        Series              series;
        const double        duration = motion.time.back() - motion.time.front();
        std::vector<double> noises;
        for (const CampaignTest &test : workspace.tests)
          noises.push_back(mean_noise(test.axes));
        for (std::size_t i = 0; i < n; ++i)
          series.time.push_back((motion.time[i] - motion.time.front()) /
                                duration);
        series.row_noise.assign(n, median(noises));
        series.duration = duration / workspace.comparison.usual_duration;
        std::vector<Series> all(friction.size() / n, series);
        for (std::size_t s = 0; s < all.size(); ++s)
          all[s].friction.assign(friction.data() + s * n,
                                 friction.data() + (s + 1) * n);
        return Whitener(all,
                        workspace.range.typical_friction,
                        workspace.comparison.noise());
      }

    private:
      const Workspace    &workspace;
      const MeasuredTest &motion;
      Replay              replay;
    };
  } // namespace



  // d^2 = w (I + U U^T)^-1 w with what the parameters may do in U.
  double separation(const Workspace    &workspace,
                    const Model        &a,
                    const Model        &b,
                    const MeasuredTest &motion)
  {
    ImaginedTest          test(workspace, motion);
    const Eigen::VectorXd at_b = test.predict(b, b.scaled, true);
    const Eigen::VectorXd at_a = test.predict(a, a.scaled, false);
    if (at_a.size() == 0 || at_b.size() == 0)
      return 0.;
    const Eigen::MatrixXd of_a = test.uncertainty(a, at_a);
    const Eigen::MatrixXd of_b = b.derivatives.size() > 0 ?
                                   test.uncertainty(b, at_b) :
                                   Eigen::MatrixXd(at_a.size(), 0);
    RowMatrix             columns(at_a.size(), 1 + of_a.cols() + of_b.cols());
    columns << at_b - at_a, of_a, of_b;
    test.whitener(at_a).apply(columns);
    const Eigen::VectorXd w = columns.col(0);
    const Eigen::MatrixXd U = columns.rightCols(columns.cols() - 1);
    const Eigen::MatrixXd inner =
      Eigen::MatrixXd::Identity(U.cols(), U.cols()) + U.transpose() * U;
    const Eigen::VectorXd Uw = U.transpose() * w;
    const double square      = w.squaredNorm() - Uw.dot(inner.ldlt().solve(Uw));
    return std::sqrt(std::max(0., square));
  }



  namespace
  {
    double duration_of(const MeasuredTest &motion)
    {
      return motion.time.back() - motion.time.front();
    }



    // Of those that tell apart the one that reaches least beyond the tested
    // conditions, where models are believed and rigs can follow, and of these
    // the shortest; else the one that tells best.
    template <class Distance>
    NextTest choose_test(const std::vector<ProposedTest> &proposed,
                         const Distance                  &distance_of)
    {
      // By less it is not better.
      constexpr double clearly = 1.1;

      NextTest                  best;
      std::pair<double, double> least_cost;
      for (const ProposedTest &test : proposed)
        {
          const double    distance = distance_of(test.motion);
          const std::pair cost(test.reach, duration_of(test.motion));
          const bool      is_enough  = distance >= NextTest::told_apart;
          const bool      had_enough = best.tells();
          if (!(is_enough && (!had_enough || cost < least_cost)) &&
              !(!had_enough && distance > clearly * best.distance))
            continue;
          best.words     = test.words;
          best.programme = test.programme;
          best.distance  = distance;
          least_cost     = cost;
        }
      return best;
    }



    // The base with a candidate that is worth finding at that strength, the
    // rest fitted.
    std::optional<Model> imagined(const Workspace &workspace,
                                  const Model     &base,
                                  const Candidate &candidate)
    {
      const TrialFormula        &formula = candidate.formulas.front();
      const TrialFormula::Shape &shape =
        formula.shapes[formula.shapes.size() / 2];
      return if_possible([&]() -> std::optional<Model> {
        Model model =
          make_model(workspace.start,
                     with_part(base.parts, candidate, 0),
                     merged(base.values(), shape(worthwhile_strength)),
                     workspace.tests,
                     base);
        // The effect stays; what these tests show of it, the others take away
        // again.
        std::vector<bool> held;
        for (const FitParameter &parameter : model.campaign->fitted)
          held.push_back(lists(formula.parameters, parameter.path));
        if (workspace.comparison.fit(model, 1., {}, held))
          return model;
        return {};
      });
    }
  } // namespace



  std::string cheapest_test(const Workspace &workspace,
                            const Model     &base,
                            const Candidate &candidate)
  {
    const std::optional<Model> with = imagined(workspace, base, candidate);
    if (!with.has_value())
      return "";
    const NextTest best =
      choose_test(propose_tests(*base.campaign),
                  [&](const MeasuredTest &motion) {
                    return separation(workspace, base, *with, motion);
                  });
    return best.distance >= NextTest::told_apart / 2. ? best.words : "";
  }



  NextTest propose_next_test(const Workspace          &workspace,
                             const Model              &winner,
                             const std::vector<Rival> &rivals)
  {
    if (rivals.empty())
      return {};
    const std::vector<ProposedTest> proposed = propose_tests(*winner.campaign);
    NextTest best = choose_test(proposed, [&](const MeasuredTest &motion) {
      double least = std::numeric_limits<double>::infinity();
      for (const Rival &rival : rivals)
        least =
          std::min(least, separation(workspace, winner, rival.model, motion));
      return least;
    });
    // By less than one deviation it is none.
    if (best.distance < 1.)
      return {};
    std::set<std::string> names;
    for (const Part &part : winner.parts)
      names.insert(part.name);
    for (const Rival &rival : rivals)
      names.insert(rival.name);
    best.separates.assign(names.begin(), names.end());
    return best;
  }
} // namespace SlipStep
