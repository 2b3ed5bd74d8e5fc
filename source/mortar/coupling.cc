#include <deal.II/base/mpi.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <mortise/mortar/coupling.h>
#include <mortise/mortar/nodal_block.h>
#include <mortise/mortar/row_assembler.h>

#include "coupled_faces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Index = types::global_dof_index;

    /// The columns of one side of the constraint: hierarchical functions, or
    /// nodal ones where the trace has nodes. Prescribed ones are among them
    /// where nodes hang.
    class ConstraintColumns
    {
    public:
      explicit ConstraintColumns(const FaceTrace &trace)
        : trace(trace)
        , begin(1)
      {
        if (trace.nodes.empty())
          return;
        const FaceNodes &face = trace.nodes[0];
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int k = 0; k < trace.n_functions(); ++k)
            {
              const unsigned int row = c * trace.n_functions() + k;
              if (face.hang())
                for (unsigned int e = face.begin[k]; e < face.begin[k + 1]; ++e)
                  add(face.nodes[face.column[e]], c, face.weight[e]);
              // what holds a mode holds the node in its place
              else if (trace.begin[row + 1] > trace.begin[row])
                add(face.nodes[k], c, 1.);
              begin.push_back(index.size());
            }
      }

      bool
      are_nodal() const
      {
        return !trace.nodes.empty();
      }

      Expansion
      component(const unsigned int c) const
      {
        if (trace.nodes.empty())
          return mortise::component(trace, c);
        return {begin, index, weight, c * trace.n_functions()};
      }

      /// @p local with its columns in these functions.
      FullMatrix<double>
      in_columns(const FullMatrix<double> &local) const
      {
        return trace.nodes.empty() ?
                 local :
                 nodal_block(local,
                             {trace.shape, trace.degree, 0},
                             {trace.shape, trace.degree, trace.degree});
      }

    private:
      void
      add(const Index node, const unsigned int c, const double factor)
      {
        index.push_back(dim * node + c);
        weight.push_back(factor);
      }

      const FaceTrace          &trace;
      std::vector<unsigned int> begin;
      std::vector<Index>        index;
      std::vector<double>       weight;
    };

    /// The rows of component @p c, those along the normal times its part of that.
    class ConstraintRows
    {
    public:
      ConstraintRows(const MultiplierSpace::FaceRows &rows)
        : rows(rows)
        , weight(dim)
      {
        for (unsigned int c = 0; c < dim && !rows.normals.empty(); ++c)
          for (unsigned int k = 0; k < rows.n_nodes(); ++k)
            for (unsigned int e = rows.begin[k]; e < rows.begin[k + 1]; ++e)
              weight[c].push_back(rows.weight[e] * rows.normals[k][c]);
      }

      Expansion
      component(const unsigned int c) const
      {
        if (rows.normals.empty())
          return {rows.begin, rows.index, rows.weight, c * rows.n_nodes()};
        return {rows.begin, rows.index, weight[c], 0};
      }

    private:
      const MultiplierSpace::FaceRows &rows;
      std::vector<std::vector<double>> weight; ///< by component
    };

    /// The prescribed displacements of one side.
    class PrescribedTrace
    {
    public:
      explicit PrescribedTrace(const FaceTrace &trace)
        : n_functions(trace.n_functions())
        , begin(1)
      {
        for (const Index dof : trace.prescribed)
          {
            if (dof != numbers::invalid_dof_index)
              index.push_back(dof);
            begin.push_back(index.size());
          }
        weight.assign(index.size(), 1.);
      }

      bool
      are_nodal() const
      {
        return false;
      }

      Expansion
      component(const unsigned int c) const
      {
        return {begin, index, weight, c * n_functions};
      }

      const FullMatrix<double> &
      in_columns(const FullMatrix<double> &local) const
      {
        return local;
      }

    private:
      unsigned int              n_functions;
      std::vector<unsigned int> begin;
      std::vector<Index>        index;
      std::vector<double>       weight;
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

    /// [D, -M] with the columns that @p Columns makes of a trace.
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
              (*all_rows[&coupling - couplings.data()])[s]);
            const LocalCoupling &local = coupling.local[s];
            const FaceTrace     &slave = coupling.interface->slave().traces[s];
            const Columns        own(slave);
            if (local.is_dual() && own.are_nodal())
              for_each_entity(slave.basis(), [&](const auto &nodes) {
                FullMatrix<double> block(nodes.size(), nodes.size());
                for (unsigned int i = 0; i < nodes.size(); ++i)
                  block(i, i) = local.weights[nodes[i]];
                for (unsigned int c = 0; c < dim; ++c)
                  {
                    const ExpansionPart row(rows.component(c), nodes),
                      column(own.component(c), nodes);
                    visit(row(), column(), block, 1.);
                  }
              });
            const auto all = [&](const FaceTrace          &side,
                                 const FullMatrix<double> &block,
                                 const double              factor) {
              const Columns            columns(side);
              const FullMatrix<double> in_columns =
                values ? columns.in_columns(block) : block;
              for (unsigned int c = 0; c < dim; ++c)
                visit(rows.component(c),
                      columns.component(c),
                      in_columns,
                      factor);
            };
            if (!(local.is_dual() && own.are_nodal()))
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
    assemble_blocks<ConstraintColumns>(couplings,
                                       rows_of(couplings),
                                       partition,
                                       coupling);
  }

  void
  assemble_components(const std::vector<Coupling> &couplings,
                      const CouplingPartition     &partition,
                      SparseMatrix                &components,
                      SparseMatrix                &frames)
  {
    std::vector<Index> sizes;
    for (const Coupling &coupling : couplings)
      sizes.push_back(
        coupling.multipliers->n_component_rows(coupling.interface->slave()));
    const Index mine = std::accumulate(sizes.begin(), sizes.end(), Index(0));
    const auto counts = Utilities::MPI::all_gather(partition.comm, mine);
    const auto me     = Utilities::MPI::this_mpi_process(partition.comm);
    const auto first =
      std::accumulate(counts.begin(), counts.begin() + me, Index(0));
    IndexSet owned(std::accumulate(counts.begin(), counts.end(), Index(0)));
    owned.add_range(first, first + mine);

    std::vector<MultiplierSpace::ComponentRows> rows;
    RowsByFace                                  rows_by_face;
    rows.reserve(couplings.size());
    auto next = first;
    for (const Coupling &coupling : couplings)
      {
        rows.push_back(
          coupling.multipliers->component_rows(coupling.interface->slave(),
                                               next));
        rows_by_face.push_back(&rows.back().rows);
        next += sizes[rows.size() - 1];
      }
    assemble_blocks<ConstraintColumns>(
      couplings,
      rows_by_face,
      {partition.owned_displacement, owned, partition.comm},
      components);

    IndexSet relevant = partition.owned_multiplier;
    for (const auto &of_coupling : rows)
      for (const auto &[row, column, weight] : of_coupling.frames)
        relevant.add_index(row);
    relevant.compress();
    DynamicSparsityPattern pattern(relevant.size(), owned.size(), relevant);
    for (const auto &of_coupling : rows)
      for (const auto &[row, column, weight] : of_coupling.frames)
        pattern.add(row, column);
    frames.reinit(
      partition.owned_multiplier, owned, pattern, partition.comm, true);
    for (const auto &of_coupling : rows)
      for (const auto &[row, column, weight] : of_coupling.frames)
        frames.set(row, column, weight);
    frames.compress(VectorOperation::insert);
  }

  void
  assemble_prescribed_columns(const std::vector<Coupling> &couplings,
                              const CouplingPartition     &partition,
                              SparseMatrix                &coupling)
  {
    assemble_blocks<PrescribedTrace>(couplings,
                                     rows_of(couplings),
                                     partition,
                                     coupling);
  }
} // namespace mortise
