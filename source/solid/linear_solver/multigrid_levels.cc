// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/linear_solver/multigrid_levels.h>

#include <slipstep/solid/supports.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/mpi.templates.h>

#include <deal.II/distributed/tria.h>

#include <deal.II/fe/fe_q.h>

#include <deal.II/grid/cell_id.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <map>

namespace SlipStep
{
  using namespace dealii;

  namespace
  {
    // Shares of the intervals [0, w_1], [w_1, w_1 + w_2] ... of the fine
    // points, scaled into [begin, end], in those of the coarse points.
    FullMatrix<double>
    overlaps(const QGauss<1> &quadrature, const double begin, const double end)
    {
      const unsigned int  n = quadrature.size();
      FullMatrix<double>  shares(n, n);
      std::vector<double> borders(n + 1, 0.);
      for (unsigned int q = 0; q < n; ++q)
        borders[q + 1] = borders[q] + quadrature.weight(q);
      for (unsigned int coarse = 0; coarse < n; ++coarse)
        for (unsigned int fine = 0; fine < n; ++fine)
          {
            const double from =
              std::max(borders[coarse], begin + (end - begin) * borders[fine]);
            const double to =
              std::min(borders[coarse + 1],
                       begin + (end - begin) * borders[fine + 1]);
            shares(coarse, fine) =
              std::max(0., to - from) / quadrature.weight(coarse);
          }
      return shares;
    }



    template <int dim>
    ContactTangent<dim> contact_faces(const Triangulation<dim> &triangulation,
                                      const unsigned int        face,
                                      const unsigned int        n_points)
    {
      ContactTangent<dim> result;
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned() && cell->at_boundary(face))
          result.push_back({cell, std::vector<Tensor<2, dim>>(n_points)});
      return result;
    }



    // How many generations of cells every cell has that is refined, known on
    // all ranks.
    template <int dim>
    std::map<CellId, unsigned int>
    heights_of_cells(const Triangulation<dim> &triangulation)
    {
      std::map<CellId, unsigned int> heights;
      for (const auto &active : triangulation.active_cell_iterators())
        if (active->is_locally_owned())
          {
            typename Triangulation<dim>::cell_iterator cell   = active;
            unsigned int                               height = 0;
            while (cell->level() > 0)
              {
                cell                  = cell->parent();
                unsigned int &highest = heights[cell->id()];
                if (highest > height)
                  break; // and so are those above
                highest = ++height;
              }
          }
      using Cells          = std::vector<std::pair<CellId, unsigned int>>;
      const MPI_Comm &comm = triangulation.get_communicator();
      if (Utilities::MPI::n_mpi_processes(comm) > 1)
        for (const Cells &cells :
             Utilities::MPI::all_gather(comm,
                                        Cells(heights.begin(), heights.end())))
          for (const auto &[id, height] : cells)
            heights[id] = std::max(heights[id], height);
      return heights;
    }



    // A mesh without the last generations of the cells of another, but for
    // those that no neighbour may lack.
    template <int dim>
    std::shared_ptr<const Triangulation<dim>>
    mesh_without(const unsigned int                    n_generations,
                 const std::map<CellId, unsigned int> &heights,
                 const Triangulation<dim>             &finest)
    {
      const auto [vertices, cells, faces] =
        GridTools::get_coarse_mesh_description(finest);
      const auto mesh =
        std::make_shared<parallel::distributed::Triangulation<dim>>(
          finest.get_communicator());
      mesh->create_triangulation(vertices, cells, faces);
      for (unsigned int l = n_generations + 1; l < finest.n_global_levels();
           ++l)
        {
          for (const auto &cell : mesh->active_cell_iterators())
            if (cell->is_locally_owned())
              if (const auto found = heights.find(cell->id());
                  found != heights.end() && found->second > n_generations)
                cell->set_refine_flag();
          mesh->execute_coarsening_and_refinement();
        }
      return mesh;
    }



    // The coarsest one first. The library makes them by coarsening copies, in a
    // time that grows with the square of the number of cells, and they keep the
    // memory of the finest one.
    template <int dim>
    std::vector<std::shared_ptr<const Triangulation<dim>>>
    meshes_down_from(const Triangulation<dim> &finest)
    {
      const auto heights = heights_of_cells(finest);
      std::vector<std::shared_ptr<const Triangulation<dim>>> meshes;
      for (unsigned int n = finest.n_global_levels() - 1; n > 0; --n)
        meshes.push_back(mesh_without(n, heights, finest));
      // Without a share in its ownership.
      meshes.emplace_back(&finest, [](const Triangulation<dim> *) {});
      return meshes;
    }
  } // namespace



  // All ranks tell all where their coarse faces are: the contact face is a
  // surface, so that is little.
  template <int dim>
  TangentTransfer<dim>::TangentTransfer(const ContactTangent<dim> &fine,
                                        const ContactTangent<dim> &coarse,
                                        const QGauss<1>           &quadrature,
                                        const BlockParameters     &parameters,
                                        const MPI_Comm            &communicator)
    : communicator(communicator)
    , shares{{overlaps(quadrature, 0., 1.),
              overlaps(quadrature, 0., .5),
              overlaps(quadrature, .5, 1.)}}
    , lexicographic(
        lexicographic_face_points<dim>(quadrature.size(), parameters))
  {
    std::vector<CellId> coarse_cells;
    for (const FaceTangent<dim> &face : coarse)
      coarse_cells.push_back(face.cell->id());
    const auto of_ranks =
      Utilities::MPI::all_gather(communicator, coarse_cells);
    std::map<CellId, std::pair<unsigned int, unsigned int>> place;
    for (unsigned int rank = 0; rank < of_ranks.size(); ++rank)
      for (unsigned int i = 0; i < of_ranks[rank].size(); ++i)
        place[of_ranks[rank][i]] = {rank, i};

    for (unsigned int f = 0; f < fine.size(); ++f)
      {
        const auto &cell = fine[f].cell;
        Link        link;
        link.fine_face = f;
        link.part.fill(-1);
        auto found = place.find(cell->id());
        if (found == place.end())
          {
            const auto parent = cell->parent();
            found             = place.find(parent->id());
            AssertThrow(found != place.end(), ExcInternalError());
            for (unsigned int i = 0; i < dim - 1; ++i)
              {
                const unsigned int axis = parameters.tangential_axis(i);
                link.part[i] = cell->center()[axis] > parent->center()[axis];
              }
          }
        link.coarse_face = found->second.second;
        links_to_rank[found->second.first].push_back(link);
      }
  }



  template <int dim>
  void TangentTransfer<dim>::add(const Link                        &link,
                                 const std::vector<Tensor<2, dim>> &fine,
                                 std::vector<Tensor<2, dim>> &coarse) const
  {
    const unsigned int n_1d = shares[0].m();
    for (unsigned int c = 0; c < coarse.size(); ++c)
      for (unsigned int f = 0; f < fine.size(); ++f)
        {
          double       share = 1.;
          unsigned int p = lexicographic[c], q = lexicographic[f];
          for (unsigned int i = 0; i < dim - 1 && share > 0.;
               ++i, p /= n_1d, q /= n_1d)
            share *= shares[link.part[i] + 1](p % n_1d, q % n_1d);
          if (share > 0.)
            coarse[c] += share * fine[f];
        }
  }



  template <int dim>
  void
  TangentTransfer<dim>::restrict_to_coarse(const ContactTangent<dim> &fine,
                                           ContactTangent<dim> &coarse) const
  {
    for (FaceTangent<dim> &face : coarse)
      std::fill(face.values.begin(), face.values.end(), Tensor<2, dim>());

    using Parcel = std::vector<std::pair<Link, std::vector<Tensor<2, dim>>>>;
    const unsigned int here = Utilities::MPI::this_mpi_process(communicator);
    std::map<unsigned int, Parcel> parcels;
    for (const auto &entry : links_to_rank)
      for (const Link &link : entry.second)
        if (entry.first == here)
          add(link,
              fine[link.fine_face].values,
              coarse[link.coarse_face].values);
        else
          parcels[entry.first].emplace_back(link, fine[link.fine_face].values);
    if (Utilities::MPI::n_mpi_processes(communicator) == 1)
      return;
    for (const auto &parcel :
         Utilities::MPI::some_to_some(communicator, parcels))
      for (const auto &entry : parcel.second)
        add(entry.first, entry.second, coarse[entry.first.coarse_face].values);
  }



  template <int dim>
  MultigridLevels<dim>::MultigridLevels(const BlockParameters &parameters,
                                        const DoFHandler<dim> &dof_handler)
    : parameters(parameters)
    , quadrature(parameters.degree + 1)
  {
    const auto meshes = meshes_down_from(dof_handler.get_triangulation());
    if (parameters.degree > 1)
      add_level(meshes.front(), 1);
    for (unsigned int l = 0; l + 1 < meshes.size(); ++l)
      add_level(meshes[l], parameters.degree);

    levels.push_back(std::make_unique<Level>());
    levels.back()->triangulation = meshes.back();
    levels.back()->dof_handler   = &dof_handler;

    for (unsigned int l = 0; l < levels.size(); ++l)
      {
        Level &level   = *levels[l];
        level.relevant = relevant_dofs(parameters, *level.dof_handler);
        constrain_displacements(parameters,
                                *level.dof_handler,
                                level.relevant,
                                LoadFactors(),
                                level.constraints);
        make_homogeneous(level.constraints);
        level.float_constraints.copy_from(level.constraints);
        level.tangent = contact_faces(*level.triangulation,
                                      parameters.contact_face,
                                      quadrature.size());
        if (l > 0)
          level.to_coarser = std::make_unique<TangentTransfer<dim>>(
            level.tangent,
            levels[l - 1]->tangent,
            QGauss<1>(parameters.degree + 1),
            parameters,
            dof_handler.get_communicator());
      }
  }



  template <int dim>
  void MultigridLevels<dim>::add_level(
    std::shared_ptr<const Triangulation<dim>> mesh,
    const unsigned int                        degree)
  {
    levels.push_back(std::make_unique<Level>());
    Level &level        = *levels.back();
    level.triangulation = mesh;
    level.fe = std::make_unique<FESystem<dim>>(FE_Q<dim>(degree), dim);
    level.own_dof_handler = std::make_unique<DoFHandler<dim>>(*mesh);
    level.own_dof_handler->distribute_dofs(*level.fe);
    level.dof_handler = level.own_dof_handler.get();
  }



  template <int dim>
  void MultigridLevels<dim>::release_setup_data(const unsigned int l)
  {
    levels[l]->float_constraints.clear();
    if (l == 0)
      return;
    levels[l]->constraints.clear();
    if (!levels[l]->own_dof_handler)
      return;
    for (FaceTangent<dim> &face : levels[l]->tangent)
      face.cell = typename Triangulation<dim>::active_cell_iterator();
    levels[l]->own_dof_handler->clear();
    levels[l]->dof_handler = nullptr;
    levels[l]->triangulation.reset();
  }



  template <int dim>
  void MultigridLevels<dim>::set_tangent(const ContactTangent<dim> &tangent)
  {
    levels.back()->tangent = tangent;
    for (unsigned int l = levels.size() - 1; l > 0; --l)
      levels[l]->to_coarser->restrict_to_coarse(levels[l]->tangent,
                                                levels[l - 1]->tangent);
  }



  template class TangentTransfer<2>;
  template class TangentTransfer<3>;
  template class MultigridLevels<2>;
  template class MultigridLevels<3>;
} // namespace SlipStep
