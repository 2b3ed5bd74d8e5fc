#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/base/expression.h>
#include <mortise/base/quotes.h>
#include <mortise/problem/input/formulation.h>
#include <mortise/problem/input/interface_law.h>
#include <mortise/problem/input/parameter_file.h>
#include <mortise/problem/input/periodic_cell.h>
#include <mortise/problem/input/quantity.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "parameter_checks.h"

namespace mortise
{
  namespace
  {
    /// Is there a boundary on both sides?
    bool
    share(const SideParameters &a, const SideParameters &b)
    {
      return a.body == b.body &&
             std::find_first_of(a.boundaries.begin(),
                                a.boundaries.end(),
                                b.boundaries.begin(),
                                b.boundaries.end()) != a.boundaries.end();
    }

    /// A spring has both stiffnesses, other laws none.
    void
    check_stiffness(const Parameters                 &parameters,
                    const InterfaceParameters        &interface,
                    const std::string                &path,
                    const std::optional<std::string> &stiffness,
                    const bool                        may_be_zero)
    {
      if (!stiffness && interface.law == Law::spring)
        parameters.fail(path,
                        "nothing with Law = spring",
                        "an expression in x, y, z");
      if (stiffness && interface.law != Law::spring)
        parameters.fail(path,
                        in_quotes(*stiffness) +
                          " with Law = " + name_of(interface.law),
                        "nothing: only Law = spring has stiffnesses");
      if (!stiffness)
        return;
      const double time = parameters.steps.first_time();
      check_expression(parameters.where(path), *stiffness, time);
      const Expression expression(*stiffness, parameters.where(path), time);
      if (expression.depends_on_time())
        parameters.fail(path,
                        in_quotes(*stiffness) + ", which depends on time",
                        "an expression in x, y, z");
      if (!expression.is_constant())
        return;
      const double value = expression.value(dealii::Point<3>());
      if (value < 0. || (value == 0. && !may_be_zero))
        parameters.fail(path,
                        in_quotes(*stiffness),
                        may_be_zero ? "0 or a positive stiffness" :
                                      "a positive stiffness");
    }

    /// Of ties, a number at any time.
    void
    check_preload(const Parameters          &parameters,
                  const InterfaceParameters &interface,
                  const std::string         &section)
    {
      const std::string path = section + "/Preload";
      if (!interface.preload)
        {
          if (interface.preload_until)
            parameters.fail(path + " until",
                            "a time without a Preload",
                            "none");
          return;
        }
      if (interface.law != Law::tie)
        parameters.fail(path,
                        in_quotes(*interface.preload) +
                          " with Law = " + name_of(interface.law),
                        "nothing: only Law = tie has a preload");
      check_number(parameters, path, *interface.preload);
    }

    /// Friction belongs to contact, a given bound to Law = tresca.
    void
    check_friction(const Parameters          &parameters,
                   const InterfaceParameters &interface,
                   const std::string         &section)
    {
      const auto check = [&](const std::string                &name,
                             const std::optional<std::string> &given,
                             const Law                         law) {
        const std::string path = section + "/" + name;
        if (!given)
          return;
        if (interface.law != law)
          parameters.fail(path,
                          in_quotes(*given) +
                            " with Law = " + name_of(interface.law),
                          "nothing: it belongs to Law = " + name_of(law));
        const double time = parameters.steps.first_time();
        check_expression(parameters.where(path), *given, time);
        const Expression expression(*given, parameters.where(path), time);
        if (expression.is_constant() &&
            !(expression.value(dealii::Point<3>()) >= 0.))
          parameters.fail(path,
                          in_quotes(*given),
                          "a number that is not negative");
      };
      check("Friction coefficient",
            interface.friction_coefficient,
            Law::contact);
      check("Static friction coefficient",
            interface.static_friction_coefficient,
            Law::contact);
      check("Friction bound", interface.friction_bound, Law::tresca);
      if (interface.law == Law::tresca && !interface.friction_bound)
        parameters.fail(section + "/Friction bound",
                        "nothing with Law = tresca",
                        "an expression in x, y, z, t");
      if (interface.static_friction_coefficient &&
          !interface.friction_coefficient)
        parameters.fail(section + "/Static friction coefficient",
                        "a coefficient without a Friction coefficient",
                        "none");
      if (has_friction(interface) && parameters.adaptivity.target_error &&
          parameters.steps.given())
        parameters.fail("Steps",
                        "load steps with Adaptivity and friction",
                        "one of these two: slip is known on the mesh of a step "
                        "alone");
    }

    void
    check_interface(const Parameters          &parameters,
                    const InterfaceParameters &interface)
    {
      const std::string     section = interface.path();
      const SideParameters &slave = interface.slave, &master = interface.master;
      check_expression(parameters.where(section + (interface.is_support ?
                                                     "/Displacement" :
                                                     "/Offset")),
                       interface.offset,
                       parameters.steps.first_time());
      check_stiffness(parameters,
                      interface,
                      section + "/Normal stiffness",
                      interface.normal_stiffness,
                      false);
      check_stiffness(parameters,
                      interface,
                      section + "/Tangential stiffness",
                      interface.tangential_stiffness,
                      true);
      if (interface.is_support)
        return;
      check_preload(parameters, interface, section);
      check_friction(parameters, interface, section);
      if (share(slave, master))
        parameters.fail(
          section + "/Master",
          in_quotes(side_text(parameters, master)) +
            ", which is on the slave's side",
          "another boundary than the slave's, of the same or another body");
      const auto &boundaries = parameters.bodies[slave.body].boundaries;
      for (const std::string &boundary : slave.boundaries)
        if (const auto given = boundaries.find(boundary);
            given != boundaries.end() &&
            (given->second.displacement || given->second.normal_displacement))
          parameters.fail(
            section + "/Slave",
            in_quotes(parameters.bodies[slave.body].name + ": " + boundary) +
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
            parameters.fail(
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
          if (&a < &b && !a.is_support && !b.is_support &&
              ((share(a.slave, b.slave) && share(a.master, b.master)) ||
               (share(a.slave, b.master) && share(a.master, b.slave))))
            parameters.fail("Interface " + b.name + "/Slave",
                            "the same two boundaries as those of interface " +
                              a.name,
                            "each pair of boundaries once");
    }

    void
    check_output(const OutputParameters &output, const Parameters &parameters)
    {
      std::set<std::string> names;
      const auto            check_name = [&](const std::string &parameter,
                                  const std::string &name) {
        if (!names.insert(name).second)
          parameters.fail("Output/" + parameter,
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

    void
    check_steps(const Parameters &parameters)
    {
      constexpr double           most  = 1e6;
      const StepParameters      &given = parameters.steps;
      const std::vector<double> &step  = given.step;
      if (!std::is_sorted(step.begin(), step.end(), std::less_equal<double>()))
        parameters.fail("Steps/Step",
                        "times that do not ascend",
                        "a positive number, or ascending ones");
      if (step.size() > 1 && given.end_time && *given.end_time != step.back())
        parameters.fail(
          "Steps/End time",
          "another time than the last one of Step",
          "none, or that one; it may be left out beside a list of times");
      if (step.size() == 1 && given.end_time.value_or(1.) / step[0] > most)
        parameters.fail("Steps/Step",
                        "more than a million steps",
                        "a length of a millionth of End time or more");
      if (given.by_arc_length && step.size() > 1)
        parameters.fail("Steps/Step",
                        "several times with Control = arc length",
                        "one length, along the path");
      if (given.n_steps && !given.by_arc_length)
        parameters.fail("Steps/Number of steps",
                        std::to_string(*given.n_steps) + " with Control = load",
                        "nothing: it belongs to Control = arc length");
    }
  } // namespace

  void
  validate(const Parameters &parameters)
  {
    check_loads(parameters);
    for (const InterfaceParameters &interface : parameters.interfaces)
      check_interface(parameters, interface);
    check_pairs_of_interfaces(parameters);
    check_periodic_cell(parameters);
    check_names_of_interfaces(parameters);
    check_formulations(parameters);
    check_nonlinear_laws(parameters);
    check_steps(parameters);
    check_adaptivity(parameters);
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
  check_boundary_names(const Parameters        &parameters,
                       const NamesOfBoundaries &names)
  {
    std::vector<std::string> problems;
    const auto               check = [&](const std::string &path,
                           const unsigned int body,
                           const std::string &name) {
      if (!names[body])
        return;
      const auto &existing = *names[body];
      if (std::find(existing.begin(), existing.end(), name) == existing.end())
        problems.push_back(parameters.where(path) + ": body " +
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
        for (const std::string &boundary : interface.slave.boundaries)
          check("Interface " + interface.name + "/Slave",
                interface.slave.body,
                boundary);
        for (const std::string &boundary : interface.master.boundaries)
          check("Interface " + interface.name + "/Master",
                interface.master.body,
                boundary);
      }
    for (const ResultantQuantity &resultant : parameters.output.resultants)
      check("Output/Resultants", resultant.body, resultant.boundary);
    if (!problems.empty())
      throw InputError(join_lines(problems, 30));
  }
} // namespace mortise
