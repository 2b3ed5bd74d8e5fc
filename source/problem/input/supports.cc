// Displacements along other directions than the axes of the scene:
// add_supports().
#include <mortise/base/error.h>
#include <mortise/base/quotes.h>
#include <mortise/base/rigid_motion.h>
#include <mortise/problem/input/parameters.h>

#include <algorithm>

namespace mortise
{
  namespace
  {
    /// "body boundary", which no body and no interface is called.
    std::string
    support_name(const Parameters  &parameters,
                 const std::string &body,
                 const std::string &boundary)
    {
      std::string name = body + " " + boundary;
      const auto is = [&name](const auto &other) { return other.name == name; };
      while (
        std::any_of(parameters.bodies.begin(), parameters.bodies.end(), is) ||
        std::any_of(parameters.interfaces.begin(),
                    parameters.interfaces.end(),
                    is))
        name += "-";
      return name;
    }

    /// A support of @p boundary of body @p b, displaced by @p displacement along the normal.
    InterfaceParameters
    support(const Parameters  &parameters,
            const unsigned int b,
            const std::string &boundary,
            const std::string &displacement)
    {
      const std::string  &body = parameters.bodies[b].name;
      InterfaceParameters result;
      result.name       = support_name(parameters, body, boundary);
      result.slave      = {b, {boundary}};
      result.master     = result.slave;
      result.law        = Law::slide;
      result.offset     = displacement;
      result.is_support = true;
      result.displacement_path =
        "Body " + body + "/Boundary " + boundary + "/Displacement";
      return result;
    }

    /// All components in rotated axes are components in those of the scene;
    /// others are supports.
    void
    add_rotated(Parameters        &parameters,
                const unsigned int b,
                const std::string &name)
    {
      BoundaryParameters &boundary = parameters.bodies[b].boundaries[name];
      const Components    given    = *boundary.displacement;
      const std::string   path     = "Body " + parameters.bodies[b].name +
                               "/Boundary " + name + "/Displacement";
      if (std::count(given.begin(), given.end(), "exact") > 0)
        parameters.fail(path,
                        in_quotes(joined(given)) + " with Displacement axes",
                        "expressions, or - for what is free");
      if (std::count(given.begin(), given.end(), "-") == 0)
        return; // SceneData rotates them
      const dealii::Tensor<2, 3> axes =
        RigidMotion(boundary.displacement_axes, {}).rotation;
      for (unsigned int c = 0; c < 3; ++c)
        if (given[c] != "-")
          {
            InterfaceParameters  along = support(parameters, b, name, given[c]);
            dealii::Tensor<1, 3> unit;
            unit[c]         = 1.;
            along.direction = axes * unit;
            parameters.interfaces.push_back(along);
          }
      boundary.displacement.reset();
    }
  } // namespace

  void
  add_supports(Parameters &parameters)
  {
    for (unsigned int b = 0; b < parameters.bodies.size(); ++b)
      for (auto &[name, boundary] : parameters.bodies[b].boundaries)
        {
          const bool rotated =
            boundary.displacement_axes != std::array<double, 3>();
          const std::string path = "Body " + parameters.bodies[b].name +
                                   "/Boundary " + name + "/Displacement";
          if (rotated && !boundary.displacement)
            parameters.fail(
              path + " axes",
              "axes for no components",
              "nothing without a Displacement of three components");
          if (rotated)
            add_rotated(parameters, b, name);
          if (boundary.normal_displacement)
            parameters.interfaces.push_back(
              support(parameters, b, name, *boundary.normal_displacement));
        }
  }
} // namespace mortise
