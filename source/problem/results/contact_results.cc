// See contact_results.h.
#include <deal.II/base/mpi.h>

#include <mortise/mortar/nodal_block.h>
#include <mortise/problem/results/contact_checks.h>
#include <mortise/problem/results/contact_results.h>
#include <mortise/problem/support/rigid_support.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Beside how far sides move: a user should know.
    constexpr double large_penetration = 0.1;

    /// Beside coordinates, by which meshes that touch may overlap.
    constexpr double rounding_of_places = 1e-14;

    /// The largest coordinate of @p body, about. Collective.
    double
    largest_coordinate(const Body &body)
    {
      const Extent where = extent(body);
      return where.centre.norm() + where.size;
    }

    /// Number of the first owned node of interface @p i.
    unsigned int
    first_node(const Pairing &interfaces, const unsigned int i)
    {
      unsigned int first = 0;
      for (unsigned int j = 0; j < i; ++j)
        first += interfaces.all()[j].contact_nodes.size();
      return first;
    }

    FrictionSummary
    friction_summary(const StepEvaluation &step, const unsigned int i)
    {
      const MPI_Comm       comm     = step.run.comm;
      const Coupling      &coupling = step.discretisation.interfaces().all()[i];
      const SolvedContact &contact  = step.solved.contact;
      const Vector        &lambda   = step.solved.solution.multiplier;
      FrictionSummary      result;
      Tensor<1, dim>       force;
      unsigned int         k = first_node(step.discretisation.interfaces(), i);
      for (const ContactNode &node : coupling.contact_nodes)
        {
          result.stick += contact.statuses[k] == NodeStatus::stick ? 1 : 0;
          result.slip += contact.statuses[k] == NodeStatus::slip ? 1 : 0;
          result.slip_max = std::max(result.slip_max, contact.slips[k].norm());
          result.dissipated_energy += contact.dissipated[k];
          for (unsigned int r = 0; r < node.n_multipliers; ++r)
            force -= lambda.begin()[node.multipliers[r]] *
                     (node.forces[r] - node.pressure_forces[r]);
          ++k;
        }
      result.stick    = Utilities::MPI::sum(result.stick, comm);
      result.slip     = Utilities::MPI::sum(result.slip, comm);
      result.slip_max = Utilities::MPI::max(result.slip_max, comm);
      result.dissipated_energy =
        Utilities::MPI::sum(result.dissipated_energy, comm);
      if (coupling.number < contact.dissipated_apart.size())
        result.dissipated_energy += contact.dissipated_apart[coupling.number];
      result.force = components(Utilities::MPI::sum(force, comm));
      return result;
    }

    /// By owned multiplier: @p value(node, its number, its multiplier's) at the
    /// nodes of interface @p i.
    template <typename Value>
    Vector
    by_multiplier(const StepEvaluation &step,
                  const unsigned int    i,
                  const Value          &value)
    {
      const Pairing &interfaces = step.discretisation.interfaces();
      Vector         result(step.solved.solution.multiplier);
      unsigned int   k = first_node(interfaces, i);
      for (const ContactNode &node : interfaces.all()[i].contact_nodes)
        {
          for (unsigned int r = 0; r < node.n_multipliers; ++r)
            result.begin()[node.multipliers[r]] = value(node, k, r);
          ++k;
        }
      return result;
    }

    double
    pressure_at(const StepEvaluation &step, const ContactNode &node)
    {
      return node.pressure(step.solved.solution.multiplier.begin());
    }

    /// By slave face: the values at the nodes of a scalar that is the same for
    /// all multipliers of a node.
    std::vector<std::vector<double>>
    scalar_at_nodes(const StepEvaluation &step,
                    const unsigned int    i,
                    const Vector         &field)
    {
      const Coupling &coupling = step.discretisation.interfaces().all()[i];
      auto            values   = values_by_row(coupling, field, step.run.comm);
      for (unsigned int s = 0; s < values.size(); ++s)
        {
          // of the component that most of the normal is in, since others may be
          // prescribed at a rim
          const unsigned int n      = coupling.multipliers->rows()[s].n_nodes();
          const auto        &normal = coupling.frames[s][0][0];
          unsigned int       most   = 0;
          for (unsigned int c = 1; c < dim && values[s].size() > n; ++c)
            if (std::fabs(normal[c]) > std::fabs(normal[most]))
              most = c;
          values[s] = {values[s].begin() + most * n,
                       values[s].begin() + (most + 1) * n};
        }
      return values;
    }

    ContactSummary
    contact_summary(const StepEvaluation &step, const unsigned int i)
    {
      const MPI_Comm       comm     = step.run.comm;
      const Coupling      &coupling = step.discretisation.interfaces().all()[i];
      const auto          &about    = step.run.parameters.output.moments_about;
      const SolvedContact &contact  = step.solved.contact;
      const Vector        &lambda   = step.solved.solution.multiplier;
      const std::vector<double> &gaps = step.gaps(); // collective
      ContactSummary             result;
      Tensor<1, dim>             force, moment;
      double       work = 0., least = std::numeric_limits<double>::max();
      unsigned int k = first_node(step.discretisation.interfaces(), i);
      for (const ContactNode &node : coupling.contact_nodes)
        {
          const bool active = contact.statuses[k] != NodeStatus::open;
          least             = std::min(least, gaps[k]);
          result.undecided += contact.undecided[k] ? 1 : 0;
          ++(active ? result.active : result.inactive);
          ++k;
          if (!active)
            continue;
          for (unsigned int r = 0; r < node.n_multipliers; ++r)
            {
              const double traction = lambda.begin()[node.multipliers[r]];
              result.area += node.pressed_areas[r];
              work += traction * node.pressures[r];
              force -= traction * node.forces[r];
              moment -= traction * node.moments[r];
            }
        }
      const Vector pressures =
        by_multiplier(step, i, [&](const ContactNode &node, auto, auto) {
          return pressure_at(step, node);
        });
      for (const auto &of_face : scalar_at_nodes(step, i, pressures))
        for (const double pressure : of_face)
          result.pressure_max = std::max(result.pressure_max, pressure);
      result.area          = Utilities::MPI::sum(result.area, comm);
      work                 = Utilities::MPI::sum(work, comm);
      result.pressure_mean = result.area > 0. ? work / result.area : 0.;
      result.pressure_max  = Utilities::MPI::max(result.pressure_max, comm);
      result.gap_min       = Utilities::MPI::min(least, comm);
      result.force         = components(Utilities::MPI::sum(force, comm));
      moment -=
        cross_product_3d(Tensor<1, dim>({about[0], about[1], about[2]}), force);
      result.moment = components(Utilities::MPI::sum(moment, comm));
      for (std::uint64_t *count :
           {&result.active, &result.inactive, &result.undecided})
        *count = Utilities::MPI::sum(*count, comm);
      if (coupling.law.has_friction())
        result.friction = friction_summary(step, i);
      return result;
    }
  } // namespace

  void
  add_contact(const StepEvaluation &step, StepSummary &summary)
  {
    const Pairing &interfaces = step.discretisation.interfaces();
    RunLog        &log        = step.run.log;
    for (unsigned int i = 0; i < interfaces.all().size(); ++i)
      {
        if (interfaces.all()[i].law.is_one_sided())
          {
            const double               moved = relative_motion(step, i);
            const InterfaceParameters &given = interfaces.sides()[i];
            if (!given.follows_bodies)
              check_partners(step, i, moved);
            ContactSummary contact  = contact_summary(step, i);
            contact.motion_max      = moved;
            contact.penetration_max = step.penetration(i);
            if (contact.undecided > 0)
              log.warning(
                "interface " + given.name + ": at " +
                std::to_string(contact.undecided) + " of " +
                std::to_string(contact.active + contact.inactive) +
                " nodes pressure and gap are zero to rounding, so that the contact area is not determined there");
            if (!given.follows_bodies &&
                contact.penetration_max > large_penetration * moved &&
                contact.penetration_max >
                  rounding_of_places *
                    largest_coordinate(
                      *step.discretisation.bodies()[given.slave.body]))
              log.warning(
                "interface " + given.name + ": the bodies overlap by up to " +
                RunLog::number(contact.penetration_max) +
                " between nodes, of " + RunLog::number(moved) +
                " of relative motion; the contact there is smaller than the faces of the slave, which should be finer");
            warn_of_large_motion(step, i, moved);
            if (contact.friction)
              warn_of_large_slip(step, i, contact.friction->slip_max);
            summary.interfaces[i].contact = contact;
          }
      }
  }

  std::vector<std::vector<double>>
  contact_fields(const StepEvaluation &step, const unsigned int i)
  {
    const Coupling &coupling = step.discretisation.interfaces().all()[i];
    if (!coupling.law.is_one_sided())
      return {};
    const SolvedContact &contact      = step.solved.contact;
    const bool           has_friction = coupling.law.has_friction();
    const auto           status       = [&](const unsigned int k) {
      return contact.statuses[k] == NodeStatus::open ? 0. :
                             has_friction && contact.statuses[k] == NodeStatus::stick ? 2. :
                                                                                        1.;
    };
    const auto &traces = coupling.interface->slave().traces;
    std::vector<std::vector<double>> by_face(traces.size());
    // coefficients from values at nodes, n at a time
    const auto add = [&](const std::vector<std::vector<double>> &values) {
      for (unsigned int s = 0; s < traces.size(); ++s)
        {
          const auto &functions =
            face_nodal_basis(traces[s].shape, traces[s].degree).functions;
          for (auto from = values[s].begin(); from != values[s].end();
               from += functions.n())
            for (unsigned int k = 0; k < functions.m(); ++k)
              by_face[s].push_back(std::inner_product(
                from, from + functions.n(), &functions(k, 0), 0.));
        }
    };
    using Node = ContactNode;
    for (const Vector &field :
         {by_multiplier(step,
                        i,
                        [&](const Node &node, auto, auto) {
                          return pressure_at(step, node);
                        }),
          by_multiplier(step,
                        i,
                        [&](const Node &, const unsigned int k, auto) {
                          return step.gaps()[k];
                        }),
          by_multiplier(step, i, [&](const Node &, const unsigned int k, auto) {
            return status(k);
          })})
      add(scalar_at_nodes(step, i, field));
    if (has_friction)
      add(values_by_row(coupling,
                        by_multiplier(step,
                                      i,
                                      [&](const Node &,
                                          const unsigned int k,
                                          const unsigned int r) {
                                        return contact.slips[k][r];
                                      }),
                        step.run.comm));
    return by_face;
  }
} // namespace mortise
