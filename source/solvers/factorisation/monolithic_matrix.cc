// See monolithic_matrix.h.
#include <deal.II/base/mpi.h>

#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/full_matrix.h>

#include <mortise/mortar/row_assembler.h>
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

    /// Prescribed values are zero. @p relevant: rows of the cells of this rank.
    AffineConstraints<double>
    monolithic_constraints(const BulkSystem &bulk,
                           const Numbering  &numbering,
                           const IndexSet   &relevant)
    {
      const MultigridLevel     &level   = bulk.levels().front();
      const auto               &hanging = level.space->hanging_nodes();
      AffineConstraints<double> constraints(relevant);
      add_hanging_nodes(
        *level.space, dim, Numbering::displacement, numbering, constraints);
      if (bulk.pressure() != nullptr)
        add_hanging_nodes(bulk.pressure()->nodes().space,
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
      CellIndices(const BulkSystem &bulk, const Numbering &numbering)
      {
        const auto &layout = *bulk.levels().front().layout;
        for (unsigned int i = 0;
             i < layout.locally_owned_size() + layout.n_ghost_indices();
             ++i)
          displacements.push_back(
            numbering(Numbering::displacement, layout.local_to_global(i)));
        if (bulk.pressure() == nullptr)
          return;
        const auto &of_pressure = bulk.pressure()->nodes().layout;
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

    /// Owned rows, and those that the cells of this rank touch.
    IndexSet
    relevant_rows(const CellIndices &cells, const Numbering &numbering)
    {
      std::vector<Index> touched = cells.displacements;
      touched.insert(touched.end(),
                     cells.pressures.begin(),
                     cells.pressures.end());
      std::sort(touched.begin(), touched.end());
      IndexSet rows = numbering.owned();
      rows.add_indices(touched.begin(), touched.end());
      return rows;
    }

    ExpansionList
    one(const Index i)
    {
      ExpansionList result;
      result.add(i, 1.);
      result.close();
      return result;
    }

    /// @p indices with what @p constraints make of them.
    ExpansionList
    resolve(const std::vector<Index>        &indices,
            const AffineConstraints<double> &constraints)
    {
      ExpansionList result;
      for (const Index i : indices)
        {
          if (!constraints.is_constrained(i))
            result.add(i, 1.);
          else
            for (const auto &[master, factor] :
                 *constraints.get_constraint_entries(i))
              result.add(master, factor);
          result.close();
        }
      return result;
    }

    /// Calls @p visit(i, columns, values) for the stiffness of interfaces, without
    /// constrained components.
    template <typename Visit>
    void
    for_each_row_of_interfaces(const BulkSystem &bulk,
                               const Numbering  &numbering,
                               const Visit      &visit)
    {
      const SparseMatrix &K = bulk.stiffness_of_interfaces();
      if (K.m() == 0)
        return;
      std::vector<double> is_free(K.n_rows(), 1.);
      for (const unsigned int i : bulk.levels().front().constrained)
        is_free[i] = 0.;
      const std::vector<double> of_columns = K.on_columns(is_free.data());
      for (unsigned int i = 0; i < K.n_rows(); ++i)
        {
          if (is_free[i] == 0.)
            continue;
          const auto          row = K.row(i);
          ExpansionList       columns;
          std::vector<double> values;
          for (unsigned int k = 0; k < row.length; ++k)
            if (of_columns[row.columns[k]] != 0.)
              {
                columns.add(numbering(Numbering::displacement,
                                      K.global_column(row.columns[k])),
                            1.);
                columns.close();
                values.push_back(row.values[k]);
              }
          if (!values.empty())
            visit(numbering(Numbering::displacement, K.global_row(i)),
                  columns,
                  FullMatrix<double>(1, values.size(), values.data()));
        }
    }

    /// Calls @p visit(i, columns, values, transposed) for what is not K, G and C:
    /// entries of the row i, or of the column. @p B and @p forces: expanded, without
    /// rows where there are no multipliers.
    template <typename Visit>
    void
    for_each_constraint_row(const BlockSystem    &system,
                            const ScaledResidual &residual,
                            const Numbering      &numbering,
                            const SparseMatrix   &B,
                            const SparseMatrix   &forces,
                            const Visit          &visit)
    {
      const auto visit_diagonal = [&](const Index i, const double value) {
        visit(i, one(i), FullMatrix<double>(1, 1, &value), false);
      };
      const auto visit_row = [&](const Index         i,
                                 const SparseMatrix &from,
                                 const unsigned int  local,
                                 const auto          field,
                                 const double        factor,
                                 const bool          transposed) {
        const auto         row = from.row(local);
        ExpansionList      columns;
        FullMatrix<double> values(1, row.length, row.values);
        values *= factor;
        for (unsigned int k = 0; k < row.length; ++k)
          {
            columns.add(numbering(field, from.global_column(row.columns[k])),
                        1.);
            columns.close();
          }
        visit(i, columns, values, transposed);
      };
      for (unsigned int g = 0; g < system.free_pressures.size(); ++g)
        if (const int pinned = system.free_pressures.pinned(g); pinned >= 0)
          visit_diagonal(
            numbering(Numbering::pressure,
                      system.owned_pressure.nth_index_in_set(pinned)),
            -1. / residual.inverse_diagonal_p().local_element(pinned));
      for (unsigned int local = 0; local < B.n_rows(); ++local)
        {
          const Index k = numbering(Numbering::multiplier, B.global_row(local));
          const bool  is_active = !system.active || (*system.active)[local];
          visit_diagonal(
            k,
            is_active ?
              0. :
              -1. / residual.inverse_diagonal_lambda().local_element(local));
          if (!is_active)
            continue;
          visit_row(k, B, local, Numbering::displacement, 1., false);
          visit_row(k, forces, local, Numbering::displacement, 1., true);
          if (system.has_springs())
            visit_row(
              k, system.compliance(), local, Numbering::multiplier, -1., false);
        }
    }
  } // namespace

  SparseMatrix
  monolithic_matrix(const BlockSystem         &system,
                    const ScaledResidual      &residual,
                    const MonolithicNumbering &numbering)
  {
    const BulkSystem  &bulk = *system.bulk;
    const bool         tied = system.owned_multiplier.size() > 0;
    const SparseMatrix B =
      tied ? system.directed_constraint().expanded() : SparseMatrix();
    const SparseMatrix other_forces = system.has_symmetric_coupling() ?
                                        SparseMatrix() :
                                        system.directed_forces().expanded();
    CellIndices        cells(bulk, numbering);
    const AffineConstraints<double> constraints =
      monolithic_constraints(bulk, numbering, relevant_rows(cells, numbering));

    // visit(row expansion, column expansion, block, transposed)
    const auto for_each_row = [&](const auto &visit) {
      for_each_constraint_row(system,
                              residual,
                              numbering,
                              B,
                              system.has_symmetric_coupling() ? B :
                                                                other_forces,
                              [&](const Index               i,
                                  const ExpansionList      &columns,
                                  const FullMatrix<double> &values,
                                  const bool                transposed) {
                                if (transposed)
                                  visit(columns, one(i), values, true);
                                else
                                  visit(one(i), columns, values, false);
                              });
      for_each_row_of_interfaces(bulk,
                                 numbering,
                                 [&](const Index               i,
                                     const ExpansionList      &columns,
                                     const FullMatrix<double> &values) {
                                   visit(one(i), columns, values, false);
                                 });
      // as the norm of residuals has it
      const double diagonal = 1.;
      for (const auto &line : constraints.get_lines())
        if (numbering.owned().is_element(line.index))
          visit(one(line.index),
                one(line.index),
                FullMatrix<double>(1, 1, &diagonal),
                false);
    };
    RowAssembler assembler(numbering.owned(), numbering.owned());
    const auto   record = [&](const ExpansionList &row,
                            const ExpansionList &column) {
      assembler.record(row(), row.size(), column(), column.size());
    };
    bulk.elasticity().for_each_cell([&](const auto &cell) {
      const ExpansionList of_cell = resolve(cells.of(cell), constraints);
      record(of_cell, of_cell);
    });
    for_each_row([&](const ExpansionList &row,
                     const ExpansionList &column,
                     const FullMatrix<double> &,
                     const bool) { record(row, column); });
    assembler.allocate();
    bulk.elasticity().for_each_cell_matrix(
      [](const auto &) { return true; },
      [&](const auto &cell, const auto &local) {
        const ExpansionList of_cell = resolve(cells.of(cell), constraints);
        assembler.add(of_cell(), of_cell(), local.mixed, 1., false);
      });
    for_each_row([&](const ExpansionList      &row,
                     const ExpansionList      &column,
                     const FullMatrix<double> &block,
                     const bool                transposed) {
      assembler.add(row(), column(), block, 1., transposed);
    });
    return assembler.create(system.communicator);
  }
} // namespace mortise
