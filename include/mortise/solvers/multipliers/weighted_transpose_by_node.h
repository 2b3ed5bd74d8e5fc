// The rows of T B^T by node of displacements, once for all components with the
// same entries.
#pragma once

#include <mortise/solvers/multipliers/weighted_transpose.h>

#include <vector>

namespace mortise
{
  struct WeightedTransposeByNode
  {
    /// @p rows: T B^T. @p numbers: nodes by its multipliers.
    WeightedTransposeByNode(WeightedTranspose   rows,
                            const RowsByEntity &B,
                            const NodeNumbers  &numbers);

    /// By node: have all components the same row, for those multipliers that
    /// exist (has_multiplier()), or none, since T is zero?
    std::vector<char>         is_common;
    std::vector<int>          row_of; ///< by node and component; -1: none
    std::vector<unsigned int> begin;  ///< by row
    std::vector<int>          nodes;  ///< of multipliers, ascending
    std::vector<double>       values;
    std::vector<int>          group_of; ///< neighbours with the same nodes

    /// Has the node of multipliers one of this component?
    bool
    has_multiplier(const int node, const unsigned int component) const
    {
      return (components[node] >> component & 1) != 0;
    }

    bool
    has_all_multipliers(const int node) const
    {
      return components[node] == (1 << dim) - 1;
    }

  private:
    using Entry = WeightedTranspose::Entry; ///< node, value

    struct Row
    {
      const Entry *first = nullptr, *last = nullptr;
    };

    /// The row of all components of a node, if they share one.
    bool
    unite(const Row *rows, std::vector<Entry> &united) const;
    bool
    same_nodes(unsigned int r, unsigned int s) const
    {
      return std::equal(nodes.begin() + begin[r],
                        nodes.begin() + begin[r + 1],
                        nodes.begin() + begin[s],
                        nodes.begin() + begin[s + 1]);
    }
    void
    add_row(const Row &row);

    std::vector<char> components; ///< bits, by node of multipliers
  };
} // namespace mortise
