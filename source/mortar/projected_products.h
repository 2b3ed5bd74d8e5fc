// Products of a field along a curved face with the nodal functions of the face,
// as polynomials of the face; only sources of this room include it.
#pragma once

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

#include <mortise/interface/surface_evaluation.h>
#include <mortise/mortar/nodal_block.h>

#include <algorithm>
#include <vector>

namespace mortise
{
  /// The projection of phi_k times a field on the polynomials of the face,
  /// which
  /// does the same work on them: at k n + i its value at node i, of n. @p field:
  /// its value where the nodal functions have the values that it is given.
  template <typename Value, typename Field>
  std::vector<Value>
  projected_products(const SurfaceFace &face,
                     const FaceTrace   &trace,
                     const Field       &field)
  {
    const TraceBasis                 &basis = trace.basis();
    const dealii::FullMatrix<double> &functions =
      face_nodal_basis(trace.shape, trace.degree).functions;
    const unsigned int         n = basis.size();
    dealii::FullMatrix<double> mass(n, n);
    std::vector<Value>         moments(n * n); // int phi_k phi_j field
    dealii::Vector<double>     hierarchical(n), phi(n);
    FacePolynomial             polynomial;
    polynomial.reinit(face, face.frame.center);
    // a product of three functions and the area, a root of a polynomial
    const ReferenceRule &rule =
      gauss_rule(std::min(2 * trace.degree + face.degree + 2, max_gauss_points))
        .on(face.shape);
    for (unsigned int q = 0; q < rule.weight.size(); ++q)
      {
        basis.evaluate(rule.xi_1[q], rule.xi_2[q], &hierarchical(0));
        functions.Tvmult(phi, hierarchical);
        Vec3<Lanes> x, dx[2];
        polynomial.evaluate(broadcast(rule.xi_1[q]),
                            broadcast(rule.xi_2[q]),
                            x,
                            dx);
        const Vec3<Lanes> normal = cross(dx[0], dx[1]);
        const double      area =
          rule.weight[q] * square_root(dot(normal, normal))[0];
        const Value value = field(phi);
        for (unsigned int k = 0; k < n; ++k)
          for (unsigned int j = 0; j < n; ++j)
            {
              const double product = area * phi(k) * phi(j);
              mass(k, j) += product;
              moments[k * n + j] += product * value;
            }
      }
    mass.gauss_jordan();
    std::vector<Value> result(n * n);
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          result[k * n + i] += mass(i, j) * moments[k * n + j];
    return result;
  }

  /// Does the face bend, by its normals at nodes, beyond rounding?
  inline bool
  are_unlike(const std::vector<Frame> &frames)
  {
    constexpr double rounding = 1e-12;
    return std::any_of(frames.begin(), frames.end(), [&](const Frame &frame) {
      return (frame[0] - frames[0][0]).norm() > rounding;
    });
  }

  /// That where nodal functions have the values @p phi, not of unit length.
  inline dealii::Tensor<1, 3>
  interpolated(const std::vector<Frame>     &frames,
               const dealii::Vector<double> &phi)
  {
    dealii::Tensor<1, 3> normal;
    for (unsigned int k = 0; k < frames.size(); ++k)
      normal += phi(k) * frames[k][0];
    return normal;
  }
} // namespace mortise
