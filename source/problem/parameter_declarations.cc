#include <mortise/problem/formulation.h>
#include <mortise/problem/parameters.h>

#include "declare.h"

namespace mortise
{
  namespace
  {
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
      declare.choice(
        "Formulation",
        formulation_names().front(),
        "Unknowns: the displacement, or (mixed) displacement and pressure, one degree lower, "
        "which neither locks nor ends where nu comes to 0.5. auto: mixed from nu = 0.49 on.",
        formulation_names());
      declare.text(
        "Body force",
        "auto",
        "Force on the volume [force per volume]. auto: what balances the exact solution "
        "if that is given by expressions, else zero.",
        "three expressions \"bx; by; bz\" in x, y, z; exact; or auto");
      declare_mesh({declared, {section, "Mesh"}});

      Declare material(declared, {section, "Material"});
      material.choice(
        "Law",
        body.material.law,
        "Material law; each takes its own of the constants below.",
        law_names());
      material.number(
        "Young modulus",
        body.material.young_modulus,
        "Young's modulus of Law = linear elastic [force per area].",
        "a positive number");
      material.number("Poisson ratio",
                      body.material.poisson_ratio,
                      "Poisson's ratio of Law = linear elastic [-].",
                      "a number above -1 and not above 0.5");
      const Orthotropic &orthotropic = body.material.orthotropic;
      material.numbers(
        "Young moduli",
        text_of(orthotropic.young_moduli),
        "E_x, E_y, E_z of Law = orthotropic, along the axes of the material "
        "[force per area].",
        "3 positive numbers",
        3);
      material.numbers(
        "Poisson ratios",
        text_of(orthotropic.poisson_ratios),
        "nu_xy, nu_yz, nu_zx of Law = orthotropic [-]; nu_ij is the contraction along j per "
        "extension along i under tension along i, nu_ij / E_i = nu_ji / E_j.",
        "3 numbers with which the stiffness is positive definite",
        3);
      material.numbers(
        "Shear moduli",
        text_of(orthotropic.shear_moduli),
        "G_xy, G_yz, G_zx of Law = orthotropic [force per area].",
        "3 positive numbers",
        3);
      material.numbers(
        "Axes",
        text_of(orthotropic.axes),
        "Rotates the axes of Law = orthotropic about those of the scene, x, then y, then z "
        "[degrees]. They do not follow the Rotate of the mesh.",
        "3 numbers",
        3);
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
      exact.text(
        "Pressure",
        "",
        "Exact mean pressure, minus a third of the trace of the stress [force per area], for "
        "expressions in a scene with nu = 0.5, where it does not follow from the displacement.",
        "an expression in x, y, z");

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
      declare.integer(
        "Multipliers on all ranks",
        solver.max_gathered,
        "Up to so many multipliers every rank helps to factorise what couples "
        "them; of more it knows its own and their neighbours.",
        0);
      declare.yes_no("Print iterations",
                     solver.print_iterations,
                     "A line for each.");

      Declare steps(declared, {"Steps"});
      steps.text("End time", "", "End of the last step [time]; it begins at 0. Empty: that of Step, or 1.", "a positive number");
      steps.text("Step", "", "Length of the steps, or the times at which they end [time]. Empty: one step.", "a positive number, or several, ascending, separated by commas");
      steps.integer("Output every", 1, "Fields are written after every so many of these times, and at the end.", 1);
      steps.number("Smallest step", 1e-3, "A nonlinear scene gives up when halved steps come below this share of the planned one [-].", "a positive number");
      Declare output(declared, {"Output"});
      output.integer("Checkpoint every", 0, "After so many steps the run is written to DIRECTORY/checkpoint.bin, from which --restart goes on. 0: never.", 0);
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
