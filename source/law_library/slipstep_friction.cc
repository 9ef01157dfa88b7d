// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/utilities.h>

#include <slipstep/friction/contact_point.h>
#include <slipstep/friction/state_numbers.h>
#include <slipstep/law_library/slipstep_friction.h>
#include <slipstep/utilities/text.h>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

struct slipstep_law
{
  explicit slipstep_law(const SlipStep::Parameters &parameters)
    : law(parameters)
    , numbers(law)
  {}

  const SlipStep::FrictionLaw  law;
  const SlipStep::StateNumbers numbers;
};

namespace SlipStep
{
  namespace
  {
    void tell(const std::string &text, char *message, const std::size_t size)
    {
      if (message == nullptr || size == 0)
        return;
      const std::string line = essential_lines(text, 3);
      std::strncpy(message, line.c_str(), size - 1);
      message[size - 1] = '\0';
    }

    /// A step from one state to another, in parts within which slip and
    /// pressure change evenly.
    class PartedStep
    {
    public:
      PartedStep(const FrictionLaw  &law,
                 const ContactState &start,
                 const double        time_step)
        : law(law)
        , start(start)
        , time_step(time_step)
      {}

      /// Find parts so short that the estimated error of each is small: an
      /// increment of a host program may be as long as a contact needs to
      /// relax, or to unload.
      ContactState find_parts(const dealii::Tensor<1, 2> &slip,
                              const double                pressure)
      {
        return find_parts(start, 0., 1., slip, pressure);
      }

      /// The same parts for other increments.
      ContactState repeat(const dealii::Tensor<1, 2> &slip,
                          const double                pressure) const;

    private:
      ContactState find_parts(const ContactState         &from,
                              const double                begin,
                              const double                end,
                              const dealii::Tensor<1, 2> &slip,
                              const double                pressure);

      // Both stages of a part.
      ContactPoint part(const ContactState         &from,
                        const double                begin,
                        const double                end,
                        const dealii::Tensor<1, 2> &slip,
                        const double                pressure) const;

      const FrictionLaw  &law;
      const ContactState  start;
      const double        time_step;
      std::vector<double> ends;        ///< of the parts, as shares of the step
      unsigned int        n_jumps = 0; ///< parts that are off, however short
    };



    ContactPoint PartedStep::part(const ContactState         &from,
                                  const double                begin,
                                  const double                end,
                                  const dealii::Tensor<1, 2> &slip,
                                  const double                pressure) const
    {
      const auto pressure_at = [&](const double share) {
        return (1. - share) * start.normal_traction + share * pressure;
      };
      const double stage = TwoStages::gamma * (end - begin);
      ContactPoint point(from);
      point.update(law,
                   stage * slip,
                   pressure_at(begin + stage),
                   stage * time_step);
      point.begin_second_stage(law);
      point.update(law, stage * slip, pressure_at(end), stage * time_step);
      return point;
    }



    // As a share of the strength.
    double distance(const ContactState &one, const ContactState &other)
    {
      return one.strength > 0. ?
               std::max((one.traction - other.traction).norm() / one.strength,
                        std::abs(one.normal_ratio - other.normal_ratio)) :
               0.;
    }



    // Slip turns where the strength falls below the traction, which three
    // stages in one part and in its halves may pass alike.
    bool unloads_too_much(const ContactState &begin, const ContactState &end)
    {
      constexpr double least = 0.5;
      return end.normal_traction > 0. &&
             end.normal_traction < least * begin.normal_traction;
    }



    // Where slip begins, a step of one stage returns straight to the strength
    // all that lies beyond, and so turns too much. A part of which only the
    // last stage slips is such a step, and both of its halves may end alike.
    double error_of_turn(const FrictionLaw  &law,
                         const ContactState &begin,
                         const ContactPoint &part,
                         const double        last_stage)
    {
      const ContactState &end = part.trial();
      if (part.stage_start().slip_rate > 0. || !(end.slip_rate > 0.))
        return 0.;
      const double share =
        law.tangential_stiffness() * end.slip_rate * last_stage / end.strength;
      const dealii::Tensor<1, 2> traction =
        law.isotropic_traction(end.traction);
      const dealii::Tensor<1, 2> path =
        law.isotropic_traction(part.stage_start().traction - begin.traction);
      // Of second order in the slip along and across the traction.
      return 0.5 * share * std::abs(dealii::cross_product_2d(path) * traction) /
             (traction.norm() * end.strength);
    }



    // By halves: where a host's iteration varies an increment a little, most
    // parts stay, and the tangent is that of what is computed.
    ContactState PartedStep::find_parts(const ContactState         &from,
                                        const double                begin,
                                        const double                end,
                                        const dealii::Tensor<1, 2> &slip,
                                        const double                pressure)
    {
      // A little more than what slipstep itself allows, so that its own steps
      // stay whole.
      constexpr double       allowed = 1e-3, shortest = 1e-14;
      constexpr double       allowed_of_work = 5e-3;
      constexpr std::size_t  most_parts      = 10000;
      constexpr unsigned int most_jumps      = 5;

      const ContactPoint tried  = part(from, begin, end, slip, pressure);
      const double       middle = 0.5 * (begin + end);
      // Two estimates: the one of two halves does not see what both halves
      // miss, the one of a part how far its stages are from each other.
      const auto is_good = [&]() {
        if (tried.error(law).at_end > allowed ||
            unloads_too_much(from, tried.trial()) ||
            error_of_turn(
              law, from, tried, TwoStages::gamma * (end - begin) * time_step) >
              allowed)
          return false;
        const ContactState halves =
          part(part(from, begin, middle, slip, pressure).trial(),
               middle,
               end,
               slip,
               pressure)
            .trial();
        const double strength = std::max(from.strength, tried.trial().strength);
        const double work     = strength * ((end - begin) * slip.norm() +
                                        strength / law.tangential_stiffness());
        return distance(halves, tried.trial()) <= allowed &&
               std::abs(halves.dissipation - tried.trial().dissipation) <=
                 allowed_of_work * work;
      };
      if (end - begin < shortest || is_good())
        {
          if (end - begin < shortest && ++n_jumps > most_jumps)
            throw RunError("friction jumps again and again, however short the "
                           "step: where it falls with speed or slip, effect "
                           "overstress or viscous lets it rise at once");
          if (ends.size() == most_parts)
            throw RunError("the step is too long: it needs more than 10000 "
                           "parts");
          ends.push_back(end);
          return tried.trial();
        }
      return find_parts(find_parts(from, begin, middle, slip, pressure),
                        middle,
                        end,
                        slip,
                        pressure);
    }



    ContactState PartedStep::repeat(const dealii::Tensor<1, 2> &slip,
                                    const double                pressure) const
    {
      ContactState state = start;
      double       begin = 0.;
      for (const double end : ends)
        {
          state = part(state, begin, end, slip, pressure).trial();
          begin = end;
        }
      return state;
    }



    /// Distances for differences: a millionth of what makes a difference.
    constexpr double difference = 1e-6;

    void differentiate(const slipstep_law         &law,
                       const PartedStep           &step,
                       const dealii::Tensor<1, 2> &slip,
                       const double                pressure,
                       const ContactState         &end,
                       double                     *d_slip,
                       double                     *d_pressure)
    {
      const auto traction = [&](const dealii::Tensor<1, 2> &at_slip,
                                const double                at_pressure) {
        return step.repeat(at_slip, at_pressure).traction;
      };
      if (d_slip != nullptr)
        {
          const double distance =
            difference *
            (slip.norm() + end.strength / law.law.tangential_stiffness());
          for (unsigned int j = 0; j < 2; ++j)
            {
              dealii::Tensor<1, 2> change;
              change[j]        = distance;
              const auto slope = (traction(slip + change, pressure) -
                                  traction(slip - change, pressure)) /
                                 (2. * distance);
              for (unsigned int i = 0; i < 2; ++i)
                d_slip[2 * i + j] = slope[i];
            }
        }
      if (d_pressure != nullptr)
        {
          const double distance = difference * pressure;
          const auto   slope    = (traction(slip, pressure + distance) -
                              traction(slip, pressure - distance)) /
                             (2. * distance);
          for (unsigned int i = 0; i < 2; ++i)
            d_pressure[i] = slope[i];
        }
    }

    bool is_finite(const double *const numbers, const std::size_t n)
    {
      return std::all_of(numbers, numbers + n, [](const double x) {
        return std::isfinite(x);
      });
    }



    // What no step leaves behind.
    void check_state(const FrictionLaw &law, const ContactState &state)
    {
      const auto check = [](const char  *name,
                            const double value,
                            const double least,
                            const double greatest) {
        constexpr double round_off = 1e-6;
        if (value < least - round_off || value > greatest + round_off)
          throw InputError(
            "the state has " + std::string(name) + " = " +
            rounded_text(value, 4) +
            ", which no step leaves behind: the first one is slipstep_initial_state()'s");
      };
      const auto [smallest, largest] = law.coefficient_range();
      check("mu", state.coefficient, smallest, largest);
      check("r_s", state.normal_ratio, 0., 1.);
      for (const auto &[name, value] :
           {std::pair("normal_traction_MPa", state.normal_traction),
            {"strength_MPa", state.strength},
            {"slip_path_mm", state.slip_path},
            {"slip_rate_mm_per_s", state.slip_rate}})
        check(name, value, 0., std::numeric_limits<double>::infinity());
      for (const ContactMemory &memory : law.memories())
        check(memory.name, state[memory], memory.least, memory.greatest);
      if (state.normal_traction == 0. && state.traction.norm() > 0.)
        throw InputError("the state has a traction without pressure");
    }



    slipstep_law *read(const std::filesystem::path &file,
                       char                        *message,
                       const std::size_t            size)
    {
      try
        {
          Parameters parameters;
          FrictionLaw::declare_parameters(parameters);
          parameters.read(file);
          if (!parameters.variants().empty())
            throw InputError(file.string() +
                             ": a sweep has several laws; \"slipstep export\" "
                             "writes one");
          return new slipstep_law(parameters);
        }
      catch (const std::exception &error)
        {
          tell(error.what(), message, size);
        }
      return nullptr;
    }
  } // namespace
} // namespace SlipStep

using namespace SlipStep;

slipstep_law *
slipstep_law_read(const char *file, char *message, const size_t size)
{
  return read(file, message, size);
}



slipstep_law *
slipstep_law_parse(const char *text, char *message, const size_t size)
{
  // A case is read from a file, which its messages name.
  std::string name =
    (std::filesystem::temp_directory_path() / "slipstep_law_XXXXXX.prm")
      .string();
  const int descriptor = mkstemps(name.data(), 4);
  if (descriptor < 0)
    {
      tell("no temporary file can be written in " +
             std::filesystem::temp_directory_path().string(),
           message,
           size);
      return nullptr;
    }
  close(descriptor);
  std::ofstream(name) << text;
  slipstep_law *const law = read(name, message, size);
  std::filesystem::remove(name);
  return law;
}



slipstep_law *slipstep_law_named(const char  *folder,
                                 const char  *name,
                                 char *const  message,
                                 const size_t size)
{
  static std::mutex                                           mutex;
  static std::map<std::string, std::unique_ptr<slipstep_law>> laws;
  const std::lock_guard<std::mutex>                           lock(mutex);
  const std::string                                           file =
    (std::filesystem::path(folder) /
     (lower_case(dealii::Utilities::trim(name)) + ".prm"))
      .string();
  std::unique_ptr<slipstep_law> &law = laws[file];
  if (law == nullptr)
    law.reset(read(file, message, size));
  return law.get();
}



void slipstep_law_free(slipstep_law *const law)
{
  delete law;
}



int slipstep_state_size(const slipstep_law *const law)
{
  return static_cast<int>(law->numbers.size());
}



const char *slipstep_state_name(const slipstep_law *const law, const int i)
{
  return i < 0 || i >= slipstep_state_size(law) ? "" : law->numbers.name(i);
}



void slipstep_initial_state(const slipstep_law *const law, double *const state)
{
  law->numbers.write(law->law.initial_state(), state);
}



void slipstep_elastic_slip(const slipstep_law *const law,
                           const double *const       traction,
                           double *const             slip)
{
  const dealii::Tensor<1, 2> elastic =
    law->law.elastic_slip(dealii::Tensor<1, 2>({traction[0], traction[1]}));
  slip[0] = elastic[0];
  slip[1] = elastic[1];
}



double slipstep_stored_energy(const slipstep_law *const law,
                              const double *const       state)
{
  return law->law.stored_energy(law->numbers.read(state));
}



double slipstep_tangential_stiffness(const slipstep_law *const law)
{
  return law->law.tangential_stiffness();
}



double slipstep_normal_stiffness(const slipstep_law *const law)
{
  return law->law.normal_stiffness();
}



int slipstep_step(const slipstep_law *const law,
                  const double *const       start,
                  const double              slip[2],
                  const double              pressure,
                  const double              time_step,
                  double *const             end,
                  double                    traction[2],
                  double                    d_slip[4],
                  double                    d_pressure[2],
                  char *const               message,
                  const size_t              size)
{
  try
    {
      const ContactState first = law->numbers.read(start);
      if (!is_finite(start, law->numbers.size()))
        throw InputError("the state has a number that is not finite");
      if (!std::isfinite(slip[0]) || !std::isfinite(slip[1]) ||
          !std::isfinite(pressure))
        throw InputError("slip and pressure of a step have to be finite");
      if (!(time_step > 0.) || !std::isfinite(time_step))
        throw InputError("the time step has to be positive");
      const dealii::Tensor<1, 2> increment({slip[0], slip[1]});
      check_state(law->law, first);
      PartedStep         step(law->law, first, time_step);
      const ContactState last      = step.find_parts(increment, pressure);
      double             slopes[6] = {0., 0., 0., 0., 0., 0.};
      if (pressure > 0. && (d_slip != nullptr || d_pressure != nullptr))
        differentiate(*law,
                      step,
                      increment,
                      pressure,
                      last,
                      d_slip == nullptr ? nullptr : slopes,
                      d_pressure == nullptr ? nullptr : slopes + 4);
      std::vector<double> numbers(law->numbers.size());
      law->numbers.write(last, numbers.data());
      if (!is_finite(numbers.data(), numbers.size()) || !is_finite(slopes, 6))
        throw RunError("the result is no number: slip or pressure too large?");
      std::copy(numbers.begin(), numbers.end(), end);
      for (unsigned int i = 0; i < 2; ++i)
        traction[i] = last.traction[i];
      if (d_slip != nullptr)
        std::copy(slopes, slopes + 4, d_slip);
      if (d_pressure != nullptr)
        std::copy(slopes + 4, slopes + 6, d_pressure);
      return 0;
    }
  catch (const std::exception &error)
    {
      tell(error.what(), message, size);
      return 1;
    }
}
