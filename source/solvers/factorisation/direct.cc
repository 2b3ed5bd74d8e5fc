// See direct.h.
#include <deal.II/base/mpi.h>

#include <Epetra_Map.h>
#include <Epetra_Vector.h>
#include <mortise/solvers/factorisation/direct.h>
#include <mortise/solvers/epetra_tools.h>
#include <mortise/solvers/factorisation/mumps_factorisation.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    using Index = types::global_dof_index;

    constexpr unsigned int n_fields = 3;

    /// One numbering of (u, p, lambda), rank by rank: what a rank owns of u,
    /// then of p, then of lambda.
    class MonolithicNumbering
    {
    public:
      explicit MonolithicNumbering(const BlockSystem &system)
        : owned{&system.owned_displacement,
                &system.owned_pressure,
                &system.owned_multiplier}
      {
        std::vector<Index> counts[n_fields];
        for (unsigned int field = 0; field < n_fields; ++field)
          {
            counts[field] =
              Utilities::MPI::all_gather(system.communicator,
                                         owned[field]->n_elements());
            start[field].push_back(0);
            for (const Index n : counts[field])
              start[field].push_back(start[field].back() + n);
          }
        Index next = 0;
        for (unsigned int r = 0; r < counts[0].size(); ++r)
          for (unsigned int field = 0; field < n_fields; ++field)
            {
              shift[field].push_back(next - start[field][r]);
              next += counts[field][r];
            }
        n = next;
      }

      Index
      operator()(const unsigned int field, const Index i) const
      {
        const auto &all = start[field];
        return i + shift[field][std::upper_bound(all.begin(), all.end(), i) -
                                all.begin() - 1];
      }

      Index
      size() const
      {
        return n;
      }

      const IndexSet *owned[n_fields]; ///< by field

    private:
      std::vector<Index> start[n_fields], shift[n_fields]; ///< by rank
      Index              n = 0;
    };

    /// Square roots of the inverse diagonals of the residual's norm, in the
    /// monolithic numbering: they make the matrix free of units, so that
    /// pivoting compares like with like.
    void
    set_scaling(Epetra_Vector        &scale,
                const ScaledResidual &residual,
                const BlockSystem    &system)
    {
      int        next = 0;
      const auto add  = [&](const Epetra_Vector &square) {
        for (int i = 0; i < square.MyLength(); ++i)
          scale[next++] = std::sqrt(square[i]);
      };
      add(residual.inverse_diagonal_u());
      if (system.mixed())
        add(residual.inverse_diagonal_p());
      if (system.owned_multiplier.size() > 0)
        add(residual.inverse_diagonal_lambda());
    }

    /// Gathers the rows of one matrix from blocks.
    class RowBuilder
    {
    public:
      RowBuilder(const MonolithicNumbering &numbering, Epetra_CrsMatrix &matrix)
        : numbering(numbering)
        , matrix(matrix)
      {}

      /// Row @p local of @p part, whose columns are of @p field.
      void
      add(const Epetra_CrsMatrix &part,
          const int               local,
          const unsigned int      field,
          const double            factor = 1.)
      {
        const EpetraRow row(part, local);
        for (int e = 0; e < row.length; ++e)
          add(numbering(field, part.ColMap().GID(row.columns[e])),
              factor * row.values[e]);
      }

      void
      add(const Index column, const double value)
      {
        columns.push_back(static_cast<int>(column));
        values.push_back(value);
      }

      void
      insert(const Index row)
      {
        matrix.InsertGlobalValues(static_cast<int>(row),
                                  static_cast<int>(columns.size()),
                                  values.data(),
                                  columns.data());
        columns.clear();
        values.clear();
      }

    private:
      const MonolithicNumbering &numbering;
      Epetra_CrsMatrix          &matrix;
      std::vector<int>           columns;
      std::vector<double>        values;
    };

    /// [K G^T B^T; G -C 0; B 0 -S], not scaled.
    std::unique_ptr<Epetra_CrsMatrix>
    monolithic_matrix(const BlockSystem         &system,
                      const ScaledResidual      &residual,
                      const MonolithicNumbering &numbering)
    {
      const auto      &K = system.stiffness.trilinos_matrix();
      std::vector<int> my_rows;
      for (unsigned int field = 0; field < n_fields; ++field)
        for (const auto i : *numbering.owned[field])
          my_rows.push_back(numbering(field, i));
      const Epetra_Map map(static_cast<int>(numbering.size()),
                           static_cast<int>(my_rows.size()),
                           my_rows.data(),
                           0,
                           K.Comm());

      std::unique_ptr<Epetra_CrsMatrix> pressure_force, coupling_force;
      if (system.mixed())
        pressure_force =
          transpose(system.divergence.trilinos_matrix(), K.RowMap());
      if (system.owned_multiplier.size() > 0)
        coupling_force =
          transpose(system.coupling.by_displacement(), K.RowMap());
      auto matrix = std::make_unique<Epetra_CrsMatrix>(Copy, map, 0, false);
      RowBuilder rows(numbering, *matrix);
      int        local = 0;
      for (const auto i : system.owned_displacement)
        {
          rows.add(K, local, 0);
          if (pressure_force)
            rows.add(*pressure_force, local, 1);
          if (coupling_force)
            rows.add(*coupling_force, local, 2);
          ++local;
          rows.insert(numbering(0, i));
        }
      local = 0;
      for (const auto k : system.owned_pressure)
        {
          rows.add(system.divergence.trilinos_matrix(), local, 0);
          rows.add(system.compliance.trilinos_matrix(), local, 1, -1.);
          for (unsigned int g = 0; g < system.free_pressures.size(); ++g)
            if (system.free_pressures.pinned(g) == local)
              rows.add(numbering(1, k),
                       -1. / residual.inverse_diagonal_p()[local]);
          ++local;
          rows.insert(numbering(1, k));
        }
      local = 0;
      for (const auto k : system.owned_multiplier)
        {
          if (system.active && !(*system.active)[local])
            rows.add(numbering(2, k),
                     -1. / residual.inverse_diagonal_lambda()[local]);
          else
            {
              rows.add(system.coupling.by_displacement(), local, 0);
              if (system.has_springs())
                rows.add(
                  system.spring_compliance.trilinos_matrix(), local, 2, -1.);
              rows.add(numbering(2, k), 0.);
            }
          ++local;
          rows.insert(numbering(2, k));
        }
      matrix->FillComplete();
      return matrix;
    }

    /// Calls visit(monolithic value, value) for all values of this rank.
    template <typename Solution, typename Visit>
    void
    for_each_value(Epetra_Vector &v, Solution &x, const Visit &visit)
    {
      int next = 0;
      for (auto *part : {&x.displacement, &x.pressure, &x.multiplier})
        for (unsigned int i = 0; i < part->locally_owned_size(); ++i)
          visit(v[next++], part->begin()[i]);
    }

    /// What the system without pins leaves free, a constant pressure of mean
    /// one and the multipliers that come with it, by group of FreePressures:
    /// with a pin c at pressure k, (A + c e e^T) n = c e for A n = 0 and n_k
    /// = 1.
    std::vector<SystemVector>
    free_constants(const BlockSystem         &system,
                   const Epetra_CrsMatrix    &matrix,
                   const Epetra_Vector       &scale,
                   const MumpsFactorisation &factorisation)
    {
      std::vector<SystemVector> result;
      for (unsigned int g = 0; g < system.free_pressures.size(); ++g)
        {
          Epetra_Vector b(matrix.RowMap()), y(b);
          if (const int pinned = system.free_pressures.pinned(g); pinned >= 0)
            b[system.owned_displacement.n_elements() + pinned] = 1.;
          factorisation.solve(y, b);
          y.Multiply(1., scale, y, 0.);
          SystemVector constant = system.zero_vector();
          for_each_value(y, constant, [](const double from, double &to) {
            to = from;
          });
          SystemVector scaled = system.zero_vector();
          add_scaled(scaled,
                     1. / system.free_pressures.mean(g, constant.pressure),
                     constant);
          result.push_back(scaled);
        }
      return result;
    }
  } // namespace

  /// The factorised matrix, scaled, and what it leaves free.
  struct DirectSolver::Factors
  {
    explicit Factors(const BlockSystem    &system,
                     const ScaledResidual &residual)
      : system(system)
      , matrix(
          monolithic_matrix(system, residual, MonolithicNumbering(system)))
      , scale(matrix->RowMap())
      , b(scale)
      , y(scale)
    {
      set_scaling(scale, residual, system);
      matrix->LeftScale(scale);
      matrix->RightScale(scale);
      valid = factorisation.initialize(*matrix, MatrixKind::general);
      if (valid)
        constants = free_constants(system, *matrix, scale, factorisation);
    }

    /// @p x = A^{-1} r; false when the solve failed.
    bool
    solve(const SystemVector &r, SystemVector &x)
    {
      for_each_value(b, r, [](double &to, const double from) { to = from; });
      b.Multiply(1., scale, b, 0.);
      if (!factorisation.solve(y, b))
        return false;
      y.Multiply(1., scale, y, 0.);
      for_each_value(y, x, [](const double from, double &to) { to = from; });
      for (unsigned int g = 0; g < constants.size(); ++g)
        add_scaled(x,
                   -system.free_pressures.mean(g, x.pressure),
                   constants[g]);
      return true;
    }

    const BlockSystem                &system;
    std::unique_ptr<Epetra_CrsMatrix> matrix;
    Epetra_Vector                     scale, b, y;
    MumpsFactorisation               factorisation;
    std::vector<SystemVector>         constants;
    bool                              valid;
  };

  DirectSolver::DirectSolver(const BlockSystem   &system,
                             const SolverOptions &options)
    : LinearSolver(system, options, "direct")
  {}

  DirectSolver::~DirectSolver() = default;

  bool
  DirectSolver::set_up()
  {
    factors     = std::make_unique<Factors>(system, *residual);
    description = "factorisation (MUMPS)";
    return factors->valid;
  }

  void
  DirectSolver::run(const SystemVector &rhs,
                    SystemVector       &x,
                    bool /*is_zero*/,
                    SolveReport &report)
  {
    constexpr unsigned int max_refinements = 4;
    SystemVector           r = system.zero_vector(), correction = r;
    const double           rhs_norm = residual->norm(rhs);
    double                 previous = std::numeric_limits<double>::infinity();
    residual->compute(rhs, x, r);
    for (unsigned int step = 0; rhs_norm > 0. && step <= max_refinements &&
                                factors->solve(r, correction);
         ++step)
      {
        add_scaled(x, 1., correction);
        residual->compute(rhs, x, r);
        const double reached = residual->norm(r) / rhs_norm;
        if (options.monitor)
          options.monitor(step, reached);
        // Refine until rounding is reached, at least once.
        if (!(reached < 0.5 * previous) || (step > 0 && reached <= 1e-14))
          break;
        previous = reached;
      }
    const auto relative_error = [&] {
      return factors->solve(r, correction) ?
               std::sqrt(system.stiffness_product(correction.displacement) /
                         system.stiffness_product(x.displacement)) :
               1.;
    };
    residual->judge({rhs, x, r}, options.tolerance, relative_error, report);
  }
} // namespace mortise
