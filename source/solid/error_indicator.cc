// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/error_indicator.h>

#include <deal.II/fe/fe_values.h>


namespace SlipStep
{
  using namespace dealii;

  namespace
  {
    const double factor = 1. / 6.;
  }



  // One pass over the cells of a mesh. Every rank computes the jumps at its own
  // cells, those towards ghost cells twice: nothing has to be exchanged.
  template <int dim>
  class ErrorIndicator<dim>::Evaluation
  {
  public:
    using Cell      = typename DoFHandler<dim>::active_cell_iterator;
    using Tractions = std::vector<Tensor<1, dim>>;

    Evaluation(const BlockParameters  &parameters,
               const DoFHandler<dim>  &dof_handler,
               const Vector           &displacement,
               const ContactFace<dim> &contact,
               const LoadFactors      &loads)
      : parameters(parameters)
      , displacement(displacement)
      , contact(contact)
      , loads(loads)
      , mu(parameters.shear_modulus())
      , lambda(parameters.lame_lambda())
      , cell_quadrature(parameters.degree + 1)
      , in_cell(dof_handler.get_fe(),
                cell_quadrature,
                update_hessians | update_JxW_values)
      , own_face(dof_handler.get_fe(),
                 contact.quadrature(),
                 update_gradients | update_JxW_values | update_normal_vectors)
      , own_subface(dof_handler.get_fe(),
                    contact.quadrature(),
                    update_gradients | update_JxW_values |
                      update_normal_vectors)
      , other_face(dof_handler.get_fe(), contact.quadrature(), update_gradients)
      , other_subface(dof_handler.get_fe(),
                      contact.quadrature(),
                      update_gradients)
    {}

    double in_cell_and_on_faces(const Cell &cell)
    {
      double sum = divergence_term(cell);
      for (const unsigned int f : cell->face_indices())
        sum += cell->face(f)->at_boundary() ? boundary_term(cell, f) :
                                              jump_term(cell, f);
      return factor / parameters.young_modulus * sum;
    }

    double on_contact_face(const typename ContactFace<dim>::CellFace &face)
    {
      return factor / parameters.young_modulus * contact_misfit(face) +
             stick_slip_border(face) + edge_of_contact(face);
    }

  private:
    const BlockParameters  &parameters;
    const Vector           &displacement;
    const ContactFace<dim> &contact;
    const LoadFactors      &loads;
    const double            mu, lambda;
    const QGauss<dim>       cell_quadrature;
    FEValues<dim>           in_cell;
    FEFaceValues<dim>       own_face;
    FESubfaceValues<dim>    own_subface;
    FEFaceValues<dim>       other_face;
    FESubfaceValues<dim>    other_subface;

    const FEValuesExtractors::Vector displacements{0};

    // sigma n at the points of a face, with normals that may come from the
    // other side.
    Tractions tractions(const FEFaceValuesBase<dim>       &values,
                        const std::vector<Tensor<1, dim>> &normals) const
    {
      std::vector<Tensor<2, dim>> gradients(values.n_quadrature_points);
      values[displacements].get_function_gradients(displacement, gradients);
      Tractions result(gradients.size());
      for (unsigned int q = 0; q < gradients.size(); ++q)
        result[q] = mu * (gradients[q] + transpose(gradients[q])) * normals[q] +
                    lambda * trace(gradients[q]) * normals[q];
      return result;
    }

    double divergence_term(const Cell &cell)
    {
      in_cell.reinit(cell);
      std::vector<Tensor<3, dim>> hessians(in_cell.n_quadrature_points);
      in_cell[displacements].get_function_hessians(displacement, hessians);
      double sum = 0.;
      for (unsigned int q = 0; q < hessians.size(); ++q)
        {
          Tensor<1, dim> divergence;
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = 0; j < dim; ++j)
              divergence[i] += mu * hessians[q][i][j][j] +
                               (mu + lambda) * hessians[q][j][j][i];
          sum += divergence.norm_square() * in_cell.JxW(q);
        }
      return cell->diameter() * cell->diameter() * sum;
    }

    static double jump(const Tractions             &own,
                       const Tractions             &other,
                       const FEFaceValuesBase<dim> &values)
    {
      double sum = 0.;
      for (unsigned int q = 0; q < own.size(); ++q)
        sum += (own[q] - other[q]).norm_square() * values.JxW(q);
      return sum;
    }

    double jump_term(const Cell &cell, const unsigned int f)
    {
      double sum = 0.;
      if (cell->face(f)->has_children())
        {
          // Smaller cells on the other side.
          const unsigned int other_f = cell->neighbor_of_neighbor(f);
          for (unsigned int s = 0; s < cell->face(f)->n_children(); ++s)
            {
              own_subface.reinit(cell, f, s);
              other_face.reinit(cell->neighbor_child_on_subface(f, s), other_f);
              const auto &normals = own_subface.get_normal_vectors();
              sum += jump(tractions(own_subface, normals),
                          tractions(other_face, normals),
                          own_subface);
            }
          return 0.25 * cell->face(f)->child(0)->diameter() * sum;
        }

      own_face.reinit(cell, f);
      const auto &normals = own_face.get_normal_vectors();
      if (cell->neighbor_is_coarser(f))
        {
          const auto place = cell->neighbor_of_coarser_neighbor(f);
          other_subface.reinit(cell->neighbor(f), place.first, place.second);
          sum = jump(tractions(own_face, normals),
                     tractions(other_subface, normals),
                     own_face);
        }
      else
        {
          other_face.reinit(cell->neighbor(f), cell->neighbor_of_neighbor(f));
          sum = jump(tractions(own_face, normals),
                     tractions(other_face, normals),
                     own_face);
        }
      return 0.25 * cell->face(f)->diameter() * sum;
    }

    // The contact face has its own term.
    double boundary_term(const Cell &cell, const unsigned int f)
    {
      const FaceConditions &face = parameters.faces[f];
      if (face.is_contact)
        return 0.;
      own_face.reinit(cell, f);
      const Tractions own = tractions(own_face, own_face.get_normal_vectors());
      const Tensor<1, 3> given = face.traction(loads);
      double             sum   = 0.;
      for (unsigned int d = 0; d < dim; ++d)
        if (!parameters.holds(f, d))
          for (unsigned int q = 0; q < own.size(); ++q)
            sum += std::pow(own[q][d] - given[d], 2) * own_face.JxW(q);
      return cell->face(f)->diameter() * sum;
    }

    double contact_misfit(const typename ContactFace<dim>::CellFace &face)
    {
      own_face.reinit(face.cell, face.face);
      const Tractions own = tractions(own_face, own_face.get_normal_vectors());
      double          sum = 0.;
      for (unsigned int q = 0; q < own.size(); ++q)
        sum += (own[q] + face.points[q].force).norm_square() * own_face.JxW(q);
      return face.cell->face(face.face)->diameter() * sum;
    }

    // Where a cell is in contact in part, its pressure ends somewhere in it.
    double
    edge_of_contact(const typename ContactFace<dim>::CellFace &face) const
    {
      double area = 0., closed_area = 0., square = 0.;
      for (const auto &point : face.points)
        {
          const double pressure = point.point.trial().normal_traction;
          area += point.JxW;
          closed_area += pressure > 0. ? point.JxW : 0.;
          square += point.JxW * pressure * pressure;
        }
      const double share = closed_area / area;
      return factor / parameters.young_modulus *
             face.cell->face(face.face)->diameter() * share * (1. - share) *
             square;
    }

    double
    stick_slip_border(const typename ContactFace<dim>::CellFace &face) const
    {
      double area = 0., slip_area = 0., mean_ratio = 0., square = 0.;
      for (const auto &point : face.points)
        {
          const ContactState &state = point.point.trial();
          area += point.JxW;
          slip_area += point.slips ? point.JxW : 0.;
          mean_ratio += point.JxW * state.loading_ratio;
          square += point.JxW * state.traction.norm_square();
        }
      mean_ratio /= area;
      double variance = 0.;
      for (const auto &point : face.points)
        variance += point.JxW *
                    std::pow(point.point.trial().strength *
                               (point.point.trial().loading_ratio - mean_ratio),
                             2);
      const double share  = slip_area / area;
      const double border = share * (1. - share) * square;
      return factor / parameters.young_modulus *
               face.cell->face(face.face)->diameter() * (variance + border) +
             border / (2. * contact.friction_law().tangential_stiffness());
    }
  };



  template <int dim>
  std::vector<double>
  ErrorIndicator<dim>::squared_errors(const DoFHandler<dim>  &dof_handler,
                                      const Vector           &displacement,
                                      const ContactFace<dim> &contact,
                                      const LoadFactors      &loads) const
  {
    Evaluation evaluation(
      parameters, dof_handler, displacement, contact, loads);
    std::vector<double> errors(dof_handler.get_triangulation().n_active_cells(),
                               0.);
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        errors[cell->active_cell_index()] +=
          evaluation.in_cell_and_on_faces(cell);
    for (const auto &face : contact.cell_faces())
      errors[face.cell->active_cell_index()] +=
        evaluation.on_contact_face(face);
    return errors;
  }



  template class ErrorIndicator<2>;
  template class ErrorIndicator<3>;
} // namespace SlipStep
