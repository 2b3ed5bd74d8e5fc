#include <mortise/base/error.h>
#include <mortise/base/quotes.h>
#include <mortise/problem/formulation.h>
#include <mortise/problem/scene_data.h>

#include <algorithm>
#include <array>

namespace mortise
{
  using namespace dealii;

  std::vector<Material>
  materials(const Parameters &parameters)
  {
    std::vector<Material> result;
    for (const BodyParameters &body : parameters.bodies)
      result.push_back(make_material(
        body.material, is_mixed(body), [&](const std::string &name) {
          return parameters.where("Body " + body.name + "/Material/" + name);
        }));
    return result;
  }

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
          if (material.isotropic() == nullptr)
            throw InputError(
              where +
              ": the named solution needs bodies of Law = linear "
              "elastic; body " +
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
          LameSolution::Layer &a     = layers[interface.slave.body],
                              &b     = layers[interface.master.body];
          LameSolution::Layer &outer = a.inner_radius < b.inner_radius ? b : a;
          outer.offset_inside        = constant_along(
            parameters, time, interface, "Offset", interface.offset);
          outer.contact_inside = interface.law == "contact";
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

    /// One component of a given vector field: an expression, the exact
    /// solution's, or free.
    struct Component
    {
      Component(const std::string &text,
                const std::string &where,
                const double       time)
        : exact(text == "exact")
        , free(text == "-")
        , expression(exact || free ? "0" : text, where, time)
        , what(where + ": " + in_quotes(text))
      {}

      bool        exact, free;
      Expression  expression;
      std::string what; ///< for messages
    };

    std::vector<Component>
    components(const Components  &texts,
               const std::string &where,
               const double       time)
    {
      std::vector<Component> result;
      for (unsigned int c = 0; c < dim; ++c)
        result.emplace_back(texts[c], where + ", component " + "xyz"[c], time);
      return result;
    }

    /// At all times.
    bool
    all_zero(const std::vector<Component> &field)
    {
      return std::all_of(
        field.begin(), field.end(), [](const Component &component) {
          return !component.exact && component.expression.is_constant() &&
                 !component.expression.depends_on_time() &&
                 component.expression.value(Point<dim>()) == 0.;
        });
    }

    /// Values of @p field at x, components that are "exact" from @p exact_value.
    template <typename ExactValue>
    Tensor<1, dim>
    evaluate(const std::vector<Component> &field,
             const Point<dim>             &x,
             FieldChecks                  &checks,
             const ExactValue             &exact_value)
    {
      Tensor<1, dim> value;
      for (unsigned int c = 0; c < dim; ++c)
        if (!field[c].exact)
          value[c] = checks(field[c].expression.value(x), x, field[c].what);
      if (field[0].exact || field[1].exact || field[2].exact)
        {
          const Tensor<1, dim> exact = exact_value(x);
          for (unsigned int c = 0; c < dim; ++c)
            if (field[c].exact)
              value[c] = exact[c];
        }
      return value;
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
      const auto &pressure = parameters.exact_solution.pressure;
      return std::make_shared<ExpressionSolution>(
        VectorExpression(joined(parameters.exact_solution.displacement),
                         where,
                         time),
        materials(parameters),
        Expression(pressure.value_or("0"),
                   parameters.where("Exact solution/Pressure"),
                   time));
    }
  } // namespace

  SceneData::SceneData(const Parameters &parameters,
                       const double      time,
                       FieldChecks      &checks)
    : parameters(parameters)
    , time(time)
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

  Loads
  SceneData::loads(const Body &body) const
  {
    FieldChecks          &watch = checks;
    const auto            exact = solution;
    const BodyParameters &given = parameters.bodies[body.index];
    const std::string     path  = "Body " + body.name;
    const unsigned int    b     = body.index;
    Loads                 loads;
    if (given.body_force)
      {
        const auto field = components(*given.body_force,
                                      parameters.where(path + "/Body force"),
                                      time);
        if (!all_zero(field))
          loads.body_force = [=, &watch](const Point<dim> &x) {
            return evaluate(field, x, watch, [&](const Point<dim> &p) {
              return exact->body_force(p, b);
            });
          };
      }
    else if (parameters.exact_solution.kind == ExactKind::expressions)
      loads.body_force = [=](const Point<dim> &x) {
        return exact->body_force(x, b);
      };

    for (const auto &entry : given.boundaries)
      {
        const BoundaryParameters &boundary = entry.second;
        const std::string         where    = path + "/Boundary " + entry.first;
        const auto id = body.boundary_id(entry.first, parameters.where(where));
        if (boundary.traction)
          {
            const auto field = components(*boundary.traction,
                                          parameters.where(where + "/Traction"),
                                          time);
            if (!all_zero(field))
              loads.tractions.push_back(
                {id,
                 [=, &watch](const Point<dim>     &x,
                             const Tensor<1, dim> &normal) {
                   return evaluate(field, x, watch, [&](const Point<dim> &p) {
                     return exact->stress(p, b) * normal;
                   });
                 }});
          }
        if (boundary.pressure && *boundary.pressure == "exact")
          loads.tractions.push_back(
            {id, [=](const Point<dim> &x, const Tensor<1, dim> &normal) {
               return (normal * (exact->stress(x, b) * normal)) * normal;
             }});
        else if (boundary.pressure)
          {
            const std::string here = parameters.where(where + "/Pressure");
            const Expression  pressure(*boundary.pressure, here, time);
            const std::string what =
              here + ": " + in_quotes(*boundary.pressure);
            loads.tractions.push_back(
              {id,
               [=, &watch](const Point<dim> &x, const Tensor<1, dim> &normal) {
                 return -watch(pressure.value(x), x, what) * normal;
               }});
          }
      }
    return loads;
  }

  std::function<double(const Point<dim> &)>
  SceneData::offset(const InterfaceParameters &given) const
  {
    const std::string where =
      parameters.where("Interface " + given.name + "/Offset");
    const Expression expression(given.offset, where, time);
    if (expression.is_constant() && !expression.depends_on_time() &&
        expression.value(Point<dim>()) == 0.)
      return {};
    const std::string what = where + ": " + in_quotes(given.offset);
    return [expression, what, &watch = checks](const Point<dim> &x) {
      return watch(expression.value(x), x, what);
    };
  }

  std::vector<DirichletCondition>
  SceneData::dirichlet(const Body &body) const
  {
    FieldChecks                    &watch = checks;
    const auto                      exact = solution;
    const unsigned int              b     = body.index;
    std::vector<DirichletCondition> conditions;
    for (const auto &entry : parameters.bodies[b].boundaries)
      if (entry.second.displacement)
        {
          const std::string where =
            "Body " + body.name + "/Boundary " + entry.first;
          const auto field =
            components(*entry.second.displacement,
                       parameters.where(where + "/Displacement"),
                       time);
          DirichletCondition condition;
          condition.boundary =
            body.boundary_id(entry.first, parameters.where(where));
          for (unsigned int c = 0; c < dim; ++c)
            condition.fixed[c] = !field[c].free;
          if (!all_zero(field))
            condition.value = [=, &watch](const Point<dim> &x) {
              return evaluate(field, x, watch, [&](const Point<dim> &p) {
                return exact->displacement(p, b);
              });
            };
          conditions.push_back(condition);
        }
    return conditions;
  }
} // namespace mortise
