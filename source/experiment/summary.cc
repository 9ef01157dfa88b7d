// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/experiment/summary.h>

#include <slipstep/utilities/json_file.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/text.h>
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
      members.optional("slip_rate_over_speed", slide.relative_rate);
      members.optional("r_growth_at_end", slide.growth);
      members.optional("friction_change_at_end", slide.change);
      members.optional("swing_from", slide.swing_from);
      members.optional("swing_to", slide.swing_to);
    }

    void list_stability(JsonMembers members, StabilitySummary &stability)
    {
      members("speed_mm_per_min", stability.speed, mm_min);
      members("pressure_MPa", stability.pressure);
      members("friction", stability.friction);
      members("stiffness_MPa_per_mm", stability.stiffness);
      members("critical_stiffness_MPa_per_mm", stability.critical_stiffness);
      members("critical_frequency_Hz", stability.critical_frequency);
      members.optional("direction_deg", stability.direction);
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
      members.optional("pushed", summary.is_pushed);
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
      members.optional("programme_crc32", summary.programme);
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
    using dealii::Tensor;

    /// The motion of one statement of the programme.
    struct Motion
    {
      double       start_time = 0.;
      double       end_time   = 0.;
      Tensor<1, 2> start;
      /// Unit vectors: of a straight motion both are that from its first to
      /// its last position.
      Tensor<1, 2> first_direction, last_direction;
      bool         is_straight = false;
      /// One segment: a followed test may change its speed at any time.
      bool is_even = false;
      /// Mean over the path, so that rests within a followed test do not count.
      double       speed     = 0.;
      unsigned int statement = 0; ///< counted from 1
    };

    /// Whether all positions are in order along one direction and near its
    /// line, but for some jitter: what turns round or goes in a circle has no
    /// direction.
    bool is_straight(const std::vector<Tensor<1, 2>> &positions)
    {
      const Tensor<1, 2> moved    = positions.back() - positions.front();
      const double       length   = moved.norm();
      double             farthest = 0., back = 0., aside = 0.;
      for (const Tensor<1, 2> &position : positions)
        {
          const Tensor<1, 2> from = position - positions.front();
          const double       way  = from * moved / length;
          farthest                = std::max(farthest, way);
          back                    = std::max(back, farthest - way);
          aside = std::max(aside, (from - way / length * moved).norm());
        }
      return length > 0. && back <= 0.1 * length && aside <= 0.25 * length;
    }

    /// From the first position to one 5 % of the largest distance away: jitter
    /// at rest does not count.
    /// @return zero if nothing moves
    Tensor<1, 2> beginning(const std::vector<Tensor<1, 2>> &positions)
    {
      double largest = 0.;
      for (const Tensor<1, 2> &position : positions)
        largest = std::max(largest, (position - positions.front()).norm());
      for (const Tensor<1, 2> &position : positions)
        {
          const Tensor<1, 2> way = position - positions.front();
          if (way.norm() > 0.05 * largest)
            return way / way.norm();
        }
      return {};
    }

    void set_directions(std::vector<Tensor<1, 2>> positions, Motion &motion)
    {
      motion.is_straight = is_straight(positions);
      if (motion.is_straight)
        {
          const Tensor<1, 2> moved = positions.back() - positions.front();
          motion.first_direction = motion.last_direction = moved / moved.norm();
          return;
        }
      motion.first_direction = beginning(positions);
      std::reverse(positions.begin(), positions.end());
      motion.last_direction = -beginning(positions);
    }

    std::vector<Motion> motions(const Programme &programme)
    {
      std::vector<Motion>         result;
      const std::vector<Segment> &all = programme.segments();
      for (std::size_t first = 0, last = 0; first < all.size(); first = last)
        {
          std::vector<Tensor<1, 2>> positions{all[first].start.displacement};
          double                    path = 0., speed_by_path = 0.;
          for (;
               last < all.size() && all[last].statement == all[first].statement;
               ++last)
            {
              const double speed = all[last].end.velocity.norm();
              const double distance =
                speed * (all[last].end_time - all[last].start_time);
              path += distance;
              speed_by_path += speed * distance;
              positions.push_back(all[last].end.displacement);
            }
          if (path == 0.)
            continue;
          Motion motion;
          motion.start_time = all[first].start_time;
          motion.end_time   = all[last - 1].end_time;
          motion.start      = positions.front();
          motion.speed      = speed_by_path / path;
          motion.statement  = all[first].statement + 1;
          motion.is_even    = last == first + 1;
          set_directions(positions, motion);
          result.push_back(motion);
        }
      return result;
    }

    double along(const Tensor<1, 2> &direction, const double x, const double y)
    {
      return direction[0] * x + direction[1] * y;
    }

    /// A row of the history of a slide, or the one before it.
    struct SlideRow
    {
      double time;   ///< [s]
      double travel; ///< of the drive [mm]
      double slip;   ///< of the contact [mm]
      double friction;
      double loading_ratio;
    };

    /// Where friction turns, by more than what is noticed. The first turn may
    /// be the peak with which sliding began.
    struct Turns
    {
      unsigned int n     = 0;
      double       least = std::numeric_limits<double>::infinity();
      double       most  = -std::numeric_limits<double>::infinity();
    };

    Turns turns(const std::vector<SlideRow>::const_iterator begin,
                const std::vector<SlideRow>::const_iterator end,
                const double                                noticed)
    {
      Turns  result;
      int    sign = 0;
      double last = begin->friction; // farthest since the last turn
      for (auto row = begin; row != end; ++row)
        {
          const double change = row->friction - last;
          if (sign == 0 ? std::abs(change) > noticed : change * sign > 0.)
            {
              sign = change > 0. ? 1 : -1;
              last = row->friction;
            }
          else if (change * sign < -noticed)
            {
              if (result.n++ > 0)
                {
                  result.least = std::min(result.least, last);
                  result.most  = std::max(result.most, last);
                }
              sign = -sign;
              last = row->friction;
            }
        }
      return result;
    }



    /// Whether a slide ends as it would go on.
    void look_at_end(const std::vector<SlideRow> &rows,
                     const bool                   is_even,
                     SlideSummary                &slide)
    {
      constexpr double noticed = 0.02, last_part = 0.02, tenth = 0.1;

      const SlideRow &last   = rows.back();
      const auto      before = [&](const double share) {
        return std::lower_bound(rows.begin(),
                                rows.end() - 1,
                                (1. - share) * last.travel,
                                [](const SlideRow &row, const double travel) {
                                  return row.travel < travel;
                                });
      };
      auto from = before(last_part);
      if (from == rows.end() - 1 && from != rows.begin())
        --from;
      if (last.travel > from->travel)
        slide.relative_rate =
          (last.slip - from->slip) / (slide.speed * (last.time - from->time));
      // Two turns are a peak and what recovers after it; one is a peak, or a
      // valley of a long wave.
      const auto half    = before(0.5);
      double     largest = 0.;
      for (auto row = half; row != rows.end(); ++row)
        largest = std::max(largest, std::abs(row->friction));
      const Turns turned = turns(half, rows.end(), noticed * largest);
      if (turned.n > 2)
        {
          slide.swing_from = turned.least;
          slide.swing_to   = turned.most;
        }
      from = before(tenth);
      if (from == rows.begin())
        return;
      const SlideRow &a = *(from - 1), &b = *from;
      const double    part =
        ((1. - tenth) * last.travel - a.travel) / (b.travel - a.travel);
      if (last.loading_ratio > 0.)
        slide.growth =
          1. - (a.loading_ratio + part * (b.loading_ratio - a.loading_ratio)) /
                 last.loading_ratio;
      if (!is_even || !(largest > 0.))
        return;
      double least = a.friction + part * (b.friction - a.friction);
      double most  = least;
      for (; from != rows.end(); ++from)
        {
          least = std::min(least, from->friction);
          most  = std::max(most, from->friction);
        }
      slide.change = (most - least) / largest;
    }

    /// The largest friction, and where it was first reached but for round-off,
    /// which a plateau has everywhere.
    class Peak
    {
    public:
      explicit Peak(const double least)
        : value(least)
        , at_place(least)
      {}

      double value, place = 0.;

      void consider(const double friction, const double here)
      {
        constexpr double round_off = 1e-6;

        value = std::max(value, friction);
        if (!(friction - round_off * std::abs(friction) > at_place))
          return;
        place    = here;
        at_place = friction;
      }

    private:
      double at_place;
    };



    /// First row after a time. Of many thousands of strokes each has its part
    /// of the history only.
    std::vector<HistoryRow>::const_iterator
    first_after(const double time, const std::vector<HistoryRow> &history)
    {
      return std::upper_bound(history.begin(),
                              history.end(),
                              time,
                              [](const double time, const HistoryRow &row) {
                                return time < row.time;
                              });
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
      const Tensor<1, 2> &direction = motion.first_direction;
      slide.speed                   = motion.speed;
      // Adding zero turns -0, for which atan2 gives -pi, into +0.
      slide.angle = std::atan2(direction[1] + 0., direction[0]);
      Peak peak(-std::numeric_limits<double>::infinity());
      slide.dip       = std::numeric_limits<double>::infinity();
      slide.statement = motion.statement;

      // What pushes have moved is in the history alone.
      Tensor<1, 2> start = motion.start;
      // The row before it, and its own.
      std::vector<SlideRow> rows = {{motion.start_time, 0., 0., 0., 0.}};
      slide.is_complete = history.back().time >= motion.end_time - tolerance;
      const auto begin  = first_after(motion.start_time + tolerance, history);
      const auto end    = first_after(motion.end_time + tolerance, history);
      if (begin == end)
        return false;
      if (begin != history.begin())
        {
          const HistoryRow &row = *(begin - 1);
          slide.before = along(direction, row.friction, row.friction_y);
          start[0]     = row.displacement;
          start[1]     = row.displacement_y;
          rows[0]      = {
                 row.time, 0., row.slip, slide.before, row.loading_ratio.mean};
        }
      for (auto row = begin; row != end; ++row)
        {
          slide.kinetic  = along(direction, row->friction, row->friction_y);
          slide.length   = along(direction,
                               row->displacement - start[0],
                               row->displacement_y - start[1]);
          slide.pressure = row->pressure;
          slide.dynamic_ratio = row->loading_ratio.mean;
          slide.coefficient   = row->coefficient.mean;
          slide.slip_fraction = row->slip_fraction;
          slide.dip           = std::min(slide.dip, slide.kinetic);
          peak.consider(slide.kinetic, slide.length);
          rows.push_back({row->time,
                          slide.length,
                          row->slip,
                          slide.kinetic,
                          row->loading_ratio.mean});
        }
      slide.peak              = peak.value;
      slide.peak_displacement = peak.place;
      look_at_end(rows, motion.is_even, slide);
      return true;
    }
  } // namespace



  bool StabilitySummary::is_of(const SlideSummary &slide) const
  {
    const auto are_close = [](const double a, const double b) {
      return std::abs(a - b) <= 1e-6 * b;
    };
    return are_close(slide.speed, speed) && are_close(slide.pressure, pressure);
  }



  bool Summary::is_unstable(const SlideSummary &slide) const
  {
    return any_of(stability, [&](const StabilitySummary &s) {
      return !s.is_stable() && s.is_of(slide);
    });
  }



  std::string Summary::missing_energy() const
  {
    if (!(balance_error > 0.01))
      return "";
    return short_text(100. * balance_error, 2) +
           " % of the work is neither stored nor dissipated (balance_error in "
           "summary.json)";
  }



  std::string MeshErrorSummary::missed() const
  {
    if (n_missed == 0)
      return "";
    char text[200];
    std::snprintf(text,
                  sizeof(text),
                  "the estimated error of the mesh is %.2g at worst (t = %.4g "
                  "s) and %.2g at the end, the tolerance is %g; it was missed "
                  "in %llu of %llu steps looked at",
                  largest,
                  time_of_largest,
                  last,
                  tolerance,
                  n_missed,
                  n_checked);
    return text;
  }



  void summarise_history(const std::vector<HistoryRow> &history,
                         const Programme               &programme,
                         Summary                       &summary)
  {
    summary.slides.clear();
    if (history.empty())
      return;

    const std::vector<Motion> all = motions(programme);
    Tensor<1, 2>              first_direction, last_direction;
    first_direction[0] = last_direction[0] = 1.;
    if (!all.empty())
      first_direction = all.front().first_direction;
    double end_of_motion = 0.;
    for (std::size_t i = 0; i < all.size(); ++i)
      {
        SlideSummary slide;
        if (i > 0)
          slide.rest = all[i].start_time - all[i - 1].end_time;
        if (summarise(all[i], history, slide))
          {
            last_direction = all[i].last_direction;
            end_of_motion  = all[i].end_time;
            if (all[i].is_straight)
              summary.slides.push_back(slide);
          }
      }
    // A load pushes where it points.
    const double begin_of_motion =
      all.empty() ? history.back().time : all.front().start_time;
    summary.is_pushed =
      any_of(programme.segments(),
             [](const Segment &segment) { return segment.pushes; });
    bool is_first = true;
    for (const Segment &segment : programme.segments())
      if (segment.pushes && segment.push.norm() > 0. &&
          segment.start_time < history.back().time)
        {
          const Tensor<1, 2> direction = segment.push / segment.push.norm();
          if (segment.start_time < begin_of_motion && is_first)
            first_direction = direction;
          if (segment.end_time > end_of_motion)
            last_direction = direction;
          is_first = false;
        }

    Peak peak(0.);
    for (const HistoryRow &row : history)
      peak.consider(std::hypot(row.friction, row.friction_y),
                    along(first_direction,
                          row.displacement,
                          row.displacement_y));
    summary.peak_friction     = peak.value;
    summary.peak_displacement = peak.place;

    const HistoryRow &last = history.back();
    summary.final_friction =
      along(last_direction, last.friction, last.friction_y);
    summarise_energies(history, summary);
  }



  void summarise_energies(const std::vector<HistoryRow> &history,
                          Summary                       &summary)
  {
    const HistoryRow &last = history.back();
    summary.work           = last.external_work;
    summary.stored         = last.stored_energy;
    summary.kinetic        = last.kinetic_energy;
    summary.dissipated     = last.dissipated_energy;

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
