// One elastic body: triangulation, hp space of displacements, mapping,
// conformity constraints and material.
#pragma once

#include <deal.II/base/index_set.h>

#include <deal.II/dofs/dof_handler.h>

#include <deal.II/fe/mapping.h>

#include <deal.II/hp/fe_collection.h>

#include <deal.II/lac/affine_constraints.h>

#include <mortise/base/types.h>
#include <mortise/body/mesh/mesh_source.h>
#include <mortise/body/spaces/hp_constraints.h>
#include <mortise/body/spaces/pressure_space.h>
#include <mortise/material/material.h>

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace mortise
{
  class Body
  {
  public:
    using CellIterator = dealii::DoFHandler<dim>::active_cell_iterator;

    /// @p index is the position of the body in the scene.
    Body(const std::string &name, unsigned int index, const Material &material);

    /// Mesh of the body, spread over @p comm; the names are those of create_mesh(). Collective;
    /// throws InputError (@p where starts the message).
    void
    create_mesh(const MeshParameters        &parameters,
                MPI_Comm                     comm,
                const std::string           &where,
                const std::set<std::string> &interfaces = {});

    /// Spaces of degree @p degree, or of the degree that @p degree_by_region gives to the material id
    /// of a cell, or the last of @p degree_near that touches it; mapping of the largest degree on curved meshes, at least
    /// of @p least_mapping_degree, tetrahedra straight that would be tangled; conformity
    /// constraints; pressures if the material is mixed, which needs degrees
    /// above one. Replaces those of an earlier call. Collective; throws
    /// InputError for a region that the mesh does not have and for a ball that
    /// touches no cell.
    void
    create_space(
      unsigned int                                          degree,
      const std::map<dealii::types::material_id, unsigned> &degree_by_region,
      const std::string                                    &where,
      const std::vector<Ball>                              &degree_near = {},
      unsigned int least_mapping_degree                                 = 1);

    /// The same with degrees by active cell of the mesh, which are read for
    /// owned cells. Collective.
    void
    create_space(const std::vector<unsigned int> &degrees);

    const dealii::parallel::DistributedTriangulationBase<dim> &
    triangulation() const
    {
      return *mesh.triangulation;
    }

    /// Degree of the displacement on @p cell.
    unsigned int
    degree(const CellIterator &cell) const
    {
      return cell->get_fe().degree;
    }

    /// Boundary id of @p boundary; throws InputError listing the names that exist.
    dealii::types::boundary_id
    boundary_id(const std::string &boundary, const std::string &where) const;

    /// Number of cells, smallest and largest degree over all ranks. Collective.
    struct Statistics
    {
      dealii::types::global_cell_index cells      = 0;
      unsigned int                     degree_min = 0;
      unsigned int                     degree_max = 0;
    };
    Statistics
    statistics() const;

    /// Largest degree of the space.
    unsigned int
    max_degree() const
    {
      return fe[fe.size() - 1].degree;
    }

    const std::string  name;
    const unsigned int index;
    const Material     material;

    Mesh mesh; ///< first among what refers to it
    /// Systems of three FE_Legendre or FE_SimplexLegendre (two orders of
    /// vertices each), rising degree.
    dealii::hp::FECollection<dim> fe;
    dealii::DoFHandler<dim>       dof_handler;

    std::unique_ptr<dealii::Mapping<dim>> mapping;
    unsigned int                          mapping_degree = 1;
    unsigned int                          n_straightened = 0; ///< cells

    dealii::IndexSet
      relevant_dofs; ///< of owned and ghost cells, and their masters
    dealii::AffineConstraints<double>
      conformity; ///< hanging nodes and mixed degrees; left open
    std::unique_ptr<EntityDegrees>
      degrees; ///< of edges and faces, by the minimum rule

    /// Of a body in mixed form, else null.
    std::unique_ptr<PressureSpace> pressure;

  private:
    void
    create_space(
      const std::set<unsigned int>                            &used,
      const std::function<unsigned int(const CellIterator &)> &degree_of,
      unsigned int least_mapping_degree);
    void
    create_mapping(unsigned int least_degree);
  };
} // namespace mortise
