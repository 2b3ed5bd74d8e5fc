// The linear system of a FrictionSet.
#include <deal.II/base/mpi.h>

#include <mortise/problem/contact/friction_set.h>

#include <array>
#include <cmath>
#include <optional>
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

      /// A node that slips with @p law, where a pressure brings the traction
      /// @p carried of its multipliers along.
      void
      turn_node(const ContactNode    &node,
                const Friction       &law,
                const Tensor<1, dim> &carried)
      {
        constexpr double   rounding = 1e-12;
        const unsigned int m        = node.n_multipliers;
        const auto         frame = directions_of(node.normal, m, law.direction);
        const bool         resists = law.bound > 0.;
        // rows of equal areas; components without a multiplier stay
        Tensor<2, dim> motions, forces;
        for (unsigned int r = 0; r < dim; ++r)
          if (r < m)
            {
              motions[r] = node.kinematic * frame[r];
              forces[r] =
                r == 0 ? node.normal + carried : node.rotation * frame[r];
              for (unsigned int c = 0; c < m; ++c)
                {
                  motions[r][c] *= node.area / node.areas[c];
                  forces[r][c] *= node.area / node.areas[c];
                }
            }
          else
            motions[r][r] = forces[r][r] = 1.;
        const Tensor<2, dim> to_forces = transpose(invert(forces));
        is_unsymmetric = is_unsymmetric || (forces - motions).norm() > rounding;
        for (unsigned int r = 0; r < m; ++r)
          {
            const unsigned int at = node.multipliers[r];
            is_turned[at]         = true;
            active[at]            = r == 0 || (r == 2 && resists);
            if (r == 2 && resists)
              compliance[at] = node.area * law.compliance;
            for (unsigned int c = 0; c < m; ++c)
              {
                const unsigned int of = node.multipliers[c];
                add(at, of, motions[r][c], turn);
                add(at, of, to_forces[r][c], inverse);
                add(at, of, forces[r][c], turn_of_forces);
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
  FrictionSet::select(const std::vector<bool> &closed)
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
        const bool within =
          within_system && node.law.bound > 0. && node.bound.coefficient > 0.;
        const Tensor<1, dim> carried = of.rotation * node.law.direction;
        system.turn_node(
          of,
          node.law,
          (within ? node.bound.coefficient / of.length_of_mean : 0.) * carried);
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
} // namespace mortise
