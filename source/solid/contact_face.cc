// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/contact_face.h>

#include <deal.II/base/mpi.h>

#include <slipstep/utilities/lists.h>

#include <algorithm>

namespace SlipStep
{
  using namespace dealii;



  template <int dim>
  ContactFace<dim>::ContactFace(const BlockParameters &parameters,
                                const FrictionLaw     &law)
    : parameters(parameters)
    , law(law)
    , worn_depth(contact_memory("worn_depth_mm"))
    , face_quadrature(parameters.degree + 1)
  {}



  // @sect3{Points on the face}
  //
  // Every quadrature point of a cell's face on the plane is a contact point
  // with a memory of its own: that is why the face is kept beside the finite
  // element space and not in it. Shape functions are the same on all faces of
  // boxes, so their values at the points are looked up once.

  template <int dim>
  void ContactFace<dim>::reinit(const DoFHandler<dim> &dof_handler)
  {
    this->dof_handler = &dof_handler;
    faces.clear();
    FEFaceValues<dim> fe_values(dof_handler.get_fe(),
                                face_quadrature,
                                update_values | update_JxW_values |
                                  update_quadrature_points);
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned() &&
          cell->at_boundary(parameters.contact_face))
        {
          fe_values.reinit(cell, parameters.contact_face);
          if (faces.empty())
            find_shape_functions(fe_values);
          CellFace cell_face{cell, parameters.contact_face, {}};
          for (const unsigned int q : fe_values.quadrature_point_indices())
            {
              QuadraturePoint point;
              point.position                    = fe_values.quadrature_point(q);
              const GapAndStrength::Place place = place_of(point.position);
              point.gap                         = parameters.surface.gap(place);
              ContactState state                = law.initial_state();
              state.strength_factor = parameters.surface.strength(place);
              point.point           = ContactPoint(state);
              point.JxW             = fe_values.JxW(q);
              cell_face.points.push_back(point);
            }
          faces.push_back(std::move(cell_face));
        }
  }



  template <int dim>
  void
  ContactFace<dim>::find_shape_functions(const FEFaceValues<dim> &fe_values)
  {
    const FiniteElement<dim> &fe = fe_values.get_fe();
    shape_functions.clear();
    for (unsigned int i = 0; i < fe.dofs_per_cell; ++i)
      if (fe.has_support_on_face(i, parameters.contact_face))
        {
          ShapeFunction function{i, fe.system_to_component_index(i).first, {}};
          for (const unsigned int q : fe_values.quadrature_point_indices())
            function.values.push_back(fe_values.shape_value(i, q));
          shape_functions.push_back(function);
        }
  }



  template <int dim>
  void ContactFace<dim>::interpolate(
    const Vector                               &displacement,
    const std::vector<types::global_dof_index> &dofs,
    std::vector<Tensor<1, dim>>                &values) const
  {
    std::fill(values.begin(), values.end(), Tensor<1, dim>());
    for (const ShapeFunction &function : shape_functions)
      {
        const double nodal_value = displacement(dofs[function.dof]);
        for (unsigned int q = 0; q < values.size(); ++q)
          values[q][function.component] += nodal_value * function.values[q];
      }
  }



  // @sect3{What the plane answers}
  //
  // The block may dip into the plane against a stiff spring, and slide against
  // another one: @f$f_n = \alpha_n g@f$ of the penetration g, and the friction
  // law of the slip since the beginning of the stage, which is that of the
  // block plus that of the frame (the plane may be the part that moves). The
  // answer is a traction and its derivative with respect to the displacement of
  // the block at the point; what of it is tangential depends on the
  // penetration, too, since a contact pressed harder holds more. So the tangent
  // is unsymmetric.

  template <int dim>
  void ContactFace<dim>::update(const Vector       &displacement,
                                const Vector       &old_displacement,
                                const Tensor<1, 2> &frame_increment,
                                const double        time_step)
  {
    std::vector<types::global_dof_index> dofs(
      dof_handler->get_fe().dofs_per_cell);
    std::vector<Tensor<1, dim>> values(face_quadrature.size());
    std::vector<Tensor<1, dim>> old_values(face_quadrature.size());

    const unsigned int normal = parameters.normal_axis();
    const double       sign   = parameters.outward_sign();
    for (CellFace &cell_face : faces)
      {
        cell_face.cell->get_dof_indices(dofs);
        interpolate(displacement, dofs, values);
        interpolate(old_displacement, dofs, old_values);
        for (unsigned int q = 0; q < values.size(); ++q)
          {
            QuadraturePoint &point = cell_face.points[q];
            point.distance =
              point.gap + worn_at_start(point) - sign * values[q][normal];
            if (!is_second_stage)
              {
                // Before a wave arrives they are less, and squares underflow
                // [mm].
                constexpr double least = 1e-100;
                const double     gap   = point.gap + worn_at_start(point) -
                                   sign * old_values[q][normal];
                const bool is_off =
                  point.point.committed().normal_traction == 0. && gap > least;
                point.distance_at_start = is_off ? gap : 0.;
              }
            Tensor<1, 2> slip;
            for (unsigned int i = 0; i < dim - 1; ++i)
              slip[i] =
                (values[q] - old_values[q])[parameters.tangential_axis(i)] +
                frame_increment[i];

            respond(point, slip, time_step);
          }
      }
  }



  template <int dim>
  double ContactFace<dim>::worn_at_start(const QuadraturePoint &point) const
  {
    return law.wear_rate() > 0. ? point.point.stage_start()[worn_depth] : 0.;
  }



  template <int dim>
  double ContactFace<dim>::wear_work() const
  {
    double work = 0.;
    if (law.wear_rate() > 0.)
      for (const CellFace &cell_face : faces)
        for (const QuadraturePoint &point : cell_face.points)
          work += point.JxW * point.point.trial().normal_traction *
                  (point.point.trial()[worn_depth] - worn_at_start(point));
    return work;
  }



  // A point that was off the plane when the step began slips from when it
  // touches, @f$1/\xi@f$ of the way of the step (before, it is only carried
  // along, to where the tangent takes it to be),
  // @f$\xi = g / (g + g_0)@f$ for a penetration g and a distance g_0 at the
  // beginning. Both stages start from there, since what the first tells of one
  // that touches later than at its end says nothing of the second: it is one
  // step of backward Euler, and every point makes such a step once.
  //
  // What wears away in a stage gives way at once. With a depth
  // @f$k f_n s@f$ worn over a slip path s the plane answers
  // @f$f_n = \alpha_n (g - k f_n s)@f$, as a spring of the stiffness
  // @f$\alpha_n / (1 + \alpha_n k s)@f$ would. The path depends on f_n by no
  // more than the elastic slip, so that the third time is as good as exact; the
  // tangent takes it for given.
  template <int dim>
  void ContactFace<dim>::respond(QuadraturePoint    &point,
                                 const Tensor<1, 2> &slip,
                                 const double        time_step)
  {
    const unsigned int normal      = parameters.normal_axis();
    const double       sign        = parameters.outward_sign();
    const double       penetration = -point.distance;
    double             alpha_n     = law.normal_stiffness();
    point.slip_of_stage            = slip;
    point.time_of_stage            = time_step;
    point.force                    = Tensor<1, dim>();
    point.tangent                  = Tensor<2, dim>();

    const bool         was_off  = point.distance_at_start > 0.;
    const Tensor<1, 2> all_slip = slip + point.slip_before;
    double             share = 1., d_share = 0.;
    if (point.closes())
      {
        const double way = penetration + point.distance_at_start;
        share            = penetration / way;
        d_share          = point.distance_at_start / (way * way);
      }
    const auto answer = [&]() {
      return point.point.update(law,
                                was_off ? share * all_slip : slip,
                                alpha_n * penetration,
                                was_off ? time_step + point.time_before :
                                          time_step,
                                (1. - share) * all_slip);
    };
    ContactResponse response = answer();
    if (law.wear_rate() > 0. && penetration > 0.)
      for (unsigned int i = 0; i < 3; ++i)
        {
          const double path =
            point.point.trial().slip_path - point.point.stage_start().slip_path;
          alpha_n = law.normal_stiffness() /
                    (1. + law.normal_stiffness() * law.wear_rate() * path);
          response = answer();
        }
    point.slips    = response.slips;
    point.distance = -penetration * alpha_n / law.normal_stiffness();

    // A point just touching counts as closed, and as sticking: otherwise the
    // first load would meet no resistance.
    if (penetration < 0.)
      return;
    const Tensor<2, 2> d_slip =
      penetration > 0. ? share * response.d_slip : law.elastic_tangent();
    const Tensor<1, 2> d_penetration =
      alpha_n * response.d_normal + d_share * (response.d_slip * all_slip);
    point.force[normal]           = sign * alpha_n * penetration;
    point.tangent[normal][normal] = alpha_n;
    for (unsigned int i = 0; i < dim - 1; ++i)
      {
        const unsigned int row     = parameters.tangential_axis(i);
        point.force[row]           = response.traction[i];
        point.tangent[row][normal] = sign * d_penetration[i];
        for (unsigned int j = 0; j < dim - 1; ++j)
          point.tangent[row][parameters.tangential_axis(j)] = d_slip[i][j];
      }
  }



  template <int dim>
  void ContactFace<dim>::begin_first_stage()
  {
    is_second_stage = false;
    for (CellFace &cell_face : faces)
      for (QuadraturePoint &point : cell_face.points)
        {
          point.slip_before = Tensor<1, 2>();
          point.time_before = 0.;
        }
  }



  template <int dim>
  void ContactFace<dim>::begin_second_stage()
  {
    is_second_stage = true;
    for (CellFace &cell_face : faces)
      for (QuadraturePoint &point : cell_face.points)
        if (point.distance_at_start > 0.)
          {
            point.slip_before = TwoStages::carry * point.slip_of_stage;
            point.time_before = TwoStages::carry * point.time_of_stage;
          }
        else
          point.point.begin_second_stage(law);
  }



  template <int dim>
  GapAndStrength::Place
  ContactFace<dim>::place_of(const Point<dim> &point) const
  {
    GapAndStrength::Place place;
    for (unsigned int i = 0; i < dim - 1; ++i)
      place.push_back(point[parameters.tangential_axis(i)]);
    return place;
  }



  // @sect3{First touch}
  //
  // Of a face that is not flat no point may touch, and there is no answer that
  // Newton's method could start from. As a rigid body the block sinks in by d
  // until @f$\sum \alpha_n \langle d - g\rangle w@f$ is the load: convex, so
  // Newton's method is monotone from where all is closed.

  template <int dim>
  double ContactFace<dim>::rigid_approach(const double    normal_load,
                                          const MPI_Comm &communicator) const
  {
    double farthest = std::numeric_limits<double>::lowest(), area = 0.;
    for (const CellFace &cell_face : faces)
      for (const QuadraturePoint &point : cell_face.points)
        {
          farthest = std::max(farthest, point.distance);
          area += point.JxW;
        }
    farthest        = Utilities::MPI::max(farthest, communicator);
    area            = Utilities::MPI::sum(area, communicator);
    double approach = farthest + normal_load / (law.normal_stiffness() * area);
    for (unsigned int iteration = 0; iteration < 100; ++iteration)
      {
        std::vector<double> sums(2); // load and stiffness
        for (const CellFace &cell_face : faces)
          for (const QuadraturePoint &point : cell_face.points)
            if (approach > point.distance)
              {
                sums[0] += law.normal_stiffness() * point.JxW *
                           (approach - point.distance);
                sums[1] += law.normal_stiffness() * point.JxW;
              }
        Utilities::MPI::sum(sums, communicator, sums);
        const double too_much = sums[0] - normal_load;
        if (!(too_much > 1e-10 * normal_load))
          break;
        approach -= too_much / sums[1];
      }
    return approach;
  }



  // @sect3{How long a step may be}
  //
  // The law estimates at each point what two stages differ from one. What
  // counts is the force, so errors are averaged by strength; a single point may
  // err ten times as much.

  template <int dim>
  StepError ContactFace<dim>::step_error(const MPI_Comm &communicator) const
  {
    // What a single point may err, over what the mean may; points weaker than
    // a share of the mean do not matter.
    constexpr double times_more  = 10.;
    constexpr double least_share = 0.1;

    const auto strength_of = [](const QuadraturePoint &point) {
      return std::max(point.point.trial().strength,
                      point.point.committed().strength);
    };
    std::vector<double> sums(4);
    std::vector<double> errors_at_end;
    for (const CellFace &cell_face : faces)
      for (const QuadraturePoint &point : cell_face.points)
        {
          const double    weight = point.JxW * strength_of(point);
          const StepError error =
            point.distance_at_start > 0. ? StepError() : point.point.error(law);
          errors_at_end.push_back(error.at_end);
          sums[0] += weight * error.at_end;
          sums[1] += weight * error.of_line;
          sums[2] += weight;
          sums[3] += weight > 0. ? point.JxW : 0.;
        }
    Utilities::MPI::sum(sums, communicator, sums);
    if (!(sums[2] > 0.))
      return {};

    double worst = 0.;
    auto   error = errors_at_end.begin();
    for (const CellFace &cell_face : faces)
      for (const QuadraturePoint &point : cell_face.points)
        {
          if (strength_of(point) > least_share * sums[2] / sums[3])
            worst = std::max(worst, *error);
          ++error;
        }
    worst = Utilities::MPI::max(worst, communicator);
    return {std::max(sums[0] / sums[2], worst / times_more), sums[1] / sums[2]};
  }



  template <int dim>
  double ContactFace<dim>::cells_across(const MPI_Comm &communicator) const
  {
    constexpr double none  = std::numeric_limits<double>::infinity();
    double           least = none;
    for (unsigned int i = 0; i < dim - 1; ++i)
      {
        const unsigned int axis  = parameters.tangential_axis(i);
        double             begin = none, end = -none, size = 0.;
        for (const CellFace &cell_face : faces)
          if (any_of(cell_face.points, [](const QuadraturePoint &point) {
                return point.point.trial().normal_traction > 0.;
              }))
            {
              const double middle = cell_face.cell->center()[axis];
              const double extent = cell_face.cell->extent_in_direction(axis);
              begin               = std::min(begin, middle - extent / 2.);
              end                 = std::max(end, middle + extent / 2.);
              size                = std::max(size, extent);
            }
        const double length = Utilities::MPI::max(end, communicator) -
                              Utilities::MPI::min(begin, communicator);
        size = Utilities::MPI::max(size, communicator);
        if (size > 0. && length < (1. - 1e-9) * parameters.size[axis])
          least = std::min(least, length / size);
      }
    return least;
  }



  template <int dim>
  void ContactFace<dim>::commit()
  {
    begin_first_stage();
    for (CellFace &cell_face : faces)
      for (QuadraturePoint &point : cell_face.points)
        point.point.commit();
  }



  template <int dim>
  void ContactFace<dim>::revert()
  {
    begin_first_stage();
    for (CellFace &cell_face : faces)
      for (QuadraturePoint &point : cell_face.points)
        point.point.revert();
  }



  template <int dim>
  void ContactFace<dim>::restore(const unsigned int     face,
                                 const unsigned int     q,
                                 const QuadraturePoint &earlier)
  {
    QuadraturePoint &point   = faces[face].points[q];
    QuadraturePoint  changed = earlier;
    changed.position         = point.position;
    changed.JxW              = point.JxW;
    changed.gap              = point.gap;
    point                    = changed;
  }



  template <int dim>
  void ContactFace<dim>::set_states(const unsigned int               index,
                                    const std::vector<ContactState> &states)
  {
    AssertIndexRange(index, faces.size());
    AssertDimension(states.size(), faces[index].points.size());
    for (unsigned int q = 0; q < states.size(); ++q)
      {
        QuadraturePoint &point = faces[index].points[q];
        ContactState     state = states[q];
        state.strength_factor =
          parameters.surface.strength(place_of(point.position));
        point.point = ContactPoint(state);
      }
  }



  template <int dim>
  std::map<CellId, unsigned int> ContactFace<dim>::places_of_cells() const
  {
    std::map<CellId, unsigned int> places;
    for (unsigned int i = 0; i < faces.size(); ++i)
      places.emplace(faces[i].cell->id(), i);
    return places;
  }



  // @sect3{Forces and sums}

  template <int dim>
  void
  ContactFace<dim>::add_tested(const std::vector<types::global_dof_index> &dofs,
                               const std::vector<Tensor<1, dim>> &point_forces,
                               Vector                            &forces) const
  {
    for (const ShapeFunction &function : shape_functions)
      {
        double sum = 0.;
        for (unsigned int q = 0; q < point_forces.size(); ++q)
          sum += function.values[q] * point_forces[q][function.component];
        forces(dofs[function.dof]) += sum;
      }
  }



  template <int dim>
  void ContactFace<dim>::add_forces(Vector &forces) const
  {
    std::vector<types::global_dof_index> dofs(
      dof_handler->get_fe().dofs_per_cell);
    std::vector<Tensor<1, dim>> point_forces(face_quadrature.size());
    for (const CellFace &cell_face : faces)
      {
        cell_face.cell->get_dof_indices(dofs);
        for (unsigned int q = 0; q < point_forces.size(); ++q)
          point_forces[q] = cell_face.points[q].JxW * cell_face.points[q].force;
        add_tested(dofs, point_forces, forces);
      }
  }



  template <int dim>
  void ContactFace<dim>::add_force_changes(const Vector       &displacement,
                                           const Tensor<1, 2> &frame,
                                           Vector             &forces) const
  {
    std::vector<types::global_dof_index> dofs(
      dof_handler->get_fe().dofs_per_cell);
    std::vector<Tensor<1, dim>> values(face_quadrature.size());
    const Tensor<1, dim> rigid = parameters.template in_plane<dim>(frame);
    for (const CellFace &cell_face : faces)
      {
        cell_face.cell->get_dof_indices(dofs);
        interpolate(displacement, dofs, values);
        for (unsigned int q = 0; q < values.size(); ++q)
          values[q] = cell_face.points[q].JxW *
                      (cell_face.points[q].tangent * (values[q] + rigid));
        add_tested(dofs, values, forces);
      }
  }



  template <int dim>
  ContactTangent<dim> ContactFace<dim>::tangent() const
  {
    ContactTangent<dim> tangent;
    tangent.reserve(faces.size());
    for (const CellFace &cell_face : faces)
      {
        tangent.push_back({cell_face.cell, {}});
        tangent.back().values.reserve(cell_face.points.size());
        for (const QuadraturePoint &point : cell_face.points)
          tangent.back().values.push_back(point.tangent);
      }
    return tangent;
  }



  namespace
  {
    void sum_over_ranks(const std::vector<double *> &values,
                        const MPI_Comm              &communicator)
    {
      std::vector<double> sums;
      for (const double *value : values)
        sums.push_back(*value);
      Utilities::MPI::sum(sums, communicator, sums);
      for (unsigned int i = 0; i < sums.size(); ++i)
        *values[i] = sums[i];
    }



    // Of a closed point. Means are to be divided by the load.
    template <class QuadraturePoint>
    void add_point(const QuadraturePoint &point,
                   const FrictionLaw     &law,
                   ContactTotals         &totals)
    {
      const ContactState &state = point.point.trial();
      const double        load  = point.JxW * state.normal_traction;
      totals.normal_load += load;
      totals.tangential_load += point.JxW * state.traction;
      totals.limit_load += point.JxW * state.strength;
      totals.area += point.JxW;
      totals.slip_area += point.slips ? point.JxW : 0.;
      totals.stored +=
        point.JxW * (state.normal_traction * state.normal_traction /
                       (2. * law.normal_stiffness()) +
                     law.stored_energy(state));
      totals.slip += load * state.slip_path;
      for (unsigned int i = 0; i < totals.memories.size(); ++i)
        totals.memories[i] += load * state.memories[i];
    }
  } // namespace



  // Means are weighted by the pressure.
  template <int dim>
  ContactTotals ContactFace<dim>::totals(const MPI_Comm &communicator) const
  {
    ContactTotals         totals;
    std::array<double, 3> ratios{}; // times pressure
    // Of the ratios, and of their negatives.
    std::vector<double> maxima(6, std::numeric_limits<double>::lowest());
    for (const CellFace &cell_face : faces)
      for (const QuadraturePoint &point : cell_face.points)
        {
          const ContactState &state = point.point.trial();
          totals.dissipated += point.JxW * state.dissipation;
          if (state.normal_traction <= 0.)
            continue;
          add_point(point, law, totals);
          const double                load = point.JxW * state.normal_traction;
          const std::array<double, 3> here = {
            {state.loading_ratio, state.normal_ratio, state.coefficient}};
          for (unsigned int i = 0; i < 3; ++i)
            {
              ratios[i] += load * here[i];
              maxima[i]     = std::max(maxima[i], here[i]);
              maxima[3 + i] = std::max(maxima[3 + i], -here[i]);
            }
        }
    Utilities::MPI::max(maxima, communicator, maxima);

    std::vector<double *> weighted = {&totals.slip};
    for (double &ratio : ratios)
      weighted.push_back(&ratio);
    for (double &memory : totals.memories)
      weighted.push_back(&memory);
    std::vector<double *> summed = {&totals.normal_load,
                                    &totals.tangential_load[0],
                                    &totals.tangential_load[1],
                                    &totals.limit_load,
                                    &totals.area,
                                    &totals.slip_area,
                                    &totals.stored,
                                    &totals.dissipated};
    summed.insert(summed.end(), weighted.begin(), weighted.end());
    sum_over_ranks(summed, communicator);
    if (!(totals.normal_load > 0.))
      return totals;
    for (double *mean : weighted)
      *mean /= totals.normal_load;
    Spread *const spreads[] = {&totals.loading_ratio,
                               &totals.normal_ratio,
                               &totals.coefficient};
    for (unsigned int i = 0; i < 3; ++i)
      *spreads[i] = {ratios[i], -maxima[3 + i], maxima[i]};
    return totals;
  }



  template class ContactFace<2>;
  template class ContactFace<3>;
} // namespace SlipStep
