#include <mortise/operators/block_system.h>

#include <algorithm>

namespace mortise
{
  SystemVector &
  SystemVector::operator=(const SystemVector &other)
  {
    // a vector that is empty on this rank would not take the layout of others
    for (const auto part : {&SystemVector::displacement,
                            &SystemVector::pressure,
                            &SystemVector::multiplier})
      {
        (this->*part).reinit(other.*part, true);
        this->*part = other.*part;
      }
    time = other.time;
    return *this;
  }

  void
  scale(SystemVector &x, const double factor)
  {
    for (Vector *part : {&x.displacement, &x.pressure, &x.multiplier})
      if (part->size() > 0)
        *part *= factor;
    x.time *= factor;
  }

  void
  add_scaled(SystemVector &x, const double factor, const SystemVector &y)
  {
    x.displacement.add(factor, y.displacement);
    if (x.pressure.size() > 0)
      x.pressure.add(factor, y.pressure);
    if (x.multiplier.size() > 0)
      x.multiplier.add(factor, y.multiplier);
    x.time += factor * y.time;
  }

  double
  BlockSystem::energy_product(const SystemVector &x) const
  {
    Vector force(x.displacement);
    bulk->apply_stiffness(force, x.displacement);
    double result = force * x.displacement;
    if (has_springs())
      {
        Vector opening(x.multiplier);
        compliance().vmult(opening, x.multiplier);
        clear_inactive(opening);
        result += opening * x.multiplier;
      }
    return result;
  }

  void
  BlockSystem::apply_mixed(Vector       &dst_u,
                           Vector       &dst_p,
                           const Vector &u,
                           const Vector &p) const
  {
    bulk->apply_mixed(dst_u, dst_p, u, p);
    free_pressures.project_residual(dst_p);
  }

  void
  BlockSystem::add_multiplier_force(Vector &dst, const Vector &lambda) const
  {
    directed_forces().Tvmult_add(dst, lambda);
  }

  void
  BlockSystem::to_directions(SystemVector &rhs, SystemVector &solution) const
  {
    if (!directions)
      return;
    Vector given = rhs.multiplier;
    directions->turn.vmult(rhs.multiplier, given);
    given = solution.multiplier;
    directions->inverse.vmult(solution.multiplier, given);
  }

  void
  BlockSystem::from_directions(SystemVector &solution) const
  {
    if (!directions)
      return;
    const Vector given  = solution.multiplier;
    solution.multiplier = 0.;
    (directions->turn_of_forces ? *directions->turn_of_forces :
                                  directions->turn)
      .Tvmult_add(solution.multiplier.begin(), given.begin());
  }

  void
  BlockSystem::clear_inactive(Vector &multiplier) const
  {
    for (unsigned int i = 0; active && i < active->size(); ++i)
      if (!(*active)[i])
        multiplier.local_element(i) = 0.;
  }

  void
  BlockSystem::apply_to_constrained(const Vector &u,
                                    SystemVector &rhs,
                                    Vector       *forces) const
  {
    bulk->apply_to_constrained(u, rhs, forces);
    if (owned_multiplier.size() > 0)
      constraint.vmult_free(rhs.multiplier, u);
  }

  void
  BlockSystem::apply_constraint(Vector &dst, const Vector &u) const
  {
    directed_constraint().vmult(dst, u);
    clear_inactive(dst);
  }

  void
  BlockSystem::subtract_spring_opening(Vector &dst, const Vector &lambda) const
  {
    if (!has_springs())
      return;
    Vector opening(dst);
    compliance().vmult(opening, lambda);
    clear_inactive(opening);
    dst -= opening;
  }
} // namespace mortise
