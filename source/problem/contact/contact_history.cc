// What a ContactStep keeps from step to step, and what it predicts from that.
#include <deal.II/base/mpi.h>

#include <mortise/problem/contact/contact_step.h>

#include <cmath>
#include <utility>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    std::vector<bool>
    closed_nodes(const std::vector<ContactRecord> &records)
    {
      std::vector<bool> result;
      for (const ContactRecord &record : records)
        result.push_back(record.closed);
      return result;
    }
  } // namespace

  ContactRecords
  ContactStep::records() const
  {
    return {positions,
            friction.records(set.active()),
            friction.dissipated_apart(),
            run.comm};
  }

  ContactRecords
  ContactStep::records_of_iterate(const SceneLoad    &load,
                                  const SystemVector &x) const
  {
    auto result = friction.records(set.active());
    if (!friction.empty())
      friction.set_iterate(x.multiplier,
                           discretisation.weighted_gaps(load, x),
                           result);
    return {positions, result, friction.dissipated_apart(), run.comm};
  }

  void
  ContactStep::follow(const std::optional<ContactRecords> &accepted,
                      const SlipOrigin                    &origin,
                      const SceneData                     &data,
                      const SceneLoad                     &load,
                      const SystemVector                  &x)
  {
    if (friction.empty())
      return;
    if (accepted)
      {
        friction.restore(accepted->nearest(positions));
        friction.set_dissipated(accepted->dissipated());
      }
    friction.set_origin(
      discretisation.weighted_gaps(load, x),
      origin.openings(discretisation.interfaces().all(),
                      discretisation.displacement_of_pairing(),
                      discretisation.linear_system().owned_multiplier));
    friction.begin(data);
    friction.guess(*first);
  }

  void
  ContactStep::remember(Solved now)
  {
    // with other pairs each problem has another ContactStep
    if (!run.parameters.steps.given() || discretisation.interfaces().follow())
      return;
    if (!scaled)
      scaled = std::make_unique<ScaledResidual>(discretisation.linear_system());
    SystemVector rhs = now.rhs, x = now.x;
    if (last)
      {
        const bool other_set =
          Utilities::MPI::max(now.statuses == last->statuses ? 0 : 1,
                              run.comm) == 1;
        // from one set to another an increment is half of each
        if (other_set || mixed_increment)
          increments.clear();
        mixed_increment = other_set;
        add_scaled(rhs, -1., last->rhs);
        add_scaled(x, -1., last->x);
      }
    increments.add(rhs, x, *scaled);
    last = std::move(now);
  }

  void
  ContactStep::resume(const SceneLoad &load, const SystemVector &x)
  {
    if (!friction.empty())
      {
        friction.restore(*first);
        friction.set_origin(discretisation.weighted_gaps(load, x));
      }
    remember({load.rhs, x, statuses()});
  }

  void
  ContactStep::accept(const SceneLoad &load, const SystemVector &x)
  {
    if (!friction.empty())
      friction.accept(set.active(),
                      x.multiplier,
                      discretisation.weighted_gaps(load, x));
    first = friction.records(set.active());
  }

  void
  ContactStep::go_back()
  {
    last.reset();
    increments.clear();
    mixed_increment = false;
    friction.stick();
  }

  std::vector<double>
  ContactStep::pressures(const SystemVector &x) const
  {
    std::vector<double> result;
    for (const ContactNode *node : discretisation.interfaces().contact_nodes())
      result.push_back(node->pressure(x.multiplier.begin()));
    return result;
  }

  std::vector<bool>
  ContactStep::predict(const SceneLoad &load, SystemVector &x)
  {
    if (last)
      {
        x                = last->x;
        SystemVector rhs = load.rhs;
        add_scaled(rhs, -1., last->rhs);
        if (!increments.empty())
          add_scaled(x, 1., increments.start(rhs, *scaled));
      }
    double area = 0.;
    for (const ContactNode *node : discretisation.interfaces().contact_nodes())
      area += node->area;
    // what rounding leaves between meshes that touch is closed
    const double closed =
      1e-10 * std::sqrt(Utilities::MPI::sum(area, run.comm));
    const Vector weighted = discretisation.weighted_gaps(
      load, last ? x : discretisation.linear_system().zero_vector());
    const std::vector<double> gaps = discretisation.gaps(weighted);
    std::vector<bool>         guess(gaps.size());
    if (!last && first)
      {
        guess = closed_nodes(*first);
        friction.guess(*first);
      }
    else if (!last)
      for (unsigned int i = 0; i < gaps.size(); ++i)
        guess[i] = gaps[i] <= closed;
    else
      {
        const std::vector<double> pressure = pressures(x);
        for (unsigned int i = 0; i < gaps.size(); ++i)
          guess[i] = last->statuses[i] != NodeStatus::open ? pressure[i] > 0. :
                                                             gaps[i] <= -closed;
        if (!friction.empty())
          friction.advance(guess, x.multiplier, weighted, least_accuracy);
      }
    const auto holds = [this](const std::vector<bool> &active) {
      return free_motions(friction.laws(active)).empty();
    };
    if (holds(guess))
      return guess;
    friction.stick();
    if (last)
      {
        std::vector<bool> same;
        for (const NodeStatus status : last->statuses)
          same.push_back(status != NodeStatus::open);
        for (const auto &tried : {guess, same})
          if (holds(tried))
            return tried;
      }
    else if (!friction.empty() && holds(guess))
      return guess;
    return std::vector<bool>(gaps.size(), true);
  }
} // namespace mortise
