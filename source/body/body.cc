#include <deal.II/base/mpi.h>

#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q.h>

#include <mortise/base/error.h>
#include <mortise/body/body.h>
#include <mortise/body/fe_legendre.h>

#include <set>

namespace mortise
{
  using namespace dealii;

  Body::Body(const std::string   &name,
             const unsigned int   index,
             const LinearElastic &material,
             const MPI_Comm       comm)
    : name(name)
    , index(index)
    , material(material)
    , triangulation(comm)
    , dof_handler(triangulation)
  {}

  void
  Body::create_mesh(const MeshParameters &parameters, const std::string &where)
  {
    names  = mortise::create_mesh(parameters, triangulation, where);
    curved = parameters.source != "box" && parameters.source != "file";
  }

  void
  Body::create_space(
    const unsigned int                            degree,
    const std::map<types::material_id, unsigned> &degree_by_region,
    const std::string                            &where)
  {
    for (const auto &region : degree_by_region)
      if (names.materials.count(region.first) == 0)
        {
          std::vector<std::string> existing;
          for (const auto &material_id : names.materials)
            existing.push_back(std::to_string(material_id.first));
          throw InputError(where + ": Degree by region names the material id " +
                           std::to_string(region.first) +
                           ", which the mesh does not have; it has " +
                           join_names(existing));
        }

    std::set<unsigned int> used = {degree};
    for (const auto &region : degree_by_region)
      used.insert(region.second);
    std::map<unsigned int, unsigned int> fe_index;
    for (const unsigned int p : used)
      {
        fe_index[p] = fe.size();
        fe.push_back(FESystem<dim>(FE_Legendre(p), dim));
      }

    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const auto region = degree_by_region.find(cell->material_id());
          cell->set_active_fe_index(
            fe_index[region == degree_by_region.end() ? degree :
                                                        region->second]);
        }
    dof_handler.distribute_dofs(fe);

    mapping_degree = curved ? *used.rbegin() : 1;
    mapping        = std::make_unique<MappingQCache<dim>>(mapping_degree);
    mapping->initialize(MappingQ<dim>(mapping_degree), triangulation);

    degrees = std::make_unique<EntityDegrees>(dof_handler);
    make_conformity_constraints(dof_handler, *degrees, conformity);
    relevant_dofs = conformity.get_local_lines();
  }

  types::boundary_id
  Body::boundary_id(const std::string &boundary, const std::string &where) const
  {
    const auto found = names.boundaries.find(boundary);
    if (found != names.boundaries.end())
      return found->second;
    std::vector<std::string> existing;
    for (const auto &entry : names.boundaries)
      existing.push_back(entry.first);
    throw InputError(where + ": body '" + name + "' has no boundary '" +
                     boundary + "'; it has: " + join_names(existing));
  }

  Body::Statistics
  Body::statistics() const
  {
    unsigned int lowest = max_degree + 1, highest = 0;
    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          lowest  = std::min(lowest, degree(cell));
          highest = std::max(highest, degree(cell));
        }
    const MPI_Comm comm = triangulation.get_communicator();
    return {triangulation.n_global_active_cells(),
            Utilities::MPI::min(lowest, comm),
            Utilities::MPI::max(highest, comm)};
  }
} // namespace mortise
