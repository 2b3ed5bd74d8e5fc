// See thickness_matrix.h.
#include <deal.II/base/partitioner.h>

#include <mortise/operators/cells/linear_cell_matrices.h>
#include <mortise/operators/levels/level_functions.h>
#include <mortise/operators/levels/thickness_matrix.h>

#include <algorithm>
#include <map>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Index = types::global_dof_index;

    /// J of jumps in the functions of a coarsening, row by row.
    class CoarseJumps
    {
    public:
      CoarseJumps(const std::vector<ConstraintPenalty> &jumps,
                  const IndexSet                       &owned_nodes,
                  const VertexCoarsening               &coarsening,
                  BlockCsrMatrixBuilder                &builder,
                  const MPI_Comm                        comm)
        : jumps(jumps)
        , builder(builder)
        , begin_of_jump({0})
      {
        std::vector<Index> nodes;
        for (const ConstraintPenalty &jump : jumps)
          for (const auto &entry : jump.entries)
            nodes.push_back(entry.first);
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        IndexSet needed(owned_nodes.size());
        needed.add_indices(nodes.begin(), nodes.end());
        const Utilities::MPI::Partitioner layout(displacement_indices(
                                                   owned_nodes),
                                                 displacement_indices(needed),
                                                 comm);
        const InterpolationRows rows = interpolation_rows(layout, coarsening);
        const std::vector<unsigned int>      begin = rows.begin();
        std::map<unsigned int, double>       sum; // by number in the builder
        std::map<unsigned int, unsigned int> index_of_number;
        for (const ConstraintPenalty &jump : jumps)
          {
            sum.clear();
            for (const auto &[node, value] : jump.entries)
              {
                const unsigned int i = layout.global_to_local(dim * node) / dim;
                for (unsigned int e = begin[i]; e < begin[i + 1]; ++e)
                  sum[builder.local_number(rows.nodes[e])] +=
                    value * rows.weights[e];
              }
            for (const auto &[node, value] : sum)
              {
                const auto [found, is_new] =
                  index_of_number.emplace(node, numbers_of_nodes.size());
                if (is_new)
                  {
                    numbers_of_nodes.push_back(node);
                    jumps_of_node.emplace_back();
                  }
                jumps_of_node[found->second].emplace_back(begin_of_jump.size() -
                                                            1,
                                                          value);
                entries.emplace_back(found->second, value);
              }
            begin_of_jump.push_back(entries.size());
          }
      }

      void
      couple() const
      {
        std::vector<unsigned int> place, columns, numbers;
        for (unsigned int i = 0; i < numbers_of_nodes.size(); ++i)
          {
            find_columns(i, place, columns);
            numbers.clear();
            for (const unsigned int column : columns)
              numbers.push_back(numbers_of_nodes[column]);
            builder.couple({numbers_of_nodes[i]}, numbers);
          }
      }

      void
      add() const
      {
        std::vector<unsigned int>   place, columns;
        std::vector<Tensor<2, dim>> sums;
        for (unsigned int i = 0; i < numbers_of_nodes.size(); ++i)
          {
            find_columns(i, place, columns);
            sums.assign(columns.size(), Tensor<2, dim>());
            for (const auto &[j, own] : jumps_of_node[i])
              {
                const Tensor<2, dim> stiffness = own * jumps[j].stiffness;
                for (unsigned int e = begin_of_jump[j];
                     e < begin_of_jump[j + 1];
                     ++e)
                  sums[place[entries[e].first]] +=
                    entries[e].second * stiffness;
              }
            for (unsigned int k = 0; k < columns.size(); ++k)
              {
                double *block = builder.block(numbers_of_nodes[i],
                                              numbers_of_nodes[columns[k]]);
                for (unsigned int c = 0; c < dim; ++c)
                  for (unsigned int r = 0; r < dim; ++r)
                    block[dim * c + r] += sums[k][r][c];
              }
          }
      }

    private:
      /// The nodes that share a jump with node @p i; @p place: of each among them.
      void
      find_columns(const unsigned int         i,
                   std::vector<unsigned int> &place,
                   std::vector<unsigned int> &columns) const
      {
        place.resize(numbers_of_nodes.size(), numbers::invalid_unsigned_int);
        for (const unsigned int column : columns)
          place[column] = numbers::invalid_unsigned_int;
        columns.clear();
        for (const auto &of_node : jumps_of_node[i])
          for (unsigned int e = begin_of_jump[of_node.first];
               e < begin_of_jump[of_node.first + 1];
               ++e)
            if (unsigned int &at = place[entries[e].first];
                at == numbers::invalid_unsigned_int)
              {
                at = columns.size();
                columns.push_back(entries[e].first);
              }
      }

      const std::vector<ConstraintPenalty>        &jumps;
      BlockCsrMatrixBuilder                       &builder;
      std::vector<unsigned int>                    begin_of_jump;
      std::vector<std::pair<unsigned int, double>> entries; ///< node, value
      std::vector<unsigned int> numbers_of_nodes;           ///< in the builder
      /// (Jump, value) by node.
      std::vector<std::vector<std::pair<unsigned int, double>>> jumps_of_node;
    };

    /// In cells that have no more functions than vertices these are of degree
    /// one.
    bool
    is_linear(const LevelFunctions::Masters &masters, const bool tetrahedron)
    {
      return masters.nodes.size() <= (tetrahedron ? 4 : 8);
    }

    /// Of the cells that are not linear.
    void
    add_projected(const MultigridLevel               &level,
                  const MatrixFreeElasticity<double> &elasticity,
                  LevelFunctions                     &functions,
                  BlockCsrMatrixBuilder              &builder)
    {
      const auto find_masters = [&](const auto &cell) {
        std::vector<Index> nodes;
        for (unsigned int i = 0; i < cell.displacements.size(); i += dim)
          nodes.push_back(level.layout->local_to_global(cell.displacements[i]) /
                          dim);
        return functions.find_masters(nodes);
      };
      elasticity.for_each_projected_matrix(
        [&](const auto &cell) {
          const auto masters = find_masters(cell);
          return is_linear(masters, cell.batches.tetrahedra) ?
                   MatrixFreeElasticity<double>::CellFunctions() :
                   LevelFunctions::columns(masters);
        },
        [&](const auto &cell, const auto &matrix) {
          functions.add_projected(matrix, find_masters(cell).nodes, builder);
        });
    }

    void
    add_linear(const MultigridLevel  &level,
               LevelFunctions        &functions,
               BlockCsrMatrixBuilder &builder)
    {
      LinearCellMatrices matrices(level.cell_moduli());
      level.space->for_each_cell([&](const Body               &body,
                                     const auto               &cell,
                                     const std::vector<Index> &nodes) {
        if (is_linear(functions.find_masters(nodes), body.mesh.tetrahedra))
          functions.add(matrices.of(body, cell),
                        functions.find_masters(
                          {nodes.begin(), nodes.begin() + cell->n_vertices()}),
                        builder);
      });
    }
  } // namespace

  VertexMatrix
  assemble_thickness_matrix(const MultigridLevel                 &level,
                            const MatrixFreeElasticity<double>   &elasticity,
                            const ThicknessCoarsening            &coarsening,
                            const std::vector<ConstraintPenalty> &jumps)
  {
    const VertexCoarsening &kept  = coarsening.functions;
    const NodalSpace       &space = *level.space;
    const IndexSet         &owned = space.owned_nodes();
    const MPI_Comm          comm  = level.layout->get_mpi_communicator();
    LevelFunctions          functions(level, level.layout, &kept);
    BlockCsrMatrixBuilder   builder(kept.owned, comm);
    const CoarseJumps       penalty(jumps, owned, kept, builder, comm);
    for (const Index node : kept.owned)
      builder.couple({builder.local_number(node)});
    VertexMatrix result;
    result.points.resize(owned.n_elements());
    result.bodies.resize(owned.n_elements());
    std::vector<unsigned int> numbers;
    space.for_each_cell(
      [&](const Body &body, const auto &cell, const auto &nodes) {
        numbers.clear();
        for (const Index node : functions.find_masters(nodes).nodes)
          numbers.push_back(builder.local_number(node));
        builder.couple(numbers);
        const auto positions =
          straight_positions(cell, space.degree(body, cell));
        for (unsigned int i = 0; i < nodes.size(); ++i)
          if (owned.is_element(nodes[i]))
            {
              const auto k     = owned.index_within_set(nodes[i]);
              result.points[k] = positions[i];
              result.bodies[k] = body.index;
            }
      });
    penalty.couple();
    builder.close();
    add_linear(level, functions, builder);
    add_projected(level, elasticity, functions, builder);
    penalty.add();
    IndexSet needed(kept.owned.size());
    needed.add_indices(kept.nodes.begin(), kept.nodes.end());
    result.blocks = builder.finish(needed);
    constrain(level.constrained, kept, result.blocks);
    result.keep(kept.kept);
    return result;
  }
} // namespace mortise
