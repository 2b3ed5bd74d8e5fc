// Matrices of single cells from the products of MatrixFreeElasticity.
#include <mortise/operators/matrix_free/matrix_free_kernel.h>
#include <mortise/operators/matrix_free/tensor_kernel.h>

#include <algorithm>
#include <functional>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// @p batch of @p cells alone, with vectors that have the values of each
    /// lane one after the other.
    template <typename Number>
    CellBatches<Number>
    single_batch(const CellBatches<Number> &cells, const unsigned int batch)
    {
      constexpr unsigned int width = Batch<Number>::size;
      const unsigned int     n_p   = cells.n_pressure_nodes;
      CellBatches<Number>    one;
      one.tetrahedra       = cells.tetrahedra;
      one.degree           = cells.degree;
      one.n_nodes          = cells.n_nodes;
      one.n_pressure_nodes = n_p;
      one.n_points         = cells.n_points;
      one.law              = cells.law;
      one.compressibility  = cells.compressibility;
      one.pressure_norm    = cells.pressure_norm;
      one.n_batches        = 1;
      one.n_cells          = cells.lanes(batch);
      one.n_affine         = batch < cells.n_affine ? 1 : 0;
      one.n_affine_cells   = one.n_affine * one.n_cells;
      one.nodes.resize(cells.n_nodes * width);
      one.pressure_nodes.resize(n_p * width);
      for (unsigned int lane = 0; lane < width; ++lane)
        {
          for (unsigned int i = 0; i < cells.n_nodes; ++i)
            one.nodes[i * width + lane] = dim * (lane * cells.n_nodes + i);
          for (unsigned int k = 0; k < n_p; ++k)
            one.pressure_nodes[k * width + lane] = lane * n_p + k;
        }
      one.nonlinear    = cells.nonlinear;
      const auto share = [&](const auto &all) {
        const std::size_t           n = all.size() / cells.n_batches;
        std::decay_t<decltype(all)> part(n);
        std::copy_n(all.begin() + batch * n, n, part.begin());
        return part;
      };
      one.tangent          = share(cells.tangent);
      one.finite_tangent   = share(cells.finite_tangent);
      one.pressure_tangent = share(cells.pressure_tangent);
      one.deformed_metric  = share(cells.deformed_metric);
      one.metric.resize((one.n_affine == 1 ? 1 : cells.n_points) * dim * dim *
                        width);
      std::copy_n(cells.metric_of(batch),
                  one.metric.size(),
                  one.metric.begin());
      return one;
    }

    /// Columns of @p matrices, by lane, from products with unit vectors:
    /// @p product sets the first entries of a column from the first unknowns, the
    /// rest from the rest.
    template <typename Number, typename Product>
    void
    fill_columns(const unsigned int                       n_first,
                 const unsigned int                       n_rest,
                 const Product                           &product,
                 const std::vector<FullMatrix<double> *> &matrices)
    {
      constexpr unsigned int width = Batch<Number>::size;
      AlignedVector<Number>  u(width * n_first), p(width * n_rest), of_u(u),
        of_p(p);
      for (unsigned int j = 0; j < n_first + n_rest; ++j)
        {
          const auto set_unit = [&](const Number value) {
            for (unsigned int lane = 0; lane < width; ++lane)
              if (j < n_first)
                u[lane * n_first + j] = value;
              else
                p[lane * n_rest + j - n_first] = value;
          };
          set_unit(1.);
          of_u.fill(Number());
          of_p.fill(Number());
          product(u.data(), p.data(), of_u.data(), of_p.data());
          set_unit(0.);
          for (unsigned int lane = 0; lane < width; ++lane)
            {
              for (unsigned int i = 0; i < n_first; ++i)
                (*matrices[lane])(i, j) = of_u[lane * n_first + i];
              for (unsigned int k = 0; k < n_rest; ++k)
                (*matrices[lane])(n_first + k, j) = of_p[lane * n_rest + k];
            }
        }
    }
  } // namespace

  template <typename Number>
  std::vector<typename MatrixFreeElasticity<Number>::CellMatrix>
  MatrixFreeElasticity<Number>::batch_matrices(const unsigned int g,
                                               const unsigned int batch) const
  {
    const CellBatches<Number> one = single_batch(groups[g], batch);
    const unsigned int      n_u = dim * one.n_nodes, n_p = one.n_pressure_nodes;
    std::vector<CellMatrix> result(Batch<Number>::size);
    std::vector<FullMatrix<double> *> systems, norms;
    for (CellMatrix &cell : result)
      {
        cell.mixed.reinit(n_u + n_p, n_u + n_p);
        cell.pressure_norm.reinit(n_p, n_p);
        systems.push_back(&cell.mixed);
        norms.push_back(&cell.pressure_norm);
      }
    fill_columns<Number>(
      n_u,
      n_p,
      [&](Number *u, Number *p, Number *of_u, Number *of_p) {
        kernels[g]->add_mixed_product(one, {u, p}, {of_u, of_p});
      },
      systems);
    fill_columns<Number>(
      0,
      n_p,
      [&](Number *, Number *p, Number *, Number *of_p) {
        kernels[g]->add_pressure_norm(one, p, of_p);
      },
      norms);
    return result;
  }

  template <typename Number>
  typename MatrixFreeElasticity<Number>::Cell
  MatrixFreeElasticity<Number>::cell(const unsigned int g,
                                     const unsigned int batch,
                                     const unsigned int lane) const
  {
    constexpr unsigned int     width = Batch<Number>::size;
    const CellBatches<Number> &cells = groups[g];
    const unsigned int         n_p   = cells.n_pressure_nodes;
    Cell                       result{cells, {}, {}};
    const unsigned int        *nodes = cells.nodes_of(batch);
    for (unsigned int i = 0; i < cells.n_nodes; ++i)
      for (unsigned int c = 0; c < dim; ++c)
        result.displacements.push_back(nodes[i * width + lane] + c);
    for (unsigned int k = 0; k < n_p; ++k)
      result.pressures.push_back(
        cells.pressure_nodes_of(batch)[k * width + lane]);
    return result;
  }

  template <typename Number>
  std::vector<FullMatrix<double>>
  MatrixFreeElasticity<Number>::projected_matrices(
    const unsigned int                g,
    const unsigned int                batch,
    const std::vector<CellFunctions> &functions) const
  {
    constexpr unsigned int          width = Batch<Number>::size;
    const CellBatches<Number>       one   = single_batch(groups[g], batch);
    const unsigned int              n     = dim * one.n_nodes;
    std::size_t                     m     = 0;
    std::vector<FullMatrix<double>> result;
    for (const CellFunctions &of_cell : functions)
      {
        result.emplace_back(of_cell.size(), of_cell.size());
        m = std::max(m, of_cell.size());
      }
    AlignedVector<Number> u(width * n), of_u(u);
    for (unsigned int j = 0; j < m; ++j)
      {
        u.fill(Number());
        for (unsigned int lane = 0; lane < functions.size(); ++lane)
          if (j < functions[lane].size())
            for (const auto &[i, value] : functions[lane][j])
              u[lane * n + i] += value;
        of_u.fill(Number());
        kernels[g]->add_product(one, u.data(), of_u.data());
        for (unsigned int lane = 0; lane < functions.size(); ++lane)
          if (j < functions[lane].size())
            for (unsigned int i = 0; i < functions[lane].size(); ++i)
              for (const auto &[k, value] : functions[lane][i])
                result[lane](i, j) += value * of_u[lane * n + k];
      }
    return result;
  }

  template <typename Number>
  void
  MatrixFreeElasticity<Number>::for_each_projected_matrix(
    const std::function<CellFunctions(const Cell &)> &functions,
    const std::function<void(const Cell &, const FullMatrix<double> &)> &visit)
    const
  {
    for (unsigned int g = 0; g < groups.size(); ++g)
      for (unsigned int batch = 0; batch < groups[g].n_batches; ++batch)
        {
          std::vector<CellFunctions> of_lanes;
          bool                       any = false;
          for (unsigned int lane = 0; lane < groups[g].lanes(batch); ++lane)
            {
              of_lanes.push_back(functions(cell(g, batch, lane)));
              any = any || !of_lanes.back().empty();
            }
          if (!any)
            continue;
          const auto matrices = projected_matrices(g, batch, of_lanes);
          for (unsigned int lane = 0; lane < of_lanes.size(); ++lane)
            if (!of_lanes[lane].empty())
              visit(cell(g, batch, lane), matrices[lane]);
        }
  }

  template <typename Number>
  void
  MatrixFreeElasticity<Number>::for_each_cell_matrix(
    const std::function<bool(const Cell &)>                     &wanted,
    const std::function<void(const Cell &, const CellMatrix &)> &visit) const
  {
    for (unsigned int g = 0; g < groups.size(); ++g)
      {
        const CellBatches<Number> &cells = groups[g];
        for (unsigned int batch = 0; batch < cells.n_batches; ++batch)
          {
            std::vector<CellMatrix> matrices; // once one is wanted
            for (unsigned int lane = 0; lane < cells.lanes(batch); ++lane)
              {
                const Cell cell = this->cell(g, batch, lane);
                if (!wanted(cell))
                  continue;
                if (matrices.empty())
                  matrices = batch_matrices(g, batch);
                visit(cell, matrices[lane]);
              }
          }
      }
  }

  template <typename Number>
  void
  MatrixFreeElasticity<Number>::for_each_cell(
    const std::function<void(const Cell &)> &visit) const
  {
    for_each_cell_matrix(
      [&](const Cell &cell) {
        visit(cell);
        return false;
      },
      [](const Cell &, const CellMatrix &) {});
  }

  template std::vector<MatrixFreeElasticity<double>::CellMatrix>
  MatrixFreeElasticity<double>::batch_matrices(unsigned int,
                                               unsigned int) const;
  template void
  MatrixFreeElasticity<double>::for_each_cell_matrix(
    const std::function<bool(const Cell &)> &,
    const std::function<void(const Cell &, const CellMatrix &)> &) const;
  template void
  MatrixFreeElasticity<double>::for_each_projected_matrix(
    const std::function<CellFunctions(const Cell &)> &,
    const std::function<void(const Cell &, const FullMatrix<double> &)> &)
    const;
  template MatrixFreeElasticity<double>::Cell
  MatrixFreeElasticity<double>::cell(unsigned int,
                                     unsigned int,
                                     unsigned int) const;
  template std::vector<FullMatrix<double>>
  MatrixFreeElasticity<double>::projected_matrices(
    unsigned int,
    unsigned int,
    const std::vector<CellFunctions> &) const;
  template void
  MatrixFreeElasticity<double>::for_each_cell(
    const std::function<void(const Cell &)> &) const;
} // namespace mortise
