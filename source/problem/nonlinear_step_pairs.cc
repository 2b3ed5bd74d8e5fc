// Newton's method of a NonlinearStep where interfaces follow the bodies.
#include <deal.II/base/mpi.h>

#include <mortise/base/error.h>
#include <mortise/mortar/coupling.h>
#include <mortise/problem/nonlinear_step.h>
#include <mortise/solvers/anderson.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <string>

namespace mortise
{
  using namespace dealii;

  namespace
  {
    constexpr unsigned int most_pairings = 60, most_useless = 20,
                           few_pairings = 10, most_without_set = 2;

    /// Residuals below these that do not fall by half, the smaller in one
    /// iteration and the larger in so many, are what numbers of points of
    /// integration leave that change with the pairs.
    constexpr double       rounding_of_pairs = 1e-7, most_rounding = 1e-6;
    constexpr unsigned int most_of_rounding = 3;

    /// Of residuals from one iteration to the next.
    constexpr double slow_contraction = 0.1;

    bool
    are_equal(const Vector &a, const Vector &b, const MPI_Comm comm)
    {
      const bool same =
        a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin());
      return Utilities::MPI::min(same ? 1 : 0, comm) == 1;
    }

    /// By name of an interface: multiplier_coefficients(), in axes that follow
    /// the bodies if there is friction.
    using ByFace = std::map<std::string, std::vector<std::vector<double>>>;

    /// The normal of a node and two tangents that move with the face.
    Frame
    axes(const Coupling &coupling, const unsigned int s, const unsigned int k)
    {
      Tensor<1, dim> n(coupling.frames[s][k][0]),
        t(coupling.interface->slave().faces[s].frame.tangent[0]);
      t -= (t * n) * n;
      Frame result;
      result[0] = n;
      result[1] = t / t.norm();
      result[2] = cross_product_3d(n, Tensor<1, dim>(result[1]));
      return result;
    }

    /// Of tractions with friction, by slave face, in the axes of nodes, or from
    /// these in space.
    std::vector<std::vector<double>>
    in_axes(const Coupling                  &coupling,
            std::vector<std::vector<double>> coefficients,
            const bool                       to_space)
    {
      if (!coupling.has_following_friction())
        return coefficients;
      for (unsigned int s = 0; s < coefficients.size(); ++s)
        {
          const unsigned int n = coupling.frames[s].size();
          for (unsigned int k = 0; k < n; ++k)
            {
              const Frame    Q = axes(coupling, s, k);
              Tensor<1, dim> value;
              for (unsigned int c = 0; c < dim; ++c)
                value[c] = coefficients[s][c * n + k];
              value = to_space ? transpose(Q) * value : Q * value;
              for (unsigned int c = 0; c < dim; ++c)
                coefficients[s][c * n + k] = value[c];
            }
        }
      return coefficients;
    }

    ByFace
    by_face(const Pairing &pairing,
            const Vector  &multiplier,
            const MPI_Comm comm)
    {
      ByFace result;
      for (const Coupling &coupling : pairing.all())
        result[coupling.interface->name()] =
          in_axes(coupling,
                  multiplier_coefficients(coupling, multiplier, comm),
                  false);
      return result;
    }

    /// Anderson's acceleration of iterations that contract slowly, since the
    /// tangent lacks terms: of friction, and where sides are apart.
    class Acceleration
    {
    public:
      /// @p weights: of the squares of displacements.
      explicit Acceleration(const Vector &weights)
        : weights(weights)
      {}

      /// An iteration led from the displacement @p given to @p result with
      /// @p multipliers. Collective.
      void
      add(const Vector       &given,
          const SystemVector &result,
          const ByFace       &multipliers)
      {
        Step step{result, multipliers, result.displacement};
        step.way -= given;
        steps.push_back(std::move(step));
        if (steps.size() > most_steps)
          steps.pop_front();
      }

      /// The next iterate, the last result before. Collective.
      void
      apply(SystemVector &x, ByFace &multipliers) const
      {
        const unsigned int n = steps.size();
        FullMatrix<double> products(n, n);
        for (unsigned int a = 0; a < n; ++a)
          {
            Vector scaled = steps[a].way;
            scaled.scale(weights);
            for (unsigned int b = a; b < n; ++b)
              products(a, b) = products(b, a) = scaled * steps[b].way;
          }
        const std::vector<double> factors = anderson_weights(products);
        for (unsigned int a = 0; a < n; ++a)
          {
            const double factor = factors[a] - (a + 1 == n ? 1. : 0.);
            x.displacement.add(factor, steps[a].result.displacement);
            if (x.pressure.size() > 0)
              x.pressure.add(factor, steps[a].result.pressure);
            for (const auto &[name, of_faces] : steps[a].multipliers)
              if (const auto found = multipliers.find(name);
                  found != multipliers.end())
                for (unsigned int s = 0; s < of_faces.size(); ++s)
                  for (unsigned int i = 0; i < of_faces[s].size(); ++i)
                    found->second[s][i] += factor * of_faces[s][i];
          }
      }

    private:
      static constexpr unsigned int most_steps = 4;

      struct Step
      {
        SystemVector result;
        ByFace       multipliers;
        Vector       way;
      };

      const Vector    &weights;
      std::deque<Step> steps;
    };

    /// Those of patches that met no master before stay as they are.
    void
    take(const ByFace &known, const Pairing &pairing, Vector &multiplier)
    {
      for (const Coupling &coupling : pairing.all())
        if (const auto found = known.find(coupling.interface->name());
            found != known.end())
          set_multiplier(coupling,
                         in_axes(coupling, found->second, true),
                         multiplier);
    }
  } // namespace

  void
  NonlinearStep::pair_at(const Vector &displacement)
  {
    SystemVector x = discretisation.linear_system().zero_vector();
    x.displacement = displacement;
    SceneLoad without_prescribed;
    // both sides may have moved so far, towards each other
    double moved = 0.;
    if (begin.size() > 0)
      {
        Vector way(displacement);
        way -= begin;
        moved = 2. * std::sqrt(double(dim)) * way.linfty_norm();
      }
    discretisation.pair(discretisation.solutions(without_prescribed, x), moved);
    discretisation.set_gaps(*data, *load);
    norm = std::make_unique<ScaledResidual>(discretisation.linear_system());
    paired_at = displacement;
  }

  void
  NonlinearStep::begin_contact(const std::optional<ContactRecords> &known)
  {
    auto next = std::make_unique<ContactStep>(
      run, discretisation, solver, preloads, known);
    if (linearised_at)
      next->take_preconditioner(*contact);
    *of_scene = std::move(next);
    contact   = of_scene->get();
  }

  void
  NonlinearStep::go_on(const ContactRecords &known,
                       const State          &last,
                       const SlipOrigin     &origin,
                       const SystemVector   &x)
  {
    begin_contact(known);
    const bool has_last = last.displacement.size() > 0;
    contact->follow(has_last ? last.contact : std::nullopt,
                    origin,
                    *data,
                    *load,
                    free_part(x));
  }

  NewtonReport
  NonlinearStep::follow(const State &last, SystemVector &x)
  {
    const auto zero = [this] {
      return discretisation.linear_system().zero_vector().multiplier;
    };
    begin = x.displacement;
    if (!are_equal(paired_at, x.displacement, run.comm))
      {
        pair_at(x.displacement);
        // those of the last state belong to this pairing
        if (x.multiplier.size() != zero().size())
          x.multiplier = zero();
      }
    const SlipOrigin origin(discretisation.interfaces().all(),
                            discretisation.linear_system().owned_displacement,
                            discretisation.displacement_of_pairing(),
                            run.comm);
    if (contact != nullptr)
      begin_contact(last.contact);
    if (last.displacement.size() > 0 && last.contact)
      go_on(*last.contact, last, origin, x);
    Acceleration acceleration(discretisation.linear_system().bulk->diagonal());
    double       best  = std::numeric_limits<double>::infinity();
    unsigned int rises = 0, n_without_set = 0;
    NewtonReport all;
    while (all.iterations < most_pairings && rises < most_useless)
      {
        const Vector       given = x.displacement;
        const NewtonReport one   = improve(1, x);
        const bool lacks_set     = contact != nullptr && contact->lacks_set();
        all.linear_iterations += one.linear_iterations;
        const SolveReport before = all.linear;
        all.linear               = one.linear;
        all.linear.setup_seconds += before.setup_seconds;
        all.linear.solve_seconds += before.solve_seconds;
        if (one.iterations == 0)
          {
            all.residual  = one.residual;
            all.converged = one.converged && n_without_set == 0;
            break;
          }
        auto known =
          by_face(discretisation.interfaces(), x.multiplier, run.comm);
        std::optional<ContactRecords> reached;
        if (contact != nullptr)
          reached = contact->records_of_iterate(*load, free_part(x));
        acceleration.add(given, x, known);
        if (contraction > slow_contraction)
          {
            acceleration.apply(x, known);
            set_prescribed(x);
          }
        try
          {
            pair_at(x.displacement);
          }
        catch (const InputError &error)
          {
            why          = error.what();
            is_wrong     = true;
            all.residual = std::numeric_limits<double>::infinity();
            break;
          }
        x.multiplier = zero();
        take(known, discretisation.interfaces(), x.multiplier);
        if (reached)
          go_on(*reached, last, origin, x);
        else
          solver.update_interfaces();
        const double before_that = all.residual;
        all.residual             = residual(x);
        if (all.iterations > 0)
          contraction = all.residual / before_that;
        print(++all.iterations, all.residual);
        rises         = all.residual < 0.5 * best ? 0 : rises + 1;
        best          = std::min(best, all.residual);
        n_without_set = lacks_set ? n_without_set + 1 : 0;
        all.converged =
          !lacks_set && (all.residual <= tolerance() ||
                         (best < rounding_of_pairs && rises > 0) ||
                         (best < most_rounding && rises >= most_of_rounding));
        if (all.converged || n_without_set > most_without_set)
          break;
      }
    all.easy = all.converged && all.iterations <= few_pairings;
    return all;
  }
} // namespace mortise
