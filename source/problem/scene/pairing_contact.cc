// Contact of a Pairing: its nodes, and what they hold.
#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/problem/scene/pairing.h>
#include <mortise/problem/support/rigid_motions.h>

#include <string>
#include <utility>

namespace mortise
{
  using namespace dealii;

  void
  Pairing::set_contact_nodes()
  {
    std::string nowhere;
    for (Coupling &coupling : couplings)
      if (coupling.law.is_one_sided())
        {
          coupling.contact_nodes =
            mortise::contact_nodes(coupling, owned, run.comm);
          for (const ContactNode &node : coupling.contact_nodes)
            if (!(node.area > 0.))
              nowhere = coupling.interface->name();
        }
    throw_if_any(
      nowhere.empty() ?
        "" :
        "Interface " + nowhere +
          ": a multiplier of the contact has no area, since too "
          "little of its faces has a partner; move the surfaces, or exchange slave and master",
      run.comm);
  }

  std::vector<const ContactNode *>
  Pairing::contact_nodes() const
  {
    std::vector<const ContactNode *> result;
    for (const Coupling &coupling : couplings)
      for (const ContactNode &node : coupling.contact_nodes)
        result.push_back(&node);
    return result;
  }

  namespace
  {
    /// Add to @p tie what the multipliers @p all of a coupling, the first of
    /// which is @p first, hold at @p node. One that slips is held along the normal
    /// and, by the force that slips along with it, across its direction.
    void
    add_moments(const ContactNode                   &node,
                const Friction                      &law,
                const std::vector<MultiplierMoment> &all,
                const unsigned int                   first,
                TieSupport                          &tie)
    {
      if (law.status == NodeStatus::open)
        return;
      const auto along = [&](const Tensor<1, dim> &direction) {
        MultiplierMoment sum;
        for (unsigned int r = 0; r < node.n_multipliers; ++r)
          {
            const MultiplierMoment &own = all[node.multipliers[r] - first];
            sum.weight += direction[r] * own.weight;
            sum.moment += direction[r] * own.moment;
          }
        return sum;
      };
      if (law.status == NodeStatus::stick)
        for (unsigned int r = 0; r < node.n_multipliers; ++r)
          tie.multipliers.push_back(all[node.multipliers[r] - first]);
      else
        tie.multipliers.push_back(along(node.kinematic_normal()));
      if (law.status == NodeStatus::slip && node.n_multipliers == dim &&
          law.bound > 0.)
        tie.across_slip.push_back(
          along(node.kinematic * cross_product_3d(node.normal, law.direction)));
    }
  } // namespace

  std::vector<TieSupport>
  Pairing::supports_of(const std::vector<Friction> &laws,
                       const std::vector<bool>     &is_preloaded) const
  {
    auto         ties   = supports;
    unsigned int number = 0;
    for (unsigned int i = 0; i < ties.size(); ++i)
      {
        TieSupport &tie = ties[i];
        if (!is_preloaded[i])
          tie.released.reset();
        if (!couplings[i].law.is_one_sided())
          continue;
        const auto all    = std::exchange(tie.multipliers, {});
        bool       sticks = false;
        for (const ContactNode &node : couplings[i].contact_nodes)
          {
            const Friction &law = laws[number++];
            sticks              = sticks || law.status == NodeStatus::stick;
            add_moments(
              node, law, all, couplings[i].multipliers->range().first, tie);
          }
        if (Utilities::MPI::max(sticks ? 1 : 0, run.comm) == 0)
          tie.constrained = ConstrainedDirections::normal;
      }
    return ties;
  }

  void
  Pairing::check_no_free_motion(const std::vector<Friction> &laws,
                                const std::vector<bool>     &is_preloaded) const
  {
    check_rigid_motions(spaces.bodies,
                        spaces.dirichlet,
                        spaces.rigid_parts,
                        supports_of(laws, is_preloaded));
  }

  FreeMotions
  Pairing::free_motions(const std::vector<Friction> &laws,
                        const std::vector<bool>     &is_preloaded) const
  {
    return find_free_motions(spaces.bodies,
                             spaces.dirichlet,
                             spaces.rigid_parts,
                             supports_of(laws, is_preloaded));
  }

  void
  Pairing::select(const std::vector<NodeStatus> &statuses)
  {
    auto next = statuses.begin();
    for (Coupling &coupling : couplings)
      if (coupling.law.is_one_sided())
        {
          const auto end = next + coupling.contact_nodes.size();
          select_nodes({next, end}, owned, run.comm, coupling);
          next = end;
        }
  }
} // namespace mortise
