// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/step_control.h>

#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/text.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace SlipStep
{
  namespace
  {
    const char *const equal_steps_key =
      "Time stepping/Equal steps per statement";
    const char *const most_steps_key = "Time stepping/Most steps per statement";
    const char *const least_step_key = "Time stepping/Least step";

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
      "5e-4",
      Quantity(Dimension::number, 1e-14, 1.),
      "Error that a step aims at: the difference of its friction force, found "
      "by a second-order method, from that of a first-order method, as a share "
      "of the present strength. Strength, coefficient of friction and normal "
      "ratio are judged in the same way. A straight line from row to row may "
      "be off by four times the tolerance. The error of the result is smaller, "
      "and proportional to the tolerance. Between 1e-14 and 1, no unit; at 1 "
      "practically every step is accepted, so that the other keys determine "
      "the number of steps.");
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
      "Distance that the drive moves in the first step of a slide, relative to "
      "the elastic slip at which the static friction is reached. Between 1e-6 "
      "and 1e6, no unit.");
    parameters.declare(
      most_steps_key,
      "200000",
      dealii::Patterns::Integer(1, 1000000000),
      "Number of steps, rejected ones included, after which a statement of the "
      "programme is given up and the run fails; a 'follow' may have as many more "
      "as its test has rows. 1 or more.");
    parameters.declare(
      least_step_key,
      "1e-16",
      Quantity(Dimension::number, 0., 1.),
      "Least step, relative to the duration of its statement: where a smaller "
      "one is needed, the run fails. Between 0 and 1, no unit.");
    parameters.declare(
      equal_steps_key,
      "0",
      dealii::Patterns::Integer(0, 1000000),
      "Number of equal steps of each statement of the programme, and from row "
      "to row of a 'follow', whatever error they make: for convergence studies. "
      "Tolerance, Least steps per statement and First slip are not used then. "
      "0: steps are chosen by the tolerance.");
  }



  std::vector<std::string> StepControl::idle_keys(const Parameters &parameters)
  {
    if (parameters.integer(equal_steps_key) == 0)
      return {};
    return {"Time stepping/Tolerance",
            "Time stepping/Least steps per statement",
            "Time stepping/First slip"};
  }



  std::string words_of_sudden_effects(const FrictionLaw &law)
  {
    const EffectInfo *effect =
      find_effect(law.effects(),
                  [](const EffectInfo &info) { return info.is_sudden; });
    return effect == nullptr ?
             "" :
             "; where effect " + effect->name +
               " lets friction fall within less slip than the elastic slip of "
               "the contact (friction over stiffness), the contact jumps: let "
               "friction fall over more slip";
  }



  StepControl::StepControl(const Parameters  &parameters,
                           const Programme   &programme,
                           const FrictionLaw &law)
    : programme(programme)
    , tolerance(parameters.number("Time stepping/Tolerance"))
    , first_slip(parameters.number("Time stepping/First slip"))
    , least_steps(parameters.integer("Time stepping/Least steps per statement"))
    , equal_steps(parameters.integer(equal_steps_key))
    , most_steps(parameters.integer(most_steps_key))
    , least_step(parameters.number(least_step_key))
    , elastic_slip_per_pressure(law.static_coefficient() /
                                law.tangential_stiffness())
    , sudden(words_of_sudden_effects(law))
  {
    // What was set later goes before, so that a study can change the mode.
    for (const std::string &key : idle_keys(parameters))
      if (parameters.text(key) != parameters.entry(key).default_value &&
          parameters.layer(key) >= parameters.layer(equal_steps_key))
        parameters.reject(key,
                          std::string("it is not used with ") +
                            equal_steps_key + " = " +
                            std::to_string(equal_steps));
    if (equal_steps > most_steps)
      parameters.reject(most_steps_key,
                        std::string(equal_steps_key) + " = " +
                          std::to_string(equal_steps) +
                          " needs at least as many");
    start_segment();
  }



  void StepControl::plan_anew(const double step)
  {
    if (equal_steps == 0)
      plan(step);
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
    const Segment &now = programme.segments()[segment];
    if (equal_steps > 0)
      full_step = largest_step = (now.end_time - now.start_time) / equal_steps;
    if (!is_first_of_statement())
      return plan(full_step);

    const double speed    = now.end.velocity.norm();
    const double pressure = std::max(now.start.pressure, now.end.pressure);
    double       end_of_statement = now.end_time;
    rows_of_statement             = 0;
    for (std::size_t i = segment;
         i < programme.segments().size() &&
         programme.segments()[i].statement == now.statement;
         ++i)
      {
        end_of_statement = programme.segments()[i].end_time;
        ++rows_of_statement;
      }
    const double duration = end_of_statement - now.start_time;
    if (equal_steps == 0)
      largest_step = duration / least_steps;
    smallest_step      = least_step * duration;
    steps_of_statement = 0;

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



  // A run has an end.
  void StepControl::count_step()
  {
    const Segment     &now   = programme.segments()[segment];
    const unsigned int limit = most_steps + rows_of_statement - 1;
    if (++steps_of_statement <= limit)
      return;
    throw RunError(
      "Statement " + std::to_string(now.statement + 1) +
      " of the programme takes more than " + std::to_string(limit) +
      " time steps (" + most_steps_key +
      (rows_of_statement > 1 ? " and one for each row" : "") +
      "), rejected ones included: at t = " + short_text(end, 6) +
      " s they are " + short_text(step_size(), 2) + " s long; " +
      (rows_of_statement > 1 ?
         "a test that reverses or trembles needs many: allow more steps, "
         "follow fewer rows, or set a larger Time stepping/Tolerance" :
         "stick-slip, and a mass that rings on its spring, need many: allow "
         "more steps, slide less far, or damp the motion (effect viscous)") +
      sudden);
  }



  double StepControl::resolution() const
  {
    return std::max(smallest_step,
                    8. * std::numeric_limits<double>::epsilon() *
                      programme.segments()[segment].end_time);
  }



  // A step that the clock can hardly resolve is no step.
  void StepControl::shrink(const double wanted_step, const std::string &reason)
  {
    ++rejected;
    ++tries;
    count_step();
    if (!(wanted_step > resolution()))
      throw RunError("At t = " + short_text(begin, 6) +
                     " s no time step is small enough: " + reason);
    plan(wanted_step);
  }



  // Written so that an undefined error is refused, too.
  bool StepControl::would_accept(const double error) const
  {
    const double allowed =
      equal_steps > 0 ? std::numeric_limits<double>::max() : 1.5 * tolerance;
    return error <= allowed;
  }



  bool StepControl::accept(const StepError &estimate, const std::string &remedy)
  {
    const double error = estimate.measure();
    const double step  = step_size();
    const double ideal = 0.9 * std::sqrt(tolerance / std::max(error, 1e-30));
    if (!would_accept(error))
      {
        shrink(
          step * std::max(0.2, std::min(ideal, 0.7)),
          std::string(
            "to keep the allowed error (Time stepping/Tolerance), a step would "
            "have to be shorter than ") +
            least_step_key + " or the resolution of time" + sudden + remedy);
        return false;
      }

    ++accepted;
    tries = 0;
    count_step();
    // That of a line between rows does not add up, and sliding on makes good
    // what a flank in one step is off; at rest it stays.
    if (estimate.at_end > largest_error &&
        programme.segments()[segment].end.velocity.norm() == 0.)
      {
        largest_error   = estimate.at_end;
        time_of_largest = end;
      }
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



  std::string StepControl::warning() const
  {
    constexpr double much = 0.2;

    if (!(largest_error > much))
      return "";
    return "the steps are too long (" +
           (equal_steps > 0 ?
              equal_steps_key + (" = " + std::to_string(equal_steps)) :
              "Time stepping/Tolerance = " + rounded_text(tolerance, 3)) +
           "): friction is off by an estimated " + percent_text(largest_error) +
           " of its value in the step that ends at t = " +
           rounded_text(time_of_largest, 6) +
           " s, and may be wrong from there on";
  }



  void StepControl::note_lost_swing(const double share, const double time)
  {
    if (share <= lost_swing)
      return;
    lost_swing    = share;
    time_of_swing = time;
  }



  std::string StepControl::warning_of_swing() const
  {
    constexpr double much = 0.01;

    if (!(lost_swing > much))
      return "";
    return "the machine's mass begins to oscillate at t = " +
           rounded_text(time_of_swing, 6) + " s, by " +
           percent_text(lost_swing) +
           " of the friction; the steps are too long to resolve the "
           "oscillation, so it dies out at once, and its effect on the contact "
           "is missing: a smaller Time stepping/Tolerance resolves it";
  }



  void StepControl::cut(const std::string &reason)
  {
    // After so many cuts something else is wrong than the step.
    const bool is_hopeless = step_size() < 1e-9 * first_step;
    shrink(is_hopeless ? 0. : step_size() / 4., reason);
  }
} // namespace SlipStep
