#include <deal.II/base/mpi.h>

#include <mortise/body/mesh/gmsh_model.h>
#include <mortise/problem/adaptive/adaptivity.h>
#include <mortise/problem/input/formulation.h>

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

    /// Can gmsh make another mesh of these tetrahedra?
    bool
    can_be_remeshed(const BodyParameters &given, const Body &body)
    {
      return body.mesh.tetrahedra && given.mesh.source == "file" &&
             is_geometry_file(given.mesh.file);
    }

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
  } // namespace

  void
  Adaptivity::refine(Bodies &bodies)
  {
    if (cycle == 0)
      return;
    for (const auto &body : bodies)
      {
        const auto &split = splits[body->index];
        const bool  any =
          std::find(split.begin(), split.end(), true) != split.end();
        if (Utilities::MPI::max(any ? 1 : 0, run.comm) == 1)
          split_cells(*body, split, states[body->index]);
        if (meshes.empty() || meshes[body->index].sizes == nullptr)
          continue;
        auto       stage = run.log.stage(run.timers, "mesh");
        const auto n     = body->triangulation().n_global_active_cells();
        body->pressure.reset();
        body->dof_handler.clear();
        sizes.resize(bodies.size());
        sizes[body->index] = meshes[body->index].sizes;
        create_mesh(run, sizes[body->index], *body);
        states[body->index] =
          states_after(*body,
                       meshes[body->index],
                       rigid_motion(run.parameters.bodies[body->index].mesh));
        stage.details(
          "body " + body->name + ", " + std::to_string(n) + " cells become " +
          std::to_string(body->triangulation().n_global_active_cells()));
      }
  }

  double
  Adaptivity::next_unknowns(const Bodies      &bodies,
                            const Refinements &choices) const
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

  bool
  Adaptivity::plan_meshes(const Bodies      &bodies,
                          const Refinements &choices,
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
        meshes.assign(bodies.size(), {});
        for (const auto &body : bodies)
          if (splits_tetrahedra(*body, choices[body->index]))
            {
              const BodyParameters &given = run.parameters.bodies[body->index];
              meshes[body->index] =
                plan_remeshing(*body,
                               choices[body->index],
                               states[body->index],
                               {share_of_cell * allowed / n_cells,
                                most,
                                *given_degrees(given).begin(),
                                rigid_motion(given.mesh),
                                given.mesh.refinements});
            }
        // one that is hardly finer is not worth what it costs
        const double next = next_unknowns(bodies, none);
        if (next < least_growth * now)
          break;
        if (next <= run.parameters.adaptivity.most_unknowns)
          return true;
      }
    meshes.clear();
    return false;
  }

  void
  Adaptivity::choose(const Bodies &bodies)
  {
    if (reached() || !stopped_by.empty())
      return;
    const AdaptivityParameters &given  = run.parameters.adaptivity;
    const double                target = *given.target_error,
                 most = allowed * (goal ? target : target * target);
    RefinementOptions options{given.splits(),
                              given.strategy == "h",
                              given.largest_degree,
                              {}};
    for (const auto &body : bodies)
      options.may_remesh.push_back(
        given.splits() && n_meshes < most_meshes &&
        can_be_remeshed(run.parameters.bodies[body->index], *body));
    if (cycle == 1 && given.splits())
      for (const auto &body : bodies)
        if (body->mesh.tetrahedra && !options.may_remesh[body->index])
          run.log.line("  body " + body->name +
                       ": tetrahedra without a geometry keep their size, "
                       "degrees alone rise");
    meshes.clear();
    const auto choose = [&] {
      // the first changes are those of all cells
      return estimated ? choose_refinements(bodies, states, options, most) :
                         refine_new(bodies, states, options);
    };
    auto       choices = choose();
    const bool wants_meshes =
      std::any_of(bodies.begin(), bodies.end(), [&](const auto &body) {
        return splits_tetrahedra(*body, choices[body->index]);
      });
    if (wants_meshes && !plan_meshes(bodies, choices, most))
      {
        options.may_remesh.assign(bodies.size(), false);
        choices = choose();
      }
    if (!meshes.empty())
      {
        ++n_meshes;
        // what else is refined would have no change
        for (auto &of_body : choices)
          std::fill(of_body.begin(), of_body.end(), Refinement::keep);
      }
    const double next = next_unknowns(bodies, choices);
    if (meshes.empty() && growth(bodies, states, choices) == 1.)
      stopped_by = "Largest degree = " + std::to_string(given.largest_degree) +
                   " allows no more";
    else if (next > given.most_unknowns)
      stopped_by =
        "Largest number of unknowns = " + RunLog::number(given.most_unknowns) +
        " allows no more, the next cycle needs about " + RunLog::number(next);
    splits = prepare_refinement(bodies, choices, states);
  }
} // namespace mortise
