// Proves that the matrices of cells with functions of degree one and the loads
// of cells, p up to 8, are the textbook sums by FEValues, to 1e-12 of the
// largest entry: hexahedra and tetrahedra, affine, straight and curved,
// isotropic and orthotropic.
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_system.h>

#include <mortise/body/elements/fe_simplex_legendre.h>
#include <mortise/operators/cells/linear_cell_matrices.h>
#include <mortise/operators/cells/load_kernel.h>
#include <mortise/operators/scene_system.h>
#include <verdict.h>

#include "../scenes/scene.h"
#include "reference_cell.h"

namespace mortise::testing
{
  using namespace dealii;

  Tensor<1, dim>
  force(const Point<dim> &x)
  {
    return Point<dim>(1. + x[1], x[0] * x[2], -2.);
  }

  dealii::Vector<double>
  textbook_load(const FiniteElement<dim> &system, const FEValues<dim> &values)
  {
    dealii::Vector<double> f(system.n_dofs_per_cell());
    for (const unsigned int q : values.quadrature_point_indices())
      for (unsigned int i = 0; i < values.dofs_per_cell; ++i)
        for (unsigned int c = 0; c < dim; ++c)
          f[system.component_to_system_index(c, i)] +=
            values.JxW(q) * values.shape_value(i, q) *
            force(values.quadrature_point(q))[c];
    return f;
  }

  double
  largest(const FullMatrix<double> &matrix)
  {
    double result = 0.;
    for (unsigned int i = 0; i < matrix.m(); ++i)
      for (unsigned int j = 0; j < matrix.n(); ++j)
        result = std::max(result, std::abs(matrix(i, j)));
    return result;
  }

  void
  check(const std::string                            &name,
        const MeshParameters                         &mesh,
        const bool                                    curved,
        const std::map<types::material_id, unsigned> &by_region,
        const unsigned int                            degree,
        const Material &material = LinearElastic{10., 0.3})
  {
    Body body("body", 0, material);
    body.create_mesh(mesh, MPI_COMM_WORLD, "test");
    body.mesh.curved = curved;
    body.create_space(degree, by_region, "test");
    Loads loads;
    loads.body_force = force;
    std::unique_ptr<FiniteElement<dim>> vertices =
      std::make_unique<FESystem<dim>>(FE_Q<dim>(1), dim);
    if (body.mesh.tetrahedra)
      vertices = make_simplex_system(FE_SimplexLegendre(1), dim);
    ReferenceCell      reference(body, *vertices);
    LinearCellMatrices linear;
    double             in_matrix = 0., in_load = 0.;
    for (const auto &cell : body.dof_handler.active_cell_iterators())
      {
        const auto &fe = cell->get_fe();
        const auto  iterator =
          static_cast<Triangulation<dim>::cell_iterator>(cell);
        reference.reinit(cell);
        const FullMatrix<double> expected = reference.matrix();
        FullMatrix<double>       difference(expected);
        difference.add(-1., linear.of(body, cell));
        in_matrix =
          std::max(in_matrix, largest(difference) / largest(expected));
        FEValues<dim> for_load(
          *body.mapping,
          fe.base_element(0),
          body.mesh.tetrahedra ?
            simplex_quadrature<dim>(2 * fe.degree + body.mapping_degree - 1) :
            reference_rule(body, fe),
          update_values | update_JxW_values | update_quadrature_points);
        for_load.reinit(iterator);
        dealii::Vector<double> f = textbook_load(fe, for_load);
        f -= LoadKernel(body, fe).compute(cell, loads);
        in_load =
          std::max(in_load,
                   f.linfty_norm() / textbook_load(fe, for_load).linfty_norm());
      }
    const std::string what = name + ", p = " + std::to_string(degree) + ": ";
    verdict(what + "matrix of degree one 1e-12", in_matrix, 1e-12);
    verdict(what + "load 1e-11", in_load, 1e-11);
  }
} // namespace mortise::testing

int
main(int argc, char **argv)
{
  using namespace mortise::testing;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  mortise::MeshParameters box;
  box.extent       = {0., 0., 0., 2., 1.5, 1.};
  box.subdivisions = {2, 1, 1};
  auto distorted = box, shell = box;
  distorted.subdivisions = {2, 2, 2};
  distorted.distort      = 0.2;
  shell.source           = "shell octant";
  shell.extent           = {1., 2.};
  shell.subdivisions     = {1, 1};

  for (const unsigned int p : {1, 2, 3})
    {
      check("hexahedra, affine", box, false, {}, p);
      check("hexahedra, straight", distorted, false, {}, p);
      check("hexahedra, curved", shell, true, {}, p);
    }
  check("hexahedra, two degrees", shell, true, {{1, 3}}, 2);
  for (auto *mesh : {&box, &shell})
    mesh->cells = "tetrahedra";
  for (unsigned int p = 1; p <= 8; ++p)
    {
      check("tetrahedra, affine", box, false, {}, p);
      if (p <= 5)
        check("tetrahedra, curved", shell, true, {}, p);
    }
  check("tetrahedra, two degrees", shell, true, {{1, 3}}, 2);

  const mortise::Orthotropic wood{{{10., 1., 0.5}},
                                  {{0.35, 0.6, 0.02}},
                                  {{0.7, 0.05, 0.8}},
                                  {{20., -35., 70.}}};
  for (const std::string cells : {"hexahedra", "tetrahedra"})
    {
      box.cells = shell.cells = cells;
      check("orthotropic " + cells + ", affine", box, false, {}, 3, wood);
      check("orthotropic " + cells + ", curved", shell, true, {}, 2, wood);
    }
}
