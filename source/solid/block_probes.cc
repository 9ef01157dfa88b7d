// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/block_probes.h>

#include <deal.II/base/mpi_remote_point_evaluation.h>

#include <deal.II/fe/mapping_q1.h>

#include <deal.II/numerics/vector_tools_evaluate.h>

#include <algorithm>

namespace SlipStep
{
  using namespace dealii;

  // The first rank asks, whichever rank has the cell answers.
  template <int dim>
  std::vector<Tensor<1, dim>>
  displacements_at(const Block<dim>              &block,
                   const std::vector<Point<dim>> &points,
                   const MPI_Comm                &communicator)
  {
    const bool asks = Utilities::MPI::this_mpi_process(communicator) == 0;
    Utilities::MPI::RemotePointEvaluation<dim> cache;
    const MappingQ1<dim>                       mapping;
    const auto                                 values =
      VectorTools::point_values<dim>(mapping,
                                     block.state().unknowns,
                                     block.state().displacements,
                                     asks ? points : std::vector<Point<dim>>(),
                                     cache);
    std::vector<Tensor<1, dim>> result(values.begin(), values.end());
    for (Tensor<1, dim> &value : result)
      value += block.state().frame_motion;
    return Utilities::MPI::broadcast(communicator, result, 0);
  }



  template <int dim>
  std::vector<double>
  BlockProbes<dim>::values(const Block<dim> &block,
                           const MPI_Comm   &communicator) const
  {
    using Kind = QuantityOfInterest::Kind;
    std::vector<Point<dim>> points;
    for (const QuantityOfInterest &probe : probes)
      if (probe.kind == Kind::displacement)
        {
          points.emplace_back();
          std::copy(probe.position.begin(),
                    probe.position.end(),
                    points.back().begin_raw());
        }
    std::vector<Tensor<1, dim>> displacements;
    if (!points.empty())
      displacements = displacements_at(block, points, communicator);

    const auto          faces = face_names(dim);
    std::vector<double> result;
    std::size_t         n_points = 0;
    for (const QuantityOfInterest &probe : probes)
      if (probe.is_on_contact_face())
        result.push_back(on_contact_face.value(probe,
                                               block.state().contact_face,
                                               communicator));
      else if (probe.kind == Kind::displacement)
        result.push_back(displacements[n_points++][probe.component]);
      else
        {
          const FaceAction action = block.action_on(
            std::find(faces.begin(), faces.end(), probe.face) - faces.begin());
          result.push_back((probe.kind == Kind::force ?
                              action.force :
                              action.moment)[probe.component]);
        }
    return result;
  }



  template std::vector<Tensor<1, 2>>
  displacements_at(const Block<2> &,
                   const std::vector<Point<2>> &,
                   const MPI_Comm &);
  template std::vector<Tensor<1, 3>>
  displacements_at(const Block<3> &,
                   const std::vector<Point<3>> &,
                   const MPI_Comm &);
  template class BlockProbes<2>;
  template class BlockProbes<3>;
} // namespace SlipStep
