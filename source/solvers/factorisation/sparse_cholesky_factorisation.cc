// The panels of sparse_cholesky.h.
#include <deal.II/base/mpi.h>

#include <mortise/operators/matrix_free/tensor_kernel.h>
#include <mortise/solvers/factorisation/front.h>
#include <mortise/solvers/factorisation/sparse_cholesky.h>

#include <algorithm>
#include <type_traits>

namespace mortise
{
  using namespace dealii;

  /// Makes the panels, children in front of their parents.
  template <typename Number, typename Work>
  class SparseCholesky<Number, Work>::Factorisation
  {
  public:
    Factorisation(const SparseCholesky &inverse, const GatheredRows &matrix)
      : inverse(inverse)
      , matrix(matrix)
      , node_at(inverse.permutation.size())
      , local(inverse.permutation.size(), -1)
      , n_variants(inverse.supernodes.size(), 1)
      , updates(inverse.supernodes.size())
    {
      for (unsigned int i = 0; i < node_at.size(); ++i)
        node_at[inverse.permutation[i]] = i;
      for (unsigned int s = 0; s < n_variants.size(); ++s)
        {
          const Supernode &supernode = inverse.supernodes[s];
          for (unsigned int i = 0; i < supernode.width; ++i)
            n_variants[s] =
              std::max(n_variants[s],
                       matrix.variants[node_at[supernode.first + i]]);
          for (const unsigned int child : supernode.children)
            n_variants[s] = std::max(n_variants[s], n_variants[child]);
        }
    }

    /// The panels of supernode @p s; empty when it is not positive definite.
    AlignedVector<Number>
    process(const unsigned int s)
    {
      const Supernode &supernode = inverse.supernodes[s];
      for (unsigned int i = 0; i < supernode.width; ++i)
        local[supernode.first + i] = i;
      for (unsigned int i = 0; i < supernode.rows.size(); ++i)
        local[supernode.rows[i]] = supernode.width + i;
      const unsigned int  stride = padded<Number>(supernode.height());
      const std::size_t   size   = std::size_t(stride) * supernode.width;
      AlignedVector<Work> panels(size * n_variants[s]);
      for (unsigned int variant = 0; variant < n_variants[s]; ++variant)
        {
          auto &update = updates[s].emplace_back();
          if (!is_needed(s, variant))
            continue;
          Front<Work> front(supernode,
                            panels.begin() + size * variant,
                            static_cast<int>(stride),
                            update);
          add_matrix(front, supernode, variant);
          for (const unsigned int child : supernode.children)
            add_update(front, child, variant);
          if (!front.eliminate())
            return {};
        }
      for (const unsigned int child : supernode.children)
        updates[child].clear();
      if constexpr (std::is_same_v<Number, Work>)
        return panels;
      else
        {
          AlignedVector<Number> converted;
          converted.resize_fast(panels.size());
          std::copy(panels.begin(), panels.end(), converted.begin());
          return converted;
        }
    }

    /// Add the updates of other ranks to the common supernode @p s. Collective.
    void
    receive(const unsigned int s)
    {
      for (const unsigned int child : inverse.supernodes[s].children)
        if (inverse.owner[child] != on_all_ranks)
          {
            const std::size_t height = inverse.supernodes[child].rows.size();
            updates[child].resize(n_variants[child]);
            for (auto &update : updates[child])
              {
                update.resize(height * height);
                MPI_Bcast(update.data(),
                          update.size(),
                          Utilities::MPI::mpi_type_id_for_type<Work>,
                          inverse.owner[child],
                          inverse.comm);
              }
          }
    }

  private:
    /// Is a variant of the panel of supernode @p s needed on this rank?
    bool
    is_needed(const unsigned int s, const unsigned int variant) const
    {
      return inverse.owner[s] != on_all_ranks || n_variants[s] == 1 ||
             inverse.common_component < 0 ||
             static_cast<int>(variant) == inverse.common_component;
    }

    void
    add_matrix(Front<Work>       &front,
               const Supernode   &supernode,
               const unsigned int component) const
    {
      for (unsigned int j = 0; j < supernode.width; ++j)
        {
          const unsigned int i      = node_at[supernode.first + j];
          const double      *values = matrix.row(i, component);
          Work              *to     = front.column(static_cast<int>(j));
          for (unsigned int k = matrix.begin[i]; k < matrix.begin[i + 1]; ++k)
            if (const int column = matrix.columns[k];
                inverse.permutation[column] >= supernode.first + j)
              to[local[inverse.permutation[column]]] =
                static_cast<Work>(values[k - matrix.begin[i]] *
                                  matrix.scale[i] * matrix.scale[column]);
        }
    }

    void
    add_update(Front<Work>       &front,
               const unsigned int child,
               const unsigned int component) const
    {
      const auto        &rows = inverse.supernodes[child].rows;
      const unsigned int n    = rows.size();
      const Work        *update =
        updates[child][n_variants[child] == 1 ? 0 : component].data();
      for (unsigned int j = 0; j < n; ++j, update += n)
        {
          Work *to = front.column(local[rows[j]]);
          for (unsigned int i = j; i < n; ++i)
            to[local[rows[i]]] += update[i];
        }
    }

    const SparseCholesky     &inverse;
    const GatheredRows       &matrix;
    std::vector<unsigned int> node_at;    ///< by position
    std::vector<int>          local;      ///< in the front, by position
    std::vector<unsigned int> n_variants; ///< by supernode
    /// Update matrices for parents, by supernode and variant.
    std::vector<std::vector<std::vector<Work>>> updates;
  };

  template <typename Number, typename Work>
  bool
  SparseCholesky<Number, Work>::factorise(const GatheredRows &matrix)
  {
    Factorisation factorisation(*this, matrix);
    panels.resize(supernodes.size());
    bool       positive = true;
    const auto process  = [&](const unsigned int s) {
      if (positive)
        panels[s] = factorisation.process(s);
      positive = positive && !panels[s].empty();
    };
    for (const unsigned int s : own)
      process(s);
    positive = Utilities::MPI::min(positive ? 1 : 0, comm) == 1;
    for (const unsigned int s : common)
      {
        factorisation.receive(s);
        process(s);
      }
    return Utilities::MPI::min(positive ? 1 : 0, comm) == 1;
  }

  template bool
  SparseCholesky<float, float>::factorise(const GatheredRows &);
  template bool
  SparseCholesky<float, double>::factorise(const GatheredRows &);
  template bool
  SparseCholesky<double, double>::factorise(const GatheredRows &);
} // namespace mortise
