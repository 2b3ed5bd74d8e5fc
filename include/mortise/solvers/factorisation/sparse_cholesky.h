// Supernodal sparse Cholesky factorisation for the many solves of a
// preconditioner, see doc/measurements/sparse_cholesky.md. Subtrees are
// distributed over the ranks; above them each rank treats one component. All
// ranks hold the matrix during factorisation. Sources: Duff, Reid (1983); Liu
// (1992), "The multifrontal method".
#pragma once

#include <deal.II/base/aligned_vector.h>

#include <mortise/solvers/factorisation/gathered_rows.h>
#include <mortise/solvers/factorisation/rows_by_node.h>

#include <vector>

namespace mortise
{
  /// Number of multiplications to factorise one component of @p rows.
  /// Collective.
  double
  factorisation_work(const RowsByNode &rows, MPI_Comm comm);

  /// Computed in the precision of @p Work, kept and applied in @p Number.
  template <typename Number, typename Work = double>
  class SparseCholesky
  {
  public:
    /// Factorise the matrix of these rows, once for all components with the
    /// same values. False on all ranks if it is not positive definite.
    /// Collective.
    bool
    initialize(const RowsByNode &rows, MPI_Comm comm);

    /// x = matrix^{-1} b, both with the entries of RowsByNode. Collective.
    void
    solve(double *x, const double *b) const;

  private:
    class Factorisation;

    void
    list_parts();
    bool
    factorise(const GatheredRows &matrix);
    /// visit(panel, number of components, the first of them).
    template <typename Visit>
    void
    for_each_panel(unsigned int s, const Visit &visit) const;
    /// The components of nodes in or from a buffer.
    void
    pack(const unsigned int *indices, unsigned int n, Number *to) const
    {
      for (unsigned int i = 0; i < n; ++i)
        std::copy_n(&vector[indices[i] * n_components],
                    n_components,
                    to + i * n_components);
    }
    void
    unpack(const unsigned int *indices,
           unsigned int        n,
           const Number       *from) const
    {
      for (unsigned int i = 0; i < n; ++i)
        std::copy_n(from + i * n_components,
                    n_components,
                    &vector[indices[i] * n_components]);
    }

    /// Sum the common part of vectors over the ranks.
    void
    add_up_common() const;
    void
    forward(unsigned int s) const
    {
      for_each_panel(s, [&](const Number *panel, const auto n, const auto c) {
        forward<n()>(s, panel, c);
      });
    }
    void
    backward(unsigned int s) const
    {
      for_each_panel(s, [&](const Number *panel, const auto n, const auto c) {
        backward<n()>(s, panel, c);
      });
    }
    /// With one panel, @p n components from the first.
    template <unsigned int n>
    void
    forward(unsigned int s, const Number *panel, unsigned int first) const;
    template <unsigned int n>
    void
    backward(unsigned int s, const Number *panel, unsigned int first) const;

    MPI_Comm                  comm = MPI_COMM_NULL;
    int                       rank = 0, n_ranks = 1;
    unsigned int              n_components = 1;
    std::vector<int>          entries;        ///< as in RowsByNode
    std::vector<int>          counts, starts; ///< nodes, components, by rank
    std::vector<double>       scale;          ///< by owned node
    std::vector<unsigned int> permutation;    ///< of each node in the order
    std::vector<Supernode>    supernodes;
    std::vector<int>          owner; ///< rank or on_all_ranks
    /// Component of common supernodes that this rank treats; -1: all.
    int                       common_component = -1;
    std::vector<unsigned int> own, common;    ///< supernodes
    std::vector<unsigned int> common_indices; ///< of nodes
    /// Nodes, components, of subtrees.
    std::vector<int>          part_counts, part_starts;
    std::vector<unsigned int> part_positions; ///< of nodes, rank by rank
    /// By supernode, see Front::eliminate(); one if all components have the
    /// same values.
    std::vector<dealii::AlignedVector<Number>> panels;
    /// By component, in the order of elimination.
    mutable std::vector<Number>           vector;
    mutable std::vector<Number>           exchange;
    mutable dealii::AlignedVector<Number> workspace; ///< of one supernode
  };
} // namespace mortise
