#include <mortise/solvers/multigrid/bulk_preconditioner.h>
#include <mortise/solvers/multigrid/degree_multigrid.h>
#include <mortise/solvers/multigrid/hierarchical_preconditioner.h>

namespace mortise
{
  std::unique_ptr<BulkPreconditioner>
  make_bulk_preconditioner(const BlockSystem   &system,
                           const SolverOptions &options)
  {
    if (system.nodal)
      return std::make_unique<DegreeMultigrid>(options.max_gathered);
    return std::make_unique<HierarchicalPreconditioner>();
  }
} // namespace mortise
