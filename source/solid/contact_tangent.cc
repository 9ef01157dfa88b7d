#include <slipstep/solid/contact_tangent.h>

#include <deal.II/base/qprojector.h>
#include <deal.II/base/quadrature_lib.h>

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



  template std::vector<unsigned int>
  lexicographic_face_points<2>(const unsigned int, const BlockParameters &);
  template std::vector<unsigned int>
  lexicographic_face_points<3>(const unsigned int, const BlockParameters &);
} // namespace SlipStep
