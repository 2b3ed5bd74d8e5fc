// Inf-sup constants as eigenvalues, for meshes so small that dense matrices
// serve: of pressures against displacements, cell by cell. No preconditioner of
// the program is used.
#pragma once

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/sparse_matrix.h>

#include <Teuchos_LAPACK.hpp>
#include <mortise/body/boundary_conditions.h>
#include <mortise/body/elements/legendre_elements.h>
#include <mortise/operators/scene_system.h>
#include <mortise/solvers/factorisation/mumps_factorisation.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "../operators/reference_cell.h"

namespace mortise::testing
{
  using DenseMatrix = dealii::LAPACKFullMatrix<double>;
  using Indices     = std::vector<unsigned int>;

  /// The eigenvalues of S x = e N x, rising; S symmetric, N symmetric and
  /// positive definite.
  inline std::vector<double>
  generalized_eigenvalues(const DenseMatrix &S, const DenseMatrix &N)
  {
    const int           n = S.m();
    std::vector<double> scale(n), a(n * n), b(n * n), values(n), work(64 * n);
    for (int i = 0; i < n; ++i)
      scale[i] = 1. / std::sqrt(N(i, i));
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        {
          const double both = 0.5 * scale[i] * scale[j];
          a[j * n + i]      = both * (S(i, j) + S(j, i));
          b[j * n + i]      = both * (N(i, j) + N(j, i));
        }
    int info = 0;
    Teuchos::LAPACK<int, double>().SYGV(1,
                                        'N',
                                        'U',
                                        n,
                                        a.data(),
                                        n,
                                        b.data(),
                                        n,
                                        values.data(),
                                        work.data(),
                                        work.size(),
                                        &info);
    if (info != 0)
      throw std::runtime_error("the norm is not positive definite");
    return values;
  }

  /// Which rows or columns of a matrix are taken: their place, or -1.
  using Places = std::vector<int>;

  inline Places
  places(const unsigned int n, const Indices &taken)
  {
    Places result(n, -1);
    for (unsigned int i = 0; i < taken.size(); ++i)
      result[taken[i]] = i;
    return result;
  }

  /// The same matrix. One rank.
  inline SparseMatrix
  copy_of(const dealii::SparseMatrix<double> &A)
  {
    std::vector<SparseMatrix::Entry> entries;
    for (const auto &entry : A)
      entries.push_back({entry.row(), entry.column(), entry.value()});
    return SparseMatrix(dealii::complete_index_set(A.m()),
                        dealii::complete_index_set(A.n()),
                        MPI_COMM_WORLD,
                        entries);
  }

  /// visit(column, value) in @p row of @p A, where the column has a place.
  template <typename Visit>
  void
  for_entries(const SparseMatrix &A,
              const unsigned int  row,
              const Places       &columns,
              const Visit        &visit)
  {
    const auto entries = A.row(row);
    for (unsigned int k = 0; k < entries.length; ++k)
      if (const int j = columns[A.global_column(entries.columns[k])]; j >= 0)
        visit(j, entries.values[k]);
  }

  /// @p rows and @p columns of @p A. One rank.
  inline SparseMatrix
  submatrix(const SparseMatrix &A, const Indices &rows, const Indices &columns)
  {
    const Places                     place = places(A.n(), columns);
    std::vector<SparseMatrix::Entry> entries;
    for (unsigned int i = 0; i < rows.size(); ++i)
      for_entries(A, rows[i], place, [&](const unsigned int j, const double v) {
        entries.push_back({i, j, v});
      });
    return SparseMatrix(dealii::complete_index_set(rows.size()),
                        dealii::complete_index_set(columns.size()),
                        MPI_COMM_WORLD,
                        entries);
  }

  /// B A^{-1} B^T with @p rows of B and those of its columns that have a place
  /// in A. One rank.
  inline DenseMatrix
  schur_complement(const SparseMatrix &A,
                   const SparseMatrix &B,
                   const Indices      &rows,
                   const Places       &columns)
  {
    DenseMatrix S(rows.size(), rows.size());
    if (A.m() == 0) // nothing is free
      return S;
    MumpsFactorisation factors;
    if (!factors.initialize(A, MatrixKind::positive_definite))
      throw std::runtime_error("the inner product is not positive definite");
    std::vector<double> x(A.m()), y(A.m());
    for (unsigned int i = 0; i < rows.size(); ++i)
      {
        std::fill(y.begin(), y.end(), 0.);
        for_entries(B, rows[i], columns, [&](const int j, const double value) {
          y[j] += value;
        });
        if (!factors.solve(x.data(), y.data()))
          throw std::runtime_error("the solve failed");
        for (unsigned int k = 0; k <= i; ++k)
          {
            double sum = 0.;
            for_entries(B,
                        rows[k],
                        columns,
                        [&](const int j, const double value) {
                          sum += value * x[j];
                        });
            S(i, k) = S(k, i) = sum;
          }
      }
    return S;
  }

  /// Add @p rows and columns of a sparse matrix.
  inline void
  add_dense(const SparseMatrix &matrix, const Indices &rows, DenseMatrix &dense)
  {
    const Places place = places(matrix.m(), rows);
    for (unsigned int i = 0; i < rows.size(); ++i)
      for_entries(matrix, rows[i], place, [&](const int j, const double value) {
        dense(i, j) += value;
      });
  }

  /// One body, homogeneous conditions.
  struct InfSupBody
  {
    MeshParameters                                 mesh;
    unsigned int                                   degree = 2;
    std::map<dealii::types::material_id, unsigned> degree_by_region;
    std::vector<std::string>                       clamped; ///< boundaries
  };

  inline std::unique_ptr<Body>
  make_body(const InfSupBody   &given,
            const unsigned int  index,
            const LinearElastic material)
  {
    auto body =
      std::make_unique<Body>("body " + std::to_string(index), index, material);
    body->create_mesh(given.mesh, MPI_COMM_WORLD, "inf-sup");
    body->create_space(given.degree, given.degree_by_region, "inf-sup");
    return body;
  }

  /// Conformity and the conditions, open.
  inline dealii::AffineConstraints<double>
  make_constraints(const Body &body, const InfSupBody &given)
  {
    dealii::AffineConstraints<double> constraints;
    constraints.copy_from(body.conformity);
    std::vector<DirichletCondition> conditions;
    for (const std::string &name : given.clamped)
      conditions.push_back(
        {body.boundary_id(name, "inf-sup"), {{true, true, true}}, {}});
    add_dirichlet_constraints(body, conditions, constraints);
    return constraints;
  }

  inline SceneField
  displacement_field(const Body &body, const InfSupBody &given)
  {
    std::vector<dealii::AffineConstraints<double>> constraints(1);
    constraints[0].copy_from(make_constraints(body, given));
    SceneField u;
    u.numbering   = FieldNumbering({&body.dof_handler}, MPI_COMM_WORLD);
    u.constraints = scene_constraints(u.numbering, constraints);
    return u;
  }

  /// Replace the pressures of @p body by those of the displacement's degree.
  inline void
  set_equal_order(Body &body)
  {
    dealii::hp::FECollection<dim> fe;
    dealii::DoFHandler<dim>       higher(body.triangulation());
    std::set<unsigned int>        degrees;
    for (unsigned int i = 0; i < body.fe.size(); ++i)
      degrees.insert(body.fe[i].degree + 1);
    distribute_legendre_dofs(
      degrees,
      [&](const auto &cell) {
        return Body::CellIterator(&body.triangulation(),
                                  cell->level(),
                                  cell->index(),
                                  &body.dof_handler)
                 ->get_fe()
                 .degree +
               1;
      },
      1,
      fe,
      higher);
    body.pressure = std::make_unique<PressureSpace>(higher);
  }

  struct MixedMatrices
  {
    SparseMatrix stiffness, divergence, mass;
  };

  /// K, G and M of one body in hierarchical functions. One rank.
  inline MixedMatrices
  assemble_mixed(const Body &body, const SceneField &u, const SceneField &p)
  {
    const dealii::types::global_dof_index n_u = u.numbering.size(),
                                          n_p = p.numbering.size();
    dealii::DynamicSparsityPattern all(n_u + n_p, n_u + n_p);
    // both fields with one set of constraints, pressures last
    dealii::AffineConstraints<double> constraints;
    for (const auto &[field, first] : std::initializer_list<
           std::pair<const SceneField *, dealii::types::global_dof_index>>{
           {&u, 0}, {&p, n_u}})
      for (const auto &line : field->constraints.get_lines())
        {
          constraints.add_line(first + line.index);
          for (const auto &[dof, weight] : line.entries)
            constraints.add_entry(first + line.index, first + dof, weight);
        }
    constraints.close();
    std::vector<dealii::types::global_dof_index> dofs, of_pressure;
    const auto indices = [&](const Body::CellIterator &cell) {
      const auto own = body.pressure->cell(cell);
      dofs.resize(cell->get_fe().n_dofs_per_cell());
      cell->get_dof_indices(dofs);
      of_pressure.resize(own->get_fe().n_dofs_per_cell());
      own->get_dof_indices(of_pressure);
      for (const auto dof : of_pressure)
        dofs.push_back(n_u + dof);
    };
    for (const auto &cell : body.dof_handler.active_cell_iterators())
      {
        indices(cell);
        constraints.add_entries_local_to_global(dofs, all, false);
      }
    dealii::SparsityPattern sparsity;
    sparsity.copy_from(all);
    dealii::SparseMatrix<double> assembled(sparsity);
    for (const auto &cell : body.dof_handler.active_cell_iterators())
      {
        const auto   &system = cell->get_fe();
        ReferenceCell of_cell(body,
                              system,
                              &body.pressure->cell(cell)->get_fe());
        of_cell.reinit(cell);
        const dealii::FullMatrix<double> matrix = of_cell.matrix();
        indices(cell);
        dealii::FullMatrix<double> local(dofs.size());
        const auto                 place = [&](const unsigned int i) {
          return i < system.n_dofs_per_cell() ?
                                   system.component_to_system_index(i % dim, i / dim) :
                                   i;
        };
        for (unsigned int i = 0; i < dofs.size(); ++i)
          for (unsigned int j = 0; j < dofs.size(); ++j)
            local(place(i), place(j)) = matrix(i, j);
        constraints.distribute_local_to_global(local, dofs, assembled);
      }
    const SparseMatrix mixed = copy_of(assembled);
    Indices            rows_u(n_u), rows_p(n_p);
    std::iota(rows_u.begin(), rows_u.end(), 0);
    std::iota(rows_p.begin(), rows_p.end(), n_u);
    return {submatrix(mixed, rows_u, rows_u),
            submatrix(mixed, rows_p, rows_u),
            submatrix(mixed, rows_p, rows_p)};
  }

  /// Results from the eigenvalues of (G K^{-1} G^T, M).
  struct PressureInfSup
  {
    unsigned int displacements = 0, pressures = 0; ///< free ones
    unsigned int kernel  = 0;  ///< zeros, the constant among them if clamped
    double       beta    = 0.; ///< root of the least that is not the constant's
    double       largest = 0.; ///< root of the largest
  };

  /// From @p S = G K^{-1} G^T and @p M of all free pressures.
  inline PressureInfSup
  pressure_result(const unsigned int displacements,
                  const DenseMatrix &S,
                  const DenseMatrix &M,
                  const bool         closed)
  {
    const auto     values = generalized_eigenvalues(S, M);
    PressureInfSup result;
    result.displacements = displacements;
    result.pressures     = values.size();
    result.kernel =
      std::count_if(values.begin(), values.end(), [](const double value) {
        return value < 1e-10;
      });
    result.beta    = std::sqrt(std::max(0., values[closed ? 1 : 0]));
    result.largest = std::sqrt(values.back());
    return result;
  }

  /// Of one body whose boundary is held on @p given.clamped; if that is all of
  /// it (@p closed) the constant pressure is left out. K is the displacement's
  /// block of the mixed form at nu = 1/2 with mu = 1/2,
  ///
  ///     u.K v = int eps(u):eps(v) + 1/4 div u div v.
  inline PressureInfSup
  pressure_inf_sup(const InfSupBody &given,
                   const bool        closed,
                   const bool        equal_order = false)
  {
    Bodies bodies;
    bodies.push_back(make_body(given, 0, LinearElastic{1.5, 0.5, true}));
    Body &body = *bodies[0];
    if (equal_order)
      set_equal_order(body);
    const SceneField u      = displacement_field(body, given);
    const SceneField p      = pressure_field(bodies, MPI_COMM_WORLD);
    const auto       system = assemble_mixed(body, u, p);

    Indices free;
    for (unsigned int i = 0; i < p.numbering.size(); ++i)
      if (!p.constraints.is_constrained(i))
        free.push_back(i);
    Indices all(u.numbering.size());
    std::iota(all.begin(), all.end(), 0);
    const DenseMatrix S = schur_complement(system.stiffness,
                                           system.divergence,
                                           free,
                                           places(u.numbering.size(), all));
    DenseMatrix       M(free.size(), free.size());
    add_dense(system.mass, free, M);

    return pressure_result(u.numbering.size() - u.constraints.n_constraints(),
                           S,
                           M,
                           closed);
  }
} // namespace mortise::testing
