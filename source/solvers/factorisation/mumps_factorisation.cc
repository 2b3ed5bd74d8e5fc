#include <deal.II/base/mpi.h>

#include <dmumps_c.h>
#include <mortise/solvers/factorisation/mumps_factorisation.h>

#include <new>

namespace mortise
{
  namespace
  {
    enum Job
    {
      initialise             = -1,
      terminate              = -2,
      analyse_and_factorise  = 4,
      solve_with_the_factors = 3
    };

    /// Number @p i of the manual, which counts from one.
    MUMPS_INT &
    control(DMUMPS_STRUC_C &mumps, const int i)
    {
      return mumps.icntl[i - 1];
    }
  } // namespace

  struct MumpsFactorisation::Implementation
  {
    Implementation(const SparseMatrix &matrix, const MatrixKind kind)
      : comm(matrix.communicator())
      , symmetric(kind != MatrixKind::general)
    {
      mumps.comm_fortran = static_cast<MUMPS_INT>(MPI_Comm_c2f(comm));
      mumps.par          = 1;
      mumps.sym          = kind == MatrixKind::general           ? 0 :
                           kind == MatrixKind::positive_definite ? 1 :
                                                                   2;
      run(initialise);
      for (const int stream : {1, 2, 3})
        control(mumps, stream) = -1;
      control(mumps, 4)  = 0; // no messages
      control(mumps, 6)  = 0; // no column permutation: it would spoil symmetry
      control(mumps, 18) = 3; // each rank has its rows
      if (symmetric)
        control(mumps, 8) = 0; // no scaling
      if (kind == MatrixKind::positive_semidefinite)
        {
          // a pivot is zero below this, where rounding leaves 1e-15 and
          // independent rows 1e-7
          mumps.cntl[2]      = -1e-12;
          control(mumps, 13) = 1; // the last front as all others
          control(mumps, 24) = 1; // look for them
        }

      MPI_Comm_rank(comm, &rank);
      int n_ranks = 0, mine = static_cast<int>(matrix.n_rows());
      MPI_Comm_size(comm, &n_ranks);
      counts.resize(n_ranks);
      starts.resize(n_ranks);
      MPI_Allgather(&mine, 1, MPI_INT, counts.data(), 1, MPI_INT, comm);
      for (int r = 1; r < n_ranks; ++r)
        starts[r] = starts[r - 1] + counts[r - 1];

      for (int i = 0; i < mine; ++i)
        {
          const auto row    = matrix.row(i);
          const auto number = matrix.global_row(i);
          for (unsigned int k = 0; k < row.length; ++k)
            if (const auto column = matrix.global_column(row.columns[k]);
                !symmetric || column <= number)
              {
                rows.push_back(static_cast<int>(number) + 1);
                columns.push_back(static_cast<int>(column) + 1);
                values.push_back(row.values[k]);
              }
        }
      mumps.n       = static_cast<int>(matrix.m());
      mumps.nnz_loc = static_cast<MUMPS_INT8>(values.size());
      mumps.irn_loc = rows.data();
      mumps.jcn_loc = columns.data();
      mumps.a_loc   = values.data();
      if (rank == 0)
        on_first.resize(mumps.n);
      mumps.rhs = on_first.data();
    }

    ~Implementation()
    {
      run(terminate);
    }

    bool
    run(const Job job)
    {
      mumps.job = job;
      dmumps_c(&mumps);
      return mumps.infog[0] >= 0;
    }

    bool
    factorise()
    {
      constexpr int workspace_too_small = -9, estimate_too_small = -8;
      // delayed pivots of a saddle point may need much more room than estimated
      for (const int workspace : {50, 1000, 5000})
        {
          control(mumps, 14) = workspace; // per cent
          if (run(analyse_and_factorise))
            {
              const bool negative_pivots = symmetric && mumps.infog[11] > 0;
              for (auto *entries : {&rows, &columns})
                *entries = std::vector<MUMPS_INT>();
              values = std::vector<double>();
              return !negative_pivots;
            }
          throw_if_out_of_memory();
          if (mumps.infog[0] != workspace_too_small &&
              mumps.infog[0] != estimate_too_small)
            return false;
        }
      return false;
    }

    /// Numbers of the manual: an allocation of reals or integers in the
    /// analysis, of anything, of what MUMPS was allowed. All ranks have the
    /// same.
    void
    throw_if_out_of_memory() const
    {
      for (const int allocation_failed : {-5, -7, -13, -19})
        if (mumps.infog[0] == allocation_failed)
          throw std::bad_alloc();
    }

    MPI_Comm               comm;
    const bool             symmetric;
    int                    rank = 0;
    DMUMPS_STRUC_C         mumps{};
    std::vector<int>       counts, starts; ///< rows by rank
    std::vector<MUMPS_INT> rows, columns;
    std::vector<double>    values, on_first; ///< on the first rank: a vector
  };

  MumpsFactorisation::MumpsFactorisation()  = default;
  MumpsFactorisation::~MumpsFactorisation() = default;

  bool
  MumpsFactorisation::initialize(const SparseMatrix &matrix,
                                 const MatrixKind    kind)
  {
    implementation = std::make_unique<Implementation>(matrix, kind);
    return implementation->factorise();
  }

  std::vector<dealii::types::global_dof_index>
  MumpsFactorisation::null_rows() const
  {
    Implementation                              &data = *implementation;
    std::vector<dealii::types::global_dof_index> rows;
    for (int k = 0; data.rank == 0 && k < data.mumps.infog[27]; ++k)
      rows.push_back(data.mumps.pivnul_list[k] - 1);
    return dealii::Utilities::MPI::broadcast(data.comm, rows, 0);
  }

  bool
  MumpsFactorisation::solve(double *x, const double *b) const
  {
    Implementation &data = *implementation;
    const int       mine = data.counts[data.rank];
    MPI_Gatherv(b,
                mine,
                MPI_DOUBLE,
                data.on_first.data(),
                data.counts.data(),
                data.starts.data(),
                MPI_DOUBLE,
                0,
                data.comm);
    const bool solved = data.run(solve_with_the_factors);
    data.throw_if_out_of_memory();
    MPI_Scatterv(data.on_first.data(),
                 data.counts.data(),
                 data.starts.data(),
                 MPI_DOUBLE,
                 x,
                 mine,
                 MPI_DOUBLE,
                 0,
                 data.comm);
    return solved;
  }
} // namespace mortise
