// See vertex_solver.h.
#include <deal.II/base/mpi.h>

#include <Teuchos_ParameterList.hpp>
#include <ml_MultiLevelPreconditioner.h>
#include <mortise/solvers/epetra_tools.h>
#include <mortise/solvers/multigrid/vertex_solver.h>

#include <cmath>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Up to this many dofs a factorisation costs no more than the additional
    /// iterations of multigrid (measured at 11,718: 1.5 s against 0.7 s, but 14
    /// iterations against 24).
    constexpr int max_direct_size = 20000;
  } // namespace

  VertexSolver::VertexSolver()  = default;
  VertexSolver::~VertexSolver() = default;

  bool
  VertexSolver::initialize(std::unique_ptr<Epetra_CrsMatrix> matrix,
                           const std::vector<Point<dim>>    &points,
                           const bool                        allow_single)
  {
    coarse = std::move(matrix);
    if (coarse->NumGlobalRows() <= max_direct_size)
      {
        factorisation    = std::make_unique<CholeskyInverse<float>>();
        const bool valid = factorisation->initialize(
          rows_as_nodes(*coarse),
          [this](Epetra_Vector &y, const Epetra_Vector &x) {
            coarse->Multiply(false, x, y);
          },
          coarse->RowMap(),
          allow_single);
        coarse.reset();
        return valid;
      }
    compute_rigid_modes(points);
    Teuchos::ParameterList parameters;
    ML_Epetra::SetDefaults("SA", parameters);
    parameters.set("ML output", 0);
    parameters.set("PDE equations", static_cast<int>(dim));
    parameters.set("null space: type", "pre-computed");
    parameters.set("null space: dimension", 6);
    parameters.set("null space: vectors", rigid_modes.data());
    parameters.set("null space: add default vectors", false);
    parameters.set("aggregation: type", "Uncoupled");
    parameters.set("aggregation: threshold", 0.01);
    // Iterations of conjugate gradients at 11,718 dofs, Poisson's ratio 0.3:
    // Chebyshev of degree 2: 40, of degree 4: 28; block Gauss-Seidel, one
    // sweep: 27, two: 24.
    parameters.set("smoother: type", "symmetric block Gauss-Seidel");
    parameters.set("smoother: sweeps", 2);
    parameters.set("smoother: damping factor", 1.);
    parameters.set("smoother: pre or post", "both");
    parameters.set("cycle applications", 2);
    parameters.set("coarse: type", "Amesos-KLU");
    parameters.set("coarse: max size", 1000);
    multigrid =
      std::make_unique<ML_Epetra::MultiLevelPreconditioner>(*coarse,
                                                            parameters,
                                                            true);
    return multigrid->IsPreconditionerComputed();
  }

  void
  VertexSolver::compute_rigid_modes(const std::vector<Point<dim>> &points)
  {
    const MPI_Comm comm = communicator(coarse->RowMap());
    Point<dim>     center;
    for (const auto &x : points)
      center += x;
    const unsigned int n_points =
      Utilities::MPI::sum<unsigned int>(points.size(), comm);
    for (unsigned int d = 0; d < dim; ++d)
      center[d] = Utilities::MPI::sum(center[d], comm) / n_points;
    double radius = 0.;
    for (const auto &x : points)
      radius = std::max(radius, x.distance(center));
    radius = Utilities::MPI::max(radius, comm);

    const unsigned int n = coarse->NumMyRows();
    rigid_modes.assign(std::max(1U, 6 * n), 0.);
    for (unsigned int v = 0; v < n / 3; ++v)
      {
        const Tensor<1, dim> x = (points[v] - center) / radius;
        for (unsigned int d = 0; d < dim; ++d)
          {
            rigid_modes[d * n + 3 * v + d] = 1.;
            // rotation about axis d
            rigid_modes[(3 + d) * n + 3 * v + (d + 1) % 3] = -x[(d + 2) % 3];
            rigid_modes[(3 + d) * n + 3 * v + (d + 2) % 3] = x[(d + 1) % 3];
          }
      }
    // A constrained dof has nothing but its diagonal: no mode lives there.
    for (unsigned int i = 0; i < n; ++i)
      {
        int     length;
        int    *columns;
        double *values;
        coarse->ExtractMyRowView(i, length, values, columns);
        bool alone = true;
        for (int k = 0; k < length; ++k)
          alone =
            alone && (columns[k] == static_cast<int>(i) || values[k] == 0.);
        if (alone)
          for (unsigned int mode = 0; mode < 6; ++mode)
            rigid_modes[mode * n + i] = 0.;
      }
  }

  void
  VertexSolver::vmult(Epetra_Vector &x, const Epetra_Vector &r) const
  {
    if (factorisation)
      factorisation->solve(x, r);
    else
      multigrid->ApplyInverse(r, x);
  }

  std::string
  VertexSolver::description() const
  {
    return factorisation ? "factorised" : "by smoothed aggregation (ML)";
  }
} // namespace mortise
