// The interfaces of a scene in one configuration: pairs of faces, integrals,
// and multipliers.
#pragma once

#include <mortise/operators/scene_solution.h>
#include <mortise/output/summary.h>
#include <mortise/problem/scene/scene_spaces.h>
#include <mortise/problem/support/rigid_support.h>

#include <algorithm>
#include <vector>

namespace mortise
{
  class Pairing
  {
  public:
    /// Pair the sides of all interfaces on the meshes, those that follow the
    /// bodies displaced by the solutions @p displaced, by body, within @p least_search at least;
    /// integrate, and choose multipliers.
    /// Slave and master are exchanged if other interfaces and prescribed
    /// displacements leave too few multipliers to tie the bodies. @p run and
    /// @p spaces must live on. Collective; throws InputError if surfaces do not
    /// meet, a rigid motion is free or constant tractions are not exact.
    Pairing(const RunContext                &run,
            const SceneSpaces               &spaces,
            const std::vector<BodySolution> *displaced    = nullptr,
            double                           least_search = 0.);

    /// By interface, slave and master possibly exchanged. If bodies slide and
    /// the slave's boundary has edges, each of its smooth patches is an
    /// interface.
    const std::vector<InterfaceParameters> &
    sides() const
    {
      return interfaces;
    }

    /// Body of the slave of interface @p i in the parameters, perhaps the
    /// master in sides().
    unsigned int
    given_slave(unsigned int i) const;

    const std::vector<Coupling> &
    all() const
    {
      return couplings;
    }

    /// By owned node of contact, interface by interface.
    std::vector<const ContactNode *>
    contact_nodes() const;

    /// Set the @p statuses of contact_nodes() for penalties. Collective.
    void
    select(const std::vector<NodeStatus> &statuses);

    /// Throws InputError with the bodies that have free rigid motions with
    /// these
    /// @p laws of contact_nodes(). @p is_preloaded, by interface: is its normal
    /// force given, so that its sides may approach each other? Collective.
    void
    check_no_free_motion(const std::vector<Friction> &laws,
                         const std::vector<bool>     &is_preloaded) const;

    /// Free rigid motions; arguments of check_no_free_motion(). Collective.
    FreeMotions
    free_motions(const std::vector<Friction> &laws,
                 const std::vector<bool>     &is_preloaded) const;

    /// Does an interface have multipliers along normals alone?
    bool
    slide() const
    {
      return std::any_of(couplings.begin(),
                         couplings.end(),
                         [](const Coupling &coupling) {
                           return coupling.law.constrained ==
                                  ConstrainedDirections::normal;
                         });
    }

    /// Is a multiplier of any interface more than a component of the traction?
    bool
    have_frames() const
    {
      return slide() || have_springs() ||
             std::any_of(couplings.begin(),
                         couplings.end(),
                         [](const Coupling &coupling) {
                           return coupling.is_directed() || coupling.is_turned;
                         });
    }

    /// Do pairs of any interface follow the bodies?
    bool
    follow() const
    {
      return std::any_of(interfaces.begin(),
                         interfaces.end(),
                         [](const InterfaceParameters &given) {
                           return given.follows_bodies;
                         });
    }

    bool
    have_contact() const
    {
      return std::any_of(couplings.begin(),
                         couplings.end(),
                         [](const Coupling &coupling) {
                           return coupling.law.is_one_sided();
                         });
    }

    bool
    have_friction() const
    {
      return std::any_of(couplings.begin(),
                         couplings.end(),
                         [](const Coupling &coupling) {
                           return coupling.law.has_friction();
                         });
    }

    bool
    have_springs() const
    {
      return std::any_of(couplings.begin(),
                         couplings.end(),
                         [](const Coupling &coupling) {
                           return coupling.law.is_compliant();
                         });
    }

    /// Of the scene; of size 0 without interfaces.
    const dealii::IndexSet &
    owned_multiplier() const
    {
      return owned;
    }

    /// The part of the summary of interface @p i that needs no solution.
    /// Collective.
    InterfaceSummary
    summary(unsigned int i) const;

    /// Distribution of the interfaces over the ranks.
    std::vector<BalanceSummary>
    balance() const;

    /// Numbers of the multipliers @p indices by interface, "name (12), other
    /// (3)". Collective.
    std::string
    count_by_name(
      const std::vector<dealii::types::global_dof_index> &indices) const;

  private:
    /// Find pairs and integrate.
    void
    find_and_integrate();
    void
    choose_multipliers();
    /// The slaves of couplings.
    std::vector<std::vector<BoundaryFace>>
    find_pairs();
    /// Are all displacements zero?
    bool
    is_start() const;
    /// Take the pairs of an overlap of the bodies that is deeper than the
    /// search distance of interface @p i, if there is one. @p slave: its
    /// faces. Collective.
    void
    find_overlap(unsigned int i, const std::vector<BoundaryFace> &slave);
    /// Warn if the mesh gap is not small.
    void
    warn_of_mesh_gap(unsigned int i) const;
    /// @p name: of the interface, or of a patch; @p slave: its faces.
    Coupling
    make_coupling(const InterfaceParameters       &given,
                  const std::string               &name,
                  const std::vector<BoundaryFace> &slave) const;
    std::vector<BoundaryFace>
    faces_of(const InterfaceParameters &given,
             const SideParameters      &side) const;
    /// A unique name for patch @p k.
    std::string
    patch_name(const InterfaceParameters &given, unsigned int k) const;
    bool
    is_patch(const unsigned int i) const
    {
      return couplings[i].interface->name() != interfaces[i].name;
    }
    /// Drop patches without partners if others of their boundary have some.
    void
    drop_patches_apart();
    void
    integrate(const InterfaceParameters &given, Coupling &coupling) const;
    /// Throws or warns if the surfaces of interface @p i do not meet.
    void
    check_overlap(unsigned int i) const;
    void
    number_multipliers();
    /// Throws InputError if one has no area. Collective.
    void
    set_contact_nodes();
    std::vector<TieSupport>
    tie_supports() const;
    /// The ties of nodes with these @p laws, in scenes with contact.
    std::vector<TieSupport>
    supports_of(const std::vector<Friction> &laws,
                const std::vector<bool>     &is_preloaded) const;
    /// Throws InputError if constant tractions are not exact on interface @p i,
    /// although displacements there are free. @p states: of its slave faces.
    void
    check_constants(unsigned int                     i,
                    const std::vector<PartnerState> &states) const;
    /// By owned displacement dof of body @p b: is it prescribed or @p coupled (by
    /// owned displacement of the scene)?
    std::vector<bool>
    constrained_dofs(unsigned int b, const std::vector<bool> &coupled) const;

    const RunContext                &run;
    const SceneSpaces               &spaces;
    const std::vector<BodySolution> *displaced;    ///< for the constructor
    const double                     least_search; ///< likewise
    std::vector<InterfaceParameters> interfaces;
    std::vector<Coupling>            couplings;
    dealii::IndexSet                 owned;
    std::vector<TieSupport>          supports; ///< by interface, with contact
  };
} // namespace mortise
