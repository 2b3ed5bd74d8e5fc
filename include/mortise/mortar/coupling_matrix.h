// The constraint B as D and M are: scalar, one value for a node of multipliers
// and a node of displacements, whatever the components.
#pragma once

#include <Epetra_CrsMatrix.h>
#include <Epetra_MultiVector.h>
#include <Epetra_Vector.h>
#include <mortise/base/types.h>

#include <memory>
#include <vector>

namespace mortise
{
  /// B = R B_c. The rows of B_c move one component of displacements each, with
  /// the values of a row of entries, which components mostly share; R are the
  /// frames of multipliers, the identity where bodies are tied. Displacements
  /// are numbered by node, their components one after the other.
  class CouplingMatrix
  {
  public:
    /// A row of B_c.
    struct Row
    {
      dealii::types::global_dof_index entries   = 0; ///< row, of the same rank
      unsigned int                    component = 0;
    };

    CouplingMatrix() = default;

    /// B itself: its rows move displacements one by one.
    explicit CouplingMatrix(SparseMatrix &&by_displacement);

    /// @p entries: rows x nodes, columns owned rank by rank; those rows that no other refers to
    /// are empty. @p rows: by owned row, those of an entity of the mesh one after
    /// the other, in it by component. @p frames: multipliers x rows, of size 0 for the identity.
    CouplingMatrix(SparseMatrix          &&entries,
                   const std::vector<Row> &rows,
                   SparseMatrix          &&frames);

    /// Drop the columns of owned displacements @p constrained.
    void
    constrain(std::vector<unsigned int> constrained);

    /// Displacements of a node: dim, or 1 where each is moved by itself.
    unsigned int
    n_components() const
    {
      return components_per_node;
    }

    /// Of multipliers.
    const Epetra_Map &
    row_map() const
    {
      return (has_frames() ? frames() : scalar()).RowMap();
    }

    /// Rows of B_c x nodes; those of representative() are filled.
    const Epetra_CrsMatrix &
    scalar() const
    {
      return entries->trilinos_matrix();
    }

    /// The owned row of scalar() with the values of owned row @p i of B_c.
    int
    representative(const int i) const
    {
      return representatives.empty() ? i : representatives[i];
    }

    unsigned int
    component(const int i) const
    {
      return components.empty() ? 0 : components[i];
    }

    bool
    has_frames() const
    {
      return static_cast<bool>(frames_of_rows);
    }

    /// R, where it is not the identity.
    const Epetra_CrsMatrix &
    frames() const
    {
      return frames_of_rows->trilinos_matrix();
    }

    /// B, where displacements are moved one by one.
    const Epetra_CrsMatrix &
    by_displacement() const;

    /// B, whatever it is made of. Collective.
    Epetra_CrsMatrix
    expanded() const;

    /// dst = B u. Collective.
    void
    vmult(Vector &dst, const Vector &u) const;

    /// dst += B^T lambda. Collective.
    void
    Tvmult_add(Vector &dst, const Vector &lambda) const;

    /// dst = B u, without regard to what is constrained. @p u: by owned displacement. Collective.
    void
    vmult_free(Vector &dst, const double *u) const;

    /// dst += B^T lambda, likewise. @p dst: by owned displacement. Collective.
    void
    Tvmult_add_free(double *dst, const Vector &lambda) const;

    /// diag(B T B^T), T diagonal, by owned displacement. Collective.
    Epetra_Vector
    diagonal_of_square(const Epetra_Vector &T) const;

    /// One value by owned displacement, on the columns of scalar(), a vector by
    /// component; zero where constrained. Collective.
    Epetra_MultiVector
    on_columns(const double *by_displacement) const
    {
      return on_columns(by_displacement, scalar());
    }

    /// Likewise on those of @p matrix, which has rows of scalar().
    Epetra_MultiVector
    on_columns(const double           *by_displacement,
               const Epetra_CrsMatrix &matrix) const;

  private:
    Epetra_MultiVector
    by_component(const double *by_displacement) const;
    void
    clear_constrained(Epetra_MultiVector &by_component) const;
    /// dst = B u, with all of B.
    void
    multiply(Vector &dst, const Epetra_MultiVector &u) const;
    /// B^T lambda, with all of B, by component.
    Epetra_MultiVector
    forces(const Vector &lambda) const;
    static void
    add(const Epetra_MultiVector &by_component, double *dst);

    unsigned int                  components_per_node = 1;
    std::unique_ptr<SparseMatrix> entries, frames_of_rows;
    std::vector<int>              representatives;
    std::vector<unsigned int>     components;
    std::vector<unsigned int>     constrained;
  };
} // namespace mortise
