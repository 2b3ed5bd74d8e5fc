#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <mortise/base/quotes.h>
#include <mortise/problem/adaptive/quantity.h>

#include <algorithm>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    const std::string components_of_quantities = "xyz";

    template <typename Quantities>
    std::string
    add_names(const Quantities &quantities, std::string names)
    {
      for (const auto &quantity : quantities)
        names += (names.empty() ? "" : ", ") + quantity.name;
      return names;
    }
  } // namespace

  std::optional<Quantity>
  Quantity::given(const Parameters &parameters)
  {
    const std::string &name = parameters.adaptivity.quantity;
    if (name.empty())
      return {};
    return Quantity(parameters, name);
  }

  Quantity::Quantity(const Parameters &parameters, const std::string &name)
    : parameters(&parameters)
  {
    const OutputParameters &output = parameters.output;
    const auto              fail   = [&](const std::string &got) {
      const std::string names =
        add_names(output.resultants, add_names(output.points, ""));
      parameters.fail(
        "Adaptivity/Quantity",
        got,
        names.empty() ?
                         "an entry of Output/Points or Output/Resultants, of which there is "
                         "none, with a component: \"NAME, x\"" :
                         "one of " + names +
            " (entries of Output/Points and Output/Resultants), with "
                           "a component: \"NAME, x\", y or z");
    };
    const std::size_t comma = name.rfind(',');
    if (comma == std::string::npos)
      fail(in_quotes(name) + ", without a component");
    const std::string of = Utilities::trim(name.substr(0, comma)),
                      c  = Utilities::trim(name.substr(comma + 1));
    if (c.size() != 1 || components_of_quantities.find(c) == std::string::npos)
      fail(in_quotes(name) + " with component " + in_quotes(c));
    component        = components_of_quantities.find(c);
    text             = of + ", " + c;
    bool       found = false;
    const auto take  = [&](const auto &quantities) {
      for (const auto &any : quantities)
        if (any.name == of)
          {
            quantity = any;
            found    = true;
          }
    };
    take(output.points);
    take(output.resultants);
    if (!found)
      fail(in_quotes(of));
  }

  void
  Quantity::fail_outside(const Bodies &bodies) const
  {
    parameters->fail("Adaptivity/Quantity",
                     in_quotes(text) + ", whose point lies outside of body " +
                       in_quotes(bodies[body()]->name),
                     "a point of Output/Points in its body");
  }

  unsigned int
  Quantity::body() const
  {
    return std::visit([](const auto &any) { return any.body; }, quantity);
  }

  Tensor<1, dim>
  Quantity::all_components(const Bodies                    &bodies,
                           const std::vector<BodySolution> &solutions,
                           const BoundaryForces            &forces) const
  {
    const Body &body = *bodies[this->body()];
    if (const auto *force = std::get_if<ResultantQuantity>(&quantity))
      return forces.on(body.index, body.boundary_id(force->boundary, ""), {})
        .force;
    const auto value = point_value(body,
                                   solutions[body.index].displacement,
                                   std::get<PointQuantity>(quantity).point);
    if (!value)
      fail_outside(bodies);
    return *value;
  }

  double
  Quantity::value(const Bodies &bodies, const ExactSolution &exact) const
  {
    const Body &body = *bodies[this->body()];
    if (const auto *force = std::get_if<ResultantQuantity>(&quantity))
      return resultant(body,
                       exact,
                       body.boundary_id(force->boundary, ""))[component];
    return exact.displacement(std::get<PointQuantity>(quantity).point,
                              body.index)[component];
  }

  LinearFunctional
  Quantity::derivative(const Discretisation &discretisation) const
  {
    const Bodies &bodies = discretisation.bodies();
    const Body   &body   = *bodies[this->body()];
    if (const auto *force = std::get_if<ResultantQuantity>(&quantity))
      return reaction_functional(discretisation,
                                 body.index,
                                 body.boundary_id(force->boundary, ""),
                                 component);
    const CellFunctionals on_cells =
      point_functional(body,
                       std::get<PointQuantity>(quantity).point,
                       component);
    if (Utilities::MPI::max(on_cells.empty() ? 0 : 1,
                            body.triangulation().get_communicator()) == 0)
      fail_outside(bodies);
    return {discretisation.load(body, on_cells).rhs,
            discretisation.linear_system().zero_vector().displacement};
  }

  DualSolution
  solve_dual(const RunContext                &run,
             const Discretisation            &discretisation,
             LinearSolver                    &solver,
             Preloads                        &preloads,
             const Quantity                  &quantity,
             const std::vector<BodySolution> &solutions,
             const BoundaryForces            &forces,
             const std::vector<BodySolution> &start)
  {
    DualSolution         result;
    const Tensor<1, dim> all =
      quantity.all_components(discretisation.bodies(), solutions, forces);
    result.value            = all[quantity.component_number()];
    result.size             = all.norm();
    const auto   functional = quantity.derivative(discretisation);
    SceneLoad    load{functional.rhs, {}};
    SystemVector z;
    if (start.empty())
      result.report = solver.solve(load.rhs, z);
    else
      {
        z             = discretisation.system_vector(start, load);
        result.report = solver.solve_from(load.rhs, z);
      }
    preloads.release(load.rhs, z, result.report);
    z.displacement -= functional.lift;
    result.solutions = discretisation.solutions(load, z);
    run.timers.add("dual", result.report.solve_seconds);
    run.log.stage_line("dual",
                       result.report.solve_seconds,
                       std::to_string(result.report.iterations) +
                         " iterations, residual " +
                         RunLog::number(result.report.relative_residual));
    return result;
  }
} // namespace mortise
