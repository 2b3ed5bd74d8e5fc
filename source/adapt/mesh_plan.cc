#include <deal.II/base/mpi.h>

#include <mortise/adapt/mesh_plan.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Edges of a new mesh are at least 2^-3 of what they were: errors are not
    /// known well.
    constexpr unsigned int most_halvings = 3;

    /// Edges are then 2^-9 of what they were, and degrees rise from there: else
    /// meshes could go on without end.
    constexpr unsigned int most_meshes = 3;

    constexpr double least_growth = 1.02; ///< of unknowns, of a new mesh

    /// Collective.
    bool
    splits_tetrahedra(const Body                    &body,
                      const std::vector<Refinement> &refinements)
    {
      const bool any =
        body.mesh.tetrahedra &&
        std::find(refinements.begin(), refinements.end(), Refinement::split) !=
          refinements.end();
      return Utilities::MPI::max(any ? 1 : 0,
                                 body.triangulation().get_communicator()) == 1;
    }

    /// Unknowns of the next cycle, about. Collective.
    double
    next_unknowns(const Bodies                 &bodies,
                  const CellStates             &states,
                  const Refinements            &choices,
                  const std::vector<Remeshing> &meshes)
    {
      double now = 0., more = 0.;
      for (const auto &body : bodies)
        {
          const double n = body->dof_handler.n_dofs();
          now += n;
          if (!meshes.empty())
            more += n * (meshes[body->index].growth - 1.);
        }
      return now * growth(bodies, states, with_closure(bodies, choices)) + more;
    }

    /// For tetrahedra that @p choices split, as small as unknowns allow; none if they allow none. Collective.
    std::vector<Remeshing>
    new_meshes(const Bodies      &bodies,
               const CellStates  &states,
               const Refinements &choices,
               const PlanOptions &options,
               const double       allowed)
    {
      Refinements none;
      double      n_cells = 0., now = 0.;
      for (const auto &body : bodies)
        {
          none.emplace_back(choices[body->index].size(), Refinement::keep);
          n_cells += body->triangulation().n_global_active_cells();
          now += body->dof_handler.n_dofs();
        }
      for (unsigned int most = most_halvings; most > 0; --most)
        {
          std::vector<Remeshing> meshes(bodies.size());
          for (const auto &body : bodies)
            if (splits_tetrahedra(*body, choices[body->index]))
              {
                RemeshingOptions own = *options.remeshing[body->index];
                own.target           = fraction_of_cell * allowed / n_cells;
                own.most_halvings    = most;
                meshes[body->index]  = plan_remeshing(*body,
                                                     choices[body->index],
                                                     states[body->index],
                                                     own);
              }
          // one that is hardly finer is not worth what it costs
          const double next = next_unknowns(bodies, states, none, meshes);
          if (next < least_growth * now)
            break;
          if (next <= options.most_unknowns)
            return meshes;
        }
      return {};
    }
  } // namespace

  MeshPlan
  plan_meshes(const Bodies               &bodies,
              const PlanOptions          &options,
              const std::optional<double> allowed,
              const unsigned int          n_meshes,
              CellStates                 &states)
  {
    RefinementOptions may = options.refinement;
    for (const auto &own : options.remeshing)
      may.may_remesh.push_back(may.may_split && n_meshes < most_meshes &&
                               own.has_value());
    const auto choose = [&] {
      return allowed ? choose_refinements(bodies, states, may, *allowed) :
                       refine_new(bodies, states, may);
    };
    MeshPlan   plan;
    auto       choices = choose();
    const bool wants_meshes =
      std::any_of(bodies.begin(), bodies.end(), [&](const auto &body) {
        return splits_tetrahedra(*body, choices[body->index]);
      });
    if (wants_meshes)
      plan.meshes =
        new_meshes(bodies, states, choices, options, allowed.value_or(0.));
    if (wants_meshes && plan.meshes.empty())
      {
        may.may_remesh.assign(bodies.size(), false);
        choices = choose();
      }
    if (!plan.meshes.empty()) // what else is refined would have no change
      for (auto &of_body : choices)
        std::fill(of_body.begin(), of_body.end(), Refinement::keep);
    plan.unknowns = next_unknowns(bodies, states, choices, plan.meshes);
    if (plan.meshes.empty() && growth(bodies, states, choices) == 1.)
      plan.limit = MeshPlan::Limit::largest_degree;
    else if (plan.unknowns > options.most_unknowns)
      plan.limit = MeshPlan::Limit::most_unknowns;
    plan.splits = prepare_refinement(bodies, choices, states);
    for (const auto &of_body : plan.splits)
      plan.merges.emplace_back(of_body.size(), false);
    return plan;
  }
} // namespace mortise
