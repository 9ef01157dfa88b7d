// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/contact_projection.h>

#include <slipstep/utilities/lists.h>

#include <deal.II/base/geometry_info.h>

#include <deal.II/fe/fe_dgq.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace SlipStep
{
  using namespace dealii;

  namespace
  {
    enum Field : unsigned int
    {
      traction_0,
      traction_1,
      normal_traction,
      strength,
      normal_ratio,
      coefficient,
      slip_path,
      slip_rate,
      dissipation,
      first_memory
    };

    // All fields of a state, in the order of their names.
    template <typename Fields, typename State, typename Copy>
    void copy_fields(Fields &fields, State &state, const Copy &copy)
    {
      copy(fields[traction_0], state.traction[0]);
      copy(fields[traction_1], state.traction[1]);
      copy(fields[normal_traction], state.normal_traction);
      copy(fields[strength], state.strength);
      copy(fields[normal_ratio], state.normal_ratio);
      copy(fields[coefficient], state.coefficient);
      copy(fields[slip_path], state.slip_path);
      copy(fields[slip_rate], state.slip_rate);
      copy(fields[dissipation], state.dissipation);
      for (unsigned int i = 0; i < state.memories.size(); ++i)
        copy(fields[first_memory + i], state.memories[i]);
    }



    // Round-off of the polynomials.
    const double tolerance = 1e-12;

    // Where a face is scaled, its points stay closed: an open point carries
    // nothing, which no scaling reaches.
    const double least_share = 1e-6;

    template <typename Fields>
    Fields mean_of(const std::vector<Fields> &fields,
                   const std::vector<double> &weights)
    {
      Fields mean{};
      double sum = 0.;
      for (unsigned int k = 0; k < fields.size(); ++k)
        {
          const double weight = weights[k % weights.size()];
          for (unsigned int i = 0; i < mean.size(); ++i)
            mean[i] += weight * fields[k][i];
          sum += weight;
        }
      for (double &value : mean)
        value /= sum;
      return mean;
    }



    // In [0, 1], of a condition that small ones fulfil.
    template <typename Condition>
    double largest_factor(const Condition &fits)
    {
      double lower = 0., upper = 1.;
      for (unsigned int bisection = 0; bisection < 60; ++bisection)
        {
          const double factor            = (lower + upper) / 2.;
          (fits(factor) ? lower : upper) = factor;
        }
      return lower;
    }
  } // namespace



  template <int dim>
  ContactProjection<dim>::ContactProjection(const unsigned int degree,
                                            const FrictionLaw &law)
    : law(law)
    , maximum_ratio(law.maximum_ratio())
    , coefficient_range(law.coefficient_range())
    , weights(QGauss<dim - 1>(degree + 1).get_weights())
  {
    const QGauss<dim - 1> points(degree + 1);
    // Lagrange polynomials through these points.
    const FE_DGQArbitraryNodes<dim - 1> polynomials(QGauss<1>(degree + 1));
    const unsigned int                  n = weights.size();
    for (unsigned int child = 0; child < n_children; ++child)
      {
        to_child[child].reinit(n, n);
        to_parent[child].reinit(n, n);
        for (unsigned int k = 0; k < n; ++k)
          for (unsigned int q = 0; q < n; ++q)
            to_child[child](k, q) = polynomials.shape_value(
              q,
              GeometryInfo<dim - 1>::child_to_cell_coordinates(points.point(k),
                                                               child));

        // The mass matrix of the Lagrange polynomials is diagonal.
        for (unsigned int q = 0; q < n; ++q)
          for (unsigned int k = 0; k < n; ++k)
            to_parent[child](q, k) =
              weights[k] / n_children * to_child[child](k, q) / weights[q];
      }
  }



  template <int dim>
  typename ContactProjection<dim>::Fields
  ContactProjection<dim>::fields_of(const ContactState &state)
  {
    static_assert(n_fields == first_memory + ContactState::most_memories);
    Fields fields;
    copy_fields(fields, state, [](double &field, const double value) {
      field = value;
    });
    return fields;
  }



  template <int dim>
  std::array<typename ContactProjection<dim>::States,
             ContactProjection<dim>::n_children>
  ContactProjection<dim>::refine(const States &parent) const
  {
    std::vector<Fields> fields(n_children * n_points(), Fields{});
    for (unsigned int child = 0; child < n_children; ++child)
      for (unsigned int k = 0; k < n_points(); ++k)
        for (unsigned int q = 0; q < n_points(); ++q)
          {
            const Fields source = fields_of(parent[q]);
            for (unsigned int i = 0; i < n_fields; ++i)
              fields[child * n_points() + k][i] +=
                to_child[child](k, q) * source[i];
          }

    const States                   states = admissible_states(fields);
    std::array<States, n_children> children;
    for (unsigned int child = 0; child < n_children; ++child)
      children[child].assign(states.begin() + child * n_points(),
                             states.begin() + (child + 1) * n_points());
    return children;
  }



  template <int dim>
  typename ContactProjection<dim>::States ContactProjection<dim>::coarsen(
    const std::array<States, n_children> &children) const
  {
    std::vector<Fields> fields(n_points(), Fields{});
    for (unsigned int child = 0; child < n_children; ++child)
      for (unsigned int k = 0; k < n_points(); ++k)
        {
          const Fields source = fields_of(children[child][k]);
          for (unsigned int q = 0; q < n_points(); ++q)
            for (unsigned int i = 0; i < n_fields; ++i)
              fields[q][i] += to_parent[child](q, k) * source[i];
        }
    return admissible_states(fields);
  }



  template <int dim>
  typename ContactProjection<dim>::States
  ContactProjection<dim>::admissible_states(std::vector<Fields> fields) const
  {
    const double infinity = std::numeric_limits<double>::infinity();
    limit_tractions(fields);
    limit_field(fields,
                coefficient,
                coefficient_range[0],
                coefficient_range[1]);
    for (unsigned int field = slip_path; field < first_memory; ++field)
      limit_field(fields, field, 0., infinity);
    for (const ContactMemory &memory : contact_memories())
      limit_field(fields,
                  first_memory + memory.slot,
                  memory.least,
                  memory.greatest);
    limit_cores(fields);

    States states(fields.size());
    for (unsigned int k = 0; k < fields.size(); ++k)
      {
        ContactState &state = states[k];
        copy_fields(fields[k], state, [](const double field, double &value) {
          value = field;
        });
        law.complete(state);
      }
    return states;
  }



  // With overstress r < r_m strictly, without it r = 1 is full slip.
  template <int dim>
  bool ContactProjection<dim>::is_admissible(
    const Fields &fields,
    const double  least_normal_traction) const
  {
    Tensor<1, 2> traction;
    traction[0]    = fields[traction_0];
    traction[1]    = fields[traction_1];
    traction       = law.isotropic_traction(traction);
    const double t = std::hypot(traction[0], traction[1]);
    if (fields[normal_traction] < least_normal_traction ||
        fields[strength] < 0.)
      return false;
    if (fields[normal_traction] == 0.)
      return t == 0. && fields[strength] == 0.;
    if (t == 0. || std::isinf(maximum_ratio))
      return t == 0. || fields[strength] > 0.;
    const double largest =
      maximum_ratio * (maximum_ratio > 1. ? 1. - 1e-9 : 1. + tolerance);
    return t <= largest * fields[strength];
  }



  template <int dim>
  void
  ContactProjection<dim>::limit_tractions(std::vector<Fields> &fields) const
  {
    if (all_of(fields, [&](const Fields &f) { return is_admissible(f, 0.); }))
      return;

    const Fields mean      = mean_of(fields, weights);
    const auto   scaled_by = [&](const double factor, Fields values) {
      for (const Field i : {traction_0, traction_1, normal_traction, strength})
        values[i] = mean[i] + factor * (values[i] - mean[i]);
      return values;
    };

    // Allowed states are a convex set, to which the mean belongs.
    const double factor = largest_factor([&](const double factor) {
      return all_of(fields, [&](const Fields &f) {
        return is_admissible(scaled_by(factor, f),
                             least_share * mean[normal_traction]);
      });
    });
    for (Fields &values : fields)
      values = scaled_by(factor, values);
  }



  // Of a vector in a disc its components are scaled together. Other memories
  // keep their places.
  template <int dim>
  void ContactProjection<dim>::limit_cores(std::vector<Fields> &fields) const
  {
    const Fields mean      = mean_of(fields, weights);
    const auto   memories  = law.core_memories();
    const auto   scaled_by = [&](const double factor, Fields values) {
      for (const ContactMemory &memory : memories)
        {
          const unsigned int i = first_memory + memory.slot;
          values[i]            = mean[i] + factor * (values[i] - mean[i]);
        }
      return values;
    };
    const auto fits = [&](const double factor) {
      return all_of(fields, [&](const Fields &f) {
        const Fields values = scaled_by(factor, f);
        ContactState state;
        std::copy(values.begin() + first_memory,
                  values.end(),
                  state.memories.begin());
        return law.admits_core(state);
      });
    };
    if (fits(1.))
      return;
    const double factor = largest_factor(fits);
    for (Fields &values : fields)
      values = scaled_by(factor, values);
  }



  template <int dim>
  void ContactProjection<dim>::limit_field(std::vector<Fields> &fields,
                                           const unsigned int   field,
                                           const double         lower,
                                           const double         upper) const
  {
    const double mean       = mean_of(fields, weights)[field];
    double       factor     = 1.;
    bool         is_outside = false;
    for (const Fields &values : fields)
      {
        const double value = values[field];
        is_outside         = is_outside || value < lower || value > upper;
        if (value < lower)
          factor = std::min(factor, (mean - lower) / (mean - value));
        if (value > upper)
          factor = std::min(factor, (upper - mean) / (value - mean));
      }
    if (!is_outside)
      return;
    // Round-off may leave even the mean outside.
    factor = std::max(factor, 0.);
    for (Fields &values : fields)
      values[field] =
        std::min(std::max(mean + factor * (values[field] - mean), lower),
                 upper);
  }



  template class ContactProjection<2>;
  template class ContactProjection<3>;
} // namespace SlipStep
