// Patches of slave vertices of degree 1 without a free vertex around them; the
// multiplier of a patch is one constant.
#pragma once

#include <deal.II/lac/la_parallel_vector.h>

#include <mortise/mortar/multiplier_faces.h>

#include <map>
#include <optional>
#include <vector>

namespace mortise
{
  class IsolatedVertices
  {
  public:
    using Index = dealii::types::global_dof_index;

    /// Connect isolated dofs over the faces of owned and ghost cells. The keys
    /// of @p any_free are the isolated dofs known here, all owned ones among
    /// them; its values tell whether the other side is free on some face
    /// around. Collective.
    IsolatedVertices(const Body                        &body,
                     const std::vector<MultiplierFace> &faces,
                     const std::map<Index, bool>       &any_free);

    /// The dof with the constant of the patch of an owned isolated @p dof;
    /// nothing if no displacement is free there.
    std::optional<Index>
    representative(Index dof) const
    {
      if (follow(dof) == 0.)
        return {};
      return static_cast<Index>(smallest(dof));
    }

    /// Add the representatives of owned dofs, which any rank may own.
    void
    add_representatives(dealii::IndexSet &set) const;

  private:
    void
    exchange()
    {
      smallest.update_ghost_values();
      follow.update_ghost_values();
      for (auto &[dof, state] : states)
        state = {smallest(dof), follow(dof)};
    }

    /// Pass the smallest dof of each face to its isolated vertices. True if one
    /// changed.
    bool
    spread(const std::vector<MultiplierFace> &faces);

    const dealii::IndexSet                            &owned;
    dealii::LinearAlgebra::distributed::Vector<double> smallest, follow;
    std::map<Index, std::pair<double, double>>         states;
  };
} // namespace mortise
