// Time of the assembly of one body of tetrahedra on one rank. Not a test: it
// serves assembly.py, which asks for one run at a time.
//
//   assembly DEGREE N M straight|curved MESH_FILE
//
// writes the mesh of the shell octant with N, M subdivisions
// to MESH_FILE (vertices, then cells), prints "cells dofs" and then,
// for each line read, "pattern matrix" in seconds.
#include <mortise/operators/scene_system.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>

using namespace mortise;

namespace
{
  void
  write_mesh(const Body &body, const std::string &file)
  {
    std::ofstream out(file);
    out.precision(17);
    const auto &triangulation = body.triangulation();
    out << triangulation.n_vertices() << ' ' << triangulation.n_active_cells()
        << '\n';
    for (const auto &vertex : triangulation.get_vertices())
      out << vertex << '\n';
    for (const auto &cell : triangulation.active_cell_iterators())
      {
        for (const unsigned int v : cell->vertex_indices())
          out << cell->vertex_index(v) << ' ';
        out << '\n';
      }
  }

  double
  seconds()
  {
    return std::chrono::duration<double>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
  }

  /// Pattern and matrix of one body that nothing holds.
  void
  assemble(const Body &body)
  {
    const FieldNumbering numbering({&body.dof_handler}, MPI_COMM_SELF);
    const double         start = seconds();
    dealii::DynamicSparsityPattern sparsity(numbering.size(), numbering.size());
    SparseMatrix                   stiffness;
    add_cell_couplings(body, numbering, body.conformity, sparsity);
    const double middle = seconds();
    stiffness.reinit(
      numbering.owned(), numbering.owned(), sparsity, MPI_COMM_SELF, true);
    const double end = seconds();
    assemble_elasticity(body, numbering, body.conformity, {}, stiffness);
    stiffness.compress(dealii::VectorOperation::add);
    std::cout << middle - start << ' ' << end - middle << ' ' << seconds() - end
              << std::endl;
  }
} // namespace

int
main(int argc, char **argv)
{
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  if (argc < 6)
    {
      std::cerr << "assembly DEGREE N M straight|curved MESH_FILE\n";
      return 2;
    }
  MeshParameters mesh;
  mesh.source       = "shell octant";
  mesh.cells        = "tetrahedra";
  mesh.extent       = {1., 2.};
  mesh.subdivisions = {static_cast<unsigned int>(std::atoi(argv[2])),
                       static_cast<unsigned int>(std::atoi(argv[3]))};

  Body body("shell", 0, LinearElastic{10., 0.3});
  body.create_mesh(mesh, MPI_COMM_SELF, "Mesh");
  body.mesh.curved = std::string(argv[4]) == "curved";
  body.create_space(std::atoi(argv[1]), {}, "Body");
  body.conformity.close();
  write_mesh(body, argv[5]);

  std::cout << body.triangulation().n_active_cells() << ' '
            << body.dof_handler.n_dofs() << std::endl;
  std::string line;
  while (std::getline(std::cin, line))
    assemble(body);
}
