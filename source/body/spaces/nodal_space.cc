#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>

#include <deal.II/dofs/dof_tools.h>

#include <mortise/base/sparse_matrix.h>
#include <mortise/body/elements/cell_face.h>
#include <mortise/body/elements/legendre_basis.h>
#include <mortise/body/elements/legendre_elements.h>
#include <mortise/body/spaces/nodal_conformity.h>
#include <mortise/body/spaces/nodal_space.h>
#include <mortise/body/spaces/thickness_coarsening.h>

#include <algorithm>
#include <map>
#include <set>

namespace mortise
{
  using namespace dealii;

  NodalSpace::NodalSpace(const std::vector<const Body *> &bodies,
                         const DegreeRule                &rule,
                         const MPI_Comm                   comm)
    : rule(rule)
    , lattices(bodies.size())
  {
    std::vector<const DoFHandler<dim> *> all(bodies.size());
    for (const Body *body : bodies)
      if (rule(*body, body->max_degree()) > 0)
        {
          distribute(*body);
          all[body->index] = &lattices[body->index]->handler;
          scene.push_back(body);
        }
    numbering = FieldNumbering(all, comm);
    relevant  = IndexSet(numbering.size());
    for (const Body *body : scene)
      {
        IndexSet active;
        DoFTools::extract_locally_active_dofs(*all[body->index], active);
        numbering.add_to(body->index, active, relevant);
      }
    find_hanging_nodes();
    relevant.compress();
  }

  void
  NodalSpace::distribute(const Body &body)
  {
    auto &lattice = lattices[body.index];
    lattice       = std::make_unique<Lattice>();
    lattice->handler.reinit(body.triangulation());
    std::set<unsigned int> used;
    for (unsigned int i = 0; i < body.fe.size(); ++i)
      used.insert(degree(body, body.fe[i].degree));
    const auto degree_of = [&](const Body::CellIterator &cell) {
      return degree(body,
                    Body::CellIterator(&body.triangulation(),
                                       cell->level(),
                                       cell->index(),
                                       &body.dof_handler));
    };
    hp::FECollection<dim> fe;
    distribute_legendre_dofs(used, degree_of, 1, fe, lattice->handler, true);
    lattice->degrees = std::make_unique<EntityDegrees>(lattice->handler);
  }

  void
  NodalSpace::find_hanging_nodes()
  {
    using Entries = std::vector<std::pair<Index, double>>;
    std::vector<std::pair<Index, Entries>> lines;
    std::vector<Index>                     masters;
    for (const Body *body : scene)
      if (const Lattice &lattice = *lattices[body->index];
          body->triangulation().has_hanging_nodes() ||
          !lattice.degrees->one_degree())
        {
          IndexSet active;
          DoFTools::extract_locally_active_dofs(lattice.handler, active);
          AffineConstraints<double> constraints;
          if (body->mesh.tetrahedra)
            make_simplex_nodal_constraints(lattice.handler,
                                           *lattice.degrees,
                                           constraints);
          else
            make_nodal_constraints(lattice.handler,
                                   *lattice.degrees,
                                   constraints);
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

  Body::CellIterator
  NodalSpace::lattice_cell(const unsigned int        body,
                           const Body::CellIterator &cell) const
  {
    const DoFHandler<dim> &handler = lattices[body]->handler;
    return {&handler.get_triangulation(),
            cell->level(),
            cell->index(),
            &handler};
  }

  void
  NodalSpace::get_nodes(const unsigned int        body,
                        const Body::CellIterator &cell,
                        std::vector<Index>       &nodes) const
  {
    const Lattice           &lattice = *lattices[body];
    const Body::CellIterator own     = lattice_cell(body, cell);
    if (own->reference_cell() == ReferenceCells::Hexahedron)
      mortise::get_nodes(own, *lattice.degrees, nodes);
    else
      {
        nodes.resize(own->get_fe().n_dofs_per_cell());
        own->get_dof_indices(nodes);
      }
    for (auto &node : nodes)
      node = numbering(body, node);
  }

  FaceNodes
  NodalSpace::face_nodes(const Body               &body,
                         const Body::CellIterator &cell,
                         const unsigned int        face_number) const
  {
    FaceNodes result;
    result.degree = degree(body, cell);
    std::vector<Index> nodes;
    get_nodes(body.index, cell, nodes);
    bool any = false;
    for (const unsigned int i :
         CellFace(lattice_cell(body.index, cell), face_number).indices)
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
    const auto degree_on = [](const unsigned int level) {
      return [level](const Body &body, unsigned int degree) {
        for (unsigned int l = 0; l < level; ++l)
          degree = lower_degree(body.mesh.tetrahedra, degree);
        return degree;
      };
    };
    NodalSpaces levels;
    bool        lowest = false;
    const bool  single = coarsens_across_thickness(bodies);
    for (unsigned int level = 0; !lowest; ++level)
      {
        const auto rule = degree_on(level);
        levels.push_back(std::make_unique<NodalSpace>(bodies, rule, comm));
        lowest = single ||
                 std::all_of(bodies.begin(), bodies.end(), [&](const Body *b) {
                   return rule(*b, b->max_degree()) == 1;
                 });
      }
    return levels;
  }

  std::unique_ptr<NodalSpace>
  make_nodal_pressures(const std::vector<const Body *> &bodies,
                       const MPI_Comm                   comm)
  {
    return std::make_unique<NodalSpace>(
      bodies,
      [](const Body &body, const unsigned int degree) {
        return body.pressure ? degree - 1 : 0;
      },
      comm);
  }

  IndexSet
  displacement_indices(const IndexSet &nodes)
  {
    return by_component(nodes, dim);
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
