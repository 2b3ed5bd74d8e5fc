// Multipliers that have the sign of the pressure: values at the nodes of edges
// and insides where that is enough, Bernstein coefficients of the same
// polynomials where nodes hang, degrees meet or are reduced, or multipliers are
// not dual. Only sources of this room include it.
#pragma once

#include <deal.II/lac/affine_constraints.h>

#include <mortise/body/elements/trace_basis.h>

#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "combinations.h"

namespace mortise
{
  /// Of one component, in the space of @p reduction. Edges and insides with
  /// coefficients have the degree of the highest mode that is kept there, the
  /// multiplier at the dof of mode k being the coefficient k - 1 of the edge.
  /// All that follows from others has weights that are not negative and add up
  /// to one: subdivision where nodes hang, elevation where degrees meet or are
  /// reduced, means of ruled surfaces inside faces that are covered in part.
  class SignedMultipliers
  {
  public:
    using Index = dealii::types::global_dof_index;
    using Dofs  = std::vector<Index>;
    /// Of an edge or inside with these functions of a face with these dofs.
    using Choice =
      std::function<bool(const std::vector<unsigned int> &functions,
                         const Dofs                      &dofs)>;

    /// @p has_coefficients: in place of values. All edges of a face must whose
    /// inside has, and those that others hang on. Both must live on.
    SignedMultipliers(const dealii::AffineConstraints<double> &reduction,
                      const Choice &has_coefficients);

    /// @p dofs: of a face of an owned or ghost cell; all come in front of the functions below.
    void
    add_face(const TraceBasis &basis, const Dofs &dofs);

    /// The values at the nodes of a face.
    std::vector<Combination>
    values_at_nodes(const TraceBasis &basis, const Dofs &dofs) const;

    /// Coefficients of edges and the inside of a face, and what gives them from
    /// the values at its nodes.
    std::vector<std::pair<Index, std::vector<double>>>
    from_values(const TraceBasis &basis, const Dofs &dofs) const;

  private:
    /// An edge whose coefficients are multipliers, but for the ends.
    struct Edge
    {
      std::array<Index, 2> ends;
      Dofs                 multipliers;
    };

    /// The coefficients of a face, in the order of its lattice.
    struct Coefficients
    {
      std::array<unsigned int, 2> degree; ///< triangles: the same twice
      std::vector<Combination>    all;
      /// Those inside that are multipliers: place, multiplier.
      std::vector<std::pair<unsigned int, Index>> inside;
    };

    std::optional<Index>
    multiplier_at(Index dof) const;
    /// None where it hangs, or has values.
    std::optional<Edge>
    own_edge(const TraceBasis &basis, const Dofs &dofs, unsigned int e) const;
    std::vector<Combination>
    coefficients(const Edge &edge) const;
    std::vector<Combination>
    coefficients(const TraceBasis &basis,
                 const Dofs       &dofs,
                 unsigned int      e) const;
    Coefficients
    coefficients(const TraceBasis &basis, const Dofs &dofs) const;
    Combination
    expand(Index dof) const;

    const dealii::AffineConstraints<double> &reduction;
    const Choice                            &has_coefficients;
    /// By dof of an edge's mode: the edge, the place among its multipliers.
    std::map<Index, std::pair<Edge, unsigned int>> modes;
  };
} // namespace mortise
