#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <mortise/body/fe_simplex_legendre.h>
#include <mortise/operators/cell_kernel.h>
#include <mortise/operators/vertex_matrix.h>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Index = types::global_dof_index;

    /// Calls visit(body, cell, indices by [vertex][component]).
    template <typename Visit>
    void
    for_each_cell(const NodalLevel &level, const Visit &visit)
    {
      std::vector<Index> indices;
      level.space->for_each_cell([&](const Body               &body,
                                     const auto               &cell,
                                     const std::vector<Index> &nodes) {
        indices.clear();
        for (const auto node : nodes)
          for (unsigned int c = 0; c < dim; ++c)
            indices.push_back(dim * node + c);
        visit(body, cell, indices);
      });
    }

    /// What the values of a cell follow from where some hang: value i is
    /// sum_j weights(i, j) u(indices[j]).
    struct Masters
    {
      std::vector<Index> indices;
      FullMatrix<double> weights;
    };

    /// No indices where none hangs.
    Masters
    find_masters(const NodalLevel &level, const std::vector<Index> &all)
    {
      const auto        &hanging = level.space->hanging_nodes();
      std::vector<Index> nodes;
      bool               any = false;
      for (unsigned int i = 0; i < all.size(); i += dim)
        if (const auto *entries = hanging.get_constraint_entries(all[i] / dim))
          {
            any = true;
            for (const auto &entry : *entries)
              nodes.push_back(entry.first);
          }
        else
          nodes.push_back(all[i] / dim);
      Masters result;
      if (!any)
        return result;
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
      for (const Index node : nodes)
        for (unsigned int c = 0; c < dim; ++c)
          result.indices.push_back(dim * node + c);
      result.weights.reinit(all.size(), result.indices.size());
      for (unsigned int i = 0; i < all.size(); ++i)
        {
          const auto set = [&](const Index node, const double weight) {
            const auto place =
              std::lower_bound(nodes.begin(), nodes.end(), node) -
              nodes.begin();
            result.weights(i, dim * place + i % dim) = weight;
          };
          if (const auto *entries =
                hanging.get_constraint_entries(all[i] / dim))
            for (const auto &[node, weight] : *entries)
              set(node, weight);
          else
            set(all[i] / dim, 1.);
        }
      return result;
    }

    std::unique_ptr<FiniteElement<dim>>
    linear_element(const Body &body)
    {
      if (body.mesh.tetrahedra)
        return make_simplex_system(FE_SimplexLegendre(1), dim);
      return std::make_unique<FESystem<dim>>(FE_Q<dim>(1), dim);
    }

    /// Drops what is held, in rows and columns.
    class HeldIndices
    {
    public:
      explicit HeldIndices(const NodalLevel &level)
        : held(level.layout)
      {
        for (const unsigned int place : level.held)
          held.local_element(place) = 1.;
        held.update_ghost_values();
      }

      bool
      operator()(const unsigned int place) const
      {
        return held.local_element(place) != 0.;
      }

    private:
      LevelVector<double> held;
    };
  } // namespace

  void
  assemble_vertex_matrix(const NodalLevel &level, VertexMatrix &result)
  {
    const auto &layout = *level.layout;
    const auto &owned  = layout.locally_owned_range();
    IndexSet    local  = owned;
    local.add_indices(layout.ghost_indices());
    const HeldIndices held(level);
    const auto        is_held = [&](const Index index) {
      return held(layout.global_to_local(index));
    };

    DynamicSparsityPattern sparsity(owned.size(), owned.size(), local);
    const auto             keep_free = [&](std::vector<Index> &indices) {
      indices.erase(std::remove_if(indices.begin(), indices.end(), is_held),
                    indices.end());
    };
    for_each_cell(level,
                  [&](const Body &, const auto &, std::vector<Index> &all) {
                    for (const Index index : all)
                      if (is_held(index))
                        sparsity.add(index, index);
                    if (const Masters masters = find_masters(level, all);
                        !masters.indices.empty())
                      all = masters.indices;
                    keep_free(all);
                    std::sort(all.begin(), all.end());
                    for (const Index row : all)
                      sparsity.add_entries(row, all.begin(), all.end(), true);
                  });
    const auto for_each_penalty = [&](const auto &visit) {
      for (const auto &group : level.penalty.groups)
        for (unsigned int r = 0; r < group.rows.size(); ++r)
          for (unsigned int k = 0; k < group.columns.size(); ++k)
            for (unsigned int c = 0; c < dim; ++c)
              if (!held(group.rows[r] + c) && !held(group.columns[k] + c))
                visit(layout.local_to_global(group.rows[r] + c),
                      layout.local_to_global(group.columns[k] + c),
                      group.values[r * group.columns.size() + k]);
    };
    for_each_penalty([&](const Index row, const Index column, const double) {
      sparsity.add(row, column);
    });

    result.matrix.reinit(
      owned, owned, sparsity, layout.get_mpi_communicator(), true);
    std::map<unsigned int, std::unique_ptr<CellKernel>> kernels;
    FullMatrix<double>                                  local_matrix;
    std::vector<Point<dim>> points(owned.n_elements() / dim);
    std::vector<double>     values;
    std::vector<Index>      columns;
    const auto              add = [&](const std::vector<Index> &all,
                         const FullMatrix<double> &local) {
      for (unsigned int i = 0; i < all.size(); ++i)
        if (!is_held(all[i]))
          {
            columns.clear();
            values.clear();
            for (unsigned int j = 0; j < all.size(); ++j)
              if (!is_held(all[j]))
                {
                  columns.push_back(all[j]);
                  values.push_back(local(i, j));
                }
            result.matrix.add(
              all[i], columns.size(), columns.data(), values.data(), false);
          }
    };
    for_each_cell(
      level,
      [&](const Body &body, const auto &cell, const std::vector<Index> &all) {
        auto &kernel = kernels[body.index];
        if (!kernel)
          kernel = std::make_unique<CellKernel>(body, *linear_element(body));
        local_matrix.reinit(all.size(), all.size());
        kernel->compute(cell, local_matrix);
        for (unsigned int i = 0; i < all.size(); ++i)
          if (is_held(all[i]))
            result.matrix.add(all[i], all[i], local_matrix(i, i));
        if (const Masters masters = find_masters(level, all);
            masters.indices.empty())
          add(all, local_matrix);
        else
          {
            FullMatrix<double> resolved(masters.indices.size());
            resolved.triple_product(
              local_matrix, masters.weights, masters.weights, true, false);
            add(masters.indices, resolved);
          }
        for (const unsigned int v : cell->vertex_indices())
          if (layout.in_local_range(all[dim * v]))
            points[layout.global_to_local(all[dim * v]) / dim] =
              cell->vertex(v);
      });
    for_each_penalty(
      [&](const Index row, const Index column, const double value) {
        result.matrix.add(row, column, value);
      });
    result.matrix.compress(VectorOperation::add);
    result.points = std::move(points);
    for (const auto index : owned)
      result.rows.push_back(index);
  }
} // namespace mortise
