// The exact solution that the parameters of a scene name: the constructor of
// SceneData.
#include <mortise/base/error.h>
#include <mortise/base/quotes.h>
#include <mortise/problem/scene/scene_data.h>

#include <array>
#include <sstream>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    /// Pressure on boundary @p name of body @p b; zero if there is none.
    double
    constant_pressure(const Parameters  &parameters,
                      const double       time,
                      const unsigned int b,
                      const std::string &name)
    {
      const auto &boundaries = parameters.bodies[b].boundaries;
      const auto  found      = boundaries.find(name);
      if (found == boundaries.end() || !found->second.pressure ||
          *found->second.pressure == "exact")
        return 0.;
      const std::string where =
        parameters.where("Body " + parameters.bodies[b].name + "/Boundary " +
                         name + "/Pressure");
      const Expression pressure(*found->second.pressure, where, time);
      if (!pressure.is_constant())
        throw InputError(
          where + ": got " + in_quotes(*found->second.pressure) +
          "; the named exact solutions need a constant pressure");
      return pressure.value(Point<dim>());
    }

    /// Entry @p name of @p interface.
    double
    constant_along(const Parameters          &parameters,
                   const double               time,
                   const InterfaceParameters &interface,
                   const std::string         &name,
                   const std::string         &text)
    {
      const std::string where =
        parameters.where("Interface " + interface.name + "/" + name);
      const Expression expression(text, where, time);
      if (!expression.is_constant())
        throw InputError(where + ": got " + in_quotes(text) +
                         "; the named exact solutions need a constant");
      return expression.value(Point<dim>());
    }

    std::shared_ptr<const ExactSolution>
    make_lame_solution(const Parameters            &parameters,
                       const double                 time,
                       const LameSolution::Geometry geometry)
    {
      const bool        sphere = geometry == LameSolution::Geometry::sphere;
      const std::string source = sphere ? "shell octant" : "cylinder sector";
      const std::string where = parameters.where("Exact solution/Displacement");
      std::vector<LameSolution::Layer> layers;
      unsigned int                     innermost = 0, outermost = 0;
      for (unsigned int b = 0; b < parameters.bodies.size(); ++b)
        {
          const MeshParameters &mesh = parameters.bodies[b].mesh;
          if (mesh.source != source || mesh.extent.size() < 2)
            throw InputError(
              where + ": the named solution needs bodies of Source = " +
              source + "; body " + in_quotes(parameters.bodies[b].name, '\'') +
              " has Source = " + mesh.source);
          const Material material = materials(parameters)[b];
          if (material.isotropic() == nullptr || material.nonlinear())
            throw InputError(
              where +
              ": the named solution needs bodies of Law = linear "
              "elastic at small strain; body " +
              in_quotes(parameters.bodies[b].name, '\'') +
              " has Law = " + parameters.bodies[b].material.law);
          layers.push_back(
            {mesh.extent[0], mesh.extent[1], *material.isotropic()});
          if (mesh.extent[0] < layers[innermost].inner_radius)
            innermost = b;
          if (mesh.extent[1] > layers[outermost].outer_radius)
            outermost = b;
        }
      for (const InterfaceParameters &interface : parameters.interfaces)
        {
          if (interface.is_support && interface.law == Law::spring)
            parameters.fail(interface.path() + "/Normal stiffness",
                            in_quotes(*interface.normal_stiffness) +
                              " with a named exact solution",
                            "none, since it has no elastic foundation");
          if (interface.is_support)
            continue;
          LameSolution::Layer &a     = layers[interface.slave.body],
                              &b     = layers[interface.master.body];
          LameSolution::Layer &outer = a.inner_radius < b.inner_radius ? b : a;
          outer.offset_inside        = constant_along(
            parameters, time, interface, "Offset", interface.offset);
          outer.contact_inside = is_one_sided(interface.law);
          if (interface.normal_stiffness)
            outer.compliance_inside =
              1. / constant_along(parameters,
                                  time,
                                  interface,
                                  "Normal stiffness",
                                  *interface.normal_stiffness);
        }
      return std::make_shared<LameSolution>(
        geometry,
        layers,
        constant_pressure(parameters, time, innermost, "inside"),
        constant_pressure(parameters, time, outermost, "outside"),
        rigid_motion(parameters.bodies[innermost].mesh));
    }

    /// An exact solution whose values are watched.
    class CheckedSolution : public ExactSolution
    {
    public:
      CheckedSolution(const std::shared_ptr<const ExactSolution> &exact,
                      const std::string                          &where,
                      FieldChecks                                &checks)
        : exact(exact)
        , checks(checks)
      {
        for (unsigned int i = 0; i < what.size(); ++i)
          what[i] = where + ": the exact " + quantities[i];
      }

      Tensor<1, 3>
      displacement(const Point<3> &p, const unsigned int body) const override
      {
        return checks.all(exact->displacement(p, body), p, what[0]);
      }

      Tensor<2, 3>
      gradient(const Point<3> &p, const unsigned int body) const override
      {
        return checks.all(exact->gradient(p, body), p, what[1]);
      }

      SymmetricTensor<2, 3>
      stress(const Point<3> &p, const unsigned int body) const override
      {
        return checks.all(exact->stress(p, body), p, what[2]);
      }

      Tensor<2, 3>
      nominal_stress(const Point<3> &p, const unsigned int body) const override
      {
        return checks.all(exact->nominal_stress(p, body), p, what[2]);
      }

      Tensor<1, 3>
      body_force(const Point<3> &p, const unsigned int body) const override
      {
        return checks.all(exact->body_force(p, body), p, what[3]);
      }

    private:
      static constexpr std::array<const char *, 4> quantities = {
        {"displacement's norm",
         "norm of the displacement's gradient",
         "stress's norm",
         "body force's norm"}};

      const std::shared_ptr<const ExactSolution> exact;
      FieldChecks                               &checks;
      std::array<std::string, 4>                 what;
    };

    std::shared_ptr<const ExactSolution>
    make_expression_solution(const Parameters  &parameters,
                             const double       time,
                             const std::string &where)
    {
      const auto             &pressure = parameters.exact_solution.pressure;
      std::vector<Expression> thermal_strains;
      for (const BodyParameters &body : parameters.bodies)
        {
          std::ostringstream strain;
          strain.precision(17);
          strain << body.material.thermal_expansion << " * ("
                 << body.temperature.value_or("0") << ")";
          thermal_strains.emplace_back(strain.str(),
                                       parameters.where("Body " + body.name +
                                                        "/Temperature"),
                                       time);
        }
      return std::make_shared<ExpressionSolution>(
        VectorExpression(joined(parameters.exact_solution.displacement),
                         where,
                         time),
        materials(parameters),
        Expression(pressure.value_or("0"),
                   parameters.where("Exact solution/Pressure"),
                   time),
        thermal_strains);
    }
  } // namespace

  SceneData::SceneData(const Parameters &parameters,
                       const double      at,
                       FieldChecks      &checks)
    : parameters(parameters)
    , factor(parameters.steps.ramp ? at : 1.)
    , time(parameters.steps.ramp ? 1. : at)
    , checks(checks)
  {
    const ExactSolutionParameters &given = parameters.exact_solution;
    std::string where = parameters.where("Exact solution/Displacement");
    if (given.kind == ExactKind::thick_sphere)
      solution =
        make_lame_solution(parameters, time, LameSolution::Geometry::sphere);
    else if (given.kind == ExactKind::thick_cylinder)
      solution =
        make_lame_solution(parameters, time, LameSolution::Geometry::cylinder);
    else if (given.kind == ExactKind::expressions)
      {
        solution = make_expression_solution(parameters, time, where);
        where += ": in " + in_quotes(joined(given.displacement));
        if (given.pressure)
          where += " with Pressure = " + in_quotes(*given.pressure);
      }
    else
      return;
    solution = std::make_shared<CheckedSolution>(solution, where, checks);
  }
} // namespace mortise
