#include <mortise/problem/input/parameter_schema.h>

namespace mortise
{
  void
  declare_solver(const ParameterSection &section, SolverParameters &solver)
  {
    section.add(
      "Method",
      solver.method,
      "Linear solver. auto: condensed, or saddle point if a body is in mixed form; up to 100,000 displacements "
      "direct, where moduli differ by more than a million, or springs are softer than bodies by more than a "
      "thousand million.",
      Allowed::one_of(solver_method_names()));
    section.add(
      "Tolerance",
      solver.tolerance,
      {"Residual relative to the right hand side at which the solver stops [].",
       "-"},
      {"a number between 0 and 1, both excluded",
       [](double tolerance) { return tolerance > 0. && tolerance < 1.; }});
    section.add(
      "Max iterations",
      solver.max_iterations,
      "Largest number of iterations; without convergence the run ends with exit code 3.",
      Allowed::integer(1));
    section.add(
      "Multipliers on all ranks",
      solver.max_gathered,
      "Largest number of multipliers for which all ranks factorise the Schur complement together; beyond it each "
      "rank factorises the part of its own multipliers and their neighbours.",
      Allowed::integer(0));
    section.add(
      "Friction",
      solver.friction,
      "How the bound of Coulomb's law follows the pressure. newton: within a linear system, which is not symmetric; "
      "fixed point: from one symmetric linear system to the next.",
      Allowed::one_of({"newton", "fixed point"}));
    section.add("Print iterations",
                solver.print_iterations,
                "Print a line for each iteration.",
                {"true or false", {}, {"false", "true"}});
  }

  void
  declare_adaptivity(const ParameterSection &section,
                     AdaptivityParameters   &adaptivity)
  {
    section.add(
      "Target error",
      adaptivity.target_error,
      {"Estimated relative error at which the run ends [], of the displacements in the energy norm, or of Quantity. "
       "Empty: no adaptivity.",
       "-"},
      {"a number between 0 and 1, both excluded",
       [](double error) { return error > 0. && error < 1.; }});
    section.add(
      "Quantity",
      adaptivity.quantity,
      "The quantity of interest of Target error: a component of an entry of Output/Points or Output/Resultants. "
      "Cells that contribute to its error are refined. Empty: the energy norm.",
      {"\"NAME, x\", \"NAME, y\" or \"NAME, z\""});
    section.add(
      "Strategy",
      adaptivity.strategy,
      "Refinement of cells with large errors from cycle to cycle, starting with the given mesh and degrees. p: the "
      "degree rises by one; h: hexahedra are cut into eight; hp: one of both, by the decay of Legendre "
      "coefficients. The degree of tetrahedra rises; with h and hp gmsh meshes those of a geometry (.geo, .step, "
      ".brep) again, up to three times, with small cells where solutions are not smooth.",
      Allowed::one_of({"h", "p", "hp"}));
    section.add(
      "Largest number of unknowns",
      adaptivity.most_unknowns,
      "If the next cycle needs more, the run ends with exit code 3 and the last result is written.",
      Allowed::positive_number());
    section.add(
      "Largest degree",
      adaptivity.largest_degree,
      "If the next cycle needs a higher degree, the run ends with exit code 3 and the last result is written.",
      Allowed::integer(min_degree, max_degree));
  }

  void
  declare_steps(const ParameterSection &section, StepParameters &steps)
  {
    section.add(
      "End time",
      steps.end_time,
      {"End of the last step []; the first begins at 0. Empty: the last of Step, or 1.",
       "time"},
      Allowed::positive_number());
    section.add(
      "Step",
      steps.step,
      {"Length of all steps, or the times at which they end []. Empty: one step.",
       "time"},
      {"a positive number, or ascending ones separated by commas",
       [](double length) { return length > 0.; }});
    section.add(
      "Control",
      steps.by_arc_length,
      "load: t is given. arc length: t is an unknown, and each step has the length Step along the path of "
      "equilibria, so that loads may pass a maximum and fall; with the first tangent of the run t would grow by Step. "
      "The run ends where t reaches End time. For nonlinear laws, without contact.",
      Allowed::one_of({"load", "arc length"}));
    section.add(
      "Number of steps",
      steps.n_steps,
      "Control = arc length: the run ends after so many steps; parts of one that failed count as one. Empty: 100.",
      Allowed::integer(1));
    section.add(
      "Output every",
      steps.output_every,
      "Fields are written at every n-th of these times, and at the end.",
      Allowed::integer(1));
    section.add(
      "Largest step",
      steps.largest_step,
      {"Longest step in a nonlinear scene []; steps between the times of Step are cut evenly. Empty: no limit.",
       "time"},
      Allowed::positive_number());
    section.add(
      "Smallest step",
      steps.smallest_step,
      {"Steps that fail in a nonlinear scene are halved, down to this fraction of the planned step []; after those that "
       "converge easily the next ones are longer again.",
       "-"},
      Allowed::positive_number());
  }
} // namespace mortise
