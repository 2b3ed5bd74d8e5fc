// Contact of a Discretisation.
#include <mortise/problem/scene/discretisation.h>

#include <numeric>

namespace mortise
{
  using namespace dealii;

  std::vector<bool>
  Discretisation::one_sided() const
  {
    std::vector<bool> result;
    for (const Coupling &coupling : pairing->all())
      result.resize(coupling.multipliers->range().end(),
                    coupling.law.is_one_sided());
    return result;
  }

  Vector
  Discretisation::gaps(const SceneLoad &load, const SystemVector &x) const
  {
    if (system.owned_multiplier.size() == 0)
      return {}; // every displacement of both sides is prescribed
    Vector result(system.owned_multiplier, run.comm), moved(result);
    system.constraint.vmult(moved, x.displacement); // of inactive ones, too
    result = load.rhs.multiplier;
    result -= moved;
    for (const Coupling &coupling : pairing->all())
      for (unsigned int k = 0; k < coupling.normal_multipliers.size(); ++k)
        result.begin()[coupling.multipliers->range().first + k] /=
          coupling.normal_multipliers[k].area;
    return result;
  }

  SystemVector
  Discretisation::rigid_motion(const FreeMotions &free,
                               const unsigned int k) const
  {
    const auto moved = linear_displacements(
      spaces.bodies,
      [&](const unsigned int body, const unsigned int c, const Point<dim> &x) {
        const Motion  row    = row_of(free.of_body[body], c, x);
        const Motion &motion = free.motions[k][body];
        return std::inner_product(row.begin(), row.end(), motion.begin(), 0.);
      });
    return mortise::system_vector(spaces.fields, system, {}, moved);
  }

  void
  Discretisation::update_coarse_active_set()
  {
    pairing->select(*system.active);
    system.bulk->update_penalties(pairing->all());
  }
} // namespace mortise
