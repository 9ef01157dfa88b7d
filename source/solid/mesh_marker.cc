// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/mesh_marker.h>

#include <slipstep/utilities/exceptions.h>
#include <slipstep/utilities/text.h>

#include <deal.II/base/mpi.h>

#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  using namespace dealii;

  namespace
  {
    template <int dim, typename Worker>
    void for_own_cells(
      const parallel::distributed::Triangulation<dim> &triangulation,
      const Worker                                    &worker)
    {
      for (const auto &cell : triangulation.active_cell_iterators())
        if (cell->is_locally_owned())
          worker(cell);
    }



    // Level that the finest cell at each vertex is going to have, of own cells
    // and ghosts, if nothing is merged.
    template <int dim>
    std::vector<int> finest_levels_at_vertices(
      parallel::distributed::Triangulation<dim> &triangulation)
    {
      using Cell = typename Triangulation<dim>::active_cell_iterator;
      std::vector<int> levels(triangulation.n_vertices(), 0);
      const auto       add = [&](const Cell &cell, const int level) {
        for (const unsigned int v : cell->vertex_indices())
          levels[cell->vertex_index(v)] =
            std::max(levels[cell->vertex_index(v)], level);
      };
      const auto level_of = [](const Cell &cell) {
        return cell->level() + (cell->refine_flag_set() ? 1 : 0);
      };
      for_own_cells(triangulation,
                    [&](const auto &cell) { add(cell, level_of(cell)); });
      GridTools::exchange_cell_data_to_ghosts<
        int,
        parallel::distributed::Triangulation<dim>>(triangulation,
                                                   level_of,
                                                   add);
      return levels;
    }



    // A family is merged only if all children agree and no neighbour is finer
    // than they are.
    template <int dim, typename Cell>
    bool may_merge(const Cell &parent, const std::vector<int> &finest)
    {
      for (const auto &child : parent->child_iterators())
        {
          if (!child->is_active() || !child->is_locally_owned() ||
              !child->coarsen_flag_set())
            return false;
          for (const unsigned int v : child->vertex_indices())
            if (finest[child->vertex_index(v)] > child->level())
              return false;
        }
      return true;
    }



    // Cells that touch differ by one level at most. What follows from this is
    // done here, and not left to the triangulation, because its answer would
    // depend on how the mesh is divided among the ranks.
    template <int dim>
    void settle_flags(parallel::distributed::Triangulation<dim> &triangulation,
                      MarkedCells                               &counts)
    {
      const MPI_Comm  &communicator = triangulation.get_communicator();
      std::vector<int> finest;
      for (unsigned int n_new = 1; n_new > 0;)
        {
          finest = finest_levels_at_vertices(triangulation);
          n_new  = 0;
          for_own_cells(triangulation, [&](const auto &cell) {
            int level = 0;
            for (const unsigned int v : cell->vertex_indices())
              level = std::max(level, finest[cell->vertex_index(v)]);
            if (level > cell->level() + 1 && !cell->refine_flag_set())
              {
                cell->clear_coarsen_flag();
                cell->set_refine_flag();
                ++n_new;
              }
          });
          n_new = Utilities::MPI::max(n_new, communicator);
        }

      counts.n_refined = counts.n_merged = 0;
      for_own_cells(triangulation, [&](const auto &cell) {
        // The flag is a direction of refinement, not a bool.
        counts.n_refined += cell->refine_flag_set() ? 1 : 0;
        if (cell->level() == 0 || cell->parent()->child(0) != cell)
          return;
        const auto parent = cell->parent();
        if (may_merge<dim>(parent, finest))
          ++counts.n_merged;
        else
          for (const auto &child : parent->child_iterators())
            if (child->is_active() && child->is_locally_owned())
              child->clear_coarsen_flag();
      });
      counts.n_refined = Utilities::MPI::sum(counts.n_refined, communicator);
      counts.n_merged  = Utilities::MPI::sum(counts.n_merged, communicator);
    }
  } // namespace



  // Memory is estimated as for the first mesh.
  template <int dim>
  double MeshMarker<dim>::most_cells(const double n_cells,
                                     const double n_unknowns) const
  {
    const double memory_per_cell =
      parameters.least_memory(n_unknowns) / n_cells;
    return std::min(refinement.most_cells,
                    refinement.most_memory / memory_per_cell);
  }



  template <int dim>
  std::string MeshMarker<dim>::words_of_limit(const double n_wanted,
                                              const double most) const
  {
    return "the mesh would need " + short_text(n_wanted, 6) + " cells, but " +
           (most < refinement.most_cells ?
              "'Most memory' in section Block/Adaptivity (or the machine's) "
              "allows " :
              "'Most cells' in section Block/Adaptivity allows ") +
           short_text(std::floor(most), 6) +
           ": raise it, raise 'Tolerance', or 'set Beyond the limit = warn'";
  }



  template <int dim>
  MarkedCells MeshMarker<dim>::mark(
    parallel::distributed::Triangulation<dim> &triangulation,
    const std::vector<double>                 &squared_errors,
    const double                               squared_norm,
    const double                               n_unknowns,
    const unsigned int                         least_level) const
  {
    const MPI_Comm &communicator = triangulation.get_communicator();
    const double    n_cells      = triangulation.n_global_active_cells();
    const double    limit =
      std::pow(refinement.tolerance, 2) * squared_norm / n_cells;
    const int finest = least_level + refinement.levels;

    const auto error_of = [&](const auto &cell) {
      return squared_errors[cell->active_cell_index()];
    };
    MarkedCells result;
    double      sum = 0., sum_above = 0., largest = 0.;
    for_own_cells(triangulation, [&](const auto &cell) {
      sum += error_of(cell);
      if (error_of(cell) > limit && cell->level() < finest)
        sum_above += error_of(cell);
      largest = std::max(largest, error_of(cell));
    });
    sum          = Utilities::MPI::sum(sum, communicator);
    sum_above    = Utilities::MPI::sum(sum_above, communicator);
    largest      = Utilities::MPI::max(largest, communicator);
    result.error = squared_norm > 0. ? std::sqrt(sum / squared_norm) : 0.;
    const double allowed       = limit * n_cells;
    const bool   is_worthwhile = squared_norm > 0. && sum > allowed &&
                               sum_above > 2. * MarkedCells::slack * allowed;

    // Errors of smooth solutions grow with h^(p + d/2) per cell.
    const double merging = std::pow(refinement.merging_share, 2) * limit /
                           std::pow(2., 2. * parameters.degree + dim);
    const auto set_flags = [&](const double threshold) {
      for_own_cells(triangulation, [&](const auto &cell) {
        cell->clear_refine_flag();
        cell->clear_coarsen_flag();
        if (error_of(cell) > threshold && cell->level() < finest)
          cell->set_refine_flag();
        else if (cell->level() > static_cast<int>(least_level) &&
                 error_of(cell) * goal.growth(cell) < merging)
          cell->set_coarsen_flag();
      });
      settle_flags(triangulation, result);
      return n_cells + ((1 << dim) - 1.) * result.n_refined;
    };

    const double most     = most_cells(n_cells, n_unknowns);
    const double n_wanted = set_flags(is_worthwhile ? limit : largest);
    if (result.n_refined == 0 || n_wanted <= most)
      return result;
    result.n_too_many = n_wanted - most;
    if (refinement.stop_at_cap)
      throw RunError(words_of_limit(n_wanted, most));

    // The largest errors that fit.
    double lower = limit, upper = largest;
    for (unsigned int bisection = 0; bisection < 20; ++bisection)
      {
        const double middle                         = std::sqrt(lower * upper);
        (set_flags(middle) <= most ? upper : lower) = middle;
      }
    set_flags(upper);
    return result;
  }



  MeshTolerance::MeshTolerance(const RefinementParameters &refinement)
    : refinement(refinement)
  {
    if (refinement.type == RefinementType::adaptive)
      record.tolerance = refinement.tolerance;
  }



  void MeshTolerance::add(const double time, const MarkedCells &marked)
  {
    ++record.n_checked;
    record.last = marked.error;
    if (marked.error > record.largest)
      {
        record.largest         = marked.error;
        record.time_of_largest = time;
      }
    if (marked.error <= record.tolerance * (1. + MarkedCells::slack))
      return;
    ++record.n_missed;
    ++(marked.n_too_many > 0. ? by_cells :
       marked.n_refined > 0   ? by_repeats :
                                by_levels);
  }



  std::string MeshTolerance::remedy() const
  {
    std::string text;
    const auto  add = [&text](const unsigned long long n,
                             const std::string       &limit) {
      if (n > 0)
        text += (text.empty() ? "" : ", ") + limit + " (" + std::to_string(n) +
                (n == 1 ? " step)" : " steps)");
    };
    add(by_levels,
        "'Refinement = adaptive " + std::to_string(refinement.levels) +
          "' allows no finer cells");
    add(by_cells, "'Most cells' or 'Most memory' allows no more of them");
    add(by_repeats, "'Most repeats' allowed no further repeat");
    return text;
  }



  template class MeshMarker<2>;
  template class MeshMarker<3>;
} // namespace SlipStep
