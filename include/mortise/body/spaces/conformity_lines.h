// Which degrees of freedom of a mesh of hp elements follow from others, where
// nodes hang and where degrees are mixed; what they follow with depends on the
// basis, which derived classes know. It never closes constraints.
#pragma once

#include <deal.II/lac/affine_constraints.h>

#include <mortise/body/spaces/entity_degrees.h>

#include <array>
#include <unordered_map>
#include <utility>
#include <vector>

namespace mortise
{
  class ConformityLines
  {
  public:
    using CellIterator = EntityDegrees::CellIterator;
    using Index        = dealii::types::global_dof_index;
    using Entries      = std::vector<std::pair<Index, double>>;

    /// Both are kept by reference; @p dof_handler as for EntityDegrees.
    ConformityLines(const dealii::DoFHandler<3> &dof_handler,
                    const EntityDegrees         &degrees);
    virtual ~ConformityLines() = default;

    /// Makes the lines of this rank's cells and initialises @p constraints with them and those
    /// that they refer to, see make_conformity_constraints(). Collective.
    void
    make(dealii::AffineConstraints<double> &constraints);

  protected:
    /// Line @p l of @p cell, whose dofs are in own, is half @p half of line @p coarse_line of
    /// @p coarse.
    virtual void
    constrain_hanging_line(const CellIterator &cell,
                           unsigned int        l,
                           unsigned int        half,
                           const CellIterator &coarse,
                           unsigned int        coarse_line) = 0;

    /// A face of a fine cell and the coarse one that it is a quarter of.
    struct HangingFace
    {
      CellIterator cell;
      unsigned int face;
      /// Half of the coarse face along the directions of the fine one.
      unsigned int half[2];
      CellIterator coarse;
      unsigned int coarse_face;
      bool         transposed; ///< directions of the coarse cell's face
    };
    virtual void
    constrain_hanging_face(const HangingFace &at) = 0;

    /// Constrain the dofs of @p cell, in own, that are above the degree of its
    /// lines and faces or depend on those of a neighbour.
    virtual void
    constrain_mixed_degrees(const CellIterator &cell) = 0;

    /// Local dof of component @p c of @p cell, a hexahedron, that is function @p i of line @p l,
    /// in the order of evaluate_lobatto(): its ends are vertices, the others
    /// its own.
    unsigned int
    line_dof(const CellIterator &cell,
             unsigned int        l,
             unsigned int        i,
             unsigned int        c = 0) const;

    /// The same of functions @p i and @p j of face @p f along the directions of
    /// face_dof_indices().
    unsigned int
    face_dof(const CellIterator &cell,
             unsigned int        f,
             unsigned int        i,
             unsigned int        j,
             unsigned int        c = 0) const;

    /// Begin the constraint of @p dof unless it has one already.
    bool
    start_line(Index dof);

    /// Of the line that was started last.
    Entries &
    entries()
    {
      return lines.back().entries;
    }

    const dealii::DoFHandler<3> &dof_handler;
    const EntityDegrees         &degrees;
    std::vector<Index>           own;

  private:
    /// One degree of freedom as a combination of others (of none: zero).
    struct Line
    {
      Index   dof;
      Entries entries;
    };

    void
    make_lines();
    void
    find_coarse_lines();
    void
    find_hanging_line(const CellIterator &cell, unsigned int l);
    void
    find_hanging_face(const CellIterator &cell, unsigned int f);
    dealii::IndexSet
    all_dofs() const;

    /// face_dof_indices() by element and face, of hexahedra.
    std::vector<std::array<std::vector<unsigned int>, 6>> faces;

    std::vector<Line> lines;
    dealii::IndexSet  owned;      ///< of this rank
    std::vector<bool> owned_done; ///< constrained, by place in owned
    std::unordered_map<Index, bool> other_done;
    /// Refined lines of active cells: line index -> such a cell and its
    /// number there.
    std::unordered_map<unsigned int, std::pair<CellIterator, unsigned int>>
      coarse_lines;
  };
} // namespace mortise
