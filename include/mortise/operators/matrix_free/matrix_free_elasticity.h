// Linear elasticity without a matrix, several cells at once: products by sum
// factorisation on hexahedra, by dense matrices of the reference cell on
// tetrahedra. It never resolves constraints and never communicates.
#pragma once

#include <deal.II/base/aligned_vector.h>
#include <deal.II/base/partitioner.h>

#include <deal.II/lac/full_matrix.h>

#include <mortise/body/spaces/nodal_space.h>

#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace mortise
{
  /// The cells of one body and degree, computed several at once.
  template <typename Number>
  struct CellBatches
  {
    bool         tetrahedra = false;
    unsigned int degree     = 1;
    /// Per cell; points only of cells with a Jacobian that varies.
    unsigned int     n_nodes = 0, n_points = 0;
    PointLaw<Number> law;
    unsigned int     n_cells = 0;
    /// Batches with constant Jacobians come first.
    unsigned int n_affine = 0, n_batches = 0;
    unsigned int n_affine_cells = 0;
    /// [batch][node][lane]: index of the first component. Nodes of hexahedra
    /// are lexicographic, those of tetrahedra in the order of simplex_nodes().
    /// Lanes without a cell repeat the first and have no metric.
    dealii::AlignedVector<unsigned int> nodes;
    /// The same of the pressures in mixed form, of one degree less, else empty:
    /// indices.
    dealii::AlignedVector<unsigned int> pressure_nodes;
    double compressibility = 0., pressure_norm = 0.;
    /// dxi_a/dx_e sqrt(|J|) as [batch][a][e][lane] on affine cells; after these
    /// dxi_a/dx_e sqrt(w |J|) as [batch][point][a][e][lane]. On tetrahedra xi
    /// are the barycentric coordinates of the second to last ascending vertex,
    /// or on curved ones those of simplex_rule().
    dealii::AlignedVector<Number> metric;

    /// Cells of a batch.
    unsigned int
    lanes(unsigned int batch) const;

    const Number *
    metric_of(unsigned int batch) const;
  };

  /// The pressures that belong to a space of displacements.
  struct PressureNodes
  {
    const NodalSpace                          &space;
    const dealii::Utilities::MPI::Partitioner &layout; ///< node n has index n
  };

  template <typename Number>
  class MatrixFreeElasticity
  {
  public:
    /// @p layout: where the components 3 n + c of node n stand in vectors; owned
    /// and relevant ones; @p pressures: what the products in mixed form need.
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
      /// Where the displacements stand in vectors, component after component of
      /// each node, and the pressures.
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
    class Kernel;      ///< of one degree
    class MixedKernel; ///< what it can do besides in mixed form
    template <int n>
    class KernelOfSize;
    template <int n>
    class MixedKernelOfSize;
    template <int degree>
    class SimplexKernel;
    template <int degree>
    class MixedSimplexKernel;

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

    static std::unique_ptr<Kernel>
    make_kernel(unsigned int degree);
    static std::unique_ptr<Kernel>
    make_mixed_kernel(unsigned int degree);
    static std::unique_ptr<Kernel>
    make_simplex_kernel(const CellBatches<Number> &cells);
    static std::unique_ptr<Kernel>
    make_mixed_simplex_kernel(const CellBatches<Number> &cells);

    std::vector<CellBatches<Number>>     groups;
    std::vector<std::unique_ptr<Kernel>> kernels; ///< by group
    std::vector<MixedKernel *>           mixed;   ///< the same ones, or null
  };
} // namespace mortise
