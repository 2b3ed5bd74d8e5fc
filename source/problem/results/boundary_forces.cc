#include <deal.II/base/mpi.h>

#include <mortise/operators/boundary_nodes.h>
#include <mortise/output/functionals.h>
#include <mortise/problem/results/boundary_forces.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    DirichletBoundaries::Components
    all_but(DirichletBoundaries::Components which)
    {
      for (bool &component : which)
        component = !component;
      return which;
    }

    Tensor<1, dim>
    sum_over_nodes(const LevelVector<double> &forces)
    {
      Tensor<1, dim> sum;
      for (unsigned int i = 0; i < forces.locally_owned_size(); ++i)
        sum[i % dim] += forces.local_element(i);
      return Utilities::MPI::sum(sum, forces.get_mpi_communicator());
    }

    bool
    has(const SideParameters    &side,
        const Body              &body,
        const types::boundary_id boundary)
    {
      return side.body == body.index &&
             std::any_of(side.boundaries.begin(),
                         side.boundaries.end(),
                         [&](const std::string &name) {
                           return body.boundary_id(name, "") == boundary;
                         });
    }

    /// On how many boundaries of @p side a node is.
    LevelVector<double>
    boundaries_at_nodes(const Discretisation &discretisation,
                        const SideParameters &side)
    {
      LevelVector<double> result = zero_at_nodes(discretisation);
      const Body         &body   = *discretisation.bodies()[side.body];
      for (const std::string &name : side.boundaries)
        result += boundary_nodes(nodes_of(discretisation),
                                 body,
                                 body.boundary_id(name, ""));
      return result;
    }

    /// Calls visit(interface, one over the number of boundaries of its side, at
    /// @p nodes) for the sides that have @p boundary of body @p b.
    template <typename Visit>
    void
    for_each_side_at(const Discretisation      &discretisation,
                     const unsigned int         b,
                     const types::boundary_id   boundary,
                     const LevelVector<double> &nodes,
                     const Visit               &visit)
    {
      for_each_side(
        discretisation, [&](const unsigned int i, const SideParameters &side) {
          if (!has(side, *discretisation.bodies()[b], boundary))
            return;
          const LevelVector<double> n_boundaries =
            boundaries_at_nodes(discretisation, side);
          LevelVector<double> shares = nodes;
          for (unsigned int k = 0; k < shares.locally_owned_size(); ++k)
            if (shares.local_element(k) > 0.)
              shares.local_element(k) /= n_boundaries.local_element(k);
          visit(i, shares);
        });
    }

    /// Values at nodes of the displacements, what is prescribed included.
    LevelVector<double>
    values_at_nodes(const Discretisation            &discretisation,
                    const std::vector<BodySolution> &solutions)
    {
      return discretisation.linear_system().bulk->values_at_nodes(
        [&](const unsigned int body, const auto dof) {
          return solutions[body].displacement(dof);
        });
    }

    /// The tractions of @p all on boundaries of @p body where @p dirichlet, or its opposite, says so by
    /// component.
    std::vector<TractionCondition>
    tractions_on(const std::vector<TractionCondition> &all,
                 const DirichletBoundaries            &dirichlet,
                 const unsigned int                    body,
                 const bool                            on_prescribed)
    {
      std::vector<TractionCondition> result;
      for (const TractionCondition &condition : all)
        {
          auto which = dirichlet.components(body, condition.boundary);
          if (!on_prescribed)
            which = all_but(which);
          if (which == DirichletBoundaries::Components())
            continue;
          result.push_back(
            {condition.boundary,
             [which, traction = condition.traction](
               const Point<dim> &x, const Tensor<1, dim> &normal) {
               Tensor<1, dim> t = traction(x, normal);
               for (unsigned int c = 0; c < dim; ++c)
                 if (!which[c])
                   t[c] = 0.;
               return t;
             }});
        }
      return result;
    }
  } // namespace

  BoundaryForces::BoundaryForces(const Discretisation &discretisation,
                                 const SolvedStep     &solved,
                                 const std::vector<BodySolution> &solutions)
    : discretisation(discretisation)
    , solved(solved)
    , solutions(solutions)
    , dirichlet(discretisation)
  {
    const BulkSystem &bulk = *discretisation.linear_system().bulk;
    borne                  = bulk
              .respond(values_at_nodes(discretisation, solutions),
                       solved.solution.pressure,
                       solved.history,
                       solved.load.thermal_strains_at_points)
              .forces;
    borne -= solved.load.external;
    reactions = borne;
    for (const RigidPart &part :
         solved.data.rigid_parts(discretisation.bodies()))
      for (const RigidPart::PointLoad &load : part.loads)
        on_rigid_parts += load.force;
    applied = sum_over_nodes(solved.load.external) + on_rigid_parts;

    std::vector<Loads> on_prescribed(discretisation.bodies().size());
    bool               any_on_prescribed = false;
    for (const auto &body : discretisation.bodies())
      {
        tractions.push_back(solved.data.loads(*body).tractions);
        auto &there = on_prescribed[body->index].tractions;
        there = tractions_on(tractions.back(), dirichlet, body->index, true);
        any_on_prescribed = any_on_prescribed || !there.empty();
      }
    if (any_on_prescribed)
      borne += bulk.external_forces(on_prescribed);
    if (solved.solution.multiplier.size() > 0)
      {
        borne += dirichlet.multiplier_forces(solved.solution.multiplier);
        discretisation.linear_system().constraint.Tvmult_add_free(
          reactions, solved.solution.multiplier);
      }
    if (dirichlet.any_shared())
      for (const auto &body : discretisation.bodies())
        for (const auto &[boundary, which] : dirichlet.all()[body->index])
          borne -= stresses_at_nodes(body->index, boundary, which);
  }

  LevelVector<double>
  BoundaryForces::stresses_at_nodes(
    const unsigned int                     b,
    const types::boundary_id               boundary,
    const DirichletBoundaries::Components &which) const
  {
    const Body         &body   = *discretisation.bodies()[b];
    LevelVector<double> result = discretisation.linear_system().bulk->by_node(
      body, stress_functionals(body, solutions[b], boundary));
    result.scale(nodes_with(discretisation, b, boundary, which));
    return result;
  }

  void
  BoundaryForces::add_borne(const unsigned int       b,
                            const types::boundary_id boundary,
                            LevelVector<double>     &forces) const
  {
    const auto which = dirichlet.components(b, boundary);
    if (which == DirichletBoundaries::Components())
      return;
    const LevelVector<double> own =
      nodes_with(discretisation, b, boundary, which);
    for (unsigned int i = 0; i < own.locally_owned_size(); ++i)
      if (own.local_element(i) > 0.)
        forces.local_element(i) +=
          borne.local_element(i) / dirichlet.numbers().local_element(i);
    if (dirichlet.any_shared())
      forces += stresses_at_nodes(b, boundary, which);
  }

  void
  BoundaryForces::add_interfaces(const unsigned int       b,
                                 const types::boundary_id boundary,
                                 LevelVector<double>     &forces) const
  {
    for_each_side_at(discretisation,
                     b,
                     boundary,
                     nodes_with(discretisation,
                                b,
                                boundary,
                                all_but(dirichlet.components(b, boundary))),
                     [&](const unsigned int         i,
                         const LevelVector<double> &shares) {
                       LevelVector<double> own =
                         dirichlet.forces_of(i, solved.solution.multiplier);
                       own.scale(shares);
                       forces -= own;
                     });
  }

  ForceAndMoment
  BoundaryForces::on(const unsigned int       b,
                     const types::boundary_id boundary,
                     const Point<dim>        &point) const
  {
    const Body        &body = *discretisation.bodies()[b];
    std::vector<Loads> loads(discretisation.bodies().size());
    for (const TractionCondition &condition :
         tractions_on(tractions[b], dirichlet, b, false))
      if (condition.boundary == boundary)
        loads[b].tractions.push_back(condition);
    LevelVector<double> forces =
      discretisation.linear_system().bulk->external_forces(loads);
    if (solved.load.follower_pressures)
      forces += discretisation.linear_system().bulk->forces_of(
        *solved.load.follower_pressures,
        values_at_nodes(discretisation, solutions),
        &body,
        boundary);
    add_borne(b, boundary, forces);
    add_interfaces(b, boundary, forces);

    const LevelVector<double> wanted =
      boundary_nodes(nodes_of(discretisation), body, boundary);
    LevelVector<double> places =
      node_positions(nodes_of(discretisation), body, wanted);
    if (body.material.has_finite_strain())
      places += values_at_nodes(discretisation, solutions);
    ForceAndMoment result;
    for (unsigned int i = 0; i < forces.locally_owned_size(); i += dim)
      if (wanted.local_element(i) > 0.)
        {
          Tensor<1, dim> force, arm;
          for (unsigned int c = 0; c < dim; ++c)
            {
              force[c] = forces.local_element(i + c);
              arm[c]   = places.local_element(i + c) - point[c];
            }
          result.force += force;
          result.moment += cross_product_3d(arm, force);
        }
    const MPI_Comm comm = forces.get_mpi_communicator();
    return {Utilities::MPI::sum(result.force, comm),
            Utilities::MPI::sum(result.moment, comm)};
  }

  Tensor<1, dim>
  BoundaryForces::moment_of_displacement(const unsigned int i) const
  {
    const SideParameters &slave = discretisation.interfaces().sides()[i].slave;
    if (!discretisation.bodies()[slave.body]->material.has_finite_strain() ||
        solved.solution.multiplier.size() == 0 ||
        discretisation.interfaces().all()[i].is_displaced)
      return {};
    const LevelVector<double> forces =
      dirichlet.forces_of(i, solved.solution.multiplier);
    const LevelVector<double> u = values_at_nodes(discretisation, solutions),
                              there =
                                boundaries_at_nodes(discretisation, slave);
    Tensor<1, dim> sum;
    for (unsigned int k = 0; k < forces.locally_owned_size(); k += dim)
      if (there.local_element(k) > 0.)
        {
          Tensor<1, dim> force, arm;
          for (unsigned int c = 0; c < dim; ++c)
            {
              force[c] = forces.local_element(k + c);
              arm[c]   = u.local_element(k + c);
            }
          sum += cross_product_3d(arm, force);
        }
    return Utilities::MPI::sum(sum, forces.get_mpi_communicator());
  }

  EquilibriumSummary
  BoundaryForces::equilibrium() const
  {
    LevelVector<double> supports = zero_at_nodes(discretisation);
    for (const unsigned int k : nodes_of(discretisation).constrained)
      supports.local_element(k) = reactions.local_element(k);
    const Pairing &interfaces = discretisation.interfaces();
    for (unsigned int i = 0; i < interfaces.all().size(); ++i)
      if (interfaces.sides()[i].is_support || interfaces.all()[i].is_turned)
        supports -= dirichlet.forces_of(i, solved.solution.multiplier);
    // which nodes of rigid parts bear, too
    const Tensor<1, dim> sum = sum_over_nodes(supports) - on_rigid_parts;
    return {components(applied), components(sum), components(applied + sum)};
  }

  namespace
  {
    /// Component of a force on a boundary.
    struct Part
    {
      unsigned int       body;
      types::boundary_id boundary;
      unsigned int       component;
    };

    /// Add what stresses on boundaries that share nodes with that of @p part have in it. @p shares: one over the
    /// number of boundaries, at its nodes.
    void
    add_stresses(const Discretisation      &discretisation,
                 const BodySolution        &solution,
                 const DirichletBoundaries &dirichlet,
                 const Part                &part,
                 const LevelVector<double> &shares,
                 SystemVector              &rhs)
    {
      const BlockSystem &system = discretisation.linear_system();
      const Body        &body   = *discretisation.bodies()[part.body];
      for (const auto &[boundary, which] : dirichlet.all()[part.body])
        {
          if (!which[part.component])
            continue;
          LevelVector<double> weights =
            nodes_with(discretisation, part.body, boundary, which);
          for (unsigned int i = 0; i < weights.locally_owned_size(); ++i)
            if (weights.local_element(i) > 0. && shares.local_element(i) > 0.)
              weights.local_element(i) =
                (boundary == part.boundary ? 1. : 0.) - shares.local_element(i);
            else
              weights.local_element(i) = 0.;
          if (weights.linfty_norm() == 0.)
            continue;
          SystemVector x = system.zero_vector();
          x.displacement = weights;
          const auto on_body =
            discretisation.solutions({system.zero_vector(), {}}, x);
          add_scaled(rhs,
                     1.,
                     discretisation
                       .load(body,
                             stress_functional(body,
                                               solution,
                                               on_body[part.body],
                                               boundary,
                                               part.component))
                       .rhs);
        }
    }
  } // namespace

  LinearFunctional
  reaction_functional(const Discretisation            &discretisation,
                      const std::vector<BodySolution> &solutions,
                      const unsigned int               b,
                      const types::boundary_id         boundary,
                      const unsigned int               c)
  {
    const BlockSystem              &system = discretisation.linear_system();
    const DirichletBoundaries       dirichlet(discretisation);
    LinearFunctional                result{system.zero_vector(),
                            system.zero_vector().displacement};
    DirichletBoundaries::Components which{};
    which[c]                  = true;
    LevelVector<double> nodes = nodes_with(discretisation, b, boundary, which);
    if (!dirichlet.components(b, boundary)[c])
      {
        if (result.rhs.multiplier.size() > 0)
          for_each_side_at(discretisation,
                           b,
                           boundary,
                           nodes,
                           [&](const unsigned int         i,
                               const LevelVector<double> &shares) {
                             Vector seen(result.rhs.multiplier);
                             system.constraint.vmult_free(seen, shares);
                             result.rhs.multiplier -=
                               part_of(discretisation, seen, i);
                           });
        return result;
      }
    LevelVector<double> lift = nodes;
    for (unsigned int i = 0; i < lift.locally_owned_size(); ++i)
      if (lift.local_element(i) > 0.)
        lift.local_element(i) = 1. / dirichlet.numbers().local_element(i);
    result.lift = lift;
    system.bulk->apply_to_constrained(lift, result.rhs);
    if (result.rhs.multiplier.size() > 0)
      dirichlet.constraint(lift, result.rhs.multiplier);
    if (dirichlet.any_shared())
      add_stresses(discretisation,
                   solutions[b],
                   dirichlet,
                   {b, boundary, c},
                   lift,
                   result.rhs);
    return result;
  }
} // namespace mortise
