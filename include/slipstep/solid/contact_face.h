// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_contact_face_h
#define slipstep_solid_contact_face_h

#include <deal.II/base/quadrature_lib.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/fe_values.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <slipstep/experiment/history.h>
#include <slipstep/friction/contact_point.h>
#include <slipstep/solid/block_parameters.h>
#include <slipstep/solid/contact_tangent.h>

#include <array>
#include <map>
#include <vector>

namespace SlipStep
{
  using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

  /// Resultants and statistics of the contact face, summed over all ranks.
  struct ContactTotals
  {
    double               normal_load = 0.; ///< [N]
    dealii::Tensor<1, 2> tangential_load;  ///< [N]
    double               limit_load = 0.;  ///< integral of tau_y [N]
    double               area       = 0.;  ///< in contact [mm^2]
    double               slip_area  = 0.;  ///< [mm^2]
    double               dissipated = 0.;  ///< [N mm]
    double               stored     = 0.;  ///< in the contact stiffness [N mm]
    Spread               loading_ratio, normal_ratio, coefficient;
    double               slip = 0.; ///< mean path, weighted by normal load [mm]
    /// Means of ContactState::memories, likewise.
    std::array<double, ContactState::most_memories> memories{};
  };

  /// Of what effect wear took away, weighted by normal load [mm].
  inline double mean_worn_depth(const ContactTotals &totals)
  {
    return totals.memories[contact_memory("worn_depth_mm").slot];
  }

  /// The face of the block that touches the rigid plane: a contact point with
  /// its history at every quadrature point.
  ///
  /// The plane lies where the face is in the undeformed block, or as far from
  /// it as the GapAndStrength says. A point pushed into it by g gives the
  /// normal traction f_n = alpha_n g; its slip is its displacement along the
  /// plane plus that of the frame that moves with the drive, since it touches.
  template <int dim>
  class ContactFace
  {
  public:
    /// Contact at one quadrature point: the force on the plane, as seen from
    /// the weak form.
    struct QuadraturePoint
    {
      ContactPoint           point;
      dealii::Point<dim>     position; ///< undeformed [mm]
      double                 JxW = 0.; ///< [mm^2]
      dealii::Tensor<1, dim> force;    ///< per area [MPa]
      dealii::Tensor<2, dim> tangent;  ///< d force / d displacement [MPa/mm]
      bool                   slips = false;
      double                 gap   = 0.; ///< before loading [mm]
      double distance = 0.; ///< from the plane, negative if pushed in [mm]

      /// Of a point that was off the plane when the step began: how far [mm],
      /// else 0.
      double distance_at_start = 0.;
      /// In the step before the present stage, and in the stage [mm].
      dealii::Tensor<1, 2> slip_before, slip_of_stage;
      double               time_before = 0., time_of_stage = 0.; ///< [s]

      bool closes() const
      {
        return distance_at_start > 0. && distance < 0.;
      }

      /// What is not known from position and displacement, for
      /// boost::serialization.
      template <class Archive>
      void serialize(Archive &archive, const unsigned int)
      {
        archive &point &force &tangent &slips &distance;
      }
    };

    struct CellFace
    {
      typename dealii::DoFHandler<dim>::active_cell_iterator cell;
      unsigned int                                           face;
      std::vector<QuadraturePoint>                           points;
    };

    ContactFace(const BlockParameters &parameters, const FrictionLaw &law);

    /// Put fresh contact points on the locally owned part of the face.
    void reinit(const dealii::DoFHandler<dim> &dof_handler);

    /// Evaluate the law everywhere, from where the stage begins.
    /// @param displacement at the end of the stage, ghosted [mm]
    /// @param old_displacement at its beginning, ghosted [mm]
    /// @param frame_increment motion of the frame in the stage [mm]
    /// @param time_step of the stage [s]
    void update(const Vector               &displacement,
                const Vector               &old_displacement,
                const dealii::Tensor<1, 2> &frame_increment,
                const double                time_step);

    /// Let further updates be of the second stage of the step.
    void begin_second_stage();

    /// Estimated error of the step of two stages just made, relative to the
    /// strength, as StepError::measure(). It is that of the mean, or a part of
    /// that of the worst point among those that bear a load, so that a narrow
    /// front counts, too.
    StepError step_error(const MPI_Comm &communicator) const;

    /// How far the block has to go towards the plane, as a rigid body, to bear
    /// a normal load [N] > 0, from where it was in the last update [mm].
    double rigid_approach(const double    normal_load,
                          const MPI_Comm &communicator) const;

    /// Over how many cells the part of the face that bears a load reaches along
    /// that axis of the plane along which they are fewest, by the last update;
    /// infinite where it reaches over all of the face, or nothing bears.
    double cells_across(const MPI_Comm &communicator) const;

    void commit();

    /// Forget the step.
    void revert();

    /// Put a point back into an earlier state; position and weight stay.
    /// @param face index in cell_faces()
    /// @param q quadrature point of the face
    void restore(const unsigned int     face,
                 const unsigned int     q,
                 const QuadraturePoint &earlier);

    /// Replace the committed states of a face of a cell.
    /// @param index in cell_faces()
    /// @param states one per quadrature point
    void set_states(const unsigned int               index,
                    const std::vector<ContactState> &states);

    /// Add the contact forces, tested with all shape functions, to a vector
    /// which is then to be compressed. Constraints are not applied.
    void add_forces(Vector &forces) const;

    /// Likewise by how much they change, to first order, with a displacement.
    /// @param displacement ghosted [mm]
    /// @param frame motion of the frame [mm]
    void add_force_changes(const Vector               &displacement,
                           const dealii::Tensor<1, 2> &frame,
                           Vector                     &forces) const;

    /// Linearisation of the last update.
    ContactTangent<dim> tangent() const;

    /// What the pressure did on the depth that wore away in the present stage,
    /// of this rank's points [N mm].
    double wear_work() const;

    /// Of the last update.
    ContactTotals totals(const MPI_Comm &communicator) const;

    const std::vector<CellFace> &cell_faces() const
    {
      return faces;
    }

    /// Index in cell_faces() of every cell there.
    std::map<dealii::CellId, unsigned int> places_of_cells() const;

    const FrictionLaw &friction_law() const
    {
      return law;
    }

    const dealii::Quadrature<dim - 1> &quadrature() const
    {
      return face_quadrature;
    }

  private:
    // A shape function of a cell that does not vanish on its contact face; the
    // same on all, since all are alike.
    struct ShapeFunction
    {
      unsigned int        dof;
      unsigned int        component;
      std::vector<double> values; // at the quadrature points
    };

    double                worn_at_start(const QuadraturePoint &point) const;
    void                  respond(QuadraturePoint            &point,
                                  const dealii::Tensor<1, 2> &slip,
                                  const double                time_step);
    void                  begin_first_stage();
    GapAndStrength::Place place_of(const dealii::Point<dim> &point) const;

    /// Forces of the points of a face of a cell, tested.
    void add_tested(const std::vector<dealii::types::global_dof_index> &dofs,
                    const std::vector<dealii::Tensor<1, dim>> &point_forces,
                    Vector                                    &forces) const;
    void find_shape_functions(const dealii::FEFaceValues<dim> &fe_values);
    void interpolate(const Vector &displacement,
                     const std::vector<dealii::types::global_dof_index> &dofs,
                     std::vector<dealii::Tensor<1, dim>> &values) const;

    const BlockParameters          parameters;
    const FrictionLaw             &law;
    const ContactMemory           &worn_depth;
    const dealii::QGauss<dim - 1>  face_quadrature;
    const dealii::DoFHandler<dim> *dof_handler = nullptr;
    std::vector<ShapeFunction>     shape_functions;
    std::vector<CellFace>          faces;
    bool                           is_second_stage = false;
  };
} // namespace SlipStep

#endif
