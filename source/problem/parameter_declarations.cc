#include <mortise/base/error.h>
#include <mortise/problem/parameter_schema.h>
#include <mortise/problem/parameters.h>

#include <sstream>

namespace mortise
{
  namespace
  {
    namespace Patterns = dealii::Patterns;
    std::string
    text_of(const double value)
    {
      std::ostringstream stream;
      stream << value;
      return stream.str();
    }

    template <std::size_t n>
    std::string
    text_of(const std::array<double, n> &v)
    {
      std::string text = text_of(v[0]);
      for (std::size_t i = 1; i < n; ++i)
        text += ", " + text_of(v[i]);
      return text;
    }

    /// Collects the declarations of one subsection.
    class Declare
    {
    public:
      Declare(std::vector<ParameterDeclaration> &declared,
              const std::vector<std::string>    &sections)
        : declared(declared)
        , sections(sections)
      {}

      void
      text(const std::string &name,
           const std::string &value,
           const std::string &meaning,
           const std::string &allowed)
      {
        add(name, value, meaning, allowed, Patterns::Anything());
      }

      void
      number(const std::string &name,
             const double       value,
             const std::string &meaning,
             const std::string &allowed)
      {
        add(name, text_of(value), meaning, allowed, Patterns::Double());
      }

      void
      numbers(const std::string &name,
              const std::string &value,
              const std::string &meaning,
              const std::string &allowed,
              const unsigned int at_most)
      {
        add(name,
            value,
            meaning,
            allowed,
            Patterns::List(Patterns::Double(), 0, at_most));
      }

      void
      integer(const std::string &name,
              const unsigned int value,
              const std::string &meaning,
              const int          least,
              const int          most = Patterns::Integer::max_int_value)
      {
        add(name,
            std::to_string(value),
            meaning,
            most == Patterns::Integer::max_int_value ?
              "an integer of " + std::to_string(least) + " or more" :
              "an integer from " + std::to_string(least) + " to " +
                std::to_string(most),
            Patterns::Integer(least, most));
      }

      void
      yes_no(const std::string &name,
             const bool         value,
             const std::string &meaning)
      {
        add(name,
            value ? "true" : "false",
            meaning,
            "true or false",
            Patterns::Bool());
      }

      void
      choice(const std::string              &name,
             const std::string              &value,
             const std::string              &meaning,
             const std::vector<std::string> &choices)
      {
        std::string alternatives;
        for (const std::string &choice : choices)
          alternatives += (alternatives.empty() ? "" : "|") + choice;
        add(name,
            value,
            meaning,
            choices.size() == 1 ? choices[0] : "one of: " + join_names(choices),
            Patterns::Selection(alternatives));
        declared.back().choices = choices;
      }

      void
      add(const std::string           &name,
          const std::string           &value,
          const std::string           &meaning,
          const std::string           &allowed,
          const Patterns::PatternBase &pattern)
      {
        declared.push_back(
          {sections, name, value, meaning, allowed, {}, pattern.clone()});
      }

    private:
      std::vector<ParameterDeclaration> &declared;
      const std::vector<std::string>     sections;
    };

    void
    declare_mesh_source(Declare declare)
    {
      const MeshParameters mesh;
      declare.choice("Source",
                     mesh.source,
                     "Where the mesh comes from.",
                     mesh_source_names());
      declare.choice("Cells",
                     mesh.cells,
                     "Shape of the cells.",
                     {"hexahedra", "tetrahedra"});
      declare.numbers(
        "Extent",
        "",
        "Size of a generated body [length]. box and curved block: x0, y0, z0, x1, y1, "
        "z1 (of the whole block); shell octant: r_in, r_out; cylinder sector: r_in, "
        "r_out, length.",
        "2, 3 or 6 numbers, as the generator needs",
        6);
      declare.add(
        "Subdivisions",
        "",
        "Cells of a generated body. box: nx, ny, nz; shell octant: n, m (three patches of "
        "n x n, m radial); cylinder sector: around, radial, axial; curved block: nx, ny, "
        "nz, or nx, ny, nz_lower, nz_upper for both halves.",
        "2 to 4 integers of 1 or more, as the generator needs",
        Patterns::List(Patterns::Integer(1), 0, 4));
      declare.integer(
        "Refinements",
        mesh.refinements,
        "How often all cells are cut into eight, after Subdivisions or File.",
        0);
      declare.text(
        "Refine near",
        mesh.refine_near,
        "Local refinement after that: cells that reach into a ball are cut the given "
        "number of times [lengths, in moved coordinates].",
        "\"x, y, z, radius, times; ...\"");
      declare.text("File",
                   mesh.file,
                   "Mesh for the source file; from gmsh, say.",
                   "name of a file");
      declare.numbers(
        "Rotate",
        text_of(mesh.rotate),
        "Rotates the body about the axes x, then y, then z [degrees].",
        "3 numbers",
        3);
      declare.numbers("Translate",
                      text_of(mesh.translate),
                      "Moves the body, after Rotate [length].",
                      "3 numbers",
                      3);
    }

    void
    declare_mesh_shape(Declare declare)
    {
      const MeshParameters mesh;
      declare.numbers(
        "Bottom slope",
        text_of(mesh.bottom_slope),
        "box: the face zmin lies in z = z0 + sx (x - x0) + sy (y - y0) [-].",
        "2 numbers: sx, sy",
        2);
      declare.numbers(
        "Top slope",
        text_of(mesh.top_slope),
        "box: the face zmax lies in z = z1 + sx (x - x0) + sy (y - y0) [-].",
        "2 numbers: sx, sy",
        2);
      declare.number(
        "Distort",
        mesh.distort,
        "box: largest shift of a vertex as a fraction of its cell's edges, the same on "
        "every run [-].",
        "a number from 0 to 0.3");
      declare.choice("Half",
                     mesh.half,
                     "curved block: which side of the curved surface.",
                     {"lower", "upper", "both"});
      declare.choice(
        "Surface",
        mesh.surface,
        "curved block: the surface in which the halves meet, z = z_middle + Amplitude "
        "f(s, t) with s, t in [-1, 1] across the block. bump: cos(pi s/2) cos(pi t/2); "
        "saddle: (s^2 - t^2 + s/2) / 1.5; wave: sin(pi s/2 + 1/2) cos(pi t/2).",
        {"bump", "saddle", "wave"});
      declare.number(
        "Amplitude",
        mesh.amplitude,
        "curved block: height of that surface [length].",
        "a number smaller in magnitude than the height of each half");
      declare.number(
        "Middle",
        mesh.middle,
        "curved block: z_middle as a fraction of the block's height [-].",
        "a number between 0 and 1");
    }

    void
    declare_boundary(Declare declare)
    {
      declare.text(
        "Pressure",
        "",
        "Pressure, acting against the outward normal [force per area]. Empty: none.",
        "an expression in x, y, z; or exact");
      declare.text(
        "Traction",
        "",
        "Force on the surface, added to Pressure [force per area]. Empty: none.",
        "three expressions \"tx; ty; tz\"; or exact");
      declare.text(
        "Displacement",
        "",
        "Prescribed displacement [length]; - leaves a component free. Empty: all free.",
        "three of: an expression, -, or exact, as in \"-, -, 0\"; or exact for all three");
    }

    void
    declare_body(std::vector<ParameterDeclaration> &declared,
                 const std::string                 &section,
                 const std::vector<std::string>    &boundaries)
    {
      const BodyParameters body;
      Declare              declare(declared, {section});
      declare.integer("Degree",
                      body.degree,
                      "Polynomial degree of the displacement.",
                      min_degree,
                      max_degree);
      declare.text(
        "Degree by region",
        "",
        "Other degrees for cells with the given material ids of the mesh.",
        "\"material id: degree; ...\"");
      declare.text(
        "Body force",
        "auto",
        "Force on the volume [force per volume]. auto: what balances the exact solution "
        "if that is given by expressions, else zero.",
        "three expressions \"bx; by; bz\" in x, y, z; exact; or auto");
      declare_mesh_source({declared, {section, "Mesh"}});
      declare_mesh_shape({declared, {section, "Mesh"}});

      Declare material(declared, {section, "Material"});
      material.choice("Law",
                      body.material.law,
                      "Material law.",
                      {"linear elastic"});
      material.number("Young modulus",
                      body.material.young_modulus,
                      "Young's modulus [force per area].",
                      "a positive number");
      material.number("Poisson ratio",
                      body.material.poisson_ratio,
                      "Poisson's ratio [-].",
                      "a number between -1 and 0.5, both excluded");
      for (const std::string &boundary : boundaries)
        declare_boundary({declared, {section, "Boundary " + boundary}});
    }

    void
    declare_interface(Declare declare)
    {
      const InterfaceParameters interface;
      declare.text("Slave",
                   "",
                   "Side of the multiplier: the finer mesh or the softer body.",
                   "\"body: boundary\"");
      declare.text("Master", "", "The other side.", "\"body: boundary\"");
      declare.choice("Law", interface.law, "What the interface does.", {"tie"});
      declare.choice("Multiplier",
                     interface.multiplier,
                     "Space of the Lagrange multiplier (the traction).",
                     {"standard"});
      declare.number(
        "Search distance",
        interface.search_distance,
        "Largest gap or penetration that is bridged, as a fraction of the size of the "
        "larger face [-].",
        "a positive number");
      declare.text("Quadrature points",
                   "auto",
                   "Points per direction on a cell. auto: as many as needed.",
                   "auto, or an integer of 1 or more");
    }

    void
    declare_rest(std::vector<ParameterDeclaration> &declared)
    {
      Declare exact(declared, {"Exact solution"});
      exact.text(
        "Displacement",
        "",
        "Exact displacement [length]: relative errors are computed when it is given.",
        "three expressions \"ux; uy; uz\" in x, y, z; thick sphere; or thick cylinder "
        "(which take pressure, radii and materials from the scene)");

      const SolverParameters solver;
      Declare                declare(declared, {"Solver"});
      declare.choice("Method",
                     "auto",
                     "Solver. auto: by size.",
                     solver_method_names());
      declare.number(
        "Tolerance",
        solver.tolerance,
        "Residual relative to the right hand side at which the solver stops [-].",
        "a number between 0 and 1, both excluded");
      declare.integer("Max iterations",
                      solver.max_iterations,
                      "After so many iterations the run ends with exit code 3.",
                      1);
      declare.yes_no("Print iterations",
                     solver.print_iterations,
                     "A line for each.");

      Declare output(declared, {"Output"});
      output.text(
        "Directory",
        "",
        "Where summary.json and the files of fields go; made when the first is written. "
        "Empty: results/NAME for a parameter file NAME.prm.",
        "name of a directory");
      output.text(
        "Fields",
        "",
        "Fields to write for ParaView (.vtu), a file for each body and, with traction (and "
        "gap), for each interface. Empty: no files of fields.",
        "a list of: " + join_names(field_names()));
      output.text(
        "Points",
        "",
        "Displacements to report in the summary, at points of bodies [length].",
        "\"name: body: x, y, z; ...\"");
      output.text("Resultants",
                  "",
                  "Forces to report in the summary, on boundaries of bodies.",
                  "\"name: body: boundary; ...\"");
    }
  } // namespace

  std::vector<ParameterDeclaration>
  declare_parameters(const SceneNames &names)
  {
    std::vector<ParameterDeclaration> declared;
    Declare                           declare(declared, {});
    declare.text("Title", "", "Title of the scene, for people.", "any text");
    declare.text("Bodies",
                 "",
                 "Names of the bodies; each has a subsection \"Body NAME\".",
                 "names separated by commas");
    declare.text("Interfaces",
                 "",
                 "Names of interfaces; each has an \"Interface NAME\".",
                 "names separated by commas");
    for (unsigned int b = 0; b < names.bodies.size(); ++b)
      declare_body(declared, "Body " + names.bodies[b], names.boundaries[b]);
    for (const std::string &name : names.interfaces)
      declare_interface({declared, {"Interface " + name}});
    declare_rest(declared);
    return declared;
  }
} // namespace mortise
