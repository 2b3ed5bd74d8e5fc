// See monolithic_matrix.h.
#include <deal.II/base/mpi.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <mortise/solvers/epetra_tools.h>
#include <mortise/solvers/factorisation/monolithic_matrix.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  MonolithicNumbering::MonolithicNumbering(const BlockSystem &system)
  {
    const IndexSet    *owned[n_fields] = {&system.owned_displacement,
                                          &system.owned_pressure,
                                          &system.owned_multiplier};
    std::vector<Index> counts[n_fields];
    for (unsigned int field = 0; field < n_fields; ++field)
      {
        counts[field] = Utilities::MPI::all_gather(system.communicator,
                                                   owned[field]->n_elements());
        start[field].push_back(0);
        for (const Index count : counts[field])
          start[field].push_back(start[field].back() + count);
      }
    const unsigned int me =
      Utilities::MPI::this_mpi_process(system.communicator);
    Index begin = 0, end = 0;
    for (unsigned int r = 0; r < counts[0].size(); ++r)
      {
        if (r == me)
          begin = n;
        for (unsigned int field = 0; field < n_fields; ++field)
          {
            shift[field].push_back(n - start[field][r]);
            n += counts[field][r];
          }
        if (r == me)
          end = n;
      }
    owned_indices.set_size(n);
    owned_indices.add_range(begin, end);
  }

  MonolithicNumbering::Index
  MonolithicNumbering::operator()(const Field field, const Index i) const
  {
    const auto &all = start[field];
    return i + shift[field][std::upper_bound(all.begin(), all.end(), i) -
                            all.begin() - 1];
  }

  namespace
  {
    using Numbering = MonolithicNumbering;
    using Index     = Numbering::Index;

    /// Adds the nodes of @p space that hang, @p n_components numbers of
    /// @p field each.
    void
    add_hanging_nodes(const NodalSpace          &space,
                      const unsigned int         n_components,
                      const Numbering::Field     field,
                      const Numbering           &numbering,
                      AffineConstraints<double> &constraints)
    {
      for (const auto &line : space.hanging_nodes().get_lines())
        for (unsigned int c = 0; c < n_components; ++c)
          {
            const Index index = numbering(field, n_components * line.index + c);
            constraints.add_line(index);
            for (const auto &[node, weight] : line.entries)
              constraints.add_entry(index,
                                    numbering(field, n_components * node + c),
                                    weight);
          }
    }

    /// What is prescribed is zero. @p relevant: rows that the cells of this rank touch.
    AffineConstraints<double>
    monolithic_constraints(const NodalSystem &nodal,
                           const Numbering   &numbering,
                           const IndexSet    &relevant)
    {
      const NodalLevel         &level   = nodal.levels().front();
      const auto               &hanging = level.space->hanging_nodes();
      AffineConstraints<double> constraints(relevant);
      add_hanging_nodes(
        *level.space, dim, Numbering::displacement, numbering, constraints);
      if (nodal.pressure() != nullptr)
        add_hanging_nodes(nodal.pressure()->nodes().space,
                          1,
                          Numbering::pressure,
                          numbering,
                          constraints);
      const LevelVector<double> constrained =
        constrained_components(level, level.layout);
      for (const auto node : level.space->relevant_nodes())
        if (!hanging.is_constrained(node))
          for (unsigned int c = 0; c < dim; ++c)
            if (const Index index = dim * node + c; constrained(index) != 0.)
              constraints.add_line(numbering(Numbering::displacement, index));
      constraints.close();
      return constraints;
    }

    /// The cells of this rank in the monolithic numbering.
    class CellIndices
    {
    public:
      CellIndices(const NodalSystem &nodal, const Numbering &numbering)
      {
        const auto &layout = *nodal.levels().front().layout;
        for (unsigned int i = 0;
             i < layout.locally_owned_size() + layout.n_ghost_indices();
             ++i)
          displacements.push_back(
            numbering(Numbering::displacement, layout.local_to_global(i)));
        if (nodal.pressure() == nullptr)
          return;
        const auto &of_pressure = nodal.pressure()->nodes().layout;
        for (unsigned int i = 0; i < of_pressure.locally_owned_size() +
                                       of_pressure.n_ghost_indices();
             ++i)
          pressures.push_back(
            numbering(Numbering::pressure, of_pressure.local_to_global(i)));
      }

      const std::vector<Index> &
      of(const MatrixFreeElasticity<double>::Cell &cell)
      {
        cell_indices.clear();
        for (const unsigned int i : cell.displacements)
          cell_indices.push_back(displacements[i]);
        for (const unsigned int k : cell.pressures)
          cell_indices.push_back(pressures[k]);
        return cell_indices;
      }

      std::vector<Index> displacements, pressures; ///< by local index

    private:
      std::vector<Index> cell_indices;
    };

    /// Calls @p entry(row, column, value) for what is not K, G and C. @p B: expanded, or empty without
    /// multipliers.
    template <typename Entry>
    void
    for_each_constraint_entry(const BlockSystem    &system,
                              const ScaledResidual &residual,
                              const Numbering      &numbering,
                              const std::unique_ptr<Epetra_CrsMatrix> &B,
                              const Entry                             &entry)
    {
      for (unsigned int g = 0; g < system.free_pressures.size(); ++g)
        if (const int pinned = system.free_pressures.pinned(g); pinned >= 0)
          {
            const Index k =
              numbering(Numbering::pressure,
                        system.owned_pressure.nth_index_in_set(pinned));
            entry(k, k, -1. / residual.inverse_diagonal_p()[pinned]);
          }
      if (!B)
        return;
      int local = 0;
      for (const auto i : system.owned_multiplier)
        {
          const Index k = numbering(Numbering::multiplier, i);
          if (system.active && !(*system.active)[local])
            entry(k, k, -1. / residual.inverse_diagonal_lambda()[local]);
          else
            {
              const EpetraRow row(*B, local);
              for (int e = 0; e < row.length; ++e)
                {
                  const Index j =
                    numbering(Numbering::displacement, B->GCID(row.columns[e]));
                  entry(k, j, row.values[e]);
                  entry(j, k, row.values[e]);
                }
              entry(k, k, 0.);
              if (system.has_springs())
                {
                  const auto &S = system.spring_compliance.trilinos_matrix();
                  const EpetraRow springs(S, local);
                  for (int e = 0; e < springs.length; ++e)
                    entry(k,
                          numbering(Numbering::multiplier,
                                    S.GCID(springs.columns[e])),
                          -springs.values[e]);
                }
            }
          ++local;
        }
    }
  } // namespace

  std::unique_ptr<Epetra_CrsMatrix>
  monolithic_matrix(const BlockSystem         &system,
                    const ScaledResidual      &residual,
                    const MonolithicNumbering &numbering)
  {
    const NodalSystem                &nodal = *system.nodal;
    std::unique_ptr<Epetra_CrsMatrix> B;
    if (system.owned_multiplier.size() > 0)
      B = std::make_unique<Epetra_CrsMatrix>(system.coupling.expanded());
    CellIndices        cells(nodal, numbering);
    std::vector<Index> touched = cells.displacements;
    touched.insert(touched.end(),
                   cells.pressures.begin(),
                   cells.pressures.end());
    std::sort(touched.begin(), touched.end());
    IndexSet rows = numbering.owned();
    rows.add_indices(touched.begin(), touched.end());
    const AffineConstraints<double> constraints =
      monolithic_constraints(nodal, numbering, rows);

    touched.clear();
    for_each_constraint_entry(system,
                              residual,
                              numbering,
                              B,
                              [&](const Index row, const Index, const double) {
                                if (!rows.is_element(row))
                                  touched.push_back(row);
                              });
    std::sort(touched.begin(), touched.end());
    rows.add_indices(touched.begin(), touched.end());
    DynamicSparsityPattern sparsity(numbering.size(), numbering.size(), rows);
    nodal.elasticity().for_each_cell([&](const auto &cell) {
      constraints.add_entries_local_to_global(cells.of(cell), sparsity, false);
    });
    for_each_constraint_entry(system,
                              residual,
                              numbering,
                              B,
                              [&](const Index row,
                                  const Index column,
                                  const double) { sparsity.add(row, column); });
    SparseMatrix matrix;
    matrix.reinit(numbering.owned(),
                  numbering.owned(),
                  sparsity,
                  system.communicator,
                  true);
    nodal.elasticity().for_each_cell_matrix(
      [](const auto &) { return true; },
      [&](const auto &cell, const auto &local) {
        constraints.distribute_local_to_global(local.mixed,
                                               cells.of(cell),
                                               matrix);
      });
    for_each_constraint_entry(system,
                              residual,
                              numbering,
                              B,
                              [&](const Index  row,
                                  const Index  column,
                                  const double value) {
                                matrix.add(row, column, value);
                              });
    matrix.compress(VectorOperation::add);
    return std::make_unique<Epetra_CrsMatrix>(matrix.trilinos_matrix());
  }
} // namespace mortise
