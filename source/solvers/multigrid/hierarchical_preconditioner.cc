// See hierarchical_preconditioner.h.
#include <deal.II/base/mpi.h>

#include <EpetraExt_MatrixMatrix.h>
#include <mortise/solvers/epetra_tools.h>
#include <mortise/solvers/multigrid/block_smoother.h>
#include <mortise/solvers/multigrid/entity_graph.h>
#include <mortise/solvers/multigrid/hierarchical_preconditioner.h>
#include <mortise/solvers/multigrid/interface_lifting.h>
#include <mortise/solvers/multigrid/vertex_solver.h>

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
    using Sweep = BlockSmoother::Sweep;

    explicit Implementation(const BlockSystem &system)
      : bulk(system)
      , system(system)
      , x(system.owned_displacement, system.communicator)
      , r(x)
      , y(x)
      , multiplier(system.owned_multiplier, system.communicator)
      , carried(multiplier)
    {
      valid = coarse.initialize({system.vertex_dofs, system.vertex_points},
                                *bulk,
                                false);
      valid = smoother.initialize(*bulk, EntityGraph(system).patches(system)) &&
              valid;
      valid = Utilities::MPI::min(valid ? 1 : 0, system.communicator) == 1;
      if (valid && system.owned_multiplier.size() > 0)
        {
          lifting   = std::make_unique<InterfaceLifting>(system, smoother);
          valid     = lifting->is_valid();
          projector = std::make_unique<ConstraintProjector>(
            system,
            CouplingRows(system.coupling),
            *lifting);
        }
    }

    /// x += P S r, S a smoother or the solver for vertices: what satisfies the
    /// constraint stays so.
    template <typename Solve>
    void
    correct(const Solve &solve)
    {
      Epetra_Vector target = epetra_view(y);
      solve(target, epetra_view(r));
      if (projector)
        carried += projector->project(y);
      x += y;
    }

    void
    smooth(const Sweep direction)
    {
      correct([&](Epetra_Vector &to, const Epetra_Vector &from) {
        smoother.vmult(to, from, direction);
      });
    }

    /// r = P^T (b - A x).
    void
    compute_residual(const Vector &b)
    {
      Epetra_Vector target = epetra_view(r);
      (*bulk).Multiply(false, epetra_view(x), target);
      r.sadd(-1., b);
      if (projector)
        projector->project_residual(r, multiplier);
    }

    BulkMatrix                           bulk;
    BlockSmoother                        smoother;
    VertexSolver                         coarse;
    const BlockSystem                   &system;
    Vector                               x, r, y, multiplier, carried;
    std::unique_ptr<InterfaceLifting>    lifting;
    std::unique_ptr<ConstraintProjector> projector;
    bool                                 valid = true;
  };

  HierarchicalPreconditioner::HierarchicalPreconditioner()  = default;
  HierarchicalPreconditioner::~HierarchicalPreconditioner() = default;

  bool
  HierarchicalPreconditioner::initialize(const BlockSystem &system)
  {
    implementation = std::make_unique<Implementation>(system);
    return implementation->valid;
  }

  bool
  HierarchicalPreconditioner::update_active()
  {
    return initialize(implementation->system);
  }

  void
  HierarchicalPreconditioner::vmult(Vector &dst, const Vector &src) const
  {
    auto &data = *implementation;
    data.x     = 0.;
    data.r     = src;
    data.carried = 0.;
    if (data.system.has_springs())
      data.projector->project_residual(data.r, data.multiplier);
    data.smooth(BlockSmoother::Sweep::forward);
    data.compute_residual(src);
    data.correct([&](Epetra_Vector &to, const Epetra_Vector &from) {
      data.coarse.vmult(to, from);
    });
    data.compute_residual(src);
    data.smooth(BlockSmoother::Sweep::backward);
    dst = data.x;
    if (data.projector)
      data.projector->clear_ties(data.carried);
  }

  const Vector &
  HierarchicalPreconditioner::spring_multipliers() const
  {
    return implementation->carried;
  }

  const ConstraintProjector *
  HierarchicalPreconditioner::projector() const
  {
    return implementation->projector.get();
  }

  std::string
  HierarchicalPreconditioner::description() const
  {
    return "vertex stars, vertices " + implementation->coarse.description();
  }
} // namespace mortise
