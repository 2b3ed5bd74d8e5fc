// Prolongation and restriction between two degrees on the same mesh.
#pragma once

#include <mortise/operators/levels/multigrid_level.h>

#include <memory>
#include <vector>

namespace mortise
{
  template <typename Number>
  class DegreeTransfer
  {
  public:
    /// Both operators must stay alive. Collective.
    DegreeTransfer(const LevelOperator<Number> &fine,
                   const LevelOperator<Number> &coarse);
    ~DegreeTransfer();

    /// fine += P coarse. Collective.
    void
    prolongate_add(LevelVector<Number>       &fine,
                   const LevelVector<Number> &coarse) const;

    /// coarse = P^T fine. Collective.
    void
    restrict_to(LevelVector<Number>       &coarse,
                const LevelVector<Number> &fine) const;

  private:
    class Kernel; ///< between two degrees
    template <unsigned int fine_degree>
    class KernelOfDegree; ///< to lower_degree()
    class SimplexKernel;

    static std::unique_ptr<Kernel>
    make_kernel(unsigned int fine_degree);

    const LevelOperator<Number>         &fine, &coarse;
    std::vector<std::unique_ptr<Kernel>> kernels; ///< by group of cells
    /// One over the number of cells that have a node of the fine level.
    LevelVector<Number>         weights;
    mutable LevelVector<Number> weighted;
  };
} // namespace mortise
