// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/summary.h>

#include <slipstep/utilities/json_file.h>
#include <slipstep/utilities/units.h>
#include <slipstep/utilities/version.h>

#include <deal.II/base/numbers.h>

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

    void list_slide(JsonMembers members, SlideSummary &slide)
    {
      members("speed_mm_per_min", slide.speed, mm_min);
      // Those that are optional are not in older files.
      members.optional("pressure_MPa", slide.pressure);
      members("angle_deg", slide.angle, degrees);
      members("length_mm", slide.length);
      members("peak", slide.peak);
      members("peak_displacement_mm", slide.peak_displacement);
      members("kinetic", slide.kinetic);
      members("r", slide.dynamic_ratio);
      members("mu", slide.coefficient);
      members("complete", slide.is_complete);
      members.optional("statement", slide.statement);
      members.optional("rest_before_s", slide.rest);
      members.optional("friction_before", slide.before);
      members.optional("dip", slide.dip);
      members.optional("slip_fraction", slide.slip_fraction);
    }

    void list_stability(JsonMembers members, StabilitySummary &stability)
    {
      members("speed_mm_per_min", stability.speed, mm_min);
      members("pressure_MPa", stability.pressure);
      members("friction", stability.friction);
      members("stiffness_MPa_per_mm", stability.stiffness);
      members("critical_stiffness_MPa_per_mm", stability.critical_stiffness);
      members("critical_frequency_Hz", stability.critical_frequency);
      bool is_stable = stability.is_stable();
      members.optional("stable", is_stable);
    }

    void list_mesh_error(JsonMembers members, MeshErrorSummary &error)
    {
      members("tolerance", error.tolerance);
      members("last", error.last);
      members("largest", error.largest);
      members("at_s", error.time_of_largest);
      members("steps_checked", error.n_checked);
      members("steps_missed", error.n_missed);
    }

    /// Results as numbers of their own.
    void list_results(JsonMembers members, Summary &summary)
    {
      members.group("friction", [&](JsonMembers friction) {
        friction("peak", summary.peak_friction);
        friction("at_displacement_mm", summary.peak_displacement);
        friction("final", summary.final_friction);
      });
      members.group("energy", [&](JsonMembers energy) {
        energy("work", summary.work);
        energy("stored", summary.stored);
        energy.optional("kinetic", summary.kinetic);
        energy("dissipated", summary.dissipated);
        energy("balance_error", summary.balance_error);
      });
      members.array("slides", summary.slides, list_slide);
      members.array("quantities",
                    summary.quantities,
                    [](JsonMembers members, QuantityValue &quantity) {
                      members("name", quantity.name);
                      members("value", quantity.value);
                      members("unit", quantity.unit);
                    });
    }

    /// @param probes their names by those of their columns
    void list_summary(JsonMembers members, Summary &summary, json &probes)
    {
      members("case", summary.case_name);
      members("label", summary.label);
      members("command", summary.command);
      members("status", summary.status);
      members("reason", summary.reason);
      members("effects", summary.effects);
      members("dimension", summary.dimension);
      members("cells", summary.cells);
      members("dofs", summary.dofs);
      members("ranks", summary.ranks);
      members("steps", summary.steps);
      members("rejected_steps", summary.rejected_steps);
      members("newton_iterations", summary.newton_iterations);
      members("linear_iterations", summary.linear_iterations);
      members.optional("sessions", summary.sessions);
      members("wall_s", summary.wall_time);
      members("cpu_s", summary.cpu_time);
      members("peak_memory_MB", summary.peak_memory);
      list_results(members, summary);
      members.optional("probes", probes);
      members.array("stability", summary.stability, list_stability);
      members.group("opening", [&](JsonMembers opening) {
        opening("largest_share", summary.opening.share);
        opening("at_s", summary.opening.time);
      });
      // Of a mesh that is not adaptive nothing is known.
      members.group(
        "mesh_error",
        [&](JsonMembers error) { list_mesh_error(error, summary.mesh_error); },
        summary.mesh_error.tolerance != 0.);
      members("warnings", summary.warnings);
    }

    Summary from_json(json object)
    {
      Summary summary;
      json    probes = json::object();
      list_summary(JsonMembers(object, true), summary, probes);
      for (const json &probe : probes)
        summary.probes.push_back(probe.get<std::string>());
      for (std::size_t i = 0; i < summary.slides.size(); ++i)
        {
          SlideSummary &slide = summary.slides[i];
          const json   &file  = object.at("slides")[i];
          if (!file.contains("pressure_MPa"))
            slide.pressure = undefined;
          if (!file.contains("dip"))
            slide.dip = slide.peak;
        }
      // Stable on no spring: JSON has no infinity, either.
      for (StabilitySummary &stability : summary.stability)
        if (std::isnan(stability.critical_stiffness))
          stability.critical_stiffness =
            std::numeric_limits<double>::infinity();
      return summary;
    }
  } // namespace



  void write_summary(const std::filesystem::path &file, const Summary &summary)
  {
    json probes = json::object();
    for (std::size_t i = 0; i < summary.probes.size(); ++i)
      probes[probe_name(i)] = summary.probes[i];
    json    object  = {{"version", version()}, {"git_hash", git_hash()}};
    Summary written = summary;
    list_summary(JsonMembers(object, false), written, probes);
    write_json(file, object);
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
    summary.kinetic    = last.kinetic_energy;
    summary.dissipated = last.dissipated_energy;

    // Of a closed elastic cycle only round-off is left at the end.
    double scale = 0.;
    for (const HistoryRow &row : history)
      scale = std::max(
        {scale,
         std::abs(row.external_work),
         std::abs(row.stored_energy) + std::abs(row.dissipated_energy)});
    const double gap      = summary.work - summary.stored - summary.dissipated;
    summary.balance_error = scale > 0. ? std::abs(gap) / scale : 0.;
  }
} // namespace SlipStep
