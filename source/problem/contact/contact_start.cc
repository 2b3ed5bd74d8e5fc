// See contact_start.h.
#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/body/boundary_faces.h>
#include <mortise/problem/contact/contact_start.h>
#include <mortise/problem/contact/contact_step.h>
#include <mortise/problem/input/formulation.h>
#include <mortise/problem/support/side_faces.h>

#include <algorithm>
#include <ostream>
#include <utility>
#include <vector>

namespace mortise
{
  namespace
  {
    /// Of the pressures: sets need no more.
    constexpr double accuracy = 1e-4;

    /// With fewer no first guess is far from the edge.
    constexpr unsigned int few_nodes = 128;

    /// On the slaves of contact, about. Collective.
    unsigned int
    n_nodes(const RunContext &run, const Bodies &bodies)
    {
      unsigned int n = 0;
      for (const InterfaceParameters &interface : run.parameters.interfaces)
        if (is_one_sided(interface.law))
          {
            const unsigned int degree =
              run.parameters.bodies[interface.slave.body].degree;
            for (const BoundaryFace &face : side_faces(
                   bodies, interface.slave, "Interface " + interface.name))
              n += face.cell->is_locally_owned() ? degree * degree : 0;
          }
      return dealii::Utilities::MPI::sum(n, run.comm);
    }

    /// Half of all degrees; the same where they are lowest.
    Parameters
    halved(Parameters parameters)
    {
      for (BodyParameters &body : parameters.bodies)
        {
          const unsigned int lowest = is_mixed(body) ? least_mixed_degree : 1;
          change_degrees(body, [&](const unsigned int degree) {
            return std::max(lowest, degree / 2);
          });
          body.least_mapping_degree = 2; // facets meet elsewhere
        }
      return parameters;
    }

    bool
    same_degrees(const Parameters &a, const Parameters &b)
    {
      return std::equal(a.bodies.begin(),
                        a.bodies.end(),
                        b.bodies.begin(),
                        [](const BodyParameters &x, const BodyParameters &y) {
                          return x.degree == y.degree &&
                                 x.degree_by_region == y.degree_by_region &&
                                 std::equal(x.degree_near.begin(),
                                            x.degree_near.end(),
                                            y.degree_near.begin(),
                                            [](const Ball &c, const Ball &d) {
                                              return c.number == d.number;
                                            });
                        });
    }

    struct Found
    {
      std::optional<ContactRecords> contact;
      unsigned int                  n_sets = 0;
    };

    Found
    solve(const RunContext                    &run,
          const double                         time,
          Bodies                              &bodies,
          const std::optional<ContactRecords> &start)
    {
      FieldChecks     checks; // the scene itself tells
      const SceneData data(run.parameters, time, checks);
      Discretisation  discretisation(run, data, bodies);
      SolverOptions   options;
      options.method       = discretisation.choice().method;
      options.max_gathered = run.parameters.solver.max_gathered;
      const auto solver =
        make_linear_solver(discretisation.linear_system(), options);
      GlobalUnknowns unknowns(run, discretisation, *solver);
      ContactStep    step(run, discretisation, *solver, unknowns, start);
      SceneLoad      load = discretisation.load(data);
      SystemVector   x;
      unknowns.begin(data, State(), load);
      if (!step.solve(data, load, x, run.parameters.solver.tolerance).converged)
        return {};
      return {step.records(), step.n_sets()};
    }
  } // namespace

  std::optional<ContactRecords>
  contact_start(const RunContext &run, const double time, Bodies &bodies)
  {
    if (n_nodes(run, bodies) < few_nodes)
      return {};
    std::vector<Parameters> all;
    Parameters              lower = halved(run.parameters);
    lower.steps                   = {};
    lower.solver.tolerance        = std::max(accuracy, lower.solver.tolerance);
    while (!same_degrees(lower, all.empty() ? run.parameters : all.back()))
      {
        all.push_back(lower);
        lower = halved(std::move(lower));
      }
    if (all.empty())
      return {};

    auto         stage = run.log.stage(run.timers, "contact_start");
    std::ostream silent(nullptr);
    RunLog       log(silent, run.comm);
    Timers       timers;
    std::optional<ContactRecords> contact;
    std::string                   n_sets;
    try
      {
        while (!all.empty())
          {
            Found found =
              solve({all.back(), log, timers, run.comm}, time, bodies, contact);
            if (!found.contact)
              break;
            contact = std::move(found.contact);
            n_sets +=
              (n_sets.empty() ? "" : ", ") + std::to_string(found.n_sets);
            all.pop_back();
            if (found.n_sets == 1)
              break; // the guess holds
          }
      }
    catch (const InputError &)
      {}
    stage.details(n_sets.empty() ? "no contact found" :
                                   "active sets of lower degrees: " + n_sets);
    return contact;
  }
} // namespace mortise
