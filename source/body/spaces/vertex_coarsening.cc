// See vertex_coarsening.h.
#include <deal.II/base/mpi.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <mortise/body/spaces/lattice_nodes.h>
#include <mortise/body/spaces/refined_corners.h>
#include <mortise/body/spaces/vertex_coarsening.h>

#include <algorithm>
#include <numeric>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Index   = NodalSpace::Index;
    using Entries = VertexCoarsening::Entries;

    /// Calls @p visit(child, vertex of it, corners of @p cell around that vertex)
    /// for the vertices of the children that are in the middle of an edge, a
    /// face or the cell.
    template <typename Cell, typename Visit>
    void
    for_each_middle(const Cell &cell, const Visit &visit)
    {
      std::vector<unsigned int> corners;
      for (unsigned int child = 0; child < 8; ++child)
        for (unsigned int v = 0; v < 8; ++v)
          if (child != v)
            {
              corners.clear(); // of the lattice point child + v
              for (unsigned int c = 0; c < 8; ++c)
                if ((~(child ^ v) & (c ^ v)) == 0)
                  corners.push_back(c);
              visit(cell->child(child), v, corners);
            }
    }

    /// Of one body: its refinements, then its lattice.
    struct Lattice
    {
      Lattice(const NodalSpace &vertices, const Body &body, const MPI_Comm comm)
        : body(body)
        , n_refined(body.triangulation().n_global_levels() - 1)
        , coarsening(body.mesh.lattice, body.triangulation().get_vertices())
        , nodes(vertices, body, coarsening, comm)
      {}

      unsigned int
      n_steps() const
      {
        return n_refined + coarsening.n_steps();
      }

      const Body             &body;
      const unsigned int      n_refined;
      const LatticeCoarsening coarsening;
      const LatticeNodes      nodes;
    };

    /// Takes levels of cells back, one after the other.
    class Coarsener
    {
    public:
      Coarsener(const NodalSpace &vertices, const MPI_Comm comm)
        : vertices(vertices)
        , comm(comm)
        , corners(vertices, comm)
        , owned(vertices.owned_nodes())
        , rows(owned.n_elements())
      {
        for (const Body *body : vertices.bodies())
          {
            lattices.push_back(
              std::make_unique<Lattice>(vertices, *body, comm));
            n_steps = std::max(n_steps, lattices.back()->n_steps());
          }
        fine_nodes.resize(owned.n_elements());
        std::iota(fine_nodes.begin(), fine_nodes.end(), 0);
      }

      std::vector<VertexCoarsening>
      run()
      {
        std::vector<VertexCoarsening> result;
        for (unsigned int step = 0; step < n_steps; ++step)
          {
            for (const auto &lattice : lattices)
              if (step < lattice->n_refined)
                find_middles(lattice->body, lattice->n_refined - 1 - step);
              else if (step < lattice->n_steps())
                find_gone(*lattice, step - lattice->n_refined);
            result.push_back(coarsen_by(vertices, rows, fine_nodes, comm));
          }
        return result;
      }

    private:
      /// Entries of the vertices that go with the children of the cells on
      /// level @p level.
      void
      find_middles(const Body &body, const unsigned int level)
      {
        const auto &hanging = vertices.hanging_nodes();
        for (const auto &cell :
             body.triangulation().cell_iterators_on_level(level))
          if (cell->has_children() && corners.is_local(body, cell))
            for_each_middle(cell,
                            [&](const auto                      &child,
                                const unsigned int               v,
                                const std::vector<unsigned int> &around) {
                              const Index node = corners.node(body, child, v);
                              if (!owned.is_element(node) ||
                                  hanging.is_constrained(node))
                                return;
                              Entries &row = rows[owned.index_within_set(node)];
                              if (!row.empty()) // by another cell
                                return;
                              for (const unsigned int c : around)
                                corners.add(corners.node(body, cell, c),
                                            1. / around.size(),
                                            row);
                            });
      }

      /// The same on the lattice of a coarse mesh.
      void
      find_gone(const Lattice &lattice, const unsigned int step)
      {
        lattice.coarsening.for_each(
          step, [&](const unsigned int vertex, const auto &entries) {
            const Index node = lattice.nodes[vertex];
            if (node == numbers::invalid_dof_index || !owned.is_element(node))
              return;
            Entries &row = rows[owned.index_within_set(node)];
            if (row.empty())
              for (const auto &[from, weight] : entries)
                row.emplace_back(lattice.nodes[from], weight);
          });
      }

      const NodalSpace                     &vertices;
      const MPI_Comm                        comm;
      RefinedCorners                        corners;
      std::vector<std::unique_ptr<Lattice>> lattices; ///< of the bodies
      const IndexSet                       &owned;
      unsigned int                          n_steps = 0;
      std::vector<Entries>                  rows; ///< by owned node
      std::vector<unsigned int> fine_nodes; ///< owned ones of the finer mesh
    };
  } // namespace

  IndexSet
  next_range(const types::global_dof_index n_owned, const MPI_Comm comm)
  {
    Index first = 0;
    MPI_Exscan(&n_owned, &first, 1, DEAL_II_DOF_INDEX_MPI_TYPE, MPI_SUM, comm);
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      first = 0; // is left undefined there
    IndexSet range(Utilities::MPI::sum(n_owned, comm));
    range.add_range(first, first + n_owned);
    return range;
  }

  VertexCoarsening
  coarsen_by(const NodalSpace          &space,
             std::vector<Entries>      &rows,
             std::vector<unsigned int> &fine_nodes,
             const MPI_Comm             comm)
  {
    const IndexSet           &owned   = space.owned_nodes();
    const auto               &hanging = space.hanging_nodes();
    VertexCoarsening          result;
    std::vector<unsigned int> coarse_nodes;
    std::vector<Index>        of_others;
    for (unsigned int i = 0; i < fine_nodes.size(); ++i)
      {
        const Entries &row = rows[fine_nodes[i]];
        for (const auto &entry : row)
          if (!owned.is_element(entry.first))
            of_others.push_back(entry.first);
        if (row.empty() &&
            !hanging.is_constrained(owned.nth_index_in_set(fine_nodes[i])))
          {
            result.kept.push_back(i);
            coarse_nodes.push_back(fine_nodes[i]);
          }
      }
    result.owned = next_range(coarse_nodes.size(), comm);
    std::sort(of_others.begin(), of_others.end());
    IndexSet ghosts(owned.size());
    ghosts.add_indices(of_others.begin(),
                       std::unique(of_others.begin(), of_others.end()));
    // on the coarser mesh, of nodes of the finest one
    LinearAlgebra::distributed::Vector<double> number(owned, ghosts, comm);
    for (unsigned int k = 0; k < coarse_nodes.size(); ++k)
      number.local_element(coarse_nodes[k]) = result.owned.nth_index_in_set(k);
    number.update_ghost_values();

    const auto add = [&](const Index node, const double weight) {
      result.nodes.push_back(static_cast<Index>(number[node]));
      result.weights.push_back(weight);
    };
    for (const unsigned int node : fine_nodes)
      {
        result.begin.push_back(result.nodes.size());
        const Index index = owned.nth_index_in_set(node);
        if (!rows[node].empty())
          for (const auto &[from, weight] : rows[node])
            add(from, weight);
        else if (!hanging.is_constrained(index))
          add(index, 1.);
        rows[node] = Entries();
      }
    result.begin.push_back(result.nodes.size());
    fine_nodes = std::move(coarse_nodes);
    return result;
  }

  std::vector<VertexCoarsening>
  make_vertex_coarsenings(const NodalSpace &vertices, const MPI_Comm comm)
  {
    return Coarsener(vertices, comm).run();
  }
} // namespace mortise
