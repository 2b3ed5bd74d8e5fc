// See hierarchical_preconditioner.h.
#include <mortise/solvers/block_smoother.h>
#include <mortise/solvers/hierarchical_preconditioner.h>
#include <mortise/solvers/interior_condensation.h>
#include <mortise/solvers/vertex_solver.h>

namespace mortise
{
  struct HierarchicalPreconditioner::Implementation
  {
    explicit Implementation(const BlockSystem &system)
      : condensation(system)
      , r(condensation.schur_complement().RowMap())
      , t(r)
      , x(r)
      , y(r)
      , has_high_modes(system.max_degree > 1)
    {
      const auto &schur = condensation.schur_complement();
      coarse.initialize(system, schur);
      if (getenv("EXACT")) exact.initialize(schur, SparseFactorization::Kind::positive_definite);
      else if (has_high_modes)
        smoother.initialize(schur, condensation.remaining_blocks());
    }

    InteriorCondensation  condensation;
    BlockSmoother         smoother;
    SparseFactorization exact;
    VertexSolver          coarse;
    mutable Epetra_Vector r, t, x, y;
    bool                  has_high_modes;
  };

  HierarchicalPreconditioner::HierarchicalPreconditioner()  = default;
  HierarchicalPreconditioner::~HierarchicalPreconditioner() = default;

  void
  HierarchicalPreconditioner::initialize(const BlockSystem &system)
  {
    implementation = std::make_unique<Implementation>(system);
  }

  void
  HierarchicalPreconditioner::vmult(Vector &dst, const Vector &src) const
  {
    auto         &data  = *implementation;
    const auto   &schur = data.condensation.schur_complement();
    const double *r     = src.trilinos_vector()[0];

    // On S: Q + (I - Q S) M (I - S Q), positive definite for any positive definite M and any
    // positive semi-definite Q (Tang, Nabben, Vuik, Erlangga 2009: BNN).
    data.condensation.restrict_residual(data.r, r);
    if (getenv("EXACT")) data.exact.solve(data.x, data.r); else data.coarse.vmult(data.x, data.r);
    if (!getenv("EXACT") && data.has_high_modes)
      {
        schur.Multiply(false, data.x, data.t);
        data.r.Update(-1., data.t, 1.);
        data.smoother.vmult(data.y.Values(), data.r.Values());
        data.x.Update(1., data.y, 1.);
        schur.Multiply(false, data.y, data.t);
        data.coarse.vmult(data.y, data.t);
        data.x.Update(-1., data.y, 1.);
      }
    data.condensation.extend_solution(const_cast<double *>(dst.trilinos_vector()[0]), data.x, r);
  }

  std::string
  HierarchicalPreconditioner::description() const
  {
    return "hierarchical (" + implementation->coarse.description() + ")";
  }
} // namespace mortise
