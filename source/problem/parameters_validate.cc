#include "parameters_validate.h"

#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/base/numbers.h>
#include <mortise/base/quotes.h>
#include <mortise/problem/formulation.h>
#include <mortise/problem/parameter_file.h>
#include <mortise/problem/parameters.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

namespace mortise
{
  namespace
  {
    void
    check_degree(const Parameters  &parameters,
                 const std::string &path,
                 const unsigned int degree)
    {
      if (degree < min_degree || degree > max_degree)
        fail(parameters,
             path,
             "degree " + std::to_string(degree),
             "a degree from " + std::to_string(min_degree) + " to " +
               std::to_string(max_degree));
    }

    void
    check_body(const Parameters &parameters, const BodyParameters &body)
    {
      const std::string section = "Body " + body.name;
      check_degree(parameters, section + "/Degree", body.degree);
      for (const auto &[region, degree] : body.degree_by_region)
        check_degree(parameters, section + "/Degree by region", degree);
      validate(body.mesh, parameters.where(section + "/Mesh"));
      make_material(body.material,
                    is_mixed(body),
                    [&](const std::string &name) {
                      return parameters.where(section + "/Material/" + name);
                    });
      check_fields(parameters, body);
    }

    std::string
    side_text(const Parameters &parameters, const SideParameters &side)
    {
      return in_quotes(parameters.bodies[side.body].name + ": " +
                       side.boundary);
    }

    bool
    same(const SideParameters &a, const SideParameters &b)
    {
      return a.body == b.body && a.boundary == b.boundary;
    }

    void
    check_interface(const Parameters          &parameters,
                    const InterfaceParameters &interface)
    {
      const std::string     section = "Interface " + interface.name;
      const SideParameters &slave = interface.slave, &master = interface.master;
      if (same(slave, master))
        fail(parameters,
             section + "/Master",
             side_text(parameters, master) + ", which is the slave",
             "another boundary than the slave's, of the same or another body");
      if (interface.law != "tie")
        fail(parameters, section + "/Law", in_quotes(interface.law), "tie");
      if (interface.multiplier != "standard")
        fail(parameters,
             section + "/Multiplier",
             in_quotes(interface.multiplier),
             "standard");
      if (!(interface.search_distance > 0.) ||
          !std::isfinite(interface.search_distance))
        fail(parameters,
             section + "/Search distance",
             interface.search_distance,
             "a positive number");
      if (interface.quadrature_points > 100)
        fail(parameters,
             section + "/Quadrature points",
             interface.quadrature_points,
             "auto, or an integer from 1 to 100");
      const auto &boundaries = parameters.bodies[slave.body].boundaries;
      const auto  slave_side = boundaries.find(slave.boundary);
      if (slave_side != boundaries.end() && slave_side->second.displacement)
        fail(
          parameters,
          section + "/Slave",
          side_text(parameters, slave) +
            ", which has a prescribed displacement",
          "a boundary without; exchange slave and master, or drop the displacement");
    }

    /// Files of results are named after bodies and interfaces.
    void
    check_names_of_interfaces(const Parameters &parameters)
    {
      for (const InterfaceParameters &interface : parameters.interfaces)
        for (const BodyParameters &body : parameters.bodies)
          if (interface.name == body.name)
            fail(parameters,
                 "Interfaces",
                 "\"" + interface.name + "\", which is also a body",
                 "names that no body has: both name files of results");
    }

    /// No two interfaces tie the same two boundaries.
    void
    check_pairs_of_interfaces(const Parameters &parameters)
    {
      for (const InterfaceParameters &a : parameters.interfaces)
        for (const InterfaceParameters &b : parameters.interfaces)
          if (&a < &b &&
              ((same(a.slave, b.slave) && same(a.master, b.master)) ||
               (same(a.slave, b.master) && same(a.master, b.slave))))
            fail(parameters,
                 "Interface " + b.name + "/Slave",
                 "the same two boundaries as those of interface " + a.name,
                 "each pair of boundaries once");
    }

    void
    check_output(const OutputParameters &output, const Parameters &parameters)
    {
      std::set<std::string> names;
      const auto            check_name = [&](const std::string &parameter,
                                  const std::string &name) {
        if (!names.insert(name).second)
          fail(parameters,
               "Output/" + parameter,
               "the name " + in_quotes(name) + " a second time",
               "names that differ among Points and Resultants");
      };
      for (const PointQuantity &point : output.points)
        check_name("Points", point.name);
      for (const ResultantQuantity &resultant : output.resultants)
        check_name("Resultants", resultant.name);
    }

    /// Why @p directory cannot be made or written; empty if it can. Creates nothing.
    std::string
    why_not_writable(const std::string &directory)
    {
      namespace fs = std::filesystem;
      std::error_code error;
      fs::path existing = fs::absolute(directory, error).lexically_normal();
      if (error)
        return error.message();
      while (!fs::exists(fs::symlink_status(existing, error)) &&
             error != std::errc::filename_too_long &&
             existing.has_relative_path())
        existing = existing.parent_path();
      if (error == std::errc::filename_too_long)
        return error.message();
      const std::string it = file_in_quotes(existing.string()) + " ";
      if (fs::is_symlink(existing, error) && !fs::exists(existing, error))
        return it + "is a link to nothing";
      if (!fs::is_directory(existing, error))
        return it + (error ? "cannot be looked at: " + error.message() :
                             "is not a directory");
      if (access(existing.c_str(), W_OK | X_OK) != 0)
        return it + "is not writable by this user";
      return {};
    }
  } // namespace

  void
  validate(const Parameters &parameters)
  {
    if (parameters.bodies.empty())
      fail(parameters, "Bodies", "no body", "at least one name");
    for (const BodyParameters &body : parameters.bodies)
      check_body(parameters, body);
    for (const InterfaceParameters &interface : parameters.interfaces)
      check_interface(parameters, interface);
    check_pairs_of_interfaces(parameters);
    check_names_of_interfaces(parameters);
    check_exact_solution(parameters);
    check_formulations(parameters);
    const double tolerance = parameters.solver.tolerance;
    if (!(tolerance > 0. && tolerance < 1.))
      fail(parameters,
           "Solver/Tolerance",
           tolerance,
           "a number between 0 and 1, both excluded");
    if (parameters.solver.max_iterations == 0)
      fail(parameters, "Solver/Max iterations", 0, "an integer of 1 or more");
    check_output(parameters.output, parameters);
  }

  void
  check_output_directory(const Parameters &parameters, const MPI_Comm comm)
  {
    std::string message;
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      message = why_not_writable(parameters.output.directory);
    if (!message.empty())
      message =
        parameters.where("Output/Directory") + ": got " +
        file_in_quotes(parameters.output.directory) +
        ", where nothing can be written: " + message +
        "; allowed: a directory that exists or can be made, and written";
    throw_if_any(message, comm);
  }

  void
  check_boundary_names(const Parameters                            &parameters,
                       const std::vector<std::vector<std::string>> &names)
  {
    const auto check = [&](const std::string &path,
                           const unsigned int body,
                           const std::string &name) {
      const auto &existing = names[body];
      if (std::find(existing.begin(), existing.end(), name) == existing.end())
        throw InputError(parameters.where(path) + ": body " +
                         in_quotes(parameters.bodies[body].name) +
                         " has no boundary " + in_quotes(name) +
                         did_you_mean(name, existing) +
                         "; its boundaries are: " + join_names(existing));
    };
    for (unsigned int b = 0; b < parameters.bodies.size(); ++b)
      for (const auto &[name, boundary] : parameters.bodies[b].boundaries)
        check("Body " + parameters.bodies[b].name + "/Boundary " + name,
              b,
              name);
    for (const InterfaceParameters &interface : parameters.interfaces)
      {
        check("Interface " + interface.name + "/Slave",
              interface.slave.body,
              interface.slave.boundary);
        check("Interface " + interface.name + "/Master",
              interface.master.body,
              interface.master.boundary);
      }
    for (const ResultantQuantity &resultant : parameters.output.resultants)
      check("Output/Resultants", resultant.body, resultant.boundary);
  }
} // namespace mortise
