// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/numbers.h>

#include <slipstep/diagnosis/covariates.h>

namespace SlipStep
{
  std::string name_of(const Phase phase)
  {
    static const char *const names[] = {"presliding",
                                        "peak",
                                        "softening",
                                        "steady",
                                        "hold",
                                        "restart",
                                        "reversal"};
    return names[static_cast<unsigned int>(phase)];
  }



  bool is_flank(const Phase phase)
  {
    return phase == Phase::presliding || phase == Phase::restart ||
           phase == Phase::reversal;
  }



  double Covariate::shown(const double value) const
  {
    return unit == "deg" ? value * 180. / dealii::numbers::PI : value;
  }



  const std::vector<Covariate> &all_covariates()
  {
    using At = Covariates;
    // clang-format off
    static const std::vector<Covariate> list = {
      {"speed", "mm/s", &At::speed, true, false, "log10 speed",
       "at speeds of *"},
      {"pressure", "MPa", &At::pressure, true, false, "pressure",
       "under pressures of *"},
      {"path", "mm", &At::path, false, false, "path",
       "after a path of *"},
      {"slip since start", "mm", &At::since_start, true, false, "",
       "after a start, at a slip of *"},
      {"rest", "s", &At::rest, true, false, "hold time",
       "after rests of *"},
      {"heat", "MPa mm", &At::heat, false, false, "temperature",
       "after recent frictional work of *"},
      {"angle", "deg", &At::angle, false, false, "angle",
       "at angles of *"},
      {"direction", "", &At::is_reverse, false, false, "",
       ""},
      {"position", "mm", &At::position, false, false, "position",
       "along the track, in waves of *"},
      {"order of the tests", "", &At::order, false, false, "",
       "in the tests run as number *"},
      {"flank", "", &At::since_start, false, false, "",
       "on the flanks where slip begins"},
      {"unloading", "", &At::unloading, false, true, "",
       "where the pressure has been higher before"},
      {"rate of pressure", "MPa/s", &At::pressure_rate, false, true, "",
       "while the pressure changes by *"},
      {"change of pressure", "", &At::pressure_change, false, true, "",
       "for some slip after a change of pressure"},
      {"change of speed", "", &At::speed_change, false, true, "",
       "for some slip after a change of speed"}};
    // clang-format on
    return list;
  }



  namespace
  {
    const Covariate &covariate_by(std::string Covariate::*const key,
                                  const std::string            &value)
    {
      for (const Covariate &covariate : all_covariates())
        if (covariate.*key == value)
          return covariate;
      throw RunError("no covariate is called " + value);
    }
  } // namespace



  const Covariate &covariate_called(const std::string &name)
  {
    return covariate_by(&Covariate::name, name);
  }



  const Covariate &covariate_in_expression(const std::string &name)
  {
    return covariate_by(&Covariate::in_expression, name);
  }
} // namespace SlipStep
