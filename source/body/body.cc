#include <deal.II/base/mpi.h>

#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/mapping_q.h>

#include <mortise/base/error.h>
#include <mortise/base/quotes.h>
#include <mortise/body/body.h>
#include <mortise/body/elements/conforming_nodes.h>
#include <mortise/body/elements/hexahedral_mapping.h>
#include <mortise/body/elements/legendre_elements.h>
#include <mortise/body/elements/simplex_mapping.h>
#include <mortise/body/elements/simplex_quadrature.h>

#include <algorithm>
#include <set>

namespace mortise
{
  using namespace dealii;

  Body::Body(const std::string &name,
             const unsigned int index,
             const Material    &material)
    : name(name)
    , index(index)
    , material(material)
  {}

  void
  Body::create_mesh(const MeshParameters        &parameters,
                    const MPI_Comm               comm,
                    const std::string           &where,
                    const std::set<std::string> &interfaces)
  {
    mesh = mortise::create_mesh(parameters, comm, where, interfaces);
    dof_handler.reinit(*mesh.triangulation);
  }

  void
  Body::create_space(
    const unsigned int                            degree,
    const std::map<types::material_id, unsigned> &degree_by_region,
    const std::string                            &where,
    const std::vector<Ball>                      &degree_near,
    const unsigned int                            least_mapping_degree)
  {
    for (const auto &region : degree_by_region)
      if (mesh.names.materials.count(region.first) == 0)
        {
          std::vector<std::string> existing;
          for (const auto &material_id : mesh.names.materials)
            existing.push_back(std::to_string(material_id.first));
          throw InputError(where + ": Degree by region names the material id " +
                           std::to_string(region.first) +
                           ", which the mesh does not have; it has " +
                           join_names(existing));
        }

    std::set<unsigned int> used = {degree};
    for (const auto &region : degree_by_region)
      used.insert(region.second);
    for (const Ball &ball : degree_near)
      {
        unsigned int touched = 0;
        for (const auto &cell : dof_handler.active_cell_iterators())
          touched = touched || (cell->is_locally_owned() && ball.touches(cell));
        if (Utilities::MPI::max(touched, triangulation().get_communicator()) ==
            0)
          fail_untouched(ball, where + ": Degree near");
        used.insert(ball.number);
      }
    const auto degree_of = [&](const CellIterator &cell) {
      const auto ball =
        std::find_if(degree_near.rbegin(),
                     degree_near.rend(),
                     [&](const Ball &b) { return b.touches(cell); });
      if (ball != degree_near.rend())
        return ball->number;
      const auto region = degree_by_region.find(cell->material_id());
      return region == degree_by_region.end() ? degree : region->second;
    };
    create_space(used, degree_of, least_mapping_degree);
  }

  void
  Body::create_space(const std::vector<unsigned int> &cell_degrees)
  {
    std::vector<unsigned int> is_used(mortise::max_degree + 1, 0);
    for (const auto &cell : triangulation().active_cell_iterators())
      if (cell->is_locally_owned())
        is_used[cell_degrees[cell->active_cell_index()]] = 1;
    Utilities::MPI::max(is_used, triangulation().get_communicator(), is_used);
    std::set<unsigned int> used;
    for (unsigned int p = 0; p < is_used.size(); ++p)
      if (is_used[p] > 0)
        used.insert(p);
    create_space(
      used,
      [&](const CellIterator &cell) {
        return cell_degrees[cell->active_cell_index()];
      },
      1);
  }

  void
  Body::create_space(
    const std::set<unsigned int>                            &used,
    const std::function<unsigned int(const CellIterator &)> &degree_of,
    const unsigned int least_mapping_degree)
  {
    distribute_legendre_dofs(used, degree_of, dim, fe, dof_handler);
    create_mapping(least_mapping_degree);

    degrees = std::make_unique<EntityDegrees>(dof_handler);
    make_conformity_constraints(dof_handler, *degrees, conformity);
    relevant_dofs = conformity.get_local_lines();
    if (material.mixed())
      pressure = std::make_unique<PressureSpace>(dof_handler);
  }

  namespace
  {
    /// Where integrals over tetrahedra of degree 1 to @p degree, also those of coarser levels, want positive Jacobians.
    std::vector<Point<dim>>
    points_of_integrals(const unsigned int degree)
    {
      std::vector<Point<dim>> result;
      for (unsigned int p = 1; p <= degree; ++p)
        for (const unsigned int exact : {2 * p, degree + p})
          {
            const auto points = simplex_quadrature<dim>(exact).get_points();
            result.insert(result.end(), points.begin(), points.end());
          }
      return result;
    }
  } // namespace

  void
  Body::create_mapping(const unsigned int least_degree)
  {
    n_straightened = 0;
    mapping_degree = mesh.curved ? std::max(least_degree, max_degree()) : 1;
    if (mesh.geometry != nullptr)
      mapping_degree = 2; // what the file has, whatever the displacement
    const auto points = [&](const auto &cell, const auto &unit) {
      return mesh.geometry->points(cell, unit);
    };
    if (mesh.tetrahedra && mesh.geometry != nullptr)
      {
        mapping = std::make_unique<SimplexMapping>(mapping_degree,
                                                   triangulation(),
                                                   points);
        return;
      }
    if (mesh.tetrahedra)
      {
        auto curved =
          std::make_unique<SimplexMapping>(mapping_degree, triangulation());
        if (mapping_degree > 1)
          n_straightened = curved->straighten_tangled_cells(
            triangulation(), points_of_integrals(mapping_degree));
        mapping = std::move(curved);
        return;
      }
    auto cache = std::make_unique<HexahedralMapping>(mapping_degree);
    if (mesh.geometry != nullptr)
      {
        const auto unit = FE_Q<dim>(mapping_degree).get_unit_support_points();
        cache->initialize(triangulation(),
                          [&](const auto &cell) { return points(cell, unit); });
      }
    else
      {
        cache->initialize(MappingQ<dim>(mapping_degree), triangulation());
        if (mesh.curved && triangulation().has_hanging_nodes())
          {
            // of an edge: beside the straight chord of a much larger cell a
            // smaller one would be squeezed
            constexpr double        largest = 0.5;
            const HexahedralMapping manifold(*cache);
            const ConformingNodes   conforming(manifold,
                                             mapping_degree,
                                             triangulation());
            if (mapping_degree == 1 && conforming.largest_shift() > largest)
              return create_mapping(2);
            cache->initialize(triangulation(), [&](const auto &cell) {
              return conforming.nodes(cell);
            });
          }
      }
    mapping = std::move(cache);
  }

  types::boundary_id
  Body::boundary_id(const std::string &boundary, const std::string &where) const
  {
    const auto found = mesh.names.boundaries.find(boundary);
    if (found != mesh.names.boundaries.end())
      return found->second;
    std::vector<std::string> existing;
    for (const auto &entry : mesh.names.boundaries)
      existing.push_back(entry.first);
    throw InputError(where + ": body " + in_quotes(name, '\'') +
                     " has no boundary " + in_quotes(boundary, '\'') +
                     "; it has: " + join_names(existing));
  }

  Body::Statistics
  Body::statistics() const
  {
    unsigned int lowest = mortise::max_degree + 1, highest = 0;
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          lowest  = std::min(lowest, degree(cell));
          highest = std::max(highest, degree(cell));
        }
    const MPI_Comm comm = triangulation().get_communicator();
    return {triangulation().n_global_active_cells(),
            Utilities::MPI::min(lowest, comm),
            Utilities::MPI::max(highest, comm)};
  }
} // namespace mortise
