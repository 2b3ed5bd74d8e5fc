#include <mortise/base/error.h>
#include <mortise/base/quotes.h>
#include <mortise/base/rigid_motion.h>
#include <mortise/material/invariant_laws.h>
#include <mortise/operators/boundary_area.h>
#include <mortise/problem/input/formulation.h>
#include <mortise/problem/input/interface_law.h>
#include <mortise/problem/scene/scene_data.h>

#include <algorithm>
#include <sstream>

namespace mortise
{
  using namespace dealii;

  bool
  have_finite_strain(const Parameters &parameters)
  {
    return std::any_of(parameters.bodies.begin(),
                       parameters.bodies.end(),
                       [](const BodyParameters &body) {
                         return is_finite(body.material);
                       });
  }

  std::vector<Material>
  materials(const Parameters &parameters)
  {
    std::vector<Material> result;
    for (const BodyParameters &body : parameters.bodies)
      result.push_back(make_material(
        body.material, is_mixed(body), [&](const std::string &name) {
          return parameters.where("Body " + body.name + "/Material/" + name);
        }));
    // rigid bodies are no stiffer for the solver than others
    std::optional<double> softest;
    for (unsigned int b = 0; b < result.size(); ++b)
      if (!is_rigid(parameters.bodies[b].material))
        softest = std::min(softest.value_or(result[b].softest_modulus()),
                           result[b].softest_modulus());
    const bool turns_far = have_finite_strain(parameters);
    for (unsigned int b = 0; softest && b < result.size(); ++b)
      if (is_rigid(parameters.bodies[b].material))
        {
          const LinearElastic law{*softest, 0., false};
          result[b] = turns_far ?
                        Material(law,
                                 std::make_shared<NeoHookean>(law.lame_lambda(),
                                                              law.lame_mu(),
                                                              0.)) :
                        Material(law);
        }
    return result;
  }

  namespace
  {
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

    std::array<bool, dim>
    fixed(const std::vector<Component> &field)
    {
      return {{!field[0].free, !field[1].free, !field[2].free}};
    }

    using VectorField = std::function<Tensor<1, dim>(const Point<dim> &)>;

    /// @p factor times what evaluate() gives joins @p fields.
    void
    add_unless_zero(std::vector<VectorField>     &fields,
                    const std::vector<Component> &field,
                    FieldChecks                  &checks,
                    const VectorField            &exact_value,
                    const double                  factor = 1.)
    {
      if (!all_zero(field))
        fields.push_back([=, &checks](const Point<dim> &x) {
          return factor * evaluate(field, x, checks, exact_value);
        });
    }
  } // namespace

  bool
  anything_acts(const Parameters &parameters)
  {
    const double time      = parameters.steps.first_time();
    const auto   is_vector = [&](const std::optional<Components> &given) {
      return given && !all_zero(components(*given, "", time));
    };
    const auto is_number = [&](const std::optional<std::string> &given) {
      return given && !all_zero({Component(*given, "", time)});
    };
    const auto has_loads = [&](const BodyParameters &body) {
      return std::any_of(body.supports.begin(),
                         body.supports.end(),
                         [&](const PointSupport &support) {
                           return is_vector(support.displacement);
                         }) ||
             is_vector(body.body_force) || is_number(body.temperature) ||
             (body.material.density > 0. && is_vector(parameters.gravity)) ||
             std::any_of(body.boundaries.begin(),
                         body.boundaries.end(),
                         [&](const auto &entry) {
                           const BoundaryParameters &given = entry.second;
                           return is_number(given.pressure) ||
                                  is_vector(given.traction) ||
                                  is_vector(given.force) ||
                                  is_vector(given.moment) ||
                                  is_vector(given.displacement) ||
                                  is_vector(given.rotation);
                         });
    };
    const auto moves = [&](const InterfaceParameters &interface) {
      return is_number(interface.offset) || is_number(interface.preload);
    };
    const auto is_given = [&](const std::string &text) {
      return text != "free" && is_number(text);
    };
    const auto any_given = [&](const std::array<std::string, 6> &all) {
      return std::any_of(all.begin(), all.end(), is_given);
    };
    return parameters.exact_solution.kind == ExactKind::expressions ||
           any_given(parameters.mean_strain) ||
           any_given(parameters.mean_stress) ||
           std::any_of(parameters.bodies.begin(),
                       parameters.bodies.end(),
                       has_loads) ||
           std::any_of(parameters.interfaces.begin(),
                       parameters.interfaces.end(),
                       moves);
  }

  bool
  have_real_gaps(const Parameters &parameters)
  {
    return std::any_of(parameters.interfaces.begin(),
                       parameters.interfaces.end(),
                       has_mesh_gap);
  }

  namespace
  {
    template <typename Function>
    Function
    scaled(const Function &function, const double factor)
    {
      if (!function || factor == 1.)
        return function;
      return [function, factor](const auto &...at) {
        return factor * function(at...);
      };
    }
  } // namespace

  void
  SceneData::add_pressure(const types::boundary_id id,
                          const std::string       &text,
                          const std::string       &where,
                          const bool               follows,
                          Loads                   &loads) const
  {
    const auto value = [pressure = Expression(text, where, time),
                        what     = where + ": " + in_quotes(text),
                        &watch   = checks](const Point<dim> &x) {
      return watch(pressure.value(x), x, what);
    };
    if (follows)
      loads.follower_pressures.push_back({id, value});
    else
      loads.tractions.push_back(
        {id, [value](const Point<dim> &x, const Tensor<1, dim> &normal) {
           return -value(x) * normal;
         }});
  }

  Point<dim>
  SceneData::reference_point(const Body               &body,
                             const BoundaryParameters &given,
                             const types::boundary_id  id)
  {
    if (!given.reference_point)
      return boundary_area(body, id).centroid;
    const auto &point = *given.reference_point;
    return Point<dim>(point[0], point[1], point[2]);
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
    const auto            balance = [=](const Point<dim> &p) {
      return exact->body_force(p, b);
    };
    if (!given.body_force &&
        parameters.exact_solution.kind == ExactKind::expressions)
      loads.body_force = balance;
    else
      {
        std::vector<VectorField> forces;
        if (given.body_force)
          add_unless_zero(forces,
                          components(*given.body_force,
                                     parameters.where(path + "/Body force"),
                                     time),
                          watch,
                          balance);
        if (parameters.gravity && given.material.density > 0.)
          add_unless_zero(forces,
                          components(*parameters.gravity,
                                     parameters.where("Gravity"),
                                     time),
                          watch,
                          balance,
                          given.material.density);
        if (!forces.empty())
          loads.body_force = [forces](const Point<dim> &x) {
            Tensor<1, dim> sum;
            for (const VectorField &force : forces)
              sum += force(x);
            return sum;
          };
      }

    loads.thermal_strain = thermal_strain(given);

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
                     return exact->nominal_stress(p, b) * normal;
                   });
                 }});
          }
        if (!boundary.is_rigid() && (boundary.force || boundary.moment))
          {
            const BoundaryArea   area = boundary_area(body, id);
            const Tensor<1, dim> force =
              total(boundary.force, where + "/Force");
            const Tensor<1, dim> moment =
              total(boundary.moment, where + "/Moment") +
              cross_product_3d(reference_point(body, boundary, id) -
                                 area.centroid,
                               force);
            const auto traction = equivalent_traction(area, force, moment);
            loads.tractions.push_back(
              {id, [traction](const Point<dim> &x, const Tensor<1, dim> &) {
                 return traction(x);
               }});
          }
        if (boundary.pressure && *boundary.pressure == "exact")
          loads.tractions.push_back(
            {id, [=](const Point<dim> &x, const Tensor<1, dim> &normal) {
               return (normal * (exact->nominal_stress(x, b) * normal)) *
                      normal;
             }});
        else if (boundary.pressure)
          add_pressure(id,
                       *boundary.pressure,
                       parameters.where(where + "/Pressure"),
                       boundary.pressure_follows.value_or(
                         is_finite(given.material)),
                       loads);
      }
    loads.body_force = scaled(loads.body_force, factor);
    for (TractionCondition &condition : loads.tractions)
      condition.traction = scaled(condition.traction, factor);
    for (PressureCondition &condition : loads.follower_pressures)
      condition.pressure = scaled(condition.pressure, factor);
    return loads;
  }

  std::function<double(const Point<dim> &)>
  SceneData::thermal_strain(const BodyParameters &given) const
  {
    if (!given.temperature)
      return {};
    const std::string where =
      parameters.where("Body " + given.name + "/Temperature");
    const Expression  temperature(*given.temperature, where, time);
    const std::string what = where + ": " + in_quotes(*given.temperature);
    return [temperature,
            what,
            expansion = factor * given.material.thermal_expansion,
            &watch    = checks](const Point<dim> &x) {
      return expansion * watch(temperature.value(x), x, what);
    };
  }

  std::function<Tensor<1, dim>(const Point<dim> &)>
  SceneData::rotation(const Body               &body,
                      const BoundaryParameters &boundary,
                      const types::boundary_id  id,
                      const std::string        &where) const
  {
    const std::string path = parameters.where(where + "/Rotation");
    if (!boundary.rotation ||
        all_zero(components(*boundary.rotation, path, time)))
      return {};
    const Tensor<1, dim> angle =
      numbers::PI / 180. * total(boundary.rotation, where + "/Rotation");
    const Point<dim> centre = reference_point(body, boundary, id);
    if (!is_finite(parameters.bodies[body.index].material) ||
        angle.norm() == 0.)
      return [angle, centre](const Point<dim> &x) {
        return cross_product_3d(angle, x - centre);
      };
    const Tensor<2, dim> change =
      rotation_by(angle) - unit_symmetric_tensor<dim>();
    return
      [change, centre](const Point<dim> &x) { return change * (x - centre); };
  }

  std::vector<DirichletCondition>
  SceneData::dirichlet(const Body &body) const
  {
    FieldChecks                    &watch = checks;
    const auto                      exact = solution;
    const unsigned int              b     = body.index;
    std::vector<DirichletCondition> conditions;
    // what else is prescribed there becomes part of the motion
    for (const RigidPart &part : rigid_parts_without_motions(body))
      for (const types::boundary_id id : part.boundaries)
        conditions.push_back({id, {{true, true, true}}, {}, {}, true});
    for (const auto &entry : parameters.bodies[b].boundaries)
      if (entry.second.displacement && !entry.second.is_rigid())
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
          condition.fixed = fixed(field);
          const Tensor<2, dim> axes =
            RigidMotion(entry.second.displacement_axes, {}).rotation;
          const VectorField turn =
            rotation(body, entry.second, condition.boundary, where);
          if (!all_zero(field) || turn)
            condition.value =
              scaled(VectorField([=, &watch](const Point<dim> &x) {
                       const Tensor<1, dim> value =
                         axes *
                         evaluate(field, x, watch, [&](const Point<dim> &p) {
                           return exact->displacement(p, b);
                         });
                       return turn ? value + turn(x) : value;
                     }),
                     factor);
          conditions.push_back(condition);
        }
    for (const PointSupport &support : parameters.bodies[b].supports)
      {
        const auto field =
          components(support.displacement,
                     parameters.where("Body " + body.name + "/Displacement at"),
                     time);
        const auto        &ends = support.ends;
        DirichletCondition condition;
        condition.segment = {Point<dim>(ends[0], ends[1], ends[2]),
                             Point<dim>(ends[ends.size() - 3],
                                        ends[ends.size() - 2],
                                        ends[ends.size() - 1])};
        condition.fixed   = fixed(field);
        if (!all_zero(field))
          condition.value =
            scaled(VectorField([=, &watch](const Point<dim> &x) {
                     return evaluate(field, x, watch, [&](const Point<dim> &p) {
                       return exact->displacement(p, b);
                     });
                   }),
                   factor);
        conditions.push_back(condition);
      }
    return conditions;
  }
} // namespace mortise
