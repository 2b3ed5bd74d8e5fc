// Proves that blocks of combined rows and columns add up to the same matrix on
// every number of ranks, whichever rank adds them and whichever owns the rows,
// and that it has the places that were recorded and no others.
#include <deal.II/base/mpi.h>

#include <mortise/mortar/row_assembler.h>
#include <verdict.h>

#include <cmath>
#include <set>

using namespace mortise;
using namespace dealii;

namespace
{
  using Index = types::global_dof_index;

  constexpr unsigned int n_rows = 13, n_columns = 21, n_blocks = 40;

  /// Local functions that are one global one each, a combination of two, or
  /// none; a block uses the second half of them.
  struct Functions
  {
    std::vector<unsigned int> begin{0};
    std::vector<Index>        index;
    std::vector<double>       weight;
    unsigned int              n;

    Functions(const unsigned int n, const Index first, const Index size)
      : n(n)
    {
      for (unsigned int i = 0; i < 2 * n; ++i)
        {
          if ((first + i) % 5 != 4)
            add((first + 3 * i) % size, 1. + 0.1 * i);
          if ((first + i) % 5 == 2)
            add((first + i + 1) % size, -0.5);
          begin.push_back(index.size());
        }
    }

    Expansion
    expansion() const
    {
      return {begin, index, weight, n};
    }

    /// visit(local, global, weight)
    template <typename Visit>
    void
    for_each(const Visit &visit) const
    {
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int e = begin[n + i]; e < begin[n + i + 1]; ++e)
          visit(i, index[e], weight[e]);
    }

  private:
    void
    add(const Index i, const double w)
    {
      index.push_back(i);
      weight.push_back(w);
    }
  };

  struct Block
  {
    Functions          rows, columns;
    bool               transposed;
    FullMatrix<double> values;

    explicit Block(const unsigned int b)
      : rows(2 + b % 3, b, n_rows - 1) // the last row is in no block
      , columns(3 + b % 4, 2 * b, n_columns)
      , transposed(b % 2)
      , values(transposed ? columns.n : rows.n, transposed ? rows.n : columns.n)
    {
      for (unsigned int i = 0; i < values.m(); ++i)
        for (unsigned int j = 0; j < values.n(); ++j)
          values(i, j) = std::sin(1. + b + 7. * i + 3. * j);
    }
  };

  constexpr double factor = 2.;

  /// All blocks, and where they have entries.
  struct Expected
  {
    FullMatrix<double>                matrix;
    std::set<std::pair<Index, Index>> places;

    Expected()
      : matrix(n_rows, n_columns)
    {
      for (unsigned int b = 0; b < n_blocks; ++b)
        add(Block(b));
    }

  private:
    void
    add(const Block &block)
    {
      block.rows.for_each(
        [&](const unsigned int i, const Index row, const double row_weight) {
          block.columns.for_each(
            [&](const unsigned int j, const Index column, const double weight) {
              matrix(row, column) +=
                factor * row_weight * weight *
                (block.transposed ? block.values(j, i) : block.values(i, j));
              places.emplace(row, column);
            });
        });
    }
  };

  IndexSet
  owned(const std::vector<Index> &ends)
  {
    const unsigned int rank = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    IndexSet           set(ends.back());
    set.add_range(rank == 0 ? 0 : ends[rank - 1], ends[rank]);
    set.compress();
    return set;
  }
} // namespace

int
main(int argc, char *argv[])
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const unsigned int rank = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD),
                     n    = Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  // the second of three ranks has no row
  const std::vector<Index> row_ends[]    = {{13}, {6, 13}, {5, 5, 13}},
                           column_ends[] = {{21}, {12, 21}, {4, 11, 21}};
  const IndexSet rows                    = owned(row_ends[n - 1]),
                 columns                 = owned(column_ends[n - 1]);

  RowAssembler assembler(rows, columns);
  for (unsigned int b = rank; b < n_blocks; b += n)
    {
      const Block block(b);
      assembler.record(block.rows.expansion(),
                       block.rows.n,
                       block.columns.expansion(),
                       block.columns.n);
    }
  assembler.allocate();
  for (unsigned int b = rank; b < n_blocks; b += n)
    {
      const Block block(b);
      assembler.add(block.rows.expansion(),
                    block.columns.expansion(),
                    block.values,
                    factor,
                    block.transposed);
    }
  const mortise::SparseMatrix matrix = assembler.create(MPI_COMM_WORLD);

  const Expected  expected;
  mortise::Vector u(columns, MPI_COMM_WORLD), product(rows, MPI_COMM_WORLD);
  for (const Index j : columns)
    u(j) = std::cos(double(j));
  matrix.vmult(product, u);
  double       entry_error = 0., product_error = 0.;
  unsigned int n_entries = 0;
  for (unsigned int local = 0; local < matrix.n_rows(); ++local)
    {
      const Index         i   = matrix.global_row(local);
      double              sum = 0.;
      std::vector<double> got(n_columns);
      const auto          row = matrix.row(local);
      for (unsigned int k = 0; k < row.length; ++k)
        got[matrix.global_column(row.columns[k])] = row.values[k];
      n_entries += row.length;
      for (Index j = 0; j < n_columns; ++j)
        {
          sum += expected.matrix(i, j) * std::cos(double(j));
          entry_error =
            std::max(entry_error, std::abs(got[j] - expected.matrix(i, j)));
        }
      product_error = std::max(product_error, std::abs(product(i) - sum));
    }
  entry_error   = Utilities::MPI::max(entry_error, MPI_COMM_WORLD);
  product_error = Utilities::MPI::max(product_error, MPI_COMM_WORLD);
  const double n_others =
    Utilities::MPI::sum<double>(n_entries, MPI_COMM_WORLD) -
    double(expected.places.size());
  if (rank == 0)
    {
      verdict("entries", entry_error, 1e-13);
      verdict("product", product_error, 1e-13);
      verdict("other places", std::abs(n_others), 0);
    }
}
