#include <mortise/operators/boundary_nodes.h>
#include <mortise/problem/results/held_boundaries.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  const NodalLevel &
  nodes_of(const Discretisation &discretisation)
  {
    return discretisation.linear_system().nodal->levels().front();
  }

  LevelVector<double>
  zero_at_nodes(const Discretisation &discretisation)
  {
    LevelVector<double> result;
    result.reinit(nodes_of(discretisation).layout);
    return result;
  }

  LevelVector<double>
  nodes_with(const Discretisation             &discretisation,
             const unsigned int                body,
             const types::boundary_id          boundary,
             const HeldBoundaries::Components &which)
  {
    LevelVector<double> result = boundary_nodes(nodes_of(discretisation),
                                                *discretisation.bodies()[body],
                                                boundary);
    for (unsigned int i = 0; i < result.locally_owned_size(); ++i)
      if (!which[i % dim])
        result.local_element(i) = 0.;
    return result;
  }

  Vector
  part_of(const Discretisation &discretisation,
          const Vector         &multiplier,
          const unsigned int    i)
  {
    const MultiplierRange &range =
      discretisation.interfaces().all()[i].multipliers->range();
    Vector result(multiplier);
    std::fill(result.begin(), result.begin() + range.first, 0.);
    std::fill(result.begin() + range.end(), result.end(), 0.);
    return result;
  }

  HeldBoundaries::HeldBoundaries(const Discretisation &discretisation)
    : discretisation(discretisation)
    , held(discretisation.bodies().size())
    , holders(zero_at_nodes(discretisation))
  {
    for (unsigned int b = 0; b < held.size(); ++b)
      {
        for (const DirichletCondition &condition :
             discretisation.dirichlet()[b])
          for (unsigned int c = 0; c < dim; ++c)
            if (condition.fixed[c])
              held[b][condition.boundary][c] = true;
        for (const auto &[boundary, which] : held[b])
          holders += nodes_with(discretisation, b, boundary, which);
      }
    shared = holders.linfty_norm() > 1.;
  }

  std::optional<LevelVector<double>>
  HeldBoundaries::held_by_side(const SideParameters &side) const
  {
    std::optional<LevelVector<double>> result;
    const Body &body = *discretisation.bodies()[side.body];
    for (const std::string &name : side.boundaries)
      if (const auto found = held[side.body].find(body.boundary_id(name, ""));
          found != held[side.body].end())
        {
          const LevelVector<double> own =
            nodes_with(discretisation, side.body, found->first, found->second);
          if (!result)
            result = own;
          for (unsigned int i = 0; i < own.locally_owned_size(); ++i)
            if (own.local_element(i) > 0.)
              result->local_element(i) = 1.;
        }
    return result;
  }

  LevelVector<double>
  HeldBoundaries::forces_of(const unsigned int i, const Vector &lambda) const
  {
    LevelVector<double> result = zero_at_nodes(discretisation);
    discretisation.linear_system().forces().Tvmult_add_free(
      result, part_of(discretisation, lambda, i));
    return result;
  }

  LevelVector<double>
  HeldBoundaries::multiplier_forces(const Vector &lambda) const
  {
    LevelVector<double> result = zero_at_nodes(discretisation);
    discretisation.linear_system().forces().Tvmult_add_free(result, lambda);
    for_each_side(discretisation, [&](const unsigned int i, const auto &side) {
      if (const auto at_side = held_by_side(side))
        {
          LevelVector<double> own = forces_of(i, lambda);
          own.scale(*at_side);
          result -= own;
        }
    });
    return result;
  }

  void
  HeldBoundaries::constraint(const LevelVector<double> &u,
                             Vector                    &multiplier) const
  {
    const CouplingMatrix &B = discretisation.linear_system().forces();
    B.vmult_free(multiplier, u);
    for_each_side(discretisation, [&](const unsigned int i, const auto &side) {
      if (auto at_side = held_by_side(side))
        {
          at_side->scale(u);
          Vector own(multiplier);
          B.vmult_free(own, *at_side);
          multiplier -= part_of(discretisation, own, i);
        }
    });
  }
} // namespace mortise
