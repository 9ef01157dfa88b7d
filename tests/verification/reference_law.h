// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef tests_verification_reference_law_h
#define tests_verification_reference_law_h

#include "radau.h"

#include <slipstep/experiment/programme.h>
#include <slipstep/utilities/parameters.h>

#include <boost/math/tools/roots.hpp>

#include <algorithm>
#include <complex>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace SlipStep::Testing
{
  /// What a point remembers in the rate equations. Tractions are those of the
  /// isotropic law, in the metric of the ellipse.
  enum Unknown
  {
    traction_x,
    traction_y,
    normal_ratio,
    coefficient,
    slip_path,
    temperature,
    contact_age,
    dissipation,
    n_unknowns
  };

  using PointState = Unknowns<n_unknowns>;

  /// How a point moves on.
  enum class Mode
  {
    open,
    sticks,  ///< below r_s
    unloads, ///< sticks with r_s = r, which falls
    slips
  };

  /// What acts on the point between two corners of the programme.
  struct Drive
  {
    double                time     = 0.;
    double                pressure = 0., pressure_rate = 0.;
    std::array<double, 2> velocity{}; ///< of the load point

    double pressure_at(const double now) const
    {
      return pressure + (now - time) * pressure_rate;
    }
  };

  /// The rate equations of the friction law, written down from its formulas
  /// and apart from SlipStep::FrictionLaw. Derivatives are those along the
  /// imaginary axis, exact to the last digit.
  class ReferenceLaw
  {
  public:
    explicit ReferenceLaw(const Parameters &parameters);

    PointState initial_state() const
    {
      PointState x{};
      x[normal_ratio] = has_subloading ? least_ratio : 1.;
      x[coefficient]  = initial_coefficient;
      return x;
    }

    PointState rates(const Drive      &drive,
                     const Mode        mode,
                     const double      time,
                     const PointState &x) const;

    /// r with the strength at rest.
    double
    ratio(const Drive &drive, const double time, const PointState &x) const
    {
      return ratio_of(x, drive.pressure_at(time), 0.);
    }

    /// How fast r grows while nothing slips.
    double elastic_ratio_rate(const Drive      &drive,
                              const double      time,
                              const PointState &x) const;

    double
    slip_rate(const Drive &drive, const double time, const PointState &x) const;

    /// r in steady sliding.
    double steady_ratio(const double speed) const;

    std::array<double, 2> traction(const PointState &x) const
    {
      return product(cone, {x[traction_x], x[traction_y]});
    }

    /// In contact and spring.
    double stored_energy(const PointState &x) const
    {
      const std::array<double, 2> f = traction(x);
      return std::norm(std::complex<double>(x[traction_x], x[traction_y])) /
               (2. * alpha) +
             compliance / 2. * (f[0] * f[0] + f[1] * f[1]);
    }

    /// Whether r may exceed r_s, or the strength depends on the slip rate: then
    /// the slip rate is a function of the state.
    bool has_rate_effect() const
    {
      return flow != Flow::none || depends_on_rate;
    }

    double static_coefficient() const
    {
      return mu_s;
    }

    double stiffness() const
    {
      return alpha;
    }

    bool has_subloading = false;

    /// Where the rate of r_s is infinite, the way up to here is left out: it
    /// takes less than 1e-10 of the slip length.
    static constexpr double least_ratio = 1e-9;

  private:
    using Pair   = std::array<double, 2>;
    using Matrix = std::array<double, 3>; // xx, xy, yy

    enum class Flow
    {
      none,
      overstress,
      perzyna
    };

    static Pair product(const Matrix &m, const Pair &v)
    {
      return {{m[0] * v[0] + m[1] * v[1], m[1] * v[0] + m[2] * v[1]}};
    }

    void read_effects(const Parameters &parameters);
    void read_cone(const double second, const double angle);

    template <typename Number>
    using State = std::array<Number, n_unknowns>;

    template <typename Number>
    Number strength(const State<Number> &x,
                    const Number        &traction,
                    const Number        &pressure,
                    const Number        &slip_rate) const;

    template <typename Number>
    Number ratio_of(const State<Number> &x,
                    const Number        &pressure,
                    const Number        &slip_rate) const;

    /// Derivative of r along a direction.
    double ratio_along(const PointState &x,
                       const double      pressure,
                       const PointState &direction,
                       const double      pressure_rate) const;

    PointState rates_at_rest(const Drive      &drive,
                             const Mode        mode,
                             const PointState &x) const;
    PointState rates_per_slip(const PointState &x) const;

    Pair elastic(const Pair &motion) const;

    double flow_rate(const double r, const double r_s) const;
    double normal_ratio_rate(const double r_s) const;
    double consistent_rate(const Drive      &drive,
                           const double      time,
                           const PointState &x) const;
    double rate_with_rate_effects(const double      pressure,
                                  const PointState &x) const;

    double alpha = 0., compliance = 0.;
    double mu_s = 0., initial_coefficient = 0.;

    Flow   flow = Flow::none;
    double eta = 0., n = 1., r_m = 0.;

    double u              = 0.;
    bool   is_logarithmic = false;

    // Neutral unless the effect is on.
    double kappa = 0., a = 1., mu_k = 0.;
    double xi = 0., b = 1.;
    double growth = 0., t_0 = 1., renewal_length = 1.;
    double m = 0., p_0 = 1.;
    double tau_c    = 0.;
    double adhesion = 0., drag = 0.;
    double rise = 0., V_s = 1., q = 1.;
    double w = 0., D_w = 1.;
    double beta = 0., h = 0., t_c = std::numeric_limits<double>::infinity();
    double turn = 0.;
    Pair   forward{};
    bool   depends_on_rate = false;

    Matrix cone{{1., 0., 1.}}, inverse_cone{{1., 0., 1.}};
    Matrix elastic_share{{1., 0., 1.}}; ///< of contact and spring
  };



  inline ReferenceLaw::ReferenceLaw(const Parameters &parameters)
    : alpha(parameters.number("Friction/Tangential stiffness"))
  {
    if (parameters.text("Loading/Machine stiffness") != "rigid")
      compliance = 1. / std::stod(parameters.text("Loading/Machine stiffness"));
    read_cone(1., 0.);
    read_effects(parameters);
  }



  inline void ReferenceLaw::read_cone(const double second, const double angle)
  {
    const double c = std::cos(angle), s = std::sin(angle);
    const auto   matrix = [c, s](const double along, const double across) {
      return Matrix{{along * c * c + across * s * s,
                     (along - across) * c * s,
                     along * s * s + across * c * c}};
    };
    const double soft = alpha * compliance;
    cone              = matrix(1., second);
    inverse_cone      = matrix(1., 1. / second);
    elastic_share =
      matrix(1. / (1. + soft), 1. / (1. + soft * second * second));
  }



  inline void ReferenceLaw::read_effects(const Parameters &parameters)
  {
    std::string effect;
    const auto  number = [&](const std::string &key) {
      return parameters.number("Friction/" + effect + "/" + key);
    };
    const std::vector<std::string> list = parameters.list("Friction/Effects");
    for (const std::string &name : list)
      {
        effect = name;
        if (name == "overstress" || name == "perzyna")
          {
            flow = name == "perzyna" ? Flow::perzyna : Flow::overstress;
            eta  = number("Viscosity");
            n    = number("Exponent");
            r_m  = flow == Flow::perzyna ? 0. : number("Maximum ratio");
          }
        else if (name == "subloading")
          {
            has_subloading = true;
            u              = number("Rate");
            is_logarithmic =
              parameters.text("Friction/subloading/Form") == "log";
          }
        else if (name == "softening")
          kappa = number("Rate"), a = number("Steepness"),
          mu_k = number("Kinetic coefficient");
        else if (name == "healing")
          xi = number("Rate"), b = number("Steepness");
        else if (name == "ageing")
          growth = number("Growth"), t_0 = number("Time"),
          renewal_length = number("Renewal length");
        else if (name == "pressure")
          m = number("Exponent"), p_0 = number("Reference pressure");
        else if (name == "shear_cap")
          tau_c = number("Shear limit");
        else if (name == "adhesion")
          adhesion = number("Strength");
        else if (name == "viscous")
          drag = number("Drag");
        else if (name == "stribeck")
          rise = number("Rise"), V_s = number("Speed"), q = number("Exponent");
        else if (name == "run_in")
          w = number("Change"), D_w = number("Length");
        else if (name == "heating")
          beta = number("Weakening"), h = number("Heating"),
          t_c = number("Cooling time");
        else if (name == "direction")
          {
            const double angle = number("Forward angle");
            turn               = number("Change");
            forward            = {{std::cos(angle), std::sin(angle)}};
          }
        else if (name == "anisotropy")
          read_cone(number("Ratio"), number("Angle"));
        else
          throw std::invalid_argument("the reference has no " + name);
      }
    depends_on_rate = drag != 0. || rise != 0.;

    const double scale =
      1. /
      steady_ratio(parameters.number("Friction/Speed of the coefficients"));
    mu_s = scale * parameters.number("Friction/Static coefficient");
    mu_k *= scale;
    const std::string initial = parameters.text("Friction/Initial coefficient");
    initial_coefficient =
      initial == "static" ? mu_s : scale * std::stod(initial);
  }



  inline double ReferenceLaw::steady_ratio(const double speed) const
  {
    if (flow == Flow::none || speed <= 0.)
      return 1.;
    if (flow == Flow::perzyna)
      return 1. + std::pow(eta * speed, 1. / n);
    double lower = 1., upper = r_m;
    for (unsigned int i = 0; i < 100; ++i)
      {
        const double middle                             = (lower + upper) / 2.;
        (flow_rate(middle, 1.) < speed ? lower : upper) = middle;
      }
    return lower;
  }



  // Goes on smoothly below r_s, where a step looks for the end of slip.
  inline double ReferenceLaw::flow_rate(const double r, const double r_s) const
  {
    const double over = r - r_s;
    if (flow == Flow::perzyna)
      return std::copysign(std::pow(std::abs(over), n), over) / eta;
    return std::expm1(std::min(n * over, 300.)) /
           (eta * std::max(r_m - r, 1e-12));
  }



  inline double ReferenceLaw::normal_ratio_rate(const double r_s) const
  {
    constexpr double half_pi = 1.5707963267948966;
    if (!has_subloading)
      return 0.;
    const double at = std::max(r_s, least_ratio / 10.);
    return is_logarithmic ? -u * std::log(at) :
                            u * std::cos(half_pi * at) / std::sin(half_pi * at);
  }



  template <typename Number>
  Number ReferenceLaw::strength(const State<Number> &x,
                                const Number        &traction,
                                const Number        &pressure,
                                const Number        &slip_rate) const
  {
    const Number mu     = x[coefficient];
    Number       factor = 1.;
    if (m != 0.)
      factor *= std::pow(pressure / p_0, -m);
    if (tau_c > 0.)
      factor *= std::tanh(pressure * mu / tau_c) * tau_c / (pressure * mu);
    if (growth != 0.)
      factor *= 1. + growth * std::log(1. + x[contact_age] / t_0);
    if (w != 0.)
      factor *= 1. + w * (1. - std::exp(-x[slip_path] / D_w));
    if (beta != 0.)
      factor *= 1. / (1. + beta * x[temperature]);
    if (rise != 0. && std::real(slip_rate) > 0.)
      factor *= 1. + rise * std::exp(-std::pow(slip_rate / V_s, q));
    else
      factor *= 1. + rise;
    if (turn != 0.)
      {
        // Slip is normal to the ellipse.
        const Number m_x = x[traction_x] / traction,
                     m_y = x[traction_y] / traction;
        const Number e_x = inverse_cone[0] * m_x + inverse_cone[1] * m_y,
                     e_y = inverse_cone[1] * m_x + inverse_cone[2] * m_y;
        factor *= 1. + turn / 2. *
                         (1. - (forward[0] * e_x + forward[1] * e_y) /
                                 std::sqrt(e_x * e_x + e_y * e_y));
      }
    return pressure * mu * factor + adhesion + drag * slip_rate;
  }



  template <typename Number>
  Number ReferenceLaw::ratio_of(const State<Number> &x,
                                const Number        &pressure,
                                const Number        &slip_rate) const
  {
    if (x[traction_x] == Number(0.) && x[traction_y] == Number(0.))
      return 0.;
    const Number traction =
      std::sqrt(x[traction_x] * x[traction_x] + x[traction_y] * x[traction_y]);
    return traction / strength(x, traction, pressure, slip_rate);
  }



  inline double ReferenceLaw::ratio_along(const PointState &x,
                                          const double      pressure,
                                          const PointState &direction,
                                          const double      pressure_rate) const
  {
    using Complex = std::complex<double>;
    if (x[traction_x] == 0. && x[traction_y] == 0.)
      return 0.;
    constexpr double shift = 1e-40;
    State<Complex>   y;
    for (unsigned int i = 0; i < n_unknowns; ++i)
      y[i] = {x[i], shift * direction[i]};
    return ratio_of(y,
                    Complex(pressure, shift * pressure_rate),
                    Complex(0., 0.))
             .imag() /
           shift;
  }



  // With a spring the contact moves with V - c df_t/dt.
  inline ReferenceLaw::Pair ReferenceLaw::elastic(const Pair &motion) const
  {
    const Pair share = product(elastic_share, motion);
    return {{alpha * share[0], alpha * share[1]}};
  }



  inline PointState ReferenceLaw::rates_at_rest(const Drive      &drive,
                                                const Mode        mode,
                                                const PointState &x) const
  {
    PointState rates{};
    if (mode != Mode::open)
      {
        const Pair f       = elastic(product(cone, drive.velocity));
        rates[traction_x]  = f[0];
        rates[traction_y]  = f[1];
        rates[contact_age] = 1.;
      }
    rates[coefficient] = xi * std::expm1(b * (mu_s - x[coefficient]));
    rates[temperature] = -x[temperature] / t_c;
    return rates;
  }



  inline PointState ReferenceLaw::rates_per_slip(const PointState &x) const
  {
    PointState   rates{};
    const double norm = std::hypot(x[traction_x], x[traction_y]);
    const Pair   f    = elastic({{x[traction_x] / norm, x[traction_y] / norm}});
    rates[traction_x] = -f[0];
    rates[traction_y] = -f[1];
    rates[coefficient] = -kappa * std::expm1(a * (x[coefficient] - mu_k));
    const Pair e =
      product(inverse_cone, {{x[traction_x] / norm, x[traction_y] / norm}});
    rates[slip_path]   = std::hypot(e[0], e[1]);
    rates[temperature] = h * norm;
    rates[contact_age] = -x[contact_age] / renewal_length;
    rates[dissipation] = norm;
    return rates;
  }



  inline double ReferenceLaw::elastic_ratio_rate(const Drive      &drive,
                                                 const double      time,
                                                 const PointState &x) const
  {
    return ratio_along(x,
                       drive.pressure_at(time),
                       rates_at_rest(drive, Mode::sticks, x),
                       drive.pressure_rate);
  }



  // Without a rate effect r = r_s, so r grows with slip as r_s does.
  inline double ReferenceLaw::consistent_rate(const Drive      &drive,
                                              const double      time,
                                              const PointState &x) const
  {
    const double pressure = drive.pressure_at(time);
    const double per_slip = ratio_along(x, pressure, rates_per_slip(x), 0.);
    const double r_s      = has_subloading ? ratio_of(x, pressure, 0.) : 1.;
    return elastic_ratio_rate(drive, time, x) /
           (normal_ratio_rate(r_s) - per_slip);
  }



  // |f| = r tau_y(lambda(r)), or |f| = r_s tau_y(lambda): both right-hand sides
  // grow where sliding is stable.
  inline double ReferenceLaw::rate_with_rate_effects(const double      pressure,
                                                     const PointState &x) const
  {
    const double norm    = std::hypot(x[traction_x], x[traction_y]);
    const double r_s     = x[normal_ratio];
    const double at_rest = ratio_of(x, pressure, 0.);
    if (flow == Flow::none)
      {
        if (rise != 0.)
          throw std::invalid_argument("stribeck needs an overstress here");
        return (norm / r_s - strength(x, norm, pressure, 0.)) / drag;
      }
    if (at_rest <= r_s)
      return flow_rate(at_rest, r_s);
    const auto excess = [&](const double r) {
      return norm - r * strength(x, norm, pressure, flow_rate(r, r_s));
    };
    double upper = at_rest;
    while (excess(upper) > 0. && upper < 100. &&
           (flow == Flow::perzyna || upper < r_m))
      upper *= 1.1;
    if (flow == Flow::overstress)
      upper = std::min(upper, r_m);
    if (!(excess(upper) < 0.))
      return flow_rate(upper, r_s);
    boost::uintmax_t iterations = 200;
    const auto       bracket    = boost::math::tools::toms748_solve(
      excess,
      r_s,
      upper,
      boost::math::tools::eps_tolerance<double>(53),
      iterations);
    return flow_rate((bracket.first + bracket.second) / 2., r_s);
  }



  inline double ReferenceLaw::slip_rate(const Drive      &drive,
                                        const double      time,
                                        const PointState &x) const
  {
    const double pressure = drive.pressure_at(time);
    if (depends_on_rate)
      return rate_with_rate_effects(pressure, x);
    if (flow != Flow::none)
      return flow_rate(ratio_of(x, pressure, 0.), x[normal_ratio]);
    return consistent_rate(drive, time, x);
  }



  inline PointState ReferenceLaw::rates(const Drive      &drive,
                                        const Mode        mode,
                                        const double      time,
                                        const PointState &x) const
  {
    PointState rates = rates_at_rest(drive, mode, x);
    if (mode != Mode::slips)
      return rates;
    const double     lambda   = slip_rate(drive, time, x);
    const PointState per_slip = rates_per_slip(x);
    for (unsigned int i = 0; i < n_unknowns; ++i)
      rates[i] += lambda * per_slip[i];
    rates[normal_ratio] = lambda * normal_ratio_rate(x[normal_ratio]);
    return rates;
  }
} // namespace SlipStep::Testing

#endif
