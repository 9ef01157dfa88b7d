// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef slipstep_solid_linear_solver_elastic_operator_h
#define slipstep_solid_linear_solver_elastic_operator_h

// Types in this file depend on the width of VectorizedArray, which may differ
// from that of the library: include it only where multigrid_system.h is.

#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/fe/fe_tools.h>
#include <deal.II/fe/mapping_q1.h>

#include <deal.II/lac/diagonal_matrix.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <deal.II/matrix_free/fe_evaluation.h>
#include <deal.II/matrix_free/matrix_free.h>
#include <deal.II/matrix_free/tools.h>

#include <slipstep/solid/block_parameters.h>
#include <slipstep/solid/contact_tangent.h>
#include <slipstep/solid/linear_solver/lumped_mass.h>

#include <memory>

namespace SlipStep
{
  /// Stiffness and mass of the block plus tangent of the contact face,
  /// matrix-free.
  ///
  /// The contact part is computed together with the cell that owns the face,
  /// from the same nodal values: constraints, hanging nodes and communication
  /// come for free. Cells at the contact face share their SIMD batches. The
  /// mesh is needed by the constructor only.
  /// @tparam Simd names the width
  template <int dim,
            int degree,
            typename Number,
            typename Simd = dealii::VectorizedArray<Number>>
  class ElasticOperator : public dealii::Subscriptor
  {
  public:
    using VectorType = dealii::LinearAlgebra::distributed::Vector<Number>;
    using value_type = Number;

    /// @param constraints homogeneous
    /// @param with_plain_product whether plain_vmult() is needed
    ElasticOperator(const BlockParameters                   &parameters,
                    const dealii::DoFHandler<dim>           &dof_handler,
                    const dealii::AffineConstraints<Number> &constraints,
                    const bool with_plain_product);

    void initialize_dof_vector(VectorType        &vector,
                               const unsigned int index = 0) const
    {
      matrix_free.initialize_dof_vector(vector, index);
    }

    dealii::types::global_dof_index m() const
    {
      return n_unknowns;
    }

    /// Replace the contact part.
    /// @param for_smoother products and the diagonal have the definite_part()
    ///   only; residuals have all of it
    void set_contact(const ContactTangent<dim> &tangent,
                     const bool                 for_smoother);

    /// Replace what multiplies stiffness and mass in products, residuals and
    /// the diagonal.
    void set_body(const BodyFactors &body)
    {
      this->body = body;
    }

    /// The sum, identity for constrained unknowns.
    /// @param src zero where constrained
    void vmult(VectorType &dst, const VectorType &src) const;

    using LoopOverEntries =
      std::function<void(const unsigned int, const unsigned int)>;

    /// The same without care for constrained unknowns of dst, and with loops
    /// over vectors that are best done while their entries are in the cache.
    /// @param before called with ranges of entries that cells will add to: sets
    ///   dst to zero
    /// @param after called with ranges of entries that are final
    void vmult(VectorType            &dst,
               const VectorType      &src,
               const LoopOverEntries &before,
               const LoopOverEntries &after) const;

    /// dst = b - sum src, zero for constrained unknowns.
    void
    residual(VectorType &dst, const VectorType &src, const VectorType &b) const;

    /// Asked for by the interface of PreconditionChebyshev, which never calls
    /// it when it is given a diagonal.
    Number el(const unsigned int, const unsigned int) const
    {
      AssertThrow(false, dealii::ExcNotImplemented());
      return 0.;
    }

    /// Elastic part without constraints; vectors of index 1.
    void plain_vmult(VectorType &dst, const VectorType &src) const;

    /// Compute the diagonals of stiffness and mass, once.
    void compute_diagonals();

    /// Forget what only setting up needed: the library's tables of unknowns,
    /// where those of the nodes serve.
    void release_setup_data();

    /// One over the diagonal of the sum; 0 for constrained unknowns.
    /// @param largest_eigenvalue of the elastic part times its inverse
    ///   diagonal; the other parts bring no larger one
    void get_inverse_diagonal(VectorType  &inverse,
                              const Number largest_eigenvalue) const;

    std::size_t memory_consumption() const
    {
      return matrix_free.memory_consumption() +
             (tangents.size() + definite_tangents.size()) * sizeof(Matrix) +
             nodes.memory_consumption() + plain_nodes.memory_consumption() +
             elastic_diagonal.memory_consumption() +
             mass_diagonal.memory_consumption();
    }

  private:
    using Data = dealii::MatrixFree<dim, Number, Simd>;
    using Evaluator =
      dealii::FEEvaluation<dim, degree, degree + 1, dim, Number, Simd>;
    using Range  = std::pair<unsigned int, unsigned int>;
    using Matrix = dealii::Tensor<2, dim, Simd>;

    static constexpr unsigned int n_1d = degree + 1;
    static constexpr unsigned int n_face =
      dealii::Utilities::pow(n_1d, dim - 1);
    using FaceField = std::array<dealii::Tensor<1, dim, Simd>, n_face>;

    // The displacement components of a node stand side by side in a vector: one
    // load per cell and node, then a transposition in registers, is much
    // cheaper than a gather or scatter per unknown. Of every batch of cells the
    // start in offsets of where its nodes are, [node][lane];
    // invalid_unsigned_int where nodes hang or are not stored like that.
    struct NodeTable
    {
      std::vector<unsigned int> start_of_batch;
      std::vector<unsigned int> offsets;

      bool operator==(const NodeTable &other) const
      {
        return start_of_batch == other.start_of_batch &&
               offsets == other.offsets;
      }

      std::size_t memory_consumption() const
      {
        return (start_of_batch.size() + offsets.size()) * sizeof(unsigned int);
      }
    };

    using Tangents      = dealii::AlignedVector<Matrix>;
    using LoopOverCells = std::function<
      void(const Data &, VectorType &, const VectorType &, const Range &)>;

    const NodeTable &nodes_without_constraints() const
    {
      return plain_nodes.start_of_batch.empty() ? nodes : plain_nodes;
    }

    const Tangents &tangents_of_products() const
    {
      return definite_tangents.empty() ? tangents : definite_tangents;
    }

    LoopOverCells product_with(const Tangents &contact) const;
    void          apply_to_cells(VectorType       &dst,
                                 const VectorType &src,
                                 const Range      &range,
                                 const Tangents   &contact) const;
    void
    read(Evaluator &cell, const VectorType &src, const NodeTable &table) const;
    void add_to(VectorType &dst, Evaluator &cell, const NodeTable &table) const;
    void add_elastic(Evaluator &cell, const Number factor) const;
    void multiply_by_mass(const Evaluator &cell,
                          const Simd      *values,
                          const Number     factor,
                          Simd            *products) const;
    void read_face(const Evaluator &cell, FaceField &values) const;
    dealii::Tensor<1, dim, Simd> diagonal_of_contact(const Matrix *tangents,
                                                     const unsigned int i,
                                                     const Number lambda) const;
    void apply_contact(const Matrix *tangents, FaceField &field) const;
    template <bool transpose>
    void interpolate(FaceField &field) const;

    NodeTable find_nodes(const dealii::AffineConstraints<Number> &constraints,
                         const unsigned int                       index) const;
    bool      append_nodes(const unsigned int                       batch,
                           const dealii::AffineConstraints<Number> &constraints,
                           const unsigned int                       index,
                           std::vector<unsigned int>               &offsets) const;
    void      forget_categories(const unsigned int n_dof_handlers);
    void      forget_unknowns(const NodeTable &table, const unsigned int index);
    void      find_contact_cells();
    void      find_face_nodes();

    const BlockParameters                 parameters;
    const dealii::types::global_dof_index n_unknowns;
    const bool                            with_plain_product;
    Number                                lambda, mu, density;
    BodyFactors                           body;
    std::vector<Number>                   mass_shares; // of the nodes of a cell
    Data                                  matrix_free;
    NodeTable                             nodes;
    NodeTable plain_nodes; // empty if like the others

    // Contact: of every batch of cells, the slot of its tangents or
    // invalid_unsigned_int; of every cell face (in the order of the mesh), slot
    // and lane. Tangents are times the weight of the point.
    struct Place
    {
      unsigned int slot, lane;
      double       area; // [mm^2]
    };

    std::vector<unsigned int>                  slot_of_batch;
    std::vector<Place>                         place_of_face;
    unsigned int                               n_slots = 0;
    Tangents                                   tangents, definite_tangents;
    std::array<unsigned int, n_face>           face_nodes;
    std::array<std::array<Number, n_1d>, n_1d> shape; // [point][node]
    std::vector<unsigned int> lexicographic; // of points of the face quadrature

    VectorType elastic_diagonal, mass_diagonal;
  };
} // namespace SlipStep

#endif
