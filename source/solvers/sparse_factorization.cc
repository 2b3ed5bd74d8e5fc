// See sparse_factorization.h.
#include <mortise/solvers/sparse_factorization.h>

#include <Amesos.h>
#include <Amesos_BaseSolver.h>
#include <Teuchos_ParameterList.hpp>

namespace mortise
{
  SparseFactorization::SparseFactorization()  = default;
  SparseFactorization::~SparseFactorization() = default;

  bool
  SparseFactorization::initialize(const Epetra_CrsMatrix &matrix, const Kind kind)
  {
    Amesos factory;
    solver.reset();
    problem = std::make_unique<Epetra_LinearProblem>();
    problem->SetOperator(const_cast<Epetra_CrsMatrix *>(&matrix));

    name = factory.Query("Mumps") ? "MUMPS" : "KLU";
    solver.reset(factory.Create(name == "MUMPS" ? "Mumps" : "Klu", *problem));

    Teuchos::ParameterList parameters;
    parameters.set("PrintTiming", false);
    parameters.set("PrintStatus", false);
    parameters.set("MaxProcs", -3);
    if (const char *e = getenv("MUMPS_PROP"))
      parameters.set("MatrixProperty", std::string(e));
    (void)kind;
    solver->SetParameters(parameters);
    return solver->SymbolicFactorization() == 0 && solver->NumericFactorization() == 0;
  }

  bool
  SparseFactorization::solve(Epetra_MultiVector &x, const Epetra_MultiVector &b) const
  {
    problem->SetLHS(&x);
    problem->SetRHS(const_cast<Epetra_MultiVector *>(&b));
    return solver->Solve() == 0;
  }
} // namespace mortise
