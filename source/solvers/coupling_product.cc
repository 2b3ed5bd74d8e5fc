#include <deal.II/base/mpi.h>

#include <mortise/operators/tensor_kernel.h>
#include <mortise/solvers/coupling_product.h>
#include <mortise/solvers/epetra_tools.h>
#include <mortise/solvers/register_blocks.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Do the groups hold the same entries, in columns that are those of
    /// components 0, 1 and 2 of the same nodes?
    bool
    same_but_for_component(const Epetra_CrsMatrix &matrix,
                           const RowGroup         &a,
                           const RowGroup         &b,
                           const unsigned int      component)
    {
      if (a.n_rows != b.n_rows)
        return false;
      for (int i = 0; i < a.n_rows; ++i)
        {
          const EpetraRow p(matrix, a.first + i), q(matrix, b.first + i);
          if (p.length != q.length ||
              !std::equal(p.values, p.values + p.length, q.values))
            return false;
          if (i > 0)
            continue;
          for (int k = 0; k < p.length; ++k)
            if (matrix.GCID(q.columns[k]) !=
                matrix.GCID(p.columns[k]) + static_cast<int>(component))
              return false;
        }
      return true;
    }
  } // namespace

  template <typename Number>
  CouplingProduct<Number>::CouplingProduct(const BlockSystem &system)
  {
    const auto &matrix = system.coupling.trilinos_matrix();
    const auto  groups = group_rows(matrix);
    make_blocks(matrix, groups, make_layout(matrix, groups, system));
  }

  template <typename Number>
  std::vector<unsigned int>
  CouplingProduct<Number>::make_layout(const Epetra_CrsMatrix      &matrix,
                                       const std::vector<RowGroup> &groups,
                                       const BlockSystem           &system)
  {
    const auto &columns = matrix.ColMap(); // on one rank all displacements
    std::vector<bool> has_entries(columns.NumMyElements());
    for (const RowGroup &group : groups)
      {
        const EpetraRow row(matrix, group.first);
        for (int k = 0; k < row.length; ++k)
          has_entries[row.columns[k]] = true;
      }
    IndexSet touched(system.owned_displacement.size());
    for (int k = 0; k < columns.NumMyElements(); ++k)
      if (has_entries[k])
        touched.add_index(columns.GID(k));
    touched.compress();
    LevelVector<double> number(system.owned_displacement,
                               touched,
                               system.communicator);
    for (const auto index : touched)
      number(index) = 1.;
    number.compress(VectorOperation::add);
    for (unsigned int i = 0; i < number.locally_owned_size(); ++i)
      if (number.local_element(i) > 0.)
        moved.push_back(i);

    // number what is moved by itself; exact in double precision
    using Index      = types::global_dof_index;
    const Index mine = moved.size(),
                size = Utilities::MPI::sum(mine, system.communicator);
    Index first      = 0;
    MPI_Scan(&mine,
             &first,
             1,
             DEAL_II_DOF_INDEX_MPI_TYPE,
             MPI_SUM,
             system.communicator);
    first -= mine;
    for (unsigned int k = 0; k < moved.size(); ++k)
      number.local_element(moved[k]) = first + k;
    number.update_ghost_values();
    IndexSet owned(size), relevant(size);
    owned.add_range(first, first + moved.size());
    for (const auto index : touched)
      relevant.add_index(static_cast<Index>(number(index)));
    layout =
      std::make_shared<const Utilities::MPI::Partitioner>(owned,
                                                          relevant,
                                                          system.communicator);
    std::vector<unsigned int> entry(columns.NumMyElements(),
                                    numbers::invalid_unsigned_int);
    for (int k = 0; k < columns.NumMyElements(); ++k)
      if (has_entries[k])
        entry[k] =
          layout->global_to_local(static_cast<Index>(number(columns.GID(k))));
    return entry;
  }

  template <typename Number>
  void
  CouplingProduct<Number>::make_blocks(
    const Epetra_CrsMatrix          &matrix,
    const std::vector<RowGroup>     &groups,
    const std::vector<unsigned int> &entry_of_column)
  {
    std::size_t size = 0, widest = 0;
    for (unsigned int g = 0; g < groups.size();)
      {
        unsigned int n_components = 1;
        while (n_components < dim && g + n_components < groups.size() &&
               same_but_for_component(
                 matrix, groups[g], groups[g + n_components], n_components))
          ++n_components;
        if (n_components < dim)
          n_components = 1;
        Block block;
        block.n_rows = groups[g].n_rows;
        for (unsigned int c = 0; c < n_components; ++c)
          {
            const EpetraRow row(matrix, groups[g + c].first);
            block.first_row.push_back(groups[g + c].first);
            block.columns.emplace_back();
            for (int k = 0; k < row.length; ++k)
              block.columns.back().push_back(entry_of_column[row.columns[k]]);
          }
        const std::size_t width = padded<Number>(block.columns[0].size());
        size += block.n_rows * width;
        widest = std::max(widest, width);
        blocks.push_back(std::move(block));
        g += n_components;
      }
    entries.resize(size);
    workspace.resize(dim * widest);
    Number *entry = entries.data();
    for (const Block &block : blocks)
      for (int i = 0; i < block.n_rows; ++i)
        {
          const EpetraRow row(matrix, block.first_row[0] + i);
          for (int k = 0; k < row.length; ++k)
            entry[k] = static_cast<Number>(row.values[k]);
          entry += padded<Number>(row.length);
        }
  }

  template <typename Number>
  template <unsigned int n_components>
  void
  CouplingProduct<Number>::multiply_block(const Block   &block,
                                          const Number  *block_entries,
                                          const Number  *trace,
                                          Epetra_Vector &jump) const
  {
    using V                  = typename Batch<Number>::Vector;
    constexpr unsigned int w = Batch<Number>::size;
    const unsigned int n = block.columns[0].size(), m = padded<Number>(n) / w;
    const V           *row      = reinterpret_cast<const V *>(block_entries);
    V                 *gathered = reinterpret_cast<V *>(workspace.data());
    for (unsigned int c = 0; c < n_components; ++c)
      {
        Number *to = workspace.data() + c * m * w;
        for (unsigned int k = 0; k < n; ++k)
          to[k] = trace[block.columns[c][k]];
        std::fill(to + n, to + m * w, Number());
      }
    for_each_register_block<n_register_rows>(
      block.n_rows, [&](const unsigned int i, const auto n_rows) {
        const V *const from = row + std::size_t(i) * m;
        V              sums[n_rows][n_components];
        for (unsigned int r = 0; r < n_rows; ++r)
          for (unsigned int c = 0; c < n_components; ++c)
            sums[r][c] = V{};
        for (unsigned int k = 0; k < m; ++k)
          for (unsigned int r = 0; r < n_rows; ++r)
            for (unsigned int c = 0; c < n_components; ++c)
              sums[r][c] += from[r * m + k] * gathered[c * m + k];
        for (unsigned int r = 0; r < n_rows; ++r)
          for (unsigned int c = 0; c < n_components; ++c)
            {
              Number sum = 0;
              for (unsigned int l = 0; l < w; ++l)
                sum += sums[r][c][l];
              jump[block.first_row[c] + i + r] = sum;
            }
      });
  }

  template <typename Number>
  template <unsigned int n_components>
  void
  CouplingProduct<Number>::multiply_block_transposed(
    const Block         &block,
    const Number        *block_entries,
    Number              *trace,
    const Epetra_Vector &y) const
  {
    using V                  = typename Batch<Number>::Vector;
    constexpr unsigned int w = Batch<Number>::size;
    const unsigned int n = block.columns[0].size(), m = padded<Number>(n) / w;
    const V           *row  = reinterpret_cast<const V *>(block_entries);
    V                 *sums = reinterpret_cast<V *>(workspace.data());
    std::fill(sums, sums + n_components * m, V{});
    for_each_register_block<n_register_rows>(
      block.n_rows, [&](const unsigned int i, const auto n_rows) {
        const V *const from = row + std::size_t(i) * m;
        Number         factor[n_rows][n_components];
        for (unsigned int r = 0; r < n_rows; ++r)
          for (unsigned int c = 0; c < n_components; ++c)
            factor[r][c] = static_cast<Number>(y[block.first_row[c] + i + r]);
        for (unsigned int k = 0; k < m; ++k)
          for (unsigned int c = 0; c < n_components; ++c)
            {
              V sum = sums[c * m + k];
              for (unsigned int r = 0; r < n_rows; ++r)
                sum += factor[r][c] * from[r * m + k];
              sums[c * m + k] = sum;
            }
      });
    for (unsigned int c = 0; c < n_components; ++c)
      {
        const Number *from = workspace.data() + c * m * w;
        for (unsigned int k = 0; k < n; ++k)
          trace[block.columns[c][k]] += from[k];
      }
  }

  template <typename Number>
  void
  CouplingProduct<Number>::multiply(Epetra_Vector             &jump,
                                    const LevelVector<Number> &trace) const
  {
    trace.update_ghost_values();
    const Number *block_entries = entries.data();
    for (const Block &block : blocks)
      {
        if (block.columns.size() == dim)
          multiply_block<dim>(block, block_entries, trace.begin(), jump);
        else
          multiply_block<1>(block, block_entries, trace.begin(), jump);
        block_entries += block.n_rows * padded<Number>(block.columns[0].size());
      }
    trace.zero_out_ghost_values();
  }

  template <typename Number>
  void
  CouplingProduct<Number>::multiply_transposed(LevelVector<Number> &trace,
                                               const Epetra_Vector &y) const
  {
    trace                       = 0;
    const Number *block_entries = entries.data();
    for (const Block &block : blocks)
      {
        if (block.columns.size() == dim)
          multiply_block_transposed<dim>(block,
                                         block_entries,
                                         trace.begin(),
                                         y);
        else
          multiply_block_transposed<1>(block, block_entries, trace.begin(), y);
        block_entries += block.n_rows * padded<Number>(block.columns[0].size());
      }
    trace.compress(VectorOperation::add);
  }

  template class CouplingProduct<float>;
  template class CouplingProduct<double>;
} // namespace mortise
