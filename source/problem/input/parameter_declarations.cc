#include <mortise/base/error.h>
#include <mortise/base/numbers.h>
#include <mortise/base/quotes.h>
#include <mortise/problem/input/parameter_schema.h>

#include <algorithm>
#include <filesystem>
#include <set>

namespace mortise
{
  namespace
  {
    /// Names of @p items, bodies or interfaces.
    template <typename Items>
    std::vector<std::string>
    names_of(const Items &items)
    {
      std::vector<std::string> names;
      for (const auto &item : items)
        names.push_back(item.name);
      return names;
    }

    /// Index of the body called @p name, as @p value says.
    unsigned int
    body_index(const Parameters     &parameters,
               const ParameterValue &value,
               const std::string    &name)
    {
      const auto names    = names_of(parameters.bodies);
      const auto position = std::find(names.begin(), names.end(), name);
      if (position == names.end())
        throw InputError(value.where + ": there is no body " + in_quotes(name) +
                         did_you_mean(name, names) +
                         "; bodies are: " + join_names(names));
      return position - names.begin();
    }

    void
    declare_side(const ParameterSection &section,
                 const std::string      &name,
                 SideParameters         &side,
                 const Meaning          &meaning,
                 const Parameters       &parameters)
    {
      section.add(name,
                  "",
                  meaning,
                  {"\"body: boundary\", or \"body: boundary, boundary, ...\""},
                  [&](const ParameterValue &value) {
                    const auto sides = value.records(2);
                    if (sides.size() != 1)
                      value.fail(in_quotes(value.text));
                    side.body = body_index(parameters, value, sides[0][0]);
                    side.boundaries =
                      split_outside_parentheses(sides[0][1], ',');
                    std::set<std::string> different;
                    for (const std::string &boundary : side.boundaries)
                      if (boundary.empty() ||
                          !different.insert(boundary).second)
                        value.fail(in_quotes(value.text), "each boundary once");
                  });
    }

    void
    declare_interface(const ParameterSection &section,
                      InterfaceParameters    &interface,
                      const Parameters       &parameters)
    {
      const Allowed few = Allowed::integer(1, 100);
      declare_side(
        section,
        "Slave",
        interface.slave,
        "The side that carries the multiplier; best the finer mesh or the softer body.",
        parameters);
      declare_side(
        section, "Master", interface.master, "The other side.", parameters);
      section.add(
        "Law",
        interface.law,
        "Law of the interface. tie: no jump of the displacement. slide: no jump along the normal, free tangential "
        "motion; smooth patches of the slave between edges are interfaces of their own. contact: gap >= 0 and "
        "pressure >= 0, with friction if a coefficient is given; partners are those within Search distance at the start, "
        "or as Sliding says. tresca: the same with a given bound of the tangential traction. spring: a thin layer "
        "or glue with the stiffnesses below.",
        Allowed::one_of(interface_law_names()));
      section.add(
        "Friction coefficient",
        interface.friction_coefficient,
        {"Law = contact: Coulomb's coefficient [], the tangential traction divided by the pressure where bodies slip. "
         "Empty: no friction.",
         "-"},
        {"an expression in x, y, z, t, not negative"});
      section.add(
        "Static friction coefficient",
        interface.static_friction_coefficient,
        {"The coefficient [] where bodies did not slip at the end of the last step; once they slip it is the Friction "
         "coefficient. Empty: the same.",
         "-"},
        {"an expression in x, y, z, t, at least the Friction coefficient"});
      section.add(
        "Friction bound",
        interface.friction_bound,
        {"Law = tresca: the tangential traction at which bodies slip [].",
         "force per area"},
        {"an expression in x, y, z, t, not negative"});
      section.add(
        "Normal stiffness",
        interface.normal_stiffness,
        {"Law = spring: normal traction divided by opening []. For a layer of thickness d it is the "
         "modulus divided by d.",
         "force per volume"},
        {"an expression in x, y, z, positive"});
      section.add(
        "Tangential stiffness",
        interface.tangential_stiffness,
        {"The same in tangential directions []; 0: free tangential motion.",
         "force per volume"},
        {"an expression in x, y, z, positive; or 0"});
      section.add(
        "Offset",
        interface.offset,
        {"Gap between the bodies in addition to that between their meshes, which only contact takes into account; "
         "negative: an interference, as of a press fit whose meshes coincide [].",
         "length"},
        {"an expression in x, y, z, t"},
        "expression");
      section.add(
        "Preload",
        interface.preload,
        {"Law = tie: the normal force that the interface carries [], positive in tension, as in a cut through the "
         "shank of a tightened bolt, negative in compression, as under the head of that bolt. The shortening, by which "
         "the sides approach each other in addition to Offset, is an unknown. Empty: none.",
         "force"},
        {"an expression in t"});
      section.add(
        "Preload until",
        interface.preload_until,
        {"Time from which on the shortening is kept and the force follows []. Empty: the force is given at all "
         "times.",
         "time"},
        {"a number"});
      section.add(
        "Mesh gap",
        interface.ignores_mesh_gap,
        "Law = contact: meaning of gaps and overlaps of the meshes. real: a gap or an interference; ignored: the "
        "surfaces coincide, as facets of different size on one circle do. Offset is added.",
        Allowed::one_of({"real", "ignored"}));
      section.add(
        "Sliding",
        interface.sliding,
        "Which pairs of faces and normals Law = contact, tresca and slide have. small: those of "
        "the undeformed bodies; finite: those of the deformed bodies, found again in each iteration of Newton's "
        "method, so that bodies may slide and turn far. Search distance then holds for the motion of a step, and "
        "slide closes the gaps of the meshes. "
        "auto: finite where a body has a law of finite strain.",
        Allowed::one_of({"auto", "small", "finite"}));
      section.add(
        "Multiplier",
        interface.multiplier,
        "Space of the Lagrange multiplier (the traction): standard, the traces of the slave's displacements, or dual, "
        "functions biorthogonal to those of the slave's nodes, which are eliminated at no cost. Triangles have dual "
        "ones at degree 1 only, else standard ones.",
        Allowed::one_of({"standard", "dual"}));
      section.add(
        "Periodic",
        interface.periodic,
        "Law = tie: the master is moved to the slave before they are paired, as opposite faces of a cell that repeats "
        "itself are. translation: by Translation, and the displacement of the slave is that of the master and the Mean "
        "strain of the Periodic cell times Translation. rotation: by Rotation about Reference point, and the "
        "displacement of the slave is that of the master turned by it (cyclic symmetry).",
        Allowed::one_of({"none", "translation", "rotation"}));
      section.add(
        "Translation",
        interface.translation,
        {"Periodic = translation: the vector from the master to the slave [].",
         "length"},
        {"3 numbers"});
      section.add(
        "Rotation",
        interface.rotation,
        {"Periodic = rotation: the rotation from the master to the slave, a vector along the axis [].",
         "degrees"},
        {"3 numbers"});
      section.add(
        "Reference point",
        interface.reference_point,
        {"Periodic = rotation: a point of the axis []. Empty: the origin.",
         "length"},
        {"3 numbers"});
      section.add(
        "Search distance",
        "0.5",
        {"Largest distance of the two faces of a pair, as a fraction of the size of the larger face [], or a length. "
         "Partners face the slave and are not hidden by a body. With Adaptivity the distance for contact is at least "
         "the relative motion of the sides in the last cycle.",
         "-"},
        {"a positive number, or \"length NUMBER\""},
        [&interface](const ParameterValue &value) {
          const std::string word      = "length ";
          SearchDistance   &distance  = interface.search_distance;
          const bool        is_length = value.text.rfind(word, 0) == 0;
          const double      number    = value.number(
            is_length ? value.text.substr(word.size()) : value.text);
          if (!(number > 0.))
            value.fail(in_quotes(value.text));
          distance                                         = SearchDistance();
          (is_length ? distance.length : distance.by_size) = number;
        });
      section.add(
        "Quadrature points",
        "auto",
        "Quadrature points per direction on an integration cell. auto: by the degrees and the geometry.",
        {"auto, or " + few.words, few.contains},
        [&interface](const ParameterValue &value) {
          interface.quadrature_points = 0;
          if (value.text != "auto")
            value.read(interface.quadrature_points);
        });
    }

    void
    set_exact_displacement(ExactSolutionParameters &exact,
                           const ParameterValue    &value)
    {
      const std::string &text = value.text;
      exact.kind              = ExactKind::none;
      if (text == "thick sphere")
        exact.kind = ExactKind::thick_sphere;
      else if (text == "thick cylinder")
        exact.kind = ExactKind::thick_cylinder;
      else if (!text.empty())
        {
          if (text.find_first_of(";,") == std::string::npos)
            value.fail(in_quotes(text) +
                       did_you_mean(text, {"thick sphere", "thick cylinder"}));
          exact.kind = ExactKind::expressions;
          value.read(exact.displacement);
        }
    }

    void
    declare_exact_solution(const ParameterSection  &section,
                           ExactSolutionParameters &exact)
    {
      section.add(
        "Displacement",
        "",
        {"Exact displacement []: relative errors are computed when it is given.",
         "length"},
        {"three expressions \"ux; uy; uz\" in x, y, z, t; thick sphere; or thick cylinder "
         "(which take pressure, radii and materials from the scene)"},
        [&exact](const ParameterValue &value) {
          set_exact_displacement(exact, value);
        },
        "list of expressions");
      section.add(
        "Pressure",
        exact.pressure,
        {"Exact mean pressure, minus a third of the trace of the stress [], for "
         "expressions in a scene with nu = 0.5, where it does not follow from the displacement.",
         "force per area"},
        {"an expression in x, y, z, t"});
    }

    std::vector<PointQuantity>
    points_of(const ParameterValue &value, const Parameters &parameters)
    {
      std::vector<PointQuantity> points;
      for (const auto &record : value.records(3))
        {
          const auto x = split_outside_parentheses(record[2], ',');
          if (x.size() != 3)
            value.fail(in_quotes(record[2]));
          points.push_back(
            {record[0],
             body_index(parameters, value, record[1]),
             {value.number(x[0]), value.number(x[1]), value.number(x[2])}});
        }
      return points;
    }

    void
    declare_periodic_cell(const ParameterSection &section,
                          Parameters             &parameters)
    {
      const auto add = [&](const std::string          &name,
                           std::array<std::string, 6> &member,
                           const Meaning              &meaning,
                           const std::string          &allowed) {
        section.add(
          name,
          "0; 0; 0; 0; 0; 0",
          meaning,
          {allowed},
          [&member](const ParameterValue &value) {
            const auto parts = split_outside_parentheses(value.text, ';');
            if (parts.size() != member.size())
              value.fail(in_quotes(value.text),
                         value.allowed.words + " (these are " +
                           std::to_string(parts.size()) +
                           " components, not 6)");
            std::copy(parts.begin(), parts.end(), member.begin());
          },
          "list of expressions");
      };
      add(
        "Mean strain",
        parameters.mean_strain,
        {"Components xx; yy; zz; yz; zx; xy of the mean strain of the cell that interfaces with Periodic = translation "
         "repeat []; shears are those of the tensor, half of the angle. free: an unknown, to which Mean stress belongs. "
         "With finite strains it is the mean gradient of the displacement.",
         "-"},
        "six expressions in t, or free, with ';' between them");
      add(
        "Mean stress",
        parameters.mean_stress,
        {"Components of the mean stress where Mean strain is free [], per volume of the cell between three translations, "
         "or, with fewer, of the bodies.",
         "force per area"},
        "six expressions in t with ';' between them");
    }

    void
    declare_output(const ParameterSection &section, Parameters &parameters)
    {
      namespace fs             = std::filesystem;
      OutputParameters &output = parameters.output;
      section.add(
        "Directory",
        "",
        "Directory of summary.json and the files of fields, made when the first is written. Empty: results/NAME for a "
        "parameter file NAME.prm.",
        {"name of a directory"},
        [&](const ParameterValue &value) {
          output.directory =
            value.text.empty() ?
              (fs::path("results") / fs::path(parameters.file).stem())
                .string() :
              value.text;
        });
      section.add(
        "Fields",
        "",
        "Fields to write for ParaView (.vtu), a file for each body and, with traction (and "
        "gap), for each interface; degree, and with Adaptivity estimate (energy norm of the error beside that of the "
        "solution, or its part in the Quantity), are numbers for each cell. Empty: no files of fields.",
        {"a list of: " + join_names(field_names()), {}, field_names()},
        [&](const ParameterValue &value) {
          output.fields = split_outside_parentheses(value.text, ',');
          for (const std::string &field : output.fields)
            value.choice(field);
        },
        "list of selections");
      section.add(
        "Checkpoint every",
        output.checkpoint_every,
        "Number of steps, or cycles of Adaptivity, after which the state is written to DIRECTORY/checkpoint.bin, from "
        "which --restart DIRECTORY continues. 0: none.",
        Allowed::integer(0));
      section.add(
        "Points",
        "",
        {"Displacements to report in the summary, at points of bodies [].",
         "length"},
        {"\"name: body: x, y, z; ...\""},
        [&](const ParameterValue &value) {
          output.points = points_of(value, parameters);
        });
      section.add(
        "Resultants",
        "",
        "Forces and moments on boundaries of bodies to report in the summary: loads, reactions of supports, forces of "
        "interfaces.",
        {"\"name: body: boundary; ...\""},
        [&](const ParameterValue &value) {
          output.resultants.clear();
          for (const auto &record : value.records(3))
            output.resultants.push_back(
              {record[0], body_index(parameters, value, record[1]), record[2]});
        });
      section.add(
        "Moments about",
        output.moments_about,
        {"Reference point of the moments of Resultants and interfaces [].",
         "length"},
        {"3 numbers"});
    }
  } // namespace

  std::vector<ParameterEntry>
  declare_parameters(Parameters &parameters)
  {
    std::vector<ParameterEntry> entries;
    const ParameterSection      scene(entries);
    // names come first: they make the subsections
    const auto known = [](const ParameterValue &) {};
    scene.add("Title", parameters.title, "Title of the scene.", {"any text"});
    scene.add("Bodies",
              join_names(names_of(parameters.bodies)),
              "Names of the bodies; each has a subsection \"Body NAME\".",
              {"names separated by commas"},
              known,
              "list of names");
    scene.add("Interfaces",
              join_names(names_of(parameters.interfaces)),
              "Names of interfaces; each has an \"Interface NAME\".",
              {"names separated by commas"},
              known,
              "list of names");
    scene.add(
      "Gravity",
      parameters.gravity,
      {"Acceleration of all bodies with a Density [], added to Body force. Empty: none.",
       "length per time squared"},
      {"three expressions \"gx; gy; gz\" in x, y, z, t"});
    for (BodyParameters &body : parameters.bodies)
      declare_body(scene.subsection("Body " + body.name), body);
    for (InterfaceParameters &interface : parameters.interfaces)
      declare_interface(scene.subsection("Interface " + interface.name),
                        interface,
                        parameters);
    declare_periodic_cell(scene.subsection("Periodic cell"), parameters);
    declare_exact_solution(scene.subsection("Exact solution"),
                           parameters.exact_solution);
    declare_solver(scene.subsection("Solver"), parameters.solver);
    declare_adaptivity(scene.subsection("Adaptivity"), parameters.adaptivity);
    declare_steps(scene.subsection("Steps"), parameters.steps);
    declare_output(scene.subsection("Output"), parameters);
    return entries;
  }
} // namespace mortise
