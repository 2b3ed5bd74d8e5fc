#include <mortise/problem/input/parameter_schema.h>

namespace mortise
{
  void
  declare_solver(const ParameterSection &section, SolverParameters &solver)
  {
    section.add("Method",
                solver.method,
                "Solver. auto: by size.",
                Allowed::one_of(solver_method_names()));
    section.add(
      "Tolerance",
      solver.tolerance,
      "Residual relative to the right hand side at which the solver stops [-].",
      {"a number between 0 and 1, both excluded",
       [](double tolerance) { return tolerance > 0. && tolerance < 1.; }});
    section.add("Max iterations",
                solver.max_iterations,
                "After so many iterations the run ends with exit code 3.",
                Allowed::integer(1));
    section.add(
      "Multipliers on all ranks",
      solver.max_gathered,
      "Up to so many multipliers every rank helps to factorise what couples "
      "them; of more it knows its own and their neighbours.",
      Allowed::integer(0));
    section.add("Print iterations",
                solver.print_iterations,
                "A line for each.",
                {"true or false", {}, {"false", "true"}});
  }

  void
  declare_adaptivity(const ParameterSection &section,
                     AdaptivityParameters   &adaptivity)
  {
    section.add(
      "Target error",
      adaptivity.target_error,
      "Error of the displacements in the energy norm beside their own, or of Quantity beside its value, as it is estimated, at "
      "which the run ends [-]. Empty: degrees are those that are given.",
      {"a number between 0 and 1, both excluded",
       [](double error) { return error > 0. && error < 1.; }});
    section.add(
      "Quantity",
      adaptivity.quantity,
      "The number that Target error is of: a component of an entry of Output/Points or Output/Resultants. Meshes become fine and "
      "degrees high where errors have a part in it. Empty: the displacements, in the energy norm.",
      {"\"NAME, x\", \"NAME, y\" or \"NAME, z\""});
    section.add(
      "Strategy",
      adaptivity.strategy,
      "From cycle to cycle, from the mesh and the degrees that are given, where the error is: p: the degree rises by one; "
      "h: cells are cut into eight; hp: what makes the error smaller there, by how Legendre coefficients fall. "
      "Tetrahedra rise; with h and hp gmsh meshes those of a geometry (.geo, .step, .brep) again, up to three times, "
      "with small cells where solutions are not smooth.",
      Allowed::one_of({"h", "p", "hp"}));
    section.add(
      "Largest number of unknowns",
      adaptivity.most_unknowns,
      "What needs more ends with exit code 3, the last result written.",
      Allowed::positive_number());
    section.add("Largest degree",
                adaptivity.largest_degree,
                "Likewise.",
                Allowed::integer(min_degree, max_degree));
  }

  void
  declare_steps(const ParameterSection &section, StepParameters &steps)
  {
    section.add(
      "End time",
      steps.end_time,
      "End of the last step [time]; the first begins at 0. Empty: the last of Step, or 1.",
      Allowed::positive_number());
    section.add(
      "Step",
      steps.step,
      "Length of all steps, or the times at which they end [time]. Empty: one step.",
      {"a positive number, or ascending ones separated by commas",
       [](double length) { return length > 0.; }});
    section.add(
      "Output every",
      steps.output_every,
      "Fields are written after every so many of these times, and at the end.",
      Allowed::integer(1));
    section.add(
      "Smallest step",
      steps.smallest_step,
      "A nonlinear scene halves steps that fail, down to this share of the step that is asked for [-].",
      Allowed::positive_number());
  }
} // namespace mortise
