// The dense matrix that a supernode of a factorisation is computed from. It
// never knows the order of elimination.
// Source: Liu (1992), "The multifrontal method for sparse matrix solution".
#pragma once

#include <deal.II/base/aligned_vector.h>

#include <mortise/solvers/elimination_tree.h>

#include <vector>

namespace mortise
{
  /// The columns of a supernode, then its rows below, with what they update;
  /// columnwise, the lower triangle.
  struct Front
  {
    explicit Front(const Supernode &supernode);

    double &
    operator()(const int i, const int j)
    {
      return values[i + std::size_t(height) * j];
    }

    /// [L_11^{-1}; L_21] in the columns and what remains for the parent behind
    /// them. False when the columns are not positive definite.
    bool
    eliminate();

    /// What remains for the parent: rows below, squared.
    std::vector<double>
    update();

    /// After eliminate(): [L_11^{-1}; -L_21 L_11^{-1}], columns padded with
    /// zeros to whole batches, so that both halves of a solve with these
    /// columns are one product. Spoils the front.
    template <typename Number>
    dealii::AlignedVector<Number>
    panel();

    int                 width, height;
    std::vector<double> values;
  };
} // namespace mortise
