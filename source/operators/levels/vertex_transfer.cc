// See vertex_transfer.h.
#include <deal.II/base/mpi.h>

#include <mortise/operators/levels/vertex_transfer.h>

#include <algorithm>
#include <array>
#include <map>

namespace mortise
{
  using namespace dealii;

  InterpolationRows
  interpolation_rows(const Utilities::MPI::Partitioner &layout,
                     const VertexCoarsening            &own)
  {
    const auto add_own = [&](const unsigned int i, InterpolationRows &to) {
      const unsigned int from = own.begin[i], end = own.begin[i + 1];
      to.lengths.push_back(end - from);
      to.nodes.insert(to.nodes.end(),
                      own.nodes.begin() + from,
                      own.nodes.begin() + end);
      to.weights.insert(to.weights.end(),
                        own.weights.begin() + from,
                        own.weights.begin() + end);
    };
    std::map<unsigned int, InterpolationRows> packages;
    auto         chunk = layout.import_indices().begin();
    unsigned int at    = 0; // in the chunk
    for (const auto &[rank, count] : layout.import_targets())
      for (unsigned int k = 0; k < count; ++k)
        {
          while (chunk->first + at >= chunk->second)
            {
              ++chunk;
              at = 0;
            }
          if (const unsigned int index = chunk->first + at++; index % dim == 0)
            add_own(index / dim, packages[rank]);
        }
    InterpolationRows rows;
    for (unsigned int i = 0; i + 1 < own.begin.size(); ++i)
      add_own(i, rows);
    // ghosts stand in the order of their owners
    for (const auto &[rank, package] :
         Utilities::MPI::some_to_some(layout.get_mpi_communicator(), packages))
      {
        rows.lengths.insert(rows.lengths.end(),
                            package.lengths.begin(),
                            package.lengths.end());
        rows.nodes.insert(rows.nodes.end(),
                          package.nodes.begin(),
                          package.nodes.end());
        rows.weights.insert(rows.weights.end(),
                            package.weights.begin(),
                            package.weights.end());
      }
    return rows;
  }

  void
  constrain(const std::vector<unsigned int> &constrained_fine,
            const VertexCoarsening          &coarsening,
            BlockCsrMatrix                  &coarse)
  {
    std::vector<bool> is_constrained(dim * (coarsening.begin.size() - 1));
    for (const unsigned int index : constrained_fine)
      is_constrained[index] = true;
    LevelVector<double> constrained(coarse.layout);
    for (unsigned int i = 0; i < coarse.size(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        constrained.local_element(dim * i + c) =
          is_constrained[dim * coarsening.kept[i] + c];
    constrained.update_ghost_values();
    for (unsigned int i = 0; i < coarse.size(); ++i)
      for (std::size_t k = coarse.begin[i]; k < coarse.begin[i + 1]; ++k)
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int r = 0; r < dim; ++r)
            if (constrained.local_element(dim * i + r) != 0. ||
                constrained.local_element(dim * coarse.columns[k] + c) != 0.)
              coarse.values[dim * dim * k + dim * c + r] = 0.;
  }

  BlockCsrMatrix
  coarsen(const BlockCsrMatrix &fine, const VertexCoarsening &coarsening)
  {
    BlockCsrMatrixBuilder   builder(coarsening.owned,
                                  fine.layout->get_mpi_communicator());
    const InterpolationRows rows = interpolation_rows(*fine.layout, coarsening);
    const std::vector<unsigned int> begin = rows.begin();
    std::vector<unsigned int>       indices;
    for (const auto node : rows.nodes)
      indices.push_back(builder.local_number(node));

    // the columns of row i of A P
    std::vector<unsigned int> columns, row,
      number(indices.empty() ?
               0 :
               1 + *std::max_element(indices.begin(), indices.end()),
             numbers::invalid_unsigned_int);
    const auto find_columns = [&](const unsigned int i) {
      columns.clear();
      for (std::size_t k = fine.begin[i]; k < fine.begin[i + 1]; ++k)
        for (unsigned int e = begin[fine.columns[k]];
             e < begin[fine.columns[k] + 1];
             ++e)
          if (number[indices[e]] == numbers::invalid_unsigned_int)
            {
              number[indices[e]] = columns.size();
              columns.push_back(indices[e]);
            }
    };
    const auto forget_columns = [&]() {
      for (const unsigned int column : columns)
        number[column] = numbers::invalid_unsigned_int;
    };
    for (unsigned int i = 0; i < fine.size(); ++i)
      {
        find_columns(i);
        row.assign(indices.begin() + begin[i], indices.begin() + begin[i + 1]);
        builder.couple(row, columns);
        forget_columns();
      }
    builder.close();

    constexpr unsigned int                     n = dim * dim;
    std::vector<std::array<double, dim * dim>> products;
    for (unsigned int i = 0; i < fine.size(); ++i)
      {
        find_columns(i);
        products.assign(columns.size(), {});
        for (std::size_t k = fine.begin[i]; k < fine.begin[i + 1]; ++k)
          for (unsigned int e = begin[fine.columns[k]];
               e < begin[fine.columns[k] + 1];
               ++e)
            for (unsigned int v = 0; v < n; ++v)
              products[number[indices[e]]][v] +=
                rows.weights[e] * fine.values[n * k + v];
        for (unsigned int e = begin[i]; e < begin[i + 1]; ++e)
          for (unsigned int k = 0; k < columns.size(); ++k)
            {
              double *to = builder.block(indices[e], columns[k]);
              for (unsigned int v = 0; v < n; ++v)
                to[v] += rows.weights[e] * products[k][v];
            }
        forget_columns();
      }

    IndexSet needed(coarsening.owned.size());
    needed.add_indices(coarsening.nodes.begin(), coarsening.nodes.end());
    BlockCsrMatrix coarse = builder.finish(needed);
    constrain(constrained_components(fine), coarsening, coarse);
    return coarse;
  }

  template <typename Number>
  VertexTransfer<Number>::VertexTransfer(const VertexCoarsening &coarsening,
                                         const BlockCsrMatrix   &coarse)
    : begin(coarsening.begin)
    , weights(coarsening.weights.begin(), coarsening.weights.end())
  {
    for (const auto node : coarsening.nodes)
      indices.push_back(coarse.layout->global_to_local(dim * node));
  }

  template <typename Number>
  void
  VertexTransfer<Number>::prolongate_add(
    LevelVector<Number>       &fine,
    const LevelVector<Number> &coarse) const
  {
    coarse.update_ghost_values();
    const Number *from = coarse.begin();
    Number       *to   = fine.begin();
    for (unsigned int i = 0; i + 1 < begin.size(); ++i, to += dim)
      for (unsigned int e = begin[i]; e < begin[i + 1]; ++e)
        for (unsigned int c = 0; c < dim; ++c)
          to[c] += weights[e] * from[indices[e] + c];
    coarse.zero_out_ghost_values();
  }

  template <typename Number>
  void
  VertexTransfer<Number>::restrict_to(LevelVector<Number>       &coarse,
                                      const LevelVector<Number> &fine) const
  {
    coarse             = 0;
    const Number *from = fine.begin();
    Number       *to   = coarse.begin();
    for (unsigned int i = 0; i + 1 < begin.size(); ++i, from += dim)
      for (unsigned int e = begin[i]; e < begin[i + 1]; ++e)
        for (unsigned int c = 0; c < dim; ++c)
          to[indices[e] + c] += weights[e] * from[c];
    coarse.compress(VectorOperation::add);
  }

  template class VertexTransfer<float>;
  template class VertexTransfer<double>;
} // namespace mortise
