// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_block_parameters_h
#define slipstep_solid_block_parameters_h

#include <deal.II/base/tensor.h>

#include <slipstep/experiment/programme.h>
#include <slipstep/solid/gap_and_strength.h>
#include <slipstep/solid/field_schedule.h>
#include <slipstep/solid/loads.h>
#include <slipstep/solid/refinement_parameters.h>
#include <slipstep/utilities/lists.h>
#include <slipstep/utilities/parameters.h>

#include <array>
#include <string>

namespace SlipStep
{
  /// What happens on one of the faces of the box. Axes are 0, 1, 2 for x, y, z;
  /// entries beyond the dimension are not used.
  struct FaceConditions
  {
    bool is_contact = false;
    /// Both displacements in the contact plane follow the programme.
    bool is_driven = false;
    /// All points of the face have the same normal displacement.
    bool is_flat = false;
    /// Components of the displacement that are prescribed in space.
    std::array<bool, 3> is_prescribed = {{false, false, false}};
    /// Traction [MPa], pressure included, and prescribed displacement [mm] of
    /// each part of the loading.
    std::array<dealii::Tensor<1, 3>, n_load_parts> tractions, displacements;

    /// All parts together.
    dealii::Tensor<1, 3> traction(const LoadFactors &factors) const
    {
      return sum(factors, tractions);
    }

    dealii::Tensor<1, 3> displacement(const LoadFactors &factors) const
    {
      return sum(factors, displacements);
    }

  private:
    static dealii::Tensor<1, 3>
    sum(const LoadFactors                                    &factors,
        const std::array<dealii::Tensor<1, 3>, n_load_parts> &parts)
    {
      dealii::Tensor<1, 3> result;
      for (unsigned int k = 0; k < n_load_parts; ++k)
        result += factors[k] * parts[k];
      return result;
    }
  };

  /// How the linear systems are solved.
  enum class SolverType
  {
    automatic, ///< direct for small blocks, else multigrid
    multigrid,
    amg,
    direct
  };

  /// "left", "right", ..., in deal.II's order.
  std::vector<std::string> face_names(const unsigned int dim);

  /// The block: a box with lower corner at the origin.
  struct BlockParameters
  {
    /// Of the elements for which there are solvers.
    static constexpr unsigned int largest_degree = 3;

    unsigned int                dimension = 3;
    std::array<double, 3>       size;          ///< [mm]
    std::array<unsigned int, 3> subdivisions;  ///< cells per direction
    RefinementParameters        refinement;    ///< of the subdivisions
    unsigned int                degree = 1;    ///< of the elements
    double                      young_modulus; ///< [MPa]
    double                      poisson_ratio;
    double                      density      = 0.; ///< [t/mm^3], 0: no inertia
    double                      damping_time = 0.; ///< of viscous stress [s]
    /// In deal.II's order: left, right, front, back, bottom, top in 3-D; left,
    /// right, bottom, top in 2-D.
    std::array<FaceConditions, 6> faces;
    unsigned int                  contact_face = 0;
    GapAndStrength                surface; ///< of that face
    SolverType                    solver = SolverType::automatic;
    double                        newton_tolerance;
    unsigned int                  newton_iterations;
    FieldSchedule                 fields; ///< when they are written

    static void declare_parameters(Parameters &parameters);

    /// @param programme to check that faces follow what it does
    /// @throws InputError
    BlockParameters(const Parameters &parameters, const Programme &programme);

    double lame_lambda() const ///< [MPa]
    {
      return young_modulus * poisson_ratio /
             ((1. + poisson_ratio) * (1. - 2. * poisson_ratio));
    }

    double shear_modulus() const ///< [MPa]
    {
      return young_modulus / (2. * (1. + poisson_ratio));
    }

    /// Whether the body has inertia.
    bool is_dynamic() const
    {
      return density > 0.;
    }

    /// When a load on the opposite face is felt on the plane at the earliest
    /// [s]; at once without inertia.
    double time_of_first_wave() const;

    /// Axis normal to the contact plane.
    unsigned int normal_axis() const
    {
      return contact_face / 2;
    }

    /// +1 if the block touches the plane with its upper end of normal_axis().
    double outward_sign() const
    {
      return contact_face % 2 == 0 ? -1. : 1.;
    }

    /// Axis of the contact plane: 0 is the direction of `slide ... at 0 deg`,
    /// 1 that of 90 deg (3-D only).
    unsigned int tangential_axis(const unsigned int i) const
    {
      return i < normal_axis() ? i : i + 1;
    }

    /// A vector of the contact plane, along the axes of the block.
    template <int dim>
    dealii::Tensor<1, dim> in_plane(const dealii::Tensor<1, 2> &vector) const
    {
      dealii::Tensor<1, dim> result;
      for (unsigned int i = 0; i < dim - 1; ++i)
        result[tangential_axis(i)] = vector[i];
      return result;
    }

    /// Whether a face holds a component of the displacements of its points.
    bool holds(const unsigned int face, const unsigned int component) const
    {
      const FaceConditions &conditions = faces[face];
      return conditions.is_prescribed[component] ||
             (conditions.is_driven && component != normal_axis()) ||
             (conditions.is_flat && component == face / 2);
    }

    /// Whether a displacement along the normal of the contact plane is
    /// prescribed somewhere.
    bool is_held_along_normal() const
    {
      return any_of(faces, [this](const FaceConditions &face) {
        return face.is_prescribed[normal_axis()];
      });
    }

    /// Whether a face is driven, or prescribed, along an axis of the contact
    /// plane.
    bool is_held_along(const unsigned int axis) const
    {
      return any_of(faces, [axis](const FaceConditions &face) {
        return face.is_driven || face.is_prescribed[axis];
      });
    }

    /// The same of any axis along which faces are loaded: there only friction
    /// holds the block.
    bool only_friction_holds_loads() const
    {
      for (unsigned int i = 0; i + 1 < dimension; ++i)
        for (const FaceConditions &face : faces)
          for (const auto &traction : face.tractions)
            if (traction[tangential_axis(i)] != 0. &&
                !is_held_along(tangential_axis(i)))
              return true;
      return false;
    }

    /// Number of cells at the beginning.
    double n_cells() const;

    /// Number of unknown displacements at the beginning; exact, but as a number
    /// that cannot overflow.
    double n_unknowns() const;

    /// The solver that 'automatic' means for so many unknowns.
    SolverType solver_for(const double n_unknowns) const
    {
      return solver != SolverType::automatic ? solver :
             n_unknowns < 3000               ? SolverType::direct :
                                               SolverType::multigrid;
    }

    /// Memory [MB] that the chosen solver needs at the very least.
    double least_memory() const
    {
      return least_memory(n_unknowns());
    }

    double least_memory(const double n_unknowns) const;

    /// Of an assembled matrix [MB].
    double memory_of_matrix(const double n_unknowns) const;

    /// Of a matrix and its factors [MB], roughly.
    double memory_of_factors(const double n_unknowns) const
    {
      return 10. * memory_of_matrix(n_unknowns);
    }

    /// The key that decides how many cells there are.
    std::string key_of_cells() const;

    /// Area of the contact face [mm^2], in 2-D per mm of thickness.
    double nominal_contact_area() const;
  };
} // namespace SlipStep

#endif
