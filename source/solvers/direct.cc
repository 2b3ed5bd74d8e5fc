// See direct.h.
#include <deal.II/base/mpi.h>
#include <deal.II/base/timer.h>

#include <Epetra_Map.h>
#include <Epetra_Vector.h>
#include <mortise/solvers/direct.h>
#include <mortise/solvers/epetra_tools.h>
#include <mortise/solvers/scaled_residual.h>
#include <mortise/solvers/sparse_factorization.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Index = types::global_dof_index;

    /// One numbering of (u, lambda), rank by rank: what a rank owns of u, then
    /// of lambda.
    class MonolithicNumbering
    {
    public:
      explicit MonolithicNumbering(const BlockSystem &system)
      {
        const auto n_u =
          Utilities::MPI::all_gather(system.communicator,
                                     system.owned_displacement.n_elements());
        const auto n_l =
          Utilities::MPI::all_gather(system.communicator,
                                     system.owned_multiplier.n_elements());
        u_start.push_back(0);
        l_start.push_back(0);
        for (unsigned int r = 0; r < n_u.size(); ++r)
          {
            u_start.push_back(u_start.back() + n_u[r]);
            l_start.push_back(l_start.back() + n_l[r]);
          }
      }

      unsigned int
      u_owner(const Index i) const
      {
        return owner(u_start, i);
      }

      Index
      u(const Index i) const
      {
        return i + l_start[u_owner(i)];
      }

      Index
      l(const Index k) const
      {
        return k + u_start[owner(l_start, k) + 1];
      }

      Index
      size() const
      {
        return u_start.back() + l_start.back();
      }

    private:
      static unsigned int
      owner(const std::vector<Index> &start, const Index i)
      {
        return std::upper_bound(start.begin(), start.end(), i) - start.begin() -
               1;
      }

      std::vector<Index> u_start, l_start;
    };

    /// Square roots of the inverse diagonals of the residual's norm, in the
    /// monolithic numbering: they make the matrix free of units, so that
    /// pivoting compares like with like.
    void
    set_scaling(Epetra_Vector        &scale,
                const ScaledResidual &residual,
                const int             n_displacements)
    {
      for (int i = 0; i < scale.MyLength(); ++i)
        scale[i] =
          std::sqrt(i < n_displacements ?
                      residual.inverse_diagonal_u()[i] :
                      residual.inverse_diagonal_lambda()[i - n_displacements]);
    }

    /// [K B^T; B 0], not scaled.
    std::unique_ptr<Epetra_CrsMatrix>
    monolithic_matrix(const BlockSystem         &system,
                      const MonolithicNumbering &numbering)
    {
      std::vector<int> my_rows;
      for (const auto i : system.owned_displacement)
        my_rows.push_back(numbering.u(i));
      for (const auto k : system.owned_multiplier)
        my_rows.push_back(numbering.l(k));
      const Epetra_Map map(static_cast<int>(numbering.size()),
                           static_cast<int>(my_rows.size()),
                           my_rows.data(),
                           0,
                           system.stiffness.trilinos_matrix().Comm());

      std::unique_ptr<Epetra_CrsMatrix> transposed;
      if (system.owned_multiplier.size() > 0)
        transposed = transpose(system.coupling.trilinos_matrix(),
                               system.stiffness.trilinos_matrix().RowMap());
      auto matrix = std::make_unique<Epetra_CrsMatrix>(Copy, map, 0, false);

      std::vector<int>    columns;
      std::vector<double> values;
      const auto          add_row =
        [&](const Epetra_CrsMatrix &part, const int local, const auto &number) {
          const EpetraRow row(part, local);
          for (int e = 0; e < row.length; ++e)
            {
              const Index column = part.ColMap().GID(row.columns[e]);
              columns.push_back(static_cast<int>(number(column)));
              values.push_back(row.values[e]);
            }
        };
      const auto u      = [&](const Index i) { return numbering.u(i); };
      const auto l      = [&](const Index k) { return numbering.l(k); };
      const auto insert = [&](const Index row) {
        matrix->InsertGlobalValues(static_cast<int>(row),
                                   static_cast<int>(columns.size()),
                                   values.data(),
                                   columns.data());
        columns.clear();
        values.clear();
      };
      int local = 0;
      for (const auto i : system.owned_displacement)
        {
          add_row(system.stiffness.trilinos_matrix(), local, u);
          if (transposed)
            add_row(*transposed, local, l);
          ++local;
          insert(numbering.u(i));
        }
      local = 0;
      for (const auto k : system.owned_multiplier)
        {
          add_row(system.coupling.trilinos_matrix(), local++, u);
          columns.push_back(static_cast<int>(numbering.l(k)));
          values.push_back(0.);
          insert(numbering.l(k));
        }
      matrix->FillComplete();
      return matrix;
    }

    /// The vector (a, b) in the monolithic numbering of this rank, and back.
    void
    join(Epetra_Vector &v, const Vector &a, const Vector &b)
    {
      const unsigned int n = a.locally_owned_size();
      for (int i = 0; i < v.MyLength(); ++i)
        v[i] = i < static_cast<int>(n) ? a.trilinos_vector()[0][i] :
                                         b.trilinos_vector()[0][i - n];
    }

    void
    add_parts(Vector &a, Vector &b, const Epetra_Vector &v)
    {
      const unsigned int n = a.locally_owned_size();
      for (int i = 0; i < v.MyLength(); ++i)
        (i < static_cast<int>(n) ? a.trilinos_vector()[0][i] :
                                   b.trilinos_vector()[0][i - n]) += v[i];
    }
  } // namespace

  SolveReport
  solve_direct(const BlockSystem   &system,
               const SolverOptions &options,
               Vector              &u,
               Vector              &lambda)
  {
    constexpr unsigned int max_refinements = 4;

    SolveReport report;
    report.method = "direct";
    Timer timer;

    const MonolithicNumbering numbering(system);
    const auto                matrix = monolithic_matrix(system, numbering);
    const ScaledResidual      residual(system);
    Epetra_Vector             scale(matrix->RowMap());
    set_scaling(scale,
                residual,
                static_cast<int>(system.owned_displacement.n_elements()));
    matrix->LeftScale(scale);
    matrix->RightScale(scale);

    SparseFactorization factorization;
    const bool          factorized =
      factorization.initialize(*matrix, MatrixKind::general);
    report.preconditioner = "factorisation (MUMPS)";
    report.setup_seconds  = timer.wall_time();
    timer.restart();

    u.reinit(system.owned_displacement, system.communicator);
    lambda.reinit(system.owned_multiplier, system.communicator);
    Vector       r_u(u), r_lambda(lambda);
    const double rhs_norm = residual.right_hand_side_norm();
    report.converged      = rhs_norm == 0.;
    Epetra_Vector r(matrix->RowMap()), x(matrix->RowMap());
    double        previous = std::numeric_limits<double>::infinity();
    for (unsigned int step = 0;
         factorized && rhs_norm > 0. && step <= max_refinements;
         ++step)
      {
        residual.compute(u, lambda, r_u, r_lambda);
        join(r, r_u, r_lambda);
        r.Multiply(1., scale, r, 0.);
        if (!factorization.solve(x, r))
          break;
        x.Multiply(1., scale, x, 0.);
        add_parts(u, lambda, x);
        residual.compute(u, lambda, r_u, r_lambda);
        report.relative_residual = residual.norm(r_u, r_lambda) / rhs_norm;
        report.history.push_back(report.relative_residual);
        if (options.monitor)
          options.monitor(step, report.relative_residual);
        // Refine until rounding is reached, at least once.
        if (!(report.relative_residual < 0.5 * previous))
          break;
        previous = report.relative_residual;
        if (step > 0 && report.relative_residual <= 1e-14)
          break;
      }
    if (rhs_norm > 0.)
      report.converged =
        factorized && report.relative_residual <= options.tolerance;
    report.solve_seconds = timer.wall_time();
    return report;
  }
} // namespace mortise
