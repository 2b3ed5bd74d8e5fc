// See friction_set.h.
#include <deal.II/base/mpi.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <mortise/base/error.h>
#include <mortise/problem/contact/friction_set.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// What is across a unit vector.
    Tensor<1, dim>
    across(const Tensor<1, dim> &normal, const Tensor<1, dim> &value)
    {
      return value - (normal * value) * normal;
    }

    /// Orthonormal rows of @p m components: the @p normal, what of @p direction
    /// is across it, or any tangent, and what is left.
    std::array<Tensor<1, dim>, dim>
    directions_of(const Tensor<1, dim> &normal,
                  const unsigned int    m,
                  const Tensor<1, dim> &direction)
    {
      std::array<Tensor<1, dim>, dim> rows;
      rows[0] = normal;
      if (m == 1)
        return rows;
      rows[1] = across(normal, direction);
      if (rows[1].norm() == 0.)
        {
          unsigned int least = 0;
          for (unsigned int c = 1; c < m; ++c)
            if (std::fabs(normal[c]) < std::fabs(normal[least]))
              least = c;
          Tensor<1, dim> axis;
          axis[least] = 1.;
          rows[1]     = across(normal, axis);
        }
      rows[1] /= rows[1].norm();
      if (m == dim)
        rows[2] = cross_product_3d(rows[0], rows[1]);
      return rows;
    }

    /// The tangential traction in the frame of the node.
    Tensor<1, dim>
    in_frame(const ContactNode &node, const Vector &lambda)
    {
      return invert(node.rotation) *
             node.tangential(node.traction(lambda.begin()));
    }
  } // namespace

  FrictionSet::FrictionSet(const RunContext &run,
                           Discretisation   &discretisation)
    : run(run)
    , discretisation(discretisation)
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
    auto        next  = nodes.begin();
    const auto &all   = discretisation.interfaces().all();
    const auto &sides = discretisation.interfaces().sides();
    std::string wrong;
    for (unsigned int i = 0; i < all.size(); ++i)
      if (all[i].law.is_one_sided())
        {
          const auto bound = data.friction(sides[i]);
          for (const ContactNode &node : all[i].contact_nodes)
            try
              {
                if (all[i].law.has_friction())
                  next->bound = bound(node.position);
                ++next;
              }
            catch (const InputError &error)
              {
                wrong = error.what();
                ++next;
              }
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

  Tensor<1, dim>
  FrictionSet::slip(const Node &node, const Vector &weighted_gaps) const
  {
    return across(node.contact->kinematic_normal,
                  -node.contact->mean(weighted_gaps.begin()) - node.origin);
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
    double                       error = 0.;
    std::vector<double>          before_bounds;
    for (const Node &node : nodes)
      before_bounds.push_back(node.law.bound);
    for (unsigned int i = 0; i < nodes.size(); ++i)
      {
        Node &node = nodes[i];
        if (!node.has_friction)
          continue;
        const Friction before = node.law;
        node.law              = Friction();
        if (!closed[i])
          continue;
        const ContactNode &of = *node.contact;
        FrictionPoint      at;
        if (!of.has_normal())
          {
            node.law.status = NodeStatus::slip;
            continue;
          }
        at.pressure = of.pressure(lambda.begin());
        at.traction = in_frame(of, lambda);
        at.slip     = of.tangential(slip(node, weighted_gaps));
        at.c        = of.complementarity;
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
    else
      accelerate(std::move(before_bounds));
    return {counts[0], counts[1], largest > 0. ? error / largest : 0.};
  }

  void
  FrictionSet::accelerate(std::vector<double> before)
  {
    constexpr unsigned int max_depth = 4;
    std::vector<double>    after;
    for (const Node &node : nodes)
      after.push_back(node.law.bound);
    bounds.push_back({{std::move(before), after}});
    if (bounds.size() > max_depth)
      bounds.erase(bounds.begin());
    const unsigned int m = bounds.size() - 1;
    if (m == 0)
      return;
    // differences of the corrections from the newest, and the newest
    const auto correction = [&](const unsigned int k, const unsigned int i) {
      return bounds[k][1][i] - bounds[k][0][i];
    };
    std::vector<double> sums(m * (m + 1), 0.);
    for (unsigned int i = 0; i < nodes.size(); ++i)
      for (unsigned int a = 0; a < m; ++a)
        {
          const double difference = correction(m, i) - correction(a, i);
          sums[m * m + a] +=
            nodes[i].contact->area * difference * correction(m, i);
          for (unsigned int b = 0; b < m; ++b)
            sums[m * a + b] += nodes[i].contact->area * difference *
                               (correction(m, i) - correction(b, i));
        }
    Utilities::MPI::sum(sums, run.comm, sums);
    LAPACKFullMatrix<double> products(m, m);
    dealii::Vector<double>   weights(m);
    for (unsigned int a = 0; a < m; ++a)
      {
        weights(a) = sums[m * m + a];
        for (unsigned int b = 0; b < m; ++b)
          products(a, b) = sums[m * a + b];
      }
    products.compute_inverse_svd(1e-12);
    dealii::Vector<double> solved(m);
    products.vmult(solved, weights);
    for (unsigned int i = 0; i < nodes.size(); ++i)
      if (nodes[i].law.bound > 0.)
        {
          double bound = after[i];
          for (unsigned int a = 0; a < m; ++a)
            bound -= solved(a) * (after[i] - bounds[a][1][i]);
          nodes[i].law.bound = std::max(0.5 * after[i], bound);
        }
  }

  bool
  FrictionSet::keep_one(const FrictionSet &before)
  {
    constexpr double none  = std::numeric_limits<double>::max();
    double           least = none;
    Node            *which = nullptr;
    for (unsigned int i = 0; i < nodes.size(); ++i)
      if (Node &node = nodes[i];
          node.touched && node.law.status == NodeStatus::slip &&
          before.nodes[i].law.status == NodeStatus::stick &&
          node.excess < least)
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
    std::vector<Friction> result;
    for (unsigned int i = 0; i < nodes.size(); ++i)
      {
        result.push_back(nodes[i].law);
        if (!closed[i])
          result.back().status = NodeStatus::open;
      }
    return result;
  }

  namespace
  {
    /// The linear system of a set of nodes, by owned multiplier.
    struct DirectedSystem
    {
      explicit DirectedSystem(const IndexSet &multipliers)
        : multipliers(multipliers)
        , active(multipliers.n_elements(), true)
        , is_turned(multipliers.n_elements(), false)
        , compliance(multipliers.n_elements(), 0.)
      {}

      void
      set_all(const ContactNode &node, const bool are_active)
      {
        for (unsigned int r = 0; r < node.n_multipliers; ++r)
          active[node.multipliers[r]] = are_active;
      }

      /// A node that slips with @p law along the direction @p d of its
      /// multipliers, where the pressure brings @p along times itself.
      void
      turn_node(const ContactNode    &node,
                const Friction       &law,
                const Tensor<1, dim> &d,
                const double          along)
      {
        constexpr double   rounding = 1e-12;
        const unsigned int m        = node.n_multipliers;
        const auto         rows     = directions_of(node.normal, m, d),
                   kinematic_rows = directions_of(node.kinematic_normal, m, d);
        const bool resists        = law.bound > 0.;
        is_unsymmetric =
          is_unsymmetric || along > 0. ||
          (node.kinematic_normal - node.normal).norm() > rounding;
        for (unsigned int r = 0; r < m; ++r)
          {
            const unsigned int at = node.multipliers[r];
            is_turned[at]         = true;
            active[at]            = r == 0 || (r == 2 && resists);
            if (r == 2 && resists)
              compliance[at] = node.area * law.compliance;
            for (unsigned int c = 0; c < m; ++c)
              {
                // rows of equal areas
                const double share   = node.area / node.areas[c];
                const double carried = r == 0 ? along * d[c] : 0.;
                add(at,
                    node.multipliers[c],
                    share * kinematic_rows[r][c],
                    turn);
                add(at, node.multipliers[c], rows[r][c] / share, inverse);
                add(at,
                    node.multipliers[c],
                    share * (rows[r][c] + carried),
                    turn_of_forces);
              }
          }
      }

      /// What does not turn stays.
      void
      complete()
      {
        for (unsigned int i = 0; i < is_turned.size(); ++i)
          if (!is_turned[i])
            for (auto *entries : {&turn, &inverse, &turn_of_forces})
              add(i, i, 1., *entries);
      }

      SparseMatrix
      matrix(const std::vector<SparseMatrix::Entry> &entries,
             const MPI_Comm                          comm) const
      {
        return SparseMatrix(multipliers, multipliers, comm, entries);
      }

      const IndexSet                  &multipliers;
      std::vector<bool>                active, is_turned;
      std::vector<double>              compliance;
      std::vector<SparseMatrix::Entry> turn, inverse, turn_of_forces;
      bool                             is_unsymmetric = false;

    private:
      void
      add(const unsigned int                row,
          const unsigned int                column,
          const double                      value,
          std::vector<SparseMatrix::Entry> &entries) const
      {
        entries.push_back({multipliers.nth_index_in_set(row),
                           multipliers.nth_index_in_set(column),
                           value});
      }
    };
  } // namespace

  bool
  FrictionSet::select(const std::vector<bool> &closed,
                      const FrictionIteration  iteration)
  {
    const IndexSet &multipliers =
      discretisation.linear_system().owned_multiplier;
    given.reinit(multipliers, run.comm);
    DirectedSystem system(multipliers);
    bool           slips = false;
    for (unsigned int i = 0; i < nodes.size(); ++i)
      {
        const Node        &node = nodes[i];
        const ContactNode &of   = *node.contact;
        if (!closed[i] || node.law.status == NodeStatus::stick)
          {
            system.set_all(of, closed[i]);
            continue;
          }
        slips = true;
        if (!of.has_normal())
          {
            system.set_all(of, false);
            continue;
          }
        // Coulomb's traction within the system, or given
        const bool within = iteration == FrictionIteration::newton &&
                            node.law.bound > 0. && node.bound.coefficient > 0.;
        const Tensor<1, dim> carried = of.rotation * node.law.direction;
        const double         length  = carried.norm();
        system.turn_node(of,
                         node.law,
                         length > 0. ? carried / length : carried,
                         within ?
                           node.bound.coefficient * length / of.length_of_mean :
                           0.);
        const double bound = within ? node.bound.given : node.law.bound;
        for (unsigned int r = 0; r < of.n_multipliers; ++r)
          given.local_element(of.multipliers[r]) =
            of.area / of.areas[r] * bound * carried[r];
      }
    const auto any = [this](const bool here) {
      return Utilities::MPI::max(here ? 1 : 0, run.comm) == 1;
    };
    const bool was_turned = std::exchange(turned, any(slips));
    if (!turned)
      {
        discretisation.select(system.active);
        return was_turned;
      }
    system.complete();
    std::optional<SparseMatrix> forces;
    if (any(system.is_unsymmetric))
      forces = system.matrix(system.turn_of_forces, run.comm);
    discretisation.select(system.active,
                          system.matrix(system.turn, run.comm),
                          system.matrix(system.inverse, run.comm),
                          std::move(forces),
                          system.compliance);
    return true;
  }

  void
  FrictionSet::apply(SystemVector &rhs) const
  {
    const BlockSystem &system  = discretisation.linear_system();
    Vector             against = given;
    against *= -1.;
    system.constraint.Tvmult_add(rhs.displacement, against);
    for (const Node &node : nodes)
      if (node.has_friction)
        for (unsigned int r = 0; r < node.contact->n_multipliers; ++r)
          rhs.multiplier.local_element(node.contact->multipliers[r]) +=
            node.contact->areas[r] * node.origin[r];
  }

  void
  FrictionSet::complete(Vector &lambda) const
  {
    lambda += given;
  }

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

  std::vector<FrictionRecord>
  FrictionSet::records(const std::vector<bool> &closed) const
  {
    std::vector<FrictionRecord> result;
    const std::vector<Friction> all = laws(closed);
    for (unsigned int i = 0; i < nodes.size(); ++i)
      {
        const ContactNode &node = *nodes[i].contact;
        FrictionRecord    &own  = result.emplace_back();
        own.closed              = all[i].status != NodeStatus::open;
        own.slips               = all[i].status == NodeStatus::slip;
        own.dissipated          = dissipation[i];
        for (unsigned int r = 0; r < node.n_multipliers; ++r)
          for (unsigned int c = 0; c < dim; ++c)
            own.slip[c] += total_slip[i][r] * node.axis(r)[c];
      }
    return result;
  }

  void
  FrictionSet::restore(const std::vector<FrictionRecord> &records)
  {
    for (unsigned int i = 0; i < nodes.size(); ++i)
      {
        Node &node   = nodes[i];
        node.touched = records[i].closed;
        node.law.status =
          records[i].slips ? NodeStatus::slip : NodeStatus::stick;
        dissipation[i] = records[i].dissipated;
        for (unsigned int r = 0; r < node.contact->n_multipliers; ++r)
          for (unsigned int c = 0; c < dim; ++c)
            total_slip[i][r] += records[i].slip[c] * node.contact->axis(r)[c];
      }
  }

  void
  FrictionSet::accept(const std::vector<bool> &closed,
                      const Vector            &lambda,
                      const Vector            &weighted_gaps)
  {
    for (unsigned int i = 0; i < nodes.size(); ++i)
      if (Node &node = nodes[i]; node.has_friction)
        {
          const bool sticks = closed[i] && node.law.status == NodeStatus::stick;
          const Tensor<1, dim> increment =
            sticks ? Tensor<1, dim>() : slip(node, weighted_gaps);
          if (closed[i] && node.touched)
            {
              total_slip[i] += increment;
              for (unsigned int r = 0; r < node.contact->n_multipliers; ++r)
                dissipation[i] +=
                  node.contact->areas[r] * increment[r] *
                  lambda.local_element(node.contact->multipliers[r]);
            }
          node.origin += increment;
          node.touched = closed[i];
        }
  }
} // namespace mortise
