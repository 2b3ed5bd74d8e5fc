// What a FrictionSet keeps from step to step.
#include <deal.II/base/mpi.h>

#include <mortise/problem/contact/friction_set.h>

namespace mortise
{
  using namespace dealii;

  void
  FrictionSet::set_origin(const Vector            &weighted_gaps,
                          const std::vector<bool> &which)
  {
    for (unsigned int i = 0; i < nodes.size(); ++i)
      if (nodes[i].has_friction && (which.empty() || which[i]))
        {
          nodes[i].origin += slip(nodes[i], weighted_gaps);
          nodes[i].touched = nodes[i].touched || !which.empty();
        }
  }

  void
  FrictionSet::set_origin(const Vector                           &weighted_gaps,
                          const std::vector<SlipOrigin::Opening> &openings)
  {
    for (unsigned int i = 0; i < nodes.size(); ++i)
      if (Node &node = nodes[i]; node.has_friction)
        {
          const ContactNode   &of     = *node.contact;
          const Tensor<1, dim> normal = of.kinematic_normal(),
                               moved  = of.opening - openings[i].mean;
          node.origin                 = Tensor<1, dim>();
          node.origin =
            slip(node, weighted_gaps) - (moved - (normal * moved) * normal);
          // a contact that moves over the slave has others in each step
          node.touched = node.touched || openings[i].has_partner;
        }
  }

  void
  FrictionSet::set_iterate(const Vector               &lambda,
                           const Vector               &weighted_gaps,
                           std::vector<ContactRecord> &records) const
  {
    for (unsigned int i = 0; i < nodes.size(); ++i)
      if (nodes[i].has_friction)
        {
          const ContactNode &of = *nodes[i].contact;
          records[i].traction   = of.in_space(of.traction(lambda.begin()));
          records[i].increment  = of.in_space(slip(nodes[i], weighted_gaps));
        }
  }

  std::vector<ContactRecord>
  FrictionSet::records(const std::vector<bool> &closed) const
  {
    std::vector<ContactRecord>  result;
    const std::vector<Friction> all = laws(closed);
    for (unsigned int i = 0; i < nodes.size(); ++i)
      {
        const ContactNode &node = *nodes[i].contact;
        ContactRecord     &own  = result.emplace_back();
        own.closed              = closed[i];
        own.slips               = all[i].status == NodeStatus::slip;
        own.traction            = node.in_space(nodes[i].traction);
        own.increment           = node.in_space(nodes[i].increment);
        own.slip                = node.in_space(total_slip[i]);
        own.dissipated          = dissipation[i];
      }
    return result;
  }

  void
  FrictionSet::restore(const std::vector<ContactRecord> &records)
  {
    for (unsigned int i = 0; i < nodes.size(); ++i)
      {
        Node &node   = nodes[i];
        node.touched = records[i].closed;
        node.law     = Friction();
        if (records[i].slips && node.contact->has_normal())
          {
            const Tensor<1, dim> traction = node.contact->in_frame(
              node.contact->along_axes(records[i].traction));
            node.law.status = NodeStatus::slip;
            node.law.bound  = traction.norm();
            if (node.law.bound > 0.)
              node.law.direction = traction / node.law.bound;
          }
        total_slip[i]  = node.contact->along_axes(records[i].slip);
        dissipation[i] = records[i].dissipated;
      }
  }

  void
  FrictionSet::set_dissipated(const std::vector<double> &all)
  {
    const auto &couplings = discretisation.interfaces().all();
    apart                 = all;
    for (const Coupling &coupling : couplings)
      if (apart.size() <= coupling.number)
        apart.resize(coupling.number + 1, 0.);
    std::vector<double> now(apart.size(), 0.);
    auto                next = dissipation.begin();
    for (const Coupling &coupling : couplings)
      for (unsigned int k = 0; k < coupling.contact_nodes.size(); ++k)
        now[coupling.number] += *next++;
    Utilities::MPI::sum(now, run.comm, now);
    for (unsigned int i = 0; i < apart.size(); ++i)
      apart[i] -= now[i];
  }

  void
  FrictionSet::guess(const std::vector<ContactRecord> &records)
  {
    stick();
    for (unsigned int i = 0; i < nodes.size(); ++i)
      if (Node &node = nodes[i];
          node.has_friction && records[i].slips && node.contact->has_normal())
        {
          const ContactNode   &of       = *node.contact;
          const Tensor<1, dim> traction = of.along_axes(records[i].traction);
          FrictionPoint        at;
          at.pressure = of.normal * traction / of.length_of_mean;
          at.traction = of.in_frame(traction);
          at.slip =
            transpose(of.kinematic) * of.along_axes(records[i].increment);
          at.c            = of.complementarity;
          node.law.status = NodeStatus::slip;
          node.law        = next_friction(node.law, node.bound, at, 0.);
        }
  }

  namespace
  {
    /// Of the bound: what slips no farther, times c, is at rest, so that the
    /// static coefficient holds again.
    constexpr double rest = 1e-8;
  } // namespace

  void
  FrictionSet::accept(const std::vector<bool> &closed,
                      const Vector            &lambda,
                      const Vector            &weighted_gaps)
  {
    for (unsigned int i = 0; i < nodes.size(); ++i)
      if (Node &node = nodes[i]; node.has_friction)
        {
          const ContactNode &of = *node.contact;
          const bool sticks = closed[i] && node.law.status == NodeStatus::stick;
          const Tensor<1, dim> increment =
            sticks ? Tensor<1, dim>() : slip(node, weighted_gaps);
          if (closed[i] && node.touched)
            total_slip[i] += increment;
          if (closed[i] && node.touched && !sticks && of.has_normal())
            {
              // in the frame of the node, where no pressure is part of it
              const FrictionPoint at = point(node, lambda, weighted_gaps);
              dissipation[i] += of.area * (at.traction * at.slip);
              if (node.bound.static_coefficient > node.bound.coefficient &&
                  at.c * at.slip.norm() <= rest * node.law.bound)
                node.law = Friction();
            }
          node.traction  = of.traction(lambda.begin());
          node.increment = increment;
          node.origin += increment;
          node.touched = closed[i];
        }
  }
} // namespace mortise
