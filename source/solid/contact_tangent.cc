// SPDX-License-Identifier: LGPL-2.1-or-later
#include <slipstep/solid/contact_tangent.h>

#include <deal.II/base/qprojector.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace SlipStep
{
  using namespace dealii;



  template <int dim>
  std::vector<unsigned int>
  lexicographic_face_points(const unsigned int     n_1d,
                            const BlockParameters &parameters)
  {
    const QGauss<1>           line(n_1d);
    std::vector<unsigned int> numbers;
    const Quadrature<dim>     points =
      QProjector<dim>::project_to_face(ReferenceCells::get_hypercube<dim>(),
                                       QGauss<dim - 1>(n_1d),
                                       parameters.contact_face);
    for (const Point<dim> &point : points.get_points())
      {
        unsigned int number = 0;
        for (unsigned int i = dim - 1; i-- > 0;)
          {
            unsigned int q = 0;
            while (std::abs(point[parameters.tangential_axis(i)] -
                            line.point(q)[0]) > 1e-10)
              ++q;
            number = number * n_1d + q;
          }
        numbers.push_back(number);
      }
    return numbers;
  }



  // With two rows, by Cayley and Hamilton,
  //   |A| = (A^T A + |det A| I) / (tr(A^T A) + 2 |det A|)^(1/2).
  template <int dim>
  Tensor<2, dim> definite_part(const Tensor<2, dim> &tangent,
                               const unsigned int    normal_axis)
  {
    Tensor<2, dim> result;
    result[normal_axis][normal_axis] =
      std::max(0., tangent[normal_axis][normal_axis]);
    const unsigned int t = normal_axis == 0 ? 1 : 0;
    if (dim == 2)
      {
        result[t][t] = std::abs(tangent[t][t]);
        return result;
      }
    const unsigned int s = normal_axis == 2 ? 1 : 2;
    Tensor<2, 2>       tangential;
    tangential[0][0] = tangent[t][t];
    tangential[0][1] = tangent[t][s];
    tangential[1][0] = tangent[s][t];
    tangential[1][1] = tangent[s][s];

    Tensor<2, 2> square = transpose(tangential) * tangential;
    const double det    = std::abs(determinant(tangential));
    const double sum    = std::sqrt(trace(square) + 2. * det);
    if (sum == 0.)
      return result;
    result[t][t] = (square[0][0] + det) / sum;
    result[s][s] = (square[1][1] + det) / sum;
    result[t][s] = result[s][t] = square[0][1] / sum;
    return result;
  }



  template Tensor<2, 2> definite_part(const Tensor<2, 2> &, const unsigned int);
  template Tensor<2, 3> definite_part(const Tensor<2, 3> &, const unsigned int);
  template std::vector<unsigned int>
  lexicographic_face_points<2>(const unsigned int, const BlockParameters &);
  template std::vector<unsigned int>
  lexicographic_face_points<3>(const unsigned int, const BlockParameters &);
} // namespace SlipStep
