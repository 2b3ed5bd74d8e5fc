#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>

#include <mortise/body/elements/fe_simplex_legendre.h>
#include <mortise/operators/cells/cell_kernel.h>
#include <mortise/operators/levels/vertex_matrix.h>
#include <mortise/operators/levels/vertex_transfer.h>

#include <algorithm>
#include <map>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Index = types::global_dof_index;

    /// Components in the order of the nodes.
    std::unique_ptr<FiniteElement<dim>>
    linear_element(const Body &body)
    {
      if (body.mesh.tetrahedra)
        return make_simplex_system(FE_SimplexLegendre(1), dim);
      return std::make_unique<FESystem<dim>>(FE_Q<dim>(1), dim);
    }

    /// The functions that a matrix is made for by what they are at the vertices
    /// of the level: at those that do not hang, of the same mesh or of a
    /// coarser one.
    class Functions
    {
    public:
      struct Entry
      {
        Index        node; ///< of the matrix
        double       weight;
        unsigned int constrained; ///< bits of components for which it is none
      };

      /// What the values of a cell follow from: at vertex i from the entries
      /// ends[i - 1], ..., of node nodes[index] each.
      struct Masters
      {
        std::vector<Index>        nodes;
        std::vector<Entry>        entries;
        std::vector<unsigned int> indices; ///< by entry
        std::vector<unsigned int> ends;    ///< by vertex

        /// The vertices are the nodes and nothing is constrained.
        bool plain = true;
      };

      Functions(const NodalLevel &level, const VertexCoarsening *coarsening)
        : level(level)
        , constrained((level.layout->locally_owned_size() +
                       level.layout->n_ghost_indices()) /
                      dim)
      {
        LevelVector<double> is_constrained(level.layout);
        for (const unsigned int index : level.constrained)
          is_constrained.local_element(index) = 1.;
        is_constrained.update_ghost_values();
        for (unsigned int i = 0; i < dim * constrained.size(); ++i)
          if (is_constrained.local_element(i) != 0.)
            constrained[i / dim] |= 1U << i % dim;
        if (coarsening == nullptr)
          return;
        rows  = interpolation_rows(*level.layout, *coarsening);
        begin = {0};
        for (const unsigned int length : rows.lengths)
          begin.push_back(begin.back() + length);
      }

      /// Adds to @p entries the value at a local node that does not hang.
      void
      expand(const unsigned int  index,
             const double        weight,
             std::vector<Entry> &entries) const
      {
        if (begin.empty())
          entries.push_back({level.layout->local_to_global(dim * index) / dim,
                             weight,
                             constrained[index]});
        else
          for (unsigned int e = begin[index]; e < begin[index + 1]; ++e)
            entries.push_back(
              {rows.nodes[e], weight * rows.weights[e], constrained[index]});
      }

      Masters
      find_masters(const std::vector<Index> &vertices) const
      {
        Masters result;
        auto   &entries = result.entries;
        for (const Index vertex : vertices)
          {
            if (const auto *line =
                  level.space->hanging_nodes().get_constraint_entries(vertex))
              for (const auto &[node, weight] : *line)
                expand(local(node), weight, entries);
            else
              expand(local(vertex), 1., entries);
            result.ends.push_back(entries.size());
            result.plain = result.plain && begin.empty() &&
                           entries.size() == result.ends.size() &&
                           entries.back().node == vertex &&
                           entries.back().constrained == 0;
          }
        auto &nodes = result.nodes;
        if (result.plain)
          {
            nodes = vertices;
            return result;
          }
        for (const Entry &entry : entries)
          nodes.push_back(entry.node);
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        for (const Entry &entry : entries)
          result.indices.push_back(
            std::lower_bound(nodes.begin(), nodes.end(), entry.node) -
            nodes.begin());
        return result;
      }

    private:
      unsigned int
      local(const Index node) const
      {
        return level.layout->global_to_local(dim * node) / dim;
      }

      const NodalLevel &level;
      std::vector<unsigned int>
                        constrained; ///< by local node, bits of components
      InterpolationRows rows;        ///< of the coarser mesh
      std::vector<unsigned int> begin;
    };

    /// W^T A W with the weights of @p masters; @p half is workspace.
    void
    resolve(const Functions::Masters &masters,
            const FullMatrix<double> &matrix,
            FullMatrix<double>       &half,
            FullMatrix<double>       &result)
    {
      const unsigned int n = matrix.n(), m = dim * masters.nodes.size();
      half.reinit(m, n);
      result.reinit(m, m);
      const auto for_each = [&](const auto &visit) {
        unsigned int e = 0;
        for (unsigned int i = 0; i < masters.ends.size(); ++i)
          for (; e < masters.ends[i]; ++e)
            for (unsigned int c = 0; c < dim; ++c)
              if ((masters.entries[e].constrained >> c & 1U) == 0)
                visit(dim * i + c,
                      dim * masters.indices[e] + c,
                      masters.entries[e].weight);
      };
      for_each([&](const unsigned int i, const unsigned int j, const double w) {
        const double *from = &matrix(i, 0);
        double       *to   = &half(j, 0);
        for (unsigned int k = 0; k < n; ++k)
          to[k] += w * from[k];
      });
      for (unsigned int r = 0; r < m; ++r)
        {
          const double *from = &half(r, 0);
          double       *to   = &result(r, 0);
          for_each([&](const unsigned int i,
                       const unsigned int j,
                       const double       w) { to[j] += w * from[i]; });
        }
    }

    void
    couple_all(const NodalLevel        &level,
               const Functions         &functions,
               const IndexSet          &owned,
               NodalBlockMatrixBuilder &builder)
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
        std::vector<Functions::Entry> entries;
        for (const unsigned int index : of_group)
          functions.expand(index / dim, 1., entries);
        std::vector<unsigned int> result;
        for (const auto &entry : entries)
          result.push_back(builder.local_number(entry.node));
        std::sort(result.begin(), result.end());
        result.erase(std::unique(result.begin(), result.end()), result.end());
        return result;
      };
      for (const NodalPenalty &penalty : level.penalties)
        for (const auto &group : penalty.groups)
          if (const auto rows = find(group.rows), columns = find(group.columns);
              !rows.empty() && !columns.empty())
            builder.couple(rows, columns);
      builder.close();
    }

    void
    add_cells(const NodalLevel        &level,
              const Functions         &functions,
              NodalBlockMatrixBuilder &builder,
              VertexMatrix            &result)
    {
      std::map<unsigned int, std::unique_ptr<CellKernel>> kernels; // by body
      FullMatrix<double>                                  local, half, resolved;
      std::vector<unsigned int>                           indices;
      const auto &owned = level.space->owned_nodes();
      level.space->for_each_cell([&](const Body               &body,
                                     const auto               &cell,
                                     const std::vector<Index> &vertices) {
        auto &kernel = kernels[body.index];
        if (!kernel)
          kernel = std::make_unique<CellKernel>(body, *linear_element(body));
        local.reinit(dim * vertices.size(), dim * vertices.size());
        kernel->compute(cell, local);
        const auto masters = functions.find_masters(vertices);
        if (!masters.plain)
          resolve(masters, local, half, resolved);
        const FullMatrix<double> &matrix = masters.plain ? local : resolved;
        indices.clear();
        for (const Index node : masters.nodes)
          indices.push_back(builder.local_number(node));
        for (unsigned int i = 0; i < indices.size(); ++i)
          for (unsigned int j = 0; j < indices.size(); ++j)
            {
              double *block = builder.block(indices[i], indices[j]);
              for (unsigned int c = 0; c < dim; ++c)
                for (unsigned int r = 0; r < dim; ++r)
                  block[dim * c + r] += matrix(dim * i + r, dim * j + c);
            }
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
      PenaltyEntry(const NodalPenalty      &penalty,
                   const Functions         &functions,
                   NodalBlockMatrixBuilder &builder)
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
      const NodalPenalty           &penalty;
      const Functions              &functions;
      NodalBlockMatrixBuilder      &builder;
      std::vector<Functions::Entry> rows, columns;
    };

    void
    add_penalties(const NodalLevel        &level,
                  const Functions         &functions,
                  NodalBlockMatrixBuilder &builder)
    {
      for (const NodalPenalty &penalty : level.penalties)
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

  void
  VertexMatrix::keep(const std::vector<unsigned int> &kept)
  {
    for (unsigned int i = 0; i < kept.size(); ++i) // in ascending order
      {
        points[i] = points[kept[i]];
        bodies[i] = bodies[kept[i]];
      }
    points.resize(kept.size());
    bodies.resize(kept.size());
  }

  VertexMatrix
  assemble_vertex_matrix(const NodalLevel       &level,
                         const VertexCoarsening *coarsening)
  {
    const IndexSet &owned =
      coarsening ? coarsening->owned : level.space->owned_nodes();
    const Functions         functions(level, coarsening);
    NodalBlockMatrixBuilder builder(owned,
                                    level.layout->get_mpi_communicator());
    couple_all(level, functions, owned, builder);
    VertexMatrix result;
    result.points.resize(level.space->owned_nodes().n_elements());
    result.bodies.resize(result.points.size());
    add_cells(level, functions, builder, result);
    add_penalties(level, functions, builder);
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
