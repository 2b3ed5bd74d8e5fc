#include <deal.II/base/mpi.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <mortise/mortar/coupling.h>
#include <mortise/mortar/row_assembler.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "constraint_columns.h"

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Index = types::global_dof_index;

    /// The rows of component @p c: those along the normal times its part of that;
    /// or only those whose entries no earlier component has, too.
    class ConstraintRows
    {
    public:
      ConstraintRows(const MultiplierSpace::FaceRows &rows,
                     const bool                       representatives)
      {
        const unsigned int n = rows.n_nodes();
        // by component and node
        std::vector<std::map<Index, double>> weights(dim * n);
        for (unsigned int r = 0; r + 1 < rows.begin.size(); ++r)
          rows.for_each_direction(
            r, [&](const unsigned int k, const Tensor<1, dim> &direction) {
              for (unsigned int e = rows.begin[r]; e < rows.begin[r + 1]; ++e)
                if (!representatives || !rows.is_represented[e])
                  for (unsigned int c = 0; c < dim; ++c)
                    if (direction[c] != 0.)
                      weights[c * n + k][rows.index[e]] +=
                        rows.weight[e] * direction[c];
            });
        for (unsigned int c = 0; c < dim; ++c)
          {
            Part &part = parts[c];
            part.begin = {0};
            for (unsigned int k = 0; k < n; ++k)
              {
                for (const auto &[index, weight] : weights[c * n + k])
                  {
                    part.index.push_back(index);
                    part.weight.push_back(weight);
                  }
                part.begin.push_back(part.index.size());
              }
          }
      }

      bool
      has_component(const unsigned int c) const
      {
        return !parts[c].index.empty();
      }

      Expansion
      component(const unsigned int c) const
      {
        return {parts[c].begin, parts[c].index, parts[c].weight, 0};
      }

    private:
      struct Part
      {
        std::vector<unsigned int> begin;
        std::vector<Index>        index;
        std::vector<double>       weight;
      };

      std::array<Part, dim> parts;
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
      std::vector<const std::vector<MultiplierSpace::FaceRows> *>;

    RowsByFace
    rows_of(const std::vector<Coupling> &couplings)
    {
      RowsByFace rows;
      for (const Coupling &coupling : couplings)
        rows.push_back(&coupling.multipliers->rows());
      return rows;
    }

    /// [D, -M] with the columns that @p Columns makes of a trace; by node once
    /// for the components that share their entries.
    template <typename Columns>
    void
    assemble_blocks(const std::vector<Coupling> &couplings,
                    const RowsByFace            &all_rows,
                    const CouplingPartition     &partition,
                    SparseMatrix                &matrix)
    {
      RowAssembler assembler(partition.owned_multiplier,
                             partition.owned_displacement);
      // Calls visit(row expansion, its size, column expansion, its size, block,
      // factor) for all blocks.
      const auto for_each_block = [&](const bool values, const auto &visit) {
        for_each_face(
          couplings, [&](const Coupling &coupling, const unsigned int s) {
            const ConstraintRows rows(
              (*all_rows[&coupling - couplings.data()])[s], Columns::by_node);
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
              const Columns            columns{side};
              const FullMatrix<double> in_columns =
                values ? columns.in_columns(block) : block;
              for_each_component([&](const unsigned int c) {
                visit(rows.component(c),
                      columns.component(c),
                      in_columns,
                      factor);
              });
            };
            if (local.is_dual() && Columns::by_node)
              {
                const Columns own{slave};
                for_each_entity(slave.basis(), [&](const auto &nodes) {
                  FullMatrix<double> block(nodes.size(), nodes.size());
                  for (unsigned int i = 0; i < nodes.size(); ++i)
                    block(i, i) = local.weights[nodes[i]];
                  for_each_component([&](const unsigned int c) {
                    const ExpansionPart row(rows.component(c), nodes),
                      column(own.component(c), nodes);
                    visit(row(), column(), block, 1.);
                  });
                });
              }
            else
              all(slave, local.constraint, 1.);
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
      assembler.create(matrix, partition.comm);
    }
  } // namespace

  void
  assemble_constraint(const std::vector<Coupling> &couplings,
                      const CouplingPartition     &partition,
                      SparseMatrix                &coupling)
  {
    assemble_blocks<HierarchicalColumns>(couplings,
                                         rows_of(couplings),
                                         partition,
                                         coupling);
  }

  namespace
  {
    IndexSet
    nodes_of(const IndexSet &displacements)
    {
      IndexSet nodes(displacements.size() / dim);
      if (displacements.n_elements() > 0)
        nodes.add_range(displacements.nth_index_in_set(0) / dim,
                        (displacements.nth_index_in_set(0) +
                         displacements.n_elements()) /
                          dim);
      return nodes;
    }

    using Frames = std::vector<std::tuple<Index, Index, double>>;

    void
    assemble_frames(const Frames   &all,
                    const IndexSet &owned_multiplier,
                    const IndexSet &owned_rows,
                    const MPI_Comm  comm,
                    SparseMatrix   &frames)
    {
      IndexSet relevant = owned_multiplier;
      for (const auto &[multiplier, row, weight] : all)
        relevant.add_index(multiplier);
      relevant.compress();
      DynamicSparsityPattern pattern(relevant.size(),
                                     owned_rows.size(),
                                     relevant);
      for (const auto &[multiplier, row, weight] : all)
        pattern.add(multiplier, row);
      frames.reinit(owned_multiplier, owned_rows, pattern, comm, true);
      for (const auto &[multiplier, row, weight] : all)
        frames.set(multiplier, row, weight);
      frames.compress(VectorOperation::insert);
    }
  } // namespace

  CouplingMatrix
  assemble_by_node(const std::vector<Coupling> &couplings,
                   const CouplingPartition     &partition,
                   const bool                   with_frames)
  {
    const IndexSet nodes = nodes_of(partition.owned_displacement);
    std::vector<CouplingMatrix::Row> rows;
    const auto                       add_rows =
      [&rows](const std::vector<CouplingMatrix::Row> &more) {
        rows.insert(rows.end(), more.begin(), more.end());
      };
    SparseMatrix entries, frames;
    if (!with_frames)
      {
        for (const Coupling &coupling : couplings)
          add_rows(coupling.multipliers->matrix_rows());
        assemble_blocks<NodalColumns>(couplings,
                                      rows_of(couplings),
                                      {nodes,
                                       partition.owned_multiplier,
                                       partition.comm},
                                      entries);
        return {std::move(entries), rows, std::move(frames)};
      }

    Index mine = 0;
    for (const Coupling &coupling : couplings)
      mine +=
        coupling.multipliers->n_component_rows(coupling.interface->slave());
    const auto counts = Utilities::MPI::all_gather(partition.comm, mine);
    const auto me     = Utilities::MPI::this_mpi_process(partition.comm);
    const auto first =
      std::accumulate(counts.begin(), counts.begin() + me, Index(0));
    IndexSet owned(std::accumulate(counts.begin(), counts.end(), Index(0)));
    owned.add_range(first, first + mine);

    std::vector<MultiplierSpace::ComponentRows> all;
    RowsByFace                                  by_face;
    Frames                                      all_frames;
    all.reserve(couplings.size());
    for (const Coupling &coupling : couplings)
      {
        all.push_back(
          coupling.multipliers->component_rows(coupling.interface->slave(),
                                               first + rows.size()));
        by_face.push_back(&all.back().rows.by_face);
        add_rows(all.back().rows.owned);
        all_frames.insert(all_frames.end(),
                          all.back().frames.begin(),
                          all.back().frames.end());
      }
    assemble_blocks<NodalColumns>(couplings,
                                  by_face,
                                  {nodes, owned, partition.comm},
                                  entries);
    assemble_frames(
      all_frames, partition.owned_multiplier, owned, partition.comm, frames);
    return {std::move(entries), rows, std::move(frames)};
  }
} // namespace mortise
