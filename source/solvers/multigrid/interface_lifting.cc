// See interface_lifting.h.
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <Teuchos_BLAS.hpp>
#include <mortise/solvers/epetra_tools.h>
#include <mortise/solvers/multigrid/interface_lifting.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// A patch of a much coarser side couples more multipliers than it has dofs
    /// to follow them: the other side does better and keeps C sparse. These
    /// bounds leave ratios of size up to eight alone.
    constexpr std::size_t always_allowed      = 1000;
    constexpr std::size_t multipliers_per_dof = 4;
  } // namespace

  InterfaceLifting::InterfaceLifting(const BlockSystem   &system,
                                     const BlockSmoother &smoother)
    : Lifting(system)
    , smoother(smoother)
  {
    const auto transposed =
      transpose(system.coupling.by_displacement(),
                system.stiffness.trilinos_matrix().RowMap());
    std::unique_ptr<Epetra_CrsMatrix> imported;
    if (smoother.importer() != nullptr)
      {
        imported = std::make_unique<Epetra_CrsMatrix>(Copy, smoother.map(), 0);
        imported->Import(*transposed, *smoother.importer(), Insert);
        imported->FillComplete(transposed->DomainMap(), transposed->RangeMap());
      }
    std::vector<PatchCoupling> patches;
    for (unsigned int b = 0; b < smoother.blocks().size(); ++b)
      {
        PatchCoupling patch = couple(b, imported ? *imported : *transposed);
        if (!patch.dofs.empty())
          patches.push_back(std::move(patch));
      }
    select(patches, system);
    for (const PatchCoupling &patch : patches)
      blocks.push_back(patch.block);
    assemble(patches, system);
  }

  InterfaceLifting::PatchCoupling
  InterfaceLifting::couple(const unsigned int      block,
                           const Epetra_CrsMatrix &transposed) const
  {
    PatchCoupling patch;
    patch.block      = block;
    const auto &rows = smoother.blocks()[block].rows;
    const auto  gid  = [&](const int column) {
      return static_cast<types::global_dof_index>(
        transposed.ColMap().GID(column));
    };
    for (unsigned int i = 0; i < rows.size(); ++i)
      {
        const EpetraRow row(transposed, rows[i]);
        const auto      before = patch.multipliers.size();
        for (int k = 0; k < row.length; ++k)
          if (row.values[k] != 0.)
            patch.multipliers.push_back(gid(row.columns[k]));
        if (patch.multipliers.size() > before)
          patch.dofs.push_back(static_cast<int>(i));
      }
    std::sort(patch.multipliers.begin(), patch.multipliers.end());
    patch.multipliers.erase(std::unique(patch.multipliers.begin(),
                                        patch.multipliers.end()),
                            patch.multipliers.end());
    const std::size_t n = patch.multipliers.size();
    patch.values.assign(n * patch.dofs.size(), 0.);
    for (unsigned int j = 0; j < patch.dofs.size(); ++j)
      {
        const EpetraRow row(transposed, rows[patch.dofs[j]]);
        for (int k = 0; k < row.length; ++k)
          if (row.values[k] != 0.)
            patch.values[j * n + (std::lower_bound(patch.multipliers.begin(),
                                                   patch.multipliers.end(),
                                                   gid(row.columns[k])) -
                                  patch.multipliers.begin())] = row.values[k];
      }
    return patch;
  }

  void
  InterfaceLifting::select(std::vector<PatchCoupling> &patches,
                           const BlockSystem          &system) const
  {
    const auto is_light = [&](const PatchCoupling &patch) {
      return patch.multipliers.size() <=
             std::max(always_allowed, multipliers_per_dof * patch.dofs.size());
    };
    // A multiplier that only heavy patches can follow keeps these.
    IndexSet touched(system.owned_multiplier.size());
    for (const PatchCoupling &patch : patches)
      touched.add_indices(patch.multipliers.begin(), patch.multipliers.end());
    touched.compress();
    Vector light;
    light.reinit(system.owned_multiplier, touched, system.communicator, true);
    for (const PatchCoupling &patch : patches)
      if (is_light(patch))
        for (const auto k : patch.multipliers)
          light(k) += 1.;
    light.compress(VectorOperation::add);
    Vector known(system.owned_multiplier, touched, system.communicator);
    known = light;
    patches.erase(std::remove_if(patches.begin(),
                                 patches.end(),
                                 [&](const PatchCoupling &patch) {
                                   return !is_light(patch) &&
                                          std::all_of(patch.multipliers.begin(),
                                                      patch.multipliers.end(),
                                                      [&](const auto k) {
                                                        return known(k) > 0.;
                                                      });
                                 }),
                  patches.end());
  }

  void
  InterfaceLifting::assemble(const std::vector<PatchCoupling> &patches,
                             const BlockSystem                &system)
  {
    IndexSet rows = system.owned_multiplier;
    for (const PatchCoupling &patch : patches)
      rows.add_indices(patch.multipliers.begin(), patch.multipliers.end());
    rows.compress();
    DynamicSparsityPattern sparsity(rows.size(), rows.size(), rows);
    for (const PatchCoupling &patch : patches)
      for (const auto k : patch.multipliers)
        sparsity.add_entries(k,
                             patch.multipliers.begin(),
                             patch.multipliers.end(),
                             true);
    if (system.has_springs())
      for (const auto row : system.owned_multiplier)
        {
          const auto &S = system.spring_compliance.trilinos_matrix();
          const EpetraRow opening(S, S.LRID(static_cast<int>(row)));
          for (int k = 0; k < opening.length; ++k)
            sparsity.add(row, S.GCID(opening.columns[k]));
        }
    SparseMatrix schur;
    schur.reinit(system.owned_multiplier,
                 system.owned_multiplier,
                 sparsity,
                 system.communicator,
                 true);

    const Teuchos::BLAS<int, double> blas;
    std::vector<double>              inverse, product;
    FullMatrix<double>               local;
    for (const PatchCoupling &patch : patches)
      {
        const auto &block = smoother.blocks()[patch.block];
        const int   n     = static_cast<int>(block.rows.size()),
                  m       = static_cast<int>(patch.dofs.size()),
                  l       = static_cast<int>(patch.multipliers.size());
        inverse.resize(static_cast<std::size_t>(m) * m);
        product.resize(static_cast<std::size_t>(l) * m);
        local.reinit(l, l, true);
        for (int j = 0; j < m; ++j)
          for (int i = 0; i < m; ++i)
            inverse[i + j * m] =
              block.inverse[patch.dofs[i] +
                            static_cast<std::size_t>(patch.dofs[j]) * n];
        using namespace Teuchos;
        blas.GEMM(NO_TRANS,
                  NO_TRANS,
                  l,
                  m,
                  m,
                  1.,
                  patch.values.data(),
                  l,
                  inverse.data(),
                  m,
                  0.,
                  product.data(),
                  l);
        blas.GEMM(NO_TRANS,
                  TRANS,
                  l,
                  l,
                  m,
                  1.,
                  product.data(),
                  l,
                  patch.values.data(),
                  l,
                  0.,
                  &local(0, 0),
                  l);
        schur.add(patch.multipliers, local, false);
      }
    if (system.has_springs())
      for (const auto row : system.owned_multiplier)
        {
          const auto &S = system.spring_compliance.trilinos_matrix();
          const EpetraRow opening(S, S.LRID(static_cast<int>(row)));
          for (int k = 0; k < opening.length; ++k)
            schur.add(row, S.GCID(opening.columns[k]), opening.values[k]);
        }
    schur.compress(VectorOperation::add);
    if (!system.active)
      factorise(schur.trilinos_matrix());
    else
      {
        const Epetra_Comm &comm = schur.trilinos_matrix().Comm();
        factorise(*as_matrix(mortise::select(rows_as_nodes(schur.trilinos_matrix()),
                                    *system.active,
                                    comm),
                             comm));
      }
  }

  void
  InterfaceLifting::vmult(Vector &dst, const Vector &src) const
  {
    const Epetra_BlockMap &map = src.trilinos_partitioner();
    Epetra_Vector          x(View, map, dst.trilinos_vector()[0]);
    const Epetra_Vector    r(View, map, src.trilinos_vector()[0]);
    smoother.solve_blocks(x, r, blocks);
  }
} // namespace mortise
