// SPDX-License-Identifier: LGPL-2.1-or-later
#include <deal.II/base/utilities.h>

#include <slipstep/experiment/point_driver.h>
#include <slipstep/experiment/contact_under_load.h>
#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/paths.h>

#include <cmath>
#include <optional>

namespace SlipStep
{
  using dealii::Tensor;



  void declare_loading_parameters(Parameters &parameters)
  {
    parameters.declare(
      "Loading/Programme",
      "press 5.8 MPa in 1 s; hold 10 s; slide for 10 mm",
      dealii::Patterns::Anything(),
      "What happens, one statement after the other, separated by ';': 'press "
      "<pressure> in <time>', 'hold <time>', 'slide [<speed>] for <length or "
      "time> [at <angle>]', 'push <traction> in <time> [at <angle>]', 'push "
      "between <traction> and <traction> <number> times, <time> each', "
      "'follow <file of a measured test>', 'repeat <number> "
      "times { <statements> }'. A negative speed reverses. Units are part of "
      "every number.");
    parameters.declare("Loading/Speed",
                       "1 mm/min",
                       Quantity(Dimension::speed, 0., 1e30, true, true),
                       "Speed of every 'slide' that states none; the key to "
                       "sweep when one case runs at several speeds. More than "
                       "0, with its unit.");
    Machine::declare_parameters(parameters);
    StepControl::declare_parameters(parameters);
  }



  Programme parse_programme(const Parameters &parameters)
  {
    try
      {
        return Programme(parameters.text("Loading/Programme"),
                         parameters.number("Loading/Speed"),
                         parameters.resolve("."));
      }
    catch (const InputError &error)
      {
        throw InputError(parameters.origin("Loading/Programme") + ": " +
                         error.what());
      }
  }



  Parameters relocated_case(const Parameters            &parameters,
                            const std::filesystem::path &folder)
  {
    Parameters result = parameters;
    result.rewrite("Loading/Programme", [&](const std::string &text) {
      return relocated_programme(text, parameters.resolve("."), folder);
    });
    for (const std::string prefix : {"Calibration/Tests", "Report/Measured"})
      for (const std::string &key : parameters.paths(prefix))
        result.rewrite(key, [&](const std::string &text) {
          std::string files;
          for (const std::string &file :
               dealii::Utilities::split_string_list(text, ","))
            files += (files.empty() ? "" : ", ") +
                     path_from(folder, parameters.resolve(file));
          return files;
        });
    // Written down, what a later setting has made idle would be an error.
    for (const std::string &key : StepControl::idle_keys(parameters))
      result.rewrite(key, [&](const std::string &) {
        return parameters.entry(key).default_value;
      });
    return result;
  }



  namespace
  {
    Spread single(const double value)
    {
      return {value, value, value};
    }



    // The normal stiffness is linear: its work is what it stores.
    double normal_energy(const FrictionLaw &law, const ContactState &state)
    {
      return std::pow(state.normal_traction, 2) / (2. * law.normal_stiffness());
    }



    // What the contact alone has to say after a step.
    HistoryRow row_of(const FrictionLaw  &law,
                      const ContactPoint &point,
                      const double        pressure)
    {
      const ContactState &state     = point.trial();
      const bool          is_closed = pressure > 0.;
      HistoryRow          row;
      row.pressure          = pressure;
      row.friction          = is_closed ? state.traction[0] / pressure : 0.;
      row.friction_y        = is_closed ? state.traction[1] / pressure : 0.;
      row.normal_load       = pressure;
      row.tangential_load   = state.traction[0];
      row.loading_ratio     = single(state.loading_ratio);
      row.normal_ratio      = single(state.normal_ratio);
      row.coefficient       = single(state.coefficient);
      row.dissipated_energy = state.dissipation;
      row.stored_energy = normal_energy(law, state) + law.stored_energy(state);
      row.newton_iterations = 1;
      row.slip              = state.slip_path;
      row.memories          = state.memories;
      return row;
    }



    /// A contact point at the end of a machine, led through a programme.
    class PointDrive
    {
    public:
      PointDrive(const FrictionLaw &law,
                 const Programme   &programme,
                 const StepControl &control,
                 const Machine     &machine)
        : law(law)
        , programme(programme)
        , machine(machine)
        , control(control)
        , point(law)
      {}

      StepControl run(const std::function<void(const HistoryRow &)> &observe);

    private:
      std::optional<MachineStep> make_step(const Segment &segment,
                                           const Loading &to);

      bool accept(const MachineStep &step, const double pressure);

      HistoryRow commit(const MachineStep &step, const Loading &to);

      const FrictionLaw &law;
      const Programme   &programme;
      const Machine     &machine;
      StepControl        control;
      ContactPoint       point;
      Slider             slider;
      Tensor<1, 2>       load_before; ///< when the segment began
      Tensor<1, 2>       pushed;      ///< motion of the drive that loads made
      double             work = 0., snapped = 0.;
    };



    // None if the contact does not hold the load.
    std::optional<MachineStep> PointDrive::make_step(const Segment &segment,
                                                     const Loading &to)
    {
      const Loading from      = programme.at(control.time());
      const double  step_size = control.step_size();
      if (control.is_first_of_segment())
        load_before = slider.load;
      const double share = (control.end_of_step() - segment.start_time) /
                           (segment.end_time - segment.start_time);
      const Tensor<1, 2> load =
        share < 1. ? load_before + share * (segment.push - load_before) :
                     segment.push;
      const MachineStep step =
        segment.pushes ?
          machine.push(law, point, slider, load, to.pressure, step_size) :
          machine.step(law,
                       point,
                       slider,
                       to.displacement - from.displacement,
                       to.pressure,
                       step_size,
                       control.shortest_step());
      if (step.holds)
        return step;
      control.cut(
        reason_of_slip(load.norm() < slider.load.norm() ? load : segment.push,
                       slider.load,
                       from.pressure) +
        " (with a Loading/Machine mass the contact would go on sliding)");
      return {};
    }



    bool PointDrive::accept(const MachineStep &step, const double pressure)
    {
      const double start = control.time();
      const double weight =
        programme.weight_of_error(start, control.end_of_step());
      StepError error = machine.error(law, point, step);
      error.at_end *= weight;
      error.of_line *= weight;
      const bool is_first = control.is_first_of_segment();
      if (!control.accept(error))
        return false;
      if (is_first && pressure > 0.)
        control.note_lost_swing(machine.lost_swing(step) /
                                  point.trial().strength,
                                start);
      return true;
    }



    HistoryRow PointDrive::commit(const MachineStep &step, const Loading &to)
    {
      work += normal_energy(law, point.trial()) -
              normal_energy(law, point.committed()) + step.work;
      // A contact that opens lets a spring without mass go.
      if (to.pressure <= 0. && machine.mass() == 0.)
        snapped += machine.stored_energy(slider);
      slider = step.slider;
      point.commit();

      HistoryRow row     = row_of(law, point, to.pressure);
      row.time           = control.time();
      row.displacement   = to.displacement[0] + pushed[0];
      row.displacement_y = to.displacement[1] + pushed[1];
      row.slip_fraction  = step.contact.slips ? 1. : 0.;
      row.dissipated_energy += snapped;
      row.stored_energy += machine.stored_energy(slider);
      row.kinetic_energy = machine.kinetic_energy(slider);
      row.external_work  = work;
      if (!machine.is_rigid())
        row.probes = Machine::probes(slider, to.pressure);
      return row;
    }



    StepControl
    PointDrive::run(const std::function<void(const HistoryRow &)> &observe)
    {
      while (!control.is_finished())
        {
          const Segment &segment = programme.segment_at(control.end_of_step());
          const Loading  to      = programme.at(control.end_of_step());
          const double   step_size              = control.step_size();
          const std::optional<MachineStep> step = make_step(segment, to);
          if (!step.has_value() || !accept(*step, to.pressure))
            continue;
          if (segment.pushes)
            pushed += step->motion;
          HistoryRow row = commit(*step, to);
          row.step_size  = step_size;
          observe(row);
        }
      return control;
    }
  } // namespace



  StepControl
  drive_point(const FrictionLaw                             &law,
              const Programme                               &programme,
              StepControl                                    control,
              const std::function<void(const HistoryRow &)> &observe,
              const Machine                                 &machine)
  {
    return PointDrive(law, programme, control, machine).run(observe);
  }
} // namespace SlipStep
