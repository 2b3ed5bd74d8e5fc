// A sparse factorisation of a distributed matrix, kept for repeated solves. It never refines and
// never checks how good a solution is.
#pragma once

#include <Epetra_CrsMatrix.h>
#include <Epetra_LinearProblem.h>
#include <Epetra_MultiVector.h>

#include <memory>
#include <string>

class Amesos_BaseSolver;

namespace mortise
{
  class SparseFactorization
  {
  public:
    enum class Kind
    {
      general,
      symmetric_indefinite,
      positive_definite
    };

    SparseFactorization();
    ~SparseFactorization();

    /// Factorise @p matrix, which must stay alive; ranks without rows take part. Returns false when the
    /// factorisation broke down (a singular matrix). Collective.
    bool
    initialize(const Epetra_CrsMatrix &matrix, const Kind kind);

    /// x = matrix^{-1} b; false when the solve failed.
    bool
    solve(Epetra_MultiVector &x, const Epetra_MultiVector &b) const;

    /// "MUMPS" or "KLU".
    std::string
    backend() const
    {
      return name;
    }

  private:
    std::string                                name;
    mutable std::unique_ptr<Epetra_LinearProblem> problem;
    mutable std::unique_ptr<Amesos_BaseSolver>    solver;
  };
} // namespace mortise
