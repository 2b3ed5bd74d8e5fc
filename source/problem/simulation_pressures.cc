#include <mortise/base/error.h>
#include <mortise/operators/constant_pressure.h>
#include <mortise/problem/simulation.h>
#include <mortise/solvers/find_free_pressures.h>

#include <algorithm>
#include <numeric>

namespace mortise
{
  namespace
  {
    /// The bodies that interfaces hold together, group by group.
    std::vector<std::vector<unsigned int>>
    tied_groups(const Parameters &parameters)
    {
      std::vector<unsigned int> group(parameters.bodies.size());
      std::iota(group.begin(), group.end(), 0);
      for (const InterfaceParameters &interface : parameters.interfaces)
        {
          const unsigned int a = group[interface.slave.body],
                             b = group[interface.master.body];
          std::replace(group.begin(), group.end(), a, b);
        }
      std::vector<std::vector<unsigned int>> result(group.size());
      for (unsigned int b = 0; b < group.size(); ++b)
        result[group[b]].push_back(b);
      result.erase(std::remove_if(result.begin(),
                                  result.end(),
                                  [](const auto &list) {
                                    return list.empty();
                                  }),
                   result.end());
      return result;
    }
  } // namespace

  void
  Simulation::find_free_pressures()
  {
    for (const auto &group : tied_groups(parameters))
      {
        if (!std::all_of(group.begin(), group.end(), [&](const auto b) {
              return bodies[b]->material.mixed() &&
                     bodies[b]->material.incompressible();
            }))
          continue;
        Vector              all(system.owned_pressure, comm);
        std::vector<Vector> ones;
        std::string         names;
        for (const unsigned int b : group)
          {
            ones.push_back(
              constant_pressure(*bodies[b], pressure_field, system));
            all += ones.back();
            names += (names.empty() ? "" : ", ") + bodies[b]->name;
          }
        const EnclosureTest test = test_enclosure(system, all);
        if (!test.enclosed)
          continue;
        if (test.flux > 0.01)
          throw InputError(
            "Body " + names +
            ": the displacements prescribed all around change the volume (" +
            RunLog::number(100. * test.flux) +
            " % of what flows in and out does not cancel), and Poisson ratio "
            "0.5 lets no volume change; allowed: displacements that keep it, "
            "a boundary that is free, or a smaller ratio");
        Vector integrals(system.owned_pressure, comm);
        for (unsigned int i = 0; i < group.size(); ++i)
          integrals += pressure_integrals(*bodies[group[i]],
                                          pressure_field,
                                          system,
                                          ones[i]);
        system.free_pressures.add(all, integrals);
        log.warning("body " + names +
                    ": incompressible and held all around, so a constant "
                    "pressure has no effect; the mean pressure is set to zero");
      }
    system.free_pressures.project_residual(system.pressure_load);
  }
} // namespace mortise
