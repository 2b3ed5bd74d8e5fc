// Proves that assemble_elasticity() and its load are the matrix and load of the textbook
// sums by FEValues, to 1e-12 of the largest entry: hexahedra and tetrahedra,
// affine, straight and curved, p up to 8, hanging nodes, conditions with values
// and loads, isotropic and orthotropic; that it is symmetric and has rigid
// motions in its kernel.

#include <mortise/body/elements/simplex_quadrature.h>
#include <mortise/operators/cells/cell_kernel.h>
#include <mortise/operators/scene_system.h>

#include <random>

#include "../scenes/scene.h"

namespace mortise::testing
{
  using namespace dealii;

  struct Assembled
  {
    SparseMatrix matrix;
    Vector       load;
  };

  /// Pattern by deal.II, not by what is tested.
  Assembled
  empty_system(const Body                      &body,
               const FieldNumbering            &numbering,
               const AffineConstraints<double> &constraints)
  {
    DynamicSparsityPattern sparsity(numbering.size(),
                                    numbering.size(),
                                    constraints.get_local_lines());
    for (const auto &cell : body.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          std::vector<types::global_dof_index> dofs(
            cell->get_fe().n_dofs_per_cell());
          cell->get_dof_indices(dofs);
          constraints.add_entries_local_to_global(dofs, sparsity, false);
        }
    Assembled system;
    system.matrix.reinit(
      numbering.owned(), numbering.owned(), sparsity, MPI_COMM_WORLD, true);
    system.load.reinit(numbering.owned(), MPI_COMM_WORLD);
    return system;
  }

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

  /// Replace the last unknowns by their own, uncoupled diagonals.
  void
  condense(FullMatrix<double>     &K,
           dealii::Vector<double> &f,
           const unsigned int      n_b)
  {
    const unsigned int n_i = K.m() - n_b;
    if (n_i == 0)
      return;
    FullMatrix<double> K_ii(n_i), K_ib(n_i, n_b), X(n_i, n_b), S(n_b);
    K_ii.fill(K, 0, 0, n_b, n_b);
    K_ib.fill(K, 0, 0, n_b, 0);
    K_ii.gauss_jordan();
    K_ii.mmult(X, K_ib);
    K_ib.Tmmult(S, X);
    for (unsigned int i = 0; i < n_b; ++i)
      for (unsigned int k = 0; k < n_i; ++k)
        f[i] -= X(k, i) * f[n_b + k];
    for (unsigned int i = 0; i < K.m(); ++i)
      for (unsigned int j = 0; j < K.m(); ++j)
        if (i < n_b && j < n_b)
          K(i, j) -= S(i, j);
        else if (i != j)
          K(i, j) = 0.;
    for (unsigned int k = 0; k < n_i; ++k)
      f[n_b + k] = 0.;
  }

  Assembled
  textbook(const Body                      &body,
           const FieldNumbering            &numbering,
           const AffineConstraints<double> &constraints)
  {
    Assembled system = empty_system(body, numbering, constraints);
    for (const auto &cell : body.dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          const auto &fe = cell->get_fe();
          const auto  iterator =
            static_cast<Triangulation<dim>::cell_iterator>(cell);
          FEValues<dim> values(*body.mapping,
                               fe.base_element(0),
                               stiffness_quadrature(fe, body.mapping_degree),
                               update_gradients | update_JxW_values);
          values.reinit(iterator);
          const unsigned int n = values.dofs_per_cell;
          auto               K = textbook_matrix(body.material, fe, values, n);

          FEValues<dim> for_load(
            *body.mapping,
            fe.base_element(0),
            body.mesh.tetrahedra ?
              simplex_quadrature<dim>(2 * fe.degree + body.mapping_degree - 1) :
              stiffness_quadrature(fe, body.mapping_degree),
            update_values | update_JxW_values | update_quadrature_points);
          for_load.reinit(iterator);
          dealii::Vector<double> f(dim * n);
          for (const unsigned int q : for_load.quadrature_point_indices())
            for (unsigned int i = 0; i < n; ++i)
              for (unsigned int c = 0; c < dim; ++c)
                f[fe.component_to_system_index(c, i)] +=
                  for_load.JxW(q) * for_load.shape_value(i, q) *
                  force(for_load.quadrature_point(q))[c];

          condense(K, f, fe.get_first_hex_index());
          std::vector<types::global_dof_index> dofs(dim * n);
          cell->get_dof_indices(dofs);
          constraints.distribute_local_to_global(
            K, f, dofs, system.matrix, system.load);
        }
    system.matrix.compress(VectorOperation::add);
    system.load.compress(VectorOperation::add);
    return system;
  }
  Assembled
  tested(const Body                      &body,
         const FieldNumbering            &numbering,
         const AffineConstraints<double> &constraints)
  {
    DynamicSparsityPattern sparsity(numbering.size(),
                                    numbering.size(),
                                    constraints.get_local_lines());
    add_cell_couplings(body, numbering, constraints, sparsity);
    Assembled system;
    system.matrix.reinit(
      numbering.owned(), numbering.owned(), sparsity, MPI_COMM_WORLD, true);
    const AssembledBody assembled = assemble_elasticity(
      body, numbering, constraints, {true, true}, system.matrix);
    system.matrix.compress(VectorOperation::add);

    Loads loads;
    loads.body_force = force;
    SceneField field;
    field.numbering = FieldNumbering({&body.dof_handler}, MPI_COMM_WORLD);
    field.constraints.copy_from(constraints);
    for (const auto &line : constraints.get_lines())
      field.constraints.set_inhomogeneity(line.index, 0.);
    SceneLoad load;
    load.prescribed = prescribed_values(constraints);
    load.interiors.resize(1);
    load.rhs.displacement.reinit(numbering.owned(), MPI_COMM_WORLD);
    add_assembled_load(body, loads, assembled, field, nullptr, load);
    load.rhs.displacement.compress(VectorOperation::add);
    system.load = load.rhs.displacement;
    return system;
  }

  /// Entries of an owned row by global column.
  std::map<int, double>
  entries(const SparseMatrix &matrix, const int row)
  {
    const auto &epetra  = matrix.trilinos_matrix();
    int         n       = 0;
    int        *columns = nullptr;
    double     *values  = nullptr;
    epetra.ExtractMyRowView(row, n, values, columns);
    std::map<int, double> result;
    for (int k = 0; k < n; ++k)
      result[epetra.GCID(columns[k])] = values[k];
    return result;
  }

  /// Largest difference, relative to the largest entry. The pattern of @p a may
  /// be smaller: what it lacks is zero there.
  double
  difference(const SparseMatrix &a, const SparseMatrix &b)
  {
    double result = 0., largest = 0.;
    for (int row = 0; row < b.trilinos_matrix().NumMyRows(); ++row)
      {
        auto of_a = entries(a, row);
        for (const auto &[column, value] : entries(b, row))
          {
            result  = std::max(result, std::abs(value - of_a[column]));
            largest = std::max(largest, std::abs(value));
          }
      }
    return Utilities::MPI::max(result, MPI_COMM_WORLD) /
           Utilities::MPI::max(largest, MPI_COMM_WORLD);
  }

  /// |x.Ky - y.Kx| for random x and y, relative to |x||Ky|.
  double
  asymmetry(const SparseMatrix &matrix)
  {
    std::mt19937 random(1 + Utilities::MPI::this_mpi_process(MPI_COMM_WORLD));
    std::uniform_real_distribution<> any(-1., 1.);
    Vector                           x, y, Kx, Ky;
    for (Vector *v : {&x, &y, &Kx, &Ky})
      v->reinit(matrix.locally_owned_range_indices(), MPI_COMM_WORLD);
    for (Vector *v : {&x, &y})
      {
        for (const auto i : v->locally_owned_elements())
          (*v)[i] = any(random);
        v->compress(VectorOperation::insert);
      }
    matrix.vmult(Kx, x);
    matrix.vmult(Ky, y);
    return std::abs(x * Ky - y * Kx) / (x.l2_norm() * Ky.l2_norm());
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
  kernel_defect(const Body &body, const SparseMatrix &matrix)
  {
    double defect = 0.;
    for (unsigned int m = 0; m < 2 * dim; ++m)
      {
        Vector r(matrix.locally_owned_range_indices(), MPI_COMM_WORLD), Kr(r);
        for (const auto &cell : body.dof_handler.active_cell_iterators())
          if (cell->is_locally_owned())
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
              std::vector<types::global_dof_index> dofs(modes.size());
              cell->get_dof_indices(dofs);
              // interiors were eliminated
              for (unsigned int i = 0; i < modes.size(); ++i)
                r[dofs[i]] =
                  i < cell->get_fe().get_first_hex_index() ? modes[i] : 0.;
            }
        r.compress(VectorOperation::insert);
        matrix.vmult(Kr, r);
        defect = std::max(defect, Kr.linfty_norm());
      }
    return defect / matrix.linfty_norm();
  }

  /// Every seventh dof is given where no other depends on any.
  AffineConstraints<double>
  some_constraints(const Body &body)
  {
    AffineConstraints<double> constraints;
    constraints.copy_from(body.conformity);
    if (Utilities::MPI::sum(constraints.n_constraints(), MPI_COMM_WORLD) == 0)
      for (const auto dof : body.relevant_dofs)
        if (dof % 7 == 3)
          {
            constraints.add_line(dof);
            constraints.set_inhomogeneity(dof, dof % 2 == 0 ? 0.3 : 0.);
          }
    complete_constraints(body.dof_handler, constraints);
    constraints.close();
    return constraints;
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
    const FieldNumbering numbering({&body.dof_handler}, MPI_COMM_WORLD);

    const std::string what = name + ", p = " + std::to_string(degree) + ": ";
    {
      const auto      constraints = some_constraints(body);
      const Assembled a           = tested(body, numbering, constraints);
      Assembled       b           = textbook(body, numbering, constraints);
      verdict(what + "matrix 1e-12", difference(a.matrix, b.matrix), 1e-12);
      b.load -= a.load;
      verdict(what + "load 1e-11",
              b.load.linfty_norm() / a.load.linfty_norm(),
              1e-11);
      verdict(what + "symmetric 1e-13", asymmetry(a.matrix), 1e-13);
    }
    body.conformity.close();
    const Assembled a = tested(body, numbering, body.conformity);
    if (by_region.empty() && mesh.refine_near.empty())
      verdict(what + "rigid motions 1e-11",
              kernel_defect(body, a.matrix),
              1e-11);
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
  auto distorted = box, shell = box, refined = box;
  distorted.subdivisions = {2, 2, 2};
  distorted.distort      = 0.2;
  shell.source           = "shell octant";
  shell.extent           = {1., 2.};
  shell.subdivisions     = {1, 1};
  refined.refine_near    = "0, 0, 0, 0.1, 1";

  for (const unsigned int p : {1, 2, 3})
    {
      check("hexahedra, affine", box, false, {}, p);
      check("hexahedra, straight", distorted, false, {}, p);
      check("hexahedra, curved", shell, true, {}, p);
    }
  check("hexahedra, hanging nodes", refined, false, {}, 3);
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
