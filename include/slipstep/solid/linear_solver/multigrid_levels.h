// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_linear_solver_multigrid_levels_h
#define slipstep_solid_linear_solver_multigrid_levels_h

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/fe_system.h>

#include <deal.II/lac/affine_constraints.h>

#include <slipstep/solid/contact_face.h>
#include <slipstep/solid/contact_tangent.h>

#include <memory>
#include <vector>

namespace SlipStep
{
  /// Carries the tangent of the contact face from a mesh to the next coarser
  /// one, wherever their cells live.
  ///
  /// A quadrature point stands for the part of its face that its weight
  /// measures; a coarse point gets the average over its part. Averages keep a
  /// positive semidefinite tangent what it is, as an interpolation would not.
  template <int dim>
  class TangentTransfer
  {
  public:
    /// @param fine, coarse contact cell faces of the meshes; coarse cells are
    ///   those of the fine mesh or their parents
    /// @param quadrature on every cell face
    TangentTransfer(const ContactTangent<dim> &fine,
                    const ContactTangent<dim> &coarse,
                    const dealii::QGauss<1>   &quadrature,
                    const BlockParameters     &parameters,
                    const MPI_Comm            &communicator);

    void restrict_to_coarse(const ContactTangent<dim> &fine,
                            ContactTangent<dim>       &coarse) const;

  private:
    // A fine face, the coarse face that covers it, and which part of that it
    // is: per direction -1 for all of it, 0 and 1 for its halves.
    struct Link
    {
      unsigned int                       fine_face;
      unsigned int                       coarse_face;
      std::array<int, (dim > 2) ? 2 : 1> part;

      template <class Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &fine_face &coarse_face;
        for (int &p : part)
          archive &p;
      }
    };

    void add(const Link                                &link,
             const std::vector<dealii::Tensor<2, dim>> &fine,
             std::vector<dealii::Tensor<2, dim>>       &coarse) const;

    const MPI_Comm                            communicator;
    std::map<unsigned int, std::vector<Link>> links_to_rank;
    /// [part + 1](coarse point, fine point): shares of the averages.
    std::array<dealii::FullMatrix<double>, 3> shares;
    std::vector<unsigned int>                 lexicographic;
  };



  /// The meshes of a geometric multigrid: the present one and ever coarser
  /// ones, each with its unknowns, constraints and contact tangent.
  ///
  /// Every cell that can be coarsened is coarsened on the next level, so that
  /// a level covers the whole block and has its own hanging nodes ("global
  /// coarsening"). The coarsest mesh appears once more with linear elements if
  /// the elements are of higher degree: that is the level to be solved
  /// directly.
  template <int dim>
  class MultigridLevels
  {
  public:
    struct Level
    {
      std::shared_ptr<const dealii::Triangulation<dim>> triangulation;
      std::unique_ptr<dealii::FESystem<dim>>            fe;
      /// Of the level, or the one of the block on the finest.
      std::unique_ptr<dealii::DoFHandler<dim>> own_dof_handler;
      const dealii::DoFHandler<dim>           *dof_handler = nullptr;
      dealii::IndexSet                         relevant;
      dealii::AffineConstraints<double>        constraints;
      dealii::AffineConstraints<float>         float_constraints;
      ContactTangent<dim>                      tangent;
      std::unique_ptr<TangentTransfer<dim>>    to_coarser;
    };

    MultigridLevels(const BlockParameters         &parameters,
                    const dealii::DoFHandler<dim> &dof_handler);

    unsigned int n_levels() const
    {
      return levels.size();
    }

    /// 0 is the coarsest.
    const Level &operator[](const unsigned int level) const
    {
      return *levels[level];
    }

    /// Forget constraints, unknowns and mesh of a level, except what the
    /// block or the coarsest level needs.
    void release_setup_data(const unsigned int level);

    /// Take over the tangent of the contact face and average it down.
    void set_tangent(const ContactTangent<dim> &tangent);

    const dealii::Quadrature<dim - 1> &face_quadrature() const
    {
      return quadrature;
    }

  private:
    void add_level(std::shared_ptr<const dealii::Triangulation<dim>> mesh,
                   const unsigned int                                degree);

    const BlockParameters               parameters;
    const dealii::QGauss<dim - 1>       quadrature;
    std::vector<std::unique_ptr<Level>> levels;
  };
} // namespace SlipStep

#endif
