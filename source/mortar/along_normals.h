// Multipliers along a normal that turns, LocalCoupling::along_normals; only
// sources of this room include it.
#pragma once

#include <mortise/mortar/local_coupling.h>

#include <array>
#include <vector>

namespace mortise
{
  /// int N_i N_j n on the covered part of a face, by component of n.
  using NormalMoments = std::array<dealii::FullMatrix<double>, dim>;

  /// Add w_q N_i N_j n of some points, of which @p weighted has w_q N_i. @p normal:
  /// the coefficients of n.
  void
  add_normal_moments(const std::vector<dealii::Tensor<1, dim>> &normal,
                     const dealii::FullMatrix<double>          &values,
                     const dealii::FullMatrix<double>          &weighted,
                     NormalMoments                             &moments);

  /// The coefficients in N of the field with the normals of @p frames at nodes.
  std::vector<dealii::Tensor<1, dim>>
  in_functions(const std::vector<Frame> &frames, const FaceTrace &trace);

  /// Set LocalCoupling::along_normals: the projection on the whole face,
  /// corrected on its covered part by @p moments of the multipliers there.
  void
  set_along_normals(const SurfaceFace        &face,
                    const FaceTrace          &trace,
                    const std::vector<Frame> &frames,
                    const NormalMoments      &moments,
                    LocalCoupling            &local);

  /// w_q N_i(x_q); weights of signed sectors may be negative.
  void
  scale_rows(const dealii::FullMatrix<double> &values,
             const double                     *weights,
             dealii::FullMatrix<double>       &scaled);
} // namespace mortise
