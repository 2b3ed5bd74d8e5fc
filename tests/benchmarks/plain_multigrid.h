// Multigrid in the degree as step-75 has it, for elasticity without a matrix.
#pragma once

#include <deal.II/base/subscriptor.h>

#include <deal.II/fe/mapping.h>

#include <deal.II/lac/diagonal_matrix.h>
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/lac/precondition.h>
#include <deal.II/lac/trilinos_precondition.h>

#include <deal.II/matrix_free/fe_evaluation.h>
#include <deal.II/matrix_free/matrix_free.h>
#include <deal.II/matrix_free/tools.h>

#include <deal.II/multigrid/mg_coarse.h>
#include <deal.II/multigrid/mg_matrix.h>
#include <deal.II/multigrid/mg_smoother.h>
#include <deal.II/multigrid/mg_transfer_global_coarsening.h>
#include <deal.II/multigrid/multigrid.h>

#include "plain_scene.h"

namespace plain
{
  /// Products with the stiffness; constrained dofs keep their values.
  template <typename Number>
  class InterfaceStiffness : public Subscriptor
  {
  public:
    using VectorType = LinearAlgebra::distributed::Vector<Number>;
    using value_type = Number;
    template <int p>
    using Evaluation = FEEvaluation<3, p, p + 1, 3, Number>;

    void
    reinit(const Mapping<3>                &mapping,
           const DoFHandler<3>             &dof_handler,
           const AffineConstraints<double> &constraints)
    {
      degree = dof_handler.get_fe().degree;
      typename MatrixFree<3, Number>::AdditionalData data;
      data.tasks_parallel_scheme =
        MatrixFree<3, Number>::AdditionalData::TasksParallelScheme::none;
      data.mapping_update_flags = update_gradients | update_JxW_values;
      matrix_free.reinit(
        mapping, dof_handler, constraints, QGauss<1>(degree + 1), data);
    }

    void
    initialize(VectorType &v) const
    {
      matrix_free.initialize_dof_vector(v);
    }

    types::global_dof_index
    m() const
    {
      return matrix_free.get_dof_handler().n_dofs();
    }

    Number
    el(unsigned int, unsigned int) const
    {
      AssertThrow(false, ExcNotImplemented());
      return 0;
    }

    void
    vmult(VectorType &dst, const VectorType &src) const
    {
      for_degree([&](const auto p) {
        matrix_free.cell_loop(
          &InterfaceStiffness::template add_cells<decltype(p)::value>,
          this,
          dst,
          src,
          true);
      });
      for (const unsigned int i : matrix_free.get_constrained_dofs())
        dst.local_element(i) = src.local_element(i);
    }

    void
    Tvmult(VectorType &dst, const VectorType &src) const
    {
      vmult(dst, src);
    }

    std::shared_ptr<DiagonalMatrix<VectorType>>
    inverse_diagonal() const
    {
      auto  result   = std::make_shared<DiagonalMatrix<VectorType>>();
      auto &diagonal = result->get_vector();
      initialize(diagonal);
      for_degree([&](const auto p) {
        using Phi = Evaluation<decltype(p)::value>;
        const std::function<void(Phi &)> product = [](Phi &phi) {
          phi.evaluate(EvaluationFlags::gradients);
          apply_law(phi);
          phi.integrate(EvaluationFlags::gradients);
        };
        MatrixFreeTools::compute_diagonal(matrix_free, diagonal, product);
      });
      for (const unsigned int i : matrix_free.get_constrained_dofs())
        diagonal.local_element(i) = 1;
      for (auto &d : diagonal)
        d = 1 / d;
      return result;
    }

  private:
    template <int p>
    void
    add_cells(const MatrixFree<3, Number>                 &data,
              VectorType                                  &dst,
              const VectorType                            &src,
              const std::pair<unsigned int, unsigned int> &range) const
    {
      Evaluation<p> phi(data);
      for (unsigned int cell = range.first; cell < range.second; ++cell)
        {
          phi.reinit(cell);
          phi.gather_evaluate(src, EvaluationFlags::gradients);
          apply_law(phi);
          phi.integrate_scatter(EvaluationFlags::gradients, dst);
        }
    }

    template <typename Phi>
    static void
    apply_law(Phi &phi)
    {
      for (unsigned int q = 0; q < phi.n_q_points; ++q)
        {
          auto       stress   = phi.get_symmetric_gradient(q);
          const auto pressure = Number(lame_lambda) * trace(stress);
          stress *= make_vectorized_array<Number>(2. * lame_mu);
          for (unsigned int d = 0; d < 3; ++d)
            stress[d][d] += pressure;
          phi.submit_symmetric_gradient(stress, q);
        }
    }

    /// Calls @p task with the degree as a constant.
    template <typename Task>
    void
    for_degree(const Task &task) const
    {
      switch (degree)
        {
          case 1:
            return task(std::integral_constant<int, 1>());
          case 2:
            return task(std::integral_constant<int, 2>());
          case 3:
            return task(std::integral_constant<int, 3>());
          case 4:
            return task(std::integral_constant<int, 4>());
          case 6:
            return task(std::integral_constant<int, 6>());
          default:
            AssertThrow(false, ExcMessage("degrees 1, 2, 3, 4 and 6"));
        }
    }

    MatrixFree<3, Number> matrix_free;
    unsigned int          degree = 0;
  };

  /// A V-cycle in single precision over spaces of falling degree.
  class DegreeMultigrid
  {
  public:
    using VectorType = LinearAlgebra::distributed::Vector<float>;
    using Smoother =
      PreconditionChebyshev<InterfaceStiffness<float>, VectorType>;
    using Transfer = MGTransferGlobalCoarsening<3, VectorType>;

    /// The finest of @p spaces first, all kept by reference.
    DegreeMultigrid(const Mapping<3>                        &mapping,
                    const std::vector<const Space *>        &spaces,
                    const TrilinosWrappers::PreconditionAMG &amg)
      : fine(spaces.front()->dof_handler)
      , matrices(0, spaces.size() - 1)
      , two_level(0, spaces.size() - 1)
      , coarse(amg)
    {
      const unsigned int                               top = spaces.size() - 1;
      MGLevelObject<typename Smoother::AdditionalData> smoothing(0, top);
      std::vector<AffineConstraints<float>>            constraints(top + 1);
      for (unsigned int l = 0; l <= top; ++l)
        {
          const Space &space = *spaces[top - l];
          constraints[l].copy_from(space.constraints);
          matrices[l].reinit(mapping, space.dof_handler, space.constraints);
          smoothing[l].preconditioner      = matrices[l].inverse_diagonal();
          smoothing[l].degree              = 4;
          smoothing[l].smoothing_range     = 20.;
          smoothing[l].eig_cg_n_iterations = 12;
          if (l > 0)
            two_level[l].reinit_polynomial_transfer(
              space.dof_handler,
              spaces[top - l + 1]->dof_handler,
              constraints[l],
              constraints[l - 1]);
        }
      smoother.initialize(matrices, smoothing);
      const auto initialize = [this](const unsigned int l, VectorType &v) {
        matrices[l].initialize(v);
      };
      transfer = std::make_unique<Transfer>(two_level, initialize);
      transfer->build(initialize);
      level_matrices.initialize(matrices);
      multigrid = std::make_unique<Multigrid<VectorType>>(
        level_matrices, coarse, *transfer, smoother, smoother);
      preconditioner =
        std::make_unique<PreconditionMG<3, VectorType, Transfer>>(fine,
                                                                  *multigrid,
                                                                  *transfer);
    }

    void
    vmult(LinearAlgebra::distributed::Vector<double>       &dst,
          const LinearAlgebra::distributed::Vector<double> &src) const
    {
      preconditioner->vmult(dst, src);
    }

  private:
    /// One cycle of algebraic multigrid, which is in double precision.
    class Coarse : public MGCoarseGridBase<VectorType>
    {
    public:
      explicit Coarse(const TrilinosWrappers::PreconditionAMG &amg)
        : amg(amg)
      {}

      void
      operator()(unsigned int,
                 VectorType       &dst,
                 const VectorType &src) const override
      {
        b.reinit(src, true);
        x.reinit(src, true);
        b.copy_locally_owned_data_from(src);
        amg.vmult(x, b);
        dst.copy_locally_owned_data_from(x);
      }

    private:
      const TrilinosWrappers::PreconditionAMG           &amg;
      mutable LinearAlgebra::distributed::Vector<double> x, b;
    };

    const DoFHandler<3>                             &fine;
    MGLevelObject<InterfaceStiffness<float>>         matrices;
    MGLevelObject<MGTwoLevelTransfer<3, VectorType>> two_level;
    Coarse                                           coarse;
    MGSmootherPrecondition<InterfaceStiffness<float>, Smoother, VectorType>
                                                             smoother;
    mg::Matrix<VectorType>                                   level_matrices;
    std::unique_ptr<Transfer>                                transfer;
    std::unique_ptr<Multigrid<VectorType>>                   multigrid;
    std::unique_ptr<PreconditionMG<3, VectorType, Transfer>> preconditioner;
  };
} // namespace plain
