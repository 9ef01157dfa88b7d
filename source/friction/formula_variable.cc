// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/numbers.h>

#include <slipstep/friction/contact_age.h>
#include <slipstep/friction/formula_variable.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace SlipStep
{
  namespace
  {
    Strength log_speed(const SlipStepData &step, const double)
    {
      const double speed = std::max(step.slip_rate(), 1e-300);
      Strength     x;
      x.value  = std::log10(speed);
      x.d_rate = 1. / (dealii::numbers::LN10 * speed);
      return x;
    }



    Strength pressure(const SlipStepData &step, const double)
    {
      return {step.normal_traction, 0., 1., {}};
    }



    Strength path(const SlipStepData &step, const double)
    {
      Strength x;
      x.value  = step.start.slip_path + step.path;
      x.d_path = 1.;
      return x;
    }



    // Where the contact has got to over the plane, or its block while it is off
    // it.
    FormulaVariable position()
    {
      constexpr double    infinite = std::numeric_limits<double>::infinity();
      const ContactMemory memory =
        register_memory({"position_mm", 0., -infinite, infinite, 0});
      return {"position",
              "along the first axis in mm, from where the contact was first "
              "loaded",
              [memory](const SlipStepData &step, const double) {
                Strength x;
                x.value    = step.start[memory] + step.way[0];
                x.d_way[0] = 1.;
                return x;
              },
              [memory](const ContactState &state) { return state[memory]; },
              {memory}};
    }



    // The age of what now touches.
    FormulaVariable hold_time()
    {
      const ContactMemory memory = register_memory({"hold_time_s"});
      return {"hold time",
              "in s",
              [memory](const SlipStepData &step, const double length) {
                if (!(step.normal_traction > 0.))
                  return Strength();
                const Rate age =
                  contact_age_after(step.start[memory], step, length);
                return Strength{age.value, age.derivative, 0., {}};
              },
              {},
              {memory}};
    }



    // At the beginning of the step.
    FormulaVariable temperature()
    {
      return {"temperature",
              "rise in degC (needs effect heating)",
              [](const SlipStepData &step, const double) {
                static const ContactMemory memory =
                  contact_memory("temperature_rise_degC");
                return Strength{step.start[memory], 0., 0., {}};
              },
              {},
              {},
              "heating"};
    }



    Strength angle(const SlipStepData &step, const double)
    {
      constexpr double            degrees = 180. / dealii::numbers::PI;
      const dealii::Tensor<1, 2> &e       = step.direction;
      Strength                    x;
      x.value          = degrees * std::atan2(e[1], e[0]);
      x.d_direction[0] = -degrees * e[1];
      x.d_direction[1] = degrees * e[0];
      return x;
    }
  } // namespace



  const std::vector<FormulaVariable> &formula_variables()
  {
    static const std::vector<FormulaVariable> all = {
      {"log10 speed", "of the slip rate in mm/s", log_speed},
      {"pressure",
       "in MPa",
       pressure,
       [](const ContactState &state) { return state.normal_traction; }},
      {"path",
       "of slip in mm",
       path,
       [](const ContactState &state) { return state.slip_path; }},
      position(),
      hold_time(),
      temperature(),
      {"angle", "of slip in deg", angle}};
    return all;
  }
} // namespace SlipStep
