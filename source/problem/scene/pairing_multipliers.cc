#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/mortar/interface_order.h>
#include <mortise/mortar/slave_frames.h>
#include <mortise/problem/scene/pairing.h>
#include <mortise/problem/support/rigid_motions.h>
#include <mortise/problem/support/weak_ties.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Of the slave surface. Collective.
    Tensor<1, dim>
    mean_normal(const TieSupport &tie, const MPI_Comm comm)
    {
      Tensor<1, dim> sum;
      for (const auto &sample : tie.samples)
        sum += sample.area * sample.normal;
      sum               = Utilities::MPI::sum(sum, comm);
      const double norm = sum.norm();
      return norm > 0. ? sum / norm : sum;
    }
  } // namespace

  std::vector<bool>
  Pairing::constrained_dofs(const unsigned int       b,
                            const std::vector<bool> &coupled) const
  {
    const auto       &numbering = spaces.fields.displacement.numbering;
    std::vector<bool> constrained;
    for (const auto dof : spaces.bodies[b]->dof_handler.locally_owned_dofs())
      constrained.push_back(
        coupled[numbering.owned().index_within_set(numbering(b, dof))] ||
        (spaces.constraints[b].is_constrained(dof) &&
         !spaces.bodies[b]->conformity.is_constrained(dof)));
    return constrained;
  }

  void
  Pairing::check_constants(const unsigned int               i,
                           const std::vector<PartnerState> &states) const
  {
    const std::string name    = couplings[i].interface->name();
    const auto       &rows    = couplings[i].multipliers->rows();
    unsigned int      n_fixed = 0, n_covered = 0;
    const bool        slides =
      couplings[i].law.constrained == ConstrainedDirections::normal;
    std::string lost;
    for (unsigned int s = 0; s < states.size(); ++s)
      if (states[s].cover != FaceCoverage::none)
        for (unsigned int c = 0; c < (slides ? 1 : dim); ++c)
          {
            ++n_covered;
            if (rows[s].reproduce_constants[c])
              continue;
            ++n_fixed;
            if (!states[s].has_free_displacement[c] || !lost.empty())
              continue;
            std::ostringstream text;
            text << "Interface " << name << ": nothing is tied "
                 << (slides ? "along the normal" :
                              std::string("in direction ") + "xyz"[c])
                 << " at "
                 << couplings[i]
                      .interface->slave()
                      .cells[s]
                      ->face(couplings[i].interface->slave().face_numbers[s])
                      ->center()
                 << ", since other interfaces determine all displacements of "
                    "the slave there; exchange slave and master";
            lost = text.str();
          }
    if (slides)
      if (const auto sample =
            find_sharp_edge(*spaces.bodies[interfaces[i].slave.body],
                            couplings[i].interface->slave()))
        {
          std::ostringstream text;
          text
            << "Interface " << name << ": bodies slide across an edge of "
            << side_text(run.parameters, interfaces[i].slave) << " at "
            << *sample
            << ", where the surface has no normal: the edge ends within a smooth "
               "patch. Make what lies on either side of it boundaries, and "
               "interfaces, of their own, or refine a mesh that is too "
               "coarse for a round surface";
          lost = text.str();
        }
    throw_if_any(lost, run.comm);
    n_fixed   = Utilities::MPI::sum(n_fixed, run.comm);
    n_covered = Utilities::MPI::sum(n_covered, run.comm);
    if (n_covered == 0 && interfaces[i].follows_bodies)
      run.log.line("  interface " + name + ": the surfaces do not meet");
    else if (n_covered == 0)
      run.log.warning("interface " + name +
                      ": the surfaces hardly meet; nothing is tied");
    else if (n_fixed == n_covered)
      run.log.warning(
        "interface " + name +
        ": no multipliers are left, since every displacement of both "
        "surfaces is prescribed; nothing is tied");
  }

  void
  Pairing::number_multipliers()
  {
    const auto     states = partner_states(couplings);
    InterfaceOrder shared(couplings,
                          states,
                          spaces.fields.displacement.numbering,
                          run.comm);
    // supports of one boundary take nothing from each other
    std::map<std::string, std::vector<bool>> taken_before;
    for (const unsigned int i : shared.order())
      {
        std::vector<bool> coupled =
          interfaces[i].direction ?
            taken_before.try_emplace(interfaces[i].boundary, shared.coupled())
              .first->second :
            shared.coupled();
        const SideParameters &slave    = interfaces[i].slave;
        const Body           &body     = *spaces.bodies[slave.body];
        Coupling             &coupling = couplings[i];
        if (coupling.is_turned)
          for (const unsigned int k : shared.on_axis(i))
            coupled[k] = true;
        coupling.multipliers = std::make_unique<MultiplierSpace>(
          body, coupling, states[i], constrained_dofs(slave.body, coupled));
        shared.add(i);
      }
    types::global_dof_index mine = 0;
    for (const Coupling &coupling : couplings)
      mine += coupling.multipliers->n_owned();
    owned                 = owned_range(mine, run.comm);
    const auto   first    = mine > 0 ? owned.nth_index_in_set(0) : 0;
    unsigned int n_before = 0;
    for (Coupling &coupling : couplings)
      {
        coupling.multipliers->number(coupling.interface->slave(),
                                     first + n_before,
                                     n_before);
        n_before = coupling.multipliers->range().end();
      }
  }

  std::vector<TieSupport>
  Pairing::tie_supports() const
  {
    std::vector<TieSupport> ties;
    for (unsigned int i = 0; i < couplings.size(); ++i)
      {
        const InterfaceReport &report = couplings[i].interface->report();
        ties.push_back({couplings[i].interface->name(),
                        interfaces[i].slave.body,
                        interfaces[i].is_support ? TieSupport::ground :
                                                   interfaces[i].master.body,
                        multiplier_moments(couplings[i], owned, run.comm),
                        couplings[i].placement,
                        report.covered_area / report.slave_area,
                        couplings[i].law.constrained,
                        {},
                        {},
                        {}});
        const BodySurface &slave = couplings[i].interface->slave();
        for (unsigned int s = 0; s < slave.faces.size(); ++s)
          {
            const auto   face = slave.cells[s]->face(slave.face_numbers[s]);
            const double area = couplings[i].interface->coverage()[s] *
                                std::pow(slave.faces[s].size, 2);
            for (const unsigned int v : face->vertex_indices())
              ties.back().samples.push_back(
                {face->vertex(v),
                 area,
                 slave.direction.value_or(slave.faces[s].vertex_normals[v])});
          }
      }
    return ties;
  }

  void
  Pairing::choose_multipliers()
  {
    number_multipliers();
    std::vector<bool> tried(couplings.size(), false), can_exchange;
    for (unsigned int i = 0; i < couplings.size(); ++i)
      {
        const InterfaceParameters &given = interfaces[i];
        can_exchange.push_back(!given.is_support && !is_patch(i) &&
                               !given.follows_bodies &&
                               given.periodic == Periodicity::none);
        if (!can_exchange.back())
          continue;
        const auto &master =
          run.parameters.bodies[given.master.body].boundaries;
        const auto is_prescribed = [&](const std::string &boundary) {
          const auto side = master.find(boundary);
          return side != master.end() &&
                 (side->second.displacement || side->second.is_rigid());
        };
        can_exchange.back() =
          !is_rigid(run.parameters.bodies[given.master.body].material) &&
          std::none_of(given.master.boundaries.begin(),
                       given.master.boundaries.end(),
                       is_prescribed);
      }
    auto ties = tie_supports();
    auto weak = weak_ties(
      spaces.bodies, spaces.dirichlet, spaces.rigid_parts, ties, can_exchange);
    for (unsigned int k = 0; k < weak.size();)
      {
        const unsigned int   i     = weak[k++];
        InterfaceParameters &given = interfaces[i];
        if (tried[i])
          continue;
        tried[i] = true;
        std::swap(given.slave, given.master);
        Coupling other =
          make_coupling(given, given.name, faces_of(given, given.slave));
        integrate(given, other);
        other.number = couplings[i].number;
        std::swap(couplings[i], other);
        number_multipliers();
        const auto other_ties = tie_supports();
        const auto still      = weak_ties(spaces.bodies,
                                     spaces.dirichlet,
                                     spaces.rigid_parts,
                                     other_ties,
                                     can_exchange);
        if (still.size() < weak.size())
          {
            run.log.line("  interface " + given.name +
                         ": slave and master exchanged, since too few "
                         "displacements of the slave are left for multipliers");
            ties = other_ties;
            weak = still;
            k    = 0;
          }
        else
          {
            std::swap(given.slave, given.master);
            std::swap(couplings[i], other);
            number_multipliers();
          }
      }
    const auto states = partner_states(couplings);
    for (unsigned int i = 0; i < couplings.size(); ++i)
      check_constants(i, states[i]);
    for (unsigned int i = 0; i < couplings.size(); ++i)
      if (interfaces[i].preload)
        ties[i].released = mean_normal(ties[i], run.comm);
    check_rigid_motions(spaces.bodies,
                        spaces.dirichlet,
                        spaces.rigid_parts,
                        ties);
    if (have_contact())
      {
        supports = std::move(ties);
        set_contact_nodes();
      }
  }

  std::string
  Pairing::count_by_name(
    const std::vector<types::global_dof_index> &indices) const
  {
    std::vector<unsigned int> counts;
    for (const Coupling &coupling : couplings)
      {
        const auto first = coupling.multipliers->first(),
                   end   = first + coupling.multipliers->n_owned();
        counts.push_back(
          std::count_if(indices.begin(), indices.end(), [&](const auto k) {
            return k >= first && k < end;
          }));
      }
    Utilities::MPI::sum(counts, run.comm, counts);
    std::string names;
    for (unsigned int i = 0; i < counts.size(); ++i)
      if (counts[i] > 0)
        names += (names.empty() ? "" : ", ") + couplings[i].interface->name() +
                 " (" + std::to_string(counts[i]) + ")";
    return names;
  }
} // namespace mortise
