// What iterative solvers ask of a preconditioner of the bulk, whatever it is
// made of. It never looks at the multipliers.
#pragma once

#include <mortise/operators/block_system.h>

#include <memory>
#include <string>

namespace mortise
{
  /// How a multiplier moves displacements cheaply: T symmetric, positive
  /// semi-definite and positive on the range of B^T. Projector and Schur
  /// complement of the solvers are made of it.
  class Lifting
  {
  public:
    virtual ~Lifting() = default;

    /// C = B T B^T, sparse, with the rows of B.
    virtual const Epetra_CrsMatrix &
    schur_complement() const = 0;

    /// dst = T src. Collective.
    virtual void
    vmult(Vector &dst, const Vector &src) const = 0;
  };

  /// An approximate inverse of the elasticity block A = K + J, symmetric and
  /// positive definite, hence usable in conjugate gradients and GMRES.
  class BulkPreconditioner
  {
  public:
    virtual ~BulkPreconditioner() = default;

    /// Build for A = K + J of @p system (A = K without an interface). Collective. False, on every
    /// rank, when A turned out not to be positive definite; nothing else may be
    /// called then.
    virtual bool
    initialize(const BlockSystem &system) = 0;

    /// dst = A^{-1} src, approximately; dst and src are distinct. Collective.
    virtual void
    vmult(Vector &dst, const Vector &src) const = 0;

    /// Only with an interface; the preconditioner and @p system must stay
    /// alive. Collective.
    virtual std::unique_ptr<Lifting>
    make_lifting(const BlockSystem &system) const = 0;

    /// What was built, in words.
    virtual std::string
    description() const = 0;
  };

  /// The one that suits the form in which @p system has K, not initialized.
  std::unique_ptr<BulkPreconditioner>
  make_bulk_preconditioner(const BlockSystem &system);
} // namespace mortise
