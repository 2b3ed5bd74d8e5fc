#include <mortise/base/error.h>
#include <mortise/operators/matrix_free/hexahedra.h>
#include <mortise/operators/matrix_free/matrix_free_elasticity.h>
#include <mortise/operators/matrix_free/nonlinear_kernel_on.h>

namespace mortise
{
  using namespace dealii;

  template <typename Number>
  MatrixFreeElasticity<Number>::MatrixFreeElasticity(
    const NodalSpace                  &space,
    const Utilities::MPI::Partitioner &layout,
    const PressureNodes               *pressures)
  {
    std::string tangled;
    for (const Body *body : space.bodies())
      for (unsigned int element = 0; element < body->fe.size(); ++element)
        {
          std::string problem;
          groups.emplace_back(
            space, *body, element, layout, pressures, problem);
          if (tangled.empty())
            tangled = problem;
          std::unique_ptr<Kernel>    kernel;
          const CellBatches<Number> &cells = groups.back();
          if constexpr (std::is_same_v<Number, double>)
            if (!cells.pressure_nodes.empty())
              kernel = cells.tetrahedra ? make_mixed_simplex_kernel(cells) :
                                          make_mixed_kernel(cells);
          if (!kernel)
            kernel = cells.tetrahedra ? make_simplex_kernel(cells) :
                                        make_kernel(cells);
          kernels.push_back(std::move(kernel));
        }
    throw_if_any(tangled, layout.get_mpi_communicator());
  }

  template <typename Number>
  MatrixFreeElasticity<Number>::~MatrixFreeElasticity() = default;

  template <typename Number>
  void
  MatrixFreeElasticity<Number>::add_product(const Number *src,
                                            Number       *dst) const
  {
    for (unsigned int g = 0; g < groups.size(); ++g)
      kernels[g]->add_product(groups[g], src, dst);
  }

  template <typename Number>
  void
  MatrixFreeElasticity<Number>::add_diagonal(Number *dst) const
  {
    for (unsigned int g = 0; g < groups.size(); ++g)
      kernels[g]->add_diagonal(groups[g], dst);
  }

  template <typename Number>
  PointHistory
  MatrixFreeElasticity<Number>::no_history() const
  {
    PointHistory result(groups.size());
    for (unsigned int g = 0; g < groups.size(); ++g)
      if (const CellBatches<Number> &cells = groups[g]; cells.nonlinear)
        result[g].resize(std::size_t(cells.n_batches) * cells.n_points *
                         cells.nonlinear->n_history() * Batch<double>::size);
    return result;
  }

  template <typename Number>
  LeastJacobian
  MatrixFreeElasticity<Number>::add_residual(const Fields       &src,
                                             const PointHistory &before,
                                             PointHistory       &after,
                                             const Fields       &dst,
                                             const PointHistory &thermal) const
  {
    LeastJacobian least;
    for (unsigned int g = 0; g < groups.size(); ++g)
      {
        LeastJacobian of_group = kernels[g]->add_residual(
          groups[g], src, state_of(g, before, thermal), after[g].data(), dst);
        of_group.group = g;
        if (!(of_group.value >= least.value))
          least = of_group;
      }
    return least;
  }

  template <typename Number>
  void
  MatrixFreeElasticity<Number>::linearise(const Fields       &src,
                                          const PointHistory &before,
                                          const PointHistory &thermal,
                                          const Fields       &previous)
  {
    for (unsigned int g = 0; g < groups.size(); ++g)
      kernels[g]->linearise(groups[g],
                            src,
                            previous,
                            state_of(g, before, thermal));
  }

  template <typename Number>
  std::vector<std::vector<Moduli>>
  MatrixFreeElasticity<Number>::average_moduli(const bool initial_stress) const
  {
    std::vector<std::vector<Moduli>> result;
    for (unsigned int g = 0; g < groups.size(); ++g)
      result.push_back(kernels[g]->average_moduli(groups[g], initial_stress));
    return result;
  }

  template <typename Number>
  void
  MatrixFreeElasticity<Number>::add_mixed_product(const Fields &src,
                                                  const Fields &dst) const
  {
    for (unsigned int g = 0; g < groups.size(); ++g)
      kernels[g]->add_mixed_product(groups[g], src, dst);
  }

  template <typename Number>
  void
  MatrixFreeElasticity<Number>::add_pressure_force(const Number *p,
                                                   Number       *dst) const
  {
    for (unsigned int g = 0; g < groups.size(); ++g)
      kernels[g]->add_pressure_force(groups[g], p, dst);
  }

  template <typename Number>
  void
  MatrixFreeElasticity<Number>::add_pressure_norm(const Number *p,
                                                  Number       *dst) const
  {
    for (unsigned int g = 0; g < groups.size(); ++g)
      kernels[g]->add_pressure_norm(groups[g], p, dst);
  }

  template <typename Number>
  void
  MatrixFreeElasticity<Number>::add_pressure_norm_diagonal(Number *dst) const
  {
    for (unsigned int g = 0; g < groups.size(); ++g)
      kernels[g]->add_pressure_norm_diagonal(groups[g], dst);
  }

  template <typename Number>
  std::unique_ptr<typename MatrixFreeElasticity<Number>::Kernel>
  MatrixFreeElasticity<Number>::make_kernel(const CellBatches<Number> &cells)
  {
    return with_degree<1>(cells.degree, [&](const auto degree) {
      return make_kernel_on<Hexahedra<Number, degree + 1>>(cells);
    });
  }

  template class MatrixFreeElasticity<float>;
  template class MatrixFreeElasticity<double>;
} // namespace mortise
