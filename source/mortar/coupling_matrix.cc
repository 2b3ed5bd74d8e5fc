// See coupling_matrix.h.
#include <mortise/mortar/coupling_matrix.h>

#include <algorithm>
#include <utility>

namespace mortise
{
  using namespace dealii;

  CouplingMatrix::CouplingMatrix(SparseMatrix          &&entries,
                                 const std::vector<Row> &rows,
                                 SparseMatrix          &&frames)
    : entries(std::move(entries))
    , frames_of_rows(std::move(frames))
  {
    for (const Row &row : rows)
      {
        representatives.push_back(
          scalar().rows().index_within_set(row.entries));
        components.push_back(row.component);
      }
  }

  CouplingMatrix
  CouplingMatrix::with_frames(SparseMatrix &&frames) const
  {
    CouplingMatrix result = *this;
    result.frames_of_rows = std::move(frames);
    return result;
  }

  void
  CouplingMatrix::constrain(const std::vector<unsigned int> &given)
  {
    std::vector<double> flags(scalar().owned_unknowns().n_elements());
    for (const unsigned int i : given)
      flags[i] = 1.;
    const std::vector<double> of_columns = scalar().on_columns(flags.data());
    constrained.clear();
    for (unsigned int k = 0; k < of_columns.size(); ++k)
      if (of_columns[k] != 0.)
        constrained.push_back(k);
  }

  void
  CouplingMatrix::multiply(Vector                    &dst,
                           const std::vector<double> &of_columns) const
  {
    std::vector<double> to(dim * scalar().n_rows()), rows(scalar().n_rows());
    scalar().multiply(to.data(), of_columns.data());
    for (unsigned int i = 0; i < rows.size(); ++i)
      rows[i] = to[dim * representatives[i] + components[i]];
    if (has_frames())
      frames().vmult(dst.begin(), rows.data());
    else
      std::copy(rows.begin(), rows.end(), dst.begin());
  }

  std::vector<double>
  CouplingMatrix::forces(const Vector &lambda) const
  {
    std::vector<double> rows(scalar().n_rows()), from(dim * rows.size());
    if (has_frames())
      frames().Tvmult_add(rows.data(), lambda.begin());
    else
      std::copy_n(lambda.begin(), rows.size(), rows.begin());
    for (unsigned int i = 0; i < rows.size(); ++i)
      from[dim * representatives[i] + components[i]] = rows[i];
    std::vector<double> result(dim * scalar().n_columns());
    scalar().multiply_transposed_add(result.data(), from.data());
    return result;
  }

  SparseMatrix
  CouplingMatrix::expanded() const
  {
    std::vector<bool> is_free(dim * scalar().n_columns(), true);
    for (const unsigned int k : constrained)
      is_free[k] = false;
    SparseMatrix::CompressedRows rows; // of B_c
    for (unsigned int i = 0; i < scalar().n_rows(); ++i)
      {
        const auto row = scalar().row(representatives[i]);
        for (unsigned int k = 0; k < row.length; ++k)
          if (is_free[dim * row.columns[k] + components[i]])
            {
              rows.columns.push_back(
                dim * scalar().global_column(row.columns[k]) + components[i]);
              rows.values.push_back(row.values[k]);
            }
        rows.begin.push_back(rows.columns.size());
      }
    SparseMatrix of_rows(scalar().rows(),
                         scalar().owned_unknowns(),
                         scalar().communicator(),
                         std::move(rows));
    return has_frames() ? frames().times(of_rows) : of_rows;
  }

  Vector
  CouplingMatrix::diagonal_of_square(const Vector &T) const
  {
    const SparseMatrix &rows = (has_frames() ? frames() : scalar());
    Vector              result(rows.rows(), scalar().communicator());
    if (has_frames())
      {
        const SparseMatrix        B       = expanded();
        const std::vector<double> weights = B.on_columns(T.begin());
        for (unsigned int i = 0; i < B.n_rows(); ++i)
          {
            const auto row = B.row(i);
            for (unsigned int k = 0; k < row.length; ++k)
              result.local_element(i) +=
                row.values[k] * row.values[k] * weights[row.columns[k]];
          }
        return result;
      }
    const std::vector<double> weights = on_columns(T);
    for (unsigned int i = 0; i < scalar().n_rows(); ++i)
      {
        const auto row = scalar().row(representatives[i]);
        for (unsigned int k = 0; k < row.length; ++k)
          result.local_element(i) +=
            row.values[k] * row.values[k] *
            weights[dim * row.columns[k] + components[i]];
      }
    return result;
  }
} // namespace mortise
