// Vertices of a slave of degree 1 that find no free vertex around them to take
// their multiplier from: each patch of them shares one constant. It never
// decides which vertices are stranded.
#pragma once

#include <deal.II/lac/la_parallel_vector.h>

#include <mortise/mortar/multiplier_faces.h>

#include <map>
#include <optional>
#include <vector>

namespace mortise
{
  class StrandedVertices
  {
  public:
    using Index = dealii::types::global_dof_index;

    /// Connect the stranded dofs over the faces around this rank, those of
    /// owned and ghost cells. The keys of may_follow are the stranded dofs
    /// known here, all owned ones among them; the values say whether the other
    /// side is free on some face around. Collective.
    StrandedVertices(const Body                        &body,
                     const std::vector<MultiplierFace> &faces,
                     const std::map<Index, bool>       &may_follow);

    /// The dof that carries the constant of the patch that an owned stranded
    /// dof is in; nothing if nothing can follow it.
    std::optional<Index>
    representative(Index dof) const
    {
      if (follow(dof) == 0.)
        return {};
      return static_cast<Index>(smallest(dof));
    }

    /// Add the dofs that representative() gives for owned dofs, those of far
    /// ranks too.
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
    /// Pass the smallest dof of each face to its stranded vertices; whether one
    /// changed.
    bool
    spread(const std::vector<MultiplierFace> &faces);

    const dealii::IndexSet                            &owned;
    dealii::LinearAlgebra::distributed::Vector<double> smallest, follow;
    std::map<Index, std::pair<double, double>>         states;
  };
} // namespace mortise
