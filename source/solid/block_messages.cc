// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/block.h>

#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/text.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace SlipStep
{
  using namespace dealii;

  // @sect3{When it goes wrong}

  // A block without contact is free to move, so there is nothing left to
  // compute, unless it is held and has yet to touch.
  template <int dim>
  void Block<dim>::check_contact(const ContactTotals &totals)
  {
    if (parameters.surface.is_curved() &&
        totals.normal_load >= largest_normal_load)
      cells_across = contact.cells_across(communicator);
    largest_normal_load = std::max(largest_normal_load, totals.normal_load);
    contact_share       = totals.area / parameters.nominal_contact_area();
    // What a flat face has not reached by then is open as well.
    largest_contact_share = parameters.surface.is_curved() ?
                              std::max(largest_contact_share, contact_share) :
                              1.;
    if (largest_contact_share - contact_share > opening.share &&
        control.time() > parameters.time_of_first_wave())
      opening = {largest_contact_share - contact_share, control.time()};
    const bool has_yet_to_touch =
      parameters.surface.is_curved() && parameters.is_held_along_normal() &&
      largest_normal_load == 0. && !control.is_finished();
    // With a density a block may come off the plane and return.
    const bool is_off = totals.normal_load <= 1e-6 * largest_normal_load &&
                        !has_yet_to_touch && !parameters.is_dynamic();
    if (is_off || (control.is_finished() && largest_normal_load == 0.))
      throw RunError(
        "no contact pressure is left at t = " + short_text(control.time(), 6) +
        (largest_normal_load > 0. ? " s: the block has come off the plane" :
                                    " s: the block has not touched the plane"));

    // Off the plane nothing bears a load to weigh it by.
    if (contact.friction_law().wear_rate() > 0.)
      worn_depth = std::max(worn_depth, mean_worn_depth(totals));
    if (worn_depth >= parameters.size[parameters.normal_axis()])
      throw RunError(
        "At t = " + rounded_text(control.time(), 6) +
        " s the block is worn through: " + rounded_text(worn_depth, 3) +
        " mm are worn away, as a load-weighted mean (effect wear)");

    check_small_strains();
  }



  // Along a side of the block the motion is measured by that side: a thin strip
  // may be stretched by more than its height, but not rise as much, and the
  // load on a high block must stay above its foot. What all points do alike
  // strains and turns nothing.
  template <int dim>
  void Block<dim>::check_small_strains()
  {
    for (unsigned int d = 0; d < dim; ++d)
      {
        double least = std::numeric_limits<double>::infinity(), most = -least;
        for (const auto dof : dofs_of_component[d])
          {
            least = std::min(least, solution(dof));
            most  = std::max(most, solution(dof));
          }
        least = Utilities::MPI::min(least, communicator);
        most  = Utilities::MPI::max(most, communicator);
        if (!drive.is_unknown() && !inertia.exists() &&
            d != parameters.normal_axis() && !parameters.is_held_along(d) &&
            std::max(least, -most) > parameters.size[d])
          throw RunError("At t = " + rounded_text(control.time(), 6) +
                         " s the block slides away along " + "xyz"[d] +
                         ": friction cannot hold the loads of its faces");
        const double motion =
          std::min(most - least, std::max(std::abs(least), std::abs(most)));
        if (motion <= 0.05 * parameters.size[d])
          continue;
        newton.failure =
          "points of the block have moved by " + short_text(motion, 6) +
          " mm along " + "xyz"[d] +
          " with respect to the drive and to each other, which is too much "
          "for small strains and rotations";
        throw RunError("At t = " + std::to_string(control.time()) + " s " +
                       (tips_over() ? reason_of_failure() : newton.failure));
      }
  }



  template <int dim>
  bool Block<dim>::tips_over() const
  {
    return largest_normal_load > 0. && contact_share < 0.6 &&
           !parameters.surface.is_curved();
  }



  // The state of the contact tells more than the algebra, unless that has a
  // remedy of its own.
  template <int dim>
  std::string Block<dim>::reason_of_failure() const
  {
    const std::string failure = " (" + newton.failure + ")";
    if (tips_over())
      return "the block tips over: only " +
             std::to_string(std::lround(100. * contact_share)) +
             " % of its face is still in contact" + failure;
    if (control.time() == 0. &&
        newton.failure.find("'set Solver = automatic'") == std::string::npos)
      {
        const std::string sinks = warning_of_penetration();
        return "no equilibrium is found even at the beginning of the loads: " +
               (sinks.empty() ? "the loads lift the block or tip it over" :
                                sinks) +
               "; if the loads do hold the block on the plane, more "
               "Block/Newton iterations than " +
               std::to_string(parameters.newton_iterations) +
               " or, where round-off prevents convergence, a larger "
               "Block/Newton tolerance may help" +
               failure + remedy_of_proportional_loads();
      }
    if (drive.is_unknown() && drive.mass() == 0. && !inertia.exists())
      return drive.reason_of_failure() + failure;
    if (!inertia.exists() && parameters.only_friction_holds_loads())
      return "friction, which alone holds the loads of the faces along the "
             "plane, can hardly do so" +
             failure + remedy_of_jumps();
    return newton.failure + remedy_of_jumps();
  }



  // Slip of a length that the law states, however small the load.
  template <int dim>
  std::string Block<dim>::remedy_of_proportional_loads() const
  {
    const auto has = [&](const char *const effect) {
      return contact.friction_law().has(effect);
    };
    return parameters.only_friction_holds_loads() && has("subloading") &&
               !has("overstress") && !has("perzyna") ?
             "; with effect subloading any load along the plane needs some "
             "slip, and this load begins together with the pressure: press "
             "before it, give effect subloading an 'Elastic range', or add "
             "effect overstress" :
             "";
  }



  // Between stick and slip there is no equilibrium then, however short the
  // step.
  template <int dim>
  std::string Block<dim>::remedy_of_jumps() const
  {
    constexpr double least = 1e-6;

    if (contact.friction_law().static_coefficient() < least)
      return "; a Friction/Static coefficient below " + rounded_text(least, 1) +
             " is lost in the round-off of the pressure";
    for (const std::string effect : {"adhesion", "viscous"})
      if (contact.friction_law().has(effect) && contact_share < 1.)
        return "; where part of the contact face is open, friction that needs "
               "no pressure is lost at once: Friction/" +
               effect + "/Largest coefficient = 2 bounds it";
    const Segment &now = programme.segment_at(control.end_of_step());
    if (inertia.exists() || now.end.velocity.norm() == 0.)
      return "";
    return "; where friction falls with slip or speed a block this soft may "
           "jump: a Block/Density turns the jump into a motion, and viscous "
           "friction (effect viscous) slows it down";
  }



  namespace
  {
    // Subdivisions that cannot be halved leave a coarsest mesh for multigrid
    // which is factorised in every Newton step; others nearby can. "" if it is
    // small enough.
    std::string warning_of_subdivisions(const BlockParameters &parameters)
    {
      const auto   begin = parameters.subdivisions.begin();
      const auto   end   = begin + parameters.dimension;
      unsigned int most = 1, factor = 1; // powers of 2
      while (2 * most <= std::min(*std::min_element(begin, end), 8u))
        most *= 2;
      const auto is_divisible = [&](const unsigned int n) {
        return n % (2 * factor) == 0;
      };
      while (std::all_of(begin, end, is_divisible))
        factor *= 2;
      double      n_coarse = parameters.dimension;
      std::string present, better;
      for (auto n = begin; n != end; ++n)
        {
          const std::string comma = n == begin ? "" : ", ";
          n_coarse *= 1. + *n / factor;
          present += comma + std::to_string(*n);
          better += comma + std::to_string((*n + most / 2) / most * most);
        }
      if (n_coarse < 3000. || factor >= most)
        return "";
      return "the subdivisions " + present +
             " cannot be halved often enough for multigrid: its coarsest mesh "
             "has " +
             std::to_string(std::lround(n_coarse)) +
             " unknowns, and they are solved directly in every iteration; "
             "'set Subdivisions = " +
             better + "' in section Block is cheaper";
    }



    // Linear elements cannot bend without changing their volume.
    std::string warning_of_locking(const BlockParameters &parameters)
    {
      constexpr double largest = 0.45;
      if (parameters.degree > 1 || parameters.poisson_ratio < largest)
        return "";
      return "elements of degree 1 are too stiff with a Poisson's ratio of " +
             short_text(parameters.poisson_ratio, 4) +
             ", above all in bending: 'set Degree = 2' in section Block";
    }



    std::string warning_of_map(const double strength_error)
    {
      constexpr double noticed = 0.005;
      if (std::abs(strength_error) <= noticed)
        return "";
      return std::string(
               "the strength at the contact points (map Contact/Strength) is "
               "too ") +
             (strength_error > 0. ? "high" : "low") + ", by " +
             short_text(100. * std::abs(strength_error), 2) +
             " % on average: the points are too far apart for the map; more "
             "Block/Subdivisions, with borders of cells where the map jumps, "
             "resolve it better";
    }



    std::string warning_of_jump(const double largest_jump)
    {
      if (largest_jump <= 1e-3)
        return "";
      return "the friction force jumped by up to " +
             short_text(100. * largest_jump, 2) +
             " % when the mesh changed (see refinement.csv); a smaller "
             "'Tolerance' in section Block/Adaptivity or more subdivisions "
             "make it smoother";
    }



    // So long that friction, which is less than the load, cannot turn it.
    bool is_flat(const BlockParameters &parameters)
    {
      constexpr double long_for_height = 4.;
      const double     height = parameters.size[parameters.normal_axis()];
      for (unsigned int i = 0; i + 1 < parameters.dimension; ++i)
        if (parameters.size[parameters.tangential_axis(i)] <
            long_for_height * height)
          return false;
      return true;
    }



    // Of few cells along the motion, that is, about whose edge it turns.
    bool turns_early(const BlockParameters &parameters,
                     const Programme       &programme)
    {
      for (unsigned int i = 0; i + 1 < parameters.dimension; ++i)
        if (parameters.subdivisions[parameters.tangential_axis(i)] *
                parameters.refinement.initial_cells_per_subdivision() <
              3 &&
            any_of(programme.segments(), [&](const Segment &segment) {
              return segment.end.velocity[i] != 0. || segment.push[i] != 0.;
            }))
          return true;
      return false;
    }
  } // namespace



  // The edge of a contact with a gap moves, and so does the mesh: what is less
  // than 1 % of the face is not worth a word there.
  template <int dim>
  std::string Block<dim>::warning_of_opening() const
  {
    const bool is_curved = parameters.surface.is_curved();
    if (!opening.has_happened() || (is_curved && opening.share < 0.01))
      return "";
    std::string why = "less pressure or friction leaves a gap open again";
    if (!is_curved && inertia.exists())
      why = "waves lift a block that has a density, or friction tilts it; "
            "slower statements or a 'Damping time' reduce the waves";
    else if (!is_curved)
      why = std::string(turns_early(parameters, programme) ?
                          "a block of so few cells along its length tilts "
                          "early: use more Block/Subdivisions; otherwise " :
                          "") +
            (is_flat(parameters) ?
               "" :
               "friction tilts a block that is high for its length, or ") +
            "the supports and loads of its faces lift it" +
            (contact.friction_law().wear_rate() > 0. ?
               ", or the parts that bore the load have worn away" :
               "");
    return "part of the contact face lifted off the plane: at worst " +
           short_text(100. * opening.share, 3) + " % of it " +
           (is_curved ? "had touched and " : "") +
           "was open, at t = " + short_text(opening.time, 6) + " s (" + why +
           ")" +
           (!is_curved && !inertia.exists() && opening.share > 0.6 ?
              ": where a block stands on its edge, friction is limited by "
              "tilting, not by the strength of the contact, and is the lower "
              "the farther the outermost contact points are from the edge: "
              "more Block/Subdivisions along the motion raise it" :
              "");
  }



  // Under the largest load.
  template <int dim>
  std::string Block<dim>::warning_of_few_cells() const
  {
    constexpr double few = 6.;
    if (!(cells_across < few - 0.5))
      return "";
    return "only " + std::to_string(std::lround(cells_across)) +
           (cells_across < 1.5 ? " cell lies" : " cells lie") +
           " across the contact of the rounded face: pressure and what depends "
           "on it may be off by tens of per cent; from " +
           rounded_text(few, 1) +
           " cells on the pressure is fairly well resolved: use finer "
           "Block/Refinement or Block/Subdivisions, or section "
           "Block/Adaptivity";
  }



  template <int dim>
  std::string Block<dim>::warning_of_lean() const
  {
    constexpr double small_share = 0.01, small_moment = 0.05;

    const bool   is_flat = !parameters.surface.is_curved();
    const double moment =
      lean.moment_of_load / std::max(lean.moment_of_friction, 1e-300);
    if (!(is_flat && lean.share > small_share) && moment <= small_moment)
      return "";
    const std::string pressure = "the pressure at its edges is off by some " +
                                 rounded_text(600. * lean.share, 2) +
                                 " % of the mean";
    const std::string force = "the force that bends it by some " +
                              rounded_text(100. * moment, 2) + " %";
    return "the block leans: its top is shifted relative to its foot by " +
           rounded_text(100. * lean.share, 2) +
           " % of its length, and loads act as on the undeformed block: " +
           (moment <= small_moment ? pressure :
            is_flat                ? pressure + ", " + force :
                                     force) +
           "; it tips over later than a real one (guide/limits.md, 'Large "
           "deformation')";
  }



  // What is worn away has given way, but is still there in the mesh.
  template <int dim>
  std::string Block<dim>::warning_of_wear() const
  {
    constexpr double small = 0.1;

    const double height = parameters.size[parameters.normal_axis()];
    if (worn_depth <= small * height)
      return "";
    return rounded_text(worn_depth, 3) + " mm of the block's " +
           rounded_text(height, 3) +
           " mm are worn away, as a load-weighted mean (effect wear), but the "
           "block deforms as if all of it were still there";
  }



  template <int dim>
  std::string Block<dim>::warning_of_loads() const
  {
    if (load_cases[gradual].force.l2_norm() == 0. ||
        programme.segments().front().end.velocity.norm() == 0.)
      return "";
    return "loads of the faces grow during the first statement of the "
           "programme, while the block slides; 'hold 1 s' before it, or 'at "
           "once' behind the load, lets them act before it slides";
  }



  template <int dim>
  std::string Block<dim>::warning_of_pressure() const
  {
    const auto &segments = programme.segments();
    if (load_cases[programme_pressure].force.l2_norm() > 0. ||
        none_of(segments,
                [](const Segment &now) { return now.end.pressure > 0.; }))
      return "";
    return "the programme presses, but no face has 'pressure programme': only "
           "the other loads of section Block/Faces press the block on the "
           "plane";
  }



  template <int dim>
  std::vector<std::string> Block<dim>::warnings() const
  {
    const bool is_multigrid =
      parameters.solver_for(dof_handler.n_dofs()) == SolverType::multigrid;
    std::vector<std::string> texts = {warning_of_loads(),
                                      warning_of_pressure(),
                                      warning_of_penetration(),
                                      warning_of_map(strength_error),
                                      warning_of_opening(),
                                      warning_of_lean(),
                                      warning_of_few_cells(),
                                      warning_of_locking(parameters),
                                      warning_of_wear(),
                                      warning_of_solver(),
                                      control.warning(),
                                      control.warning_of_swing(),
                                      is_multigrid ?
                                        warning_of_subdivisions(parameters) :
                                        ""};
    if (most_cells_wanted > 0.)
      texts.push_back(
        "the mesh reached the limit set in section Block/Adaptivity: at worst " +
        std::to_string(std::llround(most_cells_wanted)) +
        " more cells were wanted than are allowed");
    if (const std::string missed = tolerance.summary().missed();
        !missed.empty())
      texts.push_back(missed + ": " + tolerance.remedy());
    texts.push_back(warning_of_jump(largest_jump));
    texts.erase(std::remove(texts.begin(), texts.end(), ""), texts.end());
    return texts;
  }



  // The contact's own spring is to be short beside the block: a bed that gives
  // lets a block tilt, and sink.
  template <int dim>
  std::string Block<dim>::warning_of_penetration() const
  {
    constexpr double small = 0.01;

    const double pressure = programme.largest_pressure();
    const double depth = pressure / contact.friction_law().normal_stiffness();
    const double size =
      *std::min_element(parameters.size.begin(), parameters.size.begin() + dim);
    if (depth <= small * size)
      return "";
    return "under " + rounded_text(pressure, 3) + " MPa the block sinks " +
           rounded_text(depth, 3) +
           " mm into the plane, whose contact has a Friction/Normal stiffness "
           "of " +
           rounded_text(contact.friction_law().normal_stiffness(), 3) +
           " MPa/mm only: it may tilt, and its friction may differ";
  }



  template <int dim>
  void Block<dim>::fill(Summary &summary) const
  {
    summary.dimension         = dim;
    summary.cells             = triangulation.n_global_active_cells();
    summary.dofs              = dof_handler.n_dofs();
    summary.ranks             = Utilities::MPI::n_mpi_processes(communicator);
    summary.steps             = control.n_accepted();
    summary.rejected_steps    = control.n_rejected();
    summary.newton_iterations = n_newton_total;
    summary.linear_iterations = n_linear_total;
    summary.mesh_error        = tolerance.summary();
    if (opening.has_happened())
      summary.opening = opening;
    summary.warnings = warnings();
  }
} // namespace SlipStep
