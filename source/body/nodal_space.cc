#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/fe/fe_q.h>

#include <mortise/body/fe_legendre.h>
#include <mortise/body/legendre_basis.h>
#include <mortise/body/nodal_space.h>

#include <algorithm>
#include <map>

namespace mortise
{
  using namespace dealii;

  NodalSpace::NodalSpace(const std::vector<const Body *> &bodies,
                         const std::vector<unsigned int> &degrees,
                         const MPI_Comm                   comm)
    : degrees(degrees)
    , handlers(bodies.size())
  {
    std::vector<const DoFHandler<dim> *> all(bodies.size());
    for (const Body *body : bodies)
      if (const unsigned int degree = degrees[body->index])
        {
          auto &handler = handlers[body->index];
          handler = std::make_unique<DoFHandler<dim>>(body->triangulation());
          handler->distribute_dofs(FE_Q<dim>(degree));
          all[body->index] = handler.get();
          scene.push_back(body);
        }
    numbering = FieldNumbering(all, comm);
    relevant  = IndexSet(numbering.size());
    for (const Body *body : scene)
      {
        IndexSet active;
        DoFTools::extract_locally_active_dofs(*handlers[body->index], active);
        numbering.add_to(body->index, active, relevant);
      }
    find_hanging_nodes();
    relevant.compress();
  }

  void
  NodalSpace::find_hanging_nodes()
  {
    using Entries = std::vector<std::pair<Index, double>>;
    std::vector<std::pair<Index, Entries>> lines;
    std::vector<Index>                     masters;
    for (const Body *body : scene)
      if (body->triangulation().has_hanging_nodes())
        {
          const auto &handler = *handlers[body->index];
          IndexSet    active, local;
          DoFTools::extract_locally_active_dofs(handler, active);
          DoFTools::extract_locally_relevant_dofs(handler, local);
          AffineConstraints<double> constraints(local);
          DoFTools::make_hanging_node_constraints(handler, constraints);
          complete_constraints(handler, constraints);
          constraints.close();
          for (const auto &line : constraints.get_lines())
            if (active.is_element(line.index))
              {
                lines.push_back(
                  {numbering(body->index, line.index), line.entries});
                for (auto &entry : lines.back().second)
                  {
                    entry.first = numbering(body->index, entry.first);
                    masters.push_back(entry.first);
                  }
              }
        }
    std::sort(masters.begin(), masters.end());
    relevant.add_indices(masters.begin(),
                         std::unique(masters.begin(), masters.end()));
    if (lines.empty())
      return;
    hanging.reinit(relevant);
    for (const auto &[node, entries] : lines)
      {
        hanging.add_line(node);
        hanging.add_entries(node, entries);
      }
    hanging.close();
  }

  bool
  NodalSpace::represents(const std::vector<const Body *> &bodies)
  {
    for (const Body *body : bodies)
      {
        if (body->mesh.tetrahedra)
          return false;
        const auto statistics = body->statistics();
        if (statistics.degree_min != statistics.degree_max)
          return false;
      }
    return true;
  }

  void
  NodalSpace::get_nodes(const unsigned int        body,
                        const Body::CellIterator &cell,
                        std::vector<Index>       &nodes) const
  {
    const auto &handler = *handlers[body];
    nodes.resize(handler.get_fe().n_dofs_per_cell());
    DoFHandler<dim>::active_cell_iterator(&handler.get_triangulation(),
                                          cell->level(),
                                          cell->index(),
                                          &handler)
      ->get_dof_indices(nodes);
    for (auto &node : nodes)
      node = numbering(body, node);
  }

  FaceNodes
  NodalSpace::face_nodes(const unsigned int        body,
                         const Body::CellIterator &cell,
                         const unsigned int        face_number) const
  {
    FaceNodes result;
    result.degree = degrees[body];
    std::vector<Index> nodes;
    get_nodes(body, cell, nodes);
    bool any = false;
    for (const unsigned int i : face_dof_indices(result.degree, face_number))
      {
        result.nodes.push_back(nodes[i]);
        any = any || hanging.is_constrained(nodes[i]);
      }
    if (!any)
      return result;

    std::map<Index, unsigned int> place;
    const auto add = [&](const Index node, const double weight) {
      result.column.push_back(place.emplace(node, place.size()).first->second);
      result.weight.push_back(weight);
    };
    result.begin = {0};
    for (const Index node : result.nodes)
      {
        if (const auto *masters = hanging.get_constraint_entries(node))
          for (const auto &[master, weight] : *masters)
            add(master, weight);
        else
          add(node, 1.);
        result.begin.push_back(result.column.size());
      }
    result.nodes.resize(place.size());
    for (const auto &[node, column] : place)
      result.nodes[column] = node;
    return result;
  }

  NodalSpaces
  make_nodal_spaces(const std::vector<const Body *> &bodies,
                    const MPI_Comm                   comm)
  {
    std::vector<unsigned int> degrees;
    for (const Body *body : bodies)
      degrees.push_back(body->max_degree());
    NodalSpaces levels;
    levels.push_back(std::make_unique<NodalSpace>(bodies, degrees, comm));
    while (*std::max_element(degrees.begin(), degrees.end()) > 1)
      {
        for (unsigned int &degree : degrees)
          degree = std::max(1U, degree / 2);
        levels.push_back(std::make_unique<NodalSpace>(bodies, degrees, comm));
      }
    return levels;
  }

  std::unique_ptr<NodalSpace>
  make_nodal_pressures(const std::vector<const Body *> &bodies,
                       const MPI_Comm                   comm)
  {
    std::vector<unsigned int> degrees;
    for (const Body *body : bodies)
      degrees.push_back(body->pressure ? body->max_degree() - 1 : 0);
    return std::make_unique<NodalSpace>(bodies, degrees, comm);
  }

  IndexSet
  displacement_indices(const IndexSet &nodes)
  {
    IndexSet result(dim * nodes.size());
    for (auto interval = nodes.begin_intervals();
         interval != nodes.end_intervals();
         ++interval)
      result.add_range(dim * *interval->begin(), dim * (interval->last() + 1));
    result.compress();
    return result;
  }

  namespace
  {
    struct Tables
    {
      Tables()
        : to_nodes(max_degree + 1)
        , to_modes(max_degree + 1)
      {
        for (unsigned int p = 1; p <= max_degree; ++p)
          {
            const QGaussLobatto<1> points(p + 1);
            std::vector<double>    values(p + 1);
            to_nodes[p].reinit(p + 1, p + 1);
            for (unsigned int i = 0; i <= p; ++i)
              {
                const unsigned int l = lobatto_to_lexicographic(p, i);
                evaluate_lobatto(p, points.point(l)[0], values.data());
                for (unsigned int k = 0; k <= p; ++k)
                  // exactly so, that nothing leaks from one entity to another
                  to_nodes[p](i, k) = i < 2 ? (i == k) : values[k];
              }
            to_modes[p] = to_nodes[p];
            to_modes[p].gauss_jordan();
            for (const unsigned int i : {0U, 1U})
              for (unsigned int k = 0; k <= p; ++k)
                to_modes[p](i, k) = (i == k);
          }
      }

      std::vector<FullMatrix<double>> to_nodes, to_modes;
    };

    const Tables &
    tables()
    {
      static const Tables all;
      return all;
    }
  } // namespace

  const FullMatrix<double> &
  modes_to_nodes(const unsigned int degree)
  {
    return tables().to_nodes[degree];
  }

  const FullMatrix<double> &
  nodes_to_modes(const unsigned int degree)
  {
    return tables().to_modes[degree];
  }
} // namespace mortise
