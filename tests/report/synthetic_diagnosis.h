// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tests_diagnosis_synthetic_diagnosis_h
#define tests_diagnosis_synthetic_diagnosis_h

#include <slipstep/diagnosis/diagnosis.h>

#include <cmath>
#include <random>
#include <string>

/// A diagnosis as if it had been done, made by hand: velocity steps with
/// replicates, a slide-hold-slide test, strokes and a test at high pressure, in
/// which friction rises with speed and the starting model does not know it.
namespace SyntheticDiagnosis
{
  using namespace SlipStep;

  inline DiagnosedParameter parameter(const std::string &effect,
                                      const std::string &name,
                                      const std::string &unit,
                                      const double       value,
                                      const double       deviation)
  {
    DiagnosedParameter result;
    result.path   = "Friction/" + (effect.empty() ? "" : effect + "/") + name;
    result.name   = name;
    result.unit   = unit;
    result.value  = value;
    result.lower  = value - 1.8 * deviation;
    result.upper  = value + 2.2 * deviation;
    result.effect = effect;
    for (int i = -12; i <= 12 && !effect.empty(); ++i)
      {
        const double x = 0.25 * i;
        result.profile.emplace_back(value + x * deviation,
                                    3.84 * x * x /
                                      (x < 0. ? 1.8 * 1.8 : 2.2 * 2.2));
      }
    return result;
  }

  inline CandidateResult candidate(const std::string &name,
                                   const Standing     standing,
                                   const double       p,
                                   const double       gain,
                                   const double       left_out_gain,
                                   const double       minimum_detectable)
  {
    CandidateResult result;
    result.name               = name;
    result.signature          = "signature of " + name;
    result.standing           = standing;
    result.p                  = p;
    result.score              = gain > 0. ? std::sqrt(gain) : 0.4;
    result.gain               = gain;
    result.left_out_gain      = left_out_gain;
    result.minimum_detectable = minimum_detectable;
    result.is_testable        = std::isfinite(minimum_detectable);
    return result;
  }

  /// What the test does at a row.
  struct Row
  {
    double displacement = 0.;
    double since_start  = 0.;
    double sign         = 1.;
    Phase  phase        = Phase::steady;
  };

  /// @param kind "slide", "hold" or "strokes"
  inline Row row(const std::string &kind, const double share)
  {
    Row result;
    result.displacement = result.since_start = 20. * share;
    if (kind == "hold" && share > 0.4)
      {
        result.displacement = share < 0.6 ? 8. : 20. * (share - 0.2);
        result.since_start  = share < 0.6 ? 8. : 20. * (share - 0.6);
      }
    if (kind == "strokes" && share > 0.5)
      {
        result.displacement = 20. * (1. - share);
        result.since_start  = 20. * (share - 0.5);
        result.sign         = -1.;
      }
    const double at       = result.since_start;
    const bool   is_first = kind == "slide" || share < 0.4;
    result.phase = kind == "hold" && share > 0.4 && share < 0.6 ? Phase::hold :
                   at < 0.5 ? (is_first         ? Phase::presliding :
                               result.sign < 0. ? Phase::reversal :
                                                  Phase::restart) :
                   at < 1.2 ? Phase::peak :
                   at < 5.  ? Phase::softening :
                              Phase::steady;
    return result;
  }

  /// @param effect change of friction, as a share, that the start lacks
  inline DiagnosedTest test(const std::string &name,
                            const std::string &condition,
                            const std::string &kind,
                            const double       effect)
  {
    constexpr std::size_t            n_rows = 200;
    std::mt19937                     generator(name.size() * 77 + name.back());
    std::normal_distribution<double> white(0., 0.0025);
    DiagnosedTest                    test;
    test.name      = name;
    test.condition = condition;
    test.file      = "measured/" + name + ".csv";
    test.level     = 0.3;
    test.noise     = 0.003;
    for (std::size_t i = 0; i < n_rows; ++i)
      {
        const Row    at       = row(kind, (i + 1.) / n_rows);
        const double friction = at.sign *
                                (0.3 + 0.06 * std::exp(-at.since_start)) *
                                (1. - std::exp(-4. * at.since_start));
        test.time.push_back(0.6 * i);
        test.displacement.push_back(at.displacement);
        test.phase.push_back(at.phase);
        test.before.push_back(friction);
        test.after.push_back(friction * (1. + effect));
        test.measured.push_back(friction * (1. + effect) +
                                0.001 * std::sin(0.04 * i) + white(generator));
      }
    test.rms_before      = std::hypot(effect, 0.01);
    test.rms_after       = 0.0102;
    test.left_out_before = 1.05 * std::hypot(effect, 0.01);
    test.left_out_after  = 0.0111;
    return test;
  }

  inline CovariatePanel panel(const std::string &covariate,
                              const std::string &unit,
                              const bool         is_logarithmic,
                              const double       slope)
  {
    CovariatePanel result;
    result.covariate      = covariate;
    result.unit           = unit;
    result.is_logarithmic = is_logarithmic;
    std::vector<double> winner, rival;
    for (int i = 0; i < 9; ++i)
      {
        const double x = i / 8.;
        result.x.push_back(is_logarithmic ? std::pow(10., 3. * x - 2.) :
                                            1. + 19. * x);
        winner.push_back(slope * (x - 0.5));
        rival.push_back(0.8 * slope * (x * x - 0.4));
        result.residual.push_back(slope * (x - 0.5) + 0.002 * std::sin(7. * i));
        result.error.push_back(0.003);
      }
    result.signatures = {{"overstress", winner}, {"stribeck", rival}};
    return result;
  }

  inline ElementCheck element_check(const DiagnosedTest &test)
  {
    ElementCheck result;
    result.test         = test.name;
    result.displacement = test.displacement;
    result.measured     = test.measured;
    result.point_before = test.before;
    result.point_after  = test.after;
    result.block_before = test.before;
    result.block_after  = test.after;
    for (std::size_t i = 0; i < test.displacement.size(); ++i)
      for (auto *const curve : {&result.block_before, &result.block_after})
        (*curve)[i] *= 1. - 0.012 * std::exp(-0.5 * test.displacement[i]);
    result.block_gap_before = 0.062;
    result.block_gap_after  = 0.0123;
    result.point_gap_before = 0.061;
    result.point_gap_after  = 0.0114;
    result.difference       = 0.0042;
    return result;
  }

  /// What all variants have in common: no gap was found.
  inline Diagnosis base()
  {
    Diagnosis result;
    result.seed              = 1;
    result.level             = 0.04;
    result.n_conditions      = 6;
    result.n_replicate_pairs = 3;
    result.n_samples         = 18400;
    result.data_hash         = "6c1f0a3be2d94c77";
    result.start_effects     = {"subloading", "softening"};
    result.start_parameters  = {
       parameter("", "Static coefficient", "", 0.3612, 0.0011),
       parameter("", "Tangential stiffness", "MPa/mm", 44.3, 2.1)};
    result.start_parameters[0].before = 0.35;
    result.start_parameters[1].before = 40.;
    result.parameters                 = result.start_parameters;
    result.noise                      = {
                           {"white", 0.0083, "of friction", "replicates", 0.0081, 0.0086},
                           {"gain", 0.0045, "of friction", "replicates", 0.002, 0.0098},
                           {"drift", 0.005, "of friction", "stated", 0.005, 0.005}};
    const double nothing = 0.;
    result.tests         = {
              test("slow <a> & \"b\"", "0.1 mm/min", "slide", nothing),
              test("slow again", "0.1 mm/min", "slide", nothing),
              test("middle", "1 mm/min", "slide", nothing),
              test("fast", "100 mm/min", "slide", nothing),
              test("fast again", "100 mm/min", "slide", nothing),
              test("slide-hold-slide", "hold 100 s", "hold", nothing),
              test("strokes", "10 mm/min, forth and back", "strokes", nothing),
              test("high pressure", "20 MPa", "slide", nothing)};
    result.gap.p            = 0.41;
    result.gap.p_smooth     = 0.41;
    result.gap.p_replicates = 0.52;
    result.gap.p_track      = 0.83;
    const double infinity   = std::numeric_limits<double>::infinity();
    const double none       = std::nan("");
    result.candidates       = {
            candidate("overstress", Standing::rejected, 0.47, none, none, 0.0035),
            candidate("stribeck", Standing::rejected, 0.6, none, none, 0.006),
            candidate("viscous", Standing::rejected, 0.8, none, none, 0.008),
            candidate("healing", Standing::rejected, 0.93, none, none, 0.021),
            candidate("run_in", Standing::rejected, 0.97, none, none, 0.004),
            candidate("pressure", Standing::rejected, 1., none, none, 0.012),
            candidate("shear_cap", Standing::rejected, 1., none, none, 0.31),
            candidate("direction", Standing::rejected, 1., none, none, 0.005),
            candidate("anisotropy", Standing::not_testable, 1., none, none, infinity),
            candidate("heating", Standing::not_testable, 1., none, none, infinity),
            candidate("softening", Standing::in_the_model, 1., none, none, infinity)};
    result.candidates[8].why           = "no test slides off the axis";
    result.candidates[8].cheapest_test = "a slide at 45 deg";
    result.candidates[9].why           = "no run is long and fast enough";
    result.candidates[9].cheapest_test = "sliding at 600 mm/min for 60 s";
    result.candidates[10].why          = "it is in the model already";
    result.shrink = {0.0104, 0.0104, 0.0107, 0.0107, 0.0101, 0.0025, 0.0025};
    result.steps  = {{"as the case states it", 0.083, 9100.},
                     {"calibrated", 0.0104, 1622.}};
    result.panels = {panel("speed", "mm/s", true, 0.),
                     panel("pressure", "MPa", false, 0.)};
    result.n_candidates   = 11;
    result.n_refits       = 17;
    result.n_draws        = 999;
    result.would_overturn = {
      "A third replicate of 100 mm/min whose gain differs by more than 2 %.",
      "Stated noise half as large."};
    result.wall_time = 12.3;
    result.cpu_time  = 21.4;
    return result;
  }

  inline Diagnosis no_gap()
  {
    Diagnosis result = base();
    for (CovariatePanel &panel : result.panels)
      panel.signatures.clear();
    return result;
  }

  /// Where there is a gap and where it is.
  inline Diagnosis with_gap()
  {
    Diagnosis result = base();
    result.has_gap   = true;
    result.gap.p = result.gap.p_smooth = 0.001;
    result.gap.p_replicates            = 0.001;
    result.gap.excess                  = 2210.;
    result.where                       = {
                            {"speed",
                             "mm/s",
                             0.83,
                             0.5,
                             1.7,
                             1,
                             {"steady", "softening"},
                             {"fast", "fast again"}},
                            {"heat", "MPa mm", 0.31, 4., 90., 1, {"steady"}, {"fast"}},
                            {"order of the tests", "", 0.12, 5., 8., -1, {"steady"}, {"strokes"}},
                            {"flank", "", 0.04, 0., 0., -1, {"presliding"}, {"middle"}}};
    const std::vector<double> effect = {
      -0.06, -0.06, 0., 0.07, 0.07, -0.02, 0.035, -0.02};
    for (std::size_t i = 0; i < result.tests.size(); ++i)
      {
        const DiagnosedTest &old = result.tests[i];
        result.tests[i]          = test(old.name,
                               old.condition,
                               i == 5 ? "hold" :
                                        i == 6 ? "strokes" :
                                                 "slide",
                               effect[i]);
      }
    result.shrink = {0.0491, 0.0104, 0.0513, 0.0109, 0.0101, 0.048, 0.0025};
    result.steps  = {{"as the case states it", 0.083, 9100.},
                     {"calibrated", 0.0491, 3832.},
                     {"with overstress", 0.0104, 1622.}};
    result.panels = {panel("speed", "mm/s", true, 0.13),
                     panel("pressure", "MPa", false, 0.02),
                     panel("order of the tests", "", false, 0.03)};
    return result;
  }

  inline Diagnosis named()
  {
    Diagnosis result       = with_gap();
    result.verdict         = Verdict::named;
    result.effects         = {"overstress"};
    result.explained_share = 0.98;
    result.remainder_p     = 0.46;
    result.candidates[0] =
      candidate("overstress", Standing::named, 0.001, 2210.4, 1983.1, 0.0035);
    result.candidates[0].parameters = {
      parameter("overstress", "Viscosity", "s", 0.0123, 0.0006),
      parameter("overstress", "Exponent", "", 41.2, 3.)};
    result.candidates[0].parameters[1].is_upper_open = true;
    // Others are other ones with what was missing.
    result.parameters[0].value = 0.3377;
    for (const DiagnosedParameter &added : result.candidates[0].parameters)
      result.parameters.push_back(added);
    result.candidates[1] =
      candidate("stribeck", Standing::not_needed, 0.001, 1210.4, 983.1, 0.006);
    result.element_checks = {element_check(result.tests[3])};
    result.improved_case  = "improved.prm";
    result.next_test      = {"sliding at 0.01 mm/min",
                             "press 5.8 MPa in 1 s; slide 0.01 mm/min for 2 mm",
                             {"overstress", "stribeck"},
                             7.4};
    return result;
  }

  /// A formula that is not quite right, and a rest.
  inline Diagnosis incomplete()
  {
    Diagnosis result     = named();
    result.is_incomplete = true;
    result.remainder_p   = 0.001;
    result.remains       = {
            {"pressure", "MPa", 0.61, 12., 20., -1, {"peak"}, {"high pressure"}}};
    CovariatePanel lacking = panel("speed", "mm/s", true, 0.01);
    lacking.signatures     = {
          {"formula of overstress", lacking.signatures[0].second}};
    result.completed = {{"overstress",
                         "log10 speed",
                         "0.99 + (0.02) * max(0, x - (-2))",
                         71.5,
                         lacking}};
    return result;
  }

  inline Diagnosis ambiguous()
  {
    Diagnosis result              = named();
    result.verdict                = Verdict::ambiguous;
    result.rivals                 = {{"stribeck", "overstress"}};
    result.candidates[1].standing = Standing::rival;
    result.candidates[1].gain     = 2206.2;
    return result;
  }

  inline Diagnosis unnamed()
  {
    Diagnosis result = with_gap();
    result.verdict   = Verdict::unnamed;
    result.withdrawn = {"overstress"};
    result.candidates[0] =
      candidate("overstress", Standing::rejected, 0.001, 310.4, -12., 0.0035);
    result.correction = {
      "speed", "1 + 0.04*min(max(log(v/0.01), 0), 6.9) - 0.002*log(v)^2", 0.62};
    result.shrink.fitted_after     = 0.0271;
    result.shrink.left_out_after   = 0.0322;
    result.shrink.systematic_after = 0.0251;
    result.steps.back() = {"with a correction by speed", 0.0271, 2410.};
    ElementCheck check;
    check.test            = "fast";
    check.remark          = "the block has not been simulated: no cells stated";
    result.element_checks = {check};
    result.improved_case  = "improved.prm";
    return result;
  }

  inline Diagnosis not_testable()
  {
    Diagnosis result         = no_gap();
    result.verdict           = Verdict::not_testable;
    result.n_replicate_pairs = 0;
    for (CandidateResult &one : result.candidates)
      if (one.standing != Standing::in_the_model)
        {
          const std::string name = one.name;
          one                    = candidate(name,
                          Standing::not_testable,
                          1.,
                          std::nan(""),
                          std::nan(""),
                          std::numeric_limits<double>::infinity());
          one.why                = "it would change nothing that was measured";
          one.cheapest_test      = "sliding at 600 mm/min for 60 s";
        }
    result.next_test           = {"a velocity step from 1 to 100 mm/min",
                                  "press 5.8 MPa in 1 s; slide 1 mm/min for 5 mm; slide "
                                            "100 mm/min for 5 mm",
                                  {"overstress", "stribeck", "viscous"},
                                  11.2};
    result.outliers            = {{"fast",
                                   "its level is 6 deviations off that of 'fast "
                                              "again' under the same condition"}};
    result.tests[3].is_outlier = true;
    result.warnings            = {
                 "no two tests share a condition: the noise is as stated"};
    return result;
  }
} // namespace SyntheticDiagnosis

#endif
