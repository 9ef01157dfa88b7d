#include <slipstep/experiment/step_control.h>

#include <slipstep/utilities/exceptions.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace SlipStep
{
  namespace
  {
    const char *const equal_steps_key =
      "Time stepping/Equal steps per statement";

    // The largest number of the series not above the wanted one.
    double round_down(const double wanted)
    {
      const double position = std::floor(10. * std::log10(wanted) + 1e-6);
      return std::pow(10., position / 10.);
    }
  } // namespace



  void StepControl::declare_parameters(Parameters &parameters)
  {
    parameters.declare(
      "Time stepping/Tolerance",
      "5e-5",
      Quantity(Dimension::number, 1e-14, 1.),
      "Error of the friction force that one step may make, relative to the "
      "force at full slip, as estimated by the friction law. Between 1e-14 and "
      "1, no unit; at 1 practically every step is accepted, which leaves their "
      "number to the other keys.");
    parameters.declare(
      "Time stepping/Least steps per statement",
      "10",
      dealii::Patterns::Integer(1, 1000000),
      "Number of steps that each statement of the programme gets at least. 1 "
      "or more.");
    parameters.declare(
      "Time stepping/First slip",
      "0.1",
      Quantity(Dimension::number, 1e-6, 1e6),
      "Slip in the first step of a slide, relative to the elastic slip at which "
      "the static friction is reached. Between 1e-6 and 1e6, no unit.");
    parameters.declare(
      equal_steps_key,
      "0",
      dealii::Patterns::Integer(0, 1000000),
      "Number of equal steps of each statement of the programme, whatever error "
      "they make: for convergence studies. The keys above are not used then. 0: "
      "steps are chosen by the tolerance.");
  }



  std::vector<std::string> StepControl::idle_keys(const Parameters &parameters)
  {
    if (parameters.integer(equal_steps_key) == 0)
      return {};
    return {"Time stepping/Tolerance",
            "Time stepping/Least steps per statement",
            "Time stepping/First slip"};
  }



  StepControl::StepControl(const Parameters  &parameters,
                           const Programme   &programme,
                           const FrictionLaw &law)
    : programme(programme)
    , tolerance(parameters.number("Time stepping/Tolerance"))
    , first_slip(parameters.number("Time stepping/First slip"))
    , least_steps(parameters.integer("Time stepping/Least steps per statement"))
    , equal_steps(parameters.integer(equal_steps_key))
    , elastic_slip_per_pressure(law.static_coefficient() /
                                law.tangential_stiffness())
    , nominal_strength(law.static_coefficient() * programme.largest_pressure())
  {
    // What was set later goes before, so that a study can change the mode.
    for (const std::string &key : idle_keys(parameters))
      if (parameters.text(key) != parameters.entry(key).default_value &&
          parameters.layer(key) >= parameters.layer(equal_steps_key))
        parameters.reject(key,
                          std::string("it is not used with ") +
                            equal_steps_key + " = " +
                            std::to_string(equal_steps));
    start_segment();
  }



  bool StepControl::is_finished() const
  {
    return segment == programme.segments().size();
  }



  bool StepControl::is_first_of_statement() const
  {
    return first_of_segment && (is_finished() || segment == 0 ||
                                programme.segments()[segment - 1].statement !=
                                  programme.segments()[segment].statement);
  }



  // A replayed test has a segment per sample: there the step goes on as it was.
  void StepControl::start_segment()
  {
    first_of_segment = true;
    if (is_finished())
      return;
    if (!is_first_of_statement())
      return plan(full_step);

    const Segment &now      = programme.segments()[segment];
    const double   speed    = now.end.velocity.norm();
    const double   pressure = std::max(now.start.pressure, now.end.pressure);
    double         end_of_statement = now.end_time;
    for (std::size_t i = segment;
         i < programme.segments().size() &&
         programme.segments()[i].statement == now.statement;
         ++i)
      end_of_statement = programme.segments()[i].end_time;
    largest_step = (end_of_statement - now.start_time) /
                   (equal_steps > 0 ? equal_steps : least_steps);

    double wanted = largest_step;
    if (equal_steps == 0 && speed > 0. && pressure > 0.)
      wanted =
        std::min(wanted,
                 first_slip * elastic_slip_per_pressure * pressure / speed);
    first_step = wanted;
    plan(wanted);
  }



  void StepControl::plan(const double wanted_step)
  {
    full_step = equal_steps > 0 ?
                  std::min(wanted_step, largest_step) :
                  round_down(std::min(wanted_step, largest_step * (1. + 1e-9)));

    // The last two steps of a segment share what is left, so that no tiny one
    // remains.
    const double left = programme.segments()[segment].end_time - begin;
    // The sum of many equal steps may miss the end by some round-off.
    const double round_off = equal_steps > 0 ? 1e-3 : 1e-9;
    if (left <= full_step * (1. + round_off))
      end = programme.segments()[segment].end_time;
    else if (left < 2. * full_step)
      end = begin + left / 2.;
    else
      end = begin + full_step;
  }



  // A step that the clock can hardly resolve is no step.
  void StepControl::shrink(const double wanted_step, const std::string &reason)
  {
    ++rejected;
    const double resolution = 8. * std::numeric_limits<double>::epsilon() *
                              programme.segments()[segment].end_time;
    if (!(wanted_step > resolution))
      {
        std::ostringstream message;
        message << "At t = " << std::setprecision(6) << begin
                << " s no time step is small enough: " << reason;
        throw RunError(message.str());
      }
    plan(wanted_step);
  }



  double StepControl::relative_error(const double error,
                                     const double strength) const
  {
    return error / std::max({strength, nominal_strength, 1e-300});
  }



  // Written so that an undefined error is refused, too.
  bool StepControl::would_accept(const double error,
                                 const double strength) const
  {
    const double allowed =
      equal_steps > 0 ? std::numeric_limits<double>::max() : 1.5 * tolerance;
    return relative_error(error, strength) <= allowed;
  }



  bool StepControl::accept(const double error, const double strength)
  {
    const double step = step_size();
    const double ideal =
      0.9 *
      std::sqrt(tolerance / std::max(relative_error(error, strength), 1e-30));
    if (!would_accept(error, strength))
      {
        shrink(step * std::max(0.2, std::min(ideal, 0.7)),
               "the friction law asks for a smaller one than the clock "
               "resolves");
        return false;
      }

    ++accepted;
    begin = end;
    if (begin >= programme.segments()[segment].end_time)
      {
        ++segment;
        start_segment();
      }
    else
      {
        first_of_segment = false;
        plan(equal_steps > 0 ? largest_step :
                               std::max(step, full_step) * std::min(ideal, 2.));
      }
    return true;
  }



  void StepControl::cut(const std::string &reason)
  {
    // After so many cuts something else is wrong than the step.
    const bool is_hopeless = step_size() < 1e-9 * first_step;
    shrink(is_hopeless ? 0. : step_size() / 4., reason);
  }
} // namespace SlipStep
