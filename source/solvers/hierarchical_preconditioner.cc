// See hierarchical_preconditioner.h.
#include <deal.II/base/mpi.h>

#include <EpetraExt_MatrixMatrix.h>
#include <mortise/solvers/block_smoother.h>
#include <mortise/solvers/entity_graph.h>
#include <mortise/solvers/epetra_tools.h>
#include <mortise/solvers/hierarchical_preconditioner.h>
#include <mortise/solvers/interface_lifting.h>
#include <mortise/solvers/vertex_solver.h>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// K + J; K itself without an interface.
    class BulkMatrix
    {
    public:
      explicit BulkMatrix(const BlockSystem &system)
        : matrix(&system.stiffness.trilinos_matrix())
      {
        if (system.owned_multiplier.size() == 0)
          return;
        Epetra_CrsMatrix *result = nullptr;
        EpetraExt::MatrixMatrix::Add(*matrix,
                                     false,
                                     1.,
                                     system.jump_penalty.trilinos_matrix(),
                                     false,
                                     1.,
                                     result);
        sum.reset(result);
        sum->FillComplete(matrix->DomainMap(), matrix->RangeMap());
        sum->OptimizeStorage();
        matrix = sum.get();
      }

      const Epetra_CrsMatrix &
      operator*() const
      {
        return *matrix;
      }

    private:
      const Epetra_CrsMatrix           *matrix;
      std::unique_ptr<Epetra_CrsMatrix> sum;
    };
  } // namespace

  struct HierarchicalPreconditioner::Implementation
  {
    explicit Implementation(const BlockSystem &system)
      : bulk(system)
      , r((*bulk).RowMap())
      , t(r)
      , y(r)
      , has_high_modes(system.max_degree > 1)
    {
      valid = coarse.initialize(
        {system.vertex_dofs, system.vertex_points, system.communicator}, *bulk);
      if (has_high_modes || system.owned_multiplier.size() > 0)
        valid =
          smoother.initialize(*bulk, EntityGraph(system).patches(system)) &&
          valid;
      valid = Utilities::MPI::min(valid ? 1 : 0, system.communicator) == 1;
      if (valid && system.owned_multiplier.size() > 0)
        {
          lifting = std::make_unique<InterfaceLifting>(system, smoother);
          valid   = lifting->is_valid();
        }
    }

    BulkMatrix                        bulk;
    BlockSmoother                     smoother;
    VertexSolver                      coarse;
    mutable Epetra_Vector             r, t, y;
    std::unique_ptr<InterfaceLifting> lifting;
    bool                              has_high_modes;
    bool                              valid = true;
  };

  HierarchicalPreconditioner::HierarchicalPreconditioner()  = default;
  HierarchicalPreconditioner::~HierarchicalPreconditioner() = default;

  bool
  HierarchicalPreconditioner::initialize(const BlockSystem &system)
  {
    implementation = std::make_unique<Implementation>(system);
    return implementation->valid;
  }

  void
  HierarchicalPreconditioner::vmult(Vector &dst, const Vector &src) const
  {
    const auto   &data   = *implementation;
    const auto   &matrix = *data.bulk;
    Epetra_Vector x      = epetra_view(dst);
    data.r               = *src.trilinos_vector()(0);

    // Q + (I - Q A) M (I - A Q), positive definite for any positive definite M
    // and any positive semi-definite Q, exact or not (Tang, Nabben, Vuik and
    // Erlangga 2009, "BNN").
    data.coarse.vmult(x, data.r);
    if (data.has_high_modes)
      {
        matrix.Multiply(false, x, data.t);
        data.r.Update(-1., data.t, 1.);
        data.smoother.vmult(data.y, data.r);
        x.Update(1., data.y, 1.);
        matrix.Multiply(false, data.y, data.t);
        data.coarse.vmult(data.y, data.t);
        x.Update(-1., data.y, 1.);
      }
  }

  const Lifting *
  HierarchicalPreconditioner::lifting() const
  {
    return implementation->lifting.get();
  }

  std::string
  HierarchicalPreconditioner::description() const
  {
    return (implementation->has_high_modes ? "vertex stars, " : "") +
           implementation->coarse.description();
  }
} // namespace mortise
