// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/summary.h>

#include <slipstep/utilities/units.h>
#include <slipstep/utilities/version.h>
#include <slipstep/utilities/write_file.h>

#include <deal.II/base/numbers.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>

namespace SlipStep
{
  namespace
  {
    using json = nlohmann::ordered_json;

    constexpr double degrees   = 180. / dealii::numbers::PI;
    constexpr double undefined = QuantityOfInterest::undefined;

    json slide_to_json(const SlideSummary &slide)
    {
      return {{"speed_mm_per_min", slide.speed * mm_min},
              {"pressure_MPa", slide.pressure},
              {"angle_deg", slide.angle * degrees},
              {"length_mm", slide.length},
              {"peak", slide.peak},
              {"peak_displacement_mm", slide.peak_displacement},
              {"kinetic", slide.kinetic},
              {"r", slide.dynamic_ratio},
              {"mu", slide.coefficient},
              {"complete", slide.is_complete},
              {"statement", slide.statement},
              {"rest_before_s", slide.rest},
              {"friction_before", slide.before},
              {"dip", slide.dip},
              {"slip_fraction", slide.slip_fraction}};
    }

    /// JSON has no NaN: the library writes null, read back here.
    double number(const json &object, const char *key)
    {
      const json &value = object.at(key);
      return value.is_null() ? undefined : value.get<double>();
    }

    SlideSummary slide_from_json(const json &object)
    {
      SlideSummary slide;
      slide.speed = number(object, "speed_mm_per_min") / mm_min;
      // Older files have none.
      slide.pressure = object.value("pressure_MPa", json()).is_number() ?
                         number(object, "pressure_MPa") :
                         undefined;
      slide.angle    = number(object, "angle_deg") / degrees;
      slide.length   = number(object, "length_mm");
      slide.peak     = number(object, "peak");
      slide.peak_displacement = number(object, "peak_displacement_mm");
      slide.kinetic           = number(object, "kinetic");
      slide.dynamic_ratio     = number(object, "r");
      slide.coefficient       = number(object, "mu");
      object.at("complete").get_to(slide.is_complete);
      // Older files have none.
      slide.statement     = object.value("statement", 0u);
      slide.rest          = object.value("rest_before_s", 0.);
      slide.before        = object.value("friction_before", 0.);
      slide.dip           = object.value("dip", slide.peak);
      slide.slip_fraction = object.value("slip_fraction", 1.);
      return slide;
    }

    // Stable on no spring: JSON has no infinity, either.
    json stability_to_json(const StabilitySummary &stability)
    {
      json object = {{"speed_mm_per_min", stability.speed * mm_min},
                     {"pressure_MPa", stability.pressure},
                     {"friction", stability.friction},
                     {"stiffness_MPa_per_mm", stability.stiffness},
                     {"critical_stiffness_MPa_per_mm",
                      stability.critical_stiffness},
                     {"critical_frequency_Hz", stability.critical_frequency},
                     {"stable", stability.is_stable()}};
      return object;
    }

    StabilitySummary stability_from_json(const json &object)
    {
      StabilitySummary stability;
      stability.speed     = number(object, "speed_mm_per_min") / mm_min;
      stability.pressure  = number(object, "pressure_MPa");
      stability.friction  = number(object, "friction");
      stability.stiffness = number(object, "stiffness_MPa_per_mm");
      stability.critical_stiffness =
        number(object, "critical_stiffness_MPa_per_mm");
      stability.critical_frequency = number(object, "critical_frequency_Hz");
      if (std::isnan(stability.critical_stiffness))
        stability.critical_stiffness = std::numeric_limits<double>::infinity();
      return stability;
    }

    // Of a mesh that is not adaptive nothing is known.
    json mesh_error_to_json(const MeshErrorSummary &error)
    {
      if (error.tolerance == 0.)
        return nullptr;
      return {{"tolerance", error.tolerance},
              {"last", error.last},
              {"largest", error.largest},
              {"at_s", error.time_of_largest},
              {"steps_checked", error.n_checked},
              {"steps_missed", error.n_missed}};
    }

    MeshErrorSummary mesh_error_from_json(const json &object)
    {
      MeshErrorSummary error;
      if (object.is_null())
        return error;
      error.tolerance       = number(object, "tolerance");
      error.last            = number(object, "last");
      error.largest         = number(object, "largest");
      error.time_of_largest = number(object, "at_s");
      object.at("steps_checked").get_to(error.n_checked);
      object.at("steps_missed").get_to(error.n_missed);
      return error;
    }

    json to_json(const Summary &summary)
    {
      json quantities = json::array();
      for (const QuantityValue &quantity : summary.quantities)
        quantities.push_back({{"name", quantity.name},
                              {"value", quantity.value},
                              {"unit", quantity.unit}});
      json probes = json::object();
      for (std::size_t i = 0; i < summary.probes.size(); ++i)
        probes[probe_name(i)] = summary.probes[i];
      json slides = json::array();
      for (const SlideSummary &slide : summary.slides)
        slides.push_back(slide_to_json(slide));
      json stability = json::array();
      for (const StabilitySummary &sliding : summary.stability)
        stability.push_back(stability_to_json(sliding));

      return {{"version", version()},
              {"git_hash", git_hash()},
              {"case", summary.case_name},
              {"label", summary.label},
              {"command", summary.command},
              {"status", summary.status},
              {"reason", summary.reason},
              {"effects", summary.effects},
              {"dimension", summary.dimension},
              {"cells", summary.cells},
              {"dofs", summary.dofs},
              {"ranks", summary.ranks},
              {"steps", summary.steps},
              {"rejected_steps", summary.rejected_steps},
              {"newton_iterations", summary.newton_iterations},
              {"linear_iterations", summary.linear_iterations},
              {"sessions", summary.sessions},
              {"wall_s", summary.wall_time},
              {"cpu_s", summary.cpu_time},
              {"peak_memory_MB", summary.peak_memory},
              {"friction",
               {{"peak", summary.peak_friction},
                {"at_displacement_mm", summary.peak_displacement},
                {"final", summary.final_friction}}},
              {"energy",
               {{"work", summary.work},
                {"stored", summary.stored},
                {"dissipated", summary.dissipated},
                {"balance_error", summary.balance_error}}},
              {"slides", slides},
              {"quantities", quantities},
              {"probes", probes},
              {"stability", stability},
              {"opening",
               {{"largest_share", summary.opening.share},
                {"at_s", summary.opening.time}}},
              {"mesh_error", mesh_error_to_json(summary.mesh_error)},
              {"warnings", summary.warnings}};
    }

    Summary from_json(const json &object)
    {
      Summary summary;
      object.at("case").get_to(summary.case_name);
      object.at("label").get_to(summary.label);
      object.at("command").get_to(summary.command);
      object.at("status").get_to(summary.status);
      object.at("reason").get_to(summary.reason);
      object.at("effects").get_to(summary.effects);
      object.at("dimension").get_to(summary.dimension);
      object.at("cells").get_to(summary.cells);
      object.at("dofs").get_to(summary.dofs);
      object.at("ranks").get_to(summary.ranks);
      object.at("steps").get_to(summary.steps);
      object.at("rejected_steps").get_to(summary.rejected_steps);
      object.at("newton_iterations").get_to(summary.newton_iterations);
      object.at("linear_iterations").get_to(summary.linear_iterations);
      // Older files have none.
      summary.sessions          = object.value("sessions", 1u);
      summary.wall_time         = number(object, "wall_s");
      summary.cpu_time          = number(object, "cpu_s");
      summary.peak_memory       = number(object, "peak_memory_MB");
      const json &friction      = object.at("friction");
      summary.peak_friction     = number(friction, "peak");
      summary.peak_displacement = number(friction, "at_displacement_mm");
      summary.final_friction    = number(friction, "final");
      const json &energy        = object.at("energy");
      summary.work              = number(energy, "work");
      summary.stored            = number(energy, "stored");
      summary.dissipated        = number(energy, "dissipated");
      summary.balance_error     = number(energy, "balance_error");
      for (const json &slide : object.at("slides"))
        summary.slides.push_back(slide_from_json(slide));
      for (const json &quantity : object.at("quantities"))
        summary.quantities.push_back({quantity.at("name").get<std::string>(),
                                      number(quantity, "value"),
                                      quantity.at("unit").get<std::string>()});
      // Older files have none.
      for (const json &probe : object.value("probes", json::object()))
        summary.probes.push_back(probe.get<std::string>());
      for (const json &sliding : object.value("stability", json::array()))
        summary.stability.push_back(stability_from_json(sliding));
      summary.mesh_error =
        mesh_error_from_json(object.value("mesh_error", json()));
      if (object.contains("opening"))
        summary.opening = {number(object.at("opening"), "largest_share"),
                           number(object.at("opening"), "at_s")};
      object.at("warnings").get_to(summary.warnings);
      return summary;
    }
  } // namespace



  void write_summary(const std::filesystem::path &file, const Summary &summary)
  {
    write_file(
      file,
      to_json(summary).dump(2, ' ', false, json::error_handler_t::replace) +
        "\n");
  }



  Summary read_summary(const std::filesystem::path &file)
  {
    std::ifstream in(file);
    if (!in)
      throw InputError(file.string() + ": this file cannot be read");
    try
      {
        return from_json(json::parse(in));
      }
    catch (const json::exception &)
      {
        throw InputError(file.string() +
                         ": this file is damaged, or no summary of slipstep");
      }
  }



  namespace
  {
    /// The motion of one statement of the programme.
    struct Motion
    {
      double               start_time = 0.;
      double               end_time   = 0.;
      dealii::Tensor<1, 2> start;
      /// Unit vector from its first to its last position.
      dealii::Tensor<1, 2> direction;
      /// Mean over the path, so that rests within a followed test do not count.
      double       speed     = 0.;
      unsigned int statement = 0; ///< counted from 1
    };

    std::vector<Motion> motions(const Programme &programme)
    {
      std::vector<Motion>         result;
      const std::vector<Segment> &all = programme.segments();
      for (std::size_t first = 0, last = 0; first < all.size(); first = last)
        {
          double path = 0., speed_by_path = 0.;
          for (;
               last < all.size() && all[last].statement == all[first].statement;
               ++last)
            {
              const double speed = all[last].end.velocity.norm();
              const double distance =
                speed * (all[last].end_time - all[last].start_time);
              path += distance;
              speed_by_path += speed * distance;
            }
          const auto moved =
            all[last - 1].end.displacement - all[first].start.displacement;
          // A test that comes back to where it began has no direction.
          if (moved.norm() > 0.01 * path)
            result.push_back({all[first].start_time,
                              all[last - 1].end_time,
                              all[first].start.displacement,
                              moved / moved.norm(),
                              speed_by_path / path,
                              all[first].statement + 1});
        }
      return result;
    }

    double
    along(const dealii::Tensor<1, 2> &direction, const double x, const double y)
    {
      return direction[0] * x + direction[1] * y;
    }

    /// @return false if the history holds no row of this motion
    bool summarise(const Motion                  &motion,
                   const std::vector<HistoryRow> &history,
                   SlideSummary                  &slide)
    {
      // Steps end at the borders of statements to the last bit, and the first
      // steps after a border can be as short as a microsecond.
      const double tolerance =
        4. * std::numeric_limits<double>::epsilon() * motion.end_time;
      slide.speed = motion.speed;
      // Adding zero turns -0, for which atan2 gives -pi, into +0.
      slide.angle = std::atan2(motion.direction[1] + 0., motion.direction[0]);
      slide.peak  = -std::numeric_limits<double>::infinity();
      slide.dip   = std::numeric_limits<double>::infinity();
      slide.statement = motion.statement;

      bool found        = false;
      slide.is_complete = history.back().time >= motion.end_time - tolerance;
      for (const HistoryRow &row : history)
        if (row.time <= motion.start_time + tolerance)
          slide.before = along(motion.direction, row.friction, row.friction_y);
        else if (row.time <= motion.end_time + tolerance)
          {
            found = true;
            slide.kinetic =
              along(motion.direction, row.friction, row.friction_y);
            slide.length        = along(motion.direction,
                                 row.displacement - motion.start[0],
                                 row.displacement_y - motion.start[1]);
            slide.pressure      = row.pressure;
            slide.dynamic_ratio = row.loading_ratio.mean;
            slide.coefficient   = row.coefficient.mean;
            slide.slip_fraction = row.slip_fraction;
            slide.dip           = std::min(slide.dip, slide.kinetic);
            if (slide.kinetic > slide.peak)
              {
                slide.peak              = slide.kinetic;
                slide.peak_displacement = slide.length;
              }
          }
      return found;
    }
  } // namespace



  bool Summary::is_unstable(const SlideSummary &slide) const
  {
    const auto are_close = [](const double a, const double b) {
      return std::abs(a - b) <= 1e-6 * b;
    };
    return std::any_of(stability.begin(),
                       stability.end(),
                       [&](const StabilitySummary &s) {
                         return !s.is_stable() &&
                                are_close(slide.speed, s.speed) &&
                                are_close(slide.pressure, s.pressure);
                       });
  }



  std::string Summary::missing_energy() const
  {
    if (!(balance_error > 0.01))
      return "";
    char share[32];
    std::snprintf(share, sizeof(share), "%.2g", 100. * balance_error);
    return std::string(share) +
           " % of the work is neither stored nor dissipated (balance_error in "
           "summary.json)";
  }



  std::string Summary::missed_tolerance() const
  {
    if (mesh_error.n_missed == 0)
      return "";
    char text[200];
    std::snprintf(text,
                  sizeof(text),
                  "the estimated error of the mesh is %.2g at worst (t = %.4g "
                  "s) and %.2g at the end, the tolerance is %g; it was missed "
                  "in %llu of %llu steps looked at",
                  mesh_error.largest,
                  mesh_error.time_of_largest,
                  mesh_error.last,
                  mesh_error.tolerance,
                  mesh_error.n_missed,
                  mesh_error.n_checked);
    return text;
  }



  void summarise_history(const std::vector<HistoryRow> &history,
                         const Programme               &programme,
                         Summary                       &summary)
  {
    summary.slides.clear();
    if (history.empty())
      return;

    dealii::Tensor<1, 2> last_direction;
    last_direction[0]             = 1.;
    const std::vector<Motion> all = motions(programme);
    for (std::size_t i = 0; i < all.size(); ++i)
      {
        const Motion &motion = all[i];
        SlideSummary  slide;
        if (i > 0)
          slide.rest = motion.start_time - all[i - 1].end_time;
        if (summarise(motion, history, slide))
          {
            summary.slides.push_back(slide);
            last_direction = motion.direction;
          }
      }

    summary.peak_friction = 0.;
    for (const HistoryRow &row : history)
      {
        const double magnitude = std::hypot(row.friction, row.friction_y);
        if (magnitude > summary.peak_friction)
          {
            summary.peak_friction     = magnitude;
            summary.peak_displacement = row.displacement;
          }
      }

    const HistoryRow &last = history.back();
    summary.final_friction =
      along(last_direction, last.friction, last.friction_y);
    summary.work       = last.external_work;
    summary.stored     = last.stored_energy;
    summary.dissipated = last.dissipated_energy;

    const double scale =
      std::max(std::abs(summary.work),
               std::abs(summary.stored) + std::abs(summary.dissipated));
    const double gap      = summary.work - summary.stored - summary.dissipated;
    summary.balance_error = scale > 0. ? std::abs(gap) / scale : 0.;
  }
} // namespace SlipStep
