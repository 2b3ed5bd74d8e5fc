// See vertex_multigrid.h.
#include <mortise/operators/levels/block_csr_operator.h>
#include <mortise/operators/levels/thickness_matrix.h>
#include <mortise/operators/levels/vertex_selection.h>
#include <mortise/operators/levels/vertex_transfer.h>
#include <mortise/solvers/factorisation/cholesky_inverse.h>
#include <mortise/solvers/multigrid/chebyshev.h>
#include <mortise/solvers/multigrid/lower_smoothing_bound.h>
#include <mortise/solvers/multigrid/vertex_multigrid.h>

#include <algorithm>
#include <type_traits>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Up to this many dofs a factorisation takes no longer (thick sphere, p =
    /// 2, one core: the same at 2,000; 0.34 instead of 0.25 s at 5,800).
    constexpr unsigned int max_factorised = 1500;

    /// The same of functions across the thickness, to which no other way is as
    /// good.
    constexpr unsigned int max_factorised_across = 500000;

    /// Where no coarser mesh is known: what takes fewer multiplications per
    /// dof, as thin bodies do (doc/measurements/tuning.md), up to so many dofs
    /// that all ranks can have the graph.
    constexpr double       max_work     = 3e5;
    constexpr unsigned int max_gathered = 100000;

    bool
    is_cheap(const BlockCsrMatrix &blocks)
    {
      if (blocks.layout->size() > max_gathered)
        return false;
      RowsByNode graph;
      for (unsigned int i = 0; i < blocks.size(); ++i)
        graph.lengths.push_back(blocks.begin[i + 1] - blocks.begin[i]);
      for (const unsigned int node : blocks.columns)
        graph.columns.push_back(blocks.layout->local_to_global(dim * node) /
                                dim);
      graph.variants.assign(blocks.size(), 1);
      graph.values.assign(blocks.columns.size(), 1.);
      return std::pow(dim, 3) *
               factorisation_work(graph,
                                  blocks.layout->get_mpi_communicator()) <
             max_work * blocks.layout->size();
    }

    /// A level that is coarsened.
    template <typename Number>
    struct SmoothedVertices
    {
      SmoothedVertices(BlockCsrMatrix          blocks,
                       const double            smallest,
                       const VertexCoarsening &coarsening,
                       const BlockCsrMatrix   &coarse)
        : matrix(std::move(blocks))
        , smoother(matrix, smallest)
        , transfer(coarsening, coarse)
      {
        matrix.initialize(x);
        matrix.initialize(b);
        matrix.initialize(r);
      }

      BlockCsrOperator<Number> matrix;
      Chebyshev<Number>        smoother;
      VertexTransfer<Number>   transfer;
      LevelVector<Number>      x, b, r;
    };

    template <typename To, typename From>
    void
    copy_owned(LevelVector<To> &to, const LevelVector<From> &from)
    {
      std::copy_n(from.begin(), from.locally_owned_size(), to.begin());
    }
  } // namespace

  template <typename Number>
  struct VertexMultigrid<Number>::Implementation
  {
    Implementation(const MultigridLevel &level, const bool smooth_finest)
      : level(level)
    {
      const MPI_Comm comm        = level.layout->get_mpi_communicator();
      const auto     coarsenings = level.layout->size() > max_factorised ?
                                     make_vertex_coarsenings(*level.space, comm) :
                                     std::vector<VertexCoarsening>();
      auto           next        = coarsenings.begin();
      const bool     skip_finest = !smooth_finest && !coarsenings.empty();
      VertexMatrix   matrix =
        assemble_vertex_matrix(level, skip_finest ? &*next : nullptr);
      if (skip_finest)
        to_first =
          std::make_unique<VertexTransfer<Number>>(*next++, matrix.blocks);
      set_up(std::move(matrix), {next, coarsenings.end()}, max_factorised);
    }

    Implementation(const BlockSystem                    &system,
                   const ThicknessCoarsening            &thickness,
                   const std::vector<ConstraintPenalty> &jumps)
      : level(system.bulk->levels().front())
      , across_thickness(true)
    {
      VertexMatrix matrix = assemble_thickness_matrix(level,
                                                      system.bulk->elasticity(),
                                                      thickness,
                                                      jumps);
      to_first = std::make_unique<VertexTransfer<Number>>(thickness.functions,
                                                          matrix.blocks);
      set_up(std::move(matrix), {}, max_factorised_across);
    }

    void
    set_up(VertexMatrix                         matrix,
           const std::vector<VertexCoarsening> &coarsenings,
           const unsigned int                   max_size)
    {
      BlockCsrMatrix &blocks   = matrix.blocks;
      const double    smallest = lower_smoothing_bound(*level.space, false);
      auto            next     = coarsenings.begin();
      while (blocks.layout->size() > max_size &&
             (next != coarsenings.end() || !is_cheap(blocks)))
        {
          const VertexCoarsening coarsening =
            next != coarsenings.end() ? *next++ : select_vertices(matrix);
          if (coarsening.owned.size() * dim == blocks.layout->size())
            break; // small bodies only
          BlockCsrMatrix coarse = coarsen(blocks, coarsening);
          levels.push_back(std::make_unique<SmoothedVertices<Number>>(
            std::move(blocks), smallest, coarsening, coarse));
          valid  = valid && levels.back()->smoother.is_valid();
          blocks = std::move(coarse);
          matrix.keep(coarsening.kept);
        }
      coarse_x.reinit(blocks.layout);
      coarse_b.reinit(blocks.layout);
      constrained             = constrained_components(blocks);
      const SparseMatrix rows = as_sparse_matrix(blocks);
      blocks                  = BlockCsrMatrix();
      vertex_x.reinit(rows.rows(), rows.communicator());
      vertex_r.reinit(vertex_x);
      valid = coarsest.initialize(
                rows_as_nodes(rows),
                [&rows](Vector &y, const Vector &x) { rows.vmult(y, x); },
                vertex_x,
                std::is_same_v<Number, float>) &&
              valid;
    }

    /// The solution for what b() of level @p l holds, approximately, to x().
    void
    cycle(const unsigned int l)
    {
      if (l == levels.size())
        {
          copy_owned(vertex_r, coarse_b);
          coarsest.solve(vertex_x, vertex_r);
          copy_owned(coarse_x, vertex_x);
          for (const unsigned int index : constrained)
            coarse_x.local_element(index) = 0;
          return;
        }
      SmoothedVertices<Number> &level = *levels[l];
      level.smoother.smooth(level.x, level.b, true);
      level.matrix.vmult(level.r, level.x);
      level.r.sadd(-1, 1, level.b);
      restrict_from(level.transfer, level.r, l + 1);
      cycle(l + 1);
      level.transfer.prolongate_add(level.x, x(l + 1));
      level.matrix.clear_constrained(level.x);
      level.smoother.smooth(level.x, level.b, false);
    }

    /// b() of level @p l from the next finer one.
    void
    restrict_from(const VertexTransfer<Number> &transfer,
                  const LevelVector<Number>    &r,
                  const unsigned int            l)
    {
      transfer.restrict_to(b(l), r);
      if (l < levels.size())
        levels[l]->matrix.clear_constrained(levels[l]->b);
    }

    LevelVector<Number> &
    x(const unsigned int l)
    {
      return l == levels.size() ? coarse_x : levels[l]->x;
    }

    LevelVector<Number> &
    b(const unsigned int l)
    {
      return l == levels.size() ? coarse_b : levels[l]->b;
    }

    const MultigridLevel &level;
    const bool            across_thickness =
      false; ///< the first matrix is of these functions
    std::vector<std::unique_ptr<SmoothedVertices<Number>>> levels;
    LevelVector<Number>                                    coarse_x, coarse_b;
    std::vector<unsigned int> constrained; ///< on the coarsest level
    /// Where the caller smooths the finest mesh.
    std::unique_ptr<VertexTransfer<Number>> to_first;
    CholeskyInverse<float>                  coarsest;
    Vector                                  vertex_x, vertex_r;
    bool                                    valid = true;
  };

  template <typename Number>
  VertexMultigrid<Number>::VertexMultigrid(const MultigridLevel &level,
                                           const bool            smooth_finest)
    : implementation(std::make_unique<Implementation>(level, smooth_finest))
  {}

  template <typename Number>
  VertexMultigrid<Number>::VertexMultigrid(
    const BlockSystem                    &system,
    const ThicknessCoarsening            &thickness,
    const std::vector<ConstraintPenalty> &jumps)
    : implementation(std::make_unique<Implementation>(system, thickness, jumps))
  {}

  template <typename Number>
  VertexMultigrid<Number>::~VertexMultigrid() = default;

  template <typename Number>
  bool
  VertexMultigrid<Number>::is_valid() const
  {
    return implementation->valid;
  }

  template <typename Number>
  void
  VertexMultigrid<Number>::vmult(LevelVector<Number>       &x,
                                 const LevelVector<Number> &b) const
  {
    auto &data = *implementation;
    if (data.to_first)
      data.restrict_from(*data.to_first, b, 0);
    else
      copy_owned(data.b(0), b);
    data.cycle(0);
    if (data.to_first)
      {
        x = 0;
        data.to_first->prolongate_add(x, data.x(0));
        for (const unsigned int index : data.level.constrained)
          x.local_element(index) = 0;
      }
    else
      copy_owned(x, data.x(0));
  }

  template <typename Number>
  std::string
  VertexMultigrid<Number>::description() const
  {
    const unsigned int n =
      implementation->levels.size() + (implementation->to_first ? 1 : 0);
    if (implementation->across_thickness)
      return "what is linear across flat bodies " +
             (n == 1 ? std::string() :
                       "on " + std::to_string(n) + " levels, the coarsest ") +
             "factorised";
    return "vertices " +
           (n == 0 ? "" :
                     "on " + std::to_string(n + 1) + " levels, the coarsest ") +
           "factorised";
  }

  template class VertexMultigrid<float>;
  template class VertexMultigrid<double>;
} // namespace mortise
