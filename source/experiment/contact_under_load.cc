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
    /// How much of a load the law holds at a multiple of its elastic trial.
    class PushedStage
    {
    public:
      PushedStage(const FrictionLaw  &law,
                  ContactPoint       &point,
                  const Tensor<1, 2> &load,
                  const double        normal_traction,
                  const double        time_step)
        : law(law)
        , point(point)
        , load(load)
        , normal_traction(normal_traction)
        , time_step(time_step)
        , compliance(invert(law.elastic_tangent()))
        , old(point.stage_traction())
      {}

      /// What is beyond the load, relative to it, with the trial (1 + more)
      /// times the load.
      double excess(const double more)
      {
        slip     = compliance * ((1. + more) * load - old);
        response = point.update(law, slip, normal_traction, time_step);
        return (response.traction - load) * load / load.norm_square();
      }

      /// Its derivative, after excess().
      double slope() const
      {
        return (response.d_slip * (compliance * load)) * load /
               load.norm_square();
      }

      bool solve();

      Tensor<1, 2>    slip;
      ContactResponse response;

    private:
      bool solve_by_newton();
      bool solve_by_bisection();

      const FrictionLaw &law;
      ContactPoint      &point;
      const Tensor<1, 2> load;
      const double       normal_traction;
      const double       time_step;
      const Tensor<2, 2> compliance;
      const Tensor<1, 2> old;
    };

    constexpr double push_accuracy = 1e-13;



    // Traction that bends down as slip grows keeps Newton's method on this side
    // of the first solution. Beyond a peak it is another one, if any.
    bool PushedStage::solve_by_newton()
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



    bool PushedStage::solve_by_bisection()
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



    bool PushedStage::solve()
    {
      return excess(0.) >= -push_accuracy || solve_by_newton() ||
             solve_by_bisection();
    }
  } // namespace



  std::optional<ContactResponse> pull_contact(const FrictionLaw  &law,
                                              ContactPoint       &point,
                                              const double        stiffness,
                                              const Tensor<1, 2> &force,
                                              const double  normal_traction,
                                              const double  time_step,
                                              Tensor<1, 2> &slip)
  {
    constexpr unsigned int most_iterations = 100;
    constexpr double       accuracy = 1e-13, good_enough = 1e-10;

    Tensor<2, 2> spring;
    spring[0][0] = spring[1][1] = stiffness;
    const Tensor<1, 2> old =
      normal_traction > 0. ? point.stage_traction() : Tensor<1, 2>();
    ContactResponse response;
    const auto      missing = [&](const Tensor<1, 2> &s) {
      response = point.update(law, s, normal_traction, time_step);
      return force - response.traction - spring * s;
    };
    // If nothing slipped.
    slip = invert(spring + law.elastic_tangent()) * (force - old);
    const double scale =
      force.norm() + old.norm() + law.static_coefficient() * normal_traction;
    Tensor<1, 2> left = missing(slip);
    for (unsigned int n = 0; n < most_iterations; ++n)
      {
        if (left.norm() <= accuracy * scale)
          return response;
        const Tensor<1, 2> newton = invert(response.d_slip + spring) * left;
        Tensor<1, 2>       tried;
        bool               better = false;
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



  std::optional<ContactResponse> push_contact(const FrictionLaw  &law,
                                              ContactPoint       &point,
                                              const Tensor<1, 2> &load,
                                              const double  normal_traction,
                                              const double  time_step,
                                              Tensor<1, 2> &slip)
  {
    if (law.has_core() && normal_traction > 0.)
      return pull_contact(
        law, point, 0., load, normal_traction, time_step, slip);
    if (load.norm_square() == 0.)
      {
        slip = Tensor<1, 2>();
        if (normal_traction > 0.)
          slip -= invert(law.elastic_tangent()) * point.stage_traction();
        return point.update(law, slip, normal_traction, time_step);
      }
    if (!(normal_traction > 0.))
      return {};
    PushedStage stage(law, point, load, normal_traction, time_step);
    if (!stage.solve())
      return {};
    slip = stage.slip;
    return stage.response;
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
