// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/block.h>

#include <slipstep/experiment/archive_file.h>

#include <boost/serialization/array.hpp>
#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <map>

namespace SlipStep
{
  using namespace dealii;

  // @sect3{Checkpoints}

  // A checkpoint lies between two steps: there the state is the displacements
  // of the last two steps, the velocities of a body with mass, the forces of
  // the last one, the contact points, and some numbers. Everything else follows
  // from the case and the mesh.
  //
  // To go on bit for bit, sums have to be made in the same order: so the same
  // cells have to come in the same order, on the same ranks. The triangulation
  // guarantees that, being made anew from its coarsest cells after every change
  // of the mesh.
  //
  // Files are our own instead of p4est's, which ends the program when the disk
  // is full.
  namespace
  {
    // The mesh as one rank sees it: its cells, in their order.
    template <int dim>
    std::vector<CellId> owned_cells(const Triangulation<dim> &triangulation)
    {
      std::vector<CellId> ids;
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          ids.push_back(cell->id());
      return ids;
    }



    std::vector<CellId> read_mesh(const std::filesystem::path &file)
    {
      std::vector<CellId> ids;
      read_archive(file, ids);
      return ids;
    }



    std::string numbered(const std::string &name, const unsigned int number)
    {
      return name + "." + std::to_string(number);
    }



    template <int dim>
    struct SavedPoint
    {
      typename ContactFace<dim>::QuadraturePoint point;
      // Of which the present preconditioner was made.
      Tensor<2, dim> old_tangent;

      template <class Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &point &old_tangent;
      }
    };



    // What lives on the cells of one rank.
    template <int dim>
    struct CellData
    {
      // Numbers of the unknowns of each cell, counted on the rank, and for each
      // vector the values of those unknowns.
      std::vector<unsigned int>        unknowns;
      std::vector<std::vector<double>> values;
      // Which of the cells are in contact, and all their points.
      std::vector<CellId>          contact_cells;
      std::vector<SavedPoint<dim>> points;
      // Of the preconditioner.
      BodyFactors  body;
      unsigned int n_iterations       = 0;
      bool         has_preconditioner = false;

      template <class Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &unknowns &values &contact_cells &points &body &n_iterations
          &has_preconditioner;
      }
    };
  } // namespace



  template <int dim>
  std::vector<std::string>
  Block<dim>::save(const std::filesystem::path &folder) const
  {
    const unsigned int rank = Utilities::MPI::this_mpi_process(communicator);
    write_archive(folder / numbered("mesh", rank), owned_cells(triangulation));

    CellData<dim>                        data;
    std::vector<types::global_dof_index> dofs(fe.dofs_per_cell);
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          cell->get_dof_indices(dofs);
          for (const auto dof : dofs)
            data.unknowns.push_back(
              old_solution.get_partitioner()->global_to_local(dof));
        }
    std::vector<const Vector *> vectors = {&old_solution, &older_solution};
    if (inertia.exists())
      vectors.push_back(&inertia.state());
    for (const Vector *vector : vectors)
      {
        Vector ghosted(*vector);
        ghosted.update_ghost_values();
        data.values.emplace_back(
          ghosted.begin(),
          ghosted.begin() + ghosted.get_partitioner()->locally_owned_size() +
            ghosted.get_partitioner()->n_ghost_indices());
      }

    const PreconditionerOrigin<dim> origin = system->preconditioner_origin();
    data.has_preconditioner                = origin.exists;
    data.n_iterations                      = origin.n_iterations;
    data.body                              = origin.body;
    for (unsigned int f = 0; f < contact.cell_faces().size(); ++f)
      {
        const auto &cell_face = contact.cell_faces()[f];
        data.contact_cells.push_back(cell_face.cell->id());
        for (unsigned int q = 0; q < cell_face.points.size(); ++q)
          {
            SavedPoint<dim> saved;
            saved.point = cell_face.points[q];
            if (origin.exists)
              saved.old_tangent = origin.tangent[f].values[q];
            data.points.push_back(saved);
          }
      }
    write_archive(folder / numbered("cells", rank), data);
    std::vector<std::string> files = {numbered("mesh", rank),
                                      numbered("cells", rank)};
    if (rank == 0)
      {
        write_archive(folder / "block", *this);
        files.emplace_back("block");
      }
    return files;
  }



  template <int dim>
  bool Block<dim>::load(const std::filesystem::path &folder,
                        const unsigned int           n_files)
  {
    const SolverType first_solver = solver_in_use;
    read_archive(folder / "block", *this);
    if (solver_in_use != first_solver)
      choose_solver();
    restore_mesh(folder, n_files);
    restore_cells(folder, n_files);

    const unsigned int rank = Utilities::MPI::this_mpi_process(communicator);
    const bool         is_same =
      n_files == Utilities::MPI::n_mpi_processes(communicator) &&
      read_mesh(folder / numbered("mesh", rank)) == owned_cells(triangulation);
    return Utilities::MPI::min(is_same ? 1u : 0u, communicator) == 1;
  }



  // In the order of their numbers, a cell that is not in the saved mesh comes
  // before its descendants, if it has been refined there.
  template <int dim>
  void Block<dim>::restore_mesh(const std::filesystem::path &folder,
                                const unsigned int           n_files)
  {
    std::vector<CellId> saved;
    for (unsigned int n = 0; n < n_files; ++n)
      {
        const auto ids = read_mesh(folder / numbered("mesh", n));
        saved.insert(saved.end(), ids.begin(), ids.end());
      }
    std::sort(saved.begin(), saved.end());

    bool has_changed = false;
    // No mesh has more levels than this.
    for (unsigned int pass = 0; pass < 32; ++pass)
      {
        unsigned int n_flags = 0;
        for (const auto &cell : triangulation.active_cell_iterators())
          if (cell->is_locally_owned())
            {
              const CellId id = cell->id();
              const auto   found =
                std::lower_bound(saved.begin(), saved.end(), id);
              if (found != saved.end() && *found == id)
                continue;
              ++n_flags;
              if (found != saved.end() && id.is_ancestor_of(*found))
                cell->set_refine_flag();
              else if (cell->level() > 0)
                cell->set_coarsen_flag();
            }
        if (Utilities::MPI::sum(n_flags, communicator) == 0)
          break;
        triangulation.execute_coarsening_and_refinement();
        has_changed = true;
      }
    if (triangulation.n_global_active_cells() != saved.size())
      throw InputError("the checkpoint " + folder.string() +
                       " is of another mesh: it has " +
                       std::to_string(saved.size()) +
                       " cells; run without --resume to start anew");
    if (has_changed)
      setup_system();
  }



  // A cell finds its data in the file of the rank that owned it: most likely
  // that of the same number. Files are read one after the other until all cells
  // have been found.
  template <int dim>
  void Block<dim>::restore_cells(const std::filesystem::path &folder,
                                 const unsigned int           n_files)
  {
    std::map<CellId, typename DoFHandler<dim>::active_cell_iterator> missing;
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        missing.emplace(cell->id(), cell);
    const auto contact_face_of = contact.places_of_cells();

    const unsigned int          n_q     = contact.quadrature().size();
    const std::vector<Vector *> vectors = fields_of_state();
    for (Vector *vector : vectors)
      *vector = 0.;
    PreconditionerOrigin<dim> origin;
    origin.tangent = contact.tangent();

    const unsigned int rank = Utilities::MPI::this_mpi_process(communicator);
    std::vector<types::global_dof_index> dofs(fe.dofs_per_cell);
    for (unsigned int n = 0; n == 0 || (n < n_files && !missing.empty()); ++n)
      {
        const unsigned int file = (rank + n) % n_files;
        const auto         ids  = read_mesh(folder / numbered("mesh", file));
        CellData<dim>      data;
        read_archive(folder / numbered("cells", file), data);
        origin.exists       = data.has_preconditioner;
        origin.n_iterations = data.n_iterations;
        origin.body         = data.body;
        for (unsigned int c = 0; c < ids.size(); ++c)
          {
            const auto cell = missing.find(ids[c]);
            if (cell == missing.end())
              continue;
            cell->second->get_dof_indices(dofs);
            for (unsigned int v = 0; v < vectors.size(); ++v)
              for (unsigned int i = 0; i < dofs.size(); ++i)
                if (vectors[v]->in_local_range(dofs[i]))
                  (*vectors[v])(dofs[i]) =
                    data.values[v][data.unknowns[c * dofs.size() + i]];
            missing.erase(cell);
          }
        for (unsigned int i = 0; i < data.contact_cells.size(); ++i)
          {
            const auto face = contact_face_of.find(data.contact_cells[i]);
            if (face == contact_face_of.end())
              continue;
            for (unsigned int q = 0; q < n_q; ++q)
              {
                const SavedPoint<dim> &saved = data.points[i * n_q + q];
                contact.restore(face->second, q, saved.point);
                origin.tangent[face->second].values[q] = saved.old_tangent;
              }
          }
      }
    for (Vector *vector : vectors)
      vector->update_ghost_values();
    solution = old_solution;
    if (origin.exists)
      system->make_preconditioner(origin);
  }
} // namespace SlipStep
