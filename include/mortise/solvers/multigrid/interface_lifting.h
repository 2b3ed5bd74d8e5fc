// How a multiplier moves displacements cheaply: exact solves on the patches
// around the vertices of the interface. Projector and Schur complement of the
// solvers are made of it.
#pragma once

#include <mortise/operators/block_system.h>
#include <mortise/solvers/interface/lifting.h>
#include <mortise/solvers/multigrid/block_smoother.h>

#include <memory>
#include <vector>

namespace mortise
{
  /// T = sum over the patches p that hold interface dofs of R_p^T A_p^{-1} R_p
  /// with A = K + J.
  class InterfaceLifting : public Lifting
  {
  public:
    /// @p smoother holds the patches of A and must stay alive. Collective.
    InterfaceLifting(const BlockSystem &system, const BlockSmoother &smoother);

    void
    vmult(Vector &dst, const Vector &src) const override;

  private:
    /// The columns of B that a patch touches.
    struct PatchCoupling
    {
      unsigned int     block; ///< of the smoother
      std::vector<int> dofs;  ///< positions in the block
      std::vector<dealii::types::global_dof_index> multipliers; ///< sorted
      std::vector<double> values; ///< multipliers x dofs, column major
    };

    PatchCoupling
    couple(unsigned int block, const Epetra_CrsMatrix &transposed) const;
    void
    select(std::vector<PatchCoupling> &patches,
           const BlockSystem          &system) const;
    void
    assemble(const std::vector<PatchCoupling> &patches,
             const BlockSystem                &system);

    const BlockSmoother      &smoother;
    std::vector<unsigned int> blocks; ///< that take part
  };
} // namespace mortise
