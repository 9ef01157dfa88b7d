// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/contact_under_load.h>

#include <slipstep/utilities/text.h>

#include <boost/math/tools/roots.hpp>

#include <cmath>

namespace SlipStep
{
  using dealii::Tensor;

  namespace
  {
    constexpr double push_accuracy = 1e-13;

    /// How much of a load the law holds at a multiple of its elastic trial.
    class PushedStage
    {
    public:
      PushedStage(const ContactStage &stage, const Tensor<1, 2> &load)
        : stage(stage)
        , load(load)
        , compliance(invert(stage.law.elastic_tangent()))
        , old(stage.start())
      {}

      /// What is beyond the load, relative to it, with the trial (1 + more)
      /// times the load.
      double excess(const double more)
      {
        slip     = compliance * ((1. + more) * load - old);
        response = stage.update(slip);
        return (response.traction - load) * load / load.norm_square();
      }

      /// Its derivative, after excess().
      double slope() const
      {
        return (response.d_slip * (compliance * load)) * load /
               load.norm_square();
      }

      bool solve()
      {
        return excess(0.) >= -push_accuracy || solve_by_newton() ||
               solve_by_bisection();
      }

      Tensor<1, 2>    slip;
      ContactResponse response;

    private:
      // Traction that bends down as slip grows keeps Newton's method on this
      // side of the first solution. Beyond a peak it is another one, if any.
      bool solve_by_newton()
      {
        double more = 0.;
        for (unsigned int n = 0; n < 50; ++n)
          {
            const double value = excess(more);
            const double rate  = slope();
            if (!std::isfinite(value) || !(rate > 0.) || value > push_accuracy)
              return false;
            if (std::abs(value) <= push_accuracy)
              return true;
            more -= value / rate;
          }
        return false;
      }

      bool solve_by_bisection()
      {
        double lower = 0.;
        for (int power = -120; power <= 120; ++power)
          {
            double       upper = std::exp2(power / 3.);
            const double value = excess(upper);
            if (!std::isfinite(value))
              return false;
            if (value >= 0.)
              {
                boost::uintmax_t iterations = 200;
                const auto       bracket    = boost::math::tools::toms748_solve(
                  [this](const double more) { return excess(more); },
                  lower,
                  upper,
                  boost::math::tools::eps_tolerance<double>(51),
                  iterations);
                return std::abs(excess(bracket.second)) <= 1e-9;
              }
            lower = upper;
          }
        return false;
      }

      const ContactStage &stage;
      const Tensor<1, 2>  load;
      const Tensor<2, 2>  compliance;
      const Tensor<1, 2>  old;
    };
  } // namespace



  std::optional<ContactResponse> pull_contact(const ContactStage &stage,
                                              const double        stiffness,
                                              const Tensor<1, 2> &force,
                                              Tensor<1, 2>       &slip)
  {
    constexpr unsigned int most_iterations = 100;
    constexpr double       accuracy = 1e-13, good_enough = 1e-10;

    Tensor<2, 2> spring;
    spring[0][0] = spring[1][1] = stiffness;
    const Tensor<1, 2> old      = stage.start();
    ContactResponse    response;
    const auto         missing = [&](const Tensor<1, 2> &s) {
      response = stage.update(s);
      return force - response.traction - spring * s;
    };
    // If nothing slipped.
    slip = invert(spring + stage.law.elastic_tangent()) * (force - old);
    const double scale = force.norm() + old.norm() +
                         stage.law.static_coefficient() * stage.normal_traction;
    Tensor<1, 2> left = missing(slip);
    for (unsigned int n = 0; n < most_iterations; ++n)
      {
        if (left.norm() <= accuracy * scale)
          return response;
        const Tensor<1, 2> newton = invert(response.d_slip + spring) * left;
        // What slides freely bears no more, whatever the slip.
        if (!(newton.norm() < 1e100))
          break;
        Tensor<1, 2> tried;
        bool         better = false;
        for (double share = 1.; !better && share > 1e-12; share *= 0.5)
          {
            const Tensor<1, 2> at = slip + share * newton;
            tried                 = missing(at);
            better                = tried.norm() < left.norm();
            if (better)
              slip = at;
          }
        if (!better)
          break;
        left = tried;
      }
    left = missing(slip);
    return left.norm() <= good_enough * scale ? std::make_optional(response) :
                                                std::nullopt;
  }



  std::optional<ContactResponse> push_contact(const ContactStage &stage,
                                              const Tensor<1, 2> &load,
                                              Tensor<1, 2>       &slip)
  {
    const bool is_closed = stage.normal_traction > 0.;
    if (stage.law.has_core() && is_closed)
      return pull_contact(stage, 0., load, slip);
    if (load.norm_square() == 0.)
      {
        slip = Tensor<1, 2>();
        if (is_closed)
          slip -= invert(stage.law.elastic_tangent()) * stage.start();
        return stage.update(slip);
      }
    if (!is_closed)
      return {};
    PushedStage pushed(stage, load);
    if (!pushed.solve())
      return {};
    slip = pushed.slip;
    return pushed.response;
  }



  std::string reason_of_slip(const Tensor<1, 2> &wanted,
                             const Tensor<1, 2> &held,
                             const double        pressure)
  {
    const auto text = [](const Tensor<1, 2> &load) {
      return rounded_text(load[1] == 0. ? load[0] : load.norm(), 6) + " MPa";
    };
    return "friction cannot hold the push of " + text(wanted) +
           "; it held up to " + text(held) + ", at a pressure of " +
           rounded_text(pressure, 6) + " MPa";
  }
} // namespace SlipStep
