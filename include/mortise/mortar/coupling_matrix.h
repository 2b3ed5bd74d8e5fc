// The constraint matrix B with scalar entries, as D and M have: one value per
// node of multipliers and node of displacements for all components.
#pragma once

#include <mortise/base/sparse_matrix.h>

#include <vector>

namespace mortise
{
  /// B = R B_c. A row of B_c acts on one component of the displacement and has
  /// the values of a row of entries, which components mostly share. R holds the
  /// frames of multipliers and is the identity for ties. Displacements are
  /// numbered by node, their components one after the other.
  class CouplingMatrix
  {
  public:
    /// A row of B_c.
    struct Row
    {
      dealii::types::global_dof_index entries   = 0; ///< row of the same rank
      unsigned int                    component = 0;
    };

    CouplingMatrix() = default;

    /// @p entries: rows x nodes; rows that @p rows do not refer to are empty.
    /// @p rows: by owned row, ordered by entity of the mesh and within it by
    /// component. @p frames: R, multipliers x rows, of size 0 for the identity.
    CouplingMatrix(SparseMatrix          &&entries,
                   const std::vector<Row> &rows,
                   SparseMatrix          &&frames);

    /// The same B_c with other @p frames in place of R.
    CouplingMatrix
    with_frames(SparseMatrix &&frames) const;

    /// Drop the columns of owned displacements @p constrained. Collective.
    void
    constrain(const std::vector<unsigned int> &constrained);

    /// Rows of B_c x nodes; those of representative() are filled.
    const SparseMatrix &
    scalar() const
    {
      return entries;
    }

    /// The owned row of scalar() with the values of owned row @p i of B_c.
    unsigned int
    representative(const unsigned int i) const
    {
      return representatives[i];
    }

    unsigned int
    component(const unsigned int i) const
    {
      return components[i];
    }

    bool
    has_frames() const
    {
      return frames_of_rows.m() > 0;
    }

    /// R, unless it is the identity.
    const SparseMatrix &
    frames() const
    {
      return frames_of_rows;
    }

    /// B, multipliers x displacements. Collective.
    SparseMatrix
    expanded() const;

    /// dst = B u. Collective.
    void
    vmult(Vector &dst, const Vector &u) const
    {
      multiply(dst, on_columns(u));
    }

    /// dst += B^T lambda. Collective.
    void
    Tvmult_add(Vector &dst, const Vector &lambda) const
    {
      std::vector<double> of_columns = forces(lambda);
      clear_constrained(of_columns);
      scalar().add_to_owned(dst.begin(), of_columns);
    }

    /// dst = B u with the columns of constrained displacements. Collective.
    void
    vmult_free(Vector &dst, const Vector &u) const
    {
      multiply(dst, scalar().on_columns(u.begin()));
    }

    /// dst += B^T lambda with these columns. Collective.
    void
    Tvmult_add_free(Vector &dst, const Vector &lambda) const
    {
      scalar().add_to_owned(dst.begin(), forces(lambda));
    }

    /// diag(B T B^T) by owned multiplier; T diagonal, by owned displacement.
    /// Collective.
    Vector
    diagonal_of_square(const Vector &T) const;

    /// By column of scalar() and component; zero if constrained. Collective.
    std::vector<double>
    on_columns(const Vector &by_displacement) const
    {
      std::vector<double> result = scalar().on_columns(by_displacement.begin());
      clear_constrained(result);
      return result;
    }

  private:
    void
    clear_constrained(std::vector<double> &of_columns) const
    {
      for (const unsigned int k : constrained)
        of_columns[k] = 0.;
    }
    /// dst = B u, with all of B.
    void
    multiply(Vector &dst, const std::vector<double> &of_columns) const;
    /// B^T lambda on the columns, with all of B.
    std::vector<double>
    forces(const Vector &lambda) const;

    SparseMatrix              entries, frames_of_rows;
    std::vector<unsigned int> representatives, components; ///< by owned row
    std::vector<unsigned int> constrained; ///< by column and component
  };
} // namespace mortise
