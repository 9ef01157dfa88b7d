// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tests_friction_law_test_tools_h
#define tests_friction_law_test_tools_h

#include <slipstep/friction/contact_point.h>

#include <cmath>
#include <memory>
#include <random>

#include "../settings.h"

namespace SlipStep::Testing
{
  /// A law with defaults except for the settings (paths below "Friction/").
  inline std::unique_ptr<FrictionLaw> make_law(const Settings &settings)
  {
    Parameters parameters;
    FrictionLaw::declare_parameters(parameters);
    set_all(settings, parameters, "Friction/");
    return std::make_unique<FrictionLaw>(parameters);
  }

  inline dealii::Tensor<1, 2> vector(const double x, const double y = 0.)
  {
    dealii::Tensor<1, 2> result;
    result[0] = x;
    result[1] = y;
    return result;
  }

  /// Loads drawn at random, of all magnitudes.
  class RandomLoads
  {
  public:
    explicit RandomLoads(const unsigned int seed)
      : random(seed)
    {}

    double uniform(const double from, const double to)
    {
      return std::uniform_real_distribution<double>(from, to)(random);
    }

    /// Between 10^from and 10^to.
    double magnitude(const double from, const double to)
    {
      return std::pow(10., uniform(from, to));
    }

    dealii::Tensor<1, 2> random_slip(const double from, const double to)
    {
      const double size = magnitude(from, to), angle = uniform(0., 6.3);
      return vector(size * std::cos(angle), size * std::sin(angle));
    }

    /// Update a point by anything, in one stage or in two. Every so often: no
    /// slip, no contact, tiny pressure.
    struct Step
    {
      double          pressure;
      bool            has_two_stages;
      ContactResponse response;
    };
    Step make_any_step(const FrictionLaw &law, ContactPoint &point)
    {
      const double choice = uniform(0., 1.);
      const auto   slip   = choice < 0.1 ? vector(0.) : random_slip(-9., 2.);
      Step         step;
      step.pressure =
        choice > 0.97 ? -1. : magnitude(choice > 0.9 ? -9. : -2., 3.);
      step.has_two_stages = uniform(0., 1.) < 0.5;
      if (step.has_two_stages)
        {
          point.update(law,
                       random_slip(-9., 2.),
                       uniform(-0.1, 1.) * magnitude(-2., 3.),
                       magnitude(-6., 6.));
          point.begin_second_stage(law);
        }
      step.response =
        point.update(law, slip, step.pressure, magnitude(-6., 6.));
      return step;
    }

    /// A step of some slip, after a first stage or not, of which a derivative
    /// can be taken.
    struct Load
    {
      dealii::Tensor<1, 2> slip;
      double               pressure, duration;
    };
    Load begin_plain_step(const FrictionLaw &law,
                          const bool         has_two_stages,
                          ContactPoint      &point)
    {
      Load load;
      load.slip     = random_slip(-6., -2.);
      load.pressure = magnitude(0., 1.5);
      load.duration = magnitude(-3., 2.);
      if (has_two_stages)
        {
          point.update(law,
                       random_slip(-6., -2.),
                       magnitude(0., 1.5),
                       load.duration);
          point.begin_second_stage(law);
        }
      return load;
    }

  private:
    std::mt19937 random;
  };

  inline bool is_finite(const ContactResponse &response)
  {
    return std::isfinite(response.traction.norm()) &&
           std::isfinite(response.d_slip.norm()) &&
           std::isfinite(response.d_normal.norm());
  }
} // namespace SlipStep::Testing

#endif
