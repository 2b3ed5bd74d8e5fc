#include <deal.II/base/mpi.h>

#include <mortise/body/boundary_faces.h>
#include <mortise/problem/simulation.h>

namespace mortise
{
  using namespace dealii;

  std::vector<bool>
  Simulation::blocked_dofs(const unsigned int b) const
  {
    std::vector<bool> blocked = occupied[b];
    unsigned int      i       = 0;
    for (const auto dof : bodies[b]->dof_handler.locally_owned_dofs())
      {
        if (body_constraints[b].is_constrained(dof) &&
            !bodies[b]->conformity.is_constrained(dof))
          blocked[i] = true;
        ++i;
      }
    return blocked;
  }

  void
  Simulation::occupy(const unsigned int i)
  {
    const SideParameters &slave  = parameters.interfaces[i].slave,
                         &master = parameters.interfaces[i].master;
    const auto mark              = [&](const unsigned int            b,
                          const types::global_dof_index dof) {
      const IndexSet &owned = bodies[b]->dof_handler.locally_owned_dofs();
      if (owned.is_element(dof))
        occupied[b][owned.index_within_set(dof)] = true;
    };
    for (const auto dof : couplings[i].multipliers->slave_dofs())
      mark(slave.body, dof);
    const Body &body = *bodies[master.body];
    for (const auto &[cell, f] :
         boundary_faces(body, body.boundary_id(master.boundary, "")))
      for (const auto &component : face_dofs(cell, f))
        for (const auto dof : component)
          mark(master.body, dof);
  }

  void
  Simulation::number_multipliers()
  {
    for (unsigned int i = 0; i < couplings.size(); ++i)
      {
        const SideParameters &slave    = parameters.interfaces[i].slave;
        const Body           &body     = *bodies[slave.body];
        Coupling             &coupling = couplings[i];
        coupling.multipliers =
          std::make_unique<MultiplierSpace>(body,
                                            body.boundary_id(slave.boundary,
                                                             ""),
                                            coupling.interface->slave(),
                                            partner_states(coupling),
                                            blocked_dofs(slave.body));
        if (Utilities::MPI::sum(coupling.multipliers->n_owned(), comm) == 0)
          log.warning(
            "interface " + parameters.interfaces[i].name +
            ": no multipliers are left, since every displacement of both surfaces is "
            "prescribed; nothing is tied");
        if (i + 1 < couplings.size())
          occupy(i);
      }
    types::global_dof_index mine = 0, first = 0, total = 0;
    for (const Coupling &coupling : couplings)
      mine += coupling.multipliers->n_owned();
    const auto counts = Utilities::MPI::all_gather(comm, mine);
    for (unsigned int rank = 0; rank < counts.size(); ++rank)
      {
        if (rank < Utilities::MPI::this_mpi_process(comm))
          first += counts[rank];
        total += counts[rank];
      }
    system.owned_multiplier.set_size(total);
    system.owned_multiplier.add_range(first, first + mine);
    for (Coupling &coupling : couplings)
      {
        coupling.multipliers->number(coupling.interface->slave(), first);
        first += coupling.multipliers->n_owned();
      }
    summary.steps.back().dofs.multiplier = total;
    summary.steps.back().dofs.total += total;
  }
} // namespace mortise
