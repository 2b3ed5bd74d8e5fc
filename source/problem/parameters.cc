#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <mortise/base/error.h>
#include <mortise/base/quotes.h>
#include <mortise/problem/formulation.h>
#include <mortise/problem/parameter_reader.h>
#include <mortise/problem/parameters.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace mortise
{
  std::string
  joined(const Components &components)
  {
    return components[0] + "; " + components[1] + "; " + components[2];
  }

  std::string
  Parameters::where(const std::string &path) const
  {
    auto origin = origins.find(path);
    if (origin ==
        origins
          .end()) // a subsection that only --set opens: its first parameter
      {
        origin = origins.lower_bound(path + "/");
        if (origin != origins.end() &&
            origin->first.compare(0, path.size() + 1, path + "/") != 0)
          origin = origins.end();
      }
    return origin == origins.end() ? path : path + " (" + origin->second + ")";
  }

  bool
  Parameters::is_set(const std::string &path) const
  {
    return origins.count(path) > 0;
  }

  const std::vector<std::string> &
  field_names()
  {
    static const std::vector<std::string> names = {"displacement",
                                                   "stress",
                                                   "pressure",
                                                   "traction"};
    return names;
  }

  namespace
  {
    using Strings = std::vector<std::string>;

    MeshParameters
    read_mesh(const ParameterReader &reader)
    {
      MeshParameters mesh;
      mesh.source = reader.text("Source");
      mesh.cells  = reader.text("Cells");
      mesh.extent = reader.numbers("Extent");
      for (const double n : reader.numbers("Subdivisions"))
        mesh.subdivisions.push_back(static_cast<unsigned int>(n));
      mesh.refinements       = reader.integer("Refinements");
      mesh.refine_near       = reader.text("Refine near");
      mesh.file              = reader.text("File");
      mesh.part              = reader.text("Part");
      mesh.mesh_size         = reader.number("Mesh size");
      mesh.curved_boundaries = reader.text("Curved boundaries");
      mesh.rotate            = reader.array<3>("Rotate");
      mesh.translate         = reader.array<3>("Translate");
      mesh.bottom_slope      = reader.array<2>("Bottom slope");
      mesh.top_slope         = reader.array<2>("Top slope");
      mesh.distort           = reader.number("Distort");
      mesh.half              = reader.text("Half");
      mesh.surface           = reader.text("Surface");
      mesh.amplitude         = reader.number("Amplitude");
      mesh.middle            = reader.number("Middle");
      return mesh;
    }

    std::map<unsigned int, unsigned int>
    read_degrees(const ParameterReader &reader)
    {
      const std::string name = "Degree by region";
      const std::string allowed =
        "\"material id: degree; ...\", two integers of 0 or more each";
      std::map<unsigned int, unsigned int> degrees;
      for (const Strings &record : reader.records(name, 2, allowed))
        {
          for (const std::string &part : record)
            if (part.size() > 9 ||
                part.find_first_not_of("0123456789") != std::string::npos)
              reader.fail(name, record[0] + ": " + record[1], allowed);
          const unsigned int id = dealii::Utilities::string_to_int(record[0]);
          if (!degrees.emplace(id, dealii::Utilities::string_to_int(record[1]))
                 .second)
            reader.fail(name,
                        record[0] + ": " + record[1],
                        "each material id only once");
        }
      return degrees;
    }

    BoundaryParameters
    read_boundary(const ParameterReader &reader)
    {
      BoundaryParameters boundary;
      if (!reader.text("Pressure").empty())
        boundary.pressure = reader.text("Pressure");
      boundary.traction =
        reader.components("Traction",
                          "three expressions \"tx; ty; tz\", or exact");
      boundary.displacement = reader.components(
        "Displacement",
        "three of: an expression, -, or exact, as in \"-, -, 0\"; or exact");
      return boundary;
    }

    BodyParameters
    read_body(const ParameterSchema &schema,
              const Parameters      &parameters,
              const std::string     &name,
              const Strings         &boundaries)
    {
      const std::string     section = "Body " + name;
      const ParameterReader reader(schema, parameters, {section});
      const ParameterReader material(schema, parameters, {section, "Material"});
      BodyParameters        body;
      body.name             = name;
      body.degree           = reader.integer("Degree");
      body.degree_by_region = read_degrees(reader);
      body.formulation      = formulation_from_name(reader.text("Formulation"));
      if (reader.text("Body force") != "auto")
        body.body_force =
          reader.components("Body force",
                            "three expressions \"bx; by; bz\", exact, or auto");
      body.mesh =
        read_mesh(ParameterReader(schema, parameters, {section, "Mesh"}));
      body.mesh.directory =
        std::filesystem::path(parameters.file).parent_path().string();
      body.material.law           = material.text("Law");
      body.material.young_modulus = material.number("Young modulus");
      body.material.poisson_ratio = material.number("Poisson ratio");
      body.material.orthotropic   = {material.array<3>("Young moduli"),
                                     material.array<3>("Poisson ratios"),
                                     material.array<3>("Shear moduli"),
                                     material.array<3>("Axes")};
      for (const std::string &boundary : boundaries)
        body.boundaries[boundary] = read_boundary(ParameterReader(
          schema, parameters, {section, "Boundary " + boundary}));
      return body;
    }

    SideParameters
    read_side(const ParameterReader &reader, const std::string &name)
    {
      const std::string allowed = "\"body: boundary\"";
      const auto        sides   = reader.records(name, 2, allowed);
      if (sides.size() != 1)
        reader.fail(name, reader.text(name), allowed);
      return {reader.body_index(name, sides[0][0]), sides[0][1]};
    }

    InterfaceParameters
    read_interface(const ParameterReader &reader, const std::string &name)
    {
      InterfaceParameters interface;
      interface.name            = name;
      interface.slave           = read_side(reader, "Slave");
      interface.master          = read_side(reader, "Master");
      interface.law             = reader.text("Law");
      interface.multiplier      = reader.text("Multiplier");
      interface.search_distance = reader.number("Search distance");
      const std::string points  = reader.text("Quadrature points");
      if (points != "auto")
        {
          if (points.empty() || points.size() > 4 ||
              points.find_first_not_of("0123456789") != std::string::npos ||
              std::stoi(points) == 0)
            reader.fail("Quadrature points",
                        points,
                        "auto, or an integer of 1 or more");
          interface.quadrature_points = std::stoi(points);
        }
      return interface;
    }

    ExactSolutionParameters
    read_exact_solution(const ParameterReader &reader)
    {
      const std::string          text = reader.text("Displacement");
      std::optional<std::string> pressure;
      if (!reader.text("Pressure").empty())
        pressure = reader.text("Pressure");
      if (text.empty())
        return {};
      if (text == "thick sphere")
        return {ExactKind::thick_sphere, {}, pressure};
      if (text == "thick cylinder")
        return {ExactKind::thick_cylinder, {}, pressure};
      const std::string allowed =
        "three expressions \"ux; uy; uz\", thick sphere, or thick cylinder";
      if (text.find_first_of(";,") == std::string::npos || text == "exact")
        throw InputError(
          reader.where("Displacement") + ": got " + in_quotes(text) +
          did_you_mean(text, {"thick sphere", "thick cylinder"}) +
          "; allowed: " + allowed);
      return {ExactKind::expressions,
              *reader.components("Displacement", allowed),
              pressure};
    }

    OutputParameters
    read_output(const ParameterReader &reader, const std::string &file)
    {
      OutputParameters output;
      output.directory = reader.text("Directory");
      if (output.directory.empty())
        output.directory = (std::filesystem::path("results") /
                            std::filesystem::path(file).stem())
                             .string();
      for (const std::string &field :
           split_outside_parentheses(reader.text("Fields"), ','))
        {
          if (std::find(field_names().begin(), field_names().end(), field) ==
              field_names().end())
            throw InputError(
              reader.where("Fields") + ": got " + in_quotes(field) +
              did_you_mean(field, field_names()) + "; allowed: a list of " +
              join_names(field_names()));
          output.fields.push_back(field);
        }
      const std::string point = "\"name: body: x, y, z; ...\"";
      for (const Strings &record : reader.records("Points", 3, point))
        {
          const auto x = split_outside_parentheses(record[2], ',');
          if (x.size() != 3)
            reader.fail("Points", record[2], point);
          output.points.push_back({record[0],
                                   reader.body_index("Points", record[1]),
                                   {reader.number_of("Points", x[0]),
                                    reader.number_of("Points", x[1]),
                                    reader.number_of("Points", x[2])}});
        }
      for (const Strings &record :
           reader.records("Resultants", 3, "\"name: body: boundary; ...\""))
        output.resultants.push_back(
          {record[0], reader.body_index("Resultants", record[1]), record[2]});
      return output;
    }

    /// Names in "set Bodies = ..." or "set Interfaces = ...": the first pass
    /// over the file.
    Strings
    read_names(const std::vector<Assignment> &assignments,
               const std::string             &parameter)
    {
      Strings     names;
      std::string origin;
      for (const Assignment &a : assignments)
        if (a.sections.empty() && a.name == parameter)
          {
            names  = split_outside_parentheses(a.value, ',');
            origin = parameter + " (" + a.origin + "): ";
          }
      for (const std::string &name : names)
        {
          if (name.empty() || name.find_first_of(":;/") != std::string::npos)
            throw InputError(
              origin + "got the name " + in_quotes(name) +
              "; a name is not empty and contains none of : ; /");
          if (name.size() > 100)
            throw InputError(origin + "got the name " + in_quotes(name) +
                             "; a name has at most 100 characters");
          if (std::count(names.begin(), names.end(), name) > 1)
            throw InputError(origin + "the name " + in_quotes(name) +
                             " stands there twice; each name only once");
        }
      return names;
    }

    /// Bodies, their boundaries and interfaces that the file and --set name.
    SceneNames
    read_scene_names(const std::vector<Assignment> &assignments,
                     const std::string             &file)
    {
      SceneNames names;
      names.bodies = read_names(assignments, "Bodies");
      if (names.bodies.empty())
        throw InputError(
          "Bodies (" + file +
          "): got no name of a body; needed is at least one, as in \"set Bodies = "
          "block\", with a subsection \"Body block\"");
      names.interfaces         = read_names(assignments, "Interfaces");
      const std::string prefix = "Boundary ";
      for (const std::string &body : names.bodies)
        {
          Strings boundaries;
          for (const Assignment &a : assignments)
            if (a.sections.size() > 1 && a.sections[0] == "Body " + body &&
                a.sections[1].compare(0, prefix.size(), prefix) == 0)
              {
                const std::string name = a.sections[1].substr(prefix.size());
                if (std::find(boundaries.begin(), boundaries.end(), name) ==
                    boundaries.end())
                  boundaries.push_back(name);
              }
          names.boundaries.push_back(boundaries);
        }
      return names;
    }

    std::vector<double> step_times(const std::vector<double> &given, const std::vector<double> &end)
    { std::vector<double> t; 
      if (given.size() > 1) return given;
      const double e = end.empty() ? 1. : end[0];
      if (given.empty()) return {e};
      const unsigned int n = std::max(1., std::ceil(e / given[0] * (1. - 1e-9)));
      for (unsigned int i = 1; i < n; ++i) t.push_back(i * given[0]);
      t.push_back(e); return t; }

    Parameters
    parse(const std::vector<Assignment> &assignments, const std::string &file)
    {
      const SceneNames names = read_scene_names(assignments, file);
      ParameterSchema  schema(names);
      Parameters       parameters;
      parameters.file = file;
      for (const Assignment &assignment : assignments)
        {
          schema.assign(assignment);
          parameters.origins[assignment.path()] = assignment.origin;
        }

      parameters.title = schema.get({}, "Title");
      for (const std::string &body : names.bodies)
        parameters.bodies.emplace_back().name = body; // others may refer to it
      for (unsigned int b = 0; b < names.bodies.size(); ++b)
        parameters.bodies[b] =
          read_body(schema, parameters, names.bodies[b], names.boundaries[b]);
      for (const std::string &name : names.interfaces)
        parameters.interfaces.push_back(
          read_interface({schema, parameters, {"Interface " + name}}, name));
      parameters.exact_solution =
        read_exact_solution({schema, parameters, {"Exact solution"}});
      const ParameterReader solver(schema, parameters, {"Solver"});
      parameters.solver.method = solver_method_from_name(solver.text("Method"));
      parameters.solver.tolerance      = solver.number("Tolerance");
      parameters.solver.max_iterations = solver.integer("Max iterations");
      parameters.solver.max_gathered =
        solver.integer("Multipliers on all ranks");
      parameters.solver.print_iterations =
        solver.text("Print iterations") == "true";
      const ParameterReader steps(schema, parameters, {"Steps"});
      parameters.steps.output_every = steps.integer("Output every");
      parameters.steps.smallest_step = steps.number("Smallest step");
      const auto given = steps.numbers("Step"); const auto end = steps.numbers("End time");
      parameters.steps.given = !given.empty() || !end.empty();
      parameters.steps.times = step_times(given, end);
      parameters.output = read_output({schema, parameters, {"Output"}}, file);
      parameters.output.checkpoint_every = ParameterReader(schema, parameters, {"Output"}).integer("Checkpoint every");
      parameters.assignments = assignments;
      return parameters;
    }

    std::vector<Assignment>
    collect(const std::string &text,
            const std::string &file,
            const Settings    &settings)
    {
      std::vector<Assignment> assignments = scan_parameter_text(text, file);
      for (const std::string &setting : settings)
        assignments.push_back(scan_setting(setting));
      return assignments;
    }
  } // namespace

  Parameters
  parse_parameters(const std::vector<Assignment> &assignments,
                   const std::string             &file)
  {
    return parse(assignments, file);
  }

  Parameters
  parse_parameters(const std::string &text,
                   const std::string &file,
                   const Settings    &settings)
  {
    return parse(collect(text, file, settings), file);
  }

  Parameters
  read_parameters(const std::string &file,
                  const Settings    &settings,
                  const MPI_Comm     comm)
  {
    // Rank 0 reads the files; all parse the same lines, so that all see the
    // same error.
    std::string          message;
    std::vector<Strings> lines;
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      try
        {
          for (const Assignment &a :
               collect(read_text_file(file), file, settings))
            {
              lines.push_back({a.name, a.value, a.origin});
              lines.back().insert(lines.back().end(),
                                  a.sections.begin(),
                                  a.sections.end());
            }
        }
      catch (const InputError &e)
        {
          message = e.what();
        }
    throw_if_any(message, comm);
    std::vector<Assignment> assignments;
    for (const Strings &line : dealii::Utilities::MPI::broadcast(comm, lines))
      assignments.push_back(
        {Strings(line.begin() + 3, line.end()), line[0], line[1], line[2]});
    return parse(assignments, file);
  }
} // namespace mortise
