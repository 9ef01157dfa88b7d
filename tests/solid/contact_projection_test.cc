// SPDX-License-Identifier: LGPL-2.1-or-later

// Contact states from a face to its children and back.

#include <slipstep/solid/contact_projection.h>

#include <gtest/gtest.h>

#include "block_test_tools.h"
#include "contact_transfer_tools.h"

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  // Rate-dependent and not, with and without a normal ratio; all have a range
  // of mu.
  const std::vector<std::string> effects = {
    "softening, healing, subloading, overstress",
    "softening, subloading",
    "softening",
    "softening, perzyna",
    "softening, subloading, overstress, anisotropy, heating",
    "softening, subloading, overstress, elastic_core",
    "softening, subloading, elastic_core, anisotropy"};

  using Conserved = decltype(conserved({}));

  FrictionLaw make_law(const std::string &effects)
  {
    return FrictionLaw(make_parameters({{"Friction/Effects", effects}}));
  }

  template <int dim>
  using States = std::vector<ContactState>;

  template <int dim>
  Conserved integral(const std::vector<ContactState> &states,
                     const unsigned int               degree)
  {
    const dealii::QGauss<dim - 1> quadrature(degree + 1);
    Conserved                     sums{};
    for (unsigned int q = 0; q < states.size(); ++q)
      for (unsigned int i = 0; i < Conserved().size(); ++i)
        sums[i] += quadrature.weight(q) * conserved(states[q])[i];
    return sums;
  }

  // A polynomial on the unit face at the points of a part of it.
  template <int dim>
  std::vector<ContactState> polynomial_on(const FrictionLaw            &law,
                                          const unsigned int            degree,
                                          const dealii::Point<dim - 1> &corner,
                                          const double                  size)
  {
    const dealii::QGauss<dim - 1> quadrature(degree + 1);
    std::vector<ContactState>     states;
    for (const auto &point : quadrature.get_points())
      states.push_back(
        polynomial_state(law,
                         degree,
                         corner[0] + size * point[0],
                         dim == 3 ? corner[dim - 2] + size * point[dim - 2] :
                                    0.3));
    return states;
  }

  template <int dim>
  void check_polynomials(const std::string &effects, const unsigned int degree)
  {
    const FrictionLaw            law = make_law(effects);
    const ContactProjection<dim> projection(degree, law);
    const auto parent         = polynomial_on<dim>(law, degree, {}, 1.);
    const auto children       = projection.refine(parent);
    const bool has_free_ratio = law.maximum_ratio() > 1.;
    for (unsigned int child = 0; child < children.size(); ++child)
      {
        dealii::Point<dim - 1> corner;
        for (unsigned int d = 0; d < dim - 1; ++d)
          corner[d] = 0.5 * ((child >> d) & 1);
        const auto expected = polynomial_on<dim>(law, degree, corner, 0.5);
        for (unsigned int q = 0; q < expected.size(); ++q)
          {
            ContactState state = expected[q];
            law.complete(state);
            if (has_free_ratio && effects.find("subl") != std::string::npos)
              {
                EXPECT_EQ(state.normal_ratio, expected[q].normal_ratio);
              }
            expect_equal(children[child][q], state, 1e-12);
          }
      }
    const auto again = projection.coarsen(children);
    for (unsigned int q = 0; q < again.size(); ++q)
      {
        ContactState state = parent[q];
        law.complete(state);
        expect_equal(again[q], state, 1e-12);
      }
  }

  template <int dim>
  void check_random_states(const std::string &effects,
                           const unsigned int degree)
  {
    const FrictionLaw            law = make_law(effects);
    const ContactProjection<dim> projection(degree, law);
    const unsigned int           n    = projection.n_points();
    constexpr unsigned int n_children = ContactProjection<dim>::n_children;
    std::mt19937           random(42);
    unsigned int           n_scaled = 0;
    for (unsigned int sample = 0; sample < 300; ++sample)
      {
        std::vector<ContactState> parent(n);
        for (ContactState &state : parent)
          state = random_state(law, random);
        const auto children = projection.refine(parent);
        const auto before   = integral<dim>(parent, degree);
        Conserved  after{};
        for (const auto &child : children)
          {
            for (const ContactState &state : child)
              expect_admissible(law, state);
            const auto part = integral<dim>(child, degree);
            for (unsigned int i = 0; i < Conserved().size(); ++i)
              after[i] += part[i] / n_children;
          }
        for (unsigned int i = 0; i < Conserved().size(); ++i)
          EXPECT_NEAR(after[i], before[i], 1e-12 * (1. + before[2]));

        // The way back keeps the integrals even of children that are
        // strangers to each other.
        std::array<std::vector<ContactState>, n_children> strangers;
        Conserved                                         sum{};
        for (auto &child : strangers)
          {
            child.resize(n);
            for (ContactState &state : child)
              state = random_state(law, random);
            const auto part = integral<dim>(child, degree);
            for (unsigned int i = 0; i < Conserved().size(); ++i)
              sum[i] += part[i] / n_children;
          }
        const auto merged = projection.coarsen(strangers);
        for (const ContactState &state : merged)
          expect_admissible(law, state);
        const auto of_merged = integral<dim>(merged, degree);
        for (unsigned int i = 0; i < Conserved().size(); ++i)
          EXPECT_NEAR(of_merged[i], sum[i], 1e-12 * (1. + sum[2]));

        // These are no states on which nothing has to be done.
        const auto again = projection.coarsen(children);
        for (unsigned int q = 0; q < n; ++q)
          n_scaled += std::abs(again[q].normal_traction -
                               parent[q].normal_traction) > 1e-9;
      }
    EXPECT_GT(n_scaled, 100u);
  }
} // namespace



TEST(ContactProjection, polynomials_go_there_and_back)
{
  for (const std::string &names : effects)
    for (const unsigned int degree : {1, 2, 3, 4})
      {
        check_polynomials<2>(names, degree);
        check_polynomials<3>(names, degree);
      }
}



TEST(ContactProjection, any_state_stays_admissible_and_integrals_stay)
{
  for (const std::string &names : effects)
    for (const unsigned int degree : {1, 2, 3})
      {
        check_random_states<2>(names, degree);
        check_random_states<3>(names, degree);
      }
}



// A core that leaves its limit between the points is drawn in; what else
// contacts remember stays the line that it is.
TEST(ContactProjection, other_memories_do_not_follow_a_core)
{
  const FrictionLaw          law = make_law(effects[5]);
  const ContactProjection<2> projection(1, law);
  const ContactMemory        core   = contact_memory("core_1");
  const ContactMemory        age    = contact_memory("contact_age_s");
  const auto                 points = dealii::QGauss<1>(2).get_points();
  std::vector<ContactState>  parent(2);
  for (unsigned int q = 0; q < 2; ++q)
    {
      parent[q].normal_traction = 1.;
      parent[q].coefficient     = law.coefficient_range()[1];
      parent[q].strength        = parent[q].coefficient;
      parent[q][age]            = 5. + points[q][0];
    }
  parent[1][core] = 1.; // beyond the limit
  law.complete(parent[1]);
  const double limit = parent[1][core];

  const auto children = projection.refine(parent);
  EXPECT_NEAR(children[1][1][core], limit, 1e-9 * limit);
  for (unsigned int child = 0; child < 2; ++child)
    for (unsigned int q = 0; q < 2; ++q)
      EXPECT_NEAR(children[child][q][age],
                  5. + (child + points[q][0]) / 2.,
                  1e-12);
}



// Full slip with a pressure that varies: the traction is at its limit at every
// point, and nothing may be scaled because of round-off.
TEST(ContactProjection, full_slip_is_kept)
{
  const FrictionLaw          law = make_law("");
  const ContactProjection<3> projection(1, law);
  std::vector<ContactState>  parent(4);
  for (unsigned int q = 0; q < 4; ++q)
    {
      parent[q].normal_traction = 1. + 0.3 * q;
      parent[q].coefficient     = law.coefficient_range()[0];
      parent[q].strength    = parent[q].normal_traction * parent[q].coefficient;
      parent[q].traction[0] = 0.6 * parent[q].strength;
      parent[q].traction[1] = -0.8 * parent[q].strength;
      law.complete(parent[q]);
    }
  const auto children = projection.refine(parent);
  for (const auto &child : children)
    for (const ContactState &state : child)
      {
        EXPECT_NEAR(state.loading_ratio, 1., 1e-12);
        EXPECT_NEAR(state.strength,
                    state.normal_traction * state.coefficient,
                    1e-12);
      }
  const auto again = projection.coarsen(children);
  for (unsigned int q = 0; q < 4; ++q)
    expect_equal(again[q], parent[q], 1e-12);
}
