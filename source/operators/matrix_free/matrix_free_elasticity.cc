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
    const PressureNodes               *pressures,
    const LawOfBody                   &laws)
  {
    std::string tangled;
    for (const Body *body : space.bodies())
      for (unsigned int element = 0; element < body->fe.size(); ++element)
        {
          std::string problem;
          groups.emplace_back(space,
                              *body,
                              element,
                              layout,
                              pressures,
                              laws ? laws(*body) : nullptr,
                              problem);
          if (tangled.empty())
            tangled = problem;
          std::unique_ptr<Kernel>    kernel;
          const CellBatches<Number> &cells = groups.back();
          if constexpr (std::is_same_v<Number, double>)
            if (!cells.pressure_nodes.empty())
              {
                AssertThrow(!cells.nonlinear,
                            ExcMessage("Mixed form knows linear laws alone."));
                kernel = cells.tetrahedra ? make_mixed_simplex_kernel(cells) :
                                            make_mixed_kernel(cells);
              }
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
  PointHistory<Number>
  MatrixFreeElasticity<Number>::no_history() const
  {
    PointHistory<Number> result(groups.size());
    for (unsigned int g = 0; g < groups.size(); ++g)
      if (groups[g].nonlinear)
        result[g].resize(groups[g].moduli.size() /
                         NonlinearLaw<Number>::n_moduli *
                         groups[g].nonlinear->n_history());
    return result;
  }

  template <typename Number>
  void
  MatrixFreeElasticity<Number>::add_residual(const Number               *u,
                                             const PointHistory<Number> &before,
                                             PointHistory<Number>       &after,
                                             Number *dst) const
  {
    for (unsigned int g = 0; g < groups.size(); ++g)
      kernels[g]->add_residual(
        groups[g], u, before[g].data(), after[g].data(), dst);
  }

  template <typename Number>
  void
  MatrixFreeElasticity<Number>::linearise(const Number               *u,
                                          const PointHistory<Number> &before)
  {
    for (unsigned int g = 0; g < groups.size(); ++g)
      kernels[g]->linearise(groups[g], u, before[g].data());
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
