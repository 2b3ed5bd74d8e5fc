// What Discretisation knows of contact.
#include <mortise/base/error.h>
#include <mortise/problem/scene/discretisation.h>

#include <algorithm>
#include <numeric>

namespace mortise
{
  void
  Discretisation::prepare_contact()
  {
    std::string nowhere;
    for (const Coupling &coupling : couplings.all())
      {
        auto &all = normal_multipliers_of_contact.emplace_back();
        if (!coupling.is_contact)
          continue;
        all = normal_multipliers(coupling, system.owned_multiplier, run.comm);
        if (std::any_of(all.begin(), all.end(), [](const auto &multiplier) {
              return !(multiplier.area > 0.);
            }))
          nowhere = coupling.interface->name();
      }
    throw_if_any(
      nowhere.empty() ?
        "" :
        "Interface " + nowhere +
          ": a multiplier of the contact has no area, since too "
          "little of its faces has a partner; move the surfaces, or exchange slave and master",
      run.comm);
  }

  std::vector<bool>
  Discretisation::one_sided() const
  {
    std::vector<bool> result;
    for (const Coupling &coupling : couplings.all())
      result.insert(result.end(),
                    coupling.multipliers->n_owned(),
                    coupling.is_contact);
    return result;
  }

  std::vector<double>
  Discretisation::gap_stiffness() const
  {
    std::vector<double> result;
    for (unsigned int i = 0; i < couplings.all().size(); ++i)
      {
        for (const NormalMultiplier &multiplier :
             normal_multipliers_of_contact[i])
          result.push_back(multiplier.stiffness);
        if (normal_multipliers_of_contact[i].empty())
          result.insert(result.end(),
                        couplings.all()[i].multipliers->n_owned(),
                        0.);
      }
    return result;
  }

  Vector
  Discretisation::gaps(const SceneLoad &load, const SystemVector &x) const
  {
    if (system.owned_multiplier.size() == 0)
      return {}; // every displacement of both sides is prescribed
    Vector result(system.owned_multiplier, run.comm), moved(result);
    system.coupling.vmult(moved, x.displacement); // of inactive ones, too
    result = load.rhs.multiplier;
    result -= moved;
    double *gap = result.begin();
    for (unsigned int i = 0; i < couplings.all().size(); ++i)
      {
        for (const NormalMultiplier &multiplier :
             normal_multipliers_of_contact[i])
          *gap++ /= multiplier.area;
        if (normal_multipliers_of_contact[i].empty())
          gap += couplings.all()[i].multipliers->n_owned();
      }
    return result;
  }

  SystemVector
  Discretisation::rigid_motion(const FreeMotions &free,
                               const unsigned int k) const
  {
    std::vector<BodySolution> moved = zero_solutions(spaces.bodies);
    for (const auto &body : spaces.bodies)
      {
        BodyVector   &u      = moved[body->index].displacement;
        const Motion &motion = free.motions[k][body->index];
        for (const auto &cell : body->dof_handler.active_cell_iterators())
          if (cell->is_locally_owned())
            for (const unsigned int v : cell->vertex_indices())
              for (unsigned int c = 0; c < dim; ++c)
                if (const auto dof =
                      cell->vertex_dof_index(v, c, cell->active_fe_index());
                    u.in_local_range(dof))
                  {
                    const Motion row =
                      row_of(free.of_body[body->index], c, cell->vertex(v));
                    u(dof) = std::inner_product(row.begin(),
                                                row.end(),
                                                motion.begin(),
                                                0.);
                  }
        u.update_ghost_values();
      }
    return mortise::system_vector(spaces.fields, system, {}, moved);
  }

  void
  Discretisation::show_active()
  {
    couplings.select(*system.active);
    system.nodal->update_penalties(couplings.all());
  }
} // namespace mortise
