#include <mortise/mortar/coupling.h>
#include <mortise/mortar/row_assembler.h>

#include <map>
#include <utility>

#include "constraint_columns.h"

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Index = types::global_dof_index;

    /// The rows of component @p c whose entries no earlier component has, too:
    /// those along the normal times its part of that.
    class ConstraintRows
    {
    public:
      explicit ConstraintRows(const MultiplierSpace::FaceMultipliers &rows)
      {
        const unsigned int n = rows.n_nodes();
        // by component and node
        std::vector<std::map<Index, double>> weights(dim * n);
        for (unsigned int r = 0; r + 1 < rows.begin.size(); ++r)
          rows.for_each_direction(
            r, [&](const unsigned int k, const Tensor<1, dim> &direction) {
              for (unsigned int e = rows.begin[r]; e < rows.begin[r + 1]; ++e)
                if (!rows.is_represented[e])
                  for (unsigned int c = 0; c < dim; ++c)
                    if (direction[c] != 0.)
                      weights[c * n + k][rows.index[e]] +=
                        rows.weight[e] * direction[c];
            });
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int k = 0; k < n; ++k)
            {
              for (const auto &[index, weight] : weights[c * n + k])
                parts[c].add(index, weight);
              parts[c].close();
            }
      }

      bool
      has_component(const unsigned int c) const
      {
        return parts[c].has_terms();
      }

      Expansion
      component(const unsigned int c) const
      {
        return parts[c]();
      }

    private:
      std::array<ExpansionList, dim> parts;
    };

    /// Calls visit(nodes) for the vertices, the edges and the inside of a face.
    template <typename Visit>
    void
    for_each_entity(const TraceBasis &basis, const Visit &visit)
    {
      std::map<std::pair<unsigned int, unsigned int>, std::vector<unsigned int>>
        entities;
      for (unsigned int k = 0; k < basis.size(); ++k)
        entities[{basis.functions[k].dimension, basis.functions[k].entity}]
          .push_back(k);
      for (const auto &entity : entities)
        visit(entity.second);
    }
  } // namespace

  namespace
  {
    /// By coupling and slave face.
    using RowsByFace =
      std::vector<const std::vector<MultiplierSpace::FaceMultipliers> *>;

    RowsByFace
    rows_of(const std::vector<Coupling> &couplings)
    {
      RowsByFace rows;
      for (const Coupling &coupling : couplings)
        rows.push_back(&coupling.multipliers->rows());
      return rows;
    }

    /// [D, -M] by node, before masters are turned, once for the components that
    /// share their entries.
    /// @p across: see MultiplierSpace::ComponentRows, by coupling.
    SparseMatrix
    assemble_blocks(const std::vector<Coupling> &couplings,
                    const RowsByFace            &all_rows,
                    const CouplingPartition     &partition,
                    const RowsByFace            &across = {})
    {
      RowAssembler assembler(partition.owned_multiplier,
                             partition.owned_displacement);
      // Calls visit(row expansion, its size, column expansion, its size, block,
      // factor) for all blocks.
      const auto for_each_block = [&](const bool values, const auto &visit) {
        for_each_face(
          couplings, [&](const Coupling &coupling, const unsigned int s) {
            const unsigned int   number = &coupling - couplings.data();
            ConstraintRows       rows((*all_rows[number])[s]);
            const LocalCoupling &local = coupling.local[s];
            const FaceTrace     &slave = coupling.interface->slave().traces[s];
            const auto           for_each_component = [&](const auto &of) {
              for (unsigned int c = 0; c < dim; ++c)
                if (rows.has_component(c))
                  of(c);
            };
            const auto all = [&](const FaceTrace          &side,
                                 const FullMatrix<double> &block,
                                 const double              factor) {
              const NodalColumns       columns(side);
              const FullMatrix<double> in_columns =
                values ? columns.in_columns(block) : block;
              for_each_component([&](const unsigned int c) {
                visit(rows.component(c),
                      columns.component(),
                      in_columns,
                      factor);
              });
            };
            const auto all_directed = [&](const FaceTrace &side,
                                          const auto      &blocks,
                                          const double     factor) {
              const NodalColumns columns(side);
              for_each_component([&](const unsigned int c) {
                visit(rows.component(c),
                      columns.component(),
                      values ? columns.in_columns(blocks[c]) : blocks[c],
                      factor);
              });
            };
            if (local.is_directed())
              {
                all_directed(slave, local.directed, 1.);
                for (const auto &partner : local.partners)
                  all_directed(
                    coupling.interface->master_traces()[partner.master],
                    partner.directed,
                    -1.);
                if (across[number]->empty())
                  return;
                rows = ConstraintRows((*across[number])[s]);
              }
            if (local.is_dual())
              {
                const NodalColumns own(slave);
                for_each_entity(slave.basis(), [&](const auto &nodes) {
                  FullMatrix<double> block(nodes.size(), nodes.size());
                  for (unsigned int i = 0; i < nodes.size(); ++i)
                    block(i, i) = local.weights[nodes[i]];
                  for_each_component([&](const unsigned int c) {
                    const ExpansionList row(rows.component(c), nodes),
                      column(own.component(), nodes);
                    visit(row(), column(), block, 1.);
                  });
                });
              }
            else
              all(slave, local.constraint, 1.);
            if (coupling.is_turned)
              rows = ConstraintRows((*across[number])[s]);
            for (const auto &partner : local.partners)
              all(coupling.interface->master_traces()[partner.master],
                  partner.constraint,
                  -1.);
          });
      };
      for_each_block(false,
                     [&](const Expansion          &row,
                         const Expansion          &column,
                         const FullMatrix<double> &block,
                         const double) {
                       assembler.record(row, block.m(), column, block.n());
                     });
      assembler.allocate();
      for_each_block(true,
                     [&](const Expansion          &row,
                         const Expansion          &column,
                         const FullMatrix<double> &block,
                         const double              factor) {
                       assembler.add(row, column, block, factor, false);
                     });
      return assembler.create(partition.comm, dim);
    }
  } // namespace

  CouplingMatrix
  assemble_by_node(const std::vector<Coupling> &couplings,
                   const CouplingPartition     &partition,
                   const bool                   with_frames)
  {
    const IndexSet nodes = nodes_of(partition.owned_displacement, dim);
    std::vector<CouplingMatrix::Row> rows;
    const auto                       add_rows =
      [&rows](const std::vector<CouplingMatrix::Row> &more) {
        rows.insert(rows.end(), more.begin(), more.end());
      };
    if (!with_frames)
      {
        for (const Coupling &coupling : couplings)
          add_rows(coupling.multipliers->matrix_rows());
        return {
          assemble_blocks(couplings,
                          rows_of(couplings),
                          {nodes, partition.owned_multiplier, partition.comm}),
          rows,
          SparseMatrix()};
      }

    Index mine = 0;
    for (const Coupling &coupling : couplings)
      mine +=
        coupling.multipliers->n_component_rows(coupling.interface->slave());
    const IndexSet owned = owned_range(mine, partition.comm);
    const Index    first = mine > 0 ? owned.nth_index_in_set(0) : 0;

    std::vector<MultiplierSpace::ComponentRows> all;
    RowsByFace                                  by_face, across;
    std::vector<SparseMatrix::Entry>            frames;
    all.reserve(couplings.size());
    for (const Coupling &coupling : couplings)
      {
        all.push_back(
          coupling.multipliers->component_rows(coupling.interface->slave(),
                                               first + rows.size()));
        by_face.push_back(&all.back().rows.by_face);
        across.push_back(&all.back().across);
        add_rows(all.back().rows.owned);
        for (const auto &[multiplier, row, weight] : all.back().frames)
          frames.push_back({multiplier, row, weight});
      }
    return {assemble_blocks(
              couplings, by_face, {nodes, owned, partition.comm}, across),
            rows,
            SparseMatrix(partition.owned_multiplier,
                         owned,
                         partition.comm,
                         frames,
                         VectorOperation::insert)};
  }
} // namespace mortise
