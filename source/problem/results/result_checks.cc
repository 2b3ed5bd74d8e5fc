#include <mortise/base/error.h>
#include <mortise/base/numbers.h>
#include <mortise/problem/results/result_checks.h>
#include <mortise/solvers/linear_solver.h>

#include <cmath>
#include <sstream>

namespace mortise
{
  void
  check_loads(const SystemVector &rhs)
  {
    const double largest = largest_entry(rhs);
    if (largest == 0. ||
        (largest >= smallest_number && largest <= largest_number))
      return;
    std::ostringstream message;
    message
      << "The loads and prescribed displacements make forces at nodes of at most "
      << largest << "; allowed: " << allowed_numbers()
      << ". Check them, or take other units";
    throw InputError(message.str());
  }

  namespace
  {
    /// Keeps the first number that is not finite.
    class Finder
    {
    public:
      void
      look(const std::string &name, const double value)
      {
        if (!found.empty() || std::isfinite(value))
          return;
        std::ostringstream text;
        text << name << " = ";
        if (std::isnan(value)) // without the sign that some write
          text << "nan";
        else
          text << value;
        found = text.str();
      }

      void
      look(const std::string &name, const std::optional<double> &value)
      {
        if (value)
          look(name, *value);
      }

      std::string found;
    };
  } // namespace

  std::string
  first_not_finite(const StepSummary &step)
  {
    Finder finder;
    if (step.solver)
      finder.look("relative residual", step.solver->relative_residual);
    for (const BodySummary &body : step.bodies)
      {
        const std::string name = "body " + body.name + ", ";
        finder.look(name + "volume", body.volume);
        if (body.displacement_max)
          finder.look(name + "largest displacement",
                      body.displacement_max->value);
        if (body.von_mises_max)
          {
            finder.look(name + "largest von Mises stress",
                        body.von_mises_max->value);
            finder.look(name + "averaged von Mises stress",
                        body.von_mises_max->averaged);
            finder.look(name + "jump of the stress", body.von_mises_max->jump);
          }
      }
    for (const InterfaceSummary &interface : step.interfaces)
      {
        const std::string name = "interface " + interface.name + ", ";
        finder.look(name + "slave area", interface.slave_area);
        finder.look(name + "covered area", interface.covered_area);
        finder.look(name + "coverage error",
                    interface.worst_face_coverage_error);
        finder.look(name + "partition of unity error",
                    interface.partition_of_unity_error);
        finder.look(name + "force residual", interface.force_residual);
        finder.look(name + "moment residual", interface.moment_residual);
        finder.look(name + "linear completeness error",
                    interface.linear_completeness_error);
      }
    if (step.errors)
      {
        finder.look("L2 error of the displacement",
                    step.errors->displacement_l2);
        finder.look("H1 error of the displacement",
                    step.errors->displacement_h1);
        finder.look("error in energy", step.errors->energy);
        finder.look("L2 error of the pressure", step.errors->pressure_l2);
        finder.look("L2 error of the multiplier", step.errors->multiplier_l2);
      }
    for (const auto &[name, values] : step.quantities)
      for (const double value : values)
        finder.look(name, value);
    return finder.found;
  }

  std::string
  not_converged(const SolveReport &report,
                const double       tolerance,
                const unsigned int n_sets,
                const std::string &advice)
  {
    const std::string other =
      !advice.empty()           ? ", or take " + advice :
      report.method == "direct" ? "" :
                                  ", or try Solver/Method = direct";
    std::ostringstream text;
    if (!report.prepared)
      {
        text
          << "The solver (" << report.method
          << ") could not be set up: its factorisation meets a pivot that is not positive, as for a free rigid motion, or "
             "with moduli or sizes that differ beyond rounding. There is no result. Check the supports of each part of the "
             "bodies"
          << other;
        return text.str();
      }
    text << "The solver (" << report.method
         << ") did not converge: relative residual " << report.relative_residual
         << " after " << report.iterations << " iterations, allowed is "
         << tolerance << ". Results so far are written. ";
    if (n_sets > 0)
      text
        << "Its " << n_sets
        << " active sets did not converge. Take the finer or the softer side of each contact as slave";
    else if (report.relative_residual <= report.attainable)
      text << "Rounding leaves up to " << report.attainable
           << " whatever the method, since moduli or sizes differ too much";
    else if (!advice.empty())
      text << "Take " << advice << ", or raise Solver/Max iterations";
    else
      text << "Raise Solver/Max iterations or try another Solver/Method";
    return text.str();
  }
} // namespace mortise
