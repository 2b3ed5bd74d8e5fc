// Proves that functions of FE_Legendre survive refinement and coarsening:
// SolutionTransfer keeps polynomials of the element's degree exactly, for one
// degree and for mixed ones.

#include <deal.II/base/mpi.h>

#include <deal.II/distributed/solution_transfer.h>

#include <deal.II/dofs/dof_tools.h>

#include <deal.II/fe/fe_system.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <deal.II/numerics/vector_tools.h>

#include <mortise/body/elements/fe_legendre.h>
#include <mortise/body/spaces/hp_constraints.h>
#include <verdict.h>

#include "element_meshes.h"

using namespace dealii;
using namespace element_test;

using DistributedVector = LinearAlgebra::distributed::Vector<double>;

class TestPolynomial : public Function<3>
{
public:
  explicit TestPolynomial(const unsigned int p)
    : Function<3>(3)
    , p(p)
  {}

  double
  value(const Point<3> &x, const unsigned int c) const override
  {
    return std::pow(x[c], p) -
           std::pow(0.3 - x[(c + 1) % 3], p) * x[(c + 2) % 3];
  }

private:
  const unsigned int p;
};

DistributedVector
interpolate(const DoFHandler<3> &dof_handler, const unsigned int p)
{
  IndexSet relevant;
  DoFTools::extract_locally_relevant_dofs(dof_handler, relevant);
  DistributedVector v(dof_handler.locally_owned_dofs(),
                      relevant,
                      dof_handler.get_communicator());
  VectorTools::interpolate(dof_handler, TestPolynomial(p), v);
  v.update_ghost_values();
  return v;
}

/// Largest error of a mode after one refinement and coarsening of cells drawn
/// at random.
double
transfer_error(const unsigned int first, const unsigned int last)
{
  parallel::distributed::Triangulation<3> triangulation(MPI_COMM_WORLD);
  create_shape("cube", first, triangulation);
  triangulation.refine_global(1);

  hp::FECollection<3> fes;
  for (unsigned int p = 1; p <= 8; ++p)
    fes.push_back(FESystem<3>(mortise::FE_Legendre(p), 3));
  DoFHandler<3> dof_handler(triangulation);
  draw_degrees(dof_handler, first - 1, last - 1, 3);
  dof_handler.distribute_dofs(fes);
  DistributedVector u = interpolate(dof_handler, first);

  for (const auto &cell : triangulation.active_cell_iterators())
    if (cell->is_locally_owned())
      {
        if (cell_number(cell->parent(), 9) % 2 == 0)
          cell->set_coarsen_flag();
        else if (cell_number(cell, 9) % 3 == 0)
          cell->set_refine_flag();
      }
  parallel::distributed::SolutionTransfer<3, DistributedVector> transfer(
    dof_handler);
  triangulation.prepare_coarsening_and_refinement();
  transfer.prepare_for_coarsening_and_refinement(u);
  triangulation.execute_coarsening_and_refinement();
  dof_handler.distribute_dofs(fes);
  DistributedVector exact = interpolate(dof_handler, first);
  DistributedVector moved;
  moved.reinit(exact);
  transfer.interpolate(moved);
  exact.zero_out_ghost_values();
  moved.zero_out_ghost_values();
  moved -= exact;
  return moved.linfty_norm();
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (unsigned int p = 1; p <= 4; ++p)
    for (const unsigned int last : {p, p + 2})
      {
        const double      error = transfer_error(p, last);
        const std::string what =
          "p=" + std::to_string(p) + ".." + std::to_string(last) +
          ": polynomials survive refinement and coarsening, 1e-12";
        verdict(what, error, 1e-12);
      }
}
