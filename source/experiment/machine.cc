#include <slipstep/experiment/machine.h>

#include <boost/math/tools/roots.hpp>

#include <cmath>

namespace SlipStep
{
  using dealii::Tensor;

  namespace
  {
    const char *const key = "Loading/Machine stiffness";
  }



  void Machine::declare_parameters(Parameters &parameters)
  {
    parameters.declare(
      key,
      "rigid",
      dealii::Patterns::Anything(),
      "Stiffness k of the machine between the load point, which the programme "
      "moves, and the contact point of 'slipstep point': tangential traction "
      "per displacement. 'rigid', or more than 0, in MPa/mm. The block of "
      "'slipstep run' takes 'rigid' only: it is elastic itself.");
  }



  Machine::Machine(const Parameters &parameters)
  {
    const std::string text = parameters.text(key);
    if (text == "rigid")
      return;
    const Quantity stiffness(Dimension::stiffness, 0., 1e30, true);
    if (!stiffness.match(text))
      parameters.reject(key,
                        "must be 'rigid' or a stiffness greater than 0, such "
                        "as 50 MPa/mm");
    compliance = 1. / stiffness.value(text);
  }



  // The law leaves a share w of the elastic trial traction, f_t = w f_trial,
  // where f_trial = f_0 + C slip. With the spring, slip = motion - c (f_t -
  // f_0), so that w determines the trial,
  //   (1 + w c C) f_trial = f_0 + C (motion + c f_0),
  // and the law a share that must be w. At w = 0 the law's cannot be less, at
  // w = 1 it cannot be more. On a weakening contact there may be several: the
  // first, from sticking on, is next to where the contact was before.
  ContactResponse Machine::update(const FrictionLaw  &law,
                                  ContactPoint       &point,
                                  const Tensor<1, 2> &load_point_increment,
                                  const double        normal_traction,
                                  const double        time_step) const
  {
    if (is_rigid())
      return point.update(law,
                          load_point_increment,
                          normal_traction,
                          time_step);

    const Tensor<2, 2> elastic = law.elastic_tangent();
    const Tensor<1, 2> old     = point.committed().traction;
    const Tensor<1, 2> load =
      old + elastic * (load_point_increment + compliance * old);
    ContactResponse response;
    const auto      excess = [&](const double share) {
      Tensor<2, 2> matrix = share * compliance * elastic;
      matrix[0][0] += 1.;
      matrix[1][1] += 1.;
      const Tensor<1, 2> trial = invert(matrix) * load;
      response                 = point.update(law,
                              invert(elastic) * (trial - old),
                              normal_traction,
                              time_step);
      const double square      = trial.norm_square();
      return square > 0. ? response.traction * trial / square - share : 0.;
    };

    double upper = 1.;
    if (excess(upper) >= -1e-14)
      return response;
    // Closer and closer to 1, then to 0.
    for (int power = -40; power <= 200; power += 3)
      {
        const double lower =
          power < 0 ? 1. - std::exp2(power) : std::exp2(-1 - power);
        if (excess(lower) > 0.)
          {
            boost::uintmax_t iterations = 200;
            const auto       bracket    = boost::math::tools::toms748_solve(
              excess,
              lower,
              upper,
              boost::math::tools::eps_tolerance<double>(51),
              iterations);
            upper = (bracket.first + bracket.second) / 2.;
            break;
          }
        upper = lower;
      }
    excess(upper);
    return response;
  }
} // namespace SlipStep
