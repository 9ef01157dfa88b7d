// SPDX-License-Identifier: LGPL-2.1-or-later

// Contact states through changes of a distributed mesh.

#include <slipstep/solid/contact_transfer.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>

#include <deal.II/grid/grid_generator.h>

#include <gtest/gtest.h>

#include <fstream>
#include <functional>

#include "../block_test_tools.h"
#include "../contact_transfer_tools.h"

using namespace SlipStep;
using namespace SlipStep::Testing;

namespace
{
  using Conserved = decltype(conserved({}));

  std::string face_name(const unsigned int dim, const unsigned int face)
  {
    const std::vector<std::string> names =
      dim == 3 ?
        std::vector<std::string>{
          "left", "right", "front", "back", "bottom", "top"} :
        std::vector<std::string>{"left", "right", "bottom", "top"};
    return names[face];
  }

  template <int dim>
  Parameters make_case(const unsigned int contact_face,
                       const unsigned int degree)
  {
    return make_parameters(
      Settings{{"Block/Dimension", std::to_string(dim)},
               {"Block/Size", dim == 3 ? "3 mm, 2 mm, 4 mm" : "3 mm, 2 mm"},
               {"Block/Subdivisions", dim == 3 ? "3, 2, 2" : "3, 2"},
               {"Block/Degree", std::to_string(degree)},
               {"Block/Faces/bottom", "free"},
               {"Block/Faces/top", "free"}} +
      Settings{{"Block/Faces/" + face_name(dim, contact_face), "contact"},
               {"Block/Faces/" + face_name(dim, contact_face ^ 1),
                "pressure programme; drive"}});
  }

  // A mesh with a contact face, without the block around it.
  template <int dim>
  class Face
  {
  public:
    Face(const Parameters &parameters)
      : law(parameters)
      , block(parameters, parse_programme(parameters))
      , triangulation(MPI_COMM_WORLD)
      , fe(dealii::FE_Q<dim>(block.degree), dim)
      , dof_handler(triangulation)
      , contact(block, law)
      , transfer(triangulation, block, law)
    {
      dealii::Point<dim>        upper;
      std::vector<unsigned int> cells(dim);
      for (unsigned int d = 0; d < dim; ++d)
        {
          upper[d] = block.size[d];
          cells[d] = block.subdivisions[d];
        }
      dealii::GridGenerator::subdivided_hyper_rectangle(
        triangulation, cells, dealii::Point<dim>(), upper, true);
      reinit();
    }

    void reinit()
    {
      dof_handler.distribute_dofs(fe);
      contact.reinit(dof_handler);
    }

    /// A state at every point from its position in the face.
    void fill(
      const std::function<ContactState(const double, const double)> &state_at)
    {
      for (unsigned int i = 0; i < contact.cell_faces().size(); ++i)
        {
          std::vector<ContactState> states;
          for (const auto &point : contact.cell_faces()[i].points)
            states.push_back(state_at(coordinate(point.position, 0),
                                      coordinate(point.position, 1)));
          contact.set_states(i, states);
        }
    }

    void for_each(
      const std::function<
        void(const ContactState &, const double, const double)> &worker) const
    {
      for (const auto &face : contact.cell_faces())
        for (const auto &point : face.points)
          worker(point.point.committed(),
                 coordinate(point.position, 0),
                 coordinate(point.position, 1));
    }

    double coordinate(const dealii::Point<dim> &point,
                      const unsigned int        i) const
    {
      if (i > dim - 2)
        return 0.3;
      const unsigned int axis = block.tangential_axis(i);
      return point[axis] / block.size[axis];
    }

    Conserved integrals() const
    {
      Conserved sums{};
      for (const auto &face : contact.cell_faces())
        for (const auto &point : face.points)
          for (unsigned int i = 0; i < Conserved().size(); ++i)
            sums[i] += point.JxW * conserved(point.point.committed())[i];
      for (double &sum : sums)
        sum = dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD);
      return sums;
    }

    /// Refine and coarsen here and there, the same on any number of ranks.
    void change_mesh(const unsigned int seed)
    {
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            std::seed_seq words{
              seed,
              static_cast<unsigned int>(std::hash<std::string>()(
                cell->level() > 0 ? cell->parent()->id().to_string() :
                                    cell->id().to_string()))};
            std::mt19937 random(words);
            const double number = random() / 4294967296.;
            if (number < 0.35 && cell->level() < 3)
              cell->set_refine_flag();
            else if (number > 0.5)
              cell->set_coarsen_flag();
          }
      triangulation.prepare_coarsening_and_refinement();
      transfer.attach(contact);
      triangulation.execute_coarsening_and_refinement();
      reinit();
      transfer.unpack(contact);
    }

    const FrictionLaw                                 law;
    const BlockParameters                             block;
    dealii::parallel::distributed::Triangulation<dim> triangulation;
    const dealii::FESystem<dim>                       fe;
    dealii::DoFHandler<dim>                           dof_handler;
    ContactFace<dim>                                  contact;
    ContactTransfer<dim>                              transfer;
  };

  template <int dim>
  void check_polynomials(const unsigned int contact_face,
                         const unsigned int degree)
  {
    Face<dim>  face(make_case<dim>(contact_face, degree));
    const auto polynomial = [&](const double x, const double y) {
      return polynomial_state(face.law, degree, x, y);
    };
    face.fill(polynomial);
    unsigned int n_changes = 0;
    for (unsigned int cycle = 0; cycle < 5; ++cycle)
      {
        const unsigned int before = face.triangulation.n_global_active_cells();
        face.change_mesh(cycle);
        n_changes += before != face.triangulation.n_global_active_cells();
        face.for_each(
          [&](const ContactState &state, const double x, const double y) {
            expect_equal(state, polynomial(x, y), 1e-12);
          });
      }
    EXPECT_GE(n_changes, 3u);
  }

  template <int dim>
  void check_random_states(const unsigned int degree)
  {
    const unsigned int rank =
      dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    Face<dim>    face(make_case<dim>(dim == 3 ? 4 : 2, degree));
    std::mt19937 random(rank);
    face.fill([&](const double, const double) {
      return random_state(face.law, random);
    });
    const auto before = face.integrals();
    for (unsigned int cycle = 0; cycle < 6; ++cycle)
      {
        face.change_mesh(cycle);
        face.for_each([&](const ContactState &state, double, double) {
          expect_admissible(face.law, state);
        });
        const auto now = face.integrals();
        for (unsigned int i = 0; i < Conserved().size(); ++i)
          EXPECT_NEAR(now[i], before[i], 1e-12 * before[2]);
      }
  }
} // namespace



TEST(ContactTransfer, polynomials_survive_on_all_faces)
{
  for (unsigned int face = 0; face < 6; ++face)
    check_polynomials<3>(face, 1 + face % 2);
  for (unsigned int face = 0; face < 4; ++face)
    check_polynomials<2>(face, 1 + face % 3);
}



TEST(ContactTransfer, integrals_survive_with_any_states)
{
  check_random_states<2>(1);
  check_random_states<2>(2);
  check_random_states<3>(1);
  check_random_states<3>(2);
}
