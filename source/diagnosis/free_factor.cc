// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/diagnosis/free_factor.h>
#include <slipstep/diagnosis/rules.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/text.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  namespace
  {
    constexpr unsigned int n_knots = 6;

    // Of the factor, for differences.
    constexpr double small_factor = 0.01;



    /// Where the knots are: equally spaced in u(x). Of a wave the last is the
    /// first.
    struct KnotScale
    {
      std::string covariate;
      double      from = 0., to = 0.; ///< x
      /// u is x, |x|, log10(1 + x / offset), or the place in a wave.
      enum class Kind
      {
        linear,
        absolute,
        logarithmic,
        periodic
      } kind                 = Kind::linear;
      double      offset     = 1.;                 ///< or the length of a wave
      double      first_knot = 0., last_knot = 1.; ///< u
      std::string renewal_length;                  ///< of the hold time

      double knot(const std::size_t k) const
      {
        const double n_intervals =
          kind == Kind::periodic ? n_knots : n_knots - 1;
        return first_knot + (last_knot - first_knot) * k / n_intervals;
      }
    };



    std::string u_text(const KnotScale &scale)
    {
      switch (scale.kind)
        {
          case KnotScale::Kind::linear:
            return "x";
          case KnotScale::Kind::absolute:
            return "abs(x)";
          case KnotScale::Kind::logarithmic:
            return "log10(1 + x / " + short_text(scale.offset, 4) + ")";
          case KnotScale::Kind::periodic:
            {
              const std::string waves = "x / " + short_text(scale.offset, 8);
              return waves + " - floor(" + waves + ")";
            }
        }
      return "";
    }



    // 1 + corrections, as a sum of max(0, u - u_k); constant beyond the knots.
    std::string factor_text(const KnotScale &scale, Eigen::VectorXd corrections)
    {
      if (scale.kind == KnotScale::Kind::periodic)
        {
          corrections.conservativeResize(n_knots + 1);
          corrections(n_knots) = corrections(0);
        }
      std::string text  = short_text(1. + corrections(0), 6);
      double      slope = 0.;
      for (Eigen::Index k = 0; k + 1 < corrections.size(); ++k)
        {
          const double next = (corrections(k + 1) - corrections(k)) /
                              (scale.knot(k + 1) - scale.knot(k));
          if (next != slope)
            text += " + (" + short_text(next - slope, 6) + ") * max(0, " +
                    u_text(scale) + " - (" + short_text(scale.knot(k), 6) +
                    "))";
          slope = next;
        }
      return text;
    }



    TrialFormula formula_of(const KnotScale       &scale,
                            const Eigen::VectorXd &corrections)
    {
      const std::string section = "Friction/expression/";
      TrialFormula      formula;
      formula.effect     = "expression";
      formula.n_in_texts = n_knots - 2;
      formula.texts      = {{section + "Covariate", scale.covariate},
                            {section + "Formula", factor_text(scale, corrections)},
                            {section + "From", short_text(scale.from, 10)},
                            {section + "To", short_text(scale.to, 10)}};
      if (!scale.renewal_length.empty())
        formula.texts[section + "Renewal length"] = scale.renewal_length;
      return formula;
    }



    KnotScale logarithmic_scale(const std::string &covariate,
                                const double       from,
                                const double       to,
                                const double       offset)
    {
      KnotScale scale;
      scale.covariate  = covariate;
      scale.from       = from;
      scale.to         = to;
      scale.kind       = KnotScale::Kind::logarithmic;
      scale.offset     = offset;
      scale.first_knot = std::log10(1. + from / offset);
      scale.last_knot  = std::log10(1. + to / offset);
      return scale;
    }



    KnotScale linear_scale(const std::string &covariate,
                           const double       from,
                           const double       to)
    {
      KnotScale scale;
      scale.covariate  = covariate;
      scale.from       = from;
      scale.to         = to;
      scale.first_knot = from;
      scale.last_knot  = to;
      return scale;
    }



    // The largest temperature rise that heating can have made, by its own
    // parameters: with all heat of the fastest slides kept.
    double largest_rise(const Parameters &parameters, const TestedRange &range)
    {
      const double power =
        range.typical_friction * range.highest * range.fastest;
      const double duration =
        std::min({range.longest_test,
                  range.longest_path / range.fastest,
                  parameters.number("Friction/heating/Cooling time")});
      return parameters.number("Friction/heating/Heating") * power * duration;
    }



    // The wave along the track that the model knows, or leaves.
    std::vector<KnotScale> track_scales(const Workspace &workspace,
                                        const Model     &model)
    {
      const Parameters &parameters = model.simulator->with(model.scaled);
      const std::vector<std::string> effects =
        parameters.list("Friction/Effects");
      const bool   has_texture = holds(effects, "texture");
      const double line        = has_texture ?
                                   parameters.number("Friction/texture/Angle") :
                                   workspace.range.main_line;
      // A position along the first axis is all that a factor knows.
      if (std::abs(std::sin(line)) > 1e-6)
        return {};
      const double wavelength =
        has_texture ? parameters.number("Friction/texture/Wavelength") :
                      workspace.range.track_wave;
      if (!(wavelength > 0.))
        return {};
      // Of the law positions count from where a test begins.
      const Eigen::VectorXd &position = workspace.covariates.position;
      KnotScale              scale =
        linear_scale("position",
                     std::min(0., position.minCoeff()) - 0.1 * wavelength,
                     std::max(0., position.maxCoeff()) + 0.1 * wavelength);
      scale.kind       = KnotScale::Kind::periodic;
      scale.offset     = wavelength;
      scale.first_knot = 0.;
      scale.last_knot  = 1.;
      return {scale};
    }



    // Those that the tests vary; several where a length has to be chosen.
    std::vector<KnotScale> scales_of(const Workspace   &workspace,
                                     const Model       &model,
                                     const std::string &covariate)
    {
      const TestedRange &range = workspace.range;
      if (covariate == "log10 speed" && range.fastest > 1.1 * range.slowest)
        return {linear_scale(covariate,
                             std::log10(range.slowest),
                             std::log10(range.fastest))};
      if (covariate == "pressure" && range.highest > 1.05 * range.lowest)
        return {logarithmic_scale(
          covariate, range.lowest, range.highest, 1e-2 * range.lowest)};
      if (covariate == "path" && range.longest_path > 0.)
        return {logarithmic_scale(
          covariate, 0., range.longest_path, 0.1 * range.longest_path)};
      if (covariate == "hold time" && range.longest_rest > 0.)
        {
          std::vector<KnotScale> scales;
          for (const char *const length : {"0.02 mm", "0.2 mm"})
            {
              scales.push_back(logarithmic_scale(
                covariate, 0., range.longest_rest, 3e-3 * range.longest_rest));
              scales.back().renewal_length = length;
            }
          return scales;
        }
      const Eigen::VectorXd &angle = workspace.covariates.angle;
      if (covariate == "angle" &&
          angle.unaryExpr([](const double a) { return std::abs(std::sin(a)); })
              .maxCoeff() > 0.05)
        {
          KnotScale scale  = linear_scale(covariate, -180., 180.);
          scale.kind       = KnotScale::Kind::absolute;
          scale.first_knot = 0.;
          return {scale};
        }
      if (covariate == "position")
        return track_scales(workspace, model);
      if (covariate == "temperature")
        {
          const double most =
            largest_rise(model.simulator->with(model.scaled), range);
          if (most > 0.)
            return {logarithmic_scale(covariate, 0., most, 0.1 * most)};
        }
      return {};
    }



    /// Fits the factor along one scale.
    class FactorFitter
    {
    public:
      FactorFitter(const Workspace   &workspace,
                   const Model       &model,
                   const KnotScale   &scale,
                   const std::string &corrects)
        : workspace(workspace)
        , model(model)
        , scale(scale)
        , corrects(corrects)
      {}

      std::optional<FreeFactor> fit();

    private:
      std::optional<Model> with(const Model           &now,
                                const Eigen::VectorXd &corrections) const;

      std::vector<Direction> directions(const Model           &now,
                                        const Eigen::VectorXd &corrections);

      const Workspace   &workspace;
      const Model       &model;
      const KnotScale   &scale;
      const std::string &corrects;
    };



    std::optional<Model>
    FactorFitter::with(const Model           &now,
                       const Eigen::VectorXd &corrections) const
    {
      std::vector<Part> parts = model.parts;
      parts.push_back(
        {corrects.empty() ? "expression" : "formula of " + corrects,
         formula_of(scale, corrections),
         corrects});
      return if_possible([&]() -> std::optional<Model> {
        return make_model(
          workspace.start, parts, now.values(), workspace.tests, now);
      });
    }



    // What each knot changes, by differences.
    std::vector<Direction>
    FactorFitter::directions(const Model           &now,
                             const Eigen::VectorXd &corrections)
    {
      const Eigen::VectorXd  here = workspace.comparison.difference(now);
      std::vector<Direction> result(n_knots);
      side_by_side(n_knots, [&](const std::size_t k) {
        Model           own   = now.copy();
        Eigen::VectorXd moved = corrections;
        moved(k) += small_factor;
        const std::optional<Model> there = with(own, moved);
        Eigen::VectorXd            change;
        if (there.has_value())
          change = workspace.comparison.difference(*there);
        result[k].friction = change.size() == 0 ?
                               Eigen::VectorXd::Zero(here.size()).eval() :
                               (change - here).eval();
      });
      return result;
    }



    // By Gauss and Newton, all other parameters being fitted in between.
    std::optional<FreeFactor> FactorFitter::fit()
    {
      // Neighbours are kept alike by this share.
      constexpr double smoothness = 0.01;

      FreeFactor result;
      result.covariate          = scale.covariate;
      result.model              = model;
      Eigen::VectorXd best      = Eigen::VectorXd::Zero(n_knots);
      bool            is_better = false;
      for (unsigned int pass = 0; pass < 3; ++pass)
        {
          const ScoreTest scores(workspace.comparison,
                                 result.model,
                                 workspace.null_draws,
                                 directions(result.model, best));
          if (pass == 0 && scores.together().p > workspace.level)
            return {};
          Eigen::VectorXd corrections =
            best + small_factor * scores.mixture(smoothness);
          // What is the same everywhere belongs to the coefficients.
          corrections.array() -= corrections.mean();
          corrections                = corrections.cwiseMax(-0.9).cwiseMin(3.);
          std::optional<Model> tried = with(result.model, corrections);
          if (!tried.has_value() || !workspace.comparison.fit(*tried, 0.1) ||
              tried->objective > result.model.objective - sure_gain)
            break;
          result.model = *tried;
          best         = corrections;
          is_better    = true;
        }
      result.formula = factor_text(scale, best);
      return is_better ? std::make_optional(result) : std::nullopt;
    }
  } // namespace



  std::optional<FreeFactor> add_free_factor(const Workspace   &workspace,
                                            const Model       &model,
                                            const std::string &covariate,
                                            const std::string &corrects)
  {
    const std::vector<std::string> effects =
      model.simulator->with(model.scaled).list("Friction/Effects");
    if (holds(effects, "expression"))
      return {};
    std::optional<FreeFactor> best;
    for (const KnotScale &scale : scales_of(workspace, model, covariate))
      {
        const std::optional<FreeFactor> tried =
          FactorFitter(workspace, model, scale, corrects).fit();
        if (tried.has_value() && (!best.has_value() || tried->model.objective <
                                                         best->model.objective))
          best = tried;
      }
    return best;
  }



  std::optional<FreeFactor> complete_formula(const Workspace &workspace,
                                             const Model     &model)
  {
    std::optional<FreeFactor> best;
    for (const Part &part : model.parts)
      {
        if (part.formula.along.empty())
          continue;
        const std::optional<FreeFactor> tried =
          add_free_factor(workspace, model, part.formula.along, part.name);
        if (tried.has_value() && (!best.has_value() || tried->model.objective <
                                                         best->model.objective))
          best = tried;
      }
    return best;
  }



  namespace
  {
    std::optional<FreeFactor> correct_along(const Workspace   &workspace,
                                            const Model       &base,
                                            const Judgement   &judgement,
                                            const std::string &name)
    {
      // What expression knows is the temperature of effect heating.
      if (name == "heat")
        return {};
      std::optional<FreeFactor> factor =
        add_free_factor(workspace, base, covariate_called(name).in_expression);
      if (factor.has_value() && judgement.gap.excess > 0.)
        factor->share =
          1. - test_gap(workspace, factor->model, judgement.view).excess /
                 judgement.gap.excess;
      return factor;
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



  std::optional<FreeFactor>
  find_correction(const Workspace                 &workspace,
                  const Model                     &base,
                  const Judgement                 &judgement,
                  const std::vector<Localisation> &where)
  {
    constexpr double least_share = 0.5;

    for (const Localisation &place : where)
      {
        const std::optional<FreeFactor> correction =
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
