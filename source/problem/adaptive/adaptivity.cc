#include <deal.II/base/mpi.h>

#include <mortise/adapt/cell_changes.h>
#include <mortise/adapt/coarsening.h>
#include <mortise/body/mesh/gmsh_model.h>
#include <mortise/operators/cells/cell_histories.h>
#include <mortise/problem/adaptive/adaptivity.h>
#include <mortise/problem/input/formulation.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  CellDegrees
  Adaptivity::degrees() const
  {
    CellDegrees result;
    for (const auto &of_body : of_cycle.cells)
      {
        result.emplace_back();
        for (const CellState &state : of_body)
          result.back().push_back(state.history.degree);
      }
    return result;
  }

  void
  Adaptivity::refine(Bodies &bodies)
  {
    if (begins_anew)
      bodies = create_meshes(run);
    begins_anew = false;
    for (const auto &body : bodies)
      {
        const unsigned int b     = body->index;
        auto              &cells = of_cycle.cells;
        if (!next.splits.empty() && !body->mesh.tetrahedra)
          {
            const auto any = [](const std::vector<bool> &cells) {
              return std::find(cells.begin(), cells.end(), true) != cells.end();
            };
            if (Utilities::MPI::max(any(next.splits[b]) || any(next.merges[b]) ?
                                      1 :
                                      0,
                                    run.comm) == 1)
              change_cells(*body, next.splits[b], next.merges[b], cells[b]);
          }
        if (next.meshes.empty() || next.meshes[b].sizes == nullptr)
          continue;
        auto       stage = run.log.stage(run.timers, "mesh");
        const auto n     = body->triangulation().n_global_active_cells();
        body->pressure.reset();
        body->dof_handler.clear();
        sizes.resize(bodies.size());
        sizes[b] = next.meshes[b].sizes;
        create_mesh(run, sizes[b], *body);
        cells[b] = states_after(*body,
                                next.meshes[b],
                                rigid_motion(run.parameters.bodies[b].mesh));
        stage.details(
          "body " + body->name + ", " + std::to_string(n) + " cells become " +
          std::to_string(body->triangulation().n_global_active_cells()));
      }
  }

  void
  Adaptivity::add(const Bodies                      &bodies,
                  const std::vector<BodySolution>   &solutions,
                  const std::optional<DualSolution> &dual,
                  std::vector<InterfaceResidual>     interface_residuals,
                  const Residuals                   &residuals)
  {
    of_cycle.add(
      bodies, solutions, dual, std::move(interface_residuals), residuals);
    if (run.parameters.output.checkpoint_every > 0)
      keep(bodies);
    plan(bodies);
  }

  double
  Adaptivity::allowed_error() const
  {
    return of_cycle.memory.allowed_error *
           (goal ? target() : target() * target());
  }

  void
  Adaptivity::begin_step(const Bodies &bodies)
  {
    CoarseningOptions options;
    for (const auto &body : bodies)
      {
        const BodyParameters &given = run.parameters.bodies[body->index];
        options.first_degree.push_back(*given_degrees(given).begin());
        options.first_level.push_back(
          body->mesh.tetrahedra ? 0 : given.mesh.refinements);
        options.forgets |= has_history(*body);
      }
    next     = {};
    n_meshes = 0;
    // errors of a quantity are known from how they fell since the first mesh,
    // and splits of all cells would add up from step to step
    begins_anew =
      goal || (options.forgets && run.parameters.adaptivity.strategy == "h");
    if (begins_anew)
      {
        of_cycle.cells.clear();
        sizes.clear();
      }
    else
      {
        next.merges = coarsen(bodies, options, allowed_error(), of_cycle.cells);
        for (const auto &of_body : next.merges)
          next.splits.emplace_back(of_body.size(), false);
      }
    of_cycle.begin_step();
  }

  void
  Adaptivity::plan(const Bodies &bodies)
  {
    if (reached() || !limit().empty())
      return;
    const AdaptivityParameters &given = run.parameters.adaptivity;
    PlanOptions                 options{
                      {given.splits(), given.strategy == "h", given.largest_degree, {}},
      given.most_unknowns,
                      {}};
    for (const auto &body : bodies)
      {
        const BodyParameters &of_body = run.parameters.bodies[body->index];
        const MeshParameters &mesh    = of_body.mesh;
        auto                 &own     = options.remeshing.emplace_back();
        if (body->mesh.tetrahedra && mesh.source == "file" &&
            is_geometry_file(mesh.file))
          own = RemeshingOptions{0.,
                                 0,
                                 *given_degrees(of_body).begin(),
                                 rigid_motion(mesh),
                                 mesh.refinements};
        if (n_cycles() == 1 && given.splits() && body->mesh.tetrahedra && !own)
          run.log.line("  body " + body->name +
                       ": tetrahedra without a geometry keep their size, "
                       "degrees alone rise");
      }
    std::optional<double> allowed;
    if (of_cycle.memory.estimate)
      allowed = allowed_error();
    next = plan_meshes(bodies, options, allowed, n_meshes, of_cycle.cells);
    if (!next.meshes.empty())
      ++n_meshes;
  }

  std::string
  Adaptivity::limit() const
  {
    const AdaptivityParameters &given = run.parameters.adaptivity;
    if (of_cycle.quantity_is_zero)
      return "Quantity = " + goal->name +
             " is zero compared with the other components and has no relative error";
    switch (next.limit)
      {
        case MeshPlan::Limit::largest_degree:
          return "Largest degree = " + std::to_string(given.largest_degree) +
                 " allows no more";
        case MeshPlan::Limit::most_unknowns:
          return "Largest number of unknowns = " +
                 RunLog::number(given.most_unknowns) +
                 " is not enough, the next cycle needs about " +
                 RunLog::number(next.unknowns);
        default:
          return "";
      }
  }
} // namespace mortise
