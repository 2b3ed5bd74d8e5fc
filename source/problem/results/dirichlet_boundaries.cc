#include <mortise/operators/boundary_nodes.h>
#include <mortise/problem/results/dirichlet_boundaries.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  const MultigridLevel &
  nodes_of(const Discretisation &discretisation)
  {
    return discretisation.linear_system().bulk->levels().front();
  }

  LevelVector<double>
  zero_at_nodes(const Discretisation &discretisation)
  {
    LevelVector<double> result;
    result.reinit(nodes_of(discretisation).layout);
    return result;
  }

  LevelVector<double>
  nodes_with(const Discretisation                  &discretisation,
             const unsigned int                     body,
             const types::boundary_id               boundary,
             const DirichletBoundaries::Components &which)
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

  DirichletBoundaries::DirichletBoundaries(const Discretisation &discretisation)
    : discretisation(discretisation)
    , prescribed(discretisation.bodies().size())
    , n_prescribing(zero_at_nodes(discretisation))
  {
    for (unsigned int b = 0; b < prescribed.size(); ++b)
      {
        for (const DirichletCondition &condition :
             discretisation.dirichlet()[b])
          for (unsigned int c = 0; c < dim; ++c)
            if (condition.fixed[c])
              prescribed[b][condition.boundary][c] = true;
        for (const auto &[boundary, which] : prescribed[b])
          n_prescribing += nodes_with(discretisation, b, boundary, which);
      }
    shared = n_prescribing.linfty_norm() > 1.;
  }

  std::optional<LevelVector<double>>
  DirichletBoundaries::prescribed_by_side(const SideParameters &side) const
  {
    std::optional<LevelVector<double>> result;
    const Body &body = *discretisation.bodies()[side.body];
    for (const std::string &name : side.boundaries)
      if (const auto found =
            prescribed[side.body].find(body.boundary_id(name, ""));
          found != prescribed[side.body].end())
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
  DirichletBoundaries::forces_of(const unsigned int i,
                                 const Vector      &lambda) const
  {
    LevelVector<double> result = zero_at_nodes(discretisation);
    discretisation.linear_system().constraint.Tvmult_add_free(
      result, part_of(discretisation, lambda, i));
    return result;
  }

  LevelVector<double>
  DirichletBoundaries::multiplier_forces(const Vector &lambda) const
  {
    LevelVector<double> result = zero_at_nodes(discretisation);
    discretisation.linear_system().constraint.Tvmult_add_free(result, lambda);
    for_each_side(discretisation, [&](const unsigned int i, const auto &side) {
      if (const auto at_side = prescribed_by_side(side))
        {
          LevelVector<double> own = forces_of(i, lambda);
          own.scale(*at_side);
          result -= own;
        }
    });
    return result;
  }

  void
  DirichletBoundaries::constraint(const LevelVector<double> &u,
                                  Vector                    &multiplier) const
  {
    const CouplingMatrix &B = discretisation.linear_system().constraint;
    B.vmult_free(multiplier, u);
    for_each_side(discretisation, [&](const unsigned int i, const auto &side) {
      if (auto at_side = prescribed_by_side(side))
        {
          at_side->scale(u);
          Vector own(multiplier);
          B.vmult_free(own, *at_side);
          multiplier -= part_of(discretisation, own, i);
        }
    });
  }
} // namespace mortise
