// Which rows of B components share; only sources of this room include it.
#pragma once

#include <deal.II/lac/la_parallel_vector.h>

#include <mortise/mortar/multiplier_space.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace mortise
{
  /// Which rows of B components share: those of multipliers at the same dofs
  /// whose parts of the values at nodes are the same on all faces.
  class SharedEntries
  {
  public:
    using Index = MultiplierSpace::Index;
    using Dofs  = std::vector<Index>;
    using ByDof = dealii::LinearAlgebra::distributed::Vector<double>;
    using NodesAndComponents = std::vector<std::pair<Index, unsigned int>>;

    SharedEntries(const Dofs               &owned_dofs,
                  const NodesAndComponents &nodes_and_components,
                  const ByDof              &layout)
      : owned_dofs(owned_dofs)
      , nodes_and_components(nodes_and_components)
      , node(layout)
      , differs{{layout, layout}}
    {
      for (unsigned int i = 0; i < owned_dofs.size(); ++i)
        node(owned_dofs[i]) = nodes_and_components[i].first;
      node.update_ghost_values();
      for (ByDof &flags : differs)
        flags = 0.;
    }

    /// @p rows: in dofs.
    void
    compare(const MultiplierSpace::FaceMultipliers &rows)
    {
      const unsigned int n = rows.n_nodes();
      nodes.clear();
      for (const Index dof : rows.index)
        nodes.push_back(node(dof));
      for (unsigned int c = 1; c < dim; ++c)
        for (unsigned int other = 0; other < c; ++other)
          for (unsigned int k = 0; k < n; ++k)
            if (!are_equal(rows, c * n + k, other * n + k))
              {
                mark(rows, c * n + k, other);
                mark(rows, other * n + k, c - 1);
              }
    }

    /// Behind the last compare(). Collective.
    void
    exchange()
    {
      for (ByDof &flags : differs)
        flags.compress(dealii::VectorOperation::add);
    }

    /// By owned multiplier, which are numbered from @p first on.
    std::vector<CouplingMatrix::Row>
    rows(const Index first) const
    {
      std::vector<CouplingMatrix::Row>       result;
      std::array<std::vector<unsigned>, dim> entity; // by component
      unsigned int                           last = 0;
      for (unsigned int i = 0; i < nodes_and_components.size(); ++i)
        {
          const unsigned int c = nodes_and_components[i].second;
          if (c < last)
            entity = {};
          last      = c;
          Index row = first + i;
          for (unsigned int other = c; other-- > 0;)
            if (const auto &of_other = entity[other];
                entity[c].size() < of_other.size())
              if (const unsigned int j = of_other[entity[c].size()];
                  nodes_and_components[j].first ==
                    nodes_and_components[i].first &&
                  differs[other](owned_dofs[i]) +
                      differs[c - 1](owned_dofs[j]) ==
                    0.)
                row = result[j].entries;
          entity[c].push_back(i);
          result.push_back({row, c});
        }
      return result;
    }

  private:
    bool
    are_equal(const MultiplierSpace::FaceMultipliers &rows,
              const unsigned int                      a,
              const unsigned int                      b) const
    {
      const unsigned int i = rows.begin[a], j = rows.begin[b],
                         n = rows.begin[a + 1] - i;
      return rows.begin[b + 1] - j == n &&
             std::equal(nodes.begin() + i,
                        nodes.begin() + i + n,
                        nodes.begin() + j) &&
             std::equal(rows.weight.begin() + i,
                        rows.weight.begin() + i + n,
                        rows.weight.begin() + j);
    }

    /// The multipliers of @p row differ from those of the component that is
    /// this one among the others.
    void
    mark(const MultiplierSpace::FaceMultipliers &rows,
         const unsigned int                      row,
         const unsigned int                      among_others)
    {
      for (unsigned int e = rows.begin[row]; e < rows.begin[row + 1]; ++e)
        differs[among_others](rows.index[e]) += 1.;
    }

    const Dofs                &owned_dofs;
    const NodesAndComponents  &nodes_and_components;
    ByDof                      node; ///< of the first component
    std::array<ByDof, dim - 1> differs;
    std::vector<double>        nodes; ///< of one face, by entry
  };
} // namespace mortise
