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

    /// A support of @p boundary of body @p b.
    InterfaceParameters
    support(const Parameters  &parameters,
            const unsigned int b,
            const std::string &boundary,
            const Law          law)
    {
      const std::string  &body = parameters.bodies[b].name;
      InterfaceParameters result;
      result.name       = support_name(parameters, body, boundary);
      result.slave      = {b, {boundary}};
      result.master     = result.slave;
      result.law        = law;
      result.is_support = true;
      result.boundary   = "Body " + body + "/Boundary " + boundary;
      return result;
    }

    /// One that displaces it by @p displacement along the normal.
    InterfaceParameters
    roller(const Parameters  &parameters,
           const unsigned int b,
           const std::string &boundary,
           const std::string &displacement)
    {
      InterfaceParameters result = support(parameters, b, boundary, Law::slide);
      result.offset              = displacement;
      return result;
    }

    /// Springs between it and the ground.
    void
    add_foundation(Parameters        &parameters,
                   const unsigned int b,
                   const std::string &name)
    {
      const BoundaryParameters &boundary =
        parameters.bodies[b].boundaries[name];
      if (!boundary.normal_stiffness && !boundary.tangential_stiffness)
        return;
      InterfaceParameters springs = support(parameters, b, name, Law::spring);
      if (!boundary.normal_stiffness)
        parameters.fail(springs.boundary + "/Normal stiffness",
                        "nothing with a Tangential stiffness",
                        "an expression in x, y, z");
      if (boundary.displacement || boundary.normal_displacement)
        parameters.fail(
          springs.boundary + "/Displacement",
          "a Displacement with a Normal stiffness",
          "one of them: springs end at the ground, which does not move");
      springs.normal_stiffness = boundary.normal_stiffness;
      springs.tangential_stiffness =
        boundary.tangential_stiffness.value_or("0");
      parameters.interfaces.push_back(springs);
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
      if (boundary.rotation)
        parameters.fail("Body " + parameters.bodies[b].name + "/Boundary " +
                          name + "/Rotation",
                        "a rotation with Displacement axes and components "
                        "that are free",
                        "components along the axes of the scene, or none free");
      const dealii::Tensor<2, 3> axes =
        RigidMotion(boundary.displacement_axes, {}).rotation;
      for (unsigned int c = 0; c < 3; ++c)
        if (given[c] != "-")
          {
            InterfaceParameters  along = roller(parameters, b, name, given[c]);
            dealii::Tensor<1, 3> unit;
            unit[c]         = 1.;
            along.direction = axes * unit;
            parameters.interfaces.push_back(along);
          }
      boundary.displacement.reset();
    }
    /// Its reference point alone has prescribed displacements.
    void
    check_rigid_boundary(const Parameters  &parameters,
                         const unsigned int b,
                         const std::string &name)
    {
      const BoundaryParameters &given =
        parameters.bodies[b].boundaries.at(name);
      const std::string path =
        "Body " + parameters.bodies[b].name + "/Boundary " + name;
      const auto refuse = [&](const std::string &what, const std::string &got) {
        parameters.fail(path + what,
                        got + " with Coupling = rigid",
                        "a Displacement of the Reference point along the axes "
                        "of the scene: three of an expression in t or -");
      };
      if (given.normal_displacement)
        refuse("/Displacement", "a displacement along the normal");
      if (given.displacement && std::count(given.displacement->begin(),
                                           given.displacement->end(),
                                           "exact") > 0)
        refuse("/Displacement", in_quotes(joined(*given.displacement)));
      if (given.displacement_axes != std::array<double, 3>())
        refuse("/Displacement axes", "axes");
      if (given.normal_stiffness || given.tangential_stiffness)
        refuse("/Normal stiffness", "springs");
    }

    /// Interfaces and supports act on what deforms.
    void
    check_rigid_slaves(const Parameters &parameters)
    {
      for (const InterfaceParameters &interface : parameters.interfaces)
        {
          if (interface.slave.body >= parameters.bodies.size())
            continue; // which is told
          const BodyParameters &body = parameters.bodies[interface.slave.body];
          std::string           what;
          if (is_rigid(body.material))
            what = "body " + body.name + " with Law = rigid";
          for (const std::string &name : interface.slave.boundaries)
            if (const auto found = body.boundaries.find(name);
                found != body.boundaries.end() && found->second.is_rigid())
              what = "boundary " + name + " with Coupling = rigid";
          if (!what.empty())
            parameters.fail(interface.path() +
                              (interface.is_support ? "" : "/Slave"),
                            what,
                            interface.is_support ?
                              "Displacement along the axes of the scene there" :
                              "a side that deforms; what is rigid may be the "
                              "Master");
        }
    }
  } // namespace

  void
  add_supports(Parameters &parameters)
  {
    for (unsigned int b = 0; b < parameters.bodies.size(); ++b)
      for (auto &[name, boundary] : parameters.bodies[b].boundaries)
        {
          if (boundary.rotation && boundary.normal_displacement)
            parameters.fail("Body " + parameters.bodies[b].name + "/Boundary " +
                              name + "/Rotation",
                            "a rotation with Displacement = normal",
                            "one of them");
          if (boundary.is_rigid())
            {
              check_rigid_boundary(parameters, b, name);
              continue;
            }
          if (boundary.rotation && !boundary.displacement)
            boundary.displacement = Components{{"0", "0", "0"}};
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
              roller(parameters, b, name, *boundary.normal_displacement));
          add_foundation(parameters, b, name);
        }
    check_rigid_slaves(parameters);
  }
} // namespace mortise
