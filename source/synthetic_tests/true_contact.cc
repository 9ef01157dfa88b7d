// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/synthetic_tests/true_contact.h>

#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/roots.h>

#include <boost/math/constants/constants.hpp>
#include <boost/numeric/odeint/stepper/rosenbrock4.hpp>
#include <boost/numeric/odeint/stepper/rosenbrock4_controller.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace SlipStep
{
  namespace Planting
  {
    namespace odeint = boost::numeric::odeint;

    using Vector = boost::numeric::ublas::vector<double>;
    using Matrix = boost::numeric::ublas::matrix<double>;

    namespace
    {
      constexpr double half_pi = boost::math::constants::half_pi<double>();

      /// Keeps what a step that is too long finds finite; it is rejected.
      double growth(const double exponent)
      {
        return std::expm1(std::min(exponent, 60.));
      }
    } // namespace



    double FlowRule::slip_rate(const double ratio,
                               const double normal_ratio) const
    {
      const double over = ratio - normal_ratio;
      if (over <= 0.)
        return 0.;
      if (formula == Formula::alternative)
        return base_speed * std::sinh(std::min(exponent * over, 60.));
      if (formula == Formula::third)
        return base_speed * growth(exponent * over);
      return growth(exponent * over) /
             (viscosity * std::max(maximum_ratio - ratio, 1e-6));
    }



    double FlowRule::steady_ratio(const double speed) const
    {
      if (formula == Formula::alternative)
        return 1. + std::asinh(speed / base_speed) / exponent;
      if (formula == Formula::third)
        return 1. + std::log1p(speed / base_speed) / exponent;
      return root_between(
        [&](const double r) {
          return viscosity * speed * (maximum_ratio - r) -
                 growth(exponent * (r - 1.));
        },
        1.,
        maximum_ratio,
        46);
    }



    double CoefficientRule::per_slip(const double mu) const
    {
      const double above = mu - kinetic_coefficient;
      if (softening == Formula::catalogue)
        return -rate * growth(steepness * above);
      const double fall = static_coefficient - kinetic_coefficient;
      return fall > 0. ? -above * std::abs(above) / (length * fall) : 0.;
    }



    double CoefficientRule::per_time(const double mu) const
    {
      return healing_rate == 0. ?
               0. :
               healing_rate *
                 growth(healing_steepness * (static_coefficient - mu));
    }



    void TrueContact::multiply(const OfInstant &factor)
    {
      influences.push_back(
        {[=](const Instant &now, double) { return factor(now); }, {}, {}, {}});
    }



    void TrueContact::add(const OfInstant &addition)
    {
      influences.push_back({{}, addition, {}, {}});
    }



    void TrueContact::multiply_at_speed(const OfNumber &factor)
    {
      multiply([=](const Instant &now) { return factor(now.slip_rate); });
      influences.back().depends_on_slip_rate = true;
    }



    void TrueContact::add_at_speed(const OfNumber &addition)
    {
      add([=](const Instant &now) { return addition(now.slip_rate); });
      influences.back().depends_on_slip_rate = true;
    }



    void TrueContact::remember(const OfMemory &rate,
                               const OfMemory &factor,
                               const OfNumber &first)
    {
      influences.push_back({factor, {}, rate, first});
    }



    namespace
    {
      /// Places in the vector of unknowns. Behind them stands what the
      /// influences remember.
      enum Unknown
      {
        traction_x, // in the metric of the ellipse
        traction_y,
        normal_ratio,
        coefficient,
        path,
        n_unknowns
      };

      /// From one row to the next.
      struct Interval
      {
        double                time     = 0.;
        double                duration = 1.;
        std::array<double, 2> position{};
        std::array<double, 2> velocity{};
        double                pressure      = 1.;
        double                pressure_rate = 0.;
      };

      /// The rate equations.
      class Rates
      {
      public:
        explicit Rates(const TrueContact &contact);

        Vector start(const double pressure) const;

        void
        operator()(const Vector &x, Vector &rates, const double time) const;

        /// By differences.
        void jacobian(const Vector &x,
                      Matrix       &matrix,
                      const double  time,
                      Vector       &per_time) const;

        /// Friction along both axes, at the beginning of the interval.
        std::array<double, 2> friction(const Vector &x) const;

        Interval interval;

      private:
        using Pair = std::array<double, 2>;

        Pair times_cone(const Pair &v) const
        {
          return {cone[0] * v[0] + cone[1] * v[1],
                  cone[1] * v[0] + cone[2] * v[1]};
        }

        /// Of the spring over that of the contact, alpha_t c.
        double softness(const double traction) const
        {
          return contact.stiffness * contact.compliance /
                 (1. + traction / contact.stiffening_traction);
        }

        double strength(const Instant &now, const Vector &x) const;

        /// Set the slip rate. @return r
        double solve_flow(Instant &now, const Vector &x) const;

        void traction_rates(const Instant &now,
                            const Pair    &direction,
                            Vector        &rates) const;

        const TrueContact &contact;
        bool               depends_on_slip_rate = false;
        /// Places of what influences remember; 0: nothing.
        std::vector<std::size_t> memories;
        std::size_t              size = n_unknowns;
        /// P = (P_xx, P_xy, P_yy), its square and its inverse: f_t = P f'.
        std::array<double, 3> cone, square, inverse;
        mutable Vector        shifted, rates_0, rates_1;
      };



      Rates::Rates(const TrueContact &contact)
        : contact(contact)
      {
        for (const Influence &influence : contact.influences)
          {
            memories.push_back(influence.memory_rate ? size++ : 0);
            depends_on_slip_rate =
              depends_on_slip_rate || influence.depends_on_slip_rate;
          }
        const double c    = std::cos(contact.anisotropy_angle),
                     s    = std::sin(contact.anisotropy_angle);
        const auto matrix = [c, s](const double second) {
          return std::array<double, 3>{c * c + second * s * s,
                                       (1. - second) * c * s,
                                       s * s + second * c * c};
        };
        const double ratio = contact.anisotropy_ratio;
        cone               = matrix(ratio);
        square             = matrix(ratio * ratio);
        inverse            = matrix(1. / ratio);
      }



      Vector Rates::start(const double pressure) const
      {
        Vector x(size, 0.);
        x[coefficient] = contact.coefficient.static_coefficient;
        for (std::size_t i = 0; i < memories.size(); ++i)
          if (memories[i] > 0 && contact.influences[i].first_memory)
            x[memories[i]] = contact.influences[i].first_memory(pressure);
        return x;
      }



      double Rates::strength(const Instant &now, const Vector &x) const
      {
        double factor = 1., sum = 0.;
        for (std::size_t i = 0; i < memories.size(); ++i)
          {
            const Influence &influence = contact.influences[i];
            const double     memory    = memories[i] > 0 ? x[memories[i]] : 0.;
            if (influence.factor)
              factor *= influence.factor(now, memory);
            if (influence.addition)
              sum += influence.addition(now);
          }
        return now.pressure * now.coefficient * factor + sum;
      }



      // The ratio is the unknown where the strength depends on the slip rate: r
      // tau_y(lambda(r)) grows with r as long as sliding is stable. Stages of a
      // step that is too long may be anywhere; any answer gets them rejected.
      double Rates::solve_flow(Instant &now, const Vector &x) const
      {
        const double r_s     = std::clamp(x[normal_ratio], 0., 1.5);
        now.slip_rate        = 0.;
        const double at_rest = now.traction / strength(now, x);
        now.slip_rate        = contact.flow.slip_rate(at_rest, r_s);
        if (!depends_on_slip_rate || !(now.slip_rate > 0.))
          return at_rest;

        const auto excess = [&](const double r) {
          now.slip_rate = contact.flow.slip_rate(r, r_s);
          return now.traction - r * strength(now, x);
        };
        double lower = r_s, upper = at_rest;
        while (excess(upper) > 0. && upper < 10.)
          {
            lower = upper;
            upper *= 1.05;
          }
        if (!(excess(lower) > 0. && excess(upper) < 0.))
          return upper;
        const double r = root_between(excess, lower, upper, 46);
        now.slip_rate  = contact.flow.slip_rate(r, r_s);
        return r;
      }



      // With a spring of compliance c the contact moves with V - c df_t/dt.
      void Rates::traction_rates(const Instant &now,
                                 const Pair    &direction,
                                 Vector        &rates) const
      {
        const double alpha = contact.stiffness;
        const Pair   drive = times_cone(interval.velocity);
        const Pair   right{alpha * (drive[0] - now.slip_rate * direction[0]),
                         alpha * (drive[1] - now.slip_rate * direction[1])};
        const double soft = softness(now.traction);
        const double xx = 1. + soft * square[0], xy = soft * square[1],
                     yy = 1. + soft * square[2], det = xx * yy - xy * xy;
        rates[traction_x] = (yy * right[0] - xy * right[1]) / det;
        rates[traction_y] = (xx * right[1] - xy * right[0]) / det;
      }



      void
      Rates::operator()(const Vector &x, Vector &rates, const double time) const
      {
        // r_s follows r within this share of the time in which r changes.
        constexpr double lag = 1e-4;

        const double passed = time - interval.time;
        const double norm   = std::hypot(x[traction_x], x[traction_y]);
        const Pair   direction =
          norm > 1e-14 ? Pair{x[traction_x] / norm, x[traction_y] / norm} :
                           Pair{0., 0.};
        Instant now;
        now.pressure      = interval.pressure + passed * interval.pressure_rate;
        now.pressure_rate = interval.pressure_rate;
        now.slip_rate     = 0.;
        now.traction      = norm;
        now.coefficient   = x[coefficient];
        now.path          = x[path];
        now.progress      = contact.progress;
        for (unsigned int i = 0; i < 2; ++i)
          now.position[i] =
            interval.position[i] + passed * interval.velocity[i];
        now.direction = {inverse[0] * direction[0] + inverse[1] * direction[1],
                         inverse[1] * direction[0] + inverse[2] * direction[1]};
        const double length = std::hypot(now.direction[0], now.direction[1]);
        if (length > 0.)
          now.direction = {now.direction[0] / length,
                           now.direction[1] / length};

        const double r = solve_flow(now, x), r_s = x[normal_ratio];
        traction_rates(now, direction, rates);
        rates[path] = now.slip_rate;
        rates[coefficient] =
          now.slip_rate * contact.coefficient.per_slip(now.coefficient) +
          contact.coefficient.per_time(now.coefficient);
        const double haste =
          contact.stiffness / (1. + softness(norm)) *
            std::hypot(interval.velocity[0], interval.velocity[1]) /
            (now.pressure * now.coefficient) +
          std::abs(now.pressure_rate) / now.pressure + 0.01;
        rates[normal_ratio] = r < r_s ?
                                -(r_s - r) * haste / lag :
                                contact.subloading_rate * now.slip_rate /
                                  std::tan(half_pi * std::clamp(r_s, lag, 1.5));
        for (std::size_t i = 0; i < memories.size(); ++i)
          if (memories[i] > 0)
            rates[memories[i]] =
              contact.influences[i].memory_rate(now, x[memories[i]]);
      }



      void Rates::jacobian(const Vector &x,
                           Matrix       &matrix,
                           const double  time,
                           Vector       &per_time) const
      {
        rates_0.resize(size, false);
        rates_1.resize(size, false);
        (*this)(x, rates_0, time);
        shifted = x;
        for (std::size_t j = 0; j < size; ++j)
          {
            const double shift = 1e-7 * std::max(std::abs(x[j]), 1e-3);
            shifted[j]         = x[j] + shift;
            (*this)(shifted, rates_1, time);
            shifted[j] = x[j];
            for (std::size_t i = 0; i < size; ++i)
              matrix(i, j) = (rates_1[i] - rates_0[i]) / shift;
          }
        // Central, since an error of it is one of the step.
        const double shift = 1e-3 * interval.duration;
        (*this)(x, rates_0, time - shift);
        (*this)(x, rates_1, time + shift);
        per_time = (rates_1 - rates_0) / (2. * shift);
      }



      std::array<double, 2> Rates::friction(const Vector &x) const
      {
        const Pair f = times_cone({x[traction_x], x[traction_y]});
        return {f[0] / interval.pressure, f[1] / interval.pressure};
      }



      Interval interval_of(const MeasuredTest &motion, const std::size_t row)
      {
        const std::size_t next = std::min(row + 1, motion.time.size() - 1);
        Interval          result;
        result.time      = motion.time[row];
        result.pressure  = motion.pressure[row];
        const auto place = [&](const std::vector<double> &values,
                               const unsigned int         axis) {
          if (values.empty())
            return;
          result.position[axis] = values[row];
          if (next > row)
            result.velocity[axis] = (values[next] - values[row]) /
                                    (motion.time[next] - motion.time[row]);
        };
        place(motion.displacement, 0);
        place(motion.displacement_y, 1);
        if (next > row)
          {
            result.duration = motion.time[next] - motion.time[row];
            result.pressure_rate =
              (motion.pressure[next] - motion.pressure[row]) / result.duration;
          }
        return result;
      }



      /// Whether speed, direction or rate of the pressure change.
      bool is_abrupt(const Interval &before, const Interval &now)
      {
        const double change = std::hypot(now.velocity[0] - before.velocity[0],
                                         now.velocity[1] - before.velocity[1]);
        const double speed  = std::hypot(now.velocity[0], now.velocity[1]);
        return change > 1e-6 * speed ||
               std::abs(now.pressure_rate - before.pressure_rate) >
                 1e-6 * std::abs(now.pressure_rate);
      }



      /// Goes through a test row by row.
      class Integrator
      {
      public:
        Integrator(const TrueContact &contact, const double tolerance)
          : rates(contact)
          , stepper(1e-2 * tolerance, tolerance, odeint::rosenbrock4<double>())
        {}

        TrueFriction run(const MeasuredTest &motion);

      private:
        void cross_interval(Vector &x);

        Rates                                                       rates;
        odeint::rosenbrock4_controller<odeint::rosenbrock4<double>> stepper;
        double wanted_step = 1e-6;
      };



      void Integrator::cross_interval(Vector &x)
      {
        const double end = rates.interval.time + rates.interval.duration;
        const auto   system =
          std::make_pair(std::cref(rates),
                         [this](const Vector &x,
                                Matrix       &matrix,
                                const double &time,
                                Vector       &per_time) {
                           rates.jacobian(x, matrix, time, per_time);
                         });
        double time = rates.interval.time;
        for (unsigned int n = 0; time < end; ++n)
          {
            if (n > 100000)
              throw RunError("the hidden truth: no time step is small enough");
            const double left       = end - time;
            const bool   is_cut     = wanted_step >= left;
            double       step       = is_cut ? left : wanted_step;
            double       time_there = time;
            if (stepper.try_step(system, x, time_there, step) ==
                odeint::success)
              {
                time        = is_cut ? end : time_there;
                wanted_step = is_cut ? std::max(wanted_step, step) : step;
              }
            else
              wanted_step = step;
          }
      }



      TrueFriction Integrator::run(const MeasuredTest &motion)
      {
        TrueFriction result;
        Vector       x = rates.start(motion.pressure.front());
        Interval     before;
        for (std::size_t row = 0; row < motion.time.size(); ++row)
          {
            rates.interval      = interval_of(motion, row);
            const auto friction = rates.friction(x);
            result.along_x.push_back(friction[0]);
            result.along_y.push_back(friction[1]);
            if (row + 1 == motion.time.size())
              break;
            if (is_abrupt(before, rates.interval))
              wanted_step = 1e-5 * rates.interval.duration;
            before = rates.interval;
            cross_interval(x);
          }
        return result;
      }
    } // namespace



    TrueFriction simulate(const TrueContact  &contact,
                          const MeasuredTest &motion,
                          const double        tolerance)
    {
      return Integrator(contact, tolerance).run(motion);
    }
  } // namespace Planting
} // namespace SlipStep
