// See along_normals.h.
#include "along_normals.h"

#include <mortise/mortar/nodal_block.h>

#include "projected_products.h"

namespace mortise
{
  using namespace dealii;

  void
  add_normal_moments(const std::vector<Tensor<1, dim>> &normal,
                     const FullMatrix<double>          &values,
                     const FullMatrix<double>          &weighted,
                     NormalMoments                     &moments)
  {
    std::vector<double> at_points(values.m());
    FullMatrix<double>  of_component;
    for (unsigned int c = 0; c < dim; ++c)
      {
        for (unsigned int q = 0; q < values.m(); ++q)
          {
            at_points[q] = 0.;
            for (unsigned int j = 0; j < values.n(); ++j)
              at_points[q] += values(q, j) * normal[j][c];
          }
        scale_rows(weighted, at_points.data(), of_component);
        of_component.Tmmult(moments[c], values, true);
      }
  }

  std::vector<Tensor<1, dim>>
  in_functions(const std::vector<Frame> &frames, const FaceTrace &trace)
  {
    const FullMatrix<double> &functions =
      face_nodal_basis(trace.shape, trace.degree).functions;
    std::vector<Tensor<1, dim>> result(frames.size());
    for (unsigned int j = 0; j < frames.size(); ++j)
      for (unsigned int k = 0; k < frames.size(); ++k)
        result[j] += functions(j, k) * frames[k][0];
    return result;
  }

  void
  set_along_normals(const SurfaceFace        &face,
                    const FaceTrace          &trace,
                    const std::vector<Frame> &frames,
                    const NormalMoments      &moments,
                    LocalCoupling            &local)
  {
    /// Weight of the correction on the rest of the face.
    constexpr double   share = 1e-9;
    const unsigned int n     = frames.size();
    local.along_normals      = projected_products<Tensor<1, dim>>(
      face, trace, [&](const dealii::Vector<double> &phi) {
        return interpolated(frames, phi);
      });
    FullMatrix<double> mass(n, n), inverse(n, n);
    local.constraint.mTmult(mass, local.multiplier);
    inverse = mass;
    for (unsigned int i = 0; i < n; ++i)
      inverse(i, i) *= 1. + share;
    inverse.gauss_jordan();
    FullMatrix<double> half(n, n), wanted(n, n), now(n, n), left(n, n);
    for (unsigned int c = 0; c < dim; ++c)
      {
        local.multiplier.mmult(half, moments[c]);
        half.mTmult(wanted, local.multiplier); // k, i
        for (unsigned int k = 0; k < n; ++k)
          for (unsigned int i = 0; i < n; ++i)
            now(k, i) = local.along_normals[k * n + i][c];
        now.mmult(left, mass);
        wanted.add(-1., left);
        wanted.mmult(left, inverse);
        for (unsigned int k = 0; k < n; ++k)
          for (unsigned int i = 0; i < n; ++i)
            local.along_normals[k * n + i][c] += left(k, i);
      }
  }

  void
  scale_rows(const FullMatrix<double> &values,
             const double             *weights,
             FullMatrix<double>       &scaled)
  {
    scaled.reinit(values.m(), values.n(), true);
    for (unsigned int q = 0; q < values.m(); ++q)
      {
        const double *from = &values(q, 0);
        double       *to   = &scaled(q, 0);
        for (unsigned int i = 0; i < values.n(); ++i)
          to[i] = weights[q] * from[i];
      }
  }
} // namespace mortise
