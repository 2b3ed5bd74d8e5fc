#include <mortise/operators/cells/linear_cell_matrices.h>
#include <mortise/operators/levels/level_functions.h>
#include <mortise/operators/levels/vertex_matrix.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Index = types::global_dof_index;

    void
    couple_all(const MultigridLevel  &level,
               const LevelFunctions  &functions,
               const LevelFunctions  *of_penalties,
               const IndexSet        &owned,
               BlockCsrMatrixBuilder &builder)
    {
      for (const Index node : owned)
        builder.couple({builder.local_number(node)});
      std::vector<unsigned int> indices;
      level.space->for_each_cell(
        [&](const Body &, const auto &, const std::vector<Index> &vertices) {
          indices.clear();
          for (const Index node : functions.find_masters(vertices).nodes)
            indices.push_back(builder.local_number(node));
          builder.couple(indices);
        });
      const auto find = [&](const std::vector<unsigned int> &of_group) {
        std::vector<LevelFunctions::Entry> entries;
        for (const unsigned int index : of_group)
          of_penalties->expand(index / dim, 1., entries);
        std::vector<unsigned int> result;
        for (const auto &entry : entries)
          result.push_back(builder.local_number(entry.node));
        std::sort(result.begin(), result.end());
        result.erase(std::unique(result.begin(), result.end()), result.end());
        return result;
      };
      if (of_penalties != nullptr)
        for (const JumpPenalty &penalty : level.penalties->parts)
          for (const auto &group : penalty.groups)
            if (const auto rows = find(group.rows),
                columns         = find(group.columns);
                !rows.empty() && !columns.empty())
              builder.couple(rows, columns);
      builder.close();
    }

    void
    add_cells(const MultigridLevel  &level,
              LevelFunctions        &functions,
              BlockCsrMatrixBuilder &builder,
              VertexMatrix          &result)
    {
      LinearCellMatrices matrices(level.cell_moduli());
      const auto        &owned = level.space->owned_nodes();
      level.space->for_each_cell([&](const Body               &body,
                                     const auto               &cell,
                                     const std::vector<Index> &vertices) {
        functions.add(matrices.of(body, cell),
                      functions.find_masters(vertices),
                      builder);
        for (const unsigned int v : cell->vertex_indices())
          if (owned.is_element(vertices[v]))
            {
              const auto i     = owned.index_within_set(vertices[v]);
              result.points[i] = cell->vertex(v);
              result.bodies[i] = body.index;
            }
      });
    }

    /// Adds the entry of @p penalty between the nodes of two local indices.
    class PenaltyEntry
    {
    public:
      PenaltyEntry(const JumpPenalty     &penalty,
                   const LevelFunctions  &functions,
                   BlockCsrMatrixBuilder &builder)
        : penalty(penalty)
        , functions(functions)
        , builder(builder)
      {}

      void
      add(const unsigned int i, const unsigned int j, const double value)
      {
        rows.clear();
        columns.clear();
        functions.expand(i / dim, 1., rows);
        functions.expand(j / dim, value, columns);
        Tensor<2, dim> directions = unit_symmetric_tensor<dim>();
        if (!penalty.normals.empty())
          directions =
            outer_product(penalty.normals[i / dim], penalty.normals[j / dim]);
        for (const auto &row : rows)
          for (const auto &column : columns)
            {
              double *block = builder.block(builder.local_number(row.node),
                                            builder.local_number(column.node));
              for (unsigned int c = 0; c < dim; ++c)
                for (unsigned int r = 0; r < dim; ++r)
                  if ((row.constrained >> r & 1U) == 0 &&
                      (column.constrained >> c & 1U) == 0)
                    block[dim * c + r] +=
                      row.weight * column.weight * directions[r][c];
            }
      }

    private:
      const JumpPenalty                 &penalty;
      const LevelFunctions              &functions;
      BlockCsrMatrixBuilder             &builder;
      std::vector<LevelFunctions::Entry> rows, columns;
    };

    void
    add_penalties(const MultigridLevel  &level,
                  const LevelFunctions  &functions,
                  BlockCsrMatrixBuilder &builder)
    {
      for (const JumpPenalty &penalty : level.penalties->parts)
        {
          PenaltyEntry entry(penalty, functions, builder);
          for (const auto &group : penalty.groups)
            for (unsigned int r = 0; r < group.rows.size(); ++r)
              for (unsigned int k = 0; k < group.columns.size(); ++k)
                entry.add(group.rows[r],
                          group.columns[k],
                          group.values[r * group.columns.size() + k]);
        }
    }
  } // namespace

  VertexMatrix
  assemble_vertex_matrix(const MultigridLevel   &level,
                         const VertexCoarsening *coarsening)
  {
    const IndexSet &owned =
      coarsening ? coarsening->owned : level.space->owned_nodes();
    LevelFunctions                  functions(level, level.layout, coarsening);
    std::unique_ptr<LevelFunctions> of_penalties;
    if (level.penalties)
      of_penalties = std::make_unique<LevelFunctions>(level,
                                                      level.penalties->layout,
                                                      coarsening);
    BlockCsrMatrixBuilder builder(owned, level.layout->get_mpi_communicator());
    couple_all(level, functions, of_penalties.get(), owned, builder);
    VertexMatrix result;
    result.points.resize(level.space->owned_nodes().n_elements());
    result.bodies.resize(result.points.size());
    add_cells(level, functions, builder, result);
    if (of_penalties)
      add_penalties(level, *of_penalties, builder);
    IndexSet needed(owned.size());
    if (coarsening != nullptr)
      needed.add_indices(coarsening->nodes.begin(), coarsening->nodes.end());
    result.blocks = builder.finish(needed);
    if (coarsening != nullptr)
      {
        constrain(level.constrained, *coarsening, result.blocks);
        result.keep(coarsening->kept);
      }
    return result;
  }
} // namespace mortise
