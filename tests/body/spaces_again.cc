// Proves that the spaces of a body may be made again with other degrees:
// nothing is left of the earlier ones, on hexahedra with hanging nodes and
// tetrahedra.
#include <deal.II/base/mpi.h>

#include <mortise/body/body.h>
#include <verdict.h>

#include <set>
#include <sstream>

using namespace mortise;

namespace
{
  MeshParameters
  shell(const std::string &cells)
  {
    MeshParameters mesh;
    mesh.source       = "shell octant";
    mesh.cells        = cells;
    mesh.extent       = {1., 2.};
    mesh.subdivisions = {2, 1};
    if (cells == "hexahedra")
      mesh.refine_near = "1, 0, 0, 0.5, 1";
    return mesh;
  }

  /// All that create_space() makes, as text.
  std::string
  describe(const Body &body)
  {
    std::ostringstream text;
    text << body.fe.size() << " elements, " << body.dof_handler.n_dofs()
         << " dofs, mapping " << body.mapping_degree << ", pressures "
         << (body.pressure ? body.pressure->dof_handler.n_dofs() : 0) << '\n';
    body.conformity.print(text);
    std::vector<dealii::types::global_dof_index> dofs;
    for (const auto &cell : body.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          dofs.resize(cell->get_fe().n_dofs_per_cell());
          cell->get_dof_indices(dofs);
          for (const auto dof : dofs)
            text << dof << ' ';
          text << body.mapping->transform_unit_to_real_cell(
                    cell, dealii::Point<3>(0.2, 0.3, 0.1))
               << '\n';
        }
    return text.str();
  }

  void
  check(const std::string &cells)
  {
    Body again("body", 0, LinearElastic{1., 0.5, true}),
      once("body", 0, LinearElastic{1., 0.5, true});
    for (Body *body : {&again, &once})
      body->create_mesh(shell(cells), MPI_COMM_WORLD, "");
    again.create_space(2, {}, "");
    const std::string first = describe(again);
    again.create_space(3, {{1, 4}}, "");
    once.create_space(3, {{1, 4}}, "");
    const bool same = describe(again) == describe(once);
    again.create_space(2, {}, "");
    verdict(same, cells + ": other degrees give the spaces of a new body");
    verdict(describe(again) == first,
            cells + ": the first degrees give the first spaces");
    // the second ball is inside the first one
    const Ball wide{{1., 0., 0.}, 0.9, 3}, narrow{{1., 0., 0.}, 0.2, 4};
    again.create_space(2, {{1, 5}}, "", {wide, narrow});
    bool                   good = true;
    std::set<unsigned int> found;
    for (const auto &cell : again.dof_handler.active_cell_iterators())
      {
        found.insert(again.degree(cell));
        good = good && again.degree(cell) == (narrow.touches(cell)     ? 4u :
                                              wide.touches(cell)       ? 3u :
                                              cell->material_id() == 1 ? 5u :
                                                                         2u);
      }
    verdict(good && found.size() > 2,
            cells + ": the last ball that touches a cell gives its degree");
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  check("hexahedra");
  check("tetrahedra");
}
