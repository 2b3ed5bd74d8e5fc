// The interfaces of a scene in one configuration: pairs of faces, integrals,
// and multipliers.
#pragma once

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
    /// Pair the sides of all interfaces where they are, the meshes or those that @p displaced
    /// moves, by body; integrate, and choose multipliers, with slave and master
    /// exchanged where other interfaces and prescribed displacements leave too
    /// few to hold the bodies together. @p run and @p spaces must live on.
    /// Collective; throws InputError where surfaces do not meet, a body can
    /// move or constant tractions do not pass.
    Pairing(const RunContext                &run,
            const SceneSpaces               &spaces,
            const std::vector<BodySolution> *displaced = nullptr);

    /// By interface, with the sides as they are solved. Where bodies slide and
    /// the slave's boundary has edges, each of its smooth patches is an
    /// interface.
    const std::vector<InterfaceParameters> &
    sides() const
    {
      return interfaces;
    }

    /// The slave of interface @p i by the parameters; sides() may have it as
    /// master.
    unsigned int
    given_slave(unsigned int i) const;

    const std::vector<Coupling> &
    all() const
    {
      return couplings;
    }

    /// Let @p active multipliers take part, by owned one. Collective.
    void
    select(const std::vector<bool> &active);

    /// Throws InputError that names the bodies which @p active multipliers, by owned one,
    /// do not hold, and their motions. @p is_preloaded, by interface: its force is given
    /// now, and its sides come as close as that takes. Collective.
    void
    check_held(const std::vector<bool> &active,
               const std::vector<bool> &is_preloaded) const;

    /// Those that @p active multipliers, by owned one, leave. @p is_preloaded as for check_held().
    /// Collective.
    FreeMotions
    free_motions(const std::vector<bool> &active,
                 const std::vector<bool> &is_preloaded) const;

    /// Does an interface let bodies slide?
    bool
    slide() const
    {
      return std::any_of(couplings.begin(),
                         couplings.end(),
                         [](const Coupling &coupling) {
                           return coupling.law.held == HeldDirections::normal;
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

    /// What is known of interface @p i before anything is solved. Collective.
    InterfaceSummary
    summary(unsigned int i) const;

    /// How evenly the ranks share the interfaces.
    std::vector<BalanceSummary>
    balance() const;

    /// How many of the owned multipliers in @p indices (of all ranks) each
    /// interface has: "name (12), other (3)", without those that have none.
    /// Collective.
    std::string
    count_by_name(
      const std::vector<dealii::types::global_dof_index> &indices) const;

  private:
    /// Find what faces each other, and integrate.
    void
    find_and_integrate();
    void
    choose_multipliers();
    void
    find_pairs();
    /// Where the gap between the meshes is not what is meant.
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
    /// That of patch @p k; no body and no interface has it.
    std::string
    patch_name(const InterfaceParameters &given, unsigned int k) const;
    bool
    is_patch(const unsigned int i) const
    {
      return couplings[i].interface->name() != interfaces[i].name;
    }
    /// Patches that meet nothing are no interfaces, where others of the same
    /// boundary do.
    void
    drop_patches_apart();
    void
    integrate(const InterfaceParameters &given, Coupling &coupling) const;
    /// Throws or warns where the surfaces of interface @p i do not meet.
    void
    check_overlap(unsigned int i) const;
    void
    number_multipliers();
    /// Throws InputError where one has no area. Collective.
    void
    set_normal_multipliers();
    std::vector<TieSupport>
    tie_supports() const;
    /// The ties of active multipliers, in scenes with contact.
    std::vector<TieSupport>
    supports_of(const std::vector<bool> &active,
                const std::vector<bool> &is_preloaded) const;
    /// Throws InputError where constant tractions do not pass interface @p i, though its master
    /// could follow. @p states: of its slave faces.
    void
    check_constants(unsigned int                     i,
                    const std::vector<PartnerState> &states) const;
    /// Owned displacement dofs of body @p b that are prescribed or among @p taken, those of the
    /// scene.
    std::vector<bool>
    blocked_dofs(unsigned int b, const std::vector<bool> &taken) const;

    const RunContext                &run;
    const SceneSpaces               &spaces;
    const std::vector<BodySolution> *displaced; ///< for the constructor
    std::vector<InterfaceParameters> interfaces;
    std::vector<Coupling>            couplings;
    dealii::IndexSet                 owned;
    std::vector<TieSupport>          supports; ///< by interface, with contact
  };
} // namespace mortise
