#include <mortise/operators/levels/jump_penalty.h>
#include <mortise/operators/matrix_free/tensor_kernel.h>

#include <algorithm>
#include <array>

namespace mortise
{
  using namespace dealii;

  template <typename Number>
  PenaltyProduct<Number>::Part::Part(const JumpPenalty &penalty)
    : penalty(penalty)
  {
    // rows are filled with zeros to whole vectors of the processor
    std::size_t size = 0;
    for (const auto &group : penalty.groups)
      size += group.rows.size() * padded<Number>(group.columns.size());
    values.resize(size);
    Number *to = values.data();
    for (const auto &group : penalty.groups)
      for (unsigned int r = 0; r < group.rows.size(); ++r)
        {
          const unsigned int n = group.columns.size();
          std::copy_n(&group.values[r * n], n, to);
          to += padded<Number>(n);
        }
    for (const auto &normal : penalty.normals)
      for (unsigned int c = 0; c < dim; ++c)
        normals.push_back(static_cast<Number>(normal[c]));
  }

  template <typename Number>
  PenaltyProduct<Number>::PenaltyProduct(
    std::shared_ptr<const JumpPenalties> given)
    : penalties(std::move(given))
    , layout(*penalties->layout)
  {
    std::size_t widest = 0;
    for (const JumpPenalty &penalty : penalties->parts)
      {
        parts.emplace_back(penalty);
        for (const auto &group : penalty.groups)
          widest =
            std::max<std::size_t>(widest, padded<Number>(group.columns.size()));
      }
    workspace.resize(dim * widest);
    ghosts.resize(layout.n_ghost_indices());
    sums.resize(layout.n_ghost_indices());
    exchanged.resize(layout.n_import_indices());
  }

  template <typename Number>
  template <typename AddParts>
  void
  PenaltyProduct<Number>::gather(Number *dst, const AddParts &add_parts) const
  {
    const unsigned int n_owned = layout.locally_owned_size();
    std::fill(sums.begin(), sums.end(), Number());
    add_parts(Entries<Number>{dst, sums.data(), n_owned});
    std::vector<MPI_Request> requests;
    const ArrayView<Number>  from(sums.data(), sums.size());
    const ArrayView<Number>  received(exchanged.data(), exchanged.size());
    layout.import_from_ghosted_array_start(
      VectorOperation::add, 0, from, received, requests);
    layout.import_from_ghosted_array_finish(
      VectorOperation::add,
      ArrayView<const Number>(exchanged.data(), exchanged.size()),
      ArrayView<Number>(dst, n_owned),
      from,
      requests);
  }

  template <typename Number>
  void
  PenaltyProduct<Number>::add(const Number *src, Number *dst) const
  {
    const unsigned int       n_owned = layout.locally_owned_size();
    std::vector<MPI_Request> requests;
    const ArrayView<Number>  to(ghosts.data(), ghosts.size());
    layout.export_to_ghosted_array_start(0,
                                         ArrayView<const Number>(src, n_owned),
                                         ArrayView<Number>(exchanged.data(),
                                                           exchanged.size()),
                                         to,
                                         requests);
    layout.export_to_ghosted_array_finish(to, requests);
    gather(dst, [&](const Entries<Number> &sum) {
      const Entries<const Number> from{src, ghosts.data(), n_owned};
      for (const Part &part : parts)
        if (part.normals.empty())
          add_all_components(part, from, sum);
        else
          add_along_normals(part, from, sum);
    });
  }

  template <typename Number>
  void
  PenaltyProduct<Number>::add_all_components(const Part                  &part,
                                             const Entries<const Number> &src,
                                             const Entries<Number> &dst) const
  {
    using V                   = typename Batch<Number>::Vector;
    const unsigned int width  = Batch<Number>::size;
    const V           *values = reinterpret_cast<const V *>(part.values.data());
    for (const auto &group : part.penalty.groups)
      {
        const unsigned int n = group.columns.size(), m = padded<Number>(n);
        std::array<Number *, dim> gathered;
        for (unsigned int c = 0; c < dim; ++c)
          {
            gathered[c] = workspace.data() + c * m;
            std::fill(gathered[c] + n, gathered[c] + m, Number());
          }
        for (unsigned int j = 0; j < n; ++j)
          {
            const Number *at = src(group.columns[j]);
            for (unsigned int c = 0; c < dim; ++c)
              gathered[c][j] = at[c];
          }
        for (const unsigned int row : group.rows)
          {
            V sums[dim] = {};
            for (unsigned int j = 0; j < m / width; ++j, ++values)
              for (unsigned int c = 0; c < dim; ++c)
                sums[c] +=
                  *values * reinterpret_cast<const V *>(gathered[c])[j];
            Number *to = dst(row);
            for (unsigned int c = 0; c < dim; ++c)
              to[c] += sum_of_batch(reinterpret_cast<Number *>(&sums[c]));
          }
      }
  }

  template <typename Number>
  void
  PenaltyProduct<Number>::add_along_normals(const Part                  &part,
                                            const Entries<const Number> &src,
                                            const Entries<Number> &dst) const
  {
    using V                   = typename Batch<Number>::Vector;
    const unsigned int width  = Batch<Number>::size;
    const V           *values = reinterpret_cast<const V *>(part.values.data());
    const Number      *normals  = part.normals.data();
    Number            *gathered = workspace.data();
    for (const auto &group : part.penalty.groups)
      {
        const unsigned int n = group.columns.size(), m = padded<Number>(n);
        std::fill(gathered + n, gathered + m, Number());
        for (unsigned int j = 0; j < n; ++j)
          {
            const Number *normal = normals + group.columns[j],
                         *at     = src(group.columns[j]);
            gathered[j] =
              normal[0] * at[0] + normal[1] * at[1] + normal[2] * at[2];
          }
        for (const unsigned int row : group.rows)
          {
            V sum = {};
            for (unsigned int j = 0; j < m / width; ++j, ++values)
              sum += *values * reinterpret_cast<const V *>(gathered)[j];
            const Number total = sum_of_batch(reinterpret_cast<Number *>(&sum));
            Number      *to    = dst(row);
            for (unsigned int c = 0; c < dim; ++c)
              to[c] += normals[row + c] * total;
          }
      }
  }

  template <typename Number>
  void
  PenaltyProduct<Number>::add_diagonal(Number *diagonal) const
  {
    gather(diagonal, [&](const Entries<Number> &sum) {
      for (const Part &part : parts)
        {
          const Number *from = part.values.data();
          for (const auto &group : part.penalty.groups)
            for (const unsigned int row : group.rows)
              {
                for (unsigned int k = 0; k < group.columns.size(); ++k)
                  if (group.columns[k] == row)
                    for (unsigned int c = 0; c < dim; ++c)
                      sum(row)[c] += from[k] * (part.normals.empty() ?
                                                  Number(1) :
                                                  part.normals[row + c] *
                                                    part.normals[row + c]);
                from += padded<Number>(group.columns.size());
              }
        }
    });
  }

  template class PenaltyProduct<float>;
  template class PenaltyProduct<double>;
} // namespace mortise
