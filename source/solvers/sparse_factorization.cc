// See sparse_factorization.h.
#include <Amesos.h>
#include <Amesos_BaseSolver.h>
#include <Amesos_config.h>
#include <Teuchos_ParameterList.hpp>
#include <mortise/solvers/sparse_factorization.h>
#ifdef HAVE_AMESOS_MUMPS
#  include <Amesos_Mumps.h>
#endif

namespace mortise
{
  namespace
  {
#ifdef HAVE_AMESOS_MUMPS
    void
    set_mumps_controls(Amesos_BaseSolver &solver, const int workspace)
    {
      if (auto *mumps = dynamic_cast<Amesos_Mumps *>(&solver))
        {
          mumps->SetICNTL(
            6,
            0); // no column permutation: it would spoil the symmetric structure
          mumps->SetICNTL(
            14, workspace); // per cent beyond the estimate, for pivoting
        }
    }
#else
    void
    set_mumps_controls(Amesos_BaseSolver &, int)
    {}
#endif
  } // namespace

  SparseFactorization::SparseFactorization()  = default;
  SparseFactorization::~SparseFactorization() = default;

  bool
  SparseFactorization::initialize(const Epetra_CrsMatrix &matrix)
  {
    Amesos     factory;
    const bool has_mumps = factory.Query("Mumps");
    // delayed pivots of a saddle point may need much more room than MUMPS
    // estimates
    for (const int workspace : {100, 1000, 5000})
      if (has_mumps && factorize(factory, "Mumps", workspace, matrix))
        {
          name = "MUMPS";
          return true;
        }
    name = "KLU";
    return factorize(factory, "Klu", 0, matrix);
  }

  bool
  SparseFactorization::factorize(Amesos                 &factory,
                                 const std::string      &type,
                                 const int               workspace,
                                 const Epetra_CrsMatrix &matrix)
  {
    solver.reset();
    problem = std::make_unique<Epetra_LinearProblem>();
    problem->SetOperator(const_cast<Epetra_CrsMatrix *>(&matrix));
    solver.reset(factory.Create(type, *problem));

    Teuchos::ParameterList parameters;
    parameters.set("PrintTiming", false);
    parameters.set("PrintStatus", false);
    parameters.set("MaxProcs", -3); // all ranks
    solver->SetParameters(parameters);
    set_mumps_controls(*solver, workspace);
    return solver->SymbolicFactorization() == 0 &&
           solver->NumericFactorization() == 0;
  }

  bool
  SparseFactorization::solve(Epetra_MultiVector       &x,
                             const Epetra_MultiVector &b) const
  {
    problem->SetLHS(&x);
    problem->SetRHS(const_cast<Epetra_MultiVector *>(&b));
    return solver->Solve() == 0;
  }
} // namespace mortise
