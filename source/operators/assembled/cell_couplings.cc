#include <mortise/operators/assembled/elasticity.h>

#include <algorithm>
#include <utility>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Index = types::global_dof_index;

    /// The dofs that each cell couples, ascending, one cell after the other.
    struct CoupledDofs
    {
      std::vector<Index>       dofs;
      std::vector<std::size_t> start = {0};

      void
      append(std::vector<Index> &of_cell)
      {
        std::sort(of_cell.begin(), of_cell.end());
        of_cell.erase(std::unique(of_cell.begin(), of_cell.end()),
                      of_cell.end());
        dofs.insert(dofs.end(), of_cell.begin(), of_cell.end());
        start.push_back(dofs.size());
      }

      /// All that cells @p cells couple, ascending.
      std::vector<Index>
      joined(const std::vector<unsigned int> &cells) const
      {
        std::vector<Index> all;
        for (const unsigned int cell : cells)
          all.insert(all.end(),
                     dofs.begin() + start[cell],
                     dofs.begin() + start[cell + 1]);
        std::sort(all.begin(), all.end());
        all.erase(std::unique(all.begin(), all.end()), all.end());
        return all;
      }
    };

    /// Of the boundary of each owned cell, constrained dofs replaced by those
    /// that they depend on. Diagonals that couple with nothing go to
    /// @p sparsity.
    CoupledDofs
    coupled_dofs(const Body                      &body,
                 const FieldNumbering            &numbering,
                 const AffineConstraints<double> &constraints,
                 DynamicSparsityPattern          &sparsity)
    {
      CoupledDofs        coupled;
      std::vector<Index> dofs, resolved;
      for (const auto &cell : body.dof_handler.active_cell_iterators())
        if (cell->is_locally_owned())
          {
            dofs.resize(cell->get_fe().n_dofs_per_cell());
            cell->get_dof_indices(dofs);
            resolved.clear();
            for (unsigned int i = 0; i < dofs.size(); ++i)
              {
                const Index dof = numbering(body.index, dofs[i]);
                if (i >= cell->get_fe().get_first_hex_index())
                  sparsity.add(dof, dof);
                else if (!constraints.is_constrained(dof))
                  resolved.push_back(dof);
                else
                  {
                    sparsity.add(dof, dof);
                    for (const auto &entry :
                         *constraints.get_constraint_entries(dof))
                      resolved.push_back(entry.first);
                  }
              }
            coupled.append(resolved);
          }
      return coupled;
    }
  } // namespace

  void
  add_cell_couplings(const Body                      &body,
                     const FieldNumbering            &numbering,
                     const AffineConstraints<double> &constraints,
                     DynamicSparsityPattern          &sparsity)
  {
    const CoupledDofs coupled =
      coupled_dofs(body, numbering, constraints, sparsity);

    std::vector<std::pair<Index, unsigned int>> occurrences;
    occurrences.reserve(coupled.dofs.size());
    for (unsigned int cell = 0; cell + 1 < coupled.start.size(); ++cell)
      for (std::size_t k = coupled.start[cell]; k < coupled.start[cell + 1];
           ++k)
        occurrences.emplace_back(coupled.dofs[k], cell);
    std::sort(occurrences.begin(), occurrences.end());

    // the dofs of one entity are in the same cells and couple with the same
    std::vector<unsigned int> cells, last_cells;
    std::vector<Index>        columns;
    for (auto next = occurrences.begin(); next != occurrences.end();)
      {
        const Index row = next->first;
        cells.clear();
        for (; next != occurrences.end() && next->first == row; ++next)
          cells.push_back(next->second);
        if (cells != last_cells)
          {
            columns = coupled.joined(cells);
            last_cells.swap(cells);
          }
        sparsity.add_entries(row, columns.begin(), columns.end(), true);
      }
  }
} // namespace mortise
