// See coupling_matrix.h.
#include <deal.II/base/exceptions.h>

#include <EpetraExt_MatrixMatrix.h>
#include <Epetra_Import.h>
#include <mortise/mortar/coupling_matrix.h>

#include <algorithm>
#include <utility>

namespace mortise
{
  using namespace dealii;

  CouplingMatrix::CouplingMatrix(SparseMatrix &&by_displacement)
    : entries(std::make_unique<SparseMatrix>(std::move(by_displacement)))
  {}

  CouplingMatrix::CouplingMatrix(SparseMatrix          &&entries,
                                 const std::vector<Row> &rows,
                                 SparseMatrix          &&frames)
    : components_per_node(dim)
    , entries(std::make_unique<SparseMatrix>(std::move(entries)))
  {
    if (frames.m() > 0)
      frames_of_rows = std::make_unique<SparseMatrix>(std::move(frames));
    for (const Row &row : rows)
      {
        representatives.push_back(
          scalar().RowMap().LID(static_cast<int>(row.entries)));
        components.push_back(row.component);
      }
  }

  void
  CouplingMatrix::constrain(std::vector<unsigned int> constrained)
  {
    this->constrained = std::move(constrained);
  }

  const Epetra_CrsMatrix &
  CouplingMatrix::by_displacement() const
  {
    Assert(components_per_node == 1, ExcInternalError());
    return entries->trilinos_matrix();
  }

  Epetra_MultiVector
  CouplingMatrix::by_component(const double *by_displacement) const
  {
    const auto         n = static_cast<int>(components_per_node);
    Epetra_MultiVector result(scalar().DomainMap(), n);
    for (int i = 0; i < result.MyLength(); ++i)
      for (int c = 0; c < n; ++c)
        result[c][i] = by_displacement[n * i + c];
    return result;
  }

  void
  CouplingMatrix::clear_constrained(Epetra_MultiVector &by_component) const
  {
    for (const unsigned int k : constrained)
      by_component[k % components_per_node][k / components_per_node] = 0.;
  }

  Epetra_MultiVector
  CouplingMatrix::on_columns(const double           *by_displacement,
                             const Epetra_CrsMatrix &matrix) const
  {
    Epetra_MultiVector owned = by_component(by_displacement);
    clear_constrained(owned);
    if (matrix.Importer() == nullptr)
      return owned;
    Epetra_MultiVector result(matrix.ColMap(), owned.NumVectors());
    result.Import(owned, *matrix.Importer(), Insert);
    return result;
  }

  void
  CouplingMatrix::multiply(Vector &dst, const Epetra_MultiVector &u) const
  {
    Epetra_MultiVector to(scalar().RowMap(), dim);
    scalar().Multiply(false, u, to);
    Epetra_Vector rows(scalar().RowMap());
    for (int i = 0; i < rows.MyLength(); ++i)
      rows[i] = to[components[i]][representatives[i]];
    if (has_frames())
      {
        Epetra_Vector target(View, row_map(), dst.begin());
        frames().Multiply(false, rows, target);
      }
    else
      std::copy_n(rows.Values(), rows.MyLength(), dst.begin());
  }

  Epetra_MultiVector
  CouplingMatrix::forces(const Vector &lambda) const
  {
    Epetra_Vector rows(scalar().RowMap());
    if (has_frames())
      frames().Multiply(true,
                        Epetra_Vector(View,
                                      row_map(),
                                      const_cast<double *>(lambda.begin())),
                        rows);
    else
      std::copy_n(lambda.begin(), rows.MyLength(), rows.Values());
    Epetra_MultiVector from(scalar().RowMap(), dim),
      to(scalar().DomainMap(), dim);
    for (int i = 0; i < rows.MyLength(); ++i)
      from[components[i]][representatives[i]] = rows[i];
    scalar().Multiply(true, from, to);
    return to;
  }

  void
  CouplingMatrix::add(const Epetra_MultiVector &by_component, double *dst)
  {
    for (int i = 0; i < by_component.MyLength(); ++i)
      for (unsigned int c = 0; c < dim; ++c)
        dst[dim * i + c] += by_component[c][i];
  }

  void
  CouplingMatrix::vmult(Vector &dst, const Vector &u) const
  {
    if (components_per_node == 1)
      return entries->vmult(dst, u);
    Epetra_MultiVector from = by_component(u.begin());
    clear_constrained(from);
    multiply(dst, from);
  }

  void
  CouplingMatrix::vmult_free(Vector &dst, const double *u) const
  {
    multiply(dst, by_component(u));
  }

  void
  CouplingMatrix::Tvmult_add(Vector &dst, const Vector &lambda) const
  {
    if (components_per_node == 1)
      return entries->Tvmult_add(dst, lambda);
    Epetra_MultiVector to = forces(lambda);
    clear_constrained(to);
    add(to, dst.begin());
  }

  void
  CouplingMatrix::Tvmult_add_free(double *dst, const Vector &lambda) const
  {
    add(forces(lambda), dst);
  }

  Epetra_CrsMatrix
  CouplingMatrix::expanded() const
  {
    if (components_per_node == 1)
      return Epetra_CrsMatrix(by_displacement());
    const Epetra_CrsMatrix   &A = scalar();
    const int                 n = dim * A.DomainMap().NumMyElements();
    const Epetra_Map          displacements(-1, n, 0, A.Comm());
    const std::vector<double> ones(n, 1.);
    const Epetra_MultiVector  is_free = on_columns(ones.data());
    Epetra_CrsMatrix          result(Copy, A.RowMap(), 0);
    std::vector<int>          columns;
    std::vector<double>       values;
    for (int i = 0; i < A.NumMyRows(); ++i)
      {
        int     length = 0, *nodes = nullptr;
        double *from = nullptr;
        A.ExtractMyRowView(representatives[i], length, from, nodes);
        columns.clear();
        values.clear();
        for (int k = 0; k < length; ++k)
          if (is_free[components[i]][nodes[k]] != 0.)
            {
              columns.push_back(static_cast<int>(dim) * A.GCID(nodes[k]) +
                                static_cast<int>(components[i]));
              values.push_back(from[k]);
            }
        result.InsertGlobalValues(A.GRID(i),
                                  static_cast<int>(columns.size()),
                                  values.data(),
                                  columns.data());
      }
    result.FillComplete(displacements, A.RowMap());
    if (!has_frames())
      return result;
    Epetra_CrsMatrix B(Copy, row_map(), 0);
    EpetraExt::MatrixMatrix::Multiply(frames(), false, result, false, B);
    return B;
  }

  Epetra_Vector
  CouplingMatrix::diagonal_of_square(const Epetra_Vector &T) const
  {
    const auto squares = [](const Epetra_CrsMatrix   &A,
                            const Epetra_MultiVector &weights,
                            const auto               &row_of,
                            const auto               &component_of) {
      Epetra_Vector result(A.RowMap());
      for (int i = 0; i < A.NumMyRows(); ++i)
        {
          int     length = 0, *columns = nullptr;
          double *values = nullptr;
          A.ExtractMyRowView(row_of(i), length, values, columns);
          const double *of_columns = weights[component_of(i)];
          for (int k = 0; k < length; ++k)
            result[i] += values[k] * values[k] * of_columns[columns[k]];
        }
      return result;
    };
    if (!has_frames())
      return squares(
        scalar(),
        on_columns(T.Values()),
        [this](const int i) { return representative(i); },
        [this](const int i) { return component(i); });
    const Epetra_CrsMatrix B = expanded();
    Epetra_Vector          weights(B.ColMap());
    if (B.Importer() != nullptr)
      weights.Import(T, *B.Importer(), Insert);
    else
      std::copy_n(T.Values(), T.MyLength(), weights.Values());
    return squares(
      B, weights, [](const int i) { return i; }, [](const int) { return 0; });
  }
} // namespace mortise
