// Matrices of single cells from the products of MatrixFreeElasticity.
#include <mortise/operators/matrix_free/matrix_free_kernel.h>
#include <mortise/operators/matrix_free/tensor_kernel.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    template <typename Number>
    unsigned int
    n_pressure_nodes(const CellBatches<Number> &cells)
    {
      return cells.n_batches == 0 ? 0 :
                                    cells.pressure_nodes.size() /
                                      (cells.n_batches * Batch<Number>::size);
    }

    /// @p batch of @p cells alone, with vectors that have the values of each
    /// lane one after the other.
    template <typename Number>
    CellBatches<Number>
    single_batch(const CellBatches<Number> &cells, const unsigned int batch)
    {
      constexpr unsigned int width = Batch<Number>::size;
      const unsigned int     n_p   = n_pressure_nodes(cells);
      CellBatches<Number>    one;
      one.tetrahedra      = cells.tetrahedra;
      one.degree          = cells.degree;
      one.n_nodes         = cells.n_nodes;
      one.n_points        = cells.n_points;
      one.law             = cells.law;
      one.compressibility = cells.compressibility;
      one.pressure_norm   = cells.pressure_norm;
      one.n_batches       = 1;
      one.n_cells         = cells.lanes(batch);
      one.n_affine        = batch < cells.n_affine ? 1 : 0;
      one.n_affine_cells  = one.n_affine * one.n_cells;
      one.nodes.resize(cells.n_nodes * width);
      one.pressure_nodes.resize(n_p * width);
      for (unsigned int lane = 0; lane < width; ++lane)
        {
          for (unsigned int i = 0; i < cells.n_nodes; ++i)
            one.nodes[i * width + lane] = dim * (lane * cells.n_nodes + i);
          for (unsigned int k = 0; k < n_p; ++k)
            one.pressure_nodes[k * width + lane] = lane * n_p + k;
        }
      one.metric.resize((one.n_affine == 1 ? 1 : cells.n_points) * dim * dim *
                        width);
      std::copy_n(cells.metric_of(batch),
                  one.metric.size(),
                  one.metric.begin());
      return one;
    }
  } // namespace

  template <typename Number>
  void
  MatrixFreeElasticity<Number>::visit_batch(
    const CellBatches<Number>                     &cells,
    const unsigned int                             batch,
    const std::vector<FullMatrix<double>>         *matrices,
    const std::function<void(const CellMatrix &)> &visit) const
  {
    constexpr unsigned int width = Batch<Number>::size;
    const unsigned int     n_p   = n_pressure_nodes(cells);
    for (unsigned int lane = 0; lane < cells.lanes(batch); ++lane)
      {
        CellMatrix cell;
        for (unsigned int i = 0; i < cells.n_nodes; ++i)
          for (unsigned int c = 0; c < dim; ++c)
            cell.displacements.push_back(
              cells.nodes[(std::size_t(batch) * cells.n_nodes + i) * width +
                          lane] +
              c);
        for (unsigned int k = 0; k < n_p; ++k)
          cell.pressures.push_back(
            cells.pressure_nodes[(std::size_t(batch) * n_p + k) * width +
                                 lane]);
        if (matrices != nullptr)
          cell.matrix = (*matrices)[lane];
        visit(cell);
      }
  }

  template <typename Number>
  void
  MatrixFreeElasticity<Number>::for_each_cell(
    const std::function<void(const CellMatrix &)> &visit) const
  {
    for (const CellBatches<Number> &cells : groups)
      for (unsigned int batch = 0; batch < cells.n_batches; ++batch)
        visit_batch(cells, batch, nullptr, visit);
  }

  template <typename Number>
  void
  MatrixFreeElasticity<Number>::for_each_cell_matrix(
    const std::function<void(const CellMatrix &)> &visit) const
  {
    constexpr unsigned int width = Batch<Number>::size;
    for (unsigned int g = 0; g < groups.size(); ++g)
      {
        const CellBatches<Number> &cells = groups[g];
        const unsigned int n_u = dim * cells.n_nodes,
                           n_p = n_pressure_nodes(cells), n = n_u + n_p;
        std::vector<FullMatrix<double>> matrices(width,
                                                 FullMatrix<double>(n));
        AlignedVector<Number> u(width * n_u), p(width * n_p), r_u(u), r_p(p);
        for (unsigned int batch = 0; batch < cells.n_batches; ++batch)
          {
            const CellBatches<Number> one = single_batch(cells, batch);
            for (unsigned int j = 0; j < n; ++j)
              {
                const auto set_unit = [&](const Number value) {
                  for (unsigned int lane = 0; lane < width; ++lane)
                    if (j < n_u)
                      u[lane * n_u + j] = value;
                    else
                      p[lane * n_p + j - n_u] = value;
                };
                set_unit(1.);
                r_u.fill(Number());
                r_p.fill(Number());
                if (mixed[g])
                  mixed[g]->add_mixed_product(one,
                                              {u.data(), p.data()},
                                              {r_u.data(), r_p.data()});
                else
                  kernels[g]->add_product(one, u.data(), r_u.data());
                set_unit(0.);
                for (unsigned int lane = 0; lane < width; ++lane)
                  {
                    for (unsigned int i = 0; i < n_u; ++i)
                      matrices[lane](i, j) = r_u[lane * n_u + i];
                    for (unsigned int k = 0; k < n_p; ++k)
                      matrices[lane](n_u + k, j) = r_p[lane * n_p + k];
                  }
              }
            visit_batch(cells, batch, &matrices, visit);
          }
      }
  }

  template void
  MatrixFreeElasticity<double>::visit_batch(
    const CellBatches<double> &,
    unsigned int,
    const std::vector<FullMatrix<double>> *,
    const std::function<void(const CellMatrix &)> &) const;
  template void
  MatrixFreeElasticity<double>::for_each_cell(
    const std::function<void(const CellMatrix &)> &) const;
  template void
  MatrixFreeElasticity<double>::for_each_cell_matrix(
    const std::function<void(const CellMatrix &)> &) const;
} // namespace mortise
