// See thickness_coarsening.h.
#include <deal.II/lac/la_parallel_vector.h>

#include <mortise/body/spaces/flat_bodies.h>
#include <mortise/body/spaces/lines_across.h>
#include <mortise/body/spaces/thickness_coarsening.h>

#include <algorithm>
#include <numeric>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Index      = NodalSpace::Index;
    using NodeVector = LinearAlgebra::distributed::Vector<double>;

    /// Values of degree one at the nodes of bodies that are not flat, but for
    /// those that @p stay.
    void
    add_linear_rows(const NodalSpace                       &space,
                    const std::vector<bool>                &flat,
                    const NodeVector                       &stay,
                    std::vector<VertexCoarsening::Entries> &rows)
    {
      const auto &owned = space.owned_nodes();
      space.for_each_cell(
        [&](const Body &body, const auto &cell, const auto &nodes) {
          const unsigned int degree = space.degree(body, cell);
          if (flat[body.index] || degree == 1)
            return;
          const FullMatrix<double> values = linear_values(cell, degree);
          for (unsigned int i = cell->n_vertices(); i < nodes.size(); ++i)
            if (owned.is_element(nodes[i]))
              if (auto &row = rows[owned.index_within_set(nodes[i])];
                  row.empty() && stay(nodes[i]) == 0.)
                for (const unsigned int v : cell->vertex_indices())
                  if (values(i, v) > 1e-12)
                    row.emplace_back(nodes[v], values(i, v));
        });
    }

    /// 1 at those nodes, which are given on any rank; to be asked for those of
    /// owned cells.
    NodeVector
    marked(const std::vector<Index> &nodes,
           const NodalSpace         &space,
           const MPI_Comm            comm)
    {
      IndexSet relevant = space.relevant_nodes();
      relevant.add_indices(nodes.begin(), nodes.end());
      NodeVector result(space.owned_nodes(), relevant, comm);
      for (const Index node : nodes)
        result(node) = 1.;
      result.compress(VectorOperation::max);
      result.update_ghost_values();
      return result;
    }

    /// 1 at all nodes of cells that have more than one of those @p given, hence
    /// not only touch them with a vertex, of bodies that are not flat.
    NodeVector
    around(const std::vector<Index> &given,
           const NodalSpace         &space,
           const std::vector<bool>  &flat,
           const MPI_Comm            comm)
    {
      const NodeVector   is_given = marked(given, space, comm);
      std::vector<Index> result;
      space.for_each_cell(
        [&](const Body &body, const auto &, const auto &nodes) {
          const auto n_given =
            std::count_if(nodes.begin(), nodes.end(), [&](const Index node) {
              return is_given(node) != 0.;
            });
          if (n_given > 1 && !flat[body.index])
            result.insert(result.end(), nodes.begin(), nodes.end());
        });
      return marked(result, space, comm);
    }
  } // namespace

  bool
  coarsens_across_thickness(const std::vector<const Body *> &bodies)
  {
    const std::vector<bool> flat = find_flat_bodies(bodies);
    bool                    any = false, all = true;
    for (unsigned int i = 0; i < bodies.size(); ++i)
      {
        any = any || flat[i];
        all = all && (flat[i] || bodies[i]->max_degree() == 1 ||
                      !bodies[i]->triangulation().has_hanging_nodes());
      }
    return any && all;
  }

  ThicknessCoarsening
  make_thickness_coarsening(const NodalSpace         &nodes,
                            const std::vector<Index> &beside,
                            const MPI_Comm            comm)
  {
    ThicknessCoarsening result;
    result.flat = find_flat_bodies(nodes.bodies());
    auto rows   = find_rows_across(nodes, result.flat, comm, result.n_steps);
    add_linear_rows(nodes,
                    result.flat,
                    around(beside, nodes, result.flat, comm),
                    rows);
    std::vector<unsigned int> all(rows.size());
    std::iota(all.begin(), all.end(), 0);
    result.functions = coarsen_by(nodes, rows, all, comm);
    return result;
  }
} // namespace mortise
