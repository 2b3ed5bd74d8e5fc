// Constants that may be added to the pressure: those of incompressible bodies
// that nothing lets expand, or of groups of such bodies tied to each other.
#pragma once

#include <mortise/base/types.h>

#include <vector>

namespace mortise
{
  class FreePressures
  {
  public:
    /// @p one: the constant 1 on one such group, zero elsewhere; @p mass: its
    /// integrals against all pressures, int q. Collective.
    void
    add(const Vector &one, const Vector &mass);

    unsigned int
    size() const
    {
      return groups.size();
    }

    /// For factorisations, which have to have a regular system: the owned
    /// pressure of group @p g that is to be constrained, -1 on all ranks but one.
    int
    pinned(const unsigned int g) const
    {
      return groups[g].pinned;
    }

    /// Mean of p over group @p g. Collective.
    double
    mean(const unsigned int g, const Vector &p) const
    {
      return (groups[g].mass * p) / groups[g].volume;
    }

    /// p less its mean over each group. Collective.
    void
    project(Vector &p) const
    {
      for (unsigned int g = 0; g < groups.size(); ++g)
        p.add(-mean(g, p), groups[g].one);
    }

    /// r less what a constant change of volume brings into it, so that it does
    /// not see the constants. Collective.
    void
    project_residual(Vector &r) const
    {
      for (const Group &group : groups)
        r.add(-(group.one * r) / group.volume, group.mass);
    }

  private:
    struct Group
    {
      Vector one, mass;
      double volume;
      int    pinned; ///< owned pressure, -1 on all ranks but one
    };

    std::vector<Group> groups;
  };
} // namespace mortise
