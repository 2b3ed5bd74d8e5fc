#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/base/quotes.h>
#include <mortise/body/mesh/mesh_findings.h>
#include <mortise/problem/input/formulation.h>
#include <mortise/problem/input/interface_law.h>
#include <mortise/problem/scene/scene_spaces.h>
#include <mortise/problem/support/rigid_support.h>
#include <mortise/problem/support/side_faces.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <set>

namespace mortise
{
  using namespace dealii;

  bool
  SceneSpaces::has_prescribed_values() const
  {
    for (const auto &of_body : dirichlet)
      for (const DirichletCondition &condition : of_body)
        if (condition.value)
          return true;
    return false;
  }

  void
  create_mesh(const RunContext                &run,
              std::shared_ptr<const SizeField> sizes,
              Body                            &body)
  {
    const Parameters     &parameters = run.parameters;
    std::set<std::string> tied_boundaries;
    for (const InterfaceParameters &interface : parameters.interfaces)
      for (const SideParameters &side : {interface.slave, interface.master})
        if (side.body == body.index)
          tied_boundaries.insert(side.boundaries.begin(),
                                 side.boundaries.end());
    MeshParameters mesh   = parameters.bodies[body.index].mesh;
    mesh.is_refined_later = parameters.adaptivity.splits();
    mesh.sizes            = std::move(sizes);
    body.create_mesh(mesh,
                     run.comm,
                     "Body " + body.name + ", Mesh",
                     tied_boundaries);
  }

  namespace
  {
    /// Doubles are the farther apart the larger they are: warn where far from
    /// the origin that is in the results, and refuse cells that have hardly a
    /// shape. Collective.
    void
    check_resolution(const RunContext &run, const Body &body)
    {
      // of the least extent of a body; of the shortest edge
      constexpr double told = 1e-10, refused = 1e-4;
      // coordinates, the same with the sign changed, minus the shortest edge
      double largest[2 * dim + 1];
      std::fill(std::begin(largest),
                std::end(largest),
                -std::numeric_limits<double>::max());
      for (const auto &cell : body.triangulation().active_cell_iterators())
        if (cell->is_locally_owned())
          {
            for (const unsigned int v : cell->vertex_indices())
              for (unsigned int d = 0; d < dim; ++d)
                {
                  const double x   = cell->vertex(v)[d];
                  largest[d]       = std::max(largest[d], x);
                  largest[dim + d] = std::max(largest[dim + d], -x);
                }
            largest[2 * dim] =
              std::max(largest[2 * dim], -cell->minimum_vertex_distance());
          }
      Utilities::MPI::max(largest, run.comm, largest);
      double far = 0., extent = std::numeric_limits<double>::max();
      for (unsigned int d = 0; d < dim; ++d)
        {
          far    = std::max({far, largest[d], largest[dim + d]});
          extent = std::min(extent, largest[d] + largest[dim + d]);
        }
      const double      spacing = std::numeric_limits<double>::epsilon() * far;
      const double      edge    = -largest[2 * dim];
      const std::string what    = "its coordinates are up to " +
                               RunLog::number(far) + ", where numbers are " +
                               RunLog::number(spacing) + " apart";
      const std::string remedy =
        "Mesh/Translate, or a file whose origin is near the body";
      if (spacing > refused * edge)
        throw InputError("Body " + body.name + ", Mesh: " + what +
                         ", and its shortest edge has " + RunLog::number(edge) +
                         "; allowed: edges of at least " +
                         RunLog::number(spacing / refused) + " there (" +
                         remedy + ")");
      if (spacing > told * extent)
        run.log.warning("body " + body.name + " is far from the origin: " +
                        what + ", " + RunLog::number(spacing / extent) +
                        " of its least extent; results have no more digits "
                        "than that. Remedy: " +
                        remedy);
    }
  } // namespace

  namespace
  {
    /// The mesh of @p body, and the @p names of its boundaries if they are
    /// known; what is wrong with it becomes one of @p problems.
    void
    try_to_create_mesh(const RunContext                        &run,
                       Body                                    &body,
                       std::optional<std::vector<std::string>> &names,
                       std::vector<std::string>                &problems)
    {
      try
        {
          create_mesh(run, nullptr, body);
          names.emplace();
          for (const auto &name : body.mesh.names.boundaries)
            names->push_back(name.first);
          if (!body.mesh.remark.empty())
            run.log.line("body " + body.name + ": " + body.mesh.remark);
          check_resolution(run, body);
        }
      catch (const MeshError &error)
        {
          problems.emplace_back(error.what());
          names = error.boundaries;
        }
      catch (const InputError &error)
        {
          problems.emplace_back(error.what());
        }
    }
  } // namespace

  Bodies
  create_meshes(const RunContext &run)
  {
    auto              stage      = run.log.stage(run.timers, "mesh");
    const Parameters &parameters = run.parameters;
    Bodies            bodies;
    NamesOfBoundaries names(parameters.bodies.size());
    // of all bodies: who repairs meshes wants to know what is left to do
    std::vector<std::string> problems;
    for (unsigned int b = 0; b < parameters.bodies.size(); ++b)
      {
        bodies.push_back(std::make_unique<Body>(parameters.bodies[b].name,
                                                b,
                                                materials(parameters)[b]));
        try_to_create_mesh(run, *bodies[b], names[b], problems);
      }
    try
      {
        check_boundary_names(parameters, names);
      }
    catch (const InputError &error)
      {
        problems.emplace_back(error.what());
      }
    if (!problems.empty())
      throw InputError(join_lines(problems, 30));
    std::uint64_t n_cells = 0;
    for (const auto &body : bodies)
      n_cells += body->triangulation().n_global_active_cells();
    stage.details(std::to_string(bodies.size()) +
                  (bodies.size() == 1 ? " body, " : " bodies, ") +
                  std::to_string(n_cells) + " cells");
    return bodies;
  }

  namespace
  {
    /// Points and lines are where vertices are. Collective.
    void
    check_supports(const RunContext                      &run,
                   const Body                            &body,
                   const std::vector<DirichletCondition> &dirichlet)
    {
      const auto &given   = run.parameters.bodies[body.index].supports;
      auto        support = dirichlet.end() - given.size(); // the last ones
      for (const PointSupport &of : given)
        if (Utilities::MPI::max(faces_of(body, *support++).size(), run.comm) ==
            0)
          run.parameters.fail("Body " + body.name + "/Displacement at",
                              in_quotes(of.text) +
                                ", where the surface of the body has no vertex",
                              "vertices of the mesh, or straight edges");
    }

    /// The same conditions with the value zero.
    std::vector<DirichletCondition>
    homogeneous(std::vector<DirichletCondition> conditions)
    {
      for (DirichletCondition &condition : conditions)
        condition.value = {};
      return conditions;
    }

    std::vector<AffineConstraints<double>>
    constraints_of(
      const Bodies                                       &bodies,
      const std::vector<std::vector<DirichletCondition>> &dirichlet)
    {
      std::vector<AffineConstraints<double>> constraints(bodies.size());
      for (const auto &body : bodies)
        {
          auto &own = constraints[body->index];
          own.copy_from(body->conformity);
          add_dirichlet_constraints(*body, dirichlet[body->index], own);
        }
      return constraints;
    }

    /// The least that a spring carries per area when a body moves by its size,
    /// a modulus; stiffnesses of zero carry nothing. Collective.
    double
    softest_spring(const RunContext &run, const Bodies &bodies)
    {
      double softest = std::numeric_limits<double>::max();
      for (const InterfaceParameters &interface : run.parameters.interfaces)
        if (interface.law == Law::spring)
          {
            const double size      = extent(*bodies[interface.slave.body]).size;
            const InterfaceLaw law = interface_law(run.parameters, interface);
            for (const BoundaryFace &face : side_faces(
                   bodies, interface.slave, "Interface " + interface.name))
              {
                const InterfaceStiffness at =
                  law.stiffness(face.cell->face(face.number)->center());
                for (const double k : {at.normal, at.tangential})
                  if (k > 0.)
                    softest = std::min(softest, k * size);
              }
          }
      return Utilities::MPI::min(softest, run.comm);
    }

    /// The method, and the nodal spaces that it needs.
    void
    choose_method(const RunContext &run, SceneSpaces &spaces)
    {
      std::vector<const Body *> scene;
      double softest = std::numeric_limits<double>::max(), stiffest = 0.;
      for (const auto &body : spaces.bodies)
        {
          scene.push_back(body.get());
          softest  = std::min(softest, body->material.softest_modulus());
          stiffest = std::max(stiffest, body->material.stiffest_modulus());
        }
      const bool mixed = spaces.fields.pressure.numbering.size() > 0;
      spaces.choice =
        choose_solver(run.parameters.solver.method,
                      {spaces.fields.displacement.numbering.size(),
                       mixed,
                       stiffest / softest,
                       stiffest / softest_spring(run, spaces.bodies)});
      spaces.nodal = make_nodal_spaces(scene, run.comm);
      if (spaces.choice.method == SolverMethod::direct)
        spaces.nodal.resize(1);
      if (mixed)
        spaces.nodal_pressures = make_nodal_pressures(scene, run.comm);
    }
  } // namespace

  void
  create_space(const RunContext &run, Body &body)
  {
    const BodyParameters &given = run.parameters.bodies[body.index];
    body.create_space(given.degree,
                      given.degree_by_region,
                      "Body " + body.name,
                      given.degree_near,
                      given.least_mapping_degree);
  }

  void
  create_spaces(const RunContext &run,
                const SceneData  &data,
                SceneSpaces      &spaces)
  {
    auto stage = run.log.stage(run.timers, "spaces");

    std::vector<const DoFHandler<dim> *>         handlers;
    std::vector<std::vector<DirichletCondition>> zero;
    for (const auto &body : spaces.bodies)
      {
        const BodyParameters &given = run.parameters.bodies[body->index];
        if (spaces.cycle.degrees.empty())
          create_space(run, *body);
        else
          body->create_space(spaces.cycle.degrees[body->index]);
        handlers.push_back(&body->dof_handler);
        if (body->n_straightened > 0)
          run.log.warning("body " + body->name +
                          ": curved cells would be tangled and are straight: " +
                          std::to_string(body->n_straightened) +
                          "; a finer mesh is more accurate there");
        if (locks(given))
          run.log.warning(
            "body " + body->name + " with Poisson ratio " +
            RunLog::number(given.material.poisson_ratio) +
            " and degree 1 is too stiff (it locks); a higher Degree "
            "gives it a pressure of its own");
        spaces.dirichlet.push_back(data.dirichlet(*body));
        check_supports(run, *body, spaces.dirichlet.back());
        zero.push_back(homogeneous(spaces.dirichlet.back()));
      }
    spaces.rigid_parts       = data.rigid_parts(spaces.bodies);
    spaces.constraints       = constraints_of(spaces.bodies, zero);
    SceneField &displacement = spaces.fields.displacement;
    displacement.numbering   = FieldNumbering(handlers, run.comm);
    displacement.constraints =
      scene_constraints(displacement.numbering, spaces.constraints);
    spaces.fields.pressure = pressure_field(spaces.bodies, run.comm);
    choose_method(run, spaces);

    const auto n_pressures = spaces.fields.pressure.numbering.size();
    stage.details(
      std::to_string(displacement.numbering.size()) + " displacement dofs" +
      (n_pressures > 0 ? ", " + std::to_string(n_pressures) + " pressures" :
                         ""));
  }

  PrescribedValues
  prescribed_values(const SceneSpaces &spaces, const SceneData &data)
  {
    if (!spaces.has_prescribed_values())
      return {};
    std::vector<std::vector<DirichletCondition>> dirichlet;
    for (const auto &body : spaces.bodies)
      dirichlet.push_back(data.dirichlet(*body));
    return prescribed_values(
      scene_constraints(spaces.fields.displacement.numbering,
                        constraints_of(spaces.bodies, dirichlet)));
  }

  PrescribedValues
  prescribed_values(const SceneSpaces &spaces,
                    const RigidPart   &part,
                    const AffineField &field)
  {
    std::vector<std::vector<DirichletCondition>> dirichlet;
    for (const auto &of_body : spaces.dirichlet)
      dirichlet.push_back(homogeneous(of_body));
    for (DirichletCondition &condition : dirichlet[part.body])
      if (condition.is_rigid && std::count(part.boundaries.begin(),
                                           part.boundaries.end(),
                                           condition.boundary) > 0)
        condition.value = [field,
                           centre = part.where.centre](const Point<dim> &x) {
          return field.value + field.gradient * (x - centre);
        };
    return prescribed_values(
      scene_constraints(spaces.fields.displacement.numbering,
                        constraints_of(spaces.bodies, dirichlet)));
  }
} // namespace mortise
