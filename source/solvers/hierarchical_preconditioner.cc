// See hierarchical_preconditioner.h.
#include <mortise/solvers/block_smoother.h>
#include <mortise/solvers/entity_graph.h>
#include <mortise/solvers/hierarchical_preconditioner.h>
#include <mortise/solvers/interior_condensation.h>
#include <mortise/solvers/vertex_solver.h>

#include <deal.II/base/mpi.h>

namespace mortise
{
  using namespace dealii;

  struct HierarchicalPreconditioner::Implementation
  {
    Implementation(const BlockSystem &system, const EntityGraph &graph)
      : condensation(system, graph)
      , r(condensation.schur_complement().RowMap())
      , t(r)
      , x(r)
      , y(r)
      , has_high_modes(system.max_degree > 1)
    {
      const auto &schur = condensation.schur_complement();
      valid             = coarse.initialize(system, schur) && condensation.is_valid();
      if (has_high_modes && condensation.is_valid())
        valid = smoother.initialize(schur, graph.patches(system)) && valid;
      valid = Utilities::MPI::min(valid ? 1 : 0, system.communicator) == 1;
    }

    InteriorCondensation  condensation;
    BlockSmoother         smoother;
    VertexSolver          coarse;
    mutable Epetra_Vector r, t, x, y; ///< on the rows of the Schur complement
    bool                  has_high_modes;
    bool                  valid = true;
  };

  HierarchicalPreconditioner::HierarchicalPreconditioner()  = default;
  HierarchicalPreconditioner::~HierarchicalPreconditioner() = default;

  bool
  HierarchicalPreconditioner::initialize(const BlockSystem &system)
  {
    implementation = std::make_unique<Implementation>(system, EntityGraph(system));
    return implementation->valid;
  }

  void
  HierarchicalPreconditioner::vmult(Vector &dst, const Vector &src) const
  {
    const auto   &data  = *implementation;
    const auto   &schur = data.condensation.schur_complement();
    const double *r     = src.trilinos_vector()[0];

    // On S: Q + (I - Q S) M (I - S Q), positive definite for any positive definite M and any
    // positive semi-definite Q, exact or not (Tang, Nabben, Vuik and Erlangga 2009, "BNN").
    data.condensation.restrict_residual(data.r, r);
    data.coarse.vmult(data.x, data.r);
    if (data.has_high_modes)
      {
        schur.Multiply(false, data.x, data.t);
        data.r.Update(-1., data.t, 1.);
        data.smoother.vmult(data.y, data.r);
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
    return (implementation->has_high_modes ? "interiors condensed, vertex stars, " : "") +
           implementation->coarse.description();
  }
} // namespace mortise

