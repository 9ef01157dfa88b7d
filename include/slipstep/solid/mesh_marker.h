// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_mesh_marker_h
#define slipstep_solid_mesh_marker_h

#include <deal.II/distributed/tria.h>

#include <slipstep/experiment/summary.h>
#include <slipstep/solid/mesh_goal.h>

#include <string>
#include <vector>

namespace SlipStep
{
  /// What a mesh should change, counted over all ranks.
  struct MarkedCells
  {
    dealii::types::global_cell_index n_refined = 0;
    /// Parents that take the place of their children.
    dealii::types::global_cell_index n_merged = 0;
    /// Estimated relative error in the norm of the goal, of the mesh as it is.
    double error = 0.;
    /// Cells wanted beyond the limit; 0 if it is not reached.
    double n_too_many = 0.;

    /// By this share the error may exceed the tolerance before cells are
    /// refined that may still be: they hold 5 % of the squared one at most.
    static constexpr double slack = 0.025;
  };

  /// Decides which cells are refined or merged.
  ///
  /// If the estimated error is more than the tolerance, all cells shall have
  /// about the same error: a cell of N is refined if its squared error is more
  /// than tolerance^2 |u|^2 / N, where |u| is the norm of the goal. This is not
  /// done for a few cells that hold next to nothing of the error. A cell is
  /// merged with its siblings if the parent, with 2^(p+d/2) times their error,
  /// and with the weight that the goal gives it, stays well below the bound, so
  /// that the mesh does not flutter.
  template <int dim>
  class MeshMarker
  {
  public:
    explicit MeshMarker(const BlockParameters &parameters)
      : parameters(parameters)
      , refinement(this->parameters.refinement)
      , goal(parameters)
    {}

    /// Set the flags of a mesh, instead of those it has.
    /// @param squared_errors by active cell index, in the norm of the goal
    /// @param squared_norm of the solution
    /// @param n_unknowns on this mesh
    /// @param least_level below which nothing is merged
    /// @throws RunError if the limit is passed and the case says "stop"
    MarkedCells
    mark(dealii::parallel::distributed::Triangulation<dim> &triangulation,
         const std::vector<double>                         &squared_errors,
         const double                                       squared_norm,
         const double                                       n_unknowns,
         const unsigned int                                 least_level) const;

  private:
    double most_cells(const double n_cells, const double n_unknowns) const;

    std::string words_of_limit(const double n_wanted, const double most) const;

    const BlockParameters       parameters;
    const RefinementParameters &refinement;
    const GoalWeight<dim>       goal;
  };



  /// Whether the steps that were accepted met the tolerance of an adaptive
  /// mesh, and what kept it from being finer where they did not.
  class MeshTolerance
  {
  public:
    explicit MeshTolerance(const RefinementParameters &refinement);

    /// A step was accepted on a mesh.
    /// @param marked what that mesh should change
    void add(const double time, const MarkedCells &marked);

    const MeshErrorSummary &summary() const
    {
      return record;
    }

    /// What to change in the case, or "" if the tolerance was met.
    std::string remedy() const;

    /// For boost::serialization.
    template <class Archive>
    void serialize(Archive &archive, const unsigned int)
    {
      archive &record &by_levels &by_cells &by_repeats;
    }

  private:
    const RefinementParameters refinement;
    MeshErrorSummary           record;
    /// Steps that missed it because of ...
    unsigned long long by_levels = 0, by_cells = 0, by_repeats = 0;
  };
} // namespace SlipStep

#endif
