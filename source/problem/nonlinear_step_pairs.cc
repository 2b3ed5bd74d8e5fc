// Newton's method of a NonlinearStep where interfaces follow the bodies.
#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/mortar/coupling.h>
#include <mortise/problem/nonlinear_step.h>

#include <algorithm>
#include <limits>
#include <map>
#include <string>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int most_pairings = 60, most_useless = 20,
                           few_pairings = 10;

    /// Residuals below this that do not fall by half in so many iterations are
    /// what numbers of points of integration leave that change with the pairs.
    constexpr double       rounding_of_pairs = 1e-6;
    constexpr unsigned int most_of_rounding  = 3;

    bool
    are_equal(const Vector &a, const Vector &b, const MPI_Comm comm)
    {
      const bool same =
        a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin());
      return Utilities::MPI::min(same ? 1 : 0, comm) == 1;
    }

    /// By name of an interface: multiplier_coefficients().
    using ByFace = std::map<std::string, std::vector<std::vector<double>>>;

    ByFace
    by_face(const Pairing &pairing,
            const Vector  &multiplier,
            const MPI_Comm comm)
    {
      ByFace result;
      for (const Coupling &coupling : pairing.all())
        result[coupling.interface->name()] =
          multiplier_coefficients(coupling, multiplier, comm);
      return result;
    }

    /// Those of patches that met no master before stay as they are.
    void
    take(const ByFace &known, const Pairing &pairing, Vector &multiplier)
    {
      for (const Coupling &coupling : pairing.all())
        if (const auto found = known.find(coupling.interface->name());
            found != known.end())
          set_multiplier(coupling, found->second, multiplier);
    }
  } // namespace

  void
  NonlinearStep::pair_at(const Vector                        &displacement,
                         const std::optional<ContactRecords> &known)
  {
    SystemVector x = discretisation.linear_system().zero_vector();
    x.displacement = displacement;
    SceneLoad without_prescribed;
    discretisation.pair(discretisation.solutions(without_prescribed, x));
    discretisation.set_gaps(*data, *load);
    begin_contact(known);
    norm = std::make_unique<ScaledResidual>(discretisation.linear_system());
    paired_at = displacement;
  }

  void
  NonlinearStep::begin_contact(const std::optional<ContactRecords> &known)
  {
    *of_scene = std::make_unique<ContactStep>(
      run, discretisation, solver, preloads, known);
    contact = of_scene->get();
  }

  NewtonReport
  NonlinearStep::follow(const State &last, SystemVector &x)
  {
    const auto zero = [this] {
      return discretisation.linear_system().zero_vector().multiplier;
    };
    if (!are_equal(paired_at, x.displacement, run.comm))
      {
        pair_at(x.displacement, last.contact);
        // those of the last state belong to this pairing
        if (x.multiplier.size() != zero().size())
          x.multiplier = zero();
      }
    else
      begin_contact(last.contact);
    double       best  = std::numeric_limits<double>::infinity();
    unsigned int rises = 0;
    NewtonReport all;
    while (all.iterations < most_pairings && rises < most_useless)
      {
        const NewtonReport one = improve(1, x);
        all.linear_iterations += one.linear_iterations;
        const SolveReport before = all.linear;
        all.linear               = one.linear;
        all.linear.setup_seconds += before.setup_seconds;
        all.linear.solve_seconds += before.solve_seconds;
        if (one.iterations == 0)
          {
            all.residual  = one.residual;
            all.converged = one.converged;
            break;
          }
        const auto known =
          by_face(discretisation.interfaces(), x.multiplier, run.comm);
        try
          {
            pair_at(x.displacement, contact->records());
          }
        catch (const InputError &error)
          {
            why = error.what();
            break;
          }
        x.multiplier = zero();
        take(known, discretisation.interfaces(), x.multiplier);
        all.residual = residual(x);
        print(++all.iterations, all.residual);
        rises         = all.residual < 0.5 * best ? 0 : rises + 1;
        best          = std::min(best, all.residual);
        all.converged = all.residual <= tolerance() ||
                        (best < rounding_of_pairs && rises >= most_of_rounding);
        if (all.converged)
          break;
      }
    all.easy = all.converged && all.iterations <= few_pairings;
    return all;
  }
} // namespace mortise
