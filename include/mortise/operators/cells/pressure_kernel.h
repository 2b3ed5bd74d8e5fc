// What the pressure adds to the matrix of one cell in mixed form, by dense
// products.
#pragma once

#include <deal.II/lac/full_matrix.h>

#include <mortise/operators/cells/cell_geometry.h>

#include <array>
#include <vector>

namespace mortise
{
  /// What the cells of one pair of elements share.
  class PressureKernel
  {
  public:
    /// @p system, @p pressure: elements of displacement and pressure on the
    /// cells of @p body, which is kept by reference.
    PressureKernel(const Body                       &body,
                   const dealii::FiniteElement<dim> &system,
                   const dealii::FiniteElement<dim> &pressure);

    /// With the pressures' functions Q_k and those of the displacement N_j in
    /// the numbering of the system,
    ///
    ///     G_kj = -int Q_k div N_j,   M_kl = int Q_k Q_l
    ///
    /// in divergence() and mass(). The Jacobian must be positive.
    void
    compute(const Body::CellIterator &cell);

    const dealii::FullMatrix<double> &
    divergence() const
    {
      return G;
    }

    const dealii::FullMatrix<double> &
    mass() const
    {
      return M;
    }

  private:
    const unsigned int                         n, n_pressures;
    std::array<std::vector<unsigned int>, dim> system_index;

    CellGeometry               geometry;
    std::vector<double>        weights;
    std::vector<double>        reference_gradients; ///< [q][a][i]
    std::vector<double>        reference_values;    ///< of Q, [q][k]
    std::vector<double>        gradients;           ///< w |J| dN/dx, [q][c][i]
    std::vector<double>        values;              ///< sqrt(w |J|) Q, [q][k]
    std::vector<double>        product;             ///< [k][c][i]
    dealii::FullMatrix<double> G, M;
  };
} // namespace mortise
