// Elasticity without a matrix, several cells at once: internal forces and
// products with their derivative, by sum factorisation on hexahedra, by dense
// matrices of the reference cell on tetrahedra. Without constraints and
// communication.
#pragma once

#include <deal.II/lac/full_matrix.h>

#include <mortise/operators/matrix_free/cell_batches.h>

#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace mortise
{
  /// What points remember, by group of cells, [batch][point][number][lane];
  /// empty for linear laws.
  using PointHistory = std::vector<dealii::AlignedVector<double>>;

  /// The least determinant of deformation gradients at points, and the cell
  /// that has it.
  struct LeastJacobian
  {
    double       value = 1.;
    unsigned int group = 0, batch = 0, lane = 0;

    /// Of the first @p lanes lanes of a batch; what is not a number is least.
    template <typename Vector>
    void
    add(const Vector      &smallest,
        const unsigned int in_batch,
        const unsigned int lanes)
    {
      for (unsigned int l = 0; l < lanes; ++l)
        if (!(smallest[l] >= value))
          {
            value = smallest[l];
            batch = in_batch;
            lane  = l;
          }
    }
  };

  template <typename Number>
  class MatrixFreeElasticity
  {
  public:
    /// @p layout: where the components 3 n + c of node n stand in vectors; owned
    /// and relevant ones; @p pressures: what the products in mixed form need.
    /// K is the tangent of bodies whose law is not linear where they were last
    /// linearised.
    /// Collective; throws InputError for a tangled cell.
    MatrixFreeElasticity(const NodalSpace                          &space,
                         const dealii::Utilities::MPI::Partitioner &layout,
                         const PressureNodes *pressures = nullptr);
    ~MatrixFreeElasticity();

    /// dst += K src, both local with ghost entries, contributions of owned
    /// cells only.
    void
    add_product(const Number *src, Number *dst) const;

    /// dst += diag(K), as above.
    void
    add_diagonal(Number *dst) const;

    /// Of displacements and pressures; the same vector may not stand twice.
    struct Fields
    {
      Number *displacement = nullptr, *pressure = nullptr;
    };

    /// History of points that nothing happened to.
    PointHistory
    no_history() const;

    /// dst += f(u, p), the internal force f_i = int P : Grad N_i with the
    /// nominal stress of u, less p, after @p before, and in mixed form -int
    /// (dilatation of u - that of p) q; K u, and so on, of linear laws.
    /// @p thermal_strains: isotropic ones at points that have no stress, F = (1 +
    /// strain) F_e, or nothing.
    /// @p after: the history up to u, as large as @p before. Returns the least
    /// Jacobian of this rank's cells.
    LeastJacobian
    add_residual(const Fields       &src,
                 const PointHistory &before,
                 PointHistory       &after,
                 const Fields       &dst,
                 const PointHistory &thermal_strains = {}) const;

    /// Has K = df/du, and so on, at @p src from here on. @p previous: where it
    /// was linearised before by the same state; if given, the initial stress at
    /// finite strain is that of @p previous and its linear change to @p src
    /// instead of that of @p src, whose strains have parts of second order in
    /// the increment. Source: Magisano, Leonetti, Garcea, How to improve
    /// efficiency and robustness of the Newton method in geometrically
    /// non-linear structural problem discretized via displacement-based finite
    /// elements, CMAME 313 (2017), the method of mixed integration points.
    void
    linearise(const Fields       &src,
              const PointHistory &before,
              const PointHistory &thermal_strains = {},
              const Fields       &previous        = {});

    /// By group and cell, dP/dGrad u of laws that are not linear where they
    /// were last linearised, averaged over the cell; nothing for others.
    std::vector<std::vector<Moduli>>
    average_moduli(bool initial_stress = true) const;

    /// Has K of laws that are not linear from the points of @p fine, of the
    /// same cells and a degree that is not lower, by means with positive
    /// weights.
    void
    take_tangent(const MatrixFreeElasticity<double> &fine,
                 bool                                initial_stress = true);

    /// dst += [K G^T; G -C] src, see BlockSystem.
    void
    add_mixed_product(const Fields &src, const Fields &dst) const;

    /// dst += G^T p.
    void
    add_pressure_force(const Number *p, Number *dst) const;

    /// dst += P p, mass matrices in all cells.
    void
    add_pressure_norm(const Number *p, Number *dst) const;

    /// dst += diag(P), as above.
    void
    add_pressure_norm_diagonal(Number *dst) const;

    /// One cell in the order of its batch.
    struct Cell
    {
      const CellBatches<Number> &batches;
      /// Indices of displacements in vectors, component after component of each
      /// node, and of pressures.
      std::vector<unsigned int> displacements, pressures;
    };

    /// Of one cell, without regard to what is constrained or hangs.
    struct CellMatrix
    {
      /// [K G^T; G -C], displacements first.
      dealii::FullMatrix<double> mixed;
      dealii::FullMatrix<double> pressure_norm; ///< P, a mass matrix
    };

    /// Calls @p visit with each owned cell.
    void
    for_each_cell(const std::function<void(const Cell &)> &visit) const;

    /// Calls @p visit with the matrices of those for which @p wanted is true, right after that was
    /// asked; they are made of products with unit vectors.
    void
    for_each_cell_matrix(
      const std::function<bool(const Cell &)>                     &wanted,
      const std::function<void(const Cell &, const CellMatrix &)> &visit) const;

    /// Functions in a cell: entries (number among Cell::displacements, value)
    /// of each; those of one number add up, since nodes that hang may follow
    /// from one node in more than one way.
    using CellFunctions =
      std::vector<std::vector<std::pair<unsigned int, double>>>;

    /// Calls @p visit with W^T K W of the cells to which @p functions gives some, the columns of W, for as long as the
    /// cell is visited.
    void
    for_each_projected_matrix(
      const std::function<CellFunctions(const Cell &)> &functions,
      const std::function<
        void(const Cell &, const dealii::FullMatrix<double> &)> &visit) const;

    /// By body and, in each, by the degree of the displacement on the finest
    /// level: the same cells in the same order on all levels.
    const std::vector<CellBatches<Number>> &
    cells() const
    {
      return groups;
    }

  private:
    class Kernel; ///< of one degree
    template <typename Shape>
    class KernelOn;
    template <typename Shape, typename Pressures>
    class MixedKernelOn;
    template <typename Base>
    class TangentKernelOn;
    template <typename Base>
    class KeptTangentOn;
    template <typename Base, bool mixed>
    class NonlinearKernelOn;

    /// Of one group.
    struct StateOfPoints
    {
      const double *history;
      const double *thermal_strains; ///< or null
    };

    StateOfPoints
    state_of(unsigned int        g,
             const PointHistory &before,
             const PointHistory &thermal_strains) const
    {
      return {before[g].data(),
              thermal_strains.empty() || thermal_strains[g].empty() ?
                nullptr :
                thermal_strains[g].data()};
    }

    /// Of all lanes of a batch of group @p g.
    std::vector<CellMatrix>
    batch_matrices(unsigned int g, unsigned int batch) const;

    /// Of one lane.
    Cell
    cell(unsigned int g, unsigned int batch, unsigned int lane) const;

    /// W^T K W of all lanes of a batch.
    std::vector<dealii::FullMatrix<double>>
    projected_matrices(unsigned int                      g,
                       unsigned int                      batch,
                       const std::vector<CellFunctions> &functions) const;

    template <typename Shape>
    static std::unique_ptr<Kernel>
    make_kernel_on(const CellBatches<Number> &cells);
    template <typename Shape, typename Pressures>
    static std::unique_ptr<Kernel>
    make_mixed_kernel_on(const CellBatches<Number> &cells);
    static std::unique_ptr<Kernel>
    make_kernel(const CellBatches<Number> &cells);
    static std::unique_ptr<Kernel>
    make_mixed_kernel(const CellBatches<Number> &cells);
    static std::unique_ptr<Kernel>
    make_simplex_kernel(const CellBatches<Number> &cells);
    static std::unique_ptr<Kernel>
    make_mixed_simplex_kernel(const CellBatches<Number> &cells);

    std::vector<CellBatches<Number>>     groups;
    std::vector<std::unique_ptr<Kernel>> kernels; ///< by group
  };
} // namespace mortise
