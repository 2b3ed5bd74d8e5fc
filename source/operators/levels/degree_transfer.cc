#include <deal.II/base/quadrature_lib.h>

#include <mortise/base/lagrange.h>
#include <mortise/base/tensor_product.h>
#include <mortise/body/elements/simplex_nodes.h>
#include <mortise/operators/levels/degree_transfer.h>
#include <mortise/operators/matrix_free/dense_kernel.h>
#include <mortise/operators/matrix_free/matrix_free_kernel.h>
#include <mortise/operators/matrix_free/node_access.h>

namespace mortise
{
  using namespace dealii;

  template <typename Number>
  class DegreeTransfer<Number>::Kernel
  {
  public:
    virtual ~Kernel() = default;
    virtual void
    prolongate(const CellBatches<Number> &fine_cells,
               const CellBatches<Number> &coarse_cells,
               Number                    *fine,
               const Number              *coarse) const = 0;
    virtual void
    restrict_to(const CellBatches<Number> &fine_cells,
                const CellBatches<Number> &coarse_cells,
                const Number              *fine,
                Number                    *coarse) const = 0;
  };

  /// Between cells of hexahedra.
  template <typename Number>
  template <unsigned int fine_degree>
  class DegreeTransfer<Number>::KernelOfDegree
    : public DegreeTransfer<Number>::Kernel
  {
  public:
    using V                    = typename Batch<Number>::Vector;
    static constexpr int width = Batch<Number>::size;
    static constexpr int n     = fine_degree + 1;
    static constexpr int m     = lower_degree(false, fine_degree) + 1;
    static constexpr int N     = n * n * n;
    static constexpr int M     = m * m * m;

    KernelOfDegree()
    {
      const FullMatrix<double> values =
        lagrange_values(QGaussLobatto<1>(m), QGaussLobatto<1>(n));
      up   = LineMatrix<Number, n, m>(values);
      down = LineMatrix<Number, m, n>(transposed(values));
    }

    void
    prolongate(const CellBatches<Number> &fine_cells,
               const CellBatches<Number> &coarse_cells,
               Number                    *fine,
               const Number              *coarse) const override
    {
      V u[dim * N], a[dim * M], b[n * m * m], d[n * n * m];
      for (unsigned int batch = 0; batch < fine_cells.n_batches; ++batch)
        {
          gather<M>(coarse, coarse_cells.nodes_of(batch), a);
          for (unsigned int c = 0; c < dim; ++c)
            {
              apply_along<0, false, m, m, m>(up, a + c * M, b);
              apply_along<1, false, n, m, m>(up, b, d);
              apply_along<2, false, n, n, m>(up, d, u + c * N);
            }
          clear_idle_lanes(fine_cells, batch, u);
          scatter_add<N>(u, fine_cells.nodes_of(batch), fine);
        }
    }

    void
    restrict_to(const CellBatches<Number> &fine_cells,
                const CellBatches<Number> &coarse_cells,
                const Number              *fine,
                Number                    *coarse) const override
    {
      V u[dim * N], a[dim * M], b[n * n * m], d[n * m * m];
      for (unsigned int batch = 0; batch < fine_cells.n_batches; ++batch)
        {
          gather<N>(fine, fine_cells.nodes_of(batch), u);
          clear_idle_lanes(fine_cells, batch, u);
          for (unsigned int c = 0; c < dim; ++c)
            {
              apply_along<2, false, n, n, n>(down, u + c * N, b);
              apply_along<1, false, n, n, m>(down, b, d);
              apply_along<0, false, n, m, m>(down, d, a + c * M);
            }
          scatter_add<M>(a, coarse_cells.nodes_of(batch), coarse);
        }
    }

  private:
    static void
    clear_idle_lanes(const CellBatches<Number> &cells,
                     const unsigned int         batch,
                     V                         *u)
    {
      for (int l = cells.lanes(batch); l < width; ++l)
        for (unsigned int i = 0; i < dim * N; ++i)
          u[i][l] = 0;
    }

    LineMatrix<Number, n, m> up;
    LineMatrix<Number, m, n> down;
  };

  /// Between cells of tetrahedra.
  template <typename Number>
  class DegreeTransfer<Number>::SimplexKernel
    : public DegreeTransfer<Number>::Kernel
  {
  public:
    using V                    = typename Batch<Number>::Vector;
    static constexpr int width = Batch<Number>::size;

    SimplexKernel(const unsigned int fine_degree,
                  const unsigned int coarse_degree)
    {
      const FullMatrix<double> values =
        simplex_nodal_values(coarse_degree, simplex_nodes(fine_degree));
      up   = DenseMatrix<Number>(values);
      down = DenseMatrix<Number>(transposed(values));
      u.resize(dim * values.m() * width);
      a.resize(dim * values.n() * width);
    }

    void
    prolongate(const CellBatches<Number> &fine_cells,
               const CellBatches<Number> &coarse_cells,
               Number                    *fine,
               const Number              *coarse) const override
    {
      for (unsigned int batch = 0; batch < fine_cells.n_batches; ++batch)
        {
          load(coarse_cells, batch, coarse, a);
          up.apply(reinterpret_cast<const V *>(a.data()),
                   reinterpret_cast<V *>(u.data()));
          add(fine_cells, batch, u, fine);
        }
    }

    void
    restrict_to(const CellBatches<Number> &fine_cells,
                const CellBatches<Number> &coarse_cells,
                const Number              *fine,
                Number                    *coarse) const override
    {
      for (unsigned int batch = 0; batch < fine_cells.n_batches; ++batch)
        {
          load(fine_cells, batch, fine, u);
          down.apply(reinterpret_cast<const V *>(u.data()),
                     reinterpret_cast<V *>(a.data()));
          add(coarse_cells, batch, a, coarse);
        }
    }

  private:
    /// Calls visit(index in a vector, index in a batch) for the components at
    /// the nodes in @p n_lanes lanes.
    template <typename Visit>
    static void
    for_each_index(const CellBatches<Number> &cells,
                   const unsigned int         batch,
                   const unsigned int         n_lanes,
                   const Visit               &visit)
    {
      const unsigned int *nodes = cells.nodes_of(batch);
      for (unsigned int i = 0; i < cells.n_nodes; ++i)
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int l = 0; l < n_lanes; ++l)
            visit(nodes[i * width + l] + c,
                  (c * cells.n_nodes + i) * width + l);
    }

    static void
    load(const CellBatches<Number> &cells,
         const unsigned int         batch,
         const Number              *from,
         AlignedVector<Number>     &to)
    {
      for_each_index(cells,
                     batch,
                     width,
                     [&](const unsigned int index, const unsigned int own) {
                       to[own] = from[index];
                     });
    }

    static void
    add(const CellBatches<Number>   &cells,
        const unsigned int           batch,
        const AlignedVector<Number> &from,
        Number                      *to)
    {
      for_each_index(cells,
                     batch,
                     cells.lanes(batch),
                     [&](const unsigned int index, const unsigned int own) {
                       to[index] += from[own];
                     });
    }

    DenseMatrix<Number>           up, down;
    mutable AlignedVector<Number> u, a;
  };

  template <typename Number>
  DegreeTransfer<Number>::DegreeTransfer(const LevelOperator<Number> &fine,
                                         const LevelOperator<Number> &coarse)
    : fine(fine)
    , coarse(coarse)
  {
    fine.initialize(weights);
    fine.initialize(weighted);
    constexpr unsigned int width = Batch<Number>::size;
    for (unsigned int g = 0; g < fine.cells().size(); ++g)
      {
        const CellBatches<Number> &cells = fine.cells()[g];
        if (cells.tetrahedra)
          kernels.push_back(
            std::make_unique<SimplexKernel>(cells.degree,
                                            coarse.cells()[g].degree));
        else
          kernels.push_back(make_kernel(cells.degree));
        for (unsigned int batch = 0; batch < cells.n_batches; ++batch)
          for (unsigned int i = 0; i < cells.n_nodes; ++i)
            for (unsigned int l = 0; l < cells.lanes(batch); ++l)
              for (unsigned int c = 0; c < dim; ++c)
                weights.local_element(
                  cells.nodes[(std::size_t(batch) * cells.n_nodes + i) * width +
                              l] +
                  c) += 1;
      }
    weights.compress(VectorOperation::add);
    for (unsigned int i = 0; i < weights.locally_owned_size(); ++i)
      weights.local_element(i) = 1 / weights.local_element(i);
  }

  template <typename Number>
  DegreeTransfer<Number>::~DegreeTransfer() = default;

  template <typename Number>
  void
  DegreeTransfer<Number>::prolongate_add(LevelVector<Number>       &to,
                                         const LevelVector<Number> &from) const
  {
    coarse.complete(from);
    weighted = 0;
    for (unsigned int g = 0; g < kernels.size(); ++g)
      kernels[g]->prolongate(fine.cells()[g],
                             coarse.cells()[g],
                             weighted.begin(),
                             from.begin());
    coarse.release(from);
    weighted.compress(VectorOperation::add);
    fine.clear_constrained(weighted);
    for (unsigned int i = 0; i < to.locally_owned_size(); ++i)
      to.local_element(i) +=
        weights.local_element(i) * weighted.local_element(i);
  }

  template <typename Number>
  void
  DegreeTransfer<Number>::restrict_to(LevelVector<Number>       &to,
                                      const LevelVector<Number> &from) const
  {
    for (unsigned int i = 0; i < from.locally_owned_size(); ++i)
      weighted.local_element(i) =
        weights.local_element(i) * from.local_element(i);
    weighted.update_ghost_values();
    to = 0;
    for (unsigned int g = 0; g < kernels.size(); ++g)
      kernels[g]->restrict_to(fine.cells()[g],
                              coarse.cells()[g],
                              weighted.begin(),
                              to.begin());
    weighted.zero_out_ghost_values();
    coarse.gather(to);
    coarse.clear_constrained(to);
  }

  template <typename Number>
  std::unique_ptr<typename DegreeTransfer<Number>::Kernel>
  DegreeTransfer<Number>::make_kernel(const unsigned int fine_degree)
  {
    // one where cells of other bodies have more
    return with_degree<1>(fine_degree, [](const auto degree) {
      return std::unique_ptr<Kernel>(
        std::make_unique<KernelOfDegree<degree>>());
    });
  }

  template class DegreeTransfer<float>;
  template class DegreeTransfer<double>;
} // namespace mortise
