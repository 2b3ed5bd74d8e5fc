// See schwarz_inverse.h.
#include <deal.II/base/mpi.h>

#include <boost/serialization/utility.hpp>

#include <mortise/solvers/factorisation/schwarz_inverse.h>
#include <mortise/solvers/pseudo_random.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    constexpr double       tolerance  = 1e-6;
    constexpr unsigned int max_solves = 20;

    /// Lengths, variants and columns of rows, and their values.
    using RowPackage = std::pair<std::vector<int>, std::vector<double>>;

    /// Appends rows to @p to, with columns that are local to @p matrix.
    class RowCollector
    {
    public:
      RowCollector(NodalMatrix &to, const DistributedNodalMatrix &matrix)
        : to(to)
        , matrix(matrix)
      {}

      void
      add(const int          length,
          const unsigned int variants,
          const int         *columns,
          const double      *values)
      {
        kept.clear();
        for (int k = 0; k < length; ++k)
          if (const int local = matrix.local(columns[k]); local >= 0)
            {
              kept.push_back(k);
              to.columns.push_back(local);
            }
        to.lengths.push_back(kept.size());
        to.variants.push_back(variants);
        for (unsigned int v = 0; v < variants; ++v)
          for (const int k : kept)
            to.values.push_back(values[v * length + k]);
      }

    private:
      NodalMatrix                  &to;
      const DistributedNodalMatrix &matrix;
      std::vector<int>              kept;
    };

    /// The rows of @p nodes, local.
    RowPackage
    pack(const NodalMatrix              &rows,
         const std::vector<int>         &nodes,
         const std::vector<std::size_t> &first_column,
         const std::vector<std::size_t> &first_value)
    {
      RowPackage package;
      for (const int i : nodes)
        {
          const int length = static_cast<int>(rows.lengths[i]);
          package.first.push_back(length);
          package.first.push_back(static_cast<int>(rows.variants[i]));
          const int *columns = &rows.columns[first_column[i]];
          package.first.insert(package.first.end(), columns, columns + length);
          const double *values = &rows.values[first_value[i]];
          package.second.insert(package.second.end(),
                                values,
                                values + length * rows.variants[i]);
        }
      return package;
    }

    /// What owned nodes and ghosts have among each other, in this order.
    /// Collective.
    NodalMatrix
    overlapping_rows(const DistributedNodalMatrix &matrix)
    {
      const MPI_Comm     comm   = matrix.communicator();
      const NodalMatrix &rows   = matrix.rows();
      const auto        &starts = matrix.starts();
      const int          n      = static_cast<int>(rows.size());
      std::map<unsigned int, std::vector<int>> wanted;
      for (const int ghost : matrix.ghosts())
        {
          const auto rank =
            std::upper_bound(starts.begin(), starts.end(), ghost) -
            starts.begin() - 1;
          wanted[rank].push_back(ghost - starts[rank]);
        }

      std::vector<std::size_t> first_column(n + 1), first_value(n + 1);
      for (int i = 0; i < n; ++i)
        {
          first_column[i + 1] = first_column[i] + rows.lengths[i];
          first_value[i + 1] =
            first_value[i] + std::size_t(rows.lengths[i]) * rows.variants[i];
        }
      std::map<unsigned int, RowPackage> packages;
      for (const auto &[rank, nodes] :
           Utilities::MPI::some_to_some(comm, wanted))
        packages[rank] = pack(rows, nodes, first_column, first_value);

      NodalMatrix result;
      result.n_components = rows.n_components;
      RowCollector collector(result, matrix);
      for (int i = 0; i < n; ++i)
        collector.add(rows.lengths[i],
                      rows.variants[i],
                      &rows.columns[first_column[i]],
                      &rows.values[first_value[i]]);
      // ranks ascend, and so do the nodes of each
      for (const auto &[rank, package] :
           Utilities::MPI::some_to_some(comm, packages))
        {
          const int    *column = package.first.data();
          const double *value  = package.second.data();
          for (unsigned int k = 0; k < wanted[rank].size(); ++k)
            {
              const int length = column[0], variants = column[1];
              collector.add(length, variants, column + 2, value);
              column += 2 + length;
              value += length * variants;
            }
        }
      result.entries.resize(result.size() * result.n_components);
      std::iota(result.entries.begin(), result.entries.end(), 0);
      return result;
    }
  } // namespace

  bool
  SchwarzInverse::initialize(
    std::shared_ptr<DistributedNodalMatrix> node_matrix,
    Product                                 matrix_product,
    const Vector                           &zero)
  {
    matrix                  = std::move(node_matrix);
    product                 = std::move(matrix_product);
    NodalMatrix overlapping = overlapping_rows(*matrix);
    local_x.resize(overlapping.entries.size());
    for (Vector *vector : {&r, &z, &q})
      vector->reinit(zero);
    const bool positive =
      local.initialize(std::move(overlapping), MPI_COMM_SELF);
    if (Utilities::MPI::min(positive ? 1 : 0, matrix->communicator()) == 0 ||
        !count_solves())
      return false;
    matrix->drop_rows();
    return true;
  }

  bool
  SchwarzInverse::count_solves()
  {
    Vector x(r);
    for (const auto i : x.locally_owned_elements())
      x(i) = pseudo_random(i);
    product(r, x); // of the matrix's scale
    double first = 0.;
    for (n_solves = 0; n_solves < max_solves; ++n_solves)
      {
        solve_local(z, r);
        const double norm = z.l2_norm();
        if (n_solves == 0)
          first = norm;
        if (norm <= tolerance * first)
          {
            n_solves = std::max(n_solves, 1U);
            return true;
          }
        product(q, z);
        r -= q;
      }
    return false;
  }

  void
  SchwarzInverse::solve_local(Vector &to, const Vector &from) const
  {
    local.solve(local_x.data(), matrix->at_nodes(from).begin());
    const auto &entries = matrix->rows().entries;
    for (unsigned int i = 0; i < entries.size(); ++i)
      if (entries[i] >= 0)
        to.local_element(entries[i]) = local_x[i];
  }

  void
  SchwarzInverse::solve(Vector &x, const Vector &b) const
  {
    r = b;
    solve_local(x, r);
    for (unsigned int k = 1; k < n_solves; ++k)
      {
        product(q, k == 1 ? x : z);
        r -= q;
        solve_local(z, r);
        x += z;
      }
  }
} // namespace mortise
