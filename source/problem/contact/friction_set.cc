// See friction_set.h.
#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/contact/slip_edge.h>
#include <mortise/problem/contact/friction_set.h>
#include <mortise/solvers/anderson.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <utility>

namespace mortise
{
  using namespace dealii;

  FrictionSet::FrictionSet(const RunContext &run,
                           Discretisation   &discretisation)
    : run(run)
    , discretisation(discretisation)
    , within_system(run.parameters.solver.friction == "newton")
  {
    for (const Coupling &coupling : discretisation.interfaces().all())
      for (const ContactNode &node : coupling.contact_nodes)
        {
          nodes.emplace_back();
          nodes.back().contact      = &node;
          nodes.back().has_friction = coupling.law.has_friction();
        }
    total_slip.resize(nodes.size());
    dissipation.resize(nodes.size());
  }

  void
  FrictionSet::begin(const SceneData &data)
  {
    const auto &all   = discretisation.interfaces().all();
    const auto &sides = discretisation.interfaces().sides();
    auto        next  = nodes.begin();
    std::string wrong;
    try
      {
        for (unsigned int i = 0; i < all.size(); ++i)
          if (!all[i].law.has_friction())
            next += all[i].contact_nodes.size();
          else
            {
              const auto bound = data.friction(sides[i]);
              for (const ContactNode &node : all[i].contact_nodes)
                (next++)->bound = bound(node.position);
            }
      }
    catch (const InputError &error)
      {
        wrong = error.what();
      }
    throw_if_any(wrong, run.comm);
    bounds.clear();
  }

  void
  FrictionSet::stick()
  {
    for (Node &node : nodes)
      node.law = Friction();
  }

  void
  FrictionSet::take(const std::vector<Friction> &laws)
  {
    for (unsigned int i = 0; i < nodes.size(); ++i)
      nodes[i].law = laws[i];
  }

  Tensor<1, dim>
  FrictionSet::slip(const Node &node, const Vector &weighted_gaps) const
  {
    const Tensor<1, dim> normal = node.contact->kinematic_normal(),
                         moved  = -node.contact->mean(weighted_gaps.begin()) -
                                 node.origin;
    return moved - (normal * moved) * normal;
  }

  FrictionPoint
  FrictionSet::point(const Node   &node,
                     const Vector &lambda,
                     const Vector &weighted_gaps) const
  {
    const ContactNode &of = *node.contact;
    FrictionPoint      at;
    // a node that is to close has none yet
    at.pressure = of.pressure(lambda.begin()) -
                  of.complementarity *
                    (of.kinematic_normal() * of.mean(weighted_gaps.begin()));
    at.traction = of.in_frame(of.traction(lambda.begin()));
    at.slip     = transpose(of.kinematic) * slip(node, weighted_gaps);
    at.c        = of.complementarity;
    return at;
  }

  FrictionSet::Change
  FrictionSet::advance(const std::vector<bool> &closed,
                       const Vector            &lambda,
                       const Vector            &weighted_gaps,
                       const double             accuracy)
  {
    double largest = 0.;
    for (const Node &node : nodes)
      largest =
        std::max(largest, node.contact->traction(lambda.begin()).norm());
    largest = Utilities::MPI::max(largest, run.comm);
    std::array<std::uint64_t, 2> counts{};
    double                       error       = 0.;
    const std::vector<Friction>  laws_before = laws();
    for (unsigned int i = 0; i < nodes.size(); ++i)
      {
        Node &node = nodes[i];
        if (!node.has_friction)
          continue;
        const Friction &before = laws_before[i];
        node.law               = Friction();
        if (!closed[i])
          continue;
        if (!node.contact->has_normal())
          {
            node.law.status = NodeStatus::slip;
            continue;
          }
        const FrictionPoint at = point(node, lambda, weighted_gaps);
        if (!node.touched)
          node.law.status = NodeStatus::slip;
        else
          node.law = next_friction(before, node.bound, at, accuracy * largest);
        node.excess = at.traction.norm() - node.bound.of(at.pressure);
        error       = std::max(error, node.law.error);
        if (node.law.status != before.status)
          ++counts[node.law.status == NodeStatus::stick];
      }
    Utilities::MPI::sum(ArrayView<const std::uint64_t>(counts),
                        run.comm,
                        ArrayView<std::uint64_t>(counts));
    error = Utilities::MPI::max(error, run.comm);
    if (counts[0] + counts[1] > 0)
      bounds.clear();
    else if (!within_system)
      accelerate(laws_before);
    return {counts[0], counts[1], largest > 0. ? error / largest : 0.};
  }

  void
  FrictionSet::accelerate(const std::vector<Friction> &before)
  {
    constexpr unsigned int max_depth = 4;
    std::vector<double>    given, after;
    for (unsigned int i = 0; i < nodes.size(); ++i)
      {
        given.push_back(before[i].bound);
        after.push_back(nodes[i].law.bound);
      }
    bounds.push_back({{std::move(given), after}});
    if (bounds.size() > max_depth)
      bounds.erase(bounds.begin());
    const unsigned int  n = bounds.size();
    std::vector<double> sums(n * n, 0.);
    for (unsigned int i = 0; i < nodes.size(); ++i)
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int b = 0; b < n; ++b)
          sums[n * a + b] += nodes[i].contact->area *
                             (bounds[a][1][i] - bounds[a][0][i]) *
                             (bounds[b][1][i] - bounds[b][0][i]);
    Utilities::MPI::sum(sums, run.comm, sums);
    const std::vector<double> weights =
      anderson_weights(FullMatrix<double>(n, n, sums.data()));
    for (unsigned int i = 0; i < nodes.size(); ++i)
      if (nodes[i].law.bound > 0.)
        {
          double bound = 0.;
          for (unsigned int a = 0; a < n; ++a)
            bound += weights[a] * bounds[a][1][i];
          nodes[i].law.bound = std::max(0.5 * after[i], bound);
        }
  }

  std::uint64_t
  FrictionSet::extend(const NodePositions         &positions,
                      const std::vector<bool>     &closed,
                      const std::vector<Friction> &before,
                      const Vector                &lambda,
                      const Vector                &weighted_gaps)
  {
    std::vector<TangentialForce> forces(nodes.size());
    for (unsigned int i = 0; i < nodes.size(); ++i)
      if (const Node &node = nodes[i];
          closed[i] && node.has_friction && node.touched &&
          node.contact->has_normal() && before[i].status == NodeStatus::stick &&
          // with a static coefficient what slips once may slip for good
          node.bound.static_coefficient <= node.bound.coefficient)
        {
          const ContactNode   &of = *node.contact;
          const Tensor<1, dim> tangential =
            of.tangential(of.traction(lambda.begin()));
          forces[i].force = of.area * of.in_space(tangential);
          // the excess is that in the frame of the node
          forces[i].bound = of.area * (tangential.norm() - node.excess);
          forces[i].kind  = node.law.status == NodeStatus::slip ?
                              TangentialForce::begins :
                              TangentialForce::may_slip;
        }
    const auto    directions = extend_slip(positions, forces, run.comm);
    std::uint64_t n          = 0;
    for (unsigned int i = 0; i < nodes.size(); ++i)
      if (directions[i].norm() > 0.)
        {
          Node                &node = nodes[i];
          const ContactNode   &of   = *node.contact;
          const FrictionPoint  at   = point(node, lambda, weighted_gaps);
          const Tensor<1, dim> direction =
            of.in_frame(of.along_axes(directions[i]));
          const double bound = node.bound.of(at.pressure);
          if (!(bound > 0. && direction.norm() > 0.))
            continue;
          node.law.status    = NodeStatus::slip;
          node.law.bound     = bound;
          node.law.direction = direction / direction.norm();
          node.law.error = (at.traction - bound * node.law.direction).norm();
          ++n;
        }
    return Utilities::MPI::sum(n, run.comm);
  }

  bool
  FrictionSet::keep_one(const std::vector<Friction> &before)
  {
    constexpr double none  = std::numeric_limits<double>::max();
    double           least = none;
    Node            *which = nullptr;
    for (unsigned int i = 0; i < nodes.size(); ++i)
      if (Node &node = nodes[i];
          node.touched && node.law.status == NodeStatus::slip &&
          before[i].status == NodeStatus::stick && node.excess < least)
        {
          least = node.excess;
          which = &node;
        }
    const double of_all = Utilities::MPI::min(least, run.comm);
    if (which != nullptr && least == of_all)
      which->law = Friction();
    return of_all < none;
  }

  double
  FrictionSet::resistance(const Vector &motion) const
  {
    double sum = 0.;
    for (const Node &node : nodes)
      if (node.has_friction && node.law.status == NodeStatus::slip)
        {
          const ContactNode &of = *node.contact;
          sum +=
            node.law.bound * of.area *
            (transpose(of.rotation) * of.tangential(of.mean(motion.begin())))
              .norm();
        }
    return Utilities::MPI::sum(sum, run.comm);
  }

  std::vector<Friction>
  FrictionSet::laws(const std::vector<bool> &closed) const
  {
    std::vector<Friction> result = laws();
    for (unsigned int i = 0; i < result.size(); ++i)
      if (!closed[i])
        result[i].status = NodeStatus::open;
    return result;
  }

  std::vector<Friction>
  FrictionSet::laws_without_resistance(const std::vector<bool> &closed) const
  {
    std::vector<Friction> result = laws(closed);
    for (Friction &law : result)
      law.bound = 0.;
    return result;
  }
} // namespace mortise
