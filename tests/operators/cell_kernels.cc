// Proves that the matrices and loads of cells are the textbook sums by
// FEValues, to 1e-12 of the largest entry: hexahedra and tetrahedra, affine,
// straight and curved, p up to 8, isotropic and orthotropic; that the matrices
// are symmetric and have rigid motions in their kernel.
#include <mortise/body/elements/simplex_quadrature.h>
#include <mortise/operators/cells/cell_kernel.h>
#include <mortise/operators/cells/load_kernel.h>
#include <mortise/operators/scene_system.h>

#include "../scenes/scene.h"

namespace mortise::testing
{
  using namespace dealii;

  Tensor<1, dim>
  force(const Point<dim> &x)
  {
    return Point<dim>(1. + x[1], x[0] * x[2], -2.);
  }

  /// lambda H_cd + mu H_dc + delta_cd mu tr(H), or any law's sum_ef C_cedf
  /// H_ef.
  double
  contracted(const Material       &material,
             const Tensor<2, dim> &H,
             const unsigned int    c,
             const unsigned int    d)
  {
    if (const LinearElastic *law = material.isotropic())
      return law->lame_lambda() * H[c][d] + law->lame_mu() * H[d][c] +
             (c == d ? law->lame_mu() * trace(H) : 0.);
    double sum = 0.;
    for (unsigned int f = 0; f < dim; ++f)
      {
        Tensor<2, dim> gradient;
        gradient[d][f] = 1.;
        const auto s   = material.stress(gradient);
        for (unsigned int e = 0; e < dim; ++e)
          sum += s[c][e] * H[e][f];
      }
    return sum;
  }

  /// H = sum_q w grad N_i (x) grad N_j
  FullMatrix<double>
  textbook_matrix(const Material           &material,
                  const FiniteElement<dim> &system,
                  const FEValues<dim>      &values,
                  const unsigned int        n)
  {
    std::vector<std::vector<Tensor<1, dim>>> gradients(n);
    for (unsigned int i = 0; i < n; ++i)
      for (const unsigned int q : values.quadrature_point_indices())
        gradients[i].push_back(values.shape_grad(i, q));
    FullMatrix<double> K(dim * n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = i; j < n; ++j)
        {
          Tensor<2, dim> H;
          for (const unsigned int q : values.quadrature_point_indices())
            H +=
              outer_product(gradients[i][q], gradients[j][q]) * values.JxW(q);
          for (unsigned int c = 0; c < dim; ++c)
            for (unsigned int d = 0; d < dim; ++d)
              {
                const unsigned int row = system.component_to_system_index(c, i),
                                   column =
                                     system.component_to_system_index(d, j);
                K(row, column) = contracted(material, H, c, d);
                K(column, row) = K(row, column);
              }
        }
    return K;
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

  double
  asymmetry(const FullMatrix<double> &matrix)
  {
    double result = 0.;
    for (unsigned int i = 0; i < matrix.m(); ++i)
      for (unsigned int j = 0; j < i; ++j)
        result = std::max(result, std::abs(matrix(i, j) - matrix(j, i)));
    return result / largest(matrix);
  }

  /// Functions of one cell that take the values of @p motion, by least squares
  /// over points of the reference cell; the mapping has at most their degree.
  std::vector<double>
  modes_of(const Body                                              &body,
           const Body::CellIterator                                &cell,
           const std::function<Tensor<1, dim>(const Point<dim> &)> &motion)
  {
    const auto   &fe   = cell->get_fe();
    const auto    rule = stiffness_quadrature(fe, fe.degree);
    FEValues<dim> values(*body.mapping,
                         fe.base_element(0),
                         rule,
                         update_values | update_quadrature_points);
    values.reinit(static_cast<Triangulation<dim>::cell_iterator>(cell));
    const unsigned int                  n = values.dofs_per_cell;
    FullMatrix<double>                  mass(n);
    std::vector<dealii::Vector<double>> rhs(dim, dealii::Vector<double>(n));
    for (const unsigned int q : values.quadrature_point_indices())
      for (unsigned int i = 0; i < n; ++i)
        {
          const double N = rule.weight(q) * values.shape_value(i, q);
          for (unsigned int j = 0; j < n; ++j)
            mass(i, j) += N * values.shape_value(j, q);
          for (unsigned int c = 0; c < dim; ++c)
            rhs[c][i] += N * motion(values.quadrature_point(q))[c];
        }
    mass.gauss_jordan();
    std::vector<double>    modes(dim * n);
    dealii::Vector<double> solution(n);
    for (unsigned int c = 0; c < dim; ++c)
      {
        mass.vmult(solution, rhs[c]);
        for (unsigned int i = 0; i < n; ++i)
          modes[fe.component_to_system_index(c, i)] = solution[i];
      }
    return modes;
  }

  /// Largest |K r| over the rigid motions r, relative to |K|.
  double
  kernel_defect(const Body               &body,
                const Body::CellIterator &cell,
                const FullMatrix<double> &matrix)
  {
    double defect = 0.;
    for (unsigned int m = 0; m < 2 * dim; ++m)
      {
        const auto modes = modes_of(body, cell, [m](const Point<dim> &x) {
          Tensor<1, dim> u;
          if (m < dim)
            u[m] = 1.;
          else
            {
              u[(m + 1) % dim] = x[(m + 2) % dim];
              u[(m + 2) % dim] = -x[(m + 1) % dim];
            }
          return u;
        });
        dealii::Vector<double> r(modes.begin(), modes.end()), Kr(r.size());
        matrix.vmult(Kr, r);
        defect = std::max(defect, Kr.linfty_norm());
      }
    return defect / matrix.linfty_norm();
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
    double in_matrix = 0., in_load = 0., in_symmetry = 0., in_motions = 0.;
    for (const auto &cell : body.dof_handler.active_cell_iterators())
      {
        const auto &fe = cell->get_fe();
        const auto  iterator =
          static_cast<Triangulation<dim>::cell_iterator>(cell);
        FEValues<dim> values(*body.mapping,
                             fe.base_element(0),
                             stiffness_quadrature(fe, body.mapping_degree),
                             update_gradients | update_JxW_values);
        values.reinit(iterator);
        FullMatrix<double> K(fe.n_dofs_per_cell());
        CellKernel(body, fe).compute(cell, K);
        FullMatrix<double> difference(K);
        difference.add(
          -1.,
          textbook_matrix(body.material, fe, values, values.dofs_per_cell));
        in_matrix   = std::max(in_matrix, largest(difference) / largest(K));
        in_symmetry = std::max(in_symmetry, asymmetry(K));
        in_motions  = std::max(in_motions, kernel_defect(body, cell, K));

        FEValues<dim> for_load(
          *body.mapping,
          fe.base_element(0),
          body.mesh.tetrahedra ?
            simplex_quadrature<dim>(2 * fe.degree + body.mapping_degree - 1) :
            stiffness_quadrature(fe, body.mapping_degree),
          update_values | update_JxW_values | update_quadrature_points);
        for_load.reinit(iterator);
        dealii::Vector<double> f = textbook_load(fe, for_load);
        f -= LoadKernel(body, fe).compute(cell, loads);
        in_load =
          std::max(in_load,
                   f.linfty_norm() / textbook_load(fe, for_load).linfty_norm());
      }
    const std::string what = name + ", p = " + std::to_string(degree) + ": ";
    verdict(what + "matrix 1e-12", in_matrix, 1e-12);
    verdict(what + "load 1e-11", in_load, 1e-11);
    verdict(what + "symmetric 1e-13", in_symmetry, 1e-13);
    if (by_region.empty())
      verdict(what + "rigid motions 1e-11", in_motions, 1e-11);
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
